//! Sections of a file of version 4.1.

use super::cursor::Cursor;
use super::elements::{EXPECTED, find};
use super::raw::{Node, Raw};
use crate::format::FormatError;
use std::collections::BTreeMap;

/// `$Entities`: of the points, curves, surfaces and volumes of the geometry only the physical groups of the
/// curves are kept.
pub(super) fn entities(cursor: &mut Cursor<'_>) -> Result<BTreeMap<i32, Vec<i32>>, FormatError> {
    let mut curves = BTreeMap::new();
    let mut counts = [0; 4];
    for count in &mut counts {
        *count = cursor.size("the number of geometric entities")?;
    }
    for (dimension, count) in counts.into_iter().enumerate() {
        cursor.check_room(count, 10, 36)?;
        for _ in 0..count {
            let number = cursor.integer("the number of a geometric entity")?;
            for _ in 0..if dimension == 0 { 3 } else { 6 } {
                cursor.float("a finite coordinate")?;
            }
            let groups = integers(cursor)?;
            if dimension > 0 {
                integers(cursor)?; // its boundary
            }
            if dimension == 1 && curves.insert(number, groups).is_some() {
                return Err(cursor.wrong("each curve once"));
            }
        }
    }
    Ok(curves)
}

fn integers(cursor: &mut Cursor<'_>) -> Result<Vec<i32>, FormatError> {
    let count = cursor.size("how many numbers follow")?;
    let count = cursor.check_room(count, 2, 4)?;
    (0..count).map(|_| cursor.integer("the number of a group or an entity")).collect()
}

/// `$Nodes`: blocks, in each the numbers of its nodes, then x, y, z of each.
pub(super) fn nodes(cursor: &mut Cursor<'_>, raw: &mut Raw) -> Result<(), FormatError> {
    let (blocks, count) = totals(cursor)?;
    let count = cursor.check_room(count, 8, 32)?;
    for _ in 0..blocks {
        let dimension = cursor.integer("the dimension of an entity")?;
        cursor.integer("the number of an entity")?;
        let parameters = match cursor.integer("0 or 1")? {
            0 => 0,
            1 => dimension.clamp(0, 3),
            _ => return Err(cursor.wrong("0 or 1 for parametric nodes")),
        };
        let block = cursor.size("the number of nodes in a block")?;
        let block = cursor.check_room(block, 8, 32)?;
        let first = raw.nodes.len();
        for _ in 0..block {
            let number = cursor.size("the number of a node")?;
            raw.nodes.push(Node { number, at: [0.0; 3] });
        }
        for node in &mut raw.nodes[first..] {
            for x in &mut node.at {
                *x = cursor.float("a finite coordinate")?;
            }
            for _ in 0..parameters {
                cursor.float("a finite parameter")?;
            }
        }
    }
    if raw.nodes.len() != count {
        return Err(cursor.wrong("as many nodes in all as the section says"));
    }
    Ok(())
}

/// `$Elements`: blocks of one type on one entity; for each element its number and those of its nodes.
pub(super) fn elements(cursor: &mut Cursor<'_>, raw: &mut Raw) -> Result<(), FormatError> {
    let (blocks, count) = totals(cursor)?;
    let mut found = 0_u64;
    for _ in 0..blocks {
        cursor.integer("the dimension of an entity")?;
        let entity = cursor.integer("the number of an entity")?;
        let kind = cursor.integer(EXPECTED)?;
        let (kind, nodes) = find(kind).ok_or_else(|| cursor.wrong(EXPECTED))?;
        let block = cursor.size("the number of elements in a block")?;
        let each = nodes as u64 + 1;
        cursor.check_room(block, 2 * each, 8 * each)?;
        for _ in 0..block {
            let number = cursor.size("the number of an element")?;
            let mut corners = [0; 9];
            for corner in &mut corners[..nodes] {
                *corner = cursor.size("the number of a node")?;
            }
            raw.push(number, kind, entity, &corners[..nodes]);
        }
        found = found.saturating_add(block);
    }
    if found != count {
        return Err(cursor.wrong("as many elements in all as the section says"));
    }
    Ok(())
}

/// The numbers of blocks and of things in them; the smallest and the largest of their numbers are passed.
fn totals(cursor: &mut Cursor<'_>) -> Result<(u64, u64), FormatError> {
    let blocks = cursor.size("the number of blocks")?;
    let count = cursor.size("the number of nodes or elements")?;
    cursor.size("the smallest number")?;
    cursor.size("the largest number")?;
    cursor.check_room(blocks, 8, 20)?;
    Ok((blocks, count))
}
