//! The records of an archive, as they are written; sizes and places from a limit on as ZIP64.

use super::directory::{END, END64, ENTRY, EXTRA64, LOCAL, LOCATOR64};

/// 1 January 1980: archives of the same arrays are the same bytes.
const DATE: u16 = 0x21;

/// Sizes and places from here on do not fit into the fields of ZIP.
pub(super) const LIMIT: u64 = u32::MAX as u64;

/// One member of an archive.
#[derive(Debug)]
pub(super) struct Member {
    pub name: String,
    pub crc: u32,
    pub size: u64,
    /// Place of the local header.
    pub local: u64,
}

/// The header before a member; its checksum is put in when it is known.
pub(super) fn local_header(member: &Member, limit: u64) -> Vec<u8> {
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

/// The entry of a member in the directory at the end.
pub(super) fn entry(member: &Member, limit: u64) -> Vec<u8> {
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

/// What stands behind the directory.
pub(super) fn end(count: u64, size: u64, start: u64, limit: u64) -> Vec<u8> {
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
