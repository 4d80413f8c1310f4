use crate::error::AcousticsError;
use std::fmt::Display;
use std::path::{Path, PathBuf};

/// No list in a file is longer: what asks for more is taken for damaged.
const MOST_VALUES: usize = 1_000_000;

/// Takes values out of a text as Fortran's list-directed input does: separated by
/// blanks, tabs or commas, over as many lines as it takes, `3*0.5` for three times
/// 0.5, `d` or `e` before exponents; a slash ends a record early and leaves the rest
/// as it was. What follows the last value on its line is ignored, and so is what
/// follows an exclamation mark.
pub(crate) struct Records<'a> {
    path: PathBuf,
    lines: Vec<&'a str>,
    next: usize,
}

/// What a place in a record holds.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Item<'a> {
    /// A word, this many times.
    Word(usize, &'a str),
    /// Nothing, between two commas or after `r*`: the value stays as it was.
    Null(usize),
    /// A slash.
    End,
    /// What makes no sense.
    Nonsense,
}

impl<'a> Records<'a> {
    /// Reads a text as that of a file.
    pub(crate) fn new(path: &Path, text: &'a str) -> Self {
        Self { path: path.to_owned(), lines: text.lines().collect(), next: 0 }
    }

    /// The file and the number of the line just read.
    pub(crate) fn place(&self) -> (&Path, usize) {
        (&self.path, self.next)
    }

    /// A remark on the line just read.
    pub(crate) fn note(&self, what: &str) -> String {
        format!("{}, line {}: {what}", self.path.display(), self.next)
    }

    /// The error that the line just read does not hold `expected`.
    pub(crate) fn syntax(&self, expected: &'static str) -> AcousticsError {
        const MOST_SHOWN: usize = 120;
        let line = self.next.checked_sub(1).and_then(|index| self.lines.get(index));
        let found = line.map_or_else(
            || "the end of the file".to_owned(),
            |line| line.chars().take(MOST_SHOWN).collect(),
        );
        AcousticsError::Syntax { path: self.path.clone(), line: self.next, expected, found }
    }

    /// The error that the line just read asks for something not supported.
    pub(crate) fn unsupported(&self, feature: &'static str, found: impl Display) -> AcousticsError {
        AcousticsError::Unsupported {
            path: self.path.clone(),
            line: self.next,
            feature,
            found: found.to_string(),
        }
    }

    /// Says of a problem that the line just read leads to it.
    pub(crate) fn blame<T>(&self, result: Result<T, AcousticsError>) -> Result<T, AcousticsError> {
        result.map_err(|problem| AcousticsError::InFile {
            path: self.path.clone(),
            line: self.next,
            problem: Box::new(problem),
        })
    }

    /// The next line that holds anything, without its comment.
    fn line(&mut self, expected: &'static str) -> Result<&'a str, AcousticsError> {
        while let Some(line) = self.lines.get(self.next) {
            self.next += 1;
            let line = without_comment(line);
            if !line.trim().is_empty() {
                return Ok(line);
            }
        }
        self.next = self.lines.len() + 1;
        Err(self.syntax(expected))
    }

    /// A text, in quotes or a single word, and what follows it on its line.
    pub(crate) fn text(
        &mut self,
        expected: &'static str,
    ) -> Result<(String, &'a str), AcousticsError> {
        let line = self.line(expected)?.trim_start();
        let Some(quote) = line.chars().next().filter(|c| matches!(c, '\'' | '"')) else {
            let end = line.find(is_separator).unwrap_or(line.len());
            let (word, rest) = line.split_at(end);
            if word.is_empty() {
                return Err(self.syntax(expected));
            }
            return Ok((word.to_owned(), rest));
        };
        let mut text = String::new();
        let mut rest = &line[1..];
        while let Some((before, after)) = rest.split_once(quote) {
            text.push_str(before);
            // A quote is written twice inside of quotes.
            let Some(further) = after.strip_prefix(quote) else { return Ok((text, after)) };
            text.push(quote);
            rest = further;
        }
        Err(self.syntax(expected))
    }

    /// One record of values, which take the place of those in `values` until a
    /// slash; without one, lines are read until all are replaced. Gives how many
    /// places it reached.
    pub(crate) fn values(
        &mut self,
        expected: &'static str,
        values: &mut [f64],
    ) -> Result<usize, AcousticsError> {
        let mut count = 0;
        while count < values.len() {
            let mut rest = self.line(expected)?;
            while let Some(item) = next_item(&mut rest) {
                let left = values.len() - count;
                match item {
                    Item::Nonsense => return Err(self.syntax(expected)),
                    Item::End => return Ok(count),
                    Item::Null(times) => count += times.min(left),
                    Item::Word(times, word) => {
                        let value = fortran_number(word).ok_or_else(|| self.syntax(expected))?;
                        let times = times.min(left);
                        values[count..count + times].fill(value);
                        count += times;
                    }
                }
                if count == values.len() {
                    return Ok(count);
                }
            }
        }
        Ok(count)
    }

    /// One record of exactly as many values.
    pub(crate) fn all<const N: usize>(
        &mut self,
        expected: &'static str,
    ) -> Result<[f64; N], AcousticsError> {
        let mut values = [f64::NAN; N];
        self.values(expected, &mut values)?;
        if values.iter().any(|value| value.is_nan()) {
            Err(self.syntax(expected))
        } else {
            Ok(values)
        }
    }

    /// One count, at most a million.
    pub(crate) fn count(&mut self, expected: &'static str) -> Result<usize, AcousticsError> {
        let [value] = self.all(expected)?;
        self.checked_count(expected, value)
    }

    /// A value as a count, at most a million.
    pub(crate) fn checked_count(
        &self,
        expected: &'static str,
        value: f64,
    ) -> Result<usize, AcousticsError> {
        if value > MOST_VALUES as f64 {
            return Err(self.unsupported("more than a million values:", value));
        }
        if value >= 0.0 && value.fract() == 0.0 {
            Ok(value as usize)
        } else {
            Err(self.syntax(expected))
        }
    }

    /// A count, and as many values in the same record.
    pub(crate) fn counted(&mut self, expected: &'static str) -> Result<Vec<f64>, AcousticsError> {
        let start = self.next;
        let count = self.count(expected)?;
        self.next = start;
        let mut values = vec![f64::NAN; count + 1];
        self.values(expected, &mut values)?;
        values.remove(0);
        if values.iter().any(|value| value.is_nan()) {
            Err(self.syntax(expected))
        } else {
            Ok(values)
        }
    }

    /// Whether nothing is left but blank lines and comments.
    pub(crate) fn at_end(&self) -> bool {
        self.lines[self.next.min(self.lines.len())..]
            .iter()
            .all(|line| without_comment(line).trim().is_empty())
    }

    /// A count, which is not 0, and as many values; two values and a slash stand for
    /// equal steps between them.
    pub(crate) fn vector(
        &mut self,
        expected_count: &'static str,
        expected: &'static str,
    ) -> Result<Vec<f64>, AcousticsError> {
        let count = self.count(expected_count)?;
        if count == 0 {
            return Err(self.syntax(expected_count));
        }
        self.values_or_steps(count, expected)
    }

    /// As many values; two values and a slash stand for equal steps between them.
    pub(crate) fn values_or_steps(
        &mut self,
        count: usize,
        expected: &'static str,
    ) -> Result<Vec<f64>, AcousticsError> {
        let mut values = vec![f64::NAN; count];
        let found = self.values(expected, &mut values)?;
        if found == 2 && count > 2 && !(values[0].is_nan() || values[1].is_nan()) {
            let (first, last) = (values[0], values[1]);
            let step = (last - first) / (count - 1) as f64;
            for (index, value) in values.iter_mut().enumerate() {
                *value = first + index as f64 * step;
            }
            values[count - 1] = last;
        }
        if values.iter().any(|value| value.is_nan()) {
            return Err(self.syntax(expected));
        }
        Ok(values)
    }
}

fn is_separator(c: char) -> bool {
    c.is_whitespace() || matches!(c, ',' | '/')
}

/// A line up to an exclamation mark outside of quotes.
fn without_comment(line: &str) -> &str {
    let mut quote = None;
    for (at, c) in line.char_indices() {
        match (c, quote) {
            ('!', None) => return &line[..at],
            ('\'' | '"', None) => quote = Some(c),
            (c, Some(open)) if c == open => quote = None,
            _ => {}
        }
    }
    // An apostrophe in a comment opens no quotes.
    if quote.is_some() { line.split('!').next().unwrap_or_default() } else { line }
}

/// Takes the next item off a line; `None` at its end.
fn next_item<'a>(rest: &mut &'a str) -> Option<Item<'a>> {
    let text = rest.trim_start();
    if text.is_empty() {
        return None;
    }
    if text.starts_with('/') {
        *rest = "";
        return Some(Item::End);
    }
    let end = text.find(is_separator).unwrap_or(text.len());
    let (word, after) = text.split_at(end);
    // A comma belongs to the item before it; one with nothing before it is an item.
    let after_blanks = after.trim_start();
    *rest = after_blanks.strip_prefix(',').unwrap_or(after_blanks);
    if word.is_empty() {
        return Some(Item::Null(1));
    }
    let Some((times, word)) = word.split_once('*') else { return Some(Item::Word(1, word)) };
    // More than a list can hold is as good as endless.
    let digits = !times.is_empty() && times.bytes().all(|byte| byte.is_ascii_digit());
    let times = times.parse().unwrap_or(usize::MAX);
    Some(match word {
        _ if !digits || times == 0 => Item::Nonsense,
        "" => Item::Null(times),
        word => Item::Word(times, word),
    })
}

/// A number as Fortran writes it: exponents may be led by `d` or by a sign only.
fn fortran_number(word: &str) -> Option<f64> {
    if !word.bytes().all(|byte| byte.is_ascii_digit() || b"+-.eEdDqQ".contains(&byte)) {
        return None;
    }
    let word = word.replace(['d', 'D', 'q', 'Q', 'E'], "e");
    let value: f64 = word.parse().ok().or_else(|| {
        let sign = word.rfind(['+', '-']).filter(|&at| at > 0)?;
        let (mantissa, exponent) = word.split_at(sign);
        format!("{mantissa}e{exponent}").parse().ok()
    })?;
    value.is_finite().then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str, count: usize) -> Result<Vec<f64>, AcousticsError> {
        let mut values = vec![-1.0; count];
        Records::new(Path::new("x.env"), text).values("numbers", &mut values).map(|_| values)
    }

    #[test]
    fn numbers_come_in_all_of_fortrans_forms() {
        for (text, expected) in [
            ("1 2 3", vec![1.0, 2.0, 3.0]),
            ("1,2 , 3 ! three", vec![1.0, 2.0, 3.0]),
            ("1\t2\r\n\r\n3 4", vec![1.0, 2.0, 3.0]),
            ("! none here\n1.5D2, 2.e-1 .5+1", vec![150.0, 0.2, 5.0]),
            ("3*0.25", vec![0.25; 3]),
            ("1, 99999999999999999999*7.0", vec![1.0, 7.0, 7.0]),
            ("1,,3", vec![1.0, -1.0, 3.0]),
            ("1 2*", vec![1.0, -1.0, -1.0]),
            ("1 / 2 3", vec![1.0, -1.0, -1.0]),
            ("1 2/", vec![1.0, 2.0, -1.0]),
            ("/", vec![-1.0; 3]),
        ] {
            assert_eq!(read(text, 3).unwrap(), expected, "{text:?}");
        }
        for text in ["1 two 3", "1 nan 3", "inf 1 1", "1e999 1 1", "1", "0*1 1 1", "x*1", "1-", ""]
        {
            assert!(read(text, 3).is_err(), "{text:?}");
        }
    }

    #[test]
    fn texts_come_in_quotes_or_as_one_word() {
        for (line, expected) in [
            ("'CVW ' ! options", "CVW "),
            ("\"deep 'sound' channel!\"", "deep 'sound' channel!"),
            ("'Lloyd''s mirror'", "Lloyd's mirror"),
            ("  CVW, rest", "CVW"),
            ("! the reader's note\n'R'", "R"),
        ] {
            let mut records = Records::new(Path::new("x.env"), line);
            assert_eq!(records.text("a text").unwrap().0, expected);
        }
        let mut open = Records::new(Path::new("x.env"), "\n'open");
        assert!(matches!(open.text("a text"), Err(AcousticsError::Syntax { line: 2, .. })));
    }

    #[test]
    fn two_values_and_a_slash_are_steps() {
        let mut records = Records::new(Path::new("x.env"), "5\n0 10 /\n3\n1 /\n1000000000000\n");
        assert_eq!(records.vector("a count", "values").unwrap(), [0.0, 2.5, 5.0, 7.5, 10.0]);
        assert!(matches!(
            records.vector("a count", "values"),
            Err(AcousticsError::Syntax { line: 4, .. })
        ));
        assert!(matches!(
            records.vector("a count", "values"),
            Err(AcousticsError::Unsupported { line: 5, .. })
        ));
    }
}
