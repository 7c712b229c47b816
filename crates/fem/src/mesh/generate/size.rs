use super::outline::bounds;
use super::plane::{distance, norm};
use crate::Point;

/// Sources of a leaf of the tree.
const TOGETHER: usize = 8;

/// The wanted size of cells: `h(x) = min(largest, h_i + growth |x − x_i|)` over sources i on the bodies.
///
/// It is Lipschitz continuous with the constant `growth`.
#[derive(Debug)]
pub(super) struct SizeField {
    largest: f64,
    growth: f64,
    root: Option<Node>,
}

/// A size that is wanted at a point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Source {
    pub at: Point,
    pub size: f64,
}

impl Source {
    /// Cells are to be no larger than this edge next to it: lines of rectangles may be closer than the bodies ask.
    pub fn of_edge([a, b, middle]: [Point; 3]) -> Self {
        Self { at: middle, size: distance(a, b) }
    }
}

/// Some sources, left out together when they are too far away to matter.
#[derive(Debug)]
struct Node {
    bounds: [Point; 2],
    smallest: f64,
    parts: Parts,
}

#[derive(Debug)]
enum Parts {
    Halves(Box<[Node; 2]>),
    Sources(Vec<Source>),
}

impl Node {
    fn new(sources: &[Source]) -> Self {
        let parts = if sources.len() > TOGETHER {
            let (first, second) = sources.split_at(sources.len() / 2);
            Parts::Halves(Box::new([Self::new(first), Self::new(second)]))
        } else {
            Parts::Sources(sources.to_vec())
        };
        Self {
            bounds: bounds(&sources.iter().map(|source| source.at).collect::<Vec<_>>()),
            smallest: sources.iter().map(|source| source.size).fold(f64::INFINITY, f64::min),
            parts,
        }
    }
}

impl SizeField {
    pub fn new(largest: f64, growth: f64, sources: &[Source]) -> Self {
        let root = (!sources.is_empty()).then(|| Node::new(sources));
        Self { largest, growth, root }
    }

    /// At a point.
    pub fn at(&self, p: Point) -> f64 {
        self.least(|[lower, upper]| {
            norm([0, 1].map(|d| (lower[d] - p[d]).max(p[d] - upper[d]).max(0.0)))
        })
    }

    /// The least on the whole line where coordinate `axis` has this value.
    pub fn on_line(&self, axis: usize, value: f64) -> f64 {
        self.least(|[lower, upper]| (lower[axis] - value).max(value - upper[axis]).max(0.0))
    }

    /// The least size when `to` is the distance from a rectangle; a source is one without extent.
    fn least(&self, to: impl Fn([Point; 2]) -> f64) -> f64 {
        let Some(root) = &self.root else { return self.largest };
        let bound = |node: &Node| node.smallest + self.growth * to(node.bounds);
        let mut least = self.largest;
        let mut stack = vec![(bound(root), root)];
        while let Some((lower, node)) = stack.pop() {
            if lower >= least {
                continue;
            }
            match &node.parts {
                Parts::Sources(sources) => {
                    let sizes = sources.iter().map(|s| s.size + self.growth * to([s.at; 2]));
                    least = sizes.fold(least, f64::min);
                }
                Parts::Halves(halves) => {
                    let [a, b] = halves.each_ref().map(|half| (bound(half), half));
                    stack.extend(if a.0 < b.0 { [b, a] } else { [a, b] }); // the nearer first
                }
            }
        }
        least
    }
}

#[cfg(test)]
mod tests {
    use super::{SizeField, Source};

    /// Leaving parts of the tree out changes nothing: the field is the minimum over all sources.
    #[test]
    fn the_tree_does_not_show() {
        let at = |k: u32| [f64::from(k).sin(), f64::from(k % 7)];
        let size = |k: u32| 0.01 * f64::from(1 + k % 5);
        let sources: Vec<_> = (0..200).map(|k| Source { at: at(k), size: size(k) }).collect();
        let field = SizeField::new(0.5, 0.3, &sources);
        for k in 0..100 {
            let p = [0.07 * f64::from(k) - 2.0, 0.1 * f64::from(k)];
            let cone = |s: &Source, d: f64| s.size + 0.3 * d;
            let near = sources.iter().map(|s| cone(s, (p[0] - s.at[0]).hypot(p[1] - s.at[1])));
            assert!((field.at(p) - near.fold(0.5, f64::min)).abs() < 1e-14);
            let line = sources.iter().map(|s| cone(s, (p[1] - s.at[1]).abs()));
            assert!((field.on_line(1, p[1]) - line.fold(0.5, f64::min)).abs() < 1e-14);
        }
    }
}
