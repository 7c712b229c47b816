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
pub const CASES: &[BuiltIn] = &[BuiltIn {
    name: "piston",
    about: "Burgers piston on a spring: the paper's section 4, full-order and reduced (about 2 s)",
    text: include_str!("../../../cases/piston/case.toml"),
}];

/// The case called `name`.
pub fn find(name: &str) -> Option<&'static BuiltIn> {
    CASES.iter().find(|case| case.name == name)
}
