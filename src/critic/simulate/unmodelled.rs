//! Effects in no catalogue: random forms of what walls do and of what gauges show. Campaigns with such forms teach the
//! ranking how the ones look that are like none of its causes: of a cause's own it sees thousands, and of all others it would
//! otherwise know nothing (outlier exposure: Hendrycks, Mazeika and Dietterich 2019).

use crate::critic::simulate::bank::{NUMBERS, PLACES, SHARES};
use crate::critic::simulate::design::Design;
use crate::math::{exp, ln};
use crate::random::standard_normal::quantile;
use crate::random::{Stream, Streams};

/// At most so many forms come together.
const MOST: usize = 3;
/// Sizes of forms, log-uniform, either way: from what no campaign shows to what is plain to see. Logarithm of a factor on the
/// collapse angle.
const FALL: [f64; 2] = [0.02, 0.3];
/// Logarithm of a factor on displacements.
const LEVEL: [f64; 2] = [0.05, 1.5];
/// Logarithm of a factor on pushes: friction bounds what walls bear, joints what they bear at small drifts.
const PUSH: [f64; 2] = [0.03, 1.0];
/// Logarithm of a factor on the scale of motions.
const MOTION: [f64; 2] = [0.05, 1.0];
/// What a wall bows or twists by besides, over its mean displacement.
const SHAPE: [f64; 2] = [0.05, 1.0];
/// What a gauge shows besides (m).
const SHIFT: [f64; 2] = [1e-4, 5e-3];
/// The largest that a gauge shows, where it has an end (m).
const LARGEST: [f64; 2] = [5e-4, 1e-2];
/// No factor on what is shown is beyond this (logarithm): readings stay numbers.
const FURTHEST: f64 = 3.0;
/// The tilt at which what gauges do is fully there, if it grows (rad): 15 deg.
const FULL: f64 = 0.26;

/// What a form acts on.
#[derive(Clone, Copy, Debug, PartialEq)]
enum On {
    /// The collapse angle, and with it all displacements.
    Fall,
    /// A kind of number of the way up: how far walls move (0), bow (1), twist (2).
    Way(usize),
    /// The push of a wall that is sheared.
    Push,
    /// The scale of the motions under which a wall falls, and what it does under them.
    Motion,
    /// What is shown of the left, centre and right points, each by its share: a factor.
    Factor([f64; 3]),
    /// The same: an addition.
    Shift([f64; 3]),
    /// The same: no more than the form's size, for points that have a share.
    End([f64; 3]),
}

/// How it grows from the start (0) to the end (1).
#[derive(Clone, Copy, Debug, PartialEq)]
enum Growth {
    /// With these coefficients, constant first.
    Quadratic([f64; 3]),
    /// Not there before, fully there after.
    Step(f64),
}

/// A form.
#[derive(Clone, Debug, PartialEq)]
struct Form {
    on: On,
    growth: Growth,
    /// By specimen: of one family or of all, alike, at random, or the larger the later they are tested.
    sizes: Vec<f64>,
}

/// What is off in a campaign; by default nothing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Unmodelled(Vec<Form>);

impl Unmodelled {
    /// One to three forms; a pure function of the design and the streams.
    pub fn drawn(design: &Design, streams: &Streams) -> Unmodelled {
        // The name of the stream is part of every draw.
        let mut draws = streams.of("nameless");
        let count = 1 + draws.below(MOST);
        Unmodelled((0..count).map(|_| Form::drawn(design, &mut draws)).collect())
    }

    /// Changes the [adding](crate::critic::Path::adding) numbers of a specimen's path.
    pub fn act(&self, specimen: usize, adding: &mut [f64; NUMBERS]) {
        for Form { on, growth, sizes } in &self.0 {
            match on {
                On::Fall => adding[0] *= exp(sizes[specimen]),
                On::Way(kind) => {
                    let own = &mut adding[1 + kind * PLACES.len()..][..PLACES.len()];
                    for (number, q) in own.iter_mut().zip(PLACES) {
                        *number += sizes[specimen] * growth.at(1.0 - q);
                    }
                }
                On::Push => {
                    let (first, whole) = (ln(SHARES[0]), -ln(SHARES[0]));
                    for (number, share) in adding[1..].iter_mut().zip(SHARES) {
                        *number += sizes[specimen] * growth.at((ln(share) - first) / whole);
                    }
                }
                On::Motion => {
                    let last = (NUMBERS - 1) as f64;
                    for (k, number) in adding[1..].iter_mut().enumerate() {
                        *number += sizes[specimen] * growth.at(k as f64 / last);
                    }
                }
                On::Factor(_) | On::Shift(_) | On::End(_) => {}
            }
        }
    }

    /// What gauges show of a specimen's three points (m) at a tilt (rad).
    pub fn shown(&self, specimen: usize, tilt: f64, mut points: [f64; 3]) -> [f64; 3] {
        for Form { on, growth, sizes } in &self.0 {
            let size = sizes[specimen] * growth.at(tilt / FULL);
            match on {
                On::Factor(shares) => {
                    for (point, share) in points.iter_mut().zip(shares) {
                        *point *= exp((share * size).clamp(-FURTHEST, FURTHEST));
                    }
                }
                On::Shift(shares) => {
                    points.iter_mut().zip(shares).for_each(|(point, share)| *point += share * size);
                }
                On::End(shares) => {
                    let ended = points.iter_mut().zip(shares).filter(|(_, share)| **share != 0.0);
                    ended.for_each(|(point, _)| *point = point.min(sizes[specimen]));
                }
                On::Fall | On::Way(_) | On::Push | On::Motion => {}
            }
        }
        points
    }
}

impl Form {
    fn drawn(design: &Design, draws: &mut Stream) -> Form {
        // A design of sheared walls reads pushes, one of shaken walls what motions do, one of tilted walls neither.
        let is_pushed = design.readings().any(|(_, m)| m.quantity.has_drift());
        let is_shaken = design.readings().any(|(_, m)| m.under.is_some());
        let (on, [least, most]) = match draws.below(7) {
            _ if is_pushed => (On::Push, PUSH),
            _ if is_shaken => (On::Motion, MOTION),
            0 => (On::Fall, FALL),
            1 => (On::Way(0), LEVEL),
            kind @ 2..=3 => (On::Way(kind - 1), SHAPE),
            4 => (On::Factor(shares(draws)), LEVEL),
            5 => (On::End(shares(draws)), LARGEST),
            _ => (On::Shift(shares(draws)), SHIFT),
        };
        let size = least * exp(draws.uniform() * ln(most / least));
        let size = if draws.uniform() < 0.5 { -size } else { size };
        let families = design.families();
        let one = families[draws.below(families.len())];
        let (of_one, spread) = (draws.below(3) == 0, draws.below(4));
        let half = 0.5 * design.specimens.len() as f64;
        let own = design.specimens.iter().enumerate().map(|(index, specimen)| {
            let before = specimen.order.map_or(index as f64, |order| f64::from(order) - 1.0);
            let by = match spread {
                0 => quantile(draws.uniform()),
                1 => before / half,
                _ => 1.0,
            };
            match on {
                On::End(_) if of_one && specimen.family != one => f64::INFINITY,
                // A gauge ends where it ends, whatever is tested.
                On::End(_) => size.abs(),
                _ if of_one && specimen.family != one => 0.0,
                _ => size * by,
            }
        });
        let sizes = own.collect();
        Form { on, sizes, growth: Growth::drawn(draws) }
    }
}

/// Shares of the left, centre and right points in a form: all alike, the ends, the ends against each other, or one of them.
fn shares(draws: &mut Stream) -> [f64; 3] {
    match draws.below(6) {
        0 => [1.0, 1.0, 1.0],
        1 => [1.0, 0.0, 1.0],
        2 => [1.0, 0.0, -1.0],
        one => std::array::from_fn(|point| f64::from(u8::from(point == one - 3))),
    }
}

impl Growth {
    fn drawn(draws: &mut Stream) -> Growth {
        match draws.below(4) {
            0 => Growth::Quadratic([1.0, 0.0, 0.0]),
            1 => Growth::Quadratic([0.0, 1.0, 0.0]),
            2 => Growth::Step(draws.uniform()),
            _ => Growth::Quadratic([0; 3].map(|_| 2.0 * draws.uniform() - 1.0)),
        }
    }

    fn at(&self, x: f64) -> f64 {
        match self {
            Growth::Quadratic([constant, slope, curvature]) => constant + slope * x + curvature * x * x,
            Growth::Step(at) => f64::from(u8::from(x > *at)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::critic::fixture::made;

    /// One form of this size on all specimens.
    fn one(on: On, growth: Growth, size: f64) -> Unmodelled {
        Unmodelled(vec![Form { on, growth, sizes: vec![size; 9] }])
    }

    #[test]
    fn each_form_changes_what_it_acts_on_and_nothing_else() {
        let numbers: [f64; NUMBERS] = std::array::from_fn(|k| 0.1 + k as f64);
        let changed = |of: &Unmodelled| {
            let mut own = numbers;
            of.act(0, &mut own);
            let changed = own.iter().zip(&numbers).enumerate();
            changed.filter(|(_, (own, old))| own != old).map(|(k, (own, _))| (k, *own)).collect::<Vec<_>>()
        };
        let points = [1e-3, 2e-3, 3e-3];
        let always = Growth::Quadratic([1.0, 0.0, 0.0]);
        let fall = one(On::Fall, always, ln(0.5));
        assert_eq!(changed(&fall).len(), 1);
        assert!((changed(&fall)[0].1 - 0.05).abs() < 1e-12 && fall.shown(0, 0.1, points) == points);
        // A bow that grows: nothing upright (the last place), most at the collapse.
        let bow = one(On::Way(1), Growth::Quadratic([0.0, 1.0, 0.0]), 0.4);
        let own = changed(&bow);
        assert_eq!(own.iter().map(|(k, _)| *k).collect::<Vec<_>>(), (7..12).collect::<Vec<_>>());
        assert!((own[0].1 - numbers[7] - 0.4 * 0.85).abs() < 1e-12 && bow.shown(0, 0.1, points) == points);
        // What gauges do leaves walls alone.
        let ends = one(On::Factor([1.0, 0.0, 1.0]), always, ln(2.0));
        assert_eq!(changed(&ends), []);
        let shown = ends.shown(0, 0.1, points);
        assert!((shown[0] - 2e-3).abs() < 1e-15 && shown[1] == 2e-3 && (shown[2] - 6e-3).abs() < 1e-15);
        let knock = one(On::Shift([0.0, 1.0, 0.0]), Growth::Step(0.5), 1e-3);
        assert_eq!(knock.shown(0, 0.1, points), points);
        assert_eq!(knock.shown(0, 0.2, points), [1e-3, 3e-3, 3e-3]);
        let ended = one(On::End([0.0, 1.0, 1.0]), always, 1.5e-3);
        assert_eq!(ended.shown(0, 0.2, points), [1e-3, 1.5e-3, 1.5e-3]);
        assert_eq!(changed(&Unmodelled::default()), []);
    }

    #[test]
    fn forms_of_all_kinds_are_drawn_on_one_family_and_on_all_and_by_the_order_of_the_tests() {
        let made = made();
        let (design, _) = Design::of(&made.study);
        let all: Vec<Form> =
            (0..300).flat_map(|k| Unmodelled::drawn(&design, &Streams::new(5, k)).0).collect();
        assert!(all.len() > 450 && all.len() < 750, "{}", all.len());
        for is in [
            |form: &Form| form.on == On::Fall,
            |form: &Form| form.on == On::Way(2),
            |form: &Form| matches!(form.on, On::Factor(_)),
            |form: &Form| matches!(form.on, On::Shift([1.0, 0.0, -1.0])),
            |form: &Form| matches!(form.on, On::End(_)) && form.sizes.contains(&f64::INFINITY),
            |form: &Form| form.sizes.contains(&0.0),
            |form: &Form| form.sizes.iter().all(|size| *size == form.sizes[0]),
            |form: &Form| form.sizes.windows(2).all(|two| two[0].abs() < two[1].abs()),
            |form: &Form| matches!(form.growth, Growth::Step(_)),
        ] {
            let count = all.iter().filter(|form| is(form)).count();
            assert!(count > 5, "{count}");
        }
        assert_eq!(
            Unmodelled::drawn(&design, &Streams::new(5, 7)),
            Unmodelled::drawn(&design, &Streams::new(5, 7))
        );
    }
}
