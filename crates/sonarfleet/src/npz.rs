//! Named arrays in numpy's `.npz` files: thin reading and writing, with errors
//! that name the file and the key.

use npyz::{NpyFile, Order, WriterBuilder};
use std::fs;
use std::io::{self, Cursor, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use zip::result::ZipError;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipArchive, ZipWriter};

/// What can be wrong with an `.npz` file.
#[derive(Debug, thiserror::Error)]
pub enum NpzError {
    /// The file cannot be opened, read or written.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the operating system says.
        source: io::Error,
    },
    /// The file is not a zip archive, or a damaged one.
    #[error("{} is not an .npz file (a zip archive of .npy arrays): {source}", path.display())]
    NotAnArchive {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        source: ZipError,
    },
    /// The archive holds no array of this name.
    #[error("{}: no array `{key}`; it holds {}", path.display(), held.join(", "))]
    MissingKey {
        /// The file.
        path: PathBuf,
        /// The array asked for.
        key: String,
        /// The arrays that are there.
        held: Vec<String>,
    },
    /// The array's bytes cannot be read.
    #[error("{}: array `{key}` is damaged: {source}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The array.
        key: String,
        /// What is wrong with it.
        source: io::Error,
    },
    /// The array holds values of another type.
    #[error("{}: array `{key}` holds {found}, expected {expected}", path.display())]
    WrongType {
        /// The file.
        path: PathBuf,
        /// The array.
        key: String,
        /// Its numpy type, such as `'<c16'`.
        found: String,
        /// The types that can be read.
        expected: &'static str,
    },
    /// The array has another shape.
    #[error("{}: array `{key}` has shape {found:?}, expected {expected}", path.display())]
    WrongShape {
        /// The file.
        path: PathBuf,
        /// The array.
        key: String,
        /// Its shape.
        found: Vec<usize>,
        /// The shape asked for, in words.
        expected: String,
    },
}

/// An array of numbers as it was stored.
#[derive(Debug, Clone, PartialEq)]
pub struct Array {
    /// Length of each dimension, slowest first.
    pub shape: Vec<usize>,
    /// The values, last dimension fastest (C order), whatever order the file has.
    pub values: Vec<f64>,
}

/// An `.npz` file that has been read into memory.
///
/// ```no_run
/// # fn main() -> Result<(), sonarfleet::npz::NpzError> {
/// let archive = sonarfleet::npz::Archive::open("instance.npz")?;
/// let prior = archive.f64s_of_shape("prior", &[30, 30])?;
/// # Ok(()) }
/// ```
#[derive(Debug, Clone)]
pub struct Archive {
    path: PathBuf,
    zip: ZipArchive<Cursor<Arc<[u8]>>>,
}

impl Archive {
    /// Reads a file.
    ///
    /// # Errors
    /// [`NpzError::Io`] where it cannot be read, [`NpzError::NotAnArchive`]
    /// where it is no (whole) zip archive.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, NpzError> {
        let path = path.as_ref().to_path_buf();
        let bytes = match fs::read(&path) {
            Ok(bytes) => bytes,
            Err(source) => return Err(NpzError::Io { path, source }),
        };
        match ZipArchive::new(Cursor::new(Arc::from(bytes))) {
            Ok(zip) => Ok(Self { path, zip }),
            Err(source) => Err(NpzError::NotAnArchive { path, source }),
        }
    }

    /// The file that was read.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Names of the arrays, in alphabetical order.
    pub fn keys(&self) -> Vec<String> {
        let mut keys: Vec<String> = self
            .zip
            .file_names()
            .filter_map(|name| npyz::npz::array_name_from_file_name(&name.ok()?).map(str::to_owned))
            .collect();
        keys.sort_unstable();
        keys
    }

    /// Whether there is an array of this name.
    pub fn contains(&self, key: &str) -> bool {
        self.zip.index_for_name(&npyz::npz::file_name_from_array_name(key)).is_some()
    }

    /// An array of numbers (`f4`, `f8`, `i4`, `i8`, `u1` or boolean), as f64.
    ///
    /// # Errors
    /// Where it is missing, damaged or of another type.
    pub fn f64s(&self, key: &str) -> Result<Array, NpzError> {
        const EXPECTED: &str = "numbers (f4, f8, i4, i8, u1 or bool)";
        let bytes = self.entry(key)?;
        let npy = self.npy(key, &bytes)?;
        let shape = self.shape(key, &npy)?;
        let order = npy.header().order();
        let values = match npy.dtype().descr().trim_matches('\'') {
            "<f4" | ">f4" => self.values::<f32, _>(key, npy, f64::from),
            "<f8" | ">f8" => self.values::<f64, _>(key, npy, f64::from),
            "<i4" | ">i4" => self.values::<i32, _>(key, npy, f64::from),
            "<i8" | ">i8" => self.values::<i64, _>(key, npy, |value| value as f64),
            "|u1" => self.values::<u8, _>(key, npy, f64::from),
            "|b1" => self.values::<bool, _>(key, npy, f64::from),
            found => return Err(self.wrong_type(key, found, EXPECTED)),
        }?;
        let values = match order {
            Order::C => values,
            Order::Fortran => fortran_to_c(&shape, &values),
        };
        Ok(Array { shape, values })
    }

    /// As [`Archive::f64s`], for an array that must have this shape.
    ///
    /// # Errors
    /// Also where the shape is another.
    pub fn f64s_of_shape(&self, key: &str, shape: &[usize]) -> Result<Array, NpzError> {
        let array = self.f64s(key)?;
        if array.shape == shape {
            Ok(array)
        } else {
            Err(self.wrong_shape(key, array.shape, format!("{shape:?}")))
        }
    }

    /// The bytes of an array of `u1` (text, such as JSON, is stored so).
    ///
    /// # Errors
    /// Where it is missing, damaged or of another type.
    pub fn bytes(&self, key: &str) -> Result<Vec<u8>, NpzError> {
        let bytes = self.entry(key)?;
        let npy = self.npy(key, &bytes)?;
        self.shape(key, &npy)?;
        match npy.dtype().descr().trim_matches('\'') {
            "|u1" => self.values::<u8, _>(key, npy, |value| value),
            found => Err(self.wrong_type(key, found, "bytes (u1)")),
        }
    }

    /// The error for an array whose shape is not what the reader expects, said
    /// in words such as `[2, points]`.
    pub fn wrong_shape(&self, key: &str, found: Vec<usize>, expected: String) -> NpzError {
        NpzError::WrongShape { path: self.path.clone(), key: key.to_owned(), found, expected }
    }

    fn wrong_type(&self, key: &str, found: &str, expected: &'static str) -> NpzError {
        NpzError::WrongType {
            path: self.path.clone(),
            key: key.to_owned(),
            found: found.to_owned(),
            expected,
        }
    }

    fn damaged(&self, key: &str, source: io::Error) -> NpzError {
        NpzError::Damaged { path: self.path.clone(), key: key.to_owned(), source }
    }

    /// The inflated bytes of one array's `.npy` file.
    fn entry(&self, key: &str) -> Result<Vec<u8>, NpzError> {
        if !self.contains(key) {
            let (path, key, held) = (self.path.clone(), key.to_owned(), self.keys());
            return Err(NpzError::MissingKey { path, key, held });
        }
        // A clone shares the bytes; reading needs a cursor of its own.
        let mut zip = self.zip.clone();
        let mut bytes = Vec::new();
        zip.by_name(&npyz::npz::file_name_from_array_name(key))
            .map_err(io::Error::other)
            .and_then(|mut file| io::copy(&mut file, &mut bytes))
            .map_err(|source| self.damaged(key, source))?;
        Ok(bytes)
    }

    fn npy<'a>(&self, key: &str, bytes: &'a [u8]) -> Result<NpyFile<&'a [u8]>, NpzError> {
        NpyFile::new(bytes).map_err(|source| self.damaged(key, source))
    }

    fn shape(&self, key: &str, npy: &NpyFile<&[u8]>) -> Result<Vec<usize>, NpzError> {
        let shape: Option<Vec<usize>> =
            npy.shape().iter().map(|&length| length.try_into().ok()).collect();
        shape
            .filter(|shape| shape.iter().try_fold(1_usize, |n, &m| n.checked_mul(m)).is_some())
            .ok_or_else(|| self.damaged(key, io::Error::other("its shape overflows")))
    }

    fn values<T: npyz::Deserialize, U>(
        &self,
        key: &str,
        npy: NpyFile<&[u8]>,
        convert: impl Fn(T) -> U,
    ) -> Result<Vec<U>, NpzError> {
        npy.data::<T>()
            .map_err(io::Error::other)
            .and_then(|reader| reader.map(|value| value.map(&convert)).collect())
            .map_err(|source| self.damaged(key, source))
    }
}

/// The values of an array to be written.
#[derive(Debug, Clone, Copy)]
pub enum Values<'a> {
    /// Stored as `<f8`.
    F64(&'a [f64]),
    /// Stored as `<f4`.
    F32(&'a [f32]),
    /// Stored as `<i8`.
    I64(&'a [i64]),
    /// Stored as `|u1`.
    Bytes(&'a [u8]),
}

/// An array to be written: name, shape (slowest dimension first) and values.
#[derive(Debug, Clone, Copy)]
pub struct NamedArray<'a> {
    /// The key under which it will be read.
    pub key: &'a str,
    /// Length of each dimension, slowest first.
    pub shape: &'a [usize],
    /// The values, last dimension fastest.
    pub values: Values<'a>,
}

/// Writes a compressed `.npz` file: whole or not at all (through a temporary
/// neighbour that is renamed), and the same bytes for the same arrays.
///
/// # Errors
/// [`NpzError::Io`] where it cannot be written.
///
/// # Panics
/// Where a shape is not that of its values.
pub fn write(path: impl AsRef<Path>, arrays: &[NamedArray]) -> Result<(), NpzError> {
    let path = path.as_ref();
    archive_of(arrays)
        .and_then(|bytes| crate::replace_file(path, &bytes))
        .map_err(|source| NpzError::Io { path: path.to_path_buf(), source })
}

fn archive_of(arrays: &[NamedArray]) -> io::Result<Vec<u8>> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    // A fixed date: the same arrays give the same bytes.
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .last_modified_time(DateTime::default())
        .large_file(arrays.iter().any(|array| array.shape.iter().product::<usize>() > 1 << 28));
    for array in arrays {
        zip.start_file(npyz::npz::file_name_from_array_name(array.key), options)?;
        match array.values {
            Values::F64(values) => write_npy(&mut zip, array.shape, values),
            Values::F32(values) => write_npy(&mut zip, array.shape, values),
            Values::I64(values) => write_npy(&mut zip, array.shape, values),
            Values::Bytes(values) => write_npy(&mut zip, array.shape, values),
        }?;
    }
    Ok(zip.finish()?.into_inner())
}

fn write_npy<T: npyz::AutoSerialize + Copy>(
    writer: &mut impl Write,
    shape: &[usize],
    values: &[T],
) -> io::Result<()> {
    assert_eq!(shape.iter().product::<usize>(), values.len(), "a shape must be its values'");
    let shape: Vec<u64> = shape.iter().map(|&length| length as u64).collect();
    let mut npy =
        npyz::WriteOptions::new().default_dtype().shape(&shape).writer(writer).begin_nd()?;
    npy.extend(values.iter().copied())?;
    npy.finish()
}

/// Values in C order from values in Fortran order (first dimension fastest).
fn fortran_to_c(shape: &[usize], values: &[f64]) -> Vec<f64> {
    let mut index = vec![0; shape.len()];
    (0..values.len())
        .map(|_| {
            let place = shape.iter().zip(&index).rev().fold(0, |place, (n, i)| place * n + i);
            for (i, n) in index.iter_mut().zip(shape).rev() {
                *i += 1;
                if *i < *n {
                    break;
                }
                *i = 0;
            }
            values[place]
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn example(path: &Path) {
        let matrix = [1.0, 2.0, 3.0, 4.0, 5.0, f64::INFINITY];
        write(
            path,
            &[
                NamedArray { key: "m", shape: &[2, 3], values: Values::F64(&matrix) },
                NamedArray { key: "f", shape: &[2], values: Values::F32(&[0.5, f32::NAN]) },
                NamedArray { key: "i", shape: &[], values: Values::I64(&[-7]) },
                NamedArray { key: "t", shape: &[2], values: Values::Bytes(b"{}") },
            ],
        )
        .unwrap();
    }

    #[test]
    fn what_is_written_is_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.npz");
        example(&path);
        let archive = Archive::open(&path).unwrap();
        assert_eq!(archive.keys(), ["f", "i", "m", "t"]);
        let m = archive.f64s_of_shape("m", &[2, 3]).unwrap();
        assert_eq!(m.values, [1.0, 2.0, 3.0, 4.0, 5.0, f64::INFINITY]);
        let f = archive.f64s("f").unwrap();
        assert!((f.values[0] - 0.5).abs() < f64::EPSILON && f.values[1].is_nan());
        assert_eq!(archive.f64s("i").unwrap(), Array { shape: vec![], values: vec![-7.0] });
        assert_eq!(archive.bytes("t").unwrap(), b"{}");
        assert!(archive.contains("m") && !archive.contains("q"));
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "no temporary file stays");
    }

    #[test]
    fn the_same_arrays_give_the_same_bytes() {
        let folder = tempfile::tempdir().unwrap();
        let paths = [folder.path().join("a.npz"), folder.path().join("b.npz")];
        example(&paths[0]);
        example(&paths[1]);
        assert_eq!(fs::read(&paths[0]).unwrap(), fs::read(&paths[1]).unwrap());
    }

    #[test]
    fn errors_name_file_and_key() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.npz");
        let message = |error: NpzError| error.to_string().replace(path.to_str().unwrap(), "PATH");
        assert!(message(Archive::open(&path).unwrap_err()).starts_with("PATH: No such file"));
        fs::write(&path, "not a zip").unwrap();
        assert!(message(Archive::open(&path).unwrap_err()).starts_with("PATH is not an .npz"));
        example(&path);
        let archive = Archive::open(&path).unwrap();
        assert_eq!(
            message(archive.f64s("q").unwrap_err()),
            "PATH: no array `q`; it holds f, i, m, t"
        );
        assert_eq!(
            message(archive.f64s_of_shape("m", &[3, 3]).unwrap_err()),
            "PATH: array `m` has shape [2, 3], expected [3, 3]"
        );
        assert_eq!(
            message(archive.bytes("m").unwrap_err()),
            "PATH: array `m` holds <f8, expected bytes (u1)"
        );
        let whole = fs::read(&path).unwrap();
        fs::write(&path, &whole[..whole.len() / 2]).unwrap();
        assert!(message(Archive::open(&path).unwrap_err()).starts_with("PATH is not an .npz"));
        let missing = folder.path().join("nowhere").join("a.npz");
        assert!(matches!(write(missing, &[]), Err(NpzError::Io { .. })));
    }

    #[test]
    fn fortran_order_is_turned() {
        // The 2 × 3 matrix [[0, 1, 2], [3, 4, 5]], stored column by column.
        let turned = fortran_to_c(&[2, 3], &[0.0, 3.0, 1.0, 4.0, 2.0, 5.0]);
        assert_eq!(turned, [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
    }
}
