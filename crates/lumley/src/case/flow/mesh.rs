//! The mesh of a case: from a file, or made.

use super::MeshSection;
use crate::case::CaseError;
use crate::case::ask::{Ask, Number};
use crate::format::gmsh;
use lumley_fem::generate::Channel;
use lumley_fem::{MeshDescription, PlanarMesh};
use std::path::Path;

/// Most cells of a mesh that is made.
const MOST_CELLS: usize = 1_000_000;
/// Beyond it the first cell is less than a ten-thousandth of the middle one.
const MOST_CLUSTERING: f64 = 6.0;

/// What a mesh is made from, and the keys that go with it.
const SOURCES: [(&str, &[&str]); 3] = [
    ("file", &[]),
    ("size", &["x", "y", "growth", "triangles", "bodies", "limit"]),
    ("cells", &["x", "y", "clustering", "cut"]),
];

/// Makes or reads the mesh, and checks it.
pub(super) fn build(
    ask: &Ask,
    section: &MeshSection,
    folder: &Path,
) -> Result<PlanarMesh, CaseError> {
    let description = match source(ask, section)? {
        "file" => read(ask, section, folder),
        "size" => channel(ask, section),
        _ => rectangle(ask, section),
    }?;
    let wrong = |source| CaseError::Mesh { place: ask.place("mesh"), source: Box::new(source) };
    PlanarMesh::new(description).map_err(wrong)
}

/// The key that says where the mesh comes from; no key of another source may be there.
fn source(ask: &Ask, section: &MeshSection) -> Result<&'static str, CaseError> {
    let written = section.written();
    let mut named = SOURCES.iter().filter(|(key, _)| written.contains(key));
    let Some((source, own)) = named.next() else {
        let expected = "file = \"x.msh\"; or x, y and size for a channel; or x, y and cells for a \
                        rectangle";
        return Err(ask.missing("mesh", expected));
    };
    let stray = written.iter().find(|key| *key != source && !own.contains(key));
    if let Some(key) = stray {
        let expected = format!("nothing: a mesh that is made from mesh.{source} has no such key");
        return Err(ask.refuse(&format!("mesh.{key}"), "given", &expected));
    }
    Ok(source)
}

impl MeshSection {
    /// The keys that are written.
    fn written(&self) -> Vec<&'static str> {
        let Self { file, x, y, size, growth, triangles, bodies, limit, cells, clustering, cut } =
            self;
        let all = [
            ("file", file.is_some()),
            ("x", x.is_some()),
            ("y", y.is_some()),
            ("size", size.is_some()),
            ("growth", growth.is_some()),
            ("triangles", triangles.is_some()),
            ("bodies", !bodies.is_empty()),
            ("limit", limit.is_some()),
            ("cells", cells.is_some()),
            ("clustering", clustering.is_some()),
            ("cut", cut.is_some()),
        ];
        all.into_iter().filter(|(_, written)| *written).map(|(key, _)| key).collect()
    }

    /// The sides of the domain, in m.
    fn sides(&self, ask: &Ask) -> Result<[[f64; 2]; 2], CaseError> {
        let expected = "the lower and the upper end in m, such as [0, 2.2]";
        let side = |key: &str, ends: Option<[f64; 2]>| {
            let key = format!("mesh.{key}");
            let [lower, upper] = ends.ok_or_else(|| ask.missing(&key, expected))?;
            let ok = lower < upper && (upper - lower).is_finite();
            ask.that(ok, &key, format!("[{lower:?}, {upper:?}]"), expected)?;
            Ok([lower, upper])
        };
        Ok([side("x", self.x)?, side("y", self.y)?])
    }
}

fn read(ask: &Ask, section: &MeshSection, folder: &Path) -> Result<MeshDescription, CaseError> {
    let path = folder.join(section.file.as_deref().unwrap_or_default());
    let place = || ask.place("mesh.file");
    let unreadable = |source| CaseError::MeshFile { place: place(), source: Box::new(source) };
    gmsh::read(path).map_err(unreadable)
}

fn channel(ask: &Ask, section: &MeshSection) -> Result<MeshDescription, CaseError> {
    let [x, y] = section.sides(ask)?;
    let empty = Channel::new(x, y, section.size.unwrap_or_default());
    let channel = Channel {
        growth: section.growth.unwrap_or(empty.growth),
        limit: section.limit.unwrap_or(empty.limit),
        triangles: section.triangles,
        bodies: section.bodies.clone(),
        ..empty
    };
    let place = || ask.place("mesh");
    let wrong = |source| CaseError::Generate { place: place(), source: Box::new(source) };
    channel.mesh().map_err(wrong)
}

fn rectangle(ask: &Ask, section: &MeshSection) -> Result<MeshDescription, CaseError> {
    let sides = section.sides(ask)?;
    let cells = section.cells.unwrap_or_default();
    let count = cells[0].checked_mul(cells[1]).filter(|count| (1..=MOST_CELLS).contains(count));
    let expected = format!("columns and rows, together 1 to {MOST_CELLS} cells");
    ask.that(count.is_some(), "mesh.cells", format!("{cells:?}"), &expected)?;
    let clustering = section.clustering.unwrap_or_default();
    let range = format!("from 0, even, to {MOST_CLUSTERING}");
    for value in clustering {
        let ok = (0.0..=MOST_CLUSTERING).contains(&value);
        ask.that(ok, "mesh.clustering", Number(value), &range)?;
    }
    let cut = section.cut.unwrap_or_default();
    let place = |d: usize, s: f64| {
        let share = clustered(cells[d], clustering[d], s);
        sides[d][0] * (1.0 - share) + sides[d][1] * share
    };
    Ok(MeshDescription::structured(cells, |_| cut, |[s, t]| [place(0, s), place(1, t)]))
}

/// Where `s` from 0 to 1 goes when `n` cells are pressed to both ends. Within a cell it is linear, so that the
/// cells stay affine.
fn clustered(n: usize, strength: f64, s: f64) -> f64 {
    if strength == 0.0 {
        return s;
    }
    let pressed = |s: f64| 0.5 * (1.0 + (strength * (2.0 * s - 1.0)).tanh() / strength.tanh());
    let n = n as f64;
    let cell = (s * n).floor();
    let (lower, upper) = (pressed(cell / n), pressed((cell + 1.0) / n));
    lower + (s * n - cell) * (upper - lower)
}

#[cfg(test)]
mod tests {
    use super::clustered;

    #[test]
    fn clustered_cells_are_affine_symmetric_and_fill_the_side() {
        let n = 9;
        let at = |k: u32| clustered(n, 2.0, f64::from(k) / (2.0 * n as f64));
        assert_eq!((at(0), at(18)), (0.0, 1.0));
        for k in 0..=18 {
            assert!((at(k) + at(18 - k) - 1.0).abs() < 1e-15);
        }
        for cell in 0..9 {
            let middle = 0.5 * (at(2 * cell) + at(2 * cell + 2));
            assert!((at(2 * cell + 1) - middle).abs() < 1e-15);
        }
        assert!(at(2) < 0.5 * (at(10) - at(8)), "cells at the side are smaller");
    }
}
