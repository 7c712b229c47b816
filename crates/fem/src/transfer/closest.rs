/// The nearest of the nodes seen so far.
#[derive(Debug, Clone)]
pub(super) struct Closest {
    found: Vec<(f64, usize)>,
    wanted: usize,
}

impl Closest {
    /// Of as many nodes as are `wanted`, at least one.
    pub fn new(wanted: usize) -> Self {
        assert!(wanted > 0, "a neighbour");
        Self { found: Vec::with_capacity(wanted + 1), wanted }
    }

    pub fn clear(&mut self) {
        self.found.clear();
    }

    /// Squared distances in m² and numbers of the nodes, the nearest first; equal distances in the order of
    /// the numbers.
    pub fn found(&self) -> &[(f64, usize)] {
        &self.found
    }

    /// The square of the distance beyond which no node is among them any more.
    pub fn limit(&self) -> f64 {
        self.found.get(self.wanted - 1).map_or(f64::INFINITY, |last| last.0)
    }

    /// Takes a node at the root of `square` if it is among the nearest and not there yet.
    pub fn insert(&mut self, square: f64, node: usize) {
        if square > self.limit() {
            return;
        }
        let entry = (square, node);
        let place = self.found.partition_point(|found| *found < entry);
        if self.found.get(place) != Some(&entry) {
            self.found.insert(place, entry);
            self.found.truncate(self.wanted);
        }
    }
}

/// Calls `add` with each node and its weight by Shepard (1968), `d^-power` relative to that of the closest node,
/// so that none overflows, however near that node is. Returns the sum of the weights.
pub(super) fn shepard(found: &[(f64, usize)], power: f64, mut add: impl FnMut(usize, f64)) -> f64 {
    let (closest, node) = found[0];
    if closest == 0.0 {
        add(node, 1.0);
        return 1.0;
    }
    let mut sum = 0.0;
    for &(square, node) in found {
        let ratio = closest / square;
        let weight = if power == 2.0 { ratio } else { ratio.powf(0.5 * power) };
        add(node, weight);
        sum += weight;
    }
    sum
}
