//! Campaigns of walls whose formula is known, for the tests of every stage.

use std::sync::OnceLock;

use crate::critic::discrepancy::Reference;
use crate::critic::simulate::bank::tests::shipped;
use crate::critic::simulate::{Bank, Design, NUMBERS, Path, Plan, World};
use crate::critic::verdict::{Effort, Judge};
use crate::math::{ln, radians};
use crate::random::Streams;
use crate::random::standard_normal::quantile;
use crate::study::{Described, Nuisance, Study};

/// A score of the scatter between specimens at which there is none.
pub(crate) const ALIKE: f64 = -40.0;

/// A study with a bank that no solver made.
pub(crate) struct Made {
    pub(crate) study: Study,
    pub(crate) mechanisms: Vec<Described>,
    pub(crate) nuisances: [Nuisance; 3],
    pub(super) plan: Plan,
    pub(super) bank: Bank,
}

/// The nine walls, of a bank that no solver made: the collapse angle goes with kn and phi, displacements go with 1/kn, stones make
/// 2 % of difference.
pub(crate) fn made() -> Made {
    let (study, mechanisms, nuisances) = shipped();
    let plan = Plan::new(&study, &mechanisms, &nuisances, 45).unwrap_or_else(|f| panic!("{f}"));
    let path = |wall: usize| {
        let place = &plan.places[wall];
        let [kn, phi, _] = place.joints;
        // A point has the same stones under every cause.
        let mut noise = Streams::new(5, place.point).of(&format!("stones {}", place.family));
        let mut draw = |sd: f64| if place.family == 0 { 0.0 } else { sd * quantile(noise.uniform()) };
        let mut numbers = [0.0; NUMBERS];
        numbers[0] = ln(radians([19.0, 14.5, 19.5][place.family])) + 0.05 * kn + 0.01 * phi + draw(0.02);
        let level = draw(0.05);
        for k in 0..6 {
            numbers[1 + k] = ln(0.02) + 0.3 * (1.0 - f64::from(k as u32) / 5.0) - 0.4 * kn + level;
            numbers[7 + k] = if place.family == 2 { 0.4 } else { 0.02 } + draw(0.02);
            numbers[13 + k] = draw(0.05);
        }
        // Two causes that do something: one weakens, one lets the wall move.
        let strength = || 2.0 * place.parameters[0] - 1.0;
        match place.cause.map(|cause| mechanisms[cause].name) {
            Some("lean") => numbers[0] -= 0.2 * strength(),
            Some("creep") => {
                numbers[1..7].iter_mut().for_each(|x| *x += 2.0 * (1.0 + strength()));
                numbers[19..25].iter_mut().for_each(|x| *x += 0.4 * (1.0 + strength()));
            }
            _ => {}
        }
        Some(Path { numbers })
    };
    let paths: Vec<Option<Path>> = (0..plan.places.len()).map(path).collect();
    let endings = vec!["collapsed".to_string(); paths.len()];
    Made { study, mechanisms, nuisances, plan, bank: Bank { paths, endings } }
}

impl Made {
    pub(crate) fn world(&self) -> World<'_> {
        World::new(&self.study, &self.mechanisms, &self.nuisances, &self.plan, &self.bank)
            .expect("enough walls")
    }

    /// The same walls, but for those of a cause at the upper quantiles of its first parameter, which do not stand at rest.
    pub(super) fn falling(mut self, cause: usize, from: f64) -> Made {
        for (wall, place) in self.plan.places.iter().enumerate() {
            if place.cause == Some(cause) && place.parameters[0] > from {
                self.bank.paths[wall] = None;
                self.bank.endings[wall] = "unstable_at_rest".to_string();
            }
        }
        self
    }

    /// The same walls, but a cause lets them move further, by up to 55 times at the upper end of its first parameter.
    pub(crate) fn moving(mut self, cause: usize) -> Made {
        for (place, path) in self.plan.places.iter().zip(&mut self.bank.paths) {
            if let Some(path) = path.as_mut().filter(|_| place.cause == Some(cause)) {
                path.numbers[1..7].iter_mut().for_each(|x| *x += 4.0 * place.parameters[0]);
            }
        }
        self
    }

    /// Index of a mechanism.
    pub(crate) fn cause(&self, name: &str) -> usize {
        self.mechanisms.iter().position(|m| m.name == name).expect("in the catalogue")
    }

    /// The base model as the paper's design sees it.
    pub(super) fn reference(&self) -> (World<'_>, Design, Reference) {
        let (world, (design, _)) = (self.world(), Design::of(&self.study));
        let reference = Reference::new(&world, &design, 1000, 77).expect("it can be told");
        (world, design, reference)
    }
}

/// Enough for a made-up bank of few ways to differ.
pub(super) const EFFORT: Effort = Effort { reference: 1000, training: 300 };

/// The nine walls and who judges campaigns of the paper's design: he is trained once for all tests that ask him.
pub(super) fn judged() -> (&'static Made, &'static Judge<'static>) {
    static MADE: OnceLock<Made> = OnceLock::new();
    static WORLD: OnceLock<World<'static>> = OnceLock::new();
    static JUDGE: OnceLock<Judge<'static>> = OnceLock::new();
    let made = MADE.get_or_init(made);
    let world = WORLD.get_or_init(|| made.world());
    let (design, _) = Design::of(&made.study);
    (made, JUDGE.get_or_init(|| Judge::trained(world, &design, EFFORT, 5).expect("it can be told")))
}
