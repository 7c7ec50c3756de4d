//! Housner's rocking block (1963), integrated here and by nothing of the library: the reference of `rocking.rs`.
//!
//! A rigid stone in plane turns about one end of its bearing or the other and never slides. In the axes of the base, tangent `t` and normal
//! `n`, with the turn `theta` from the face, positive towards `+t`:
//!
//! ```text
//! J theta'' = r_n f_t - r_t f_n                 r: from the end that it turns about to the centroid, f: specific force, J: over the mass
//! f = (g sin s - a cos s, -g cos s - a sin s)   base inclined by s down towards +t, accelerated horizontally by a
//! theta' after = eta theta' before              at theta = 0: angular momentum about the end that it comes down on is kept
//! ```
//!
//! For a level base and a full bearing these are Housner's equation in its nonlinear form and `eta = 1 - 1.5 sin^2 alpha`.

use crate::fixture::G;
use pirca::math::{cos, sin};
use pirca::motion::Accelerogram;

/// Steps of Runge and Kutta's fourth order in a second: halving them moves peaks by less than 1e-6.
const STEPS_PER_SECOND: f64 = 1000.0;
/// What comes down slower (rad/s) stays down: impacts would follow one another without end.
const STAYS_DOWN: f64 = 1e-4;

/// What is lower than at rest by this share of its half height lies.
const LIES: f64 = 0.1;

/// A stone on its base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    /// Half width and half height (m).
    pub half: [f64; 2],
    /// Ends of the bearing before and behind the middle (m), both positive.
    pub ends: [f64; 2],
    /// Inclination of the base (rad), down towards positive turns.
    pub slope: f64,
}

/// Share of the spin that an impact keeps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Impact {
    /// Angular momentum about the end that comes down is kept (Housner).
    Housner,
    /// Any other, to see that it is told apart.
    Kept(f64),
}

/// What became of a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rocked {
    /// Largest turn from the face (rad).
    pub peak: f64,
    /// Whether it turned past its unstable equilibrium and did not come back.
    pub overturned: bool,
}

impl Block {
    /// Full bearing on a level base.
    pub fn perfect(b: f64, h: f64) -> Block {
        Block { half: [b, h], ends: [b, b], slope: 0.0 }
    }

    /// Square of the radius of gyration about the centroid (m^2): what worn arrises lack is left out.
    fn gyration(&self) -> f64 {
        let [b, h] = self.half;
        (b * b + h * h) / 3.0
    }

    /// Share of the spin that is kept by an impact on an end: angular momentum about it over the moment of inertia.
    pub fn kept(&self, on: usize) -> f64 {
        let h = self.half[1];
        let centre = self.gyration() + h * h;
        (centre - self.ends[0] * self.ends[1]) / (centre + self.ends[on] * self.ends[on])
    }

    /// The end about which it turns: 1 for positive turns.
    fn end(turn: f64) -> usize {
        usize::from(turn > 0.0)
    }

    /// From an end to the centroid at a turn.
    fn arm(&self, end: usize, turn: f64) -> [f64; 2] {
        let along = if end == 1 { -self.ends[1] } else { self.ends[0] };
        let (s, c, h) = (sin(turn), cos(turn), self.half[1]);
        [along * c + h * s, h * c - along * s]
    }

    /// `theta''` about an end under a horizontal acceleration of the base (m/s^2).
    fn acceleration(&self, end: usize, turn: f64, base: f64) -> f64 {
        let [t, n] = self.arm(end, turn);
        let (s, c) = (sin(self.slope), cos(self.slope));
        let (along, normal) = (G * s - base * c, -G * c - base * s);
        (n * along - t * normal)
            / (self.gyration() + self.ends[end] * self.ends[end] + self.half[1] * self.half[1])
    }

    /// Whether it is past its unstable equilibrium: at rest gravity alone would turn it further.
    fn is_past(&self, turn: f64) -> bool {
        let end = Block::end(turn);
        turn != 0.0 && turn.signum() * self.acceleration(end, turn, 0.0) > 0.0
    }

    /// Whether its centroid is so much lower than at rest that it does not come back.
    fn lies(&self, turn: f64) -> bool {
        let end = Block::end(turn);
        let (from, to) = (self.arm(end, 0.0), self.arm(end, turn));
        let up = [-sin(self.slope), cos(self.slope)];
        (from[0] - to[0]) * up[0] + (from[1] - to[1]) * up[1] > LIES * self.half[1]
    }

    /// Follows it through a record along `+t` and `after` (s) more.
    pub fn shaken(&self, record: &Accelerogram, after: f64, impact: Impact) -> Rocked {
        let mut own = Rocking { block: self, record, impact, turn: 0.0, spin: 0.0, time: 0.0 };
        let step = 1.0 / STEPS_PER_SECOND;
        let steps = ((record.duration() + after) * STEPS_PER_SECOND).round() as usize;
        let mut peak = 0.0f64;
        for k in 0..steps {
            own.advance(step * k as f64, step);
            peak = peak.max(own.turn.abs());
            if self.lies(own.turn) {
                return Rocked { peak, overturned: true };
            }
        }
        Rocked { peak, overturned: self.is_past(own.turn) }
    }
}

/// A block on the move.
struct Rocking<'a> {
    block: &'a Block,
    record: &'a Accelerogram,
    impact: Impact,
    turn: f64,
    spin: f64,
    time: f64,
}

impl Rocking<'_> {
    /// A step of length `step` (s) from a time (s) on, with the impacts in it.
    fn advance(&mut self, from: f64, step: f64) {
        self.time = from;
        let end = from + step;
        while end - self.time > 1e-12 {
            let left = end - self.time;
            if self.turn == 0.0 && self.spin == 0.0 && !self.lifts() {
                self.time = end;
                return;
            }
            // Of a block on its face the spin says which end it turns about.
            let pivot = Block::end(if self.turn == 0.0 { self.spin } else { self.turn });
            let [turn, spin] = self.ahead(pivot, left);
            let is_down = if pivot == 1 { turn < 0.0 } else { turn > 0.0 };
            if !is_down {
                (self.turn, self.spin, self.time) = (turn, spin, end);
                return;
            }
            self.come_down(pivot, left);
        }
    }

    /// Whether it leaves its face now; if so, with next to no spin to the side where it does.
    fn lifts(&mut self) -> bool {
        let base = self.record.acceleration(self.time);
        for (end, side) in [(1, 1.0), (0, -1.0)] {
            if side * self.block.acceleration(end, 0.0, base) > 0.0 {
                self.spin = side * f64::MIN_POSITIVE;
                return true;
            }
        }
        false
    }

    /// Turn and spin after a time (s), were there no impact.
    fn ahead(&self, pivot: usize, by: f64) -> [f64; 2] {
        let slope = |time: f64, [turn, spin]: [f64; 2]| {
            [spin, self.block.acceleration(pivot, turn, self.record.acceleration(time))]
        };
        let (now, middle) = ([self.turn, self.spin], self.time + 0.5 * by);
        let plus = |way: [f64; 2], by: f64| [now[0] + by * way[0], now[1] + by * way[1]];
        let one = slope(self.time, now);
        let two = slope(middle, plus(one, 0.5 * by));
        let three = slope(middle, plus(two, 0.5 * by));
        let four = slope(self.time + by, plus(three, by));
        [0, 1].map(|k| now[k] + by / 6.0 * (one[k] + 2.0 * (two[k] + three[k]) + four[k]))
    }

    /// Goes on to the impact within a time (s), found by bisection, and through it.
    fn come_down(&mut self, pivot: usize, within: f64) {
        let (mut low, mut high) = (0.0, within);
        for _ in 0..40 {
            let half = 0.5 * (low + high);
            let turn = self.ahead(pivot, half)[0];
            if (pivot == 1) == (turn >= 0.0) { low = half } else { high = half }
        }
        let [_, spin] = self.ahead(pivot, high);
        self.time += high;
        self.turn = 0.0;
        let kept = match self.impact {
            Impact::Housner => self.block.kept(1 - pivot),
            Impact::Kept(share) => share,
        };
        self.spin = if spin.abs() < STAYS_DOWN { 0.0 } else { kept * spin };
    }
}
