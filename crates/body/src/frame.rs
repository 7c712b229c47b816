use crate::Point;
use crate::planar::{Turn, across, dot, minus, plus, times};
use crate::tree::Link;

/// The motion of a body's pivot and its derivatives by the coordinates of the body's path, from which those of any
/// point of the body follow. With the arm `r = R (X − P)` from the pivot P, w the rates of turn by each coordinate,
/// and S the turn by a right angle, the point X of the body has
///
/// ```text
/// J_k   = J_k(P) + w_k S r                     dx/dq_k
/// H_jk  = H_jk(P) − w_j w_k r                  d²x/dq_j dq_k
/// a     = a(P) + omega' S r − omega² r         acceleration
/// da/dq_j = da/dq_j(P) − w_j (omega' r + omega² S r)
/// da/dv_j = da/dv_j(P) − 2 omega w_j r
/// ```
#[derive(Debug, Clone, Default)]
pub(crate) struct Frame {
    pub translation: Point,
    pub rotation: f64,
    pub turn: Turn,
    pub spin: f64,
    pub spin_rate: f64,
    velocity: Point,
    acceleration: Point,
    turns: Vec<f64>,
    jacobian: Vec<Point>,
    second: Vec<Point>,
    by_position: Vec<Point>,
    by_velocity: Vec<Point>,
}

/// The generalised coordinates, velocities and accelerations.
#[derive(Clone, Copy)]
pub(crate) struct Rates<'a> {
    pub q: &'a [f64],
    pub v: &'a [f64],
    pub a: &'a [f64],
}

impl Frame {
    pub fn new(link: &Link) -> Self {
        let n = link.path.len();
        Self {
            turns: link.turns.clone(),
            jacobian: vec![[0.0; 2]; n],
            second: vec![[0.0; 2]; n * n],
            by_position: vec![[0.0; 2]; n],
            by_velocity: vec![[0.0; 2]; n],
            ..Self::default()
        }
    }

    /// The arm from the pivot to a point that was that far from it in the placement as given.
    pub fn arm(&self, from_pivot: Point) -> Point {
        self.turn.apply(from_pivot)
    }

    pub fn velocity(&self, arm: Point) -> Point {
        plus(self.velocity, times(self.spin, across(arm)))
    }

    pub fn acceleration(&self, arm: Point) -> Point {
        let turning = times(self.spin_rate, across(arm));
        plus(self.acceleration, minus(turning, times(self.spin * self.spin, arm)))
    }

    pub fn turn_by(&self, k: usize) -> f64 {
        self.turns[k]
    }

    pub fn jacobian(&self, k: usize, arm: Point) -> Point {
        plus(self.jacobian[k], times(self.turns[k], across(arm)))
    }

    pub fn second(&self, j: usize, k: usize, arm: Point) -> Point {
        let both = self.turns[j] * self.turns[k];
        minus(self.second[j * self.turns.len() + k], times(both, arm))
    }

    pub fn acceleration_by_position(&self, j: usize, arm: Point) -> Point {
        let turning = times(self.spin_rate, arm);
        let change = plus(turning, times(self.spin * self.spin, across(arm)));
        minus(self.by_position[j], times(self.turns[j], change))
    }

    pub fn acceleration_by_velocity(&self, j: usize, arm: Point) -> Point {
        minus(self.by_velocity[j], times(2.0 * self.spin * self.turns[j], arm))
    }

    /// Follows the parent, slides in it and turns.
    pub fn update(&mut self, link: &Link, parent: &Frame, parent_pivot: Point, rates: Rates<'_>) {
        let inherited = parent.turns.len();
        let slides = || link.path[inherited..].iter().zip(&link.slides);
        let slid = slides().fold([0.0; 2], |sum, (&k, &e)| plus(sum, times(rates.q[k], e)));
        let from_pivot = plus(minus(link.pivot, parent_pivot), slid);
        self.translation = plus(parent.translation, plus(slid, parent.turn.change(from_pivot)));
        self.follow(parent, parent.arm(from_pivot));
        for (place, (&k, &direction)) in (inherited..).zip(slides()) {
            self.slide(place, parent, parent.arm(direction), (rates.v[k], rates.a[k]));
        }
        self.turn(link, parent, rates);
    }

    /// The pivot as a point of the parent.
    fn follow(&mut self, parent: &Frame, arm: Point) {
        let n = self.turns.len();
        self.velocity = parent.velocity(arm);
        self.acceleration = parent.acceleration(arm);
        for k in 0..parent.turns.len() {
            self.jacobian[k] = parent.jacobian(k, arm);
            self.by_position[k] = parent.acceleration_by_position(k, arm);
            self.by_velocity[k] = parent.acceleration_by_velocity(k, arm);
            for j in 0..parent.turns.len() {
                self.second[j * n + k] = parent.second(j, k, arm);
            }
        }
    }

    /// The pivot's slide along `e`, a direction of the parent where it is now.
    fn slide(&mut self, place: usize, parent: &Frame, e: Point, (v, a): (f64, f64)) {
        let n = self.turns.len();
        let (normal, spin) = (across(e), parent.spin);
        self.velocity = plus(self.velocity, times(v, e));
        let coriolis = times(2.0 * v * spin, normal);
        self.acceleration = plus(self.acceleration, plus(times(a, e), coriolis));
        self.jacobian[place] = e;
        self.by_position[place] = minus(times(parent.spin_rate, normal), times(spin * spin, e));
        self.by_velocity[place] = times(2.0 * spin, normal);
        for (j, &turn) in parent.turns.iter().enumerate() {
            self.second[j * n + place] = times(turn, normal);
            self.second[place * n + j] = times(turn, normal);
            let turned = minus(times(a, normal), times(2.0 * v * spin, e));
            self.by_position[j] = plus(self.by_position[j], times(turn, turned));
            self.by_velocity[j] = plus(self.by_velocity[j], times(2.0 * v * turn, normal));
        }
    }

    fn turn(&mut self, link: &Link, parent: &Frame, Rates { q, v, a }: Rates<'_>) {
        let held = (parent.rotation, parent.spin, parent.spin_rate);
        (self.rotation, self.spin, self.spin_rate) = match link.turn {
            None => held,
            Some(own) => {
                let k = own.coordinate;
                if own.beyond {
                    (held.0 + q[k], held.1 + v[k], held.2 + a[k])
                } else {
                    (q[k] - link.angle, v[k], a[k])
                }
            }
        };
        self.turn = Turn::by(self.rotation);
    }

    /// Power of a force at a point and of a moment for a unit velocity of the k-th coordinate of the path.
    pub fn power(&self, k: usize, arm: Point, force: Point, moment: f64) -> f64 {
        dot(self.jacobian(k, arm), force) + self.turns[k] * moment
    }
}
