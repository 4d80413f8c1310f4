//! What training was like, update by update: `metrics.jsonl`, `timings.jsonl` and
//! TensorBoard's event files.

use super::FileError;
use super::tensorboard::EventFile;
use serde::ser::{SerializeMap, Serializer};
use serde::{Deserialize, Serialize};
use sonarfleet::record::{TrainingPoint, TrainingRun};
use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

/// File of the numbers that are the same in every run of the same seed.
pub const METRICS: &str = "metrics.jsonl";
/// File of wall-clock seconds, which are not.
pub const TIMINGS: &str = "timings.jsonl";

/// The log of one training, in one folder: a line per update in `metrics.jsonl`, its
/// wall-clock seconds in `timings.jsonl`, and both in an event file for TensorBoard.
///
/// ```
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let folder = tempfile::tempdir()?;
/// # let folder = folder.path();
/// use sonarfleet_learning::files::{TrainingLog, metrics};
///
/// let mut log = TrainingLog::open(folder, 0)?;
/// log.write(1, 4096, &[("reward", 31.5), ("entropy", 0.7)], &[("rollout", 0.8)])?;
/// let lines = metrics::read(&folder.join(metrics::METRICS))?;
/// assert_eq!(lines[0].scalars["reward"], 31.5);
/// # Ok(()) }
/// ```
#[derive(Debug)]
pub struct TrainingLog {
    metrics: LineFile,
    timings: LineFile,
    events: EventFile,
}

impl TrainingLog {
    /// Opens the log of a training of which so many updates are done: 0 for one that
    /// begins. Whatever a killed run has logged beyond them is dropped.
    ///
    /// # Errors
    /// Where a file cannot be read or written, or has a line that is not ours.
    pub fn open(folder: &Path, updates_done: u64) -> Result<Self, FileError> {
        std::fs::create_dir_all(folder).map_err(FileError::io(folder))?;
        let (metrics, last) = LineFile::open(folder.join(METRICS), updates_done)?;
        let (timings, _) = LineFile::open(folder.join(TIMINGS), updates_done)?;
        let now_s = wall_time_s();
        let mut time_s = now_s as u64;
        // A run that is resumed within the second takes the next one.
        while folder.join(EventFile::name(time_s, "training")).exists() {
            time_s += 1;
        }
        let mut events = EventFile::create(folder, time_s, "training")?;
        events.restart(now_s, last.map_or(0, |line| line.step + 1))?;
        Ok(Self { metrics, timings, events })
    }

    /// Appends one update: its number (the first is 1), the environment steps or
    /// episodes taken so far, its scalars and its wall-clock seconds, each in the
    /// order given. Scalars that are not finite become `null` in the lines; the
    /// seconds stand under `seconds/…` in TensorBoard.
    ///
    /// # Errors
    /// [`FileError::Io`] where a file cannot be written.
    ///
    /// # Panics
    /// Where a name is given twice, or is `update` or `step`.
    pub fn write(
        &mut self,
        update: u64,
        step: u64,
        scalars: &[(&str, f64)],
        seconds: &[(&str, f64)],
    ) -> Result<(), FileError> {
        self.timings.append(&Line { update, step, values: seconds })?;
        self.metrics.append(&Line { update, step, values: scalars })?;
        let tags: Vec<String> = seconds.iter().map(|(name, _)| format!("seconds/{name}")).collect();
        let timings = tags.iter().zip(seconds).map(|(tag, &(_, value))| (tag.as_str(), value));
        let all = scalars.iter().copied().chain(timings);
        self.events.scalars(wall_time_s(), step, all.map(|(tag, value)| (tag, value as f32)))
    }
}

/// One line of a log, as it is read.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct LoggedUpdate {
    /// Number of the update, from 1.
    pub update: u64,
    /// Environment steps or episodes so far.
    pub step: u64,
    /// The numbers by name; NaN where the line says `null`.
    #[serde(flatten, deserialize_with = "null_is_nan")]
    pub scalars: BTreeMap<String, f64>,
}

/// Reads a `metrics.jsonl` or `timings.jsonl`. A last line that a killed run left
/// unfinished does not count.
///
/// # Errors
/// Where the file cannot be read, or has a line that is not ours.
pub fn read(path: &Path) -> Result<Vec<LoggedUpdate>, FileError> {
    let text = std::fs::read_to_string(path).map_err(FileError::io(path))?;
    whole_lines(&text).enumerate().map(|(index, line)| parse(path, index, line)).collect()
}

/// The log in a folder as a figure draws it. Of the scalars it takes `episodes` (else
/// the step), `reward`, `detection_utility`, `algebraic_connectivity`, `multiplier`,
/// `approx_kl` and `entropy`; one that was not logged is NaN.
///
/// # Errors
/// As [`read()`].
pub fn training_run(folder: &Path, seed: u64) -> Result<TrainingRun, FileError> {
    let timings = read(&folder.join(TIMINGS))?;
    let mut seconds: BTreeMap<u64, f64> = BTreeMap::new();
    let mut total = 0.0;
    for line in &timings {
        total += line.scalars.values().sum::<f64>();
        seconds.insert(line.update, total);
    }
    let point = |line: &LoggedUpdate| {
        let scalar = |name: &str| line.scalars.get(name).copied();
        let or_nan = |name: &str| scalar(name).unwrap_or(f64::NAN);
        TrainingPoint {
            episodes: scalar("episodes").unwrap_or(line.step as f64),
            seconds: seconds.get(&line.update).copied().unwrap_or(f64::NAN),
            reward: or_nan("reward"),
            detection_utility: or_nan("detection_utility"),
            algebraic_connectivity: or_nan("algebraic_connectivity"),
            multiplier: or_nan("multiplier"),
            approx_kl: or_nan("approx_kl"),
            entropy: or_nan("entropy"),
        }
    };
    let points = read(&folder.join(METRICS))?.iter().map(point).collect();
    Ok(TrainingRun { seed, points })
}

fn whole_lines(text: &str) -> impl Iterator<Item = &str> {
    text.split_inclusive('\n').filter(|line| line.ends_with('\n'))
}

fn parse(path: &Path, index: usize, line: &str) -> Result<LoggedUpdate, FileError> {
    serde_json::from_str(line).map_err(|error| FileError::BadLine {
        path: path.to_owned(),
        line: index + 1,
        reason: error.to_string(),
    })
}

fn null_is_nan<'de, D: serde::Deserializer<'de>>(
    deserializer: D,
) -> Result<BTreeMap<String, f64>, D::Error> {
    let values = BTreeMap::<String, Option<f64>>::deserialize(deserializer)?;
    Ok(values.into_iter().map(|(name, value)| (name, value.unwrap_or(f64::NAN))).collect())
}

/// A file that grows by whole lines.
#[derive(Debug)]
struct LineFile {
    path: PathBuf,
    file: File,
}

impl LineFile {
    /// Drops what lies beyond an update, and gives the last line that stays.
    fn open(path: PathBuf, updates_done: u64) -> Result<(Self, Option<LoggedUpdate>), FileError> {
        let text = match std::fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == ErrorKind::NotFound => String::new(),
            Err(source) => return Err(FileError::Io { path, source }),
        };
        let (mut kept, mut last) = (String::new(), None);
        for (index, line) in whole_lines(&text).enumerate() {
            let logged = parse(&path, index, line)?;
            if logged.update <= updates_done {
                kept.push_str(line);
                last = Some(logged);
            }
        }
        super::write_whole(&path, kept.as_bytes())?;
        let file = OpenOptions::new().append(true).open(&path).map_err(FileError::io(&path))?;
        Ok((Self { path, file }, last))
    }

    /// One write per line, so that a killed run leaves at most one of them unfinished.
    fn append(&mut self, line: &Line) -> Result<(), FileError> {
        let mut text = serde_json::to_string(line).expect("numbers by name are JSON");
        text.push('\n');
        self.file.write_all(text.as_bytes()).map_err(FileError::io(&self.path))
    }
}

/// One line of a log, as it is written.
struct Line<'a> {
    update: u64,
    step: u64,
    values: &'a [(&'a str, f64)],
}

impl Serialize for Line<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(2 + self.values.len()))?;
        map.serialize_entry("update", &self.update)?;
        map.serialize_entry("step", &self.step)?;
        for (index, (name, value)) in self.values.iter().enumerate() {
            let taken = self.values[..index].iter().any(|(other, _)| other == name);
            assert!(!taken && !["update", "step"].contains(name), "`{name}` stands there already");
            map.serialize_entry(name, value)?;
        }
        map.end()
    }
}

fn wall_time_s() -> f64 {
    // A clock before 1970 gives 0: wall times are only labels.
    SystemTime::now().duration_since(UNIX_EPOCH).map_or(0.0, |time| time.as_secs_f64())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn train(log: &mut TrainingLog, updates: std::ops::RangeInclusive<u64>) {
        for update in updates {
            let reward = (update as f64).sqrt();
            let scalars = [("reward", reward), ("explained_variance", f64::NAN)];
            log.write(update, update * 4096, &scalars, &[("rollout", 0.5)]).unwrap();
        }
    }

    #[test]
    fn a_line_says_what_was_given_in_that_order() {
        let folder = tempfile::tempdir().unwrap();
        let mut log = TrainingLog::open(folder.path(), 0).unwrap();
        log.write(1, 4096, &[("reward", 0.1), ("entropy", f64::NAN)], &[("rollout", 2.0)]).unwrap();
        let text = |name| fs::read_to_string(folder.path().join(name)).unwrap();
        assert_eq!(text(METRICS), "{\"update\":1,\"step\":4096,\"reward\":0.1,\"entropy\":null}\n");
        assert_eq!(text(TIMINGS), "{\"update\":1,\"step\":4096,\"rollout\":2.0}\n");
        let read = read(&folder.path().join(METRICS)).unwrap();
        assert!(read[0].scalars["entropy"].is_nan());
    }

    /// A run that is killed after its checkpoint of update 4, in the middle of a line,
    /// and resumed ends with the same metrics as one that was never killed.
    #[test]
    fn a_resumed_log_is_that_of_a_run_never_killed() {
        let (whole, killed) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        train(&mut TrainingLog::open(whole.path(), 0).unwrap(), 1..=8);
        train(&mut TrainingLog::open(killed.path(), 0).unwrap(), 1..=6);
        let unfinished = killed.path().join(METRICS);
        let mut file = OpenOptions::new().append(true).open(&unfinished).unwrap();
        file.write_all(b"{\"update\":7,\"st").unwrap();
        train(&mut TrainingLog::open(killed.path(), 4).unwrap(), 5..=8);
        for name in [METRICS, TIMINGS] {
            let text = |folder: &Path| fs::read_to_string(folder.join(name)).unwrap();
            assert_eq!(text(whole.path()), text(killed.path()));
        }
        let event_files = fs::read_dir(killed.path()).unwrap().count() - 2;
        assert_eq!(event_files, 2, "the resumed run has an event file of its own");
    }

    #[test]
    fn a_log_is_a_curve() {
        let folder = tempfile::tempdir().unwrap();
        let mut log = TrainingLog::open(folder.path(), 0).unwrap();
        let seconds = [("rollout", 0.5), ("learning", 1.5)];
        log.write(1, 4096, &[("reward", 1.0), ("episodes", 102.0)], &seconds).unwrap();
        log.write(2, 8192, &[("reward", 2.0), ("entropy", 0.5)], &seconds).unwrap();
        let TrainingRun { seed, points } = training_run(folder.path(), 9).unwrap();
        assert_eq!(seed, 9);
        let found: Vec<_> = points.iter().map(|p| [p.episodes, p.seconds, p.reward]).collect();
        assert_eq!(found, [[102.0, 2.0, 1.0], [8192.0, 4.0, 2.0]]);
        assert!(points[0].entropy.is_nan() && points[1].multiplier.is_nan());
    }

    #[test]
    fn a_strange_line_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(METRICS);
        fs::write(&path, "{\"update\":1,\"step\":2}\n{\"update\":true}\n").unwrap();
        let error = TrainingLog::open(folder.path(), 1).unwrap_err();
        assert!(error.to_string().starts_with(&format!("{}:2: ", path.display())), "{error}");
    }

    #[test]
    #[should_panic(expected = "`reward` stands there already")]
    fn a_name_stands_once() {
        let folder = tempfile::tempdir().unwrap();
        let mut log = TrainingLog::open(folder.path(), 0).unwrap();
        let _ = log.write(1, 1, &[("reward", 1.0), ("reward", 2.0)], &[]);
    }
}
