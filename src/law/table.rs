//! A free law of closure: stress against closure through knots, monotone, with a slope that has no jumps.
//!
//! Between two knots the stress is Hermite's cubic, with slopes that keep it rising (Fritsch and Carlson 1980; Fritsch and
//! Butland 1984), here held between a third and twice the smaller of the two chords beside a knot: a joint then has a
//! stiffness everywhere. The law begins at (0, 0). Beyond the last knot it goes on in a straight line with its last slope, and in
//! tension with its first.

use crate::math::monotone_slopes;

/// The law; knots that are not used are 0.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct ClosureTable {
    /// Index of the last knot; the first one is the origin.
    last: usize,
    /// Closures (m), ascending.
    closure: [f64; SIZE],
    /// Stresses (Pa), ascending.
    stress: [f64; SIZE],
    /// Slopes (Pa/m).
    slope: [f64; SIZE],
}

/// Knots that a table may have beside the origin.
pub const MOST_KNOTS: usize = 8;
/// Knots that it must have beside the origin: one is a linear law.
pub const LEAST_KNOTS: usize = 2;

const SIZE: usize = MOST_KNOTS + 1;

impl ClosureTable {
    /// Through (0, 0) and two to eight knots, closures (m) and stresses (Pa) above 0 and both strictly ascending; `None` for
    /// others.
    pub fn through(closures: &[f64], stresses: &[f64]) -> Option<ClosureTable> {
        let last = closures.len();
        if last != stresses.len() || !(LEAST_KNOTS..=MOST_KNOTS).contains(&last) {
            return None;
        }
        let (mut closure, mut stress, mut slope) = ([0.0; SIZE], [0.0; SIZE], [0.0; SIZE]);
        closure[1..=last].copy_from_slice(closures);
        stress[1..=last].copy_from_slice(stresses);
        let rises = |values: &[f64]| values.windows(2).all(|two| two[0] < two[1]);
        if !rises(&closure[..=last]) || !rises(&stress[..=last]) || !stress[last].is_finite() {
            return None;
        }
        monotone_slopes(&closure[..=last], &stress[..=last], &mut slope[..=last]);
        let chord = |k: usize| (stress[k + 1] - stress[k]) / (closure[k + 1] - closure[k]);
        for (k, slope) in slope[..=last].iter_mut().enumerate() {
            let least = chord(k.saturating_sub(1)).min(chord(k.min(last - 1)));
            *slope = slope.clamp(least / 3.0, 2.0 * least);
        }
        Some(ClosureTable { last, closure, stress, slope })
    }

    /// Closures (m) and stresses (Pa) of its knots, without the origin.
    pub fn knots(&self) -> [&[f64]; 2] {
        [&self.closure[1..=self.last], &self.stress[1..=self.last]]
    }

    /// The law with so many times the stress at any closure.
    pub fn scaled(&self, factor: f64) -> ClosureTable {
        let times = |values: [f64; SIZE]| values.map(|x| x * factor);
        ClosureTable { stress: times(self.stress), slope: times(self.slope), ..*self }
    }

    pub(super) fn stress(&self, u: f64) -> f64 {
        if u <= 0.0 {
            return self.slope[0] * u;
        }
        match self.within(u) {
            Some((k, t)) => self.cubic(k).at(t),
            None => self.stress[self.last] + self.slope[self.last] * (u - self.closure[self.last]),
        }
    }

    pub(super) fn stiffness(&self, u: f64) -> f64 {
        if u <= 0.0 {
            return self.slope[0];
        }
        match self.within(u) {
            Some((k, t)) => self.cubic(k).slope(t) / self.width(k),
            None => self.slope[self.last],
        }
    }

    pub(super) fn first_stiffness(&self) -> f64 {
        self.slope[0]
    }

    /// The largest of the slopes at the knots and of those between them.
    pub(super) fn largest_stiffness(&self) -> f64 {
        (0..self.last).fold(self.slope[self.last], |most, k| {
            most.max(self.slope[k]).max(self.cubic(k).steepest() / self.width(k))
        })
    }

    /// The closure (m) at a stress (Pa), to rounding: Newton's method from within the interval, halving where it leaves it.
    pub(super) fn closure(&self, stress: f64) -> f64 {
        if stress <= 0.0 {
            return stress / self.slope[0];
        }
        let k = self.stress[..=self.last].partition_point(|known| *known < stress) - 1;
        if k == self.last {
            return self.closure[k] + (stress - self.stress[k]) / self.slope[k];
        }
        let cubic = self.cubic(k);
        let (mut low, mut high, mut t) = (0.0, 1.0, 0.5);
        for _ in 0..60 {
            let miss = cubic.at(t) - stress;
            if miss > 0.0 {
                high = t
            } else {
                low = t
            }
            let next = t - miss / cubic.slope(t);
            let next = if low < next && next < high { next } else { 0.5 * (low + high) };
            if next == t {
                break;
            }
            t = next;
        }
        self.closure[k] + t * self.width(k)
    }

    pub(super) fn energy(&self, u: f64) -> f64 {
        if u <= 0.0 {
            return 0.5 * self.slope[0] * u * u;
        }
        let whole = |k: usize| self.cubic(k).integral(1.0) * self.width(k);
        match self.within(u) {
            Some((k, t)) => {
                (0..k).fold(0.0, |sum, k| sum + whole(k)) + self.cubic(k).integral(t) * self.width(k)
            }
            None => {
                let beyond = u - self.closure[self.last];
                let last = beyond * (self.stress[self.last] + 0.5 * self.slope[self.last] * beyond);
                (0..self.last).fold(0.0, |sum, k| sum + whole(k)) + last
            }
        }
    }

    /// The interval in which a closure above 0 lies, and its share of it; `None` beyond the last knot.
    fn within(&self, u: f64) -> Option<(usize, f64)> {
        let k = (0..self.last).find(|&k| u < self.closure[k + 1])?;
        Some((k, (u - self.closure[k]) / self.width(k)))
    }

    fn width(&self, k: usize) -> f64 {
        self.closure[k + 1] - self.closure[k]
    }

    /// The stress over the share of an interval.
    fn cubic(&self, k: usize) -> Cubic {
        let (h, [y, next]) = (self.width(k), [self.stress[k], self.stress[k + 1]]);
        let [from, to] = [self.slope[k] * h, self.slope[k + 1] * h];
        let rise = next - y;
        Cubic([y, from, 3.0 * rise - 2.0 * from - to, from + to - 2.0 * rise])
    }
}

/// A cubic over a share, constant first.
struct Cubic([f64; 4]);

impl Cubic {
    fn at(&self, t: f64) -> f64 {
        let Cubic([a, b, c, d]) = self;
        a + t * (b + t * (c + t * d))
    }

    fn slope(&self, t: f64) -> f64 {
        let Cubic([_, b, c, d]) = self;
        b + t * (2.0 * c + t * 3.0 * d)
    }

    fn integral(&self, t: f64) -> f64 {
        let Cubic([a, b, c, d]) = self;
        t * (a + t * (b / 2.0 + t * (c / 3.0 + t * d / 4.0)))
    }

    /// The largest slope between 0 and 1.
    fn steepest(&self) -> f64 {
        let Cubic([_, _, c, d]) = self;
        let turns = -c / (3.0 * d);
        let ends = self.slope(0.0).max(self.slope(1.0));
        if (0.0..1.0).contains(&turns) { ends.max(self.slope(turns)) } else { ends }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const CLOSURE: [f64; 4] = [4e-5, 1e-4, 1.2e-4, 4e-4];
    const STRESS: [f64; 4] = [5e2, 4e3, 2e4, 2.1e4];

    fn law() -> ClosureTable {
        ClosureTable::through(&CLOSURE, &STRESS).expect("it rises")
    }

    #[test]
    fn it_goes_through_its_knots_and_back() {
        for (u, sigma) in CLOSURE.into_iter().zip(STRESS) {
            assert_relative_eq!(law().stress(u), sigma, max_relative = 1e-12);
        }
        for sigma in [1e-3, 1.0, 5e2, 6e2, 1e4, 2.05e4, 3e4, -7.0] {
            assert_relative_eq!(law().stress(law().closure(sigma)), sigma, max_relative = 1e-11);
        }
        assert_eq!((law().stress(0.0), law().closure(0.0)), (0.0, 0.0));
    }

    #[test]
    fn it_always_rises_and_nowhere_faster_than_it_says() {
        let (mut before, most) = (law().stress(-1e-5), law().largest_stiffness());
        let mut steepest: f64 = 0.0;
        for k in -99..10_000 {
            let u = 1e-7 * f64::from(k);
            let (stress, slope) = (law().stress(u), law().stiffness(u));
            assert!(
                stress > before && slope > 0.0 && slope <= most * (1.0 + 1e-12),
                "{u:e}: {stress} {slope:e}"
            );
            (before, steepest) = (stress, steepest.max(slope));
        }
        // Steps of 1e-7 m beside an interval of 2e-5 m.
        assert!(steepest > 0.999 * most, "{steepest:e} {most:e}");
        assert_relative_eq!(
            law().stress(1.0),
            2.1e4 + (1.0 - 4e-4) * law().stiffness(1.0),
            max_relative = 1e-12
        );
    }

    #[test]
    fn a_straight_table_is_the_linear_law() {
        let law = ClosureTable::through(&[1e-4, 2e-4, 5e-4], &[5e3, 1e4, 2.5e4]).expect("it rises");
        for u in [-1e-4, 1e-5, 1.5e-4, 4e-4, 1e-3] {
            assert_relative_eq!(law.stress(u), 5e7 * u, max_relative = 1e-12);
            assert_relative_eq!(law.stiffness(u), 5e7, max_relative = 1e-12);
            assert_relative_eq!(law.energy(u), 2.5e7 * u * u, max_relative = 1e-12);
        }
    }

    #[test]
    fn what_does_not_rise_is_no_law() {
        let none =
            |u: &[f64], sigma: &[f64]| assert_eq!(ClosureTable::through(u, sigma), None, "{u:?} {sigma:?}");
        none(&[1e-4], &[1e3]);
        none(&[1e-4, 1e-4], &[1e3, 2e3]);
        none(&[1e-4, 2e-4], &[1e3, 1e3]);
        none(&[0.0, 2e-4], &[1e3, 2e3]);
        none(&[1e-4, 2e-4], &[-1e3, 2e3]);
        none(&[1e-4, 2e-4, 3e-4], &[1e3, 2e3]);
        none(&[1e-4, f64::NAN], &[1e3, 2e3]);
        none(&[1e-4, 2e-4], &[1e3, f64::INFINITY]);
        none(&[1.0; 9], &[1.0; 9]);
    }
}
