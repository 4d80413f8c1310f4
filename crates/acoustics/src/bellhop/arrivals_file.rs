use super::records::Records;
use crate::error::AcousticsError;
use crate::field::{Arrival, Arrivals, ReceiverLayout};
use std::f64::consts::TAU;
use std::fmt::Write;
use std::path::Path;

/// A `.arr` file: what arrives at receivers, as text or binary.
///
/// It begins with `'2D'`, the frequency, and lists of source depths, receiver depths
/// and receiver ranges, each after its count. For every source there follow the
/// greatest number of arrivals at a receiver and, over [depth, range], the number of
/// arrivals at the receiver and eight numbers for each: amplitude, phase (degrees),
/// delay (real and imaginary part, s; the latter holds the absorption), angles at
/// source and receiver (degrees below the horizontal), bounces off surface and bottom.
#[derive(Debug, Clone, PartialEq)]
pub struct ArrivalsFile {
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// How ranges and depths make up receivers, which the file does not say.
    pub layout: ReceiverLayout,
    /// Depths of the sources, metres.
    pub source_depth_m: Vec<f64>,
    /// What arrives from each source.
    pub arrivals: Vec<Arrivals>,
}

impl ArrivalsFile {
    /// The contents of the file as text.
    pub fn to_text(&self) -> String {
        let mut text = format!(" '2D'\n {}\n", self.frequency_hz);
        for list in self.lists() {
            let values: Vec<String> = list.iter().map(f64::to_string).collect();
            let _ = writeln!(text, " {} {}", list.len(), values.join(" "));
        }
        for arrivals in &self.arrivals {
            let _ = writeln!(text, " {}", most(arrivals));
            for receiver in &arrivals.at {
                let _ = writeln!(text, " {}", receiver.len());
                for arrival in receiver {
                    let [amplitude, phase, delay, lag, launch, angle, top, bottom] =
                        self.numbers(arrival);
                    let _ = writeln!(
                        text,
                        " {amplitude:e} {phase} {delay} {lag:e} {launch} {angle} {top} {bottom}"
                    );
                }
            }
        }
        text
    }

    /// The contents of the file in binary: Fortran's unformatted records.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut record = |contents: Vec<u8>| {
            let length = (contents.len() as u32).to_le_bytes();
            bytes.extend_from_slice(&length);
            bytes.extend_from_slice(&contents);
            bytes.extend_from_slice(&length);
        };
        let count = |count: usize| (count as u32).to_le_bytes().to_vec();
        let singles = |values: &[f64]| -> Vec<u8> {
            values.iter().flat_map(|&value| (value as f32).to_le_bytes()).collect()
        };
        record(b"'2D'".to_vec());
        record(singles(&[self.frequency_hz]));
        for list in self.lists() {
            record([count(list.len()), singles(list)].concat());
        }
        for arrivals in &self.arrivals {
            record(count(most(arrivals)));
            for receiver in &arrivals.at {
                record(count(receiver.len()));
                for arrival in receiver {
                    record(singles(&self.numbers(arrival)));
                }
            }
        }
        bytes
    }

    /// Understands the contents of a file, text or binary; `path` is for errors.
    ///
    /// # Errors
    /// If a line, or in binary a record, does not hold what belongs there.
    pub fn from_bytes(
        path: &Path,
        bytes: &[u8],
        layout: ReceiverLayout,
    ) -> Result<Self, AcousticsError> {
        // A binary file begins with the length of its first record.
        if bytes.starts_with(&4u32.to_le_bytes()) {
            return read(&mut Unformatted { path, bytes, at: 0 }, layout);
        }
        let text = String::from_utf8_lossy(bytes);
        read(&mut Records::new(path, &text), layout)
    }

    fn lists(&self) -> [&[f64]; 3] {
        let first = self.arrivals.first();
        let (depth_m, range_m) =
            first.map_or((&[][..], &[][..]), |a| (&a.depth_m[..], &a.range_m[..]));
        [&self.source_depth_m, depth_m, range_m]
    }

    fn numbers(&self, arrival: &Arrival) -> [f64; 8] {
        [
            arrival.amplitude,
            arrival.phase_rad.to_degrees(),
            arrival.delay_s,
            -arrival.absorption_nepers / (TAU * self.frequency_hz),
            arrival.launch_angle_deg,
            arrival.arrival_angle_deg,
            arrival.surface_bounces.into(),
            arrival.bottom_bounces.into(),
        ]
    }
}

fn most(arrivals: &Arrivals) -> usize {
    arrivals.at.iter().map(Vec::len).max().unwrap_or(0)
}

/// One record after the other, as text or binary.
trait RecordSource {
    fn dimensions(&mut self) -> Result<String, AcousticsError>;
    fn numbers<const N: usize>(
        &mut self,
        expected: &'static str,
    ) -> Result<[f64; N], AcousticsError>;
    fn count(&mut self, expected: &'static str) -> Result<usize, AcousticsError>;
    /// A count, and as many values in the same record.
    fn list(&mut self, expected: &'static str) -> Result<Vec<f64>, AcousticsError>;
    fn wrong(&self, expected: &'static str) -> AcousticsError;
}

fn read(
    source: &mut impl RecordSource,
    layout: ReceiverLayout,
) -> Result<ArrivalsFile, AcousticsError> {
    if source.dimensions()?.trim_matches([' ', '\'']) != "2D" {
        return Err(source.wrong("'2D'"));
    }
    let [frequency_hz] = source.numbers("a frequency in Hz")?;
    let source_depth_m = source.list("source depths in m")?;
    let depth_m = source.list("receiver depths in m")?;
    let range_m = source.list("receiver ranges in m")?;
    let receivers = match layout {
        ReceiverLayout::Grid => depth_m.len().saturating_mul(range_m.len()),
        ReceiverLayout::Pairs if depth_m.len() == range_m.len() => range_m.len(),
        ReceiverLayout::Pairs => return Err(source.wrong("as many depths as ranges")),
    };
    let mut arrivals = Vec::new();
    for _ in &source_depth_m {
        source.count("the greatest number of arrivals")?;
        let mut at = Vec::new();
        for _ in 0..receivers {
            let count = source.count("the number of arrivals at a receiver")?;
            let mut receiver = Vec::new();
            for _ in 0..count {
                let [amplitude, phase, delay, lag, launch, angle, top, bottom] =
                    source.numbers("the eight numbers of an arrival")?;
                receiver.push(Arrival {
                    amplitude,
                    phase_rad: phase.to_radians(),
                    delay_s: delay,
                    absorption_nepers: -lag * TAU * frequency_hz,
                    launch_angle_deg: launch,
                    arrival_angle_deg: angle,
                    surface_bounces: top as u32,
                    bottom_bounces: bottom as u32,
                });
            }
            at.push(receiver);
        }
        arrivals.push(Arrivals { range_m: range_m.clone(), depth_m: depth_m.clone(), at });
    }
    Ok(ArrivalsFile { frequency_hz, layout, source_depth_m, arrivals })
}

impl RecordSource for Records<'_> {
    fn dimensions(&mut self) -> Result<String, AcousticsError> {
        Ok(self.text("'2D'")?.0)
    }

    fn numbers<const N: usize>(
        &mut self,
        expected: &'static str,
    ) -> Result<[f64; N], AcousticsError> {
        self.all(expected)
    }

    fn count(&mut self, expected: &'static str) -> Result<usize, AcousticsError> {
        Records::count(self, expected)
    }

    fn list(&mut self, expected: &'static str) -> Result<Vec<f64>, AcousticsError> {
        self.counted(expected)
    }

    fn wrong(&self, expected: &'static str) -> AcousticsError {
        self.syntax(expected)
    }
}

/// Fortran's unformatted records: each between two words that hold its length.
struct Unformatted<'a> {
    path: &'a Path,
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Unformatted<'a> {
    fn record(&mut self, expected: &'static str) -> Result<&'a [u8], AcousticsError> {
        let word = |at: usize| {
            let bytes = self.bytes.get(at..at.checked_add(4)?)?;
            usize::try_from(i32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]])).ok()
        };
        let start = self.at + 4;
        let length = word(self.at).filter(|length| word(start + length) == Some(*length));
        let length = length.ok_or_else(|| self.wrong(expected))?;
        self.at = start + length + 4;
        Ok(&self.bytes[start..start + length])
    }

    fn words(&mut self, expected: &'static str) -> Result<&'a [[u8; 4]], AcousticsError> {
        let (words, rest) = self.record(expected)?.as_chunks();
        if rest.is_empty() { Ok(words) } else { Err(self.wrong(expected)) }
    }
}

impl RecordSource for Unformatted<'_> {
    fn dimensions(&mut self) -> Result<String, AcousticsError> {
        Ok(String::from_utf8_lossy(self.record("'2D'")?).into_owned())
    }

    fn numbers<const N: usize>(
        &mut self,
        expected: &'static str,
    ) -> Result<[f64; N], AcousticsError> {
        let numbers = self.words(expected)?.iter().map(|&word| f32::from_le_bytes(word).into());
        let numbers: Vec<f64> = numbers.collect();
        numbers.try_into().map_err(|_| self.wrong(expected))
    }

    fn count(&mut self, expected: &'static str) -> Result<usize, AcousticsError> {
        let &[word] = self.words(expected)? else { return Err(self.wrong(expected)) };
        usize::try_from(i32::from_le_bytes(word)).map_err(|_| self.wrong(expected))
    }

    fn list(&mut self, expected: &'static str) -> Result<Vec<f64>, AcousticsError> {
        let Some((&count, values)) = self.words(expected)?.split_first() else {
            return Err(self.wrong(expected));
        };
        if usize::try_from(i32::from_le_bytes(count)) != Ok(values.len()) {
            return Err(self.wrong(expected));
        }
        Ok(values.iter().map(|&word| f32::from_le_bytes(word).into()).collect())
    }

    fn wrong(&self, expected: &'static str) -> AcousticsError {
        AcousticsError::Binary { path: self.path.to_owned(), byte: self.at, expected }
    }
}
