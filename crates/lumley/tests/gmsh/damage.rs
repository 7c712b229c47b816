use crate::{CORNERS, Outcome, TRIANGLE, data, parse, text};
use lumley::format::FormatError;
use lumley::format::gmsh::GmshError;

fn of_mesh(bytes: &str) -> GmshError {
    match parse(bytes.as_bytes()).expect_err(bytes) {
        FormatError::Gmsh { source, path } => {
            assert!(path.ends_with("x.msh"));
            source
        }
        error => panic!("{bytes}: {error}"),
    }
}

#[test]
fn meshes_that_cannot_be_used_are_named() {
    let out_of_plane = text(&["1 0 0 0", "2 1 0 0.5", "4 0 1 0"], &TRIANGLE);
    assert_eq!(of_mesh(&out_of_plane), GmshError::NotPlanar { node: 2, z: 0.5 });
    let lines = text(&CORNERS, &TRIANGLE[1..]);
    assert_eq!(of_mesh(&lines), GmshError::NoCells);
    let missing = text(&CORNERS[..2], &TRIANGLE);
    assert_eq!(of_mesh(&missing), GmshError::NoSuchNode { element: 1, node: 4 });
    let twice = text(&["1 0 0 0", "2 1 0 0", "4 0 1 0", "2 1 0 0"], &TRIANGLE);
    assert_eq!(of_mesh(&twice), GmshError::NodeTwice { node: 2 });
    let both = [&TRIANGLE[..], &["5 1 2 2 1 1 2"]].concat();
    assert!(matches!(of_mesh(&text(&CORNERS, &both)), GmshError::TwoNames { .. }));
    let bent = [&CORNERS[..], &["5 .5 -.1 0"]].concat();
    let middles = ["2 8 2 1 1 1 2 5", "3 8 2 1 1 2 1 4"];
    let elements = [&TRIANGLE[..1], &middles].concat();
    assert!(matches!(of_mesh(&text(&bent, &elements)), GmshError::TwoMiddles { .. }));
}

/// What is not of the format: file, line and what was expected.
#[test]
fn foreign_text_is_refused() {
    let sound = text(&CORNERS, &TRIANGLE);
    assert!(parse(sound.as_bytes()).is_ok());
    let changes = [
        ("$MeshFormat", "$Nodes", 1),
        ("2.2 0 8", "4.0 0 8", 2),
        ("2.2 0 8", "2.2 2 8", 2),
        ("2.2 0 8", "2.2 0 4", 2),
        ("$EndMeshFormat", "$End", 3),
        ("1 2 \"hole\"", "1 2 hole", 7),
        ("1 2 \"hole\"", "1 2 \"hole", 7),
        ("$Nodes\n3", "$Nodes\n1000000000000000000", 11),
        ("$Nodes\n3", "$Nodes\n18446744073709551616", 11),
        ("$Nodes\n3", "$Nodes\n-3", 11),
        ("2 1 0 0", "2 1 nan 0", 13),
        ("2 1 0 0", "2 1 1e999 0", 13),
        ("2 1 0 0", "-2 1 0 0", 13),
        ("$EndNodes", "1 1 1 1\n$EndNodes", 15),
        ("$Elements\n4", "$Elements\n1000000000000000000", 17),
        ("1 2 2 9 1 1 2 4", "1 4 2 9 1 1 2 4 4", 18),
        ("1 2 2 9 1 1 2 4", "1 2 2000000000 9 1 1 2 4", 18),
        ("1 2 2 9 1 1 2 4", "1 2 2 9 1 1 2 x", 18),
    ];
    for (from, to, expected) in changes {
        let error = parse(sound.replacen(from, to, 1).as_bytes()).expect_err(to);
        let FormatError::Line { line, path, .. } = &error else { panic!("{to}: {error}") };
        assert!(path.ends_with("x.msh"));
        assert!(line.abs_diff(expected) <= 1, "{to}: line {line}, expected {expected}: {error}");
    }
    let twice = format!("{sound}$Nodes\n0\n$EndNodes\n");
    assert!(parse(twice.as_bytes()).is_err(), "a section twice");
    let comment = format!("{sound}$Comments\nmade by hand $5\n$EndComments\n");
    assert!(parse(comment.as_bytes()).is_ok(), "other sections are passed");
    for bytes in [&b""[..], b"$", b"$MeshFormat", b"\xff\xfe", b"PK\x03\x04", &[b'$'; 10_000]] {
        assert!(parse(bytes).is_err());
    }
}

/// Files cut anywhere.
#[test]
fn truncated_files_are_found() -> Outcome {
    for name in ["v22_ascii_1.msh", "v22_binary_1.msh", "v41_ascii_1.msh", "v41_binary_1.msh"] {
        let whole = std::fs::read(data(name))?;
        for cut in (0..whole.len() - 1).step_by(7).chain([whole.len() - 2]) {
            let error = parse(&whole[..cut]).expect_err("truncated").to_string();
            assert!(error.contains("x.msh") && error.len() < 600, "{name}, {cut} bytes: {error}");
        }
    }
    Ok(())
}

/// Thousands of files with a few bytes overwritten: an error or a mesh of the file's size, never a panic.
#[test]
fn mutations_do_no_harm() -> Outcome {
    let mut state = 7_u64;
    let mut below = |bound: usize| {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(state >> 33).expect("31 bits") % bound
    };
    for name in ["v22_ascii_2.msh", "v22_binary_2.msh", "v41_ascii_2.msh", "v41_binary_2.msh"] {
        let whole = std::fs::read(data(name))?;
        for round in 0..1000 {
            let mut bytes = whole.clone();
            let reach = if round % 2 == 0 { 700 } else { bytes.len() }; // headers, or anywhere
            for _ in 0..=below(4) {
                bytes[below(reach)] = match below(2) {
                    0 => b"0123456789 $\"-.\n"[below(16)],
                    _ => u8::try_from(below(256))?,
                };
            }
            if let Ok(mesh) = parse(&bytes) {
                assert!(mesh.points.len() < whole.len());
            }
        }
    }
    Ok(())
}

/// Binary files of the other byte order are read: every number of the small one turned round.
#[test]
fn big_endian_files_are_read() -> Outcome {
    let file = |turn: fn(&mut [u8])| {
        let int = |value: i32| turned(&value.to_le_bytes(), turn);
        let node = |number: i32, at: [f64; 3]| {
            let floats = at.iter().flat_map(|x| turned(&x.to_le_bytes(), turn));
            int(number).into_iter().chain(floats).collect::<Vec<u8>>()
        };
        let ints = |values: &[i32]| values.iter().flat_map(|v| int(*v)).collect::<Vec<u8>>();
        [
            b"$MeshFormat\n2.2 1 8\n".to_vec(),
            int(1),
            b"\n$EndMeshFormat\n$PhysicalNames\n1\n1 1 \"rim\"\n$EndPhysicalNames\n$Nodes\n3\n"
                .to_vec(),
            node(1, [0.0; 3]),
            node(2, [1.0, 0.0, 0.0]),
            node(4, [0.0, 1.0, 0.0]),
            b"\n$EndNodes\n$Elements\n4\n".to_vec(),
            ints(&[2, 1, 2, 1, 9, 1, 1, 2, 4]),
            ints(&[1, 3, 2, 2, 1, 1, 1, 2, 3, 1, 1, 2, 4, 4, 1, 1, 4, 1]),
            b"\n$EndElements\n".to_vec(),
        ]
        .concat()
    };
    let little = parse(&file(|_| ()))?;
    assert_eq!(little, parse(text(&CORNERS, &TRIANGLE).as_bytes())?);
    assert_eq!(little, parse(&file(<[u8]>::reverse))?);
    Ok(())
}

fn turned(bytes: &[u8], turn: fn(&mut [u8])) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    turn(&mut bytes);
    bytes
}
