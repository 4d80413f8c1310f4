use super::records::Records;
use crate::error::AcousticsError;
use std::fmt::Write;
use std::path::Path;

/// A `.ray` file: the paths of rays, as text.
///
/// Title, frequency, numbers of sources (x, y, z) and of launch angles (elevation,
/// bearing), depths of surface and bottom, `'rz'`; for each ray the launch angle
/// (degrees below the horizontal), the number of its points with its bounces off
/// surface and bottom, and range and depth of each point in metres.
#[derive(Debug, Clone, PartialEq)]
pub struct RayFile {
    /// The title, with the program that wrote it.
    pub title: String,
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// The number of sources.
    pub sources: usize,
    /// The number of launch angles of each source, of which eigenrays are a part.
    pub launch_angles: usize,
    /// Depths between which the water lies, metres.
    pub water_m: [f64; 2],
    /// The rays of one source after those of the other.
    pub rays: Vec<RayPath>,
}

/// A ray in a file.
#[derive(Debug, Clone, PartialEq)]
pub struct RayPath {
    /// Launch angle below the horizontal, degrees.
    pub launch_angle_deg: f64,
    /// Reflections off the surface.
    pub surface_bounces: u32,
    /// Reflections off the sea floor.
    pub bottom_bounces: u32,
    /// Range and depth of its points, metres.
    pub points_m: Vec<[f64; 2]>,
}

impl RayFile {
    /// The contents of the file.
    pub fn to_text(&self) -> String {
        let [top_m, bottom_m] = self.water_m;
        let mut text = format!(
            "'{}'\n {}\n 1 1 {}\n {} 1\n {top_m}\n {bottom_m}\n 'rz'\n",
            self.title.replace('\'', "''"),
            self.frequency_hz,
            self.sources,
            self.launch_angles,
        );
        for ray in &self.rays {
            let (top, bottom) = (ray.surface_bounces, ray.bottom_bounces);
            let _ =
                writeln!(text, " {}\n {} {top} {bottom}", ray.launch_angle_deg, ray.points_m.len());
            for [range_m, depth_m] in &ray.points_m {
                let _ = writeln!(text, " {range_m:.6} {depth_m:.6}");
            }
        }
        text
    }

    /// Understands the contents of a file; `path` is for errors.
    ///
    /// # Errors
    /// If a line does not hold what belongs there.
    pub fn from_text(path: &Path, text: &str) -> Result<Self, AcousticsError> {
        let mut records = Records::new(path, text);
        let (title, _) = records.text("a title in quotes")?;
        let [frequency_hz] = records.all("a frequency in Hz")?;
        let [_, _, sources] = records.all("the numbers of sources along x, y and z")?;
        let sources = records.checked_count("the number of sources", sources)?;
        let [angles, _] = records.all("the numbers of launch angles")?;
        let launch_angles = records.checked_count("the number of launch angles", angles)?;
        let [top_m] = records.all("the depth of the surface in m")?;
        let [bottom_m] = records.all("the depth of the bottom in m")?;
        let (coordinates, _) = records.text("'rz'")?;
        if coordinates != "rz" {
            return Err(records.unsupported("coordinates of rays other than 'rz':", coordinates));
        }
        let mut rays = Vec::new();
        while !records.at_end() {
            let [launch_angle_deg] = records.all("a launch angle in degrees")?;
            let [points, top, bottom] = records.all("numbers of points and bounces")?;
            let points = records.checked_count("the number of points", points)?;
            let points_m = (0..points)
                .map(|_| records.all("range and depth of a point in m"))
                .collect::<Result<_, _>>()?;
            rays.push(RayPath {
                launch_angle_deg,
                surface_bounces: top as u32,
                bottom_bounces: bottom as u32,
                points_m,
            });
        }
        Ok(Self { title, frequency_hz, sources, launch_angles, water_m: [top_m, bottom_m], rays })
    }
}
