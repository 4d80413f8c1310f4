//! From a case to what a program needs, and from what it wrote to an answer.

use crate::bellhop::{ArrivalsFile, RayFile, RayPath, ShadeFile};
use crate::environment::{Section, SoundSpeedField};
use crate::error::{AcousticsError, length};
use crate::field::Arrivals;
use crate::model::{Case, Output};
use crate::ray::{Ray, RayEnd, RayPoint};
use std::path::Path;

/// A case whose sound speeds reach beyond the box in which rays are followed: programs
/// of the family do not extend them.
pub(super) fn padded(case: &Case) -> Result<Case, AcousticsError> {
    let field = case.section.sound_speed();
    let [first, .., last] = *field.range_m() else { return Ok(case.clone()) };
    let far_m = case.settings.far_m.max(-case.settings.near_m);
    let beyond_m = 1.1 * far_m + 1000.0;
    let levels = field.depth_m().len();
    let mut range_m = field.range_m().to_vec();
    let mut speed_m_s = field.speed_m_s().to_vec();
    if first > -beyond_m {
        range_m.insert(0, -beyond_m);
        speed_m_s.splice(0..0, field.speed_m_s()[..levels].iter().copied());
    }
    if last < beyond_m {
        range_m.push(beyond_m);
        speed_m_s.extend_from_slice(&field.speed_m_s()[field.speed_m_s().len() - levels..]);
    }
    let field = SoundSpeedField::new(range_m, field.depth_m().to_vec(), speed_m_s, field.law())?;
    let section = &case.section;
    let mut wide = Section::new(field, section.bathymetry().clone(), section.bottom.clone())?;
    wide.altimetry.clone_from(&section.altimetry);
    wide.surface = section.surface.clone();
    wide.absorption = section.absorption;
    wide.attenuation.clone_from(&section.attenuation);
    Ok(Case { section: wide, ..case.clone() })
}

/// The answer to a case in the bytes of a file of an ending.
pub(super) fn read_answer(
    case: &Case,
    ending: &str,
    bytes: &[u8],
) -> Result<Output, AcousticsError> {
    let path = Path::new("case").with_extension(ending);
    let sources = case.source_depth_m.len();
    let (range_m, depth_m) = (case.receivers.range_m(), case.receivers.depth_m());
    match ending {
        "shd" => {
            let mut fields = ShadeFile::from_bytes(&path, bytes)?.fields;
            length("fields", sources, fields.len())?;
            for field in &mut fields {
                length("pressures", case.receivers.count(), field.pressure.len())?;
                // The file holds them in single precision.
                field.range_m = range_m.to_vec();
                field.depth_m = depth_m.to_vec();
            }
            Ok(Output::Fields(fields))
        }
        "arr" => {
            let file = ArrivalsFile::from_bytes(&path, bytes, case.receivers.layout())?;
            length("sources of arrivals", sources, file.arrivals.len())?;
            let arrivals = file.arrivals.into_iter().map(|arrivals| {
                length("receivers of arrivals", case.receivers.count(), arrivals.at.len())?;
                let mut at = arrivals.at;
                for receiver in &mut at {
                    receiver.sort_by(|a, b| a.delay_s.total_cmp(&b.delay_s));
                }
                Ok(Arrivals { range_m: range_m.to_vec(), depth_m: depth_m.to_vec(), at })
            });
            arrivals.collect::<Result<_, _>>().map(Output::Arrivals)
        }
        _ => {
            let file = RayFile::from_text(&path, &String::from_utf8_lossy(bytes))?;
            let mut of_sources = vec![Vec::new(); sources];
            for path in file.rays {
                // Rays do not name their source, but they begin there.
                let start_m = path.points_m.first().map_or(f64::NAN, |point| point[1]);
                let apart = |source: &usize| (case.source_depth_m[*source] - start_m).abs();
                let nearest = (0..sources).min_by(|a, b| apart(a).total_cmp(&apart(b)));
                if let Some(source) = nearest {
                    of_sources[source].push(ray(case, path));
                }
            }
            Ok(Output::Rays(of_sources))
        }
    }
}

/// A ray with the times that its path takes, and why it ended as far as the path tells.
fn ray(case: &Case, path: RayPath) -> Ray {
    let sound_speed = case.section.sound_speed();
    let mut time_s = 0.0;
    let mut before: Option<[f64; 2]> = None;
    let points: Vec<RayPoint> = path
        .points_m
        .into_iter()
        .map(|[range_m, depth_m]| {
            if let Some([r, z]) = before {
                let half_way = (0.5 * (r + range_m), 0.5 * (z + depth_m));
                let speed = sound_speed.speed_at_m_s(half_way.0, half_way.1);
                time_s += (range_m - r).hypot(depth_m - z) / speed;
            }
            before = Some([range_m, depth_m]);
            RayPoint { range_m, depth_m, time_s }
        })
        .collect();
    let inside = |point: &RayPoint| point.range_m.abs() < case.settings.far_m;
    let end = if points.last().is_some_and(inside) { RayEnd::Faded } else { RayEnd::LeftDomain };
    Ray {
        launch_angle_deg: path.launch_angle_deg,
        points,
        surface_bounces: path.surface_bounces,
        bottom_bounces: path.bottom_bounces,
        end,
    }
}
