//! How sure the answer is, where parameters are only known within ranges: the wall is solved over a design, and at the ends of each.

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use crate::ensemble::{Observed, Unsure, given_points};
use crate::exchange::WallFile;
use crate::model::{Outcome, Wall};
use crate::protocol::{Settlement, Witness};
use crate::study::Fit;
use crate::terminal::doing::doing;
use crate::terminal::failure::Failure;
use crate::verb::analyse::answer::Answer;
use crate::verb::analyse::ask::{Analyse, Growing};
use crate::verb::analyse::fall::Fall;
use crate::verb::analyse::known::Known;
use crate::verb::analyse::loads::loaded;
use crate::verb::analyse::solve::{BRACKET, BRACKET_DEG, BRACKET_M, law, solve_seen_by};
use crate::verb::analyse::state::{Found, State};
use crate::verb::analyse::uncertainty::{Answered, AskedOfWall, Ended, UncertaintySummary};
use crate::verb::analyse::worst::bears;

/// Walls of a design where no number is asked for, and its seed.
pub(crate) const WALLS: u64 = 64;
pub(crate) const SEED: u64 = 1;
/// Less than this share of the weight that stays is none.
const WHOLE: f64 = 0.999;

/// A parameter that may be a range: its name, its unit, what it is in words.
type Parameter = (&'static str, &'static str, &'static str);
/// All of them, in the order of their dimensions in a design.
const PHI: Parameter = ("phi_deg", "deg", "friction");
const KN: Parameter = ("kn_pa_per_m", "Pa/m", "stiffness");
const DENSITY: Parameter = ("density_kg_per_m3", "kg/m^3", "density");

/// The parameters that are not known exactly.
pub(crate) fn asked(arguments: &Analyse) -> Vec<AskedOfWall> {
    let all =
        [(PHI, Some(&arguments.phi_deg)), (KN, arguments.kn.as_ref()), (DENSITY, arguments.density.as_ref())];
    let spread = |(dimension, ((name, unit, word), known)): (u32, (Parameter, Option<&Known>))| match known? {
        Known::Exactly(_) => None,
        Known::Within { stated, spread } => {
            let unsure = Unsure { name, dimension, spread: spread.clone() };
            Some(AskedOfWall { unsure, stated: stated.clone(), unit, word })
        }
    };
    (0..).zip(all).filter_map(spread).collect()
}

/// What is asked in vain of ranges, or of a design without any.
pub(crate) fn refused(arguments: &Analyse) -> Result<(), Failure> {
    let asked = asked(arguments);
    if asked.is_empty() && (arguments.walls.is_some() || arguments.seed.is_some()) {
        return Err(Failure::Usage(
            "--walls and --seed are for a design over ranges, and all parameters are numbers: give one a range, as --phi-deg 30..38, \
             or leave them out"
                .to_owned(),
        ));
    }
    if !arguments.solver().is_elastic() && asked.iter().any(|own| own.unsure.name == KN.0) {
        return Err(Failure::Usage(format!(
            "--kn takes a range for elastic joints, and {} is of rigid blocks, whose joints have no stiffness: ask --solver implicit, \
             or leave --kn out",
            arguments.solver().method()
        )));
    }
    Ok(())
}

/// What a wall is solved with besides its parameters.
pub(crate) struct Given<'g> {
    /// The arguments, towards the direction that is answered for.
    pub arguments: &'g Analyse,
    /// The file as it was read.
    pub file: &'g WallFile,
    /// Where its blocks meet.
    pub fit: &'g Fit,
    /// The supports that go down.
    pub settlements: &'g [Settlement],
}

/// What came of the wall at some values: how it ended, how it falls, and whether all of it does.
type Came = (Ended, Option<Fall>, bool);

impl Given<'_> {
    /// How sure the answer at the middle values is; `None` where all parameters are known exactly.
    pub fn how_sure(
        &self,
        asked: Vec<AskedOfWall>,
        (wall, answer, found): (&Wall, &Answer, &Found),
    ) -> Result<Option<UncertaintySummary>, Failure> {
        if asked.is_empty() {
            return Ok(None);
        }
        let unsure: Vec<Unsure> = asked.iter().map(|own| own.unsure.clone()).collect();
        let walls = self.arguments.walls.unwrap_or(WALLS);
        let seed = self.arguments.seed.unwrap_or(SEED);
        let points = given_points(&unsure, seed, walls);
        let middle: Vec<f64> = unsure.iter().map(|own| own.spread.middle()).collect();
        let at_end = |k: usize, value: f64| {
            let mut values = middle.clone();
            values[k] = value;
            values
        };
        let ends = unsure.iter().enumerate().flat_map(|(k, own)| own.spread.ends().map(|end| at_end(k, end)));
        let all: Vec<Vec<f64>> = points.iter().cloned().chain(ends).collect();
        let mut came = self.all_solved(&asked, &all)?;
        let ends = came.split_off(points.len());
        let at_middle = self.came(wall, answer, found);
        let why: Vec<Option<String>> =
            asked.iter().zip(ends.chunks(2)).map(|(own, ends)| self.why(own, &at_middle, ends)).collect();
        let ends: Vec<[Ended; 2]> =
            ends.chunks(2).map(|pair| [&pair[0], &pair[1]].map(|came| came.0.clone())).collect();
        let points = points.into_iter().zip(came.into_iter().map(|came| came.0)).collect();
        Ok(Some(UncertaintySummary::of((asked, self.answered(), seed), &at_middle.0, &ends, points, why)))
    }

    /// What came of the wall at all values, in their order on any number of threads.
    fn all_solved(&self, asked: &[AskedOfWall], all: &[Vec<f64>]) -> Result<Vec<Came>, Failure> {
        doing(&format!("solving {} walls over the ranges", all.len()), |doing| {
            let done = AtomicUsize::new(0);
            let solved = all.par_iter().map(|values| {
                let came = self.solved(asked, values);
                doing.say(format!("{} done", 1 + done.fetch_add(1, Ordering::Relaxed)));
                came
            });
            solved.collect()
        })
    }

    /// The arguments and the wall at some values of its parameters.
    pub fn varied(&self, asked: &[AskedOfWall], values: &[f64]) -> Result<(Analyse, Wall), Failure> {
        let mut own = self.arguments.clone();
        for (parameter, &value) in asked.iter().zip(values) {
            let known = Known::Exactly(value);
            match parameter.unsure.name {
                name if name == PHI.0 => own.phi_deg = known,
                name if name == KN.0 => own.kn = Some(known),
                _ => own.density = Some(known),
            }
        }
        let wall = loaded(self.file, own.density.as_ref().map(Known::middle), &own.dead_loads)?;
        Ok((own, wall))
    }

    fn solved(&self, asked: &[AskedOfWall], values: &[f64]) -> Result<Came, Failure> {
        let (own, wall) = self.varied(asked, values)?;
        let (answer, found) =
            solve_seen_by(&own, (&wall, self.settlements), &law(&own), self.fit, Witness::NOBODY);
        Ok(self.came(&wall, &answer, &found))
    }

    fn came(&self, wall: &Wall, answer: &Answer, found: &Found) -> Came {
        let observed = match (&answer.outcome, bears(&answer.outcome)) {
            (_, Some(load)) => Observed::Value(load),
            (Outcome::Equilibrium | Outcome::Unbounded, _) => Observed::Above(answer.largest(self.arguments)),
            _ => Observed::Nothing,
        };
        let fall = Fall::of(&State::of(wall, &self.fit.contact, found), &answer.moving);
        let is_whole = answer.moving_share(wall) > WHOLE;
        (Ended { outcome: answer.name(), observed }, fall, is_whole)
    }

    /// Why a parameter does not matter, if it does not: what the mechanisms at its middle and its ends have in common.
    fn why(&self, own: &AskedOfWall, middle: &Came, ends: &[Came]) -> Option<String> {
        let by_weight = matches!(self.arguments.growing(), Growing::Tilt | Growing::Lateral);
        let is_dry = by_weight && self.arguments.cohesion == 0.0 && self.arguments.dead_loads.is_empty();
        match own.unsure.name {
            name if name == PHI.0 => {
                let (_, fall, is_whole) = middle;
                let is_alike = ends.iter().all(|(_, other, whole)| (other, whole) == (fall, is_whole));
                fall.filter(|_| is_alike).map(|fall| fall.without_friction(*is_whole))
            }
            name if name == DENSITY.0 && !self.arguments.solver().is_elastic() && is_dry => {
                Some("of rigid blocks with dry joints all forces grow with the weight".to_owned())
            }
            _ => None,
        }
    }

    fn answered(&self) -> Answered {
        match self.arguments.growing() {
            Growing::Tilt => Answered { name: "collapse_angle_deg", unit: "deg", resolution: BRACKET_DEG },
            Growing::Lateral => Answered { name: "multiplier", unit: "of its weight", resolution: BRACKET },
            Growing::Height => Answered { name: "collapse_height_m", unit: "m", resolution: BRACKET_M },
            Growing::Factor => Answered { name: "factor", unit: "times the load", resolution: BRACKET },
        }
    }
}
