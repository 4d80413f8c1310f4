use crate::error::{AcousticsError, ascending, within};

/// A launch direction and the share of the fan that it stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Beam {
    /// Launch angle below the horizontal, radians.
    pub angle_rad: f64,
    /// Angle between it and its neighbours, Δα, radians.
    pub width_rad: f64,
}

/// The launch directions of a source.
#[derive(Debug, Clone, PartialEq)]
pub struct LaunchFan {
    beams: Vec<Beam>,
}

impl LaunchFan {
    /// Beams at equal distances from one angle to another, degrees, both ends
    /// included.
    ///
    /// # Errors
    /// If the angles do not ascend within ±90° or there are fewer than two beams.
    pub fn uniform(first_deg: f64, last_deg: f64, count: usize) -> Result<Self, AcousticsError> {
        within("the number of beams", "at least 2", count as f64, count > 1)?;
        within("the first launch angle", "at least -90", first_deg, first_deg >= -90.0)?;
        within(
            "the last launch angle",
            "above the first and at most 90",
            last_deg,
            last_deg > first_deg && last_deg <= 90.0,
        )?;
        let width_rad = ((last_deg - first_deg) / (count - 1) as f64).to_radians();
        let beam = |index: usize| Beam {
            angle_rad: first_deg.to_radians() + index as f64 * width_rad,
            width_rad,
        };
        Ok(Self { beams: (0..count).map(beam).collect() })
    }

    /// Beams at ascending angles, degrees; each stands for what lies half-way to its
    /// neighbours, the outermost as far outwards as inwards. One alone has no width.
    ///
    /// # Errors
    /// If there is no angle, or they do not ascend within ±90°.
    pub fn at(angles_deg: &[f64]) -> Result<Self, AcousticsError> {
        let count = angles_deg.len();
        within("the number of beams", "at least 1", count as f64, count > 0)?;
        ascending("launch angles", angles_deg)?;
        let (first, last) = (angles_deg[0], angles_deg[count - 1]);
        within("the first launch angle", "at least -90", first, first >= -90.0)?;
        within("the last launch angle", "at most 90", last, last <= 90.0)?;
        let beam = |index: usize| {
            let (before, after) = (index.saturating_sub(1), (index + 1).min(count - 1));
            let apart = (after - before).max(1) as f64;
            Beam {
                angle_rad: angles_deg[index].to_radians(),
                width_rad: ((angles_deg[after] - angles_deg[before]) / apart).to_radians(),
            }
        };
        Ok(Self { beams: (0..count).map(beam).collect() })
    }

    /// One beam of the fan, counted from 0, as wide as it is.
    pub fn only(&self, index: usize) -> Option<Self> {
        self.beams.get(index).map(|&beam| Self { beams: vec![beam] })
    }

    /// A fan symmetric about the horizontal, denser at shallow angles: for each
    /// class, how far up and down it reaches, in degrees, and how many beams lie
    /// in it (half above, half below). Every beam stands in the middle of its
    /// share of the class.
    ///
    /// # Errors
    /// If there is no class, limits do not ascend within 90°, or a class has an
    /// odd or zero number of beams.
    pub fn graded(classes: &[(f64, usize)]) -> Result<Self, AcousticsError> {
        within(
            "the number of beam classes",
            "at least 1",
            classes.len() as f64,
            !classes.is_empty(),
        )?;
        let mut beams = Vec::new();
        let mut inner_deg = 0.0;
        for &(limit_deg, count) in classes {
            beams.extend(Self::class(inner_deg, limit_deg, count)?.beams);
            inner_deg = limit_deg;
        }
        beams.sort_by(|a: &Beam, b: &Beam| a.angle_rad.total_cmp(&b.angle_rad));
        Ok(Self { beams })
    }

    /// One class of such a fan: the directions between two angles above and below
    /// the horizontal, degrees, with half of the beams above and half below.
    ///
    /// # Errors
    /// If the angles do not ascend within 0–90°, or the number of beams is odd or
    /// zero.
    pub fn class(inner_deg: f64, outer_deg: f64, count: usize) -> Result<Self, AcousticsError> {
        within("the inner limit of a beam class", "at least 0", inner_deg, inner_deg >= 0.0)?;
        within(
            "the outer limit of a beam class",
            "above the inner one and at most 90",
            outer_deg,
            outer_deg > inner_deg && outer_deg <= 90.0,
        )?;
        let even = count > 0 && count.is_multiple_of(2);
        within("the beams in a class", "even and positive", count as f64, even)?;
        let width_rad = ((outer_deg - inner_deg) / (count / 2) as f64).to_radians();
        let beam = |index: usize, side: f64| Beam {
            angle_rad: side * (inner_deg.to_radians() + (index as f64 + 0.5) * width_rad),
            width_rad,
        };
        let upward = (0..count / 2).rev().map(|index| beam(index, -1.0));
        let downward = (0..count / 2).map(|index| beam(index, 1.0));
        Ok(Self { beams: upward.chain(downward).collect() })
    }

    /// The same fan with every beam moved downward by a fraction of its width.
    #[must_use]
    pub fn shifted(&self, fraction: f64) -> Self {
        let moved = |beam: &Beam| Beam {
            angle_rad: beam.angle_rad + fraction * beam.width_rad,
            width_rad: beam.width_rad,
        };
        Self { beams: self.beams.iter().map(moved).collect() }
    }

    /// The beams of this fan and of another.
    #[must_use]
    pub fn joined(&self, other: &Self) -> Self {
        let mut beams = [self.beams(), other.beams()].concat();
        beams.sort_by(|a, b| a.angle_rad.total_cmp(&b.angle_rad));
        Self { beams }
    }

    /// The beams, from the uppermost to the lowest.
    pub fn beams(&self) -> &[Beam] {
        &self.beams
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_of_a_graded_fan_add_up_to_the_fan() {
        let fan = LaunchFan::graded(&[(12.0, 40), (25.0, 26), (60.0, 14)]).unwrap();
        assert_eq!(fan.beams().len(), 80);
        let total: f64 = fan.beams().iter().map(|beam| beam.width_rad).sum();
        assert!((total.to_degrees() - 120.0).abs() < 1e-9);
        assert!(fan.beams().windows(2).all(|pair| pair[0].angle_rad < pair[1].angle_rad));
    }

    #[test]
    fn beams_at_given_angles_share_the_fan() {
        let fan = LaunchFan::at(&[-10.0, 0.0, 2.0, 10.0]).unwrap();
        let widths = fan.beams().iter().map(|beam| beam.width_rad.to_degrees());
        for (width, exact) in widths.zip([10.0, 6.0, 5.0, 8.0]) {
            assert!((width - exact).abs() < 1e-12);
        }
        assert_eq!(fan.only(2).unwrap().beams(), &fan.beams()[2..3]);
        assert!(fan.only(4).is_none());
    }

    #[test]
    fn bad_fans_are_refused() {
        assert!(LaunchFan::at(&[]).is_err() && LaunchFan::at(&[5.0, 5.0]).is_err());
        assert!(LaunchFan::uniform(-10.0, 10.0, 1).is_err());
        assert!(LaunchFan::uniform(10.0, -10.0, 5).is_err());
        assert!(LaunchFan::graded(&[(12.0, 3)]).is_err());
        assert!(LaunchFan::graded(&[(12.0, 2), (10.0, 2)]).is_err());
    }
}
