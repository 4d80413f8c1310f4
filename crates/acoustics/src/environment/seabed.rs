use super::FluidHalfSpace;
use std::str::FromStr;

/// Sea floors by name, as half-spaces of the compressional properties in
/// Table 1.3 of *Computational Ocean Acoustics* (Jensen, Kuperman, Porter &
/// Schmidt, 2nd ed. 2011, doi:10.1007/978-1-4419-8678-8). Shear is left out, so
/// the rocks reflect more at steep angles than they should.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Seabed {
    /// Clay so soft that it returns almost nothing: mean grain size 9 φ of the
    /// APL-UW High-Frequency Ocean Environmental Acoustic Models Handbook (TR 9407,
    /// 1994): 0.9801 times the speed of the water above (here 1488 m/s).
    Clay,
    /// Soft mud of the slope and the deep sea (the table's clay, 70 % porosity).
    Mud,
    /// Silt, 55 % porosity.
    Silt,
    /// Sand, 45 % porosity.
    Sand,
    /// Gravel, 35 % porosity.
    Gravel,
    /// Moraine, 25 % porosity.
    Moraine,
    /// Chalk.
    Chalk,
    /// Limestone.
    Limestone,
    /// Basalt: rock.
    Rock,
}

impl Seabed {
    /// All sea floors, softest first.
    pub const ALL: [Self; 9] = [
        Self::Clay,
        Self::Mud,
        Self::Silt,
        Self::Sand,
        Self::Gravel,
        Self::Moraine,
        Self::Chalk,
        Self::Limestone,
        Self::Rock,
    ];

    /// The name by which scenarios call it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Clay => "clay",
            Self::Mud => "mud",
            Self::Silt => "silt",
            Self::Sand => "sand",
            Self::Gravel => "gravel",
            Self::Moraine => "moraine",
            Self::Chalk => "chalk",
            Self::Limestone => "limestone",
            Self::Rock => "rock",
        }
    }

    /// Its acoustic properties: COA Table 1.3 (speeds for water of 1500 m/s), but clay.
    pub const fn half_space(self) -> FluidHalfSpace {
        let (speed_m_s, density_ratio, attenuation_db_wavelength) = match self {
            Self::Clay => (1458.0, 1.145, 0.08),
            Self::Mud => (1500.0, 1.5, 0.2),
            Self::Silt => (1575.0, 1.7, 1.0),
            Self::Sand => (1650.0, 1.9, 0.8),
            Self::Gravel => (1800.0, 2.0, 0.6),
            Self::Moraine => (1950.0, 2.1, 0.4),
            Self::Chalk => (2400.0, 2.2, 0.2),
            Self::Limestone => (3000.0, 2.4, 0.1),
            Self::Rock => (5250.0, 2.7, 0.1),
        };
        FluidHalfSpace { speed_m_s, density_ratio, attenuation_db_wavelength }
    }
}

/// The name of no known sea floor.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "{0:?} is no known sea floor: clay, mud, silt, sand, gravel, moraine, chalk, limestone, rock"
)]
pub struct UnknownSeabed(pub String);

impl FromStr for Seabed {
    type Err = UnknownSeabed;

    fn from_str(name: &str) -> Result<Self, UnknownSeabed> {
        Self::ALL
            .into_iter()
            .find(|seabed| seabed.name() == name)
            .ok_or_else(|| UnknownSeabed(name.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_leads_back_to_its_sea_floor() {
        for seabed in Seabed::ALL {
            assert_eq!(seabed.name().parse(), Ok(seabed));
        }
        assert_eq!("granite".parse::<Seabed>(), Err(UnknownSeabed("granite".to_owned())));
    }
}
