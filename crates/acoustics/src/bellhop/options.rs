//! What the letters of the options stand for.

use super::records::Records;
use crate::decibel::DB_PER_NEPER;
use crate::error::AcousticsError;
use crate::field::{
    BeamCoordinates, BeamKind, BeamShape, Coherence, ReceiverLayout, SourceGeometry,
};
use crate::model::Run;
use std::f64::consts::{PI, TAU};

/// Letters of a field of options; those left out are blank.
pub(crate) struct Options(String);

impl Options {
    pub(crate) fn new(letters: String) -> Self {
        Self(letters)
    }

    pub(crate) fn letter(&self, index: usize) -> char {
        self.0.chars().nth(index).unwrap_or(' ')
    }

    /// Refuses letters from an index on, which mean nothing.
    pub(crate) fn none_from(
        &self,
        index: usize,
        records: &Records,
        feature: &'static str,
    ) -> Result<(), AcousticsError> {
        let rest: String = self.0.chars().skip(index).collect();
        if rest.trim().is_empty() { Ok(()) } else { Err(records.unsupported(feature, rest)) }
    }
}

/// The unit in which attenuations are given.
#[derive(Debug, Clone, Copy)]
pub(crate) struct AttenuationUnit {
    letter: char,
    frequency_hz: f64,
}

impl AttenuationUnit {
    pub(crate) fn new(
        records: &Records,
        letter: char,
        frequency_hz: f64,
    ) -> Result<Self, AcousticsError> {
        if "NFMWQL".contains(letter) {
            return Ok(Self { letter, frequency_hz });
        }
        Err(records.unsupported("the unit of attenuation (one of N, F, M, W, Q, L)", letter))
    }

    /// An attenuation of this unit in dB per wavelength: nepers/m (N), dB/(m kHz) (F),
    /// dB/m (M), dB per wavelength (W), quality factor (Q), loss parameter (L).
    pub(crate) fn db_wavelength(self, value: f64, speed_m_s: f64) -> f64 {
        let wavelength_m = speed_m_s / self.frequency_hz;
        match self.letter {
            'N' => value * DB_PER_NEPER * wavelength_m,
            'F' => value * self.frequency_hz / 1000.0 * wavelength_m,
            'M' => value * wavelength_m,
            // No quality at all stands for no loss.
            'Q' if value == 0.0 => 0.0,
            'Q' => PI * DB_PER_NEPER / value,
            'L' => TAU * DB_PER_NEPER * value,
            _ => value,
        }
    }
}

/// What the letters of the run type ask for.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RunType {
    pub run: Run,
    pub beams: BeamKind,
    pub has_beam_pattern: bool,
    pub geometry: SourceGeometry,
    pub layout: ReceiverLayout,
    /// Whether arrivals go to a binary file.
    pub binary: bool,
}

const KINDS: [(char, BeamShape, BeamCoordinates); 4] = [
    ('G', BeamShape::Hat, BeamCoordinates::Cartesian),
    ('g', BeamShape::Hat, BeamCoordinates::RayCentred),
    ('B', BeamShape::Gaussian, BeamCoordinates::Cartesian),
    ('b', BeamShape::Gaussian, BeamCoordinates::RayCentred),
];

const RUNS: [(char, Run); 6] = [
    ('C', Run::Field(Coherence::Coherent)),
    ('S', Run::Field(Coherence::SemiCoherent)),
    ('I', Run::Field(Coherence::Incoherent)),
    ('R', Run::Rays),
    ('E', Run::Eigenrays),
    ('A', Run::Arrivals),
];

impl RunType {
    pub(crate) fn read(records: &mut Records) -> Result<Self, AcousticsError> {
        let options = Options::new(records.text("the run type in quotes")?.0);
        let letter = |index| options.letter(index);
        let binary = letter(0) == 'a';
        let asked = if binary { 'A' } else { letter(0) };
        let run = RUNS.into_iter().find(|(known, _)| *known == asked);
        let (_, run) = run.ok_or_else(|| {
            records.unsupported("the run type (one of C, S, I, R, E, A, a)", letter(0))
        })?;
        let kind = if matches!(letter(1), ' ' | '^') { 'G' } else { letter(1) };
        let kind = KINDS.into_iter().find(|(known, ..)| *known == kind);
        let (_, shape, coordinates) = kind.ok_or_else(|| {
            records.unsupported("the type of beams (one of G, ^, g, B, b)", letter(1))
        })?;
        let has_beam_pattern = match letter(2) {
            '*' => true,
            ' ' | 'O' => false,
            other => return Err(records.unsupported("the beam pattern (* or blank)", other)),
        };
        let geometry = match letter(3) {
            ' ' | 'R' => SourceGeometry::Point,
            'X' => SourceGeometry::Line,
            other => return Err(records.unsupported("the type of source (R or X)", other)),
        };
        let layout = match letter(4) {
            ' ' | 'R' => ReceiverLayout::Grid,
            'I' => ReceiverLayout::Pairs,
            other => return Err(records.unsupported("the receiver grid (R or I)", other)),
        };
        if !matches!(letter(5), ' ' | '2') {
            return Err(records.unsupported("the number of dimensions (2 or blank)", letter(5)));
        }
        options.none_from(6, records, "the rest of the run type")?;
        let beams = BeamKind { shape, coordinates };
        Ok(Self { run, beams, has_beam_pattern, geometry, layout, binary })
    }

    /// The letters that ask for this.
    pub(crate) fn letters(self) -> String {
        let kind = KINDS.into_iter().find(|(_, shape, coordinates)| {
            (*shape, *coordinates) == (self.beams.shape, self.beams.coordinates)
        });
        let run = RUNS.into_iter().find(|(_, run)| *run == self.run);
        let choose = |chosen: bool, letter: char, other: char| if chosen { letter } else { other };
        let letters = [
            run.map_or(' ', |(letter, _)| letter),
            kind.map_or(' ', |(letter, ..)| letter),
            choose(self.has_beam_pattern, '*', ' '),
            choose(self.geometry == SourceGeometry::Line, 'X', 'R'),
            choose(self.layout == ReceiverLayout::Pairs, 'I', 'R'),
        ];
        letters.into_iter().collect()
    }
}
