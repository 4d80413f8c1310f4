use crate::complex::Complex;
use crate::error::AcousticsError;
use crate::field::{Field, ReceiverLayout};
use std::path::Path;

/// Bytes of a word, in which records are measured.
const WORD: usize = 4;

/// The least length of a record: the title's.
const LEAST_WORDS: usize = 41;

/// Records before the pressures.
const HEADER_RECORDS: usize = 10;

/// A `.shd` file: sound fields on receivers, in records of equal length. Numbers are
/// little-endian and, but for the frequency and places of no use here, of single
/// precision.
///
/// | record | what |
/// |---|---|
/// | 0 | words in a record, title (80 characters) |
/// | 1 | `rectilin` or `irregular` |
/// | 2 | numbers of frequencies, bearings, sources along x, y and z, receiver depths and ranges; the frequency |
/// | 3–6 | frequencies, bearings, sources along x and y (double precision) |
/// | 7–9 | source depths, receiver depths, receiver ranges, m |
/// | 10… | pressures over the ranges, a record for each [source, receiver depth] |
#[derive(Debug, Clone, PartialEq)]
pub struct ShadeFile {
    /// The title, with the program that wrote it.
    pub title: String,
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// How ranges and depths make up receivers.
    pub layout: ReceiverLayout,
    /// Depths of the sources, metres.
    pub source_depth_m: Vec<f64>,
    /// The field of each source.
    pub fields: Vec<Field>,
}

impl ShadeFile {
    /// The contents of the file.
    pub fn to_bytes(&self) -> Vec<u8> {
        let (depth_m, range_m) = self
            .fields
            .first()
            .map_or((&[][..], &[][..]), |field| (&field.depth_m[..], &field.range_m[..]));
        let sources = self.source_depth_m.len();
        let words = LEAST_WORDS.max(sources).max(depth_m.len()).max(2 * range_m.len());
        let mut records = Fixed { bytes: Vec::new(), length: words * WORD };

        let mut title = self.title.clone().into_bytes();
        title.resize(80, b' ');
        records.push((words as u32).to_le_bytes().into_iter().chain(title));
        records.push(plot_type(self.layout).bytes());
        let counts = [1, 1, 1, 1, sources, depth_m.len(), range_m.len()];
        let counts = counts.into_iter().flat_map(|count| (count as u32).to_le_bytes());
        records.push(counts.chain((self.frequency_hz as f32).to_le_bytes()));
        for double in [self.frequency_hz, 0.0, 0.0, 0.0] {
            records.push(double.to_le_bytes());
        }
        for list in [&self.source_depth_m[..], depth_m, range_m] {
            records.push(list.iter().flat_map(|&value| (value as f32).to_le_bytes()));
        }
        for field in &self.fields {
            for row in field.pressure.chunks(range_m.len().max(1)) {
                let parts = row.iter().flat_map(|p| [p.re as f32, p.im as f32]);
                records.push(parts.flat_map(f32::to_le_bytes));
            }
        }
        records.bytes
    }

    /// Understands the contents of a file; `path` is for errors.
    ///
    /// Receiver ranges may also be of double precision, as the Acoustics Toolbox writes
    /// them since 2020.
    ///
    /// # Errors
    /// If the bytes are not those of such a file, or it holds more than one frequency or
    /// bearing, or sources at several places.
    pub fn from_bytes(path: &Path, bytes: &[u8]) -> Result<Self, AcousticsError> {
        let reader = Reader { path, bytes };
        let words = reader.count(0, "the length of a record in words")?;
        let length = words.saturating_mul(WORD);
        if words < LEAST_WORDS - 1 {
            return Err(reader.error(0, "the length of a record in words"));
        }
        let title = reader.text(WORD, 80)?;
        let layout = match reader.text(length, 10)?.as_str() {
            "irregular" => ReceiverLayout::Pairs,
            "rectilin" | "" => ReceiverLayout::Grid,
            _ => return Err(reader.error(length, "a rectilinear or an irregular grid")),
        };
        let counts = (0..7)
            .map(|index| reader.count(2 * length + index * WORD, "a count"))
            .collect::<Result<Vec<_>, _>>()?;
        let &[frequencies, bearings, along_x, along_y, sources, depths, ranges] = &counts[..]
        else {
            return Err(reader.error(2 * length, "seven counts"));
        };
        if [frequencies, bearings, along_x, along_y] != [1; 4] {
            return Err(
                reader.error(2 * length, "one frequency, one bearing, sources at one place")
            );
        }
        let rows = match layout {
            ReceiverLayout::Grid => depths,
            ReceiverLayout::Pairs => 1,
        };
        let longest = sources.max(depths).max(2 * ranges);
        let whole = sources
            .checked_mul(rows)
            .and_then(|rows| rows.checked_add(HEADER_RECORDS)?.checked_mul(length));
        if longest > words || whole.is_none_or(|whole| whole > bytes.len() + length) {
            return Err(reader.error(2 * length, "counts that fit the file"));
        }
        let pairs_match = layout == ReceiverLayout::Grid || depths == ranges;
        if sources * depths * ranges == 0 || !pairs_match {
            return Err(reader.error(2 * length, "sources and receivers"));
        }

        let [frequency_hz] = reader.doubles(3 * length, 1)?[..] else {
            return Err(reader.error(3 * length, "a frequency"));
        };
        let source_depth_m = reader.singles(7 * length, sources)?;
        let depth_m = reader.singles(8 * length, depths)?;
        let range_m = reader.ranges(9 * length, ranges, layout)?;
        let fields = (0..sources)
            .map(|source| {
                let mut pressure = Vec::with_capacity(rows * ranges);
                for row in source * rows..(source + 1) * rows {
                    let parts = reader.singles((HEADER_RECORDS + row) * length, 2 * ranges)?;
                    pressure.extend(parts.chunks_exact(2).map(|p| Complex::new(p[0], p[1])));
                }
                Ok(Field { range_m: range_m.clone(), depth_m: depth_m.clone(), pressure })
            })
            .collect::<Result<_, _>>()?;
        Ok(Self { title, frequency_hz, layout, source_depth_m, fields })
    }
}

fn plot_type(layout: ReceiverLayout) -> &'static str {
    match layout {
        ReceiverLayout::Grid => "rectilin  ",
        ReceiverLayout::Pairs => "irregular ",
    }
}

/// Records of equal length.
struct Fixed {
    bytes: Vec<u8>,
    length: usize,
}

impl Fixed {
    fn push(&mut self, contents: impl IntoIterator<Item = u8>) {
        let end = self.bytes.len() + self.length;
        self.bytes.extend(contents);
        self.bytes.resize(end, 0);
    }
}

struct Reader<'a> {
    path: &'a Path,
    bytes: &'a [u8],
}

impl Reader<'_> {
    fn error(&self, byte: usize, expected: &'static str) -> AcousticsError {
        AcousticsError::Binary { path: self.path.to_owned(), byte, expected }
    }

    fn take(&self, byte: usize, length: usize) -> Result<&[u8], AcousticsError> {
        let end = byte.checked_add(length);
        end.and_then(|end| self.bytes.get(byte..end))
            .ok_or_else(|| self.error(self.bytes.len(), "more of the file, which is cut short"))
    }

    fn count(&self, byte: usize, expected: &'static str) -> Result<usize, AcousticsError> {
        let word = self.take(byte, WORD)?;
        let count = i32::from_le_bytes([word[0], word[1], word[2], word[3]]);
        usize::try_from(count).map_err(|_| self.error(byte, expected))
    }

    fn text(&self, byte: usize, length: usize) -> Result<String, AcousticsError> {
        let text = String::from_utf8_lossy(self.take(byte, length)?).into_owned();
        Ok(text.trim_matches([' ', '\0']).to_owned())
    }

    fn singles(&self, byte: usize, count: usize) -> Result<Vec<f64>, AcousticsError> {
        let words = self.take(byte, count * WORD)?.chunks_exact(WORD);
        Ok(words.map(|w| f32::from_le_bytes([w[0], w[1], w[2], w[3]]).into()).collect())
    }

    fn doubles(&self, byte: usize, count: usize) -> Result<Vec<f64>, AcousticsError> {
        let bytes = self.take(byte, count * 2 * WORD)?;
        let (doubles, _) = bytes.as_chunks::<{ 2 * WORD }>();
        Ok(doubles.iter().map(|double| f64::from_le_bytes(*double)).collect())
    }

    /// Ranges of single or double precision: those that make sense.
    fn ranges(
        &self,
        byte: usize,
        count: usize,
        layout: ReceiverLayout,
    ) -> Result<Vec<f64>, AcousticsError> {
        let sensible = |ranges: &[f64]| {
            let ascend = layout == ReceiverLayout::Pairs || ranges.is_sorted();
            ascend && ranges.iter().all(|r| *r == 0.0 || (1e-6..1e9).contains(&r.abs()))
        };
        let doubles = self.doubles(byte, count)?;
        let singles = self.singles(byte, count)?;
        // What single precision leaves of the record is zero.
        let rest = self.take(byte + count * WORD, count * WORD)?;
        if sensible(&singles) && rest.iter().all(|&byte| byte == 0) {
            return Ok(singles);
        }
        match (sensible(&doubles), sensible(&singles)) {
            (true, _) => Ok(doubles),
            (false, true) => Ok(singles),
            (false, false) => Err(self.error(byte, "ranges of receivers")),
        }
    }
}
