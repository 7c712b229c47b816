use super::Bounds;
use crate::Point;
use std::ops::Range;

/// Items of a leaf, about.
const LEAF: usize = 4;

/// More than the nodes that can wait in a search: one a level.
const STACK: usize = 64;

/// A balanced binary tree of boxes round items that have boxes.
///
/// Which item is in which leaf is decided once; the boxes may be fitted again as often as the items move.
/// Node k has the children 2 k and 2 k + 1, the root is node 1, the leaves are the last ones.
#[derive(Debug, Clone)]
pub(super) struct BoxTree {
    items: Vec<usize>,
    nodes: Vec<Bounds>,
}

impl BoxTree {
    pub fn new(boxes: &[Bounds]) -> Self {
        let leaves = (boxes.len() / LEAF).max(1).next_power_of_two();
        let (items, nodes) = ((0..boxes.len()).collect(), vec![Bounds::EMPTY; 2 * leaves]);
        let mut tree = Self { items, nodes };
        tree.split(boxes, 0..leaves);
        tree.refit(boxes);
        tree
    }

    fn leaves(&self) -> usize {
        self.nodes.len() / 2
    }

    /// Where the items of a leaf stand.
    fn leaf(&self, leaf: usize) -> Range<usize> {
        let start = |leaf: usize| leaf * self.items.len() / self.leaves();
        start(leaf)..start(leaf + 1)
    }

    /// Orders the items of some leaves, halving them along the longer side of the box of their centres.
    fn split(&mut self, boxes: &[Bounds], leaves: Range<usize>) {
        if leaves.len() < 2 {
            return;
        }
        let middle = usize::midpoint(leaves.start, leaves.end);
        let (start, end) = (self.leaf(leaves.start).start, self.leaf(leaves.end - 1).end);
        let half = self.leaf(middle).start - start;
        let items = &mut self.items[start..end];
        let twice = |item: usize, d: usize| boxes[item].lower[d] + boxes[item].upper[d];
        let extent = |d: usize| {
            let all = items.iter().map(|&item| twice(item, d));
            all.clone().fold(f64::NEG_INFINITY, f64::max) - all.fold(f64::INFINITY, f64::min)
        };
        let axis = usize::from(extent(1) > extent(0));
        if half < items.len() {
            items.select_nth_unstable_by(half, |&a, &b| {
                twice(a, axis).total_cmp(&twice(b, axis)).then(a.cmp(&b))
            });
        }
        self.split(boxes, leaves.start..middle);
        self.split(boxes, middle..leaves.end);
    }

    /// Fits all boxes to those of the items.
    pub fn refit(&mut self, boxes: &[Bounds]) {
        let leaves = self.leaves();
        for leaf in 0..leaves {
            let items = &self.items[self.leaf(leaf)];
            let round = items.iter().fold(Bounds::EMPTY, |all, &item| all.union(&boxes[item]));
            self.nodes[leaves + leaf] = round;
        }
        for node in (1..leaves).rev() {
            self.nodes[node] = self.nodes[2 * node].union(&self.nodes[2 * node + 1]);
        }
    }

    /// Visits the items of all leaves whose box is not further from the point than the root of `limit`, in m²,
    /// the nearer leaves first. What `visit` returns is the limit from then on.
    pub fn visit(&self, point: Point, mut limit: f64, mut visit: impl FnMut(usize) -> f64) {
        let mut stack = [1; STACK];
        let mut waiting = 1;
        while waiting > 0 {
            waiting -= 1;
            let node = stack[waiting];
            if self.nodes[node].square_distance(point) > limit {
                continue;
            }
            if let Some(leaf) = node.checked_sub(self.leaves()) {
                for &item in &self.items[self.leaf(leaf)] {
                    limit = visit(item);
                }
                continue;
            }
            let [near, far] = self.by_distance([2 * node, 2 * node + 1], point);
            (stack[waiting], stack[waiting + 1]) = (far, near);
            waiting += 2;
        }
    }

    fn by_distance(&self, [a, b]: [usize; 2], point: Point) -> [usize; 2] {
        let distance = |node: usize| self.nodes[node].square_distance(point);
        if distance(a) <= distance(b) { [a, b] } else { [b, a] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Boxes that spread with a ratio of sizes of a thousand, moved by `shift`.
    fn boxes(n: usize, shift: f64) -> Vec<Bounds> {
        let fraction = |k: usize, step: f64| (k as f64 * step).fract();
        let one = |k: usize| {
            let size = 0.1 * 1000_f64.powf(-fraction(k, 0.618_033_989));
            let corner = [fraction(k, 0.754_877_666) + shift, fraction(k, 0.569_840_291)];
            Bounds { lower: corner, upper: corner.map(|x| x + size) }
        };
        (1..=n).map(one).collect()
    }

    #[test]
    fn same_items_as_brute_force_before_and_after_motion() {
        for n in [1, 2, 3, 17, 300] {
            let mut tree = BoxTree::new(&boxes(n, 0.0));
            for shift in [0.0, 0.7] {
                let boxes = boxes(n, shift);
                tree.refit(&boxes);
                for p in [[0.5, 0.5], [0.8, 0.1], [1.5, 0.9], [-3.0, 2.0]] {
                    for limit in [0.0, 0.01] {
                        let near = |item: usize| boxes[item].square_distance(p) <= limit;
                        let mut found = vec![];
                        tree.visit(p, limit, |item| {
                            found.push(item);
                            limit
                        });
                        found.retain(|&item| near(item));
                        found.sort_unstable();
                        let expected: Vec<_> = (0..n).filter(|&item| near(item)).collect();
                        assert_eq!(found, expected, "{n} boxes, {p:?}");
                    }
                }
            }
        }
    }
}
