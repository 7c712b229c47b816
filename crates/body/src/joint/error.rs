/// Why a joint is not a physical one.
///
/// ```
/// use lumley_body::joint::Prismatic;
/// let block = Prismatic { mass: -0.5, stiffness: 39.5, damping: 0.1, rest_length: 0.95 };
/// let error = block.check().unwrap_err();
/// assert_eq!(error.to_string(), "mass is -0.5 kg, expected a finite number above 0");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum JointError {
    /// A quantity outside of its physical range.
    #[error("{name} is {value} {unit}, expected {expected}")]
    Quantity {
        /// Its name.
        name: &'static str,
        /// The value found.
        value: f64,
        /// Its unit.
        unit: &'static str,
        /// What was expected.
        expected: &'static str,
    },
}
