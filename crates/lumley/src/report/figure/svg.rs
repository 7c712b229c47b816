//! A small writer of SVG fragments: every attribute is escaped and every coordinate is finite.

use std::fmt::{self, Display, Write};

use crate::report::markup;

/// The attributes of an element, in order.
pub(super) type Attributes<'a> = &'a [(&'a str, &'a dyn Display)];

/// A length or coordinate in user units, printed with at most two decimals.
#[derive(Debug, Clone, Copy)]
pub(super) struct Px(pub f64);

impl Display for Px {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        assert!(self.0.is_finite(), "a coordinate of a figure is {}", self.0);
        let rounded = (self.0 * 100.0).round() / 100.0;
        write!(f, "{}", if rounded == 0.0 { 0.0 } else { rounded })
    }
}

/// An SVG fragment under construction.
#[derive(Debug, Clone, Default)]
pub(super) struct Svg(String);

impl Svg {
    /// An element without content.
    pub(super) fn element(&mut self, tag: &str, attributes: Attributes) {
        self.start(tag, attributes);
        self.0 += "/>";
    }

    /// An element around whatever `content` writes.
    pub(super) fn wrap(
        &mut self,
        tag: &str,
        attributes: Attributes,
        content: impl FnOnce(&mut Self),
    ) {
        self.start(tag, attributes);
        self.0 += ">";
        content(self);
        let _ = write!(self.0, "</{tag}>");
    }

    /// A line of text in markup; `class` sets its anchor and weight.
    pub(super) fn text(&mut self, x: f64, y: f64, class: &str, text: &str) {
        let content = markup::svg(text);
        self.wrap("text", &[("x", &Px(x)), ("y", &Px(y)), ("class", &class)], |svg| {
            svg.0 += &content;
        });
    }

    /// A straight line.
    pub(super) fn line(&mut self, from: (f64, f64), to: (f64, f64), class: &str) {
        let ends: Attributes = &[
            ("x1", &Px(from.0)),
            ("y1", &Px(from.1)),
            ("x2", &Px(to.0)),
            ("y2", &Px(to.1)),
            ("class", &class),
        ];
        self.element("line", ends);
    }

    /// `other` moved by (`x`, `y`).
    pub(super) fn place(&mut self, x: f64, y: f64, other: &Svg) {
        let shift = format!("translate({} {})", Px(x), Px(y));
        self.wrap("g", &[("transform", &shift)], |svg| svg.0 += &other.0);
    }

    /// `other` where it is.
    pub(super) fn append(&mut self, other: &Svg) {
        self.0 += &other.0;
    }

    /// The text of the fragment.
    pub(super) fn as_str(&self) -> &str {
        &self.0
    }

    fn start(&mut self, tag: &str, attributes: Attributes) {
        let _ = write!(self.0, "<{tag}");
        for (name, value) in attributes {
            let _ = write!(self.0, " {name}=\"{}\"", markup::escape(&value.to_string()));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn attributes_and_text_are_escaped() {
        let mut svg = Svg::default();
        svg.wrap("g", &[("class", &"a\"<b")], |svg| svg.text(1.0, 2.125, "t", "<*x*>"));
        assert_eq!(
            svg.as_str(),
            "<g class=\"a&quot;&lt;b\"><text x=\"1\" y=\"2.13\" class=\"t\">&lt;\
             <tspan class=\"i\">x</tspan>&gt;</text></g>"
        );
    }

    #[test]
    #[should_panic(expected = "a coordinate of a figure is NaN")]
    fn a_coordinate_is_never_nan() {
        let _ = Px(f64::NAN).to_string();
    }
}
