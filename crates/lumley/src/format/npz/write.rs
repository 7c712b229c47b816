use super::crc32::crc32;
use super::directory::{END, END64, ENTRY, EXTRA64, LOCAL, LOCATOR64};
use crate::format::FormatError;
use crate::format::atomic::AtomicFile;
use crate::format::npy::{self, NpyWriter};
use faer::MatRef;
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// 1 January 1980: archives of the same arrays are the same bytes.
const DATE: u16 = 0x21;

/// Writes named arrays to an NPZ archive, one after the other and without a copy in memory.
///
/// The archive appears under its name, and in the place of an older one, with [`finish`](Self::finish).
/// Sizes and places beyond 4 GiB are written as ZIP64.
///
/// ```
/// use lumley::format::npz::{NpzReader, NpzWriter};
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("pod.npz");
/// let mut npz = NpzWriter::create(&path)?;
/// npz.matrix("modes", faer::mat![[1.0, 0.0], [0.0, 1.0]].as_ref())?;
/// npz.finish()?;
/// assert_eq!(NpzReader::open(&path)?.names().collect::<Vec<_>>(), ["modes"]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct NpzWriter {
    path: PathBuf,
    out: BufWriter<AtomicFile>,
    members: Vec<Member>,
    /// Sizes and places from here on are written as ZIP64.
    limit: u64,
}

#[derive(Debug)]
struct Member {
    name: String,
    crc: u32,
    size: u64,
    local: u64,
}

impl NpzWriter {
    /// Begins the archive `path`.
    ///
    /// # Errors
    /// [`FormatError::Io`].
    pub fn create(path: impl AsRef<Path>) -> Result<Self, FormatError> {
        Self::with_limit(path.as_ref(), u64::from(u32::MAX))
    }

    fn with_limit(path: &Path, limit: u64) -> Result<Self, FormatError> {
        let file = AtomicFile::create(path).map_err(FormatError::io("create", path))?;
        let out = BufWriter::with_capacity(1 << 16, file);
        Ok(Self { path: path.to_owned(), out, members: Vec::new(), limit })
    }

    /// Writes a matrix, in Fortran order.
    ///
    /// # Errors
    /// [`FormatError::Io`]; the archive must then be given up.
    ///
    /// # Panics
    /// If the name is taken.
    pub fn matrix(&mut self, name: &str, x: MatRef<'_, f64>) -> Result<(), FormatError> {
        self.array(name, &[x.nrows(), x.ncols()], |npy| npy::push_columns(npy, x))
    }

    /// Writes a vector.
    ///
    /// # Errors
    /// [`FormatError::Io`]; the archive must then be given up.
    ///
    /// # Panics
    /// If the name is taken.
    pub fn vector(&mut self, name: &str, x: &[f64]) -> Result<(), FormatError> {
        self.array(name, &[x.len()], |npy| npy.push(x))
    }

    /// Writes an array as its numbers come: `push` gives them all, the first index fastest.
    fn array(
        &mut self,
        name: &str,
        shape: &[usize],
        push: impl FnOnce(&mut NpyWriter<&mut Checked<'_>>) -> io::Result<()>,
    ) -> Result<(), FormatError> {
        let name = format!("{name}.npy");
        assert!(self.members.iter().all(|member| member.name != name), "one array of a name");
        let write = || -> io::Result<()> {
            let local = self.out.stream_position()?;
            let member = Member { name, crc: 0, size: npy::file_size(shape), local };
            self.out.write_all(&local_header(&member, self.limit))?;
            let mut checked = Checked { out: &mut self.out, crc: 0 };
            let mut npy = NpyWriter::new(&mut checked, shape)?;
            push(&mut npy)?;
            npy.finish();
            let crc = checked.crc;
            self.out.seek(SeekFrom::Start(local + 14))?;
            self.out.write_all(&crc.to_le_bytes())?;
            self.out.seek(SeekFrom::End(0))?;
            self.members.push(Member { crc, ..member });
            Ok(())
        };
        write().map_err(FormatError::io("write", &self.path))
    }

    /// Writes the directory and gives the archive its name.
    ///
    /// # Errors
    /// [`FormatError::Io`]; an older archive then stands as it was.
    pub fn finish(mut self) -> Result<(), FormatError> {
        let mut write = || -> io::Result<()> {
            let start = self.out.stream_position()?;
            for member in &self.members {
                self.out.write_all(&entry(member, self.limit))?;
            }
            let size = self.out.stream_position()? - start;
            let count = self.members.len() as u64;
            self.out.write_all(&end(count, size, start, self.limit))
        };
        let written = write()
            .and_then(|()| self.out.into_inner().map_err(io::IntoInnerError::into_error)?.commit());
        written.map_err(FormatError::io("write", &self.path))
    }
}

/// Keeps the checksum of what passes through.
#[derive(Debug)]
pub(super) struct Checked<'a> {
    out: &'a mut BufWriter<AtomicFile>,
    crc: u32,
}

impl Write for Checked<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.out.write(bytes)?;
        self.crc = crc32(self.crc, &bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

/// The header before a member; its checksum is put in when it is known.
fn local_header(member: &Member, limit: u64) -> Vec<u8> {
    let mut extra = Vec::new();
    let size = narrow(member.size, limit, &mut extra);
    // Both sizes stand in the extra field of a local header, or none.
    let packed = narrow(member.size, limit, &mut extra);
    let mut bytes = LOCAL.to_le_bytes().to_vec();
    bytes.extend(common(member, packed, size, &extra));
    bytes.extend(member.name.bytes());
    bytes.extend(extra_field(&extra));
    bytes
}

fn entry(member: &Member, limit: u64) -> Vec<u8> {
    let mut extra = Vec::new();
    let size = narrow(member.size, limit, &mut extra);
    let packed = narrow(member.size, limit, &mut extra);
    let local = narrow(member.local, limit, &mut extra);
    let mut bytes = ENTRY.to_le_bytes().to_vec();
    bytes.extend(45_u16.to_le_bytes()); // made by version 4.5
    bytes.extend(common(member, packed, size, &extra));
    bytes.extend([0; 10]); // no comment, first disk, no attributes
    bytes.extend(local.to_le_bytes());
    bytes.extend(member.name.bytes());
    bytes.extend(extra_field(&extra));
    bytes
}

/// What a local header and an entry of the directory share, from version needed to length of the extra.
fn common(member: &Member, packed: u32, size: u32, extra: &[u64]) -> Vec<u8> {
    let version: u16 = if extra.is_empty() { 20 } else { 45 };
    let utf8: u16 = if member.name.is_ascii() { 0 } else { 1 << 11 };
    let name = u16::try_from(member.name.len()).expect("a short name");
    let extra = u16::try_from(extra_field(extra).len()).expect("a short field");
    let mut bytes = Vec::new();
    for field in [version, utf8, 0, 0, DATE] {
        bytes.extend(field.to_le_bytes());
    }
    for field in [member.crc, packed, size] {
        bytes.extend(field.to_le_bytes());
    }
    for field in [name, extra] {
        bytes.extend(field.to_le_bytes());
    }
    bytes
}

fn end(count: u64, size: u64, start: u64, limit: u64) -> Vec<u8> {
    let mut extra = Vec::new();
    let place = narrow(start, limit, &mut extra);
    let length = narrow(size, limit, &mut extra);
    let short_count = u16::try_from(count).ok().filter(|&count| count < u16::MAX);
    let mut bytes = Vec::new();
    if !extra.is_empty() || short_count.is_none() {
        bytes.extend(end64(count, size, start));
    }
    bytes.extend(END.to_le_bytes());
    bytes.extend([0; 4]); // first disk
    for field in [short_count.unwrap_or(u16::MAX); 2] {
        bytes.extend(field.to_le_bytes());
    }
    bytes.extend(length.to_le_bytes());
    bytes.extend(place.to_le_bytes());
    bytes.extend([0; 2]); // no comment
    bytes
}

fn end64(count: u64, size: u64, start: u64) -> Vec<u8> {
    let mut bytes = END64.to_le_bytes().to_vec();
    bytes.extend(44_u64.to_le_bytes()); // length of what follows
    bytes.extend([45_u16.to_le_bytes(); 2].concat()); // made by and needs version 4.5
    bytes.extend([0; 8]); // first disk
    for field in [count, count, size, start] {
        bytes.extend(field.to_le_bytes());
    }
    bytes.extend(LOCATOR64.to_le_bytes());
    bytes.extend([0; 4]); // first disk
    bytes.extend((start + size).to_le_bytes());
    bytes.extend(1_u32.to_le_bytes()); // disks
    bytes
}

/// `value` where it is below `limit`; otherwise the mark that it stands among `extra`.
fn narrow(value: u64, limit: u64, extra: &mut Vec<u64>) -> u32 {
    match u32::try_from(value) {
        Ok(short) if value < limit => short,
        _ => {
            extra.push(value);
            u32::MAX
        }
    }
}

fn extra_field(values: &[u64]) -> Vec<u8> {
    if values.is_empty() {
        return Vec::new();
    }
    let length = u16::try_from(8 * values.len()).expect("at most three values");
    let mut bytes = EXTRA64.to_le_bytes().to_vec();
    bytes.extend(length.to_le_bytes());
    bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    bytes
}

#[cfg(test)]
mod tests {
    use super::{END64, NpzWriter};
    use crate::format::FormatError;
    use crate::format::npz::NpzReader;

    /// Archives beyond 4 GiB, without writing 4 GiB: all sizes and places as ZIP64.
    #[test]
    fn zip64_is_read_back() -> Result<(), Box<dyn std::error::Error>> {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("large.npz");
        let mut npz = NpzWriter::with_limit(&path, 0)?;
        npz.matrix("a", faer::mat![[1.0, 2.0]].as_ref())?;
        npz.vector("b", &[3.0])?;
        npz.finish()?;
        let marks = std::fs::read(&path)?;
        assert!(marks.windows(4).any(|bytes| bytes == END64.to_le_bytes()));
        let npz = NpzReader::open(&path)?;
        assert_eq!(npz.read("a")?, faer::mat![[1.0, 2.0]]);
        assert_eq!(npz.vector("b")?, [3.0]);
        assert!(matches!(npz.matrix("c"), Err(FormatError::NoSuchArray { .. })));
        Ok(())
    }
}
