use super::{AttenuationProfile, Boundary, Interface, SoundSpeedField};
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
    /// What the water absorbs besides.
    pub attenuation: Option<AttenuationProfile>,
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
        Ok(Self {
            sound_speed,
            bathymetry,
            altimetry: None,
            surface: Boundary::Vacuum,
            bottom,
            absorption: Absorption::Thorp,
            attenuation: None,
        })
    }

    /// The speed of sound in the water.
    pub const fn sound_speed(&self) -> &SoundSpeedField {
        &self.sound_speed
    }

    /// The sea floor.
    pub const fn bathymetry(&self) -> &Interface {
        &self.bathymetry
    }

    /// Depth of the surface at a range, metres.
    pub fn surface_at_m(&self, range_m: f64) -> f64 {
        let first_level_m = self.sound_speed.depth_m()[0];
        self.altimetry.as_ref().map_or(first_level_m, |surface| surface.depth_at_m(range_m))
    }

    /// Checks that there is water between surface and sea floor, and sound speeds in
    /// all of it.
    ///
    /// # Errors
    /// If the surface lies above the first sound-speed level, or below the sea floor,
    /// anywhere.
    pub fn check(&self) -> Result<(), AcousticsError> {
        let first_level_m = self.sound_speed.depth_m()[0];
        let nodes = self.altimetry.iter().flat_map(Interface::range_m);
        for &range_m in nodes.chain(self.bathymetry.range_m()) {
            let surface_m = self.surface_at_m(range_m);
            let floor_m = self.bathymetry.depth_at_m(range_m);
            if surface_m < first_level_m {
                return Err(AcousticsError::SurfaceAboveLevels {
                    range_m,
                    surface_m,
                    first_level_m,
                });
            }
            if surface_m > floor_m {
                return Err(AcousticsError::NoWater { range_m, surface_m, floor_m });
            }
        }
        Ok(())
    }
}
