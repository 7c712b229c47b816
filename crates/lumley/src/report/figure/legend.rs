//! The legend: samples and names in rows above a plot, where they hide no data.

use super::frame::FONT;
use super::series::Series;
use super::svg::{Px, Svg};
use crate::report::markup;

/// Height of one row.
const ROW: f64 = 18.0;

/// Draws the entries in rows of at most `width` and returns their height: the series with a name,
/// then the shaded band if it has one.
pub(super) fn draw(svg: &mut Svg, width: f64, series: &[Series], band: Option<&str>) -> f64 {
    let names = series.iter().map(|s| s.name.as_str()).chain(band);
    let cells = layout(width, names);
    for (series, cell) in series.iter().zip(&cells) {
        if let &Some((x, y, _)) = cell {
            series.draw_sample(svg, x, y - 4.0);
        }
    }
    if let (Some(_), Some(&Some((x, y, _)))) = (band, cells.last()) {
        let size = [("x", Px(x)), ("y", Px(y - 10.0)), ("width", Px(22.0)), ("height", Px(12.0))];
        let [a, b, c, d] = &size;
        svg.element(
            "rect",
            &[("class", &"band"), (a.0, &a.1), (b.0, &b.1), (c.0, &c.1), (d.0, &d.1)],
        );
    }
    for (x, y, name) in cells.iter().flatten() {
        svg.text(x + 28.0, *y, "key", name);
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
