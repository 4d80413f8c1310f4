use super::FluidHalfSpace;
use std::str::FromStr;

/// Sea floors by name, as fluid half-spaces: compressional speed, density and
/// attenuation. Shear is left out, so the rocks reflect more at steep angles than
/// they should.
///
/// All but clay are rows of Table 1.3 (bottom properties of the continental shelf
/// and slope) of *Computational Ocean Acoustics* (Jensen, Kuperman, Porter &
/// Schmidt, 2nd ed. 2011, doi:10.1007/978-1-4419-8678-8), abbreviated COA. The
/// table gives speeds relative to that of water; here they are for water of
/// 1500 m/s, and densities are relative to water.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Seabed {
    /// Clay so soft that it returns almost nothing: mean grain size 9 φ of the
    /// *APL-UW High-Frequency Ocean Environmental Acoustic Models Handbook* (TR 9407,
    /// 1994), section IV, Table 2: density ratio 1.145, 0.98 times the speed of the
    /// water above (here 1488 m/s, as near the floor of the South China Sea slope),
    /// loss parameter δ = 0.00148, which is 40π δ / ln 10 = 0.08 dB per wavelength.
    /// COA's clay is called mud here.
    Clay,
    /// Soft mud of the slope and the deep sea: COA's clay, of 70 % porosity.
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
    /// Rock: COA's basalt.
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

    /// Where its properties are from, in a few words.
    pub const fn source(self) -> &'static str {
        match self {
            Self::Clay => "APL-UW TR 9407, 9 φ",
            Self::Mud => "COA Table 1.3, clay",
            Self::Silt => "COA Table 1.3, silt",
            Self::Sand => "COA Table 1.3, sand",
            Self::Gravel => "COA Table 1.3, gravel",
            Self::Moraine => "COA Table 1.3, moraine",
            Self::Chalk => "COA Table 1.3, chalk",
            Self::Limestone => "COA Table 1.3, limestone",
            Self::Rock => "COA Table 1.3, basalt",
        }
    }

    /// Its acoustic properties.
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
        for seabed in Seabed::ALL {
            assert!(UnknownSeabed(String::new()).to_string().contains(seabed.name()));
        }
        assert_eq!("granite".parse::<Seabed>(), Err(UnknownSeabed("granite".to_owned())));
    }
    /// Speeds as multiples of 1500 m/s, as the table gives them.
    #[test]
    fn the_table_of_continental_floors() {
        for (seabed, speed_ratio, density_ratio, attenuation_db_wavelength) in [
            (Seabed::Mud, 1.0, 1.5, 0.2),
            (Seabed::Silt, 1.05, 1.7, 1.0),
            (Seabed::Sand, 1.1, 1.9, 0.8),
            (Seabed::Gravel, 1.2, 2.0, 0.6),
            (Seabed::Moraine, 1.3, 2.1, 0.4),
            (Seabed::Chalk, 1.6, 2.2, 0.2),
            (Seabed::Limestone, 2.0, 2.4, 0.1),
            (Seabed::Rock, 3.5, 2.7, 0.1),
        ] {
            let floor = seabed.half_space();
            assert!((floor.speed_m_s - 1500.0 * speed_ratio).abs() < 1e-9, "{}", seabed.name());
            assert!((floor.density_ratio - density_ratio).abs() < 1e-12, "{}", seabed.name());
            let attenuation = floor.attenuation_db_wavelength;
            assert!((attenuation - attenuation_db_wavelength).abs() < 1e-12, "{}", seabed.name());
            assert!(seabed.source().starts_with("COA"));
        }
    }

    #[test]
    fn clay_is_that_of_9_phi() {
        let clay = Seabed::Clay.half_space();
        assert!((clay.speed_m_s / 1488.0 - 0.98).abs() < 2e-4);
        let loss_parameter = 0.00148;
        let per_wavelength = 40.0 * std::f64::consts::PI * loss_parameter / 10f64.ln();
        assert!((clay.attenuation_db_wavelength - per_wavelength).abs() < 1e-3);
    }
}
