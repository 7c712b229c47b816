use super::cursor::{Cursor, Encoding};
use super::elements::Kind;
use super::{version2, version4};
use crate::format::FormatError;
use std::collections::BTreeMap;

/// What stands in a file, with the file's own numbers.
#[derive(Debug, Default)]
pub(super) struct Raw {
    pub nodes: Vec<Node>,
    pub elements: Vec<Element>,
    /// Nodes of all elements, one after the other.
    pub corners: Vec<u64>,
    /// Names of physical groups of lines.
    pub names: BTreeMap<i32, String>,
    /// In a 4.1 file, the physical groups of each geometric curve.
    pub curves: Option<BTreeMap<i32, Vec<i32>>>,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Node {
    pub number: u64,
    pub at: [f64; 3],
}

/// A line or a cell.
#[derive(Debug, Clone, Copy)]
pub(super) struct Element {
    pub number: u64,
    pub kind: Kind,
    /// Where its nodes begin.
    pub first: usize,
    pub nodes: usize,
    /// In a 2.2 file the physical group, in a 4.1 file the geometric curve or surface.
    pub group: i32,
}

impl Raw {
    /// Appends an element, points excepted.
    pub fn push(&mut self, number: u64, kind: Kind, group: i32, corners: &[u64]) {
        if kind != Kind::Point {
            let (first, nodes) = (self.corners.len(), corners.len());
            self.elements.push(Element { number, kind, first, nodes, group });
            self.corners.extend(corners);
        }
    }

    pub fn corners(&self, element: &Element) -> &[u64] {
        &self.corners[element.first..element.first + element.nodes]
    }

    /// The physical groups that a line is in.
    pub fn groups<'a>(&'a self, line: &'a Element) -> &'a [i32] {
        match &self.curves {
            Some(curves) => curves.get(&line.group).map_or(&[], Vec::as_slice),
            None => std::slice::from_ref(&line.group),
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Version {
    Two,
    Four,
}

/// Sections that are read, each of them at most once.
const SECTIONS: [&str; 5] = ["MeshFormat", "PhysicalNames", "Entities", "Nodes", "Elements"];

pub(super) fn read(cursor: &mut Cursor<'_>) -> Result<Raw, FormatError> {
    let mut raw = Raw::default();
    let version = format(cursor)?;
    raw.curves = (version == Version::Four).then(BTreeMap::new);
    let mut seen = vec!["MeshFormat"];
    while let Some(name) = cursor.section()? {
        if !SECTIONS.contains(&name) {
            cursor.skip(name)?;
            continue;
        }
        if seen.contains(&name) {
            return Err(cursor.wrong("each section once"));
        }
        match (name, version) {
            ("PhysicalNames", _) => raw.names = physical_names(cursor)?,
            ("Entities", Version::Four) => raw.curves = Some(version4::entities(cursor)?),
            ("Nodes", Version::Two) => version2::nodes(cursor, &mut raw)?,
            ("Nodes", Version::Four) => version4::nodes(cursor, &mut raw)?,
            ("Elements", Version::Two) => version2::elements(cursor, &mut raw)?,
            ("Elements", Version::Four) => version4::elements(cursor, &mut raw)?,
            _ => return Err(cursor.wrong("no $Entities in a file of version 2.2")),
        }
        cursor.end(name)?;
        seen.push(name);
    }
    for (section, expected) in [("Nodes", "a section $Nodes"), ("Elements", "a section $Elements")]
    {
        if !seen.contains(&section) {
            return Err(cursor.wrong(expected));
        }
    }
    Ok(raw)
}

/// `$MeshFormat`: version, ASCII or binary, bytes of a number; in a binary file an integer 1 follows.
fn format(cursor: &mut Cursor<'_>) -> Result<Version, FormatError> {
    if cursor.section()? != Some("MeshFormat") {
        return Err(cursor.wrong("a file of gmsh, which begins with $MeshFormat"));
    }
    let version: String = cursor.text("a version")?;
    let version = match version.as_str() {
        "2.2" => Version::Two,
        "4.1" => Version::Four,
        _ => {
            return Err(cursor.wrong("version 2.2 or 4.1: gmsh -format msh22 or msh41 writes them"));
        }
    };
    let binary: u8 = cursor.text("0 for ASCII or 1 for binary")?;
    if cursor.text::<u8>("8, the bytes of a number")? != 8 {
        return Err(cursor.wrong("numbers of 8 bytes"));
    }
    match binary {
        0 => (),
        1 => cursor.encoding = byte_order(cursor)?,
        _ => return Err(cursor.wrong("0 for ASCII or 1 for binary")),
    }
    cursor.end("MeshFormat")?;
    Ok(version)
}

fn byte_order(cursor: &mut Cursor<'_>) -> Result<Encoding, FormatError> {
    cursor.skip_line_end();
    cursor.encoding = Encoding::Binary { big_endian: false };
    match cursor.integer("the integer 1")? {
        1 => Ok(Encoding::Binary { big_endian: false }),
        0x0100_0000 => Ok(Encoding::Binary { big_endian: true }),
        _ => Err(cursor.wrong("the integer 1 before this place, in either byte order")),
    }
}

/// The names of groups of lines; those of other dimensions are passed.
fn physical_names(cursor: &mut Cursor<'_>) -> Result<BTreeMap<i32, String>, FormatError> {
    let count: u64 = cursor.text("the number of physical names")?;
    let mut names = BTreeMap::new();
    for _ in 0..count {
        let dimension: u8 = cursor.text("the dimension of a physical group")?;
        let group: i32 = cursor.text("the number of a physical group")?;
        let name = cursor.quoted()?;
        if dimension == 1 && names.insert(group, name).is_some() {
            return Err(cursor.wrong("one name for each physical group"));
        }
    }
    Ok(names)
}
