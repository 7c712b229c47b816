//! Sections of a file of version 2.2.

use super::cursor::{Cursor, Encoding};
use super::elements::{EXPECTED, find};
use super::raw::{Node, Raw};
use crate::format::FormatError;

/// `$Nodes`: their number; for each its number, x, y, z.
pub(super) fn nodes(cursor: &mut Cursor<'_>, raw: &mut Raw) -> Result<(), FormatError> {
    let count = cursor.text("the number of nodes")?;
    cursor.skip_line_end();
    let count = cursor.check_room(count, 8, 28)?;
    raw.nodes.reserve_exact(count);
    for _ in 0..count {
        let number = number(cursor, "the number of a node")?;
        let mut at = [0.0; 3];
        for x in &mut at {
            *x = cursor.float("a finite coordinate")?;
        }
        raw.nodes.push(Node { number, at });
    }
    Ok(())
}

/// `$Elements`: their number; then one on each line, or in a binary file blocks of one type.
pub(super) fn elements(cursor: &mut Cursor<'_>, raw: &mut Raw) -> Result<(), FormatError> {
    let count: u64 = cursor.text("the number of elements")?;
    cursor.skip_line_end();
    let mut left = cursor.check_room(count, 6, 8)?;
    while left > 0 {
        left -= block(cursor, raw, left)?;
    }
    Ok(())
}

/// Reads the elements of a block, or the one of a line, and returns how many there were.
fn block(cursor: &mut Cursor<'_>, raw: &mut Raw, left: usize) -> Result<usize, FormatError> {
    let text = cursor.encoding == Encoding::Text;
    let first = if text { Some(number(cursor, "the number of an element")?) } else { None };
    let kind = cursor.integer(EXPECTED)?;
    let (kind, nodes) = find(kind).ok_or_else(|| cursor.wrong(EXPECTED))?;
    let count = if text { 1 } else { number(cursor, "the number of elements in a block")? };
    let tags = number(cursor, "the number of tags")?;
    if count == 0 || count > left as u64 {
        return Err(cursor.wrong("as many elements in all as the section says"));
    }
    cursor.check_room(count.saturating_mul(tags + nodes as u64), 2, 4)?;
    for _ in 0..count {
        let element = match first {
            Some(number) => number,
            None => number(cursor, "the number of an element")?,
        };
        let mut group = 0;
        for tag in 0..tags {
            let value = cursor.integer("a tag")?;
            group = if tag == 0 { value.saturating_abs() } else { group };
        }
        let mut corners = [0; 9];
        for corner in &mut corners[..nodes] {
            *corner = number(cursor, "the number of a node")?;
        }
        raw.push(element, kind, group, &corners[..nodes]);
    }
    Ok(usize::try_from(count).expect("no more than are left"))
}

/// An integer that is not negative.
fn number(cursor: &mut Cursor<'_>, expected: &'static str) -> Result<u64, FormatError> {
    let value = cursor.integer(expected)?;
    u64::try_from(value).map_err(|_| cursor.wrong(expected))
}
