use super::{Boundary, Interface, SoundSpeedField};
use crate::error::AcousticsError;
use crate::seawater::Absorption;

/// A vertical section of the sea along one bearing: what a ray meets. The
/// source is at range 0; ranges behind it are negative, depths positive down.
#[derive(Debug, Clone, PartialEq)]
pub struct Section {
    sound_speed: SoundSpeedField,
    bathymetry: Interface,
    /// The sea surface; level at the first sound-speed level without it.
    pub altimetry: Option<Interface>,
    /// What reflects at the surface.
    pub surface: Boundary,
    /// What reflects at the sea floor.
    pub bottom: Boundary,
    /// Absorption in the water.
    pub absorption: Absorption,
}

impl Section {
    /// A section under a free surface with Thorp's absorption.
    ///
    /// # Errors
    /// If the sea floor lies deeper than the last sound-speed level anywhere.
    pub fn new(
        sound_speed: SoundSpeedField,
        bathymetry: Interface,
        bottom: Boundary,
    ) -> Result<Self, AcousticsError> {
        let deepest_level_m = sound_speed.depth_m()[sound_speed.depth_m().len() - 1];
        let deepest_floor_m = bathymetry.deepest_m();
        if deepest_floor_m > deepest_level_m {
            return Err(AcousticsError::LevelsTooShallow { deepest_level_m, deepest_floor_m });
        }
        let (surface, absorption) = (Boundary::Vacuum, Absorption::Thorp);
        Ok(Self { sound_speed, bathymetry, altimetry: None, surface, bottom, absorption })
    }

    /// The speed of sound in the water.
    pub const fn sound_speed(&self) -> &SoundSpeedField {
        &self.sound_speed
    }

    /// The sea floor.
    pub const fn bathymetry(&self) -> &Interface {
        &self.bathymetry
    }
}
