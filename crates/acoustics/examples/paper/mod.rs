//! What the examples draw on.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::{FontStyle, register_font};
use std::path::Path;

pub(crate) type Paper<'a> = DrawingArea<BitMapBackend<'a>, Shift>;
pub(crate) type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

const FONT: &[u8] = include_bytes!("../../../report/assets/fonts/DejaVuSans-subset.ttf");

/// A white sheet of paper.
pub(crate) fn paper(path: &Path, width: u32, height: u32) -> Outcome<Paper<'_>> {
    // Fails only for a second registration, which changes nothing.
    let _ = register_font("sans-serif", FontStyle::Normal, FONT);
    let paper = BitMapBackend::new(path, (width, height)).into_drawing_area();
    paper.fill(&WHITE)?;
    Ok(paper)
}
