//! A normal law integrated over the pressed part of a sub-contact.
//!
//! Closure is affine over a joint. A linear law is integrated exactly by the moments of the part; any other one over the
//! triangles of the part's outline, by the seven-point rule of degree five (Radon 1948): where a hyperbolic joint closes by
//! its maximum closure from one side of a sub-contact to the other the force is right to 2e-4.
//!
//! Where a joint is crushed the part is cut once more, along the line at which the strength is reached: beyond it the stress is
//! the strength.

use crate::contact::Cell;
use crate::law::{Coulomb, Crushing, NormalLaw};
use crate::shape::{Moments, Polygon};
use crate::solve::joints::joint::Gap;

/// Pressure integrated over a joint: the force and its first moments in the plane.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PressureSum {
    pub force: f64,
    pub by_s: f64,
    pub by_t: f64,
}

/// Integrals of the law's slope times 1, s, t by 1, s, t (N/m, N, N m): minus the derivatives of a [`PressureSum`] with
/// respect to the gap `g0, gs, gt`. The part's boundary moves with the gap, but no pressure acts there.
pub(super) type PressureSlopes = [[f64; 3]; 3];

/// Points of the rule in barycentric coordinates (two; the third is what is left to 1), and their weights.
const RULE: [([f64; 2], f64); 7] = {
    const NEAR: f64 = 0.101_286_507_323_456_33;
    const FAR: f64 = 0.470_142_064_105_115_1;
    const LIGHT: f64 = 0.125_939_180_544_827_15;
    const HEAVY: f64 = 0.132_394_152_788_506_2;
    [
        ([1.0 / 3.0, 1.0 / 3.0], 0.225),
        ([NEAR, NEAR], LIGHT),
        ([1.0 - 2.0 * NEAR, NEAR], LIGHT),
        ([NEAR, 1.0 - 2.0 * NEAR], LIGHT),
        ([FAR, FAR], HEAVY),
        ([1.0 - 2.0 * FAR, FAR], HEAVY),
        ([FAR, 1.0 - 2.0 * FAR], HEAVY),
    ]
};

impl PressureSum {
    pub fn add(&mut self, other: &PressureSum) {
        self.force += other.force;
        self.by_s += other.by_s;
        self.by_t += other.by_t;
    }

    fn add_at(&mut self, [s, t]: [f64; 2], force: f64) {
        self.add(&PressureSum { force, by_s: s * force, by_t: t * force });
    }
}

/// The law of compression of a joint as it stands: the normal law, and where it is crushed if any of it is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bearing<'l> {
    pub law: &'l NormalLaw,
    pub crushing: Option<Crushing>,
}

impl<'l> Bearing<'l> {
    /// Of a joint with this polygon at this gap.
    pub fn of(law: &'l Coulomb, polygon: &Polygon, gap: &Gap) -> Bearing<'l> {
        let is_crushed = |own: &Crushing| polygon.vertices.iter().any(|v| -gap.at(v) > own.closure);
        Bearing { law: &law.normal, crushing: law.crushing().filter(is_crushed) }
    }

    /// The stiffness (Pa/m) where what presses on a cell can be integrated by moments: linear, and not a point that is crushed.
    fn linear(&self, cell: &Cell) -> Option<f64> {
        match *self.law {
            NormalLaw::Linear { kn } if self.crushing.is_none() || !cell.outline.vertices.is_empty() => {
                Some(kn)
            }
            _ => None,
        }
    }

    /// The stress (Pa) at a closure (m).
    fn stress(&self, u: f64) -> f64 {
        match self.crushing {
            Some(Crushing { strength, closure }) if u > closure => strength,
            _ => self.law.stress(u),
        }
    }

    /// The part of a cell that is crushed.
    pub(super) fn crushed(&self, cell: &Cell, gap: &Gap) -> Option<Polygon> {
        let Crushing { closure, .. } = self.crushing?;
        let outline = cell.outline.clip(gap.g0 + closure, gap.gs, gap.gt);
        (outline.vertices.len() > 2).then_some(outline)
    }

    /// What of a pressed outline is not crushed.
    fn sound(&self, outline: Polygon, gap: &Gap) -> Polygon {
        match self.crushing {
            Some(Crushing { closure, .. }) => outline.clip(-gap.g0 - closure, -gap.gs, -gap.gt),
            None => outline,
        }
    }
}

/// The pressure on a part of a sub-contact: on all of it if it holds, else on what is compressed. `part` are the part's
/// moments.
pub(super) fn pressure(
    bearing: &Bearing<'_>,
    cell: &Cell,
    part: &Moments,
    gap: &Gap,
    holds: bool,
) -> PressureSum {
    let law = bearing.law;
    let mut sum = PressureSum::default();
    let crushed = bearing.crushed(cell, gap).map(|outline| outline.moments());
    if let Some((Crushing { strength, .. }, m)) = bearing.crushing.zip(crushed) {
        sum = PressureSum { force: strength * m.area, by_s: strength * m.s, by_t: strength * m.t };
    }
    if let Some(kn) = bearing.linear(cell) {
        let sound = crushed.map_or(*part, |crushed| less(part, &crushed));
        sum.add(&linear(kn, &sound, gap));
        return sum;
    }
    let Some(outline) = pressed_outline(cell, gap) else {
        let at = part.centroid();
        sum.add_at(at, bearing.stress(-gap.at(&at)) * part.area);
        return sum;
    };
    let pressed = outline.moments();
    each_point(&bearing.sound(outline, gap), |at, area| sum.add_at(at, law.stress(-gap.at(&at)) * area));
    if holds {
        sum.add(&linear(law.first_stiffness(), &less(part, &pressed), gap));
    }
    sum
}

/// The slopes of [`pressure`], with the same arguments. What is crushed has none, and its boundary moves without a jump of the
/// stress.
pub(super) fn pressure_slopes(
    bearing: &Bearing<'_>,
    cell: &Cell,
    part: &Moments,
    gap: &Gap,
    holds: bool,
) -> PressureSlopes {
    let law = bearing.law;
    if let Some(kn) = bearing.linear(cell) {
        let crushed = bearing.crushed(cell, gap);
        return scaled(kn, &crushed.map_or(*part, |crushed| less(part, &crushed.moments())));
    }
    let mut sum = PressureSlopes::default();
    let mut add = |[s, t]: [f64; 2], stiffness: f64| {
        let of = [1.0, s, t];
        for (row, a) in sum.iter_mut().zip(of) {
            for (entry, b) in row.iter_mut().zip(of) {
                *entry += stiffness * a * b;
            }
        }
    };
    let Some(outline) = pressed_outline(cell, gap) else {
        let (at, u) = (part.centroid(), -gap.at(&part.centroid()));
        let is_crushed = bearing.crushing.is_some_and(|crushing| u > crushing.closure);
        add(at, if is_crushed { 0.0 } else { law.stiffness(u) * part.area });
        return sum;
    };
    let pressed = outline.moments();
    each_point(&bearing.sound(outline, gap), |at, area| add(at, law.stiffness(-gap.at(&at)) * area));
    if holds {
        let rest = scaled(law.first_stiffness(), &less(part, &pressed));
        for (row, more) in sum.iter_mut().zip(rest) {
            row.iter_mut().zip(more).for_each(|(entry, x)| *entry += x);
        }
    }
    sum
}

/// Energy stored in the closure of a part of a sub-contact (J).
pub(super) fn closure_energy(
    bearing: &Bearing<'_>,
    cell: &Cell,
    part: &Moments,
    gap: &Gap,
    holds: bool,
) -> f64 {
    let law = bearing.law;
    // At the strength the joint has the energy of its closure there, and the work of the strength since.
    let crushed_at = |crushing: &Crushing, area: f64, closed: f64| {
        let Crushing { strength, closure } = *crushing;
        (law.energy(closure) - strength * closure) * area + strength * closed
    };
    let crushed = bearing.crushed(cell, gap).map(|outline| outline.moments());
    let mut sum = match bearing.crushing.zip(crushed) {
        Some((crushing, m)) => {
            crushed_at(&crushing, m.area, -(gap.g0 * m.area + gap.gs * m.s + gap.gt * m.t))
        }
        None => 0.0,
    };
    if let Some(kn) = bearing.linear(cell) {
        let sound = crushed.map_or(*part, |crushed| less(part, &crushed));
        return sum + 0.5 * kn * square(&sound, gap);
    }
    let Some(outline) = pressed_outline(cell, gap) else {
        let u = -gap.at(&part.centroid());
        return match bearing.crushing.filter(|crushing| u > crushing.closure) {
            Some(crushing) => crushed_at(&crushing, part.area, u * part.area),
            None => law.energy(u) * part.area,
        };
    };
    let pressed = outline.moments();
    each_point(&bearing.sound(outline, gap), |at, area| sum += law.energy(-gap.at(&at)) * area);
    let rest = if holds { square(&less(part, &pressed), gap) } else { 0.0 };
    sum + 0.5 * law.first_stiffness() * rest
}

/// The part of a sub-contact in compression, by clipping it at zero gap; a point is in or out as a whole.
pub(super) fn compressed(cell: &Cell, gap: &Gap) -> Moments {
    if cell.outline.vertices.is_empty() {
        return if gap.at(&cell.moments.centroid()) <= 0.0 { cell.moments } else { Moments::default() };
    }
    let open = cell.outline.vertices.iter().filter(|v| gap.at(v) > 0.0).count();
    if open == 0 {
        cell.moments
    } else if open == cell.outline.vertices.len() {
        Moments::default()
    } else {
        cell.outline.clip(gap.g0, gap.gs, gap.gt).moments()
    }
}

/// The outline of that part; `None` for a point.
fn pressed_outline(cell: &Cell, gap: &Gap) -> Option<Polygon> {
    (!cell.outline.vertices.is_empty()).then(|| cell.outline.clip(gap.g0, gap.gs, gap.gt))
}

/// Hands out the points of the rule with their shares of the area.
fn each_point(outline: &Polygon, mut take: impl FnMut([f64; 2], f64)) {
    let corners = &outline.vertices;
    for k in 1..corners.len().max(2) - 1 {
        let (a, b, c) = (corners[0], corners[k], corners[k + 1]);
        let area = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]));
        for ([x, y], weight) in RULE {
            let z = 1.0 - x - y;
            take([0, 1].map(|i| a[i] * x + b[i] * y + c[i] * z), weight * area);
        }
    }
}

/// Integrates a linear law over an area with the given integrals, exactly.
pub(super) fn linear(kn: f64, m: &Moments, gap: &Gap) -> PressureSum {
    let Gap { g0, gs, gt } = *gap;
    PressureSum {
        force: -kn * (g0 * m.area + gs * m.s + gt * m.t),
        by_s: -kn * (g0 * m.s + gs * m.ss + gt * m.st),
        by_t: -kn * (g0 * m.t + gs * m.st + gt * m.tt),
    }
}

/// The integral of the gap's square.
fn square(m: &Moments, gap: &Gap) -> f64 {
    let Gap { g0, gs, gt } = *gap;
    g0 * g0 * m.area
        + 2.0 * g0 * (gs * m.s + gt * m.t)
        + gs * gs * m.ss
        + 2.0 * gs * gt * m.st
        + gt * gt * m.tt
}

fn scaled(k: f64, m: &Moments) -> PressureSlopes {
    [[m.area, m.s, m.t], [m.s, m.ss, m.st], [m.t, m.st, m.tt]].map(|row| row.map(|x| k * x))
}

fn less(a: &Moments, b: &Moments) -> Moments {
    Moments {
        area: a.area - b.area,
        s: a.s - b.s,
        t: a.t - b.t,
        ss: a.ss - b.ss,
        st: a.st - b.st,
        tt: a.tt - b.tt,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::ClosureTable;
    use approx::assert_relative_eq;

    fn cell() -> Cell {
        let outline = Polygon { vertices: vec![[0.1, 0.0], [0.5, 0.0], [0.5, 0.3], [0.1, 0.3]] };
        Cell::within(outline)
    }

    /// A joint that is not crushed.
    fn free(law: &NormalLaw) -> Bearing<'_> {
        Bearing { law, crushing: None }
    }

    /// Force per width of the hyperbolic law from closure `a` to `b`, by the energy's slope: the integral of the stress.
    fn exact(law: &NormalLaw, a: f64, b: f64, length: f64) -> f64 {
        (law.energy(b) - law.energy(a)) / (b - a) * length
    }

    #[test]
    fn the_rule_is_exact_for_a_linear_law_and_close_for_a_hyperbola() {
        let gap = Gap { g0: -1.5e-4, gs: 2e-4, gt: -3e-4 };
        // Vm = 0 makes the hyperbola linear: the rule of degree five has nothing to round off but itself.
        let (linear, same) =
            (NormalLaw::Linear { kn: 5e7 }, NormalLaw::Hyperbolic { kn: 5e7, initial: 1e7, closure: 0.0 });
        let part = compressed(&cell(), &gap);
        let (a, b) = (
            pressure(&free(&linear), &cell(), &part, &gap, false),
            pressure(&free(&same), &cell(), &part, &gap, false),
        );
        assert_relative_eq!(a.force, b.force, max_relative = 1e-13);
        assert_relative_eq!(a.by_s, b.by_s, max_relative = 1e-13);
        assert_relative_eq!(a.by_t, b.by_t, max_relative = 1e-13);
        let law = NormalLaw::Hyperbolic { kn: 5e7, initial: 1e7, closure: 2e-4 };
        // Closed throughout, closure along t from 1e-5 to 3e-4; and opening at t = 0.1.
        for (g0, gt, pressed) in [(-1e-5, -9.666e-4, 0.3), (1e-4, -1e-3, 0.2)] {
            let gap = Gap { g0, gs: 0.0, gt };
            let part = compressed(&cell(), &gap);
            let found = pressure(&free(&law), &cell(), &part, &gap, false).force;
            let (from, to) = ((-g0).max(0.0), -gap.at(&[0.0, 0.3]));
            let force = 0.4 * exact(&law, from, to, pressed);
            println!("{found} against {force}: {:.1e}", found / force - 1.0);
            // The rule's own error, on one cell; four cells make it a sixteenth.
            assert_relative_eq!(found, force, max_relative = 3e-4);
        }
    }

    #[test]
    fn the_slopes_are_the_derivatives() {
        let law = NormalLaw::Hyperbolic { kn: 5e7, initial: 1e7, closure: 2e-4 };
        for holds in [false, true] {
            let sums = |g: [f64; 3]| {
                let gap = Gap { g0: g[0], gs: g[1], gt: g[2] };
                let part = if holds { cell().moments } else { compressed(&cell(), &gap) };
                let sum = pressure(&free(&law), &cell(), &part, &gap, holds);
                [sum.force, sum.by_s, sum.by_t]
            };
            let at = [1e-4, 2e-4, -1e-3];
            let gap = Gap { g0: at[0], gs: at[1], gt: at[2] };
            let part = if holds { cell().moments } else { compressed(&cell(), &gap) };
            let slopes = pressure_slopes(&free(&law), &cell(), &part, &gap, holds);
            for column in 0..3 {
                let moved = |h: f64| sums(std::array::from_fn(|k| at[k] + if k == column { h } else { 0.0 }));
                let (plus, minus) = (moved(1e-8), moved(-1e-8));
                for (row, entries) in slopes.iter().enumerate() {
                    let difference = -(plus[row] - minus[row]) / 2e-8;
                    // The derivative of the law by the rule, and not of the rule: they differ by the rule's own error.
                    assert_relative_eq!(entries[column], difference, max_relative = 1e-3);
                }
            }
        }
    }

    /// A law that is crushed where it closes by 0.15 mm.
    fn crushed(law: &NormalLaw) -> Bearing<'_> {
        Bearing { law, crushing: Some(Crushing { strength: law.stress(1.5e-4), closure: 1.5e-4 }) }
    }

    #[test]
    fn a_crushed_part_bears_its_strength() {
        // Closure along t from 0 at 0.1 to 0.2 mm at 0.3: crushed from 0.25 on.
        let gap = Gap { g0: 1e-4, gs: 0.0, gt: -1e-3 };
        let part = compressed(&cell(), &gap);
        let (linear, curved) =
            (NormalLaw::Linear { kn: 5e7 }, NormalLaw::Hyperbolic { kn: 5e7, initial: 1e7, closure: 0.0 });
        for law in [linear, curved] {
            let sum = pressure(&crushed(&law), &cell(), &part, &gap, false);
            // A ramp of 0.15 m to 7.5 kPa, and 0.05 m of that; 0.4 m wide.
            let [ramp, even] = [0.5 * 7.5e3 * 0.15 * 0.4, 7.5e3 * 0.05 * 0.4];
            assert_relative_eq!(sum.force, ramp + even, max_relative = 1e-12);
            assert_relative_eq!(sum.by_t, ramp * 0.2 + even * 0.275, max_relative = 1e-12);
            assert_relative_eq!(sum.by_s, 0.3 * sum.force, max_relative = 1e-12);
            let energy = closure_energy(&crushed(&law), &cell(), &part, &gap, false);
            let [ramp, even] =
                [0.5 * 5e7 * 1.5e-4 * 1.5e-4 / 3.0 * 0.15 * 0.4, 7.5e3 * (1.75e-4 - 0.75e-4) * 0.02];
            assert_relative_eq!(energy, ramp + even, max_relative = 1e-12);
        }
        // A corner is crushed as a whole.
        let corner = Cell { moments: part, outline: Polygon::default(), recess: 0.0 };
        for (g0, stress) in [(-1e-4, 5e3), (-2e-4, 7.5e3)] {
            let gap = Gap { g0, gs: 0.0, gt: 0.0 };
            let found = pressure(&crushed(&linear), &corner, &part, &gap, false);
            assert_relative_eq!(found.force, stress * part.area, max_relative = 1e-12);
        }
    }

    #[test]
    fn pressure_is_the_slope_of_the_energy_and_has_slopes_of_its_own_where_it_is_crushed() {
        let (linear, table) = (
            NormalLaw::Linear { kn: 5e7 },
            NormalLaw::Table(ClosureTable::through(&[1e-4, 2e-4, 4e-4], &[3e3, 8e3, 3e4]).expect("it rises")),
        );
        let point = Cell { moments: cell().moments, outline: Polygon::default(), recess: 0.0 };
        for (law, cell, holds, tolerance) in [
            (linear, cell(), false, 1e-7),
            (linear, cell(), true, 1e-7),
            (linear, point, false, 1e-7),
            // The derivative of the law by the rule, and not of the rule.
            (table, cell(), false, 2e-2),
            (table, cell(), true, 2e-2),
        ] {
            let part = |gap: &Gap| if holds { cell.moments } else { compressed(&cell, gap) };
            let gap_of = |g: [f64; 3]| Gap { g0: g[0], gs: g[1], gt: g[2] };
            let at =
                if cell.outline.vertices.is_empty() { [-1.1e-4, 1e-4, -1e-4] } else { [1e-4, 2e-4, -1e-3] };
            let gap = gap_of(at);
            let sum = pressure(&crushed(&law), &cell, &part(&gap), &gap, holds);
            let slopes = pressure_slopes(&crushed(&law), &cell, &part(&gap), &gap, holds);
            let (largest, force) = (slopes[0][0].abs(), sum.force.abs());
            for column in 0..3 {
                let moved = |h: f64| {
                    let gap = gap_of(std::array::from_fn(|k| at[k] + if k == column { h } else { 0.0 }));
                    let sum = pressure(&crushed(&law), &cell, &part(&gap), &gap, holds);
                    let energy = closure_energy(&crushed(&law), &cell, &part(&gap), &gap, holds);
                    ([sum.force, sum.by_s, sum.by_t], energy)
                };
                let ((plus, more), (minus, less)) = (moved(1e-8), moved(-1e-8));
                let work = -(more - less) / 2e-8;
                let own = [sum.force, sum.by_s, sum.by_t][column];
                assert!((work - own).abs() < tolerance * force, "{law:?} {column}: {work} {own}");
                for row in 0..3 {
                    let difference = -(plus[row] - minus[row]) / 2e-8;
                    let miss = (slopes[row][column] - difference).abs();
                    assert!(miss < tolerance * largest, "{law:?} {row} {column}: {miss:e} of {largest:e}");
                }
            }
        }
    }
}
