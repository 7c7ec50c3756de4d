//! What is computed: the mechanism, its path down to nothing, and the checks.

use std::f64::consts::PI;

use crate::law::{Coulomb, NormalLaw};
use crate::model::{Outcome, Wall};
use crate::protocol::{Pushover, Settlement};
use crate::solve::limit;
use crate::study::{Fit, Site};
use crate::terminal::doing::doing;
use crate::terminal::failure::Failure;
use crate::verb::analyse::ask::{Analyse, FlowName, Growing, LoadName};
use crate::verb::analyse::known::{self, Known, USUAL_STIFFNESS};
use crate::verb::analyse::solve::{law, task};
use crate::verb::analyse::uncertainty::AskedOfWall;
use crate::verb::analyse::unsure::Given;
use crate::verb::analyse::verify::mechanism::Mechanism;
use crate::verb::analyse::verify::over::over;
use crate::verb::analyse::verify::said::Verification;
use crate::verb::arguments::SolverName;
use crate::verify::{BeforeIt, CapacityCurve, Demanded, Verified, judge};

/// Stiffness (Pa/m) of joints that are as good as rigid: codes take stones to be rigid.
const RIGID: f64 = 1e10;
/// How far a wall is followed, in thicknesses of the wall.
const FURTHEST: f64 = 2.0;

/// What is asked in vain of a verification.
pub(crate) fn refused(asked: &Analyse) -> Result<(), Failure> {
    if asked.verify.is_none()
        || matches!(asked.growing(), Growing::Tilt | Growing::Lateral) && asked.load != LoadName::BaseMotion
    {
        return Ok(());
    }
    Err(Failure::Usage(format!(
        "--verify checks the mechanism of an earthquake, a horizontal share of the weight, and --load {} is another load: leave one of them out",
        asked.load.name()
    )))
}

/// A mechanism with its checks.
pub(super) struct Checked {
    pub mechanism: Mechanism,
    /// Its capacity curve, by the displacement of the oscillator.
    pub curve: CapacityCurve,
    /// Period (s) of the wall before the mechanism sets in, with joints of the stiffness that it is taken at.
    pub shakes: f64,
    /// The displacement (m) of the oscillator at which rigid blocks that lean so bear nothing any more, by limit analysis.
    pub rigid: Option<f64>,
    /// Between which of them rigid blocks that are let go turn from going back to going on, by contact dynamics, where that was looked for.
    pub turns: Option<[f64; 2]>,
    pub verified: Verified,
}

/// The wall checked, with a second opinion of where it is spent if that is asked for; why it is not, where it has no mechanism to be checked.
pub(super) fn checked(
    asked: &Analyse,
    (wall, settlements): (&Wall, &[Settlement]),
    fit: &Fit,
    site: &Site,
    second: bool,
) -> Result<Checked, String> {
    let asked = &Analyse { load: LoadName::Lateral, vertical: None, ..asked.clone() };
    let own = law(asked);
    let towards = asked.direction.unit();
    let flow = match asked.flow {
        Some(FlowName::NonAssociative) => limit::Flow::NonAssociative,
        _ => limit::Flow::Associative,
    };
    let settings = limit::Settings { flow, ..limit::Settings::default() };
    let found = limit::Analysis::new(wall, &own, fit.contact, settings)
        .multiplier(&limit::Loads::seismic(towards, 0.0));
    if !matches!(found.outcome, Outcome::Collapsed { .. }) {
        return Err(format!("limit analysis finds no mechanism: {}", found.outcome.reason()));
    }
    let mut mechanism =
        Mechanism::of(wall, &found, towards).ok_or("what moves does not move along the load")?;
    let kn = asked.kn.as_ref().filter(|_| asked.solver().is_elastic()).map_or(RIGID, Known::middle);
    let stiff = Coulomb { normal: NormalLaw::Linear { kn }, ks: asked.ks.unwrap_or(0.5 * kn), ..own };
    let task = task(asked, (wall, settlements), &stiff, fit);
    let far = FURTHEST * fit.thickness;
    let pushed = Pushover::of(&task, mechanism.control, mechanism.multiplier, far)
        .ok_or("with elastic joints it does not come to rest under its own weight")?;
    // What elastic joints bear less than rigid ones, they bear less before the mechanism sets in.
    if asked.solver().is_elastic() {
        let peak = pushed.points.iter().map(|point| point[1]).fold(0.0, f64::max);
        mechanism.multiplier = mechanism.multiplier.min(peak);
    }
    let oscillator = mechanism.oscillator;
    let point = |[moved, level]: &[f64; 2]| {
        [moved * oscillator.per_control, oscillator.acceleration(*level, site.confidence)]
    };
    let curve = CapacityCurve::of(pushed.points.iter().map(point));
    // Joints that are closed give way in proportion to their stiffness.
    let gives = pushed.gives() * oscillator.per_control * kn / softest(asked, kn);
    let shakes = 2.0 * PI * (gives / oscillator.acceleration(1.0, 1.0)).sqrt();
    let before = match (site.held, site.period) {
        (true, _) => BeforeIt::Held,
        (false, Some(period)) => BeforeIt::Shakes(period),
        (false, None) => BeforeIt::UpTo(shakes),
    };
    let rigid = second.then(|| pushed.rigid_end(&task)).flatten();
    let lets_go = second && asked.solvers.contains(&SolverName::Nonsmooth);
    let turns = lets_go.then(|| pushed.let_go(task.path.loads(0.0))).flatten();
    let demanded = Demanded {
        code: site.code.clone(),
        confidence: site.confidence,
        life: site.life.clone(),
        collapse: site.collapse.clone(),
        place: site.place.clone(),
        before,
    };
    let verified = judge(&oscillator, mechanism.multiplier, &curve, &demanded);
    let of_oscillator = |moved: f64| moved * oscillator.per_control;
    Ok(Checked {
        mechanism,
        curve,
        shakes,
        rigid: rigid.map(of_oscillator),
        turns: turns.map(|ends| ends.map(of_oscillator)),
        verified,
    })
}

/// The softest joints (Pa/m) that the wall may have: the longest period asks most of it.
fn softest(asked: &Analyse, kn: f64) -> f64 {
    match asked.kn.as_ref().filter(|_| asked.solver().is_elastic()) {
        Some(stated) => stated.low(),
        None => known::stiffness(USUAL_STIFFNESS).map_or(kn, |usual| usual.low()),
    }
}

/// The file of the site, before the wall is read: what is wrong with it is said before anything is computed.
pub(crate) fn site(asked: &Analyse) -> Result<Option<Site>, Failure> {
    let read = asked.verify.as_deref().map(Site::read).transpose();
    read.map_err(|faults| Failure::Input(faults.to_string()))
}

/// The wall against its site.
pub(crate) fn verified(
    given: &Given<'_>,
    wall: &Wall,
    asked_of_wall: &[AskedOfWall],
    site: Site,
) -> Result<Verification, Failure> {
    let checked = doing("following the mechanism", |_| {
        checked(given.arguments, (wall, given.settlements), given.fit, &site, true)
    });
    let over = over(given, asked_of_wall, &site)?;
    Ok(Verification { site, checked, over })
}
