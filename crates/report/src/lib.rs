//! The record of a run, drawn: figures as SVG and PNG, and one self-contained
//! HTML report.
//!
//! This crate computes nothing: it lays out, formats and contours what the
//! [`RunRecord`](sonarfleet::record::RunRecord) holds. Fonts and colour tables
//! are embedded, so the same record gives the same pictures on every machine.

mod canvas;
mod colour;
mod contour;
mod error;
mod figures;
mod html;
mod plot;
mod ticks;
mod valid;

pub use error::ReportError;
pub use figures::{
    write_chart, write_comparison, write_figures, write_layouts, write_scores, write_training,
};
pub use html::write_report;
