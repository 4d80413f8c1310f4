//! What a comparison of methods writes down, as its figures are drawn from it.

use crate::grid::{CellId, SurveillanceGrid};
use serde::{Deserialize, Serialize};

/// Layouts of one problem side by side.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LayoutsRecord {
    /// Which problem, in words.
    pub name: String,
    /// Version of the program that made the layouts.
    pub version: String,
    /// The surveillance grid.
    pub grid: SurveillanceGrid,
    /// Cells where no vehicle may be placed.
    pub blocked_cells: Vec<CellId>,
    /// Sensors that were there before the fleet.
    pub fixed_sensors: Vec<CellId>,
    /// Required algebraic connectivity, τ.
    pub connectivity_threshold: f64,
    /// Target prior `P_T`, [row, column].
    pub prior: Vec<f64>,
    /// The layouts, in the order in which they are shown.
    pub layouts: Vec<LayoutRecord>,
}

/// A layout and what it achieves.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LayoutRecord {
    /// The method that made it, in words.
    pub name: String,
    /// The vehicles' cells.
    pub cells: Vec<CellId>,
    /// Network detection probability `P_net`, [row, column].
    pub detection_probability: Vec<f64>,
    /// `J_d`: expected number of targets detected.
    pub detection_utility: f64,
    /// λ₂ of the communication graph.
    pub algebraic_connectivity: f64,
}

/// Lines in panels side by side.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ChartRecord {
    /// What is compared on which problem, in words.
    pub name: String,
    /// How the lines came about, in words.
    pub note: String,
    /// Version of the program that made the numbers.
    pub version: String,
    /// The panels; the same name is the same series in all of them.
    pub panels: Vec<PanelRecord>,
}

/// Lines over one abscissa.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PanelRecord {
    /// What the panel shows.
    pub title: String,
    /// Label of the abscissa, with its unit.
    pub x_label: String,
    /// Label of the ordinate, with its unit.
    pub y_label: String,
    /// A level to compare with, and what it is.
    pub level: Option<(String, f64)>,
    /// The series.
    pub series: Vec<SeriesRecord>,
}

/// One number of one method.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SeriesRecord {
    /// The method, in words.
    pub name: String,
    /// Points [x, y] of every run.
    pub runs: Vec<Vec<[f64; 2]>>,
    /// Points [x, y] of their median.
    pub median: Vec<[f64; 2]>,
}

/// What methods reach on one problem, run by run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ScoresRecord {
    /// What is compared on which problem, in words.
    pub name: String,
    /// How the numbers came about, in words.
    pub note: String,
    /// Version of the program that made the numbers.
    pub version: String,
    /// Required algebraic connectivity, τ.
    pub connectivity_threshold: f64,
    /// One per method and run, the runs of a method one after the other.
    pub scores: Vec<ScoreRecord>,
}

/// What a method reached in one run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ScoreRecord {
    /// The method, in words.
    pub name: String,
    /// Reward R under the multiplier by which methods are compared.
    pub reward: f64,
    /// `J_d` of the layout.
    pub detection_utility: f64,
    /// λ₂ of the layout.
    pub algebraic_connectivity: f64,
}
