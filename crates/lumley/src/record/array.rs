use super::{Damage, DamagedBlock, RecordError};
use crate::format::atomic;
use serde_json::{Value, json};
use std::fs::{self, File};
use std::io::{self, Read};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// An array of a record: Zarr v3, float64, little-endian, not compressed, CRC-32C behind each chunk.
#[derive(Debug, Clone)]
pub(super) struct Array {
    /// The record.
    pub root: PathBuf,
    /// Path in the record, for example `frames/fixed/values`.
    pub name: String,
    /// What the axes count.
    pub axes: [&'static str; 2],
    /// Length of the second axis; `None` for a vector.
    pub columns: Option<usize>,
    /// Shape of a chunk; the second is 1 for a vector.
    pub chunk: [usize; 2],
    /// Attributes for whoever reads the array without lumley.
    pub attributes: Value,
}

impl Array {
    pub fn folder(&self) -> PathBuf {
        self.root.join(&self.name)
    }

    fn metadata_path(&self) -> PathBuf {
        self.folder().join("zarr.json")
    }

    fn chunk_path(&self, i: usize, j: usize) -> PathBuf {
        let row = self.folder().join("c").join(i.to_string());
        if self.columns.is_some() { row.join(j.to_string()) } else { row }
    }

    /// Length of the second axis, 1 for a vector.
    pub fn width(&self) -> usize {
        self.columns.unwrap_or(1)
    }

    /// Number of chunks along the second axis.
    pub fn chunk_columns(&self) -> usize {
        self.width().div_ceil(self.chunk[1])
    }

    /// The columns of chunk `j`.
    pub fn columns_of(&self, j: usize) -> Range<usize> {
        j * self.chunk[1]..((j + 1) * self.chunk[1]).min(self.width())
    }

    fn metadata(&self, rows: usize) -> Value {
        let axes = if self.columns.is_some() { 2 } else { 1 };
        let shape = [rows, self.width()];
        json!({
            "zarr_format": 3,
            "node_type": "array",
            "shape": shape[..axes],
            "data_type": "float64",
            "chunk_grid": {
                "name": "regular",
                "configuration": { "chunk_shape": self.chunk[..axes] },
            },
            "chunk_key_encoding": { "name": "default", "configuration": { "separator": "/" } },
            "fill_value": "NaN",
            "codecs": [
                { "name": "bytes", "configuration": { "endian": "little" } },
                { "name": "crc32c" },
            ],
            "attributes": self.attributes,
            "dimension_names": self.axes[..axes],
        })
    }

    /// Writes zarr.json for `rows` rows.
    pub fn write_metadata(&self, rows: usize) -> Result<(), (PathBuf, io::Error)> {
        write_json(&self.metadata_path(), &self.metadata(rows))
    }

    /// Whether zarr.json says what it must for at least `rows` rows.
    ///
    /// More rows than are committed stand there after a crash between the array's description and the record's.
    pub fn check_metadata(&self, rows: usize) -> Result<(), RecordError> {
        let path = self.metadata_path();
        let written = text_of(&self.metadata(usize::MAX));
        // Other programs may write the same with more blanks, but not with more entries: a file of
        // nothing but brackets takes a hundred times its length when it is parsed.
        let text = read_text(&path, 2 * written.len() as u64)?;
        let commas = |text: &str| text.matches(',').count();
        if commas(&text) > commas(&written) {
            return Err(RecordError::Invalid {
                path,
                key: "number of entries".into(),
                value: commas(&text).to_string(),
                expected: format!("at most {}", commas(&written)),
            });
        }
        let found: Value = serde_json::from_str(&text).map_err(RecordError::json(&path))?;
        let found_rows = found.pointer("/shape/0").and_then(Value::as_u64).unwrap_or(0);
        let found_rows = usize::try_from(found_rows).unwrap_or(usize::MAX);
        let expected = self.metadata(found_rows.max(rows));
        if found == expected {
            return Ok(());
        }
        let keys = expected.as_object().into_iter().flatten().map(|(key, _)| key);
        let wrong = keys.clone().find(|key| found.get(key) != expected.get(key));
        let (key, of) = wrong.map_or(("keys", None), |key| (key.as_str(), Some(key)));
        let show = |value: &Value| match of {
            Some(key) => value.get(key).map_or("missing".to_owned(), Value::to_string),
            None => format!("{} keys", value.as_object().map_or(0, serde_json::Map::len)),
        };
        let [value, expected] = [&found, &expected].map(|v| show(v).chars().take(80).collect());
        Err(RecordError::Invalid { path, key: key.to_owned(), value, expected })
    }

    /// Writes chunk (i, j) row by row: `row(r)` gives what is known of row r of the chunk, the rest is NaN.
    pub fn write_chunk<'a>(
        &self,
        i: usize,
        j: usize,
        rows: impl Iterator<Item = &'a [f64]>,
    ) -> Result<(), (PathBuf, io::Error)> {
        let [height, width] = self.chunk;
        let mut bytes = f64::NAN.to_le_bytes().repeat(height * width);
        for (row, target) in rows.zip(bytes.chunks_exact_mut(width * 8)) {
            for (value, bytes) in row.iter().zip(target.as_chunks_mut().0) {
                *bytes = value.to_le_bytes();
            }
        }
        bytes.extend(crc32c::crc32c(&bytes).to_le_bytes());
        let path = self.chunk_path(i, j);
        let written = make_folder(path.parent().expect("a chunk lies in a folder"))
            .and_then(|()| atomic::write_without_folder(&path, &bytes));
        written.map_err(|source| (path, source))
    }

    /// Brings the names of the chunks (i, 0), (i, 1), ... to the disk, when all are written.
    pub fn sync_band(&self, i: usize) {
        atomic::sync_entry(&self.chunk_path(i, 0));
    }

    /// The places of all chunks that the first `rows` rows lie in.
    pub fn chunks(&self, rows: usize) -> impl Iterator<Item = (usize, usize)> {
        let columns = self.chunk_columns();
        (0..rows.div_ceil(self.chunk[0])).flat_map(move |i| (0..columns).map(move |j| (i, j)))
    }

    /// Whether chunk (i, j) is there in its length.
    pub fn check_chunk(&self, i: usize, j: usize) -> Result<(), RecordError> {
        let path = self.chunk_path(i, j);
        let expected = (self.chunk[0] * self.chunk[1] * 8 + 4) as u64;
        let damage = match fs::metadata(&path) {
            // A pipe or a device has no length that says what could be read.
            Ok(metadata) if !metadata.is_file() => Damage::Missing,
            Ok(metadata) if metadata.len() == expected => return Ok(()),
            Ok(metadata) => Damage::Length { found: metadata.len(), expected },
            Err(e) if e.kind() == io::ErrorKind::NotFound => Damage::Missing,
            Err(e) => return Err(RecordError::read("read", &path)(e)),
        };
        Err(self.damaged(i, j, damage))
    }

    /// The numbers of chunk (i, j) in little-endian bytes, row by row, as many as its shape says.
    pub fn read_chunk(&self, i: usize, j: usize) -> Result<Vec<u8>, RecordError> {
        self.check_chunk(i, j)?;
        let path = self.chunk_path(i, j);
        let mut bytes = fs::read(&path).map_err(RecordError::read("read", &path))?;
        let (numbers, stored) = bytes.split_last_chunk().ok_or_else(|| {
            let found = bytes.len() as u64; // it shrank since it was checked
            self.damaged(i, j, Damage::Length { found, expected: found.max(4) })
        })?;
        let (stored, computed) = (u32::from_le_bytes(*stored), crc32c::crc32c(numbers));
        if stored != computed {
            return Err(self.damaged(i, j, Damage::Checksum { stored, computed }));
        }
        bytes.truncate(bytes.len() - 4);
        Ok(bytes)
    }

    fn damaged(&self, i: usize, j: usize, damage: Damage) -> RecordError {
        RecordError::from(Box::new(DamagedBlock {
            path: self.chunk_path(i, j),
            array: self.name.clone(),
            axes: self.axes,
            first: i * self.chunk[0]..(i + 1) * self.chunk[0],
            second: self.columns_of(j),
            damage,
        }))
    }

    /// The first `kept` rows of the chunks (i, 0), (i, 1), ..., in their whole width, one after the other.
    pub fn read_band(&self, i: usize, kept: usize) -> Result<Vec<f64>, RecordError> {
        // Read before room is made: there is no more of it than the files take.
        let chunks: Vec<Vec<u8>> = (0..self.chunk_columns())
            .map(|j| self.read_chunk(i, j))
            .collect::<Result<_, RecordError>>()?;
        let mut band = vec![0.0; kept * self.width()];
        for (row, values) in band.chunks_exact_mut(self.width()).enumerate() {
            for (j, chunk) in chunks.iter().enumerate() {
                let columns = self.columns_of(j);
                let from = numbers(&chunk[8 * row * self.chunk[1]..]);
                values[columns].iter_mut().zip(from).for_each(|(to, from)| *to = from);
            }
        }
        Ok(band)
    }

    /// The first `rows` rows, one after the other.
    pub fn read_rows(&self, rows: usize) -> Result<Vec<f64>, RecordError> {
        let mut values = Vec::new();
        for i in 0..rows.div_ceil(self.chunk[0]) {
            let kept = (rows - i * self.chunk[0]).min(self.chunk[0]);
            values.extend(self.read_band(i, kept)?);
        }
        Ok(values)
    }

    /// Removes what a writer left behind chunk row `i`: later chunks, and files half written.
    pub fn remove_after(&self, i: usize) -> io::Result<()> {
        for entry in entries(&self.folder().join("c"))? {
            let index = entry.file_name().and_then(|name| name.to_str()?.parse::<usize>().ok());
            match index {
                Some(index) if index > i && entry.is_dir() => fs::remove_dir_all(&entry)?,
                Some(index) if index > i => fs::remove_file(&entry)?,
                _ => {}
            }
        }
        let folders =
            [self.folder(), self.folder().join("c"), self.folder().join(format!("c/{i}"))];
        for folder in folders.into_iter().filter(|folder| folder.is_dir()) {
            for file in entries(&folder)?.into_iter().filter(|path| atomic::is_temporary(path)) {
                fs::remove_file(file)?;
            }
        }
        Ok(())
    }
}

/// The numbers that stand in the bytes of a chunk.
pub(super) fn numbers(bytes: &[u8]) -> impl Iterator<Item = f64> {
    bytes.as_chunks().0.iter().map(|&number| f64::from_le_bytes(number))
}

fn entries(folder: &Path) -> io::Result<Vec<PathBuf>> {
    match fs::read_dir(folder) {
        Err(e) if e.kind() == io::ErrorKind::NotFound => Ok(Vec::new()),
        found => found?.map(|entry| entry.map(|entry| entry.path())).collect(),
    }
}

/// Makes a folder and those on the way to it.
fn make_folder(folder: &Path) -> io::Result<()> {
    if folder.is_dir() {
        return Ok(());
    }
    folder.parent().map_or(Ok(()), make_folder)?;
    fs::create_dir(folder)?;
    atomic::sync_entry(folder);
    Ok(())
}

/// A description as it stands in a file.
fn text_of(value: &Value) -> String {
    format!("{value:#}\n")
}

/// Writes a description, and the folders on the way to it.
pub(super) fn write_json(path: &Path, value: &Value) -> Result<(), (PathBuf, io::Error)> {
    let written = make_folder(path.parent().expect("a description lies in a folder"))
        .and_then(|()| atomic::write(path, text_of(value).as_bytes()));
    written.map_err(|source| (path.to_owned(), source))
}

/// Reads a description, which is refused when longer than `limit` bytes.
pub(super) fn read_text(path: &Path, limit: u64) -> Result<String, RecordError> {
    let read = RecordError::read("read", path);
    let metadata = fs::metadata(path).map_err(&read)?;
    if !metadata.is_file() || metadata.len() > limit {
        return Err(RecordError::Invalid {
            path: path.to_owned(),
            key: "length of the file".into(),
            value: format!("{} bytes", metadata.len()),
            expected: format!("a file of at most {limit} bytes"),
        });
    }
    let mut text = String::new();
    File::open(path).and_then(|file| file.take(limit).read_to_string(&mut text)).map_err(&read)?;
    Ok(text)
}
