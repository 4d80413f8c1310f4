//! How the examples draw vertical sections: range across, depth down.

use super::paper::{Outcome, Paper};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;

pub(crate) type Section<'a, 'b> =
    ChartContext<'a, BitMapBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// The sea bed.
pub(crate) const GROUND: RGBColor = RGBColor(0xa8, 0xa0, 0x95);

/// Axes of a vertical section, in km and m, depth downward.
pub(crate) fn section<'a, 'b>(
    paper: &Paper<'b>,
    title: &str,
    range_km: f64,
    depth_m: f64,
) -> Outcome<Section<'a, 'b>> {
    let mut chart = ChartBuilder::on(paper)
        .caption(title, ("sans-serif", 20))
        .margin(14)
        .x_label_area_size(44)
        .y_label_area_size(66)
        .build_cartesian_2d(0.0..range_km, depth_m..0.0)?;
    chart
        .configure_mesh()
        .disable_mesh()
        .x_desc("range, km")
        .y_desc("depth, m")
        .x_label_formatter(&|x| format!("{x:.0}"))
        .y_label_formatter(&|y| format!("{y:.0}"))
        .label_style(("sans-serif", 15))
        .draw()?;
    Ok(chart)
}

/// Fills the ground under a sea floor given as (km, m) down to the frame's end.
pub(crate) fn ground(
    chart: &mut Section<'_, '_>,
    floor: &[(f64, f64)],
    range_km: f64,
    depth_m: f64,
) -> Outcome<()> {
    let mut outline = floor.to_vec();
    outline.extend([(range_km, depth_m), (0.0, depth_m)]);
    chart.draw_series([Polygon::new(outline, GROUND.filled())])?;
    Ok(())
}
