use crate::{BOX, DUCT, flow_at, with};
use lumley::case::{Case, Start};
use lumley_fom::flow::Condition;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// Two triangles on the unit square, with a name for each side.
const SQUARE: &str = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n\
    $PhysicalNames\n4\n1 1 \"bottom\"\n1 2 \"right\"\n1 3 \"top\"\n1 4 \"left\"\n$EndPhysicalNames\n\
    $Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n\
    $Elements\n6\n1 1 2 1 1 1 2\n2 1 2 2 2 2 3\n3 1 2 3 3 3 4\n4 1 2 4 4 4 1\n\
    5 2 2 9 9 1 2 3\n6 2 2 9 9 1 3 4\n$EndElements\n";

fn desk(files: &[(&str, &str)]) -> TempDir {
    let desk = tempfile::tempdir().expect("a folder");
    for (name, text) in files {
        fs::write(desk.path().join(name), text).expect("a file");
    }
    desk
}

fn refused(folder: &Path, text: &str, words: &[&str]) {
    let path = folder.join("case.toml");
    let error = Case::parse(&path, text, false, &[]).expect_err("it is wrong").to_string();
    for word in words {
        assert!(error.contains(word), "no {word:?} in: {error}");
    }
}

fn meshed(file: &str) -> String {
    with(BOX, "x = [0, 1]\ny = [0, 2]\ncells = [2, 4]", &format!("file = \"{file}\""))
}

#[test]
fn a_mesh_comes_from_a_file_beside_the_case() {
    let desk = desk(&[("square.msh", SQUARE), ("noise.msh", "noise")]);
    let path = desk.path().join("case.toml");
    let case = flow_at(&path, &meshed("square.msh"));
    assert_eq!(case.mesh.topology().triangles().len(), 2);
    let kept = case.kept();
    assert_eq!(kept.inputs[0].name, "mesh.msh");
    assert_eq!(kept.inputs[0].path, desk.path().join("square.msh"));
    assert!(kept.case.contains("file = \"mesh.msh\""), "{}", kept.case);
    refused(desk.path(), &meshed("none.msh"), &["case.toml, line ", "mesh.file", "none.msh"]);
    refused(desk.path(), &meshed("noise.msh"), &["mesh.file", "noise.msh", ".msh file of gmsh"]);
}

/// What is replaced in a sound mesh, and what the error says.
type Damage<'a> = (&'a [(&'a str, &'a str)], &'a [&'a str]);

/// Meshes that gmsh would write of a bad geometry: the case, its line, what is wrong and what to do.
#[test]
fn bad_meshes_are_refused() {
    let changes: [Damage<'_>; 6] = [
        (
            &[("Elements\n6", "Elements\n7"), ("$EndE", "7 2 2 9 9 1 2 3\n$EndE")],
            &["cell 0 near", "cell 2 have the same corners", "remove"],
        ),
        (
            &[
                ("3 1 1 0", "3 .1 .1 0"),
                ("Elements\n6", "Elements\n5"),
                ("5 2 2 9 9 1 2 3\n6 2 2 9 9 1 3 4", "5 3 2 9 9 1 2 3 4"),
            ],
            &["cell 0 near (0.1, 0.1) m", "expected above 0", "tangled"],
        ),
        (&[("3 1 1 0", "3 1 0 0")], &["in the same place", "merge them"]),
        (&[("4 1 2 4 4 4 1", "4 1 2 5 4 4 1")], &["1 edges of the rim have no name", "(0, 1)"]),
        (&[("6 2 2 9 9 1 3 4", "6 2 2 9 9 1 3 5")], &["node 5", "bad.msh"]),
        (&[("3 1 1 0", "3 1 1 0.5")], &["z = 0.5", "bad.msh"]),
    ];
    for (replaced, words) in changes {
        let bad = replaced.iter().fold(SQUARE.to_owned(), |text, (from, to)| with(&text, from, to));
        let desk = desk(&[("bad.msh", &bad)]);
        refused(desk.path(), &meshed("bad.msh"), words);
        refused(desk.path(), &meshed("bad.msh"), &["case.toml, line "]);
    }
    // What harms nothing is taken: cells that run clockwise, and points that no cell has.
    let turned = with(SQUARE, "5 2 2 9 9 1 2 3", "5 2 2 9 9 1 3 2");
    let loose = with(&with(&turned, "Nodes\n4", "Nodes\n5"), "$EndN", "5 9 9 0\n$EndN");
    let desk = desk(&[("loose.msh", &loose)]);
    let mesh = flow_at(&desk.path().join("case.toml"), &meshed("loose.msh")).mesh;
    assert_eq!((mesh.topology().triangles().len(), mesh.nodes().len()), (2, 9));
}

#[test]
fn tables_are_linear_in_time_and_constant_beyond() {
    let desk = desk(&[("in.csv", "t, u, v\n1, 0, 0\n2, 3, 0\n")]);
    let text = with(DUCT, "velocity = [\"y*(1 - y)*sin(t)\", 0]\nramp = 0.5", "table = \"in.csv\"");
    let case = flow_at(&desk.path().join("case.toml"), &text);
    let left = case.conditions.iter().find(|(name, _)| name == "left");
    let Some((_, Condition::Velocity(field))) = left else { panic!("left has a velocity") };
    assert_eq!([0.0, 1.5, 9.0].map(|t| field.value([0.0, 0.5], t)[0]), [0.0, 1.5, 3.0]);
    let names: Vec<String> = case.kept().inputs.into_iter().map(|file| file.name).collect();
    assert_eq!(names, ["velocity-1.csv"]);
}

#[test]
fn a_kept_case_stands_alone() {
    let desk = desk(&[("square.msh", SQUARE), ("in.csv", "0,1,0\n")]);
    let text = with(&meshed("square.msh"), "velocity = [1, 0]", "table = \"in.csv\"");
    let text = with(&text, "[steady]", "[time]\nend = 1.0\nstep = 0.1");
    let case = flow_at(&desk.path().join("case.toml"), &text);
    let run = tempfile::tempdir().expect("a folder");
    let kept = case.kept();
    for input in &kept.inputs {
        fs::copy(&input.path, run.path().join(&input.name)).expect("copied");
    }
    let again = flow_at(&run.path().join("case.toml"), &kept.case);
    assert_eq!((again.kept().case, again.mesh), (kept.case, case.mesh));
}

#[test]
fn wrong_tables_are_refused_with_line_and_value() {
    let text = with(DUCT, "velocity = [\"y*(1 - y)*sin(t)\", 0]", "table = \"in.csv\"");
    for (table, words) in [
        ("0,1\n", ["line 1", "3 finite numbers", "\"0,1\""]),
        ("0,1,0\n0,2,0\n", ["line 2", "increases", "\"0,2,0\""]),
        ("0,1,0\n1,nan,0\n", ["line 2", "finite numbers", "\"1,nan,0\""]),
    ] {
        let desk = desk(&[("in.csv", table)]);
        refused(desk.path(), &text, &words);
        refused(desk.path(), &text, &["case.toml, line ", "flow.boundaries.left.table", "in.csv"]);
    }
}

#[test]
fn a_flow_starts_from_the_end_of_a_run() {
    let desk = desk(&[]);
    fs::create_dir(desk.path().join("before")).expect("a folder");
    let text = with(
        BOX,
        "[flow.boundaries.left]",
        "[flow.initial]\nrun = \"before\"\n[flow.boundaries.left]",
    );
    refused(desk.path(), &text, &["flow.initial = before", "complete run"]);
    fs::write(desk.path().join("before/manifest.json"), "{}").expect("a file");
    let case = flow_at(&desk.path().join("case.toml"), &text);
    assert!(matches!(&case.start, Start::Run(path) if *path == desk.path().join("before")));
    assert!(case.kept().case.contains(desk.path().to_str().expect("a plain path")));
}
