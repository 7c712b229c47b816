//! The legend: samples and names in rows above a plot, where they hide no data.

use super::curves::Curves;
use super::frame::FONT;
use super::series::Series;
use super::svg::{Attributes, Px, Svg};
use crate::report::markup;

/// Height of one row.
const ROW: f64 = 18.0;

/// A line of the legend: what it is called, and how it looks.
#[derive(Debug, Clone, Copy)]
pub(super) struct Entry<'a> {
    name: &'a str,
    sample: Sample<'a>,
}

#[derive(Debug, Clone, Copy)]
enum Sample<'a> {
    Series(&'a Series),
    Curves(&'a Curves),
    Band,
}

impl<'a> Entry<'a> {
    pub(super) fn of_series(series: &'a Series) -> Self {
        Self { name: &series.name, sample: Sample::Series(series) }
    }

    pub(super) fn of_curves(curves: &'a Curves) -> Self {
        Self { name: &curves.name, sample: Sample::Curves(curves) }
    }

    pub(super) fn of_band(name: &'a str) -> Self {
        Self { name, sample: Sample::Band }
    }

    /// Draws the sample, 22 units wide, beside the text whose baseline is at `y`.
    fn draw_sample(&self, svg: &mut Svg, x: f64, y: f64) {
        match self.sample {
            Sample::Series(series) => series.draw_sample(svg, x, y - 4.0),
            Sample::Curves(curves) => {
                let d = format!("M{} {}h22", Px(x), Px(y - 4.0));
                svg.element("path", &[("class", &curves.class()), ("d", &d)]);
            }
            Sample::Band => {
                let top = Px(y - 10.0);
                let place: Attributes = &[
                    ("class", &"band"),
                    ("x", &Px(x)),
                    ("y", &top),
                    ("width", &22),
                    ("height", &12),
                ];
                svg.element("rect", place);
            }
        }
    }
}

/// Draws the entries that have a name in rows of at most `width` and returns their height.
pub(super) fn draw(svg: &mut Svg, width: f64, entries: &[Entry]) -> f64 {
    let cells = layout(width, entries.iter().map(|entry| entry.name));
    for (entry, cell) in entries.iter().zip(&cells) {
        if let &Some((x, y, name)) = cell {
            entry.draw_sample(svg, x, y);
            svg.text(x + 28.0, y, "key", name);
        }
    }
    cells.iter().flatten().next_back().map_or(0.0, |(_, y, _)| y + 8.0)
}

/// Where each named entry stands (left end, baseline); an entry without a name has no place.
fn layout<'a>(
    width: f64,
    names: impl Iterator<Item = &'a str>,
) -> Vec<Option<(f64, f64, &'a str)>> {
    let (mut x, mut y) = (0.0, FONT);
    names
        .map(|name| {
            if name.is_empty() {
                return None;
            }
            let needed = 28.0 + FONT * markup::width(name);
            if x > 0.0 && x + needed > width {
                (x, y) = (0.0, y + ROW);
            }
            let cell = (x, y, name);
            x += needed + 20.0;
            Some(cell)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_wrap_and_nameless_ones_take_no_place() {
        let cells = layout(200.0, ["first model", "", "second model", "third"].into_iter());
        assert_eq!(cells[0].map(|c| (c.0, c.1)), Some((0.0, FONT)));
        assert_eq!(cells[1], None);
        assert_eq!(cells[2].map(|c| (c.0, c.1)), Some((0.0, FONT + ROW)));
        assert!(cells[3].is_some_and(|c| c.0 > 100.0 || c.1 > FONT + ROW));
    }
}
