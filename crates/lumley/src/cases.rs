//! The cases that come with lumley.

/// A case file that is part of the program.
///
/// ```
/// let piston = lumley::cases::find("piston").expect("it comes with lumley");
/// assert!(piston.text.contains("[piston]"));
/// ```
#[derive(Debug, Clone, Copy)]
pub struct BuiltIn {
    /// Its name.
    pub name: &'static str,
    /// What it is, in one line.
    pub about: &'static str,
    /// The case file.
    pub text: &'static str,
}

/// All of them.
pub const CASES: &[BuiltIn] = &[
    BuiltIn {
        name: "piston",
        about: "Burgers piston on a spring: the paper's section 4, full-order and reduced (about 2 s)",
        text: include_str!("../../../cases/piston/case.toml"),
    },
    BuiltIn {
        name: "cavity",
        about: "square cavity under a moving lid, Re = 1000, steady",
        text: include_str!("../../../cases/cavity/case.toml"),
    },
    BuiltIn {
        name: "cylinder-2d1",
        about: "cylinder in a channel, Re = 20, steady: Schaefer and Turek's benchmark 2D-1",
        text: include_str!("../../../cases/cylinder-2d1/case.toml"),
    },
    BuiltIn {
        name: "cylinder-2d2",
        about: "vortex street in a channel, Re = 100, with POD: Schaefer and Turek's benchmark 2D-2",
        text: include_str!("../../../cases/cylinder-2d2/case.toml"),
    },
    BuiltIn {
        name: "oscillating-cylinder",
        about: "cylinder that is moved up and down in a uniform stream, Re = 185, on a moving mesh",
        text: include_str!("../../../cases/oscillating-cylinder/case.toml"),
    },
    BuiltIn {
        name: "pendulum",
        about: "disc on a hinged bar in a stream, Re = 100, and its POD: the paper's section 3 (about a minute)",
        text: include_str!("../../../cases/pendulum/case.toml"),
    },
    BuiltIn {
        name: "viv",
        about: "cylinder on a spring across a stream, Re = 100: vortex-induced vibration",
        text: include_str!("../../../cases/viv/case.toml"),
    },
    BuiltIn {
        name: "massless-cylinder",
        about: "cylinder without mass or spring that a stream moves across itself, Re = 100",
        text: include_str!("../../../cases/massless-cylinder/case.toml"),
    },
    BuiltIn {
        name: "tube-pair",
        about: "two tubes on springs, one behind the other, Re = 100",
        text: include_str!("../../../cases/tube-pair/case.toml"),
    },
    BuiltIn {
        name: "falling-disc",
        about: "disc that sinks in a closed channel under gravity",
        text: include_str!("../../../cases/falling-disc/case.toml"),
    },
];

/// The case called `name`.
pub fn find(name: &str) -> Option<&'static BuiltIn> {
    CASES.iter().find(|case| case.name == name)
}
