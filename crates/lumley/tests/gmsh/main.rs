//! Meshes of gmsh: what gmsh writes is read, and no file does harm.
//!
//! The files in `data` are one mesh, written by gmsh 4.15 in its formats: a channel 3 m x 1 m with a disc of
//! radius 0.2 m, triangles for x < 2 m and quadrilaterals beyond.

mod damage;
mod read;

use lumley_fem::MeshDescription;
use std::path::PathBuf;

type Outcome = Result<(), Box<dyn std::error::Error>>;

fn data(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/gmsh/data").join(name)
}

/// A file of version 2.2 with these nodes and elements, and the physical groups 1 `rim` and 2 `hole`.
fn text(nodes: &[&str], elements: &[&str]) -> String {
    let counted = |lines: &[&str]| format!("{}\n{}\n", lines.len(), lines.join("\n"));
    format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n\
         $PhysicalNames\n3\n1 1 \"rim\"\n1 2 \"hole\"\n2 9 \"the fluid\"\n$EndPhysicalNames\n\
         $Nodes\n{}$EndNodes\n$Elements\n{}$EndElements\n",
        counted(nodes),
        counted(elements)
    )
}

const CORNERS: [&str; 3] = ["1 0 0 0", "2 1 0 0", "4 0 1 0"];
const TRIANGLE: [&str; 4] = ["1 2 2 9 1 1 2 4", "2 1 2 1 1 1 2", "3 1 2 1 1 2 4", "4 1 2 1 1 4 1"];

/// Reads a file with this content.
fn parse(bytes: &[u8]) -> Result<MeshDescription, lumley::format::FormatError> {
    let folder = tempfile::tempdir().expect("a temporary directory");
    let path = folder.path().join("x.msh");
    std::fs::write(&path, bytes).expect("a file");
    lumley::format::gmsh::read(path)
}
