//! scratch
use sonarfleet::grid::*;
use sonarfleet::sonar::section::*;
use sonarfleet::sonar::transmission_loss::*;
use sonarfleet_acoustics::environment::*;
use sonarfleet_acoustics::seawater::SoundSpeedEquation;
use sonarfleet_ocean::LocalFrame;
use sonarfleet_ocean::synthetic::SyntheticOcean;
fn cpu() -> f64 {
    let s = std::fs::read_to_string("/proc/self/stat").unwrap();
    let f: Vec<&str> = s.rsplit(')').next().unwrap().split_whitespace().collect();
    f[11].parse::<f64>().unwrap() * 0.01
}
fn parse(spec: &str) -> Numerics {
    let mut n = Quality::Standard.numerics();
    for kv in spec.split(';').filter(|s| !s.is_empty()) {
        let (k, v) = kv.split_once('=').unwrap();
        match k {
            "q" => n = v.parse::<Quality>().unwrap().numerics(),
            "b" => n.bearings = v.parse().unwrap(),
            "cut" => n.amplitude_cutoff = v.parse().unwrap(),
            "snd" => n.sounding_m = v.parse().unwrap(),
            "step" => n.range_step_m = v.parse().unwrap(),
            "c" => {
                n.beam_classes = v
                    .split(',')
                    .map(|c| {
                        let p: Vec<f64> = c.split(':').map(|x| x.parse().unwrap()).collect();
                        BeamClass {
                            limit_deg: p[0],
                            beams: p[1] as usize,
                            speed_tolerance_m_s: p[2],
                        }
                    })
                    .collect()
            }
            _ => unsafe_env(k, v),
        }
    }
    n
}
fn unsafe_env(k: &str, _v: &str) {
    panic!("{k}")
}
fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let seabeds: Vec<&str> = args[0].split(',').collect();
    let count: usize = args[1].parse().unwrap();
    let reference = &args[2];
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().unwrap();
    let ocean = SyntheticOcean { states: 1, ..SyntheticOcean::default() };
    let frame = LocalFrame::new(ocean.region);
    let (forecast, bathymetry) = (ocean.forecast(), ocean.bathymetry());
    let grid = SurveillanceGrid {
        columns: 30,
        rows: 30,
        cell_width_m: frame.width_m() / 30.0,
        cell_height_m: frame.height_m() / 30.0,
    };
    let sources: Vec<CellId> = (0..count).map(|k| CellId((k * 900 + 450) / count % 900)).collect();
    for spec in &args[2..] {
        for name in &seabeds {
            let fluid = if *name == "firm" {
                FluidHalfSpace::new(1600.0, 1.7, 0.5).unwrap()
            } else {
                name.parse::<Seabed>().unwrap().half_space()
            };
            let waters = Waters::new(
                &forecast.states[0],
                &bathymetry,
                &frame,
                SoundSpeedEquation::Mackenzie,
                Boundary::Fluid(fluid),
            )
            .unwrap();
            let file =
                format!("/tmp/k/ref_{name}_{count}_{}", reference.replace([';', ':', ','], "_"));
            let settings = LossTableSettings {
                frequency_hz: 1000.0,
                fleet_depth_m: 200.0,
                maximum_range_m: f64::INFINITY,
                numerics: parse(spec),
            };
            if spec == reference && std::path::Path::new(&file).exists() {
                continue;
            }
            let t = cpu();
            let rows =
                compute_rows(&waters, &grid, &settings, &sources, &|_, _| {}).unwrap().concat();
            let t = cpu() - t;
            if spec == reference {
                std::fs::write(
                    &file,
                    rows.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>(),
                )
                .unwrap();
                println!("{name} reference {:.2} s a source", t / count as f64);
                continue;
            }
            let fine: Vec<f32> = std::fs::read(&file)
                .unwrap()
                .chunks(4)
                .map(|b| f32::from_le_bytes(b.try_into().unwrap()))
                .collect();
            let mut d: Vec<f64> = rows
                .iter()
                .zip(&fine)
                .filter(|(_, f)| **f < 90.0)
                .map(|(a, f)| f64::from((a - f).abs()))
                .collect();
            let bias: f64 = rows
                .iter()
                .zip(&fine)
                .filter(|(_, f)| **f < 90.0)
                .map(|(a, f)| f64::from(a - f))
                .sum::<f64>()
                / d.len() as f64;
            d.sort_by(f64::total_cmp);
            let q = |x: f64| d[((d.len() - 1) as f64 * x) as usize];
            println!(
                "{name:5} {:5.1} s  {:.3} / {:.2} / {:.2}  bias {bias:+.3}  {spec}",
                t / count as f64 * 450.0,
                q(0.5),
                q(0.9),
                q(0.99)
            );
        }
    }
}
