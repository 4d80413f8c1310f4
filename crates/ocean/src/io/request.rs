//! How to get real data.

use crate::Region;
use jiff::{SignedDuration, Timestamp};
use std::fmt::Write;

/// Distance between the nodes of the Copernicus Marine global forecast, degrees.
const SPACING_DEG: f64 = 1.0 / 12.0;
/// Nodes asked for beyond the region, so that fields can be interpolated and vehicles
/// swept across the edge still feel currents.
const PADDING_NODES: f64 = 3.0;
/// Hours between the states of the forecast.
const INTERVAL_H: i64 = 6;

/// The datasets of `GLOBAL_ANALYSISFORECAST_PHY_001_024` with 6-hourly states, their
/// variables, and the file each is saved as.
const DATASETS: [(&str, &[&str], &str); 3] = [
    ("cmems_mod_glo_phy-thetao_anfc_0.083deg_PT6H-i", &["thetao"], "thetao.nc"),
    ("cmems_mod_glo_phy-so_anfc_0.083deg_PT6H-i", &["so"], "so.nc"),
    ("cmems_mod_glo_phy-cur_anfc_0.083deg_PT6H-i", &["uo", "vo"], "uo_vo.nc"),
];

/// The exact `copernicusmarine subset` commands, and the GEBCO request, for the data
/// that a scenario needs: its region with a few nodes around, its times, and depths from
/// the surface to `depth_m`.
///
/// The default of `--coordinates-selection-method`, `inside`, would cut off the nodes
/// just beyond the box, so the commands say `outside`.
pub fn download_request(region: Region, start: Timestamp, end: Timestamp, depth_m: f64) -> String {
    let area = region.grown(PADDING_NODES * SPACING_DEG);
    // Beyond 180 where the region crosses the antimeridian, as the tool wants it.
    let west = (area.west_deg + 180.0).rem_euclid(360.0) - 180.0;
    let east = west + area.width_deg();
    let (from, to) = (floor_to_state(start), ceil_to_state(end));
    let time = |time: Timestamp| time.strftime("%Y-%m-%dT%H:%M:%S").to_string();
    let mut text = String::new();
    let mut line = |arguments: std::fmt::Arguments| {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{arguments}");
    };
    line(format_args!("# Ocean: Copernicus Marine, doi:10.48670/moi-00016 (free account needed)."));
    line(format_args!("# pip install copernicusmarine && copernicusmarine login"));
    let box_arguments = format!(
        "--minimum-longitude {west:.4} --maximum-longitude {east:.4} \
         --minimum-latitude {:.4} --maximum-latitude {:.4}",
        area.south_deg, area.north_deg
    );
    for (dataset, variables, file) in DATASETS {
        let variables = variables.join(" --variable ");
        line(format_args!(
            "copernicusmarine subset --dataset-id {dataset} --variable {variables} \\"
        ));
        line(format_args!("  {box_arguments} \\"));
        line(format_args!("  --start-datetime {} --end-datetime {} \\", time(from), time(to)));
        line(format_args!("  --minimum-depth 0 --maximum-depth {:.0} \\", depth_m.ceil()));
        line(format_args!("  --coordinates-selection-method outside --output-filename {file}"));
    }
    line(format_args!(
        "# Daily means instead: PT6H-i becomes P1D-m in the dataset ids. Years before the"
    ));
    line(format_args!(
        "# forecast's archive: cmems_mod_glo_phy_my_0.083deg_P1D-m (GLORYS12), all variables."
    ));
    line(format_args!(""));
    line(format_args!("# Bathymetry: GEBCO grid (public domain), https://download.gebco.net"));
    line(format_args!(
        "#   Boundaries: west {west:.4}, east {east:.4}, south {:.4}, north {:.4}",
        area.south_deg, area.north_deg
    ));
    line(format_args!("#   Data: the current GEBCO grid (ice surface); format: 2D netCDF"));
    line(format_args!("# or, coarser, from Copernicus Marine:"));
    line(format_args!(
        "copernicusmarine subset --dataset-id cmems_mod_glo_phy_anfc_0.083deg_static \
         --dataset-part bathy --variable deptho \\"
    ));
    line(format_args!("  {box_arguments} \\"));
    line(format_args!("  --coordinates-selection-method outside --output-filename deptho.nc"));
    text
}

fn floor_to_state(time: Timestamp) -> Timestamp {
    let excess_s = time.as_second().rem_euclid(INTERVAL_H * 3600);
    let whole = time - SignedDuration::from_secs(excess_s);
    whole - SignedDuration::from_nanos(i64::from(time.subsec_nanosecond()))
}

fn ceil_to_state(time: Timestamp) -> Timestamp {
    let floor = floor_to_state(time);
    if floor == time { time } else { floor + SignedDuration::from_hours(INTERVAL_H) }
}

#[cfg(test)]
mod tests {
    use super::download_request;
    use crate::synthetic::{REGION, START};
    use jiff::SignedDuration;

    #[test]
    fn the_default_scenario_s_request() {
        let end = START + SignedDuration::from_hours(37);
        let text = download_request(REGION, START + SignedDuration::from_mins(5), end, 2300.0);
        for expected in [
            "--dataset-id cmems_mod_glo_phy-thetao_anfc_0.083deg_PT6H-i --variable thetao",
            "--dataset-id cmems_mod_glo_phy-cur_anfc_0.083deg_PT6H-i --variable uo --variable vo",
            "--minimum-longitude 117.8500 --maximum-longitude 118.6500",
            "--minimum-latitude 21.3500 --maximum-latitude 22.1300",
            "--start-datetime 2025-10-09T00:00:00 --end-datetime 2025-10-10T18:00:00",
            "--minimum-depth 0 --maximum-depth 2300",
            "--coordinates-selection-method outside",
            "download.gebco.net",
        ] {
            assert!(text.contains(expected), "{expected} not in:\n{text}");
        }
    }
}
