//! Speed, pressure and vorticity at one time, and a slider that moves the time where scripts run.

use serde_json::{Value, json};

use super::FlowReport;
use super::film::{Film, View};
use super::outlines;
use crate::report::figure::{Axis, Figure, HeatMap, WIDTH};
use crate::report::html::{Section, controls, rounded, script};
use crate::report::number::short;

/// Most that the pictures may take of a page, in bytes; of more, every other is left out.
const BUDGET: usize = 4_200_000;

/// Highest picture, in units of the figure.
const HEIGHT: f64 = 560.0;

pub(super) fn section(report: &FlowReport) -> Section {
    let section = Section::new("The flow at a glance");
    let Some(film) = report.scene.film.as_ref().filter(|film| !film.times().is_empty()) else {
        return section.paragraph("There are no pictures of this flow: none were recorded.");
    };
    let last = film.times().len() - 1;
    let maps: Vec<ViewMap> = View::ALL.map(|view| ViewMap::new(film, view)).into();
    let figure = |map: &ViewMap| map.figure(report, last);
    let figures: Vec<Figure> = maps.iter().map(figure).collect();
    if last == 0 {
        return figures.into_iter().fold(section, Section::figure);
    }
    let views = View::ALL.map(|view| (view.name(), view.name()));
    let section = figures.into_iter().fold(section.raw(&controls(&views)), Section::figure);
    section.raw(&script(&frames(report, &maps), include_str!("pictures.js")))
}

/// A view with its colours.
struct ViewMap<'a> {
    film: &'a Film,
    view: View,
    range: (f64, f64),
}

impl<'a> ViewMap<'a> {
    fn new(film: &'a Film, view: View) -> Self {
        Self { film, view, range: film.range(view) }
    }

    fn map(&self, k: usize) -> HeatMap {
        let (x, y) = self.film.nodes();
        let values = self.film.picture(self.view, k);
        let map = HeatMap::new((Axis::new("*x*", "m"), x), (Axis::new("*y*", "m"), y), values)
            .values(self.view.name(), self.view.unit());
        match self.view {
            View::Vorticity => map.limit(self.range.1),
            View::Speed | View::Pressure => map.range(self.range.0, self.range.1),
        }
    }

    fn figure(&self, report: &FlowReport, k: usize) -> Figure {
        let bodies = outlines::solids(report, self.film.times()[k]);
        let map = bodies.into_iter().fold(self.map(k), HeatMap::curves);
        map.draw_equal(WIDTH, HEIGHT).figure(self.view.name(), &self.caption(report, k))
    }

    fn caption(&self, report: &FlowReport, k: usize) -> String {
        let what = match self.view {
            View::Speed => "Speed |*u*|",
            View::Pressure => "Pressure *p*",
            View::Vorticity => "Vorticity ∂*v*/∂*x* − ∂*u*/∂*y*",
        };
        let when = if report.settings.steady {
            " of the steady flow".to_string()
        } else {
            format!(" at *t* = {} s", short(self.film.times()[k]))
        };
        let slider = match k {
            0 => "",
            _ => ", and with the slider at any other time, in the same colours",
        };
        let colours = match self.view {
            View::Speed => "",
            View::Pressure => " The few places with more or less have the last colours.",
            View::Vorticity => {
                " Red turns counterclockwise, blue clockwise; the layers at the walls, where it is larger \
                 than the colours go, have the last ones."
            }
        };
        format!("{what}{when}{slider}.{colours}")
    }
}

/// The pictures as PNG in base64, and where the bodies are.
fn frames(report: &FlowReport, maps: &[ViewMap]) -> Value {
    let film = maps[0].film;
    let mut times: Vec<usize> = (0..film.times().len()).collect();
    let picture = |map: &ViewMap, k: usize| {
        let uri = map.map(k).uri().unwrap_or_default();
        uri.split_once(',').map_or(String::new(), |(_, data)| data.to_owned())
    };
    let mut pictures: Vec<Vec<String>> =
        maps.iter().map(|map| times.iter().map(|&k| picture(map, k)).collect()).collect();
    while pictures.iter().flatten().map(String::len).sum::<usize>() > BUDGET && times.len() > 2 {
        // From the end, so that the last one stays.
        let last = times.len() - 1;
        halve(&mut times, last);
        for all in &mut pictures {
            halve(all, last);
        }
    }
    let seconds: Vec<f64> = times.iter().map(|&k| film.times()[k]).collect();
    json!({
        "start": times.len() - 1,
        "t": seconds.iter().map(|&t| rounded(t)).collect::<Vec<_>>(),
        "views": maps.iter().zip(pictures).map(|(map, pictures)| json!({
            "name": map.view.name(),
            "pictures": pictures,
        })).collect::<Vec<_>>(),
        "bodies": outlines::frames(report, &seconds),
    })
}

/// Leaves out every other one, not the last.
fn halve<T>(items: &mut Vec<T>, last: usize) {
    let mut place = 0;
    items.retain(|_| {
        place += 1;
        (last + 1 - place).is_multiple_of(2)
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halving_keeps_the_last() {
        for count in 2..9_usize {
            let mut items: Vec<usize> = (0..count).collect();
            halve(&mut items, count - 1);
            assert_eq!(items.last(), Some(&(count - 1)));
            assert_eq!(items.len(), count.div_ceil(2));
        }
    }
}
