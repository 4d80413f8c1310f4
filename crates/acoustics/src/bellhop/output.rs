use super::{ArrivalsFile, RayFile, RayPath, ShadeFile};
use crate::model::{Case, Output};
use std::fmt::Write;

/// What programs of the BELLHOP family write into their `.prt` file when they fail; some
/// of them exit as if all were well.
pub const FATAL_ERROR: &str = "*** FATAL ERROR ***";

/// The file of the BELLHOP family for a model's answer to a case: its ending and its
/// contents. `program` stands before the title.
pub fn output_file(
    case: &Case,
    output: &Output,
    binary_arrivals: bool,
    program: &str,
) -> (&'static str, Vec<u8>) {
    let title = format!("{program}- {}", case.title);
    let source_depth_m = case.source_depth_m.clone();
    let (frequency_hz, layout) = (case.frequency_hz, case.receivers.layout());
    match output {
        Output::Fields(fields) => {
            let fields = fields.clone();
            let file = ShadeFile { title, frequency_hz, layout, source_depth_m, fields };
            ("shd", file.to_bytes())
        }
        Output::Arrivals(arrivals) => {
            let arrivals = arrivals.clone();
            let file = ArrivalsFile { frequency_hz, layout, source_depth_m, arrivals };
            let bytes = if binary_arrivals { file.to_bytes() } else { file.to_text().into_bytes() };
            ("arr", bytes)
        }
        Output::Rays(of_sources) => {
            let levels = case.section.sound_speed().depth_m();
            let rays = of_sources.iter().flatten().map(|ray| RayPath {
                launch_angle_deg: ray.launch_angle_deg,
                surface_bounces: ray.surface_bounces,
                bottom_bounces: ray.bottom_bounces,
                points_m: ray.points.iter().map(|point| [point.range_m, point.depth_m]).collect(),
            });
            let file = RayFile {
                title,
                frequency_hz,
                sources: case.source_depth_m.len(),
                launch_angles: case.fan.beams().len(),
                water_m: [levels[0], levels[levels.len() - 1]],
                rays: rays.collect(),
            };
            ("ray", file.to_text().into_bytes())
        }
    }
}

/// The text of a `.prt` file about a run that went well.
pub fn print_text(program: &str, case: &Case, notes: &[String], seconds: f64) -> String {
    let (receivers, beams) = (&case.receivers, case.fan.beams());
    let mut text =
        format!("{program}- {}\nfrequency {} Hz, {:?}\n", case.title, case.frequency_hz, case.run);
    let _ = writeln!(
        text,
        "{} source depths, {} receiver depths, {} receiver ranges, {} beams",
        case.source_depth_m.len(),
        receivers.depth_m().len(),
        receivers.range_m().len(),
        beams.len(),
    );
    for note in notes {
        let _ = writeln!(text, "note: {note}");
    }
    let _ = writeln!(text, "done in {seconds:.3} s");
    text
}

/// The text of a `.prt` file about a run that failed.
pub fn fatal_text(program: &str, reason: &str) -> String {
    format!("{program}\n\n{FATAL_ERROR}\n{reason}\n")
}

/// The reason of a fatal error that a `.prt` file tells of.
pub(crate) fn fatal_reason(print: &str) -> Option<String> {
    const LINES: usize = 4;
    let (_, after) = print.split_once(FATAL_ERROR)?;
    let lines = after.lines().map(str::trim).filter(|line| !line.is_empty());
    Some(lines.take(LINES).collect::<Vec<_>>().join("; "))
}
