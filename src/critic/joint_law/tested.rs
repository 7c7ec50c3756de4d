//! The tests that a law is learnt from, and what the walls of a study show of them under any law.

use std::collections::BTreeMap;
use std::sync::Mutex;

use rayon::prelude::*;

use crate::critic::compare::{Simulated, at_rest, simulated};
use crate::critic::joint_law::form::Knots;
use crate::critic::simulate::{Design, Specimen};
use crate::ensemble::{Row, Task, build, evaluate, is_random, weight};
use crate::math::{atan, cos, ln, radians, tan};
use crate::model::Outcome;
use crate::protocol::Protocol;
use crate::study::{Arm, MeasuredKind, MeasuredQuantity, Measurement, Nuisance, Study};

/// Knots of a law.
pub const KNOTS: usize = 7;
/// Walls of a family whose stones are drawn.
const WALLS: u64 = 4;
/// From this share of the mean stress on the bed of the wall to so many times the stress under its toe.
const REACH: [f64; 2] = [0.1, 3.0];
/// The least share of its thickness on which a wall is taken to stand, when its toe is looked at.
const LEAST_STAND: f64 = 0.15;
/// How steeply a wall that has fallen is taken to have moved on, over the tilt at which it fell.
const FALLING: f64 = 5.0;

/// What is asked of a wall at a try: logarithms of the compliance at the knots, and scores of friction and of kn over ks in their
/// priors.
#[derive(Clone, Debug, PartialEq)]
pub struct Try {
    pub ln_compliance: Vec<f64>,
    pub scores: [f64; 2],
}

/// The readings of a specimen under a law.
#[derive(Clone, Debug, PartialEq)]
pub struct Shown {
    /// The mean over the walls, reading by reading (SI).
    pub means: Vec<f64>,
    /// What each wall differs by from it.
    pub apart: Vec<Vec<f64>>,
}

/// A try by the bits of its numbers, and how many walls of a family are asked for at most.
type Key = (Vec<u64>, u64);

/// Specimens whose joints are stated the same, and the study that simulates them.
pub struct Tested<'s> {
    study: Study,
    nuisances: &'s [Nuisance; 3],
    /// Index of their arms.
    pub families: Vec<usize>,
    /// The specimens.
    pub specimens: Vec<Specimen>,
    /// The knots of a law.
    pub knots: Knots,
    /// Stresses (Pa) that press on the beds of these walls: a quarter of the mean on the lowest one, and that under the toe at the
    /// largest tilt at which a wall was seen.
    pub seen: [f64; 2],
    /// Walls by family.
    walls: Vec<u64>,
    /// What was shown at a try by so many walls of a family at most. Fits ask for the same again: of all specimens, and of some.
    kept: Mutex<BTreeMap<Key, Option<Vec<Shown>>>>,
}

impl<'s> Tested<'s> {
    /// Of the families whose joints are stated as those of the family with most displacements; `None` where no displacement was read, or
    /// where joints have a law of their own already.
    pub fn of(study: &Study, design: &Design, nuisances: &'s [Nuisance; 3]) -> Option<Tested<'s>> {
        let read = |family: usize| {
            let own = design.specimens.iter().filter(|specimen| specimen.family == family);
            own.flat_map(|specimen| &specimen.readings)
                .filter(|m| m.tilt.is_some() && !m.kind.is_censored())
                .count()
        };
        let families = design.families();
        let first = families.iter().copied().max_by_key(|&family| (read(family), usize::MAX - family))?;
        if read(first) == 0 {
            return None;
        }
        let arms = &study.arms;
        let same_joints = |family: &usize| {
            arms[*family].joint == arms[first].joint && arms[*family].kn_points == arms[first].kn_points
        };
        let families: Vec<usize> = families.into_iter().filter(same_joints).collect();
        families.iter().all(|&family| arms[family].is_free_to_close()).then_some(())?;
        let specimens: Vec<Specimen> =
            design.specimens.iter().filter(|specimen| families.contains(&specimen.family)).cloned().collect();
        let seen = seen(study, &specimens)?;
        let knots = Knots::between(REACH[0] * 4.0 * seen[0], REACH[1] * seen[1], KNOTS);
        let walls = families.iter().map(|&family| if is_random(&arms[family]) { WALLS } else { 1 });
        let walls = walls.collect();
        let study = finely_tilted(study.clone().without_limit_analysis(), &specimens);
        Some(Tested { study, nuisances, families, specimens, knots, seen, walls, kept: Mutex::default() })
    }

    /// The logarithm of the compliance (m/Pa) that is stated.
    pub fn stated(&self) -> f64 {
        let arm = &self.study.arms[self.families[0]];
        -ln(arm.kn_points[arm.middle_point()])
    }

    /// The arm of a family as a try has it: its law, its friction and its ratio of stiffnesses.
    pub fn arm(&self, family: usize, of: &Try) -> Option<Arm> {
        let arm = &self.study.arms[family];
        let [_, phi, ratio] = self.nuisances;
        let factors = [1.0, phi.prior.at_score(of.scores[0]), ratio.prior.at_score(of.scores[1])];
        let with = arm.with_joints(arm.kn_points[arm.middle_point()], factors);
        with.closing_along(&self.knots.closures(&of.ln_compliance), self.knots.stresses())
    }

    /// What the specimens show under each try, by so many walls of a family at most; `None` for one that has no walls to tell of.
    pub fn shown(&self, tries: &[Try], most: u64) -> Vec<Option<Vec<Shown>>> {
        let key = |own: &Try| {
            let numbers = own.ln_compliance.iter().chain(&own.scores);
            (numbers.map(|x| x.to_bits()).collect::<Vec<u64>>(), most)
        };
        let all = || self.kept.lock().expect("nothing panics that holds it");
        let new: Vec<&Try> = tries.iter().filter(|own| !all().contains_key(&key(own))).collect();
        let simulated = self.simulated(&new, most);
        all().extend(new.iter().map(|own| key(own)).zip(simulated));
        tries.iter().map(|own| all()[&key(own)].clone()).collect()
    }

    fn simulated(&self, tries: &[&Try], most: u64) -> Vec<Option<Vec<Shown>>> {
        let places = tries.iter().enumerate().flat_map(|(at, _)| {
            let walls = self.walls.iter().enumerate();
            walls.flat_map(move |(family, &count)| {
                (0..count.min(most)).map(move |member| (at, family, member))
            })
        });
        let studies: Vec<Option<Study>> = tries.iter().map(|own| self.study_of(own)).collect();
        let rows: Vec<((usize, usize), Option<Row>)> = places
            .collect::<Vec<_>>()
            .into_par_iter()
            .map(|(at, family, member)| {
                let task = Task { arm: self.families[family] as u32, point: 0, member };
                ((at, family), studies[at].as_ref().map(|study| evaluate(study, task)))
            })
            .collect();
        let of = |at: usize| {
            let specimens = self.specimens.iter().map(|specimen| {
                let family = self.families.iter().position(|&family| family == specimen.family)?;
                let own = rows.iter().filter(|(place, _)| *place == (at, family));
                let walls: Vec<Vec<f64>> =
                    own.filter_map(|(_, row)| shown_by(specimen, row.as_ref()?)).collect();
                (!walls.is_empty()).then(|| Shown::of(&walls))
            });
            specimens.collect::<Option<Vec<Shown>>>()
        };
        (0..tries.len()).map(of).collect()
    }

    /// The collapse angle (rad) of a wall of a family under a try, 0 where it does not stand; `None` where it could not be solved.
    pub fn collapse(&self, family: usize, own: &Try, member: u64) -> Option<f64> {
        let task = Task { arm: family as u32, point: 0, member };
        let row = evaluate(&self.study_of(own)?, task);
        match row.outcome {
            Outcome::UnstableAtRest => Some(0.0),
            _ => row.collapse_angle_deg().map(radians),
        }
    }

    /// The study with a try's law in its families.
    fn study_of(&self, own: &Try) -> Option<Study> {
        let mut study = self.study.clone();
        for &family in &self.families {
            study.arms[family] = self.arm(family, own)?;
        }
        Some(study)
    }
}

impl Shown {
    fn of(walls: &[Vec<f64>]) -> Shown {
        let count = walls.len() as f64;
        let means: Vec<f64> =
            (0..walls[0].len()).map(|k| walls.iter().map(|wall| wall[k]).sum::<f64>() / count).collect();
        let apart = walls.iter().map(|wall| wall.iter().zip(&means).map(|(x, mean)| x - mean).collect());
        Shown { apart: apart.collect(), means }
    }
}

/// What a wall shows of a specimen's readings; `None` for a wall that could not be built or solved.
fn shown_by(specimen: &Specimen, row: &Row) -> Option<Vec<f64>> {
    specimen.readings.iter().map(|m| one(m, row)).collect()
}

fn one(m: &Measurement, row: &Row) -> Option<f64> {
    match simulated(m.quantity, m.tilt, row)? {
        Simulated::Value(value) | Simulated::Above(value) => Some(value),
        Simulated::Nothing => None,
        // It would have moved on: a try whose walls fall too early is led back by how much too early.
        Simulated::FellBefore => {
            let (last, tilt) = (at_rest(row).last().map_or(0.0, |(tilt, _)| radians(*tilt)), m.tilt?);
            let moved = match simulated(m.quantity, Some(last), row)? {
                Simulated::Value(moved) => moved,
                _ => 0.0,
            };
            let share = if last > 0.0 { tilt / last - 1.0 } else { 1.0 };
            Some((moved.abs() + 1e-4) * (1.0 + FALLING * share))
        }
    }
}

/// See [`Tested::seen`].
fn seen(study: &Study, specimens: &[Specimen]) -> Option<[f64; 2]> {
    let mut seen = [f64::INFINITY, 0.0f64];
    for specimen in specimens {
        let arm = &study.arms[specimen.family];
        let outline = &arm.layout.outline;
        let wall = (0..20).find_map(|member| build(study, specimen.family as u32, member).ok())?.wall;
        let pressed = weight(&wall) / outline.length;
        let (b, t) = (outline.base_thickness, outline.top_thickness);
        let height = outline.height / 3.0 * (b + 2.0 * t) / (b + t);
        // A wall may have been seen at a tilt, and it was seen to fall.
        let most = specimen.readings.iter().filter_map(|m| match m.quantity {
            MeasuredQuantity::CollapseAngle if m.kind != MeasuredKind::Above => Some(m.value),
            _ => m.tilt,
        });
        let tilt = most.fold(0.0, f64::max).min(atan(b / (2.0 * height)));
        // Pressure in a triangle over three times the distance of its resultant from the toe.
        let stands = (3.0 * (0.5 * b - height * tan(tilt))).clamp(LEAST_STAND * b, b);
        seen = [seen[0].min(0.25 * pressed / b), seen[1].max(2.0 * pressed * cos(tilt) / stands)];
    }
    (seen[0] < seen[1]).then_some(seen)
}

/// The study with steps of the tilt as fine as the readings, and going back where something was read of that.
fn finely_tilted(mut study: Study, specimens: &[Specimen]) -> Study {
    let readings = || specimens.iter().flat_map(|specimen| &specimen.readings);
    if readings().any(|m| m.quantity.is_remainder()) {
        study = study.with_remainders();
    }
    let mut tilts: Vec<f64> = readings().filter_map(|m| m.tilt).chain([0.0]).collect();
    tilts.sort_by(f64::total_cmp);
    let apart = tilts.windows(2).map(|two| two[1] - two[0]).filter(|apart| *apart > 1e-6);
    let finest = apart.fold(f64::INFINITY, f64::min);
    if let Protocol::Tilting(tilting) = &mut study.protocol {
        tilting.step = tilting.step.min(finest.max(radians(0.5)));
    }
    study
}
