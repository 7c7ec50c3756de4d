//! The methods, and which one is expected to take the fewest walls.

use clap::ValueEnum;

use crate::ensemble::rare::Pilot;
use crate::stats::effort;
use crate::terminal::output;

/// How rare values are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Method {
    /// Every wall counts alike.
    Plain,
    /// Walls that limit analysis expects near the level are solved more often than others, and count less.
    Stratified,
    /// Parameters that are drawn once per wall are shifted towards low values, and walls count by how likely they are without.
    Importance,
    /// Subset simulation over the walls' own random numbers.
    Subset,
}

impl Method {
    /// Its name in files and on the screen.
    pub fn name(self) -> &'static str {
        match self {
            Method::Plain => "plain",
            Method::Stratified => "stratified",
            Method::Importance => "importance",
            Method::Subset => "subset",
        }
    }
}

/// A method with what it is expected to take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Expected {
    pub method: Method,
    /// Walls for a coefficient of variation of 1.
    pub effort: f64,
    /// Of stratified sampling: whether subset simulation by limit analysis comes first.
    pub goes_down: bool,
}

/// All methods that can be used, the one that is expected to take the fewest walls first.
pub(crate) fn expected(pilot: &Pilot) -> Vec<Expected> {
    let of = |method, effort| Expected { method, effort, goes_down: false };
    let mut all =
        vec![of(Method::Plain, effort::plain(pilot.index)), of(Method::Subset, effort::subset(pilot.index))];
    if let Some(limit) = &pilot.limit {
        let evenly = effort::stratified(pilot.index, limit.rho, limit.cost);
        let down = effort::stratified_subset(pilot.index, limit.rho, limit.cost);
        let goes_down = down < evenly;
        all.push(Expected { method: Method::Stratified, effort: down.min(evenly), goes_down });
    }
    if let Some(parameters) = &pilot.parameters {
        all.push(of(Method::Importance, effort::importance(pilot.index, parameters.explained).0));
    }
    all.sort_by(|a, b| a.effort.total_cmp(&b.effort));
    all
}

/// Says what each is expected to take for a coefficient of variation, and which is used.
pub(crate) fn tell(name: &str, all: &[Expected], used: Method, cov: f64) {
    let walls = |own: &Expected| format!("{} {:.0}", own.method.name(), (own.effort / (cov * cov)).ceil());
    let list: Vec<String> = all.iter().map(walls).collect();
    output::note(&format!(
        "{name}: walls expected for a COV of {:.0} %: {}; method: {}",
        100.0 * cov,
        list.join(", "),
        used.name()
    ));
}
