//! What every report must be, whatever the data.

use super::Report;
use super::wellformed::elements;

/// Values that have broken plots before.
pub(super) const HOSTILE: [f64; 12] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MAX,
    f64::MIN,
    f64::MIN_POSITIVE,
    5e-324,
    -0.0,
    0.0,
    1.0,
    -1e17,
    1e-12,
];

/// Text that has broken pages before.
pub(super) const HOSTILE_TEXT: &str =
    "</script><script>alert('1')</script> & \"*_{x}^{\\ ]]> \u{0}\u{1b} <!-- ×";

/// Pseudo-random numbers from a seed (Knuth's MMIX congruence).
pub(super) struct Dice(pub u64);

impl Dice {
    /// A number below `bound`.
    pub(super) fn below(&mut self, bound: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).expect("31 bits") % bound
    }

    /// `count` hostile values.
    pub(super) fn hostile(&mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| HOSTILE[self.below(HOSTILE.len())]).collect()
    }
}

/// Asserts that the page and the figures are well-formed, draw finite numbers only, and load
/// nothing.
pub(super) fn assert_sound(report: &Report) {
    let page = ("page".to_string(), report.page.clone());
    for (name, text) in report.figures.iter().chain([&page]) {
        let found = elements(text).unwrap_or_else(|wrong| panic!("{name}: {wrong}"));
        for (key, value) in found.iter().flat_map(|element| &element.attributes) {
            // Pictures in base64 may hold any letters.
            let is_text = matches!(key.as_str(), "aria-label" | "class" | "href");
            assert!(
                is_text || !value.contains("NaN") && !value.contains("inf"),
                "{name}: {key}={value}"
            );
            let loads = matches!(key.as_str(), "src" | "href") && !value.starts_with(['#', 'd']);
            assert!(!loads, "{name}: {key}={value}");
        }
        let links = found.iter().filter(|e| e.tag == "link").count();
        assert!(links == 0 && !text.contains("@import") && !text.contains("url("), "{name}");
        let scripts = found.iter().filter(|e| e.tag == "script").count();
        assert!(
            scripts == if text.contains("id=\"frames\"") { 2 } else { 0 },
            "{name}: {scripts} scripts"
        );
    }
}
