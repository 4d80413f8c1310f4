use super::options::RunType;
use crate::environment::{Boundary, Interface, InterfaceShape, ProfileLaw};
use crate::error::AcousticsError;
use crate::field::Beam;
use crate::model::{Case, Run};
use crate::seawater::Absorption;

const KM: f64 = 1000.0;

/// The texts of a case with a ray step, and the endings of their files.
pub(crate) fn write_texts(
    case: &Case,
    step_m: f64,
) -> Result<Vec<(&'static str, String)>, AcousticsError> {
    let law = law_letter(case)?;
    let fan = fan_lines(case)?;
    let section = &case.section;
    let levels = section.sound_speed().depth_m();
    if section.attenuation.as_ref().is_some_and(|profile| profile.depth_m() != levels) {
        return Err(not_offered("attenuation at other levels than those of the sound speed"));
    }
    let deepest_m = levels[levels.len() - 1];

    let mut env = vec![
        // A text ends with its line.
        quoted(&case.title.replace(['\n', '\r'], " ")),
        format!("{}  ! Hz", case.frequency_hz),
        "1".to_owned(),
    ];
    let altimetry = if section.altimetry.is_some() { '~' } else { ' ' };
    let (absorption, absorption_line) = absorption(section.absorption);
    let surface = boundary_letter(&section.surface);
    env.push(quoted(&format!("{law}{surface}W{absorption}{altimetry}")));
    env.extend(half_space_line(&section.surface, levels[0]));
    env.extend(absorption_line);
    env.push(format!("0 0.0 {deepest_m}"));
    env.extend(level_lines(case));

    let floor = section.bathymetry();
    let is_flat = floor.range_m().len() == 1 && floor.node_depth_m()[0] >= deepest_m;
    let bathymetry = if is_flat { ' ' } else { '~' };
    env.push(format!("'{}{bathymetry}' 0.0", boundary_letter(&section.bottom)));
    env.extend(half_space_line(&section.bottom, deepest_m));

    env.extend(vector_lines(&case.source_depth_m, 1.0, "source depths, m"));
    env.extend(vector_lines(case.receivers.depth_m(), 1.0, "receiver depths, m"));
    env.extend(vector_lines(case.receivers.range_m(), KM, "receiver ranges, km"));
    let run_type = RunType {
        run: case.run,
        beams: case.beams,
        has_beam_pattern: case.beam_pattern.is_some(),
        geometry: case.geometry,
        layout: case.receivers.layout(),
        binary: false,
    };
    env.push(quoted(&run_type.letters()));
    env.extend(fan);
    let far_m = case.settings.far_m.max(-case.settings.near_m);
    // Rays touch the bottom of the water, so the box reaches beyond it.
    let box_m = if case.settings.deepest_m <= deepest_m {
        case.settings.deepest_m
    } else {
        deepest_m + 1.0
    };
    env.push(format!("{step_m} {box_m} {}  ! step, m; box, m and km", far_m / KM));

    let mut texts = vec![("env", lines(&env))];
    if law == 'Q' {
        texts.push(("ssp", sound_speed_text(case)));
    }
    if !is_flat {
        texts.push(("bty", interface_text(floor)));
    }
    if let Some(altimetry) = &section.altimetry {
        texts.push(("ati", interface_text(altimetry)));
    }
    for (ending, boundary) in [("trc", &section.surface), ("brc", &section.bottom)] {
        if let Boundary::Table(table) = boundary {
            let moduli = table.modulus().iter().zip(table.phase_rad());
            let entries =
                table.grazing_angle_deg().iter().zip(moduli).map(|(angle, (modulus, phase))| {
                    format!("{angle} {modulus} {}", phase.to_degrees())
                });
            texts.push((ending, table_text(entries)));
        }
    }
    if let Some(pattern) = &case.beam_pattern {
        let levels = pattern.angle_deg().iter().zip(pattern.level_db());
        texts.push(("sbp", table_text(levels.map(|(angle, level)| format!("{angle} {level}")))));
    }
    Ok(texts)
}

fn not_offered(what: &'static str) -> AcousticsError {
    AcousticsError::NotOffered { model: "BELLHOP", what }
}

fn lines(lines: &[String]) -> String {
    lines.join("\n") + "\n"
}

fn quoted(text: &str) -> String {
    format!("'{}'", text.replace('\'', "''"))
}

fn law_letter(case: &Case) -> Result<char, AcousticsError> {
    let field = case.section.sound_speed();
    let over_range = field.range_m().len() > 1;
    match field.law() {
        ProfileLaw::LinearSpeed if over_range => Ok('Q'),
        _ if over_range => Err(not_offered("sound speeds over range by other laws than C")),
        ProfileLaw::LinearSpeed => Ok('C'),
        ProfileLaw::LinearSquaredIndex => Ok('N'),
        ProfileLaw::CubicSpline => Ok('S'),
        ProfileLaw::MonotoneCubic => Ok('P'),
    }
}

fn boundary_letter(boundary: &Boundary) -> char {
    match boundary {
        Boundary::Vacuum => 'V',
        Boundary::Rigid => 'R',
        Boundary::Fluid(_) | Boundary::Elastic(_) => 'A',
        Boundary::Table(_) => 'F',
    }
}

fn half_space_line(boundary: &Boundary, depth_m: f64) -> Option<String> {
    let (fluid, shear_speed, shear_attenuation) = match boundary {
        Boundary::Vacuum | Boundary::Rigid | Boundary::Table(_) => return None,
        Boundary::Fluid(fluid) => (fluid, 0.0, 0.0),
        Boundary::Elastic(solid) => {
            (&solid.compressional, solid.shear_speed_m_s, solid.shear_attenuation_db_wavelength)
        }
    };
    let (speed, density) = (fluid.speed_m_s, fluid.density_ratio);
    let attenuation = fluid.attenuation_db_wavelength;
    Some(format!("{depth_m} {speed} {shear_speed} {density} {attenuation} {shear_attenuation} /"))
}

fn absorption(absorption: Absorption) -> (char, Option<String>) {
    match absorption {
        Absorption::None => (' ', None),
        Absorption::Thorp => ('T', None),
        Absorption::FrancoisGarrison { temperature_c, salinity_psu, ph, depth_m } => {
            ('F', Some(format!("{temperature_c} {salinity_psu} {ph} {depth_m}")))
        }
    }
}

/// Levels of the first profile, with attenuations where there are any.
fn level_lines(case: &Case) -> impl Iterator<Item = String> {
    let field = case.section.sound_speed();
    let attenuation = case.section.attenuation.as_ref();
    field.depth_m().iter().zip(field.speed_m_s()).map(move |(depth, speed)| match attenuation {
        // All values: those of a half-space above would carry over.
        None => format!("{depth} {speed} 0.0 1.0 0.0 0.0 /"),
        Some(profile) => {
            format!("{depth} {speed} 0.0 1.0 {} 0.0 /", profile.at_db_wavelength(*depth))
        }
    })
}

fn vector_lines(values: &[f64], unit: f64, what: &str) -> [String; 2] {
    let values: Vec<String> = values.iter().map(|value| (value / unit).to_string()).collect();
    let rows: Vec<String> = values.chunks(10).map(|row| row.join(" ")).collect();
    [format!("{}  ! {what}", values.len()), rows.join("\n") + " /"]
}

/// The beams: in equal steps where they are so, else one by one.
fn fan_lines(case: &Case) -> Result<Vec<String>, AcousticsError> {
    /// Part of a step by which beams may miss their places.
    const TOLERANCE: f64 = 1e-6;
    let beams = case.fan.beams();
    let angle_deg = |beam: &Beam| beam.angle_rad.to_degrees();
    let (first, last) = (angle_deg(&beams[0]), angle_deg(&beams[beams.len() - 1]));
    let step = (last - first) / (beams.len().max(2) - 1) as f64;
    let in_steps = beams.iter().enumerate().all(|(index, beam)| {
        (angle_deg(beam) - first - index as f64 * step).abs() <= TOLERANCE * step
    });
    let count = format!("{}  ! beams", beams.len());
    if in_steps && beams.len() > 1 {
        return Ok(vec![count, format!("{first} {last} /")]);
    }
    if !matches!(case.run, Run::Rays | Run::Eigenrays) {
        return Err(not_offered("sums over beams that are not in equal steps"));
    }
    let angles: Vec<String> = beams.iter().map(|beam| angle_deg(beam).to_string()).collect();
    Ok(vec![count, angles.join(" ") + " /"])
}

fn sound_speed_text(case: &Case) -> String {
    let field = case.section.sound_speed();
    let (columns, levels) = (field.range_m().len(), field.depth_m().len());
    let mut text = format!("{columns}\n");
    let row = |values: &mut dyn Iterator<Item = f64>| {
        values.map(|value| value.to_string()).collect::<Vec<_>>().join(" ") + "\n"
    };
    text += &row(&mut field.range_m().iter().map(|range| range / KM));
    for level in 0..levels {
        let speeds = field.speed_m_s();
        text += &row(&mut (0..columns).map(|column| speeds[column * levels + level]));
    }
    text
}

fn interface_text(interface: &Interface) -> String {
    let letter = match interface.shape() {
        InterfaceShape::Straight => 'L',
        InterfaceShape::Curvilinear => 'C',
    };
    let nodes = interface.range_m().iter().zip(interface.node_depth_m());
    let nodes = nodes.map(|(range, depth)| format!("{} {depth}", range / KM));
    format!("'{letter}'\n{}", table_text(nodes))
}

fn table_text(entries: impl ExactSizeIterator<Item = String>) -> String {
    let mut text = format!("{}\n", entries.len());
    for entry in entries {
        text += &entry;
        text.push('\n');
    }
    text
}
