use crate::format::FormatError;
use crate::format::error::excerpt;
use crate::format::region::Region;

pub(super) const LOCAL: u32 = 0x0403_4b50;
pub(super) const ENTRY: u32 = 0x0201_4b50;
pub(super) const END: u32 = 0x0605_4b50;
pub(super) const END64: u32 = 0x0606_4b50;
pub(super) const LOCATOR64: u32 = 0x0706_4b50;

/// Number of the extra field that holds what does not fit into 32 bits.
pub(super) const EXTRA64: u16 = 1;

/// Largest directory that is read, in bytes: that of about 100 000 arrays.
const LIMIT: u64 = 1 << 24;

/// One member as the central directory of an archive tells it.
#[derive(Debug, Clone)]
pub(super) struct Entry {
    pub name: String,
    pub encrypted: bool,
    pub method: u16,
    pub crc: u32,
    pub packed: u64,
    pub size: u64,
    pub local: u64,
}

/// The members of an archive, and where its central directory begins.
pub(super) fn read(file: &Region) -> Result<(Vec<Entry>, u64), FormatError> {
    let (count, size, start) = find(file)?;
    let mut bytes = vec![0; usize::try_from(size).expect("a short directory")];
    read_at(file, start, &mut bytes, "the directory")?;
    let mut cursor = Cursor { file, start, bytes: &bytes, at: 0 };
    let mut entries = Vec::new();
    while cursor.at < bytes.len() {
        entries.push(entry(&mut cursor)?);
    }
    if entries.len() as u64 != count {
        return Err(cursor.wrong("as many entries as the archive's end tells"));
    }
    Ok((entries, start))
}

/// Number of entries, size and place of the central directory.
fn find(file: &Region) -> Result<(u64, u64, u64), FormatError> {
    // At the end, before a comment of at most 65535 bytes.
    let length = file.len().min(22 + 0xFFFF);
    let start = file.len() - length;
    let mut bytes = vec![0; usize::try_from(length).expect("at most 65557 bytes")];
    file.read(start, &mut bytes)?;
    let end = (0..bytes.len().saturating_sub(21)).rev().find(|&at| {
        let comment = bytes.len() - at - 22;
        bytes[at..at + 4] == END.to_le_bytes()
            && usize::from(u16::from_le_bytes([bytes[at + 20], bytes[at + 21]])) == comment
    });
    let mut cursor = Cursor { file, start, bytes: &bytes, at: 0 };
    cursor.at = end.ok_or_else(|| cursor.wrong("an NPZ archive: the end of its directory"))?;
    let end = start + cursor.at as u64;
    cursor.skip(10)?;
    let count = cursor.u16()?;
    let (size, place) = (cursor.u32()?, cursor.u32()?);
    let found = if count == u16::MAX || size == u32::MAX || place == u32::MAX {
        find64(file, end)?
    } else {
        (u64::from(count), u64::from(size), u64::from(place))
    };
    let (_, size, place) = found;
    if size > LIMIT || place.checked_add(size).is_none_or(|after| after > end) {
        return Err(cursor.wrong("a directory that lies within the archive"));
    }
    Ok(found)
}

fn find64(file: &Region, end: u64) -> Result<(u64, u64, u64), FormatError> {
    let mut bytes = [0; 20];
    let start = end.saturating_sub(20);
    read_at(file, start, &mut bytes, "the ZIP64 locator")?;
    let mut cursor = Cursor { file, start, bytes: &bytes, at: 0 };
    cursor.signature(LOCATOR64, "the ZIP64 locator")?;
    cursor.skip(4)?;
    let start = cursor.u64()?;
    let mut bytes = [0; 56];
    read_at(file, start, &mut bytes, "the ZIP64 end of the directory")?;
    let mut cursor = Cursor { file, start, bytes: &bytes, at: 0 };
    cursor.signature(END64, "the ZIP64 end of the directory")?;
    cursor.skip(28)?;
    Ok((cursor.u64()?, cursor.u64()?, cursor.u64()?))
}

fn entry(cursor: &mut Cursor) -> Result<Entry, FormatError> {
    cursor.signature(ENTRY, "an entry of the directory")?;
    cursor.skip(4)?;
    let encrypted = cursor.u16()? & 1 != 0;
    let method = cursor.u16()?;
    cursor.skip(4)?;
    let crc = cursor.u32()?;
    let mut fields = [u64::from(cursor.u32()?), u64::from(cursor.u32()?), 0];
    let [name, extra, comment] = [cursor.u16()?, cursor.u16()?, cursor.u16()?].map(usize::from);
    cursor.skip(8)?;
    fields[2] = u64::from(cursor.u32()?);
    let name = String::from_utf8_lossy(cursor.take(name)?).into_owned();
    let after = cursor.at + extra;
    while cursor.at + 4 <= after {
        let (id, length) = (cursor.u16()?, usize::from(cursor.u16()?));
        let next = cursor.at + length;
        if id == EXTRA64 {
            // In this order: size, packed size, place; each only where it did not fit.
            for k in [1, 0, 2] {
                if fields[k] == u64::from(u32::MAX) {
                    fields[k] = cursor.u64()?;
                }
            }
        }
        cursor.jump(next)?;
    }
    cursor.jump(after)?;
    cursor.skip(comment)?;
    let [packed, size, local] = fields;
    Ok(Entry { name, encrypted, method, crc, packed, size, local })
}

/// Where the bytes of `entry` lie: its local header is read, and must agree.
pub(super) fn member(file: &Region, entry: &Entry, end: u64) -> Result<Region, FormatError> {
    let (start, mut bytes) = (entry.local, vec![0; 30 + entry.name.len()]);
    read_at(file, start, &mut bytes, "the header of a member")?;
    let mut cursor = Cursor { file, start, bytes: &bytes, at: 0 };
    cursor.signature(LOCAL, "the header of a member")?;
    cursor.skip(22)?;
    let [name, extra] = [cursor.u16()?, cursor.u16()?].map(usize::from);
    if name != entry.name.len() || cursor.take(name)? != entry.name.as_bytes() {
        return Err(cursor.wrong("the name that the directory tells"));
    }
    // No overflow: the header was read, so `start` lies in the file.
    let data = start + (30 + name + extra) as u64;
    if data.checked_add(entry.size).is_none_or(|after| after > end) {
        return Err(cursor.wrong("a member that ends before the directory"));
    }
    Ok(file.part(data, entry.size, &entry.name))
}

/// Fills `bytes` from `start` on, where an archive tells that something stands.
fn read_at(
    file: &Region,
    start: u64,
    bytes: &mut [u8],
    expected: &'static str,
) -> Result<(), FormatError> {
    if start.checked_add(bytes.len() as u64).is_none_or(|end| end > file.len()) {
        let (path, found) = (file.path().to_owned(), "the end of the file".to_owned());
        return Err(FormatError::Bytes { path, offset: start, found, expected });
    }
    file.read(start, bytes)
}

/// Reads little-endian numbers, never beyond the end.
struct Cursor<'a> {
    file: &'a Region,
    start: u64,
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Cursor<'a> {
    fn wrong(&self, expected: &'static str) -> FormatError {
        FormatError::Bytes {
            path: self.file.path().to_owned(),
            offset: self.start + self.at as u64,
            found: excerpt(&self.bytes[self.at..]),
            expected,
        }
    }

    fn jump(&mut self, to: usize) -> Result<(), FormatError> {
        if to < self.at || to > self.bytes.len() {
            return Err(self.wrong("a field that ends within its record"));
        }
        self.at = to;
        Ok(())
    }

    fn skip(&mut self, count: usize) -> Result<(), FormatError> {
        self.jump(self.at + count)
    }

    fn take(&mut self, count: usize) -> Result<&'a [u8], FormatError> {
        let (bytes, first) = (self.bytes, self.at);
        self.skip(count)?;
        Ok(&bytes[first..self.at])
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], FormatError> {
        let bytes = self.take(N)?;
        Ok(*bytes.first_chunk().expect("as many as were taken"))
    }

    fn u16(&mut self) -> Result<u16, FormatError> {
        self.array().map(u16::from_le_bytes)
    }

    fn u32(&mut self) -> Result<u32, FormatError> {
        self.array().map(u32::from_le_bytes)
    }

    fn u64(&mut self) -> Result<u64, FormatError> {
        self.array().map(u64::from_le_bytes)
    }

    fn signature(&mut self, signature: u32, expected: &'static str) -> Result<(), FormatError> {
        let first = self.at;
        if self.u32()? != signature {
            self.at = first;
            return Err(self.wrong(expected));
        }
        Ok(())
    }
}
