/// Why a formula cannot be read.
///
/// ```
/// use lumley::case::formula::{Formula, Variables};
/// let error = Formula::read("sin(x", Variables::Place).unwrap_err();
/// assert_eq!(error.to_string(), "\")\" or an operation at character 6, where the formula ends");
/// ```
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{expected} at character {column}, {}", place(.found))]
pub struct FormulaError {
    /// Where, in characters from 1.
    pub column: usize,
    /// What stands there; nothing at the end.
    pub found: String,
    /// What was expected.
    pub expected: String,
}

fn place(found: &str) -> String {
    if found.is_empty() { "where the formula ends".into() } else { format!("found \"{found}\"") }
}
