//! What other solvers say of the same wall, and where they differ by more than what they mean explains.

use std::time::Instant;

use serde_json::{Value, json};

use crate::math::compact;
use crate::model::{Outcome, Wall};
use crate::protocol::{Settlement, Witness};
use crate::study::Fit;
use crate::terminal::doing::doing;
use crate::verb::analyse::answer::Answer;
use crate::verb::analyse::ask::Analyse;
use crate::verb::analyse::known::Known;
use crate::verb::analyse::solve::{law, solve_seen_by};
use crate::verb::arguments::SolverName;

/// Answers this near to each other (share of the larger one) are one: brackets, and what a wall leans by from step to step.
const ALIKE: f64 = 0.01;
/// By how much the joints are made stiffer to see whether their stiffness explains a difference.
const STIFFER: f64 = 10.0;

/// What a solver says.
struct Opinion {
    solver: SolverName,
    answer: Answer,
    seconds: f64,
}

/// What several solvers say of a wall.
pub(crate) struct Opinions {
    all: Vec<Opinion>,
    /// In a sentence how they stand to each other.
    verdict: Verdict,
}

/// How opinions stand to each other.
struct Verdict {
    /// Whether they agree, or differ by what they mean.
    is_explained: bool,
    words: String,
}

/// Asks the other solvers that are named; `None` where none is. `first` is the answer of the first one.
pub(crate) fn opinions(
    arguments: &Analyse,
    wall: (&Wall, &[Settlement]),
    fit: &Fit,
    first: (&Answer, f64),
) -> Option<Opinions> {
    let (main, others) = arguments.solvers.split_first()?;
    if others.is_empty() {
        return None;
    }
    let ask = |solver: SolverName, stiffer: f64| {
        let mut asked = Analyse { solvers: vec![solver], ..arguments.clone() };
        asked.kn = asked.kn.map(|kn| Known::Exactly(stiffer * kn.middle()));
        asked.ks = asked.ks.map(|ks| stiffer * ks);
        let begun = Instant::now();
        let what = format!("a second opinion by {}", solver.method());
        let (answer, _) = doing(&what, |_| solve_seen_by(&asked, wall, &law(&asked), fit, Witness::NOBODY));
        Opinion { solver, answer, seconds: begun.elapsed().as_secs_f64() }
    };
    let mut all = vec![Opinion { solver: *main, answer: first.0.clone(), seconds: first.1 }];
    all.extend(others.iter().map(|solver| ask(*solver, 1.0)));
    let kn = arguments.kn.as_ref().map_or(0.0, Known::middle);
    let verdict = verdict(&all, kn, &|solver| ask(solver, STIFFER).answer);
    Some(Opinions { all, verdict })
}

impl Opinions {
    /// A line per solver, and the sentence.
    pub fn text(&self, asked: &Analyse) -> String {
        let mut text = String::from("  by other solvers:\n");
        for own in &self.all[1..] {
            let of = Analyse { solvers: vec![own.solver], ..asked.clone() };
            text += &format!(
                "    {}: {} ({})\n",
                own.solver.name(),
                own.answer.headline(&of),
                own.answer.meaning
            );
        }
        text + &format!("  {}\n", self.verdict.words)
    }

    /// The same in the JSON object.
    pub fn object(&self) -> Value {
        let of = |own: &Opinion| {
            json!({
                "solver": own.solver.name(),
                "outcome": own.answer.name(),
                "collapse_multiplier": own.answer.collapse_multiplier(),
                "meaning": own.answer.meaning,
                "seconds": own.seconds,
            })
        };
        let all: Vec<Value> = self.all.iter().map(of).collect();
        json!({ "solvers": all, "agree": self.verdict.is_explained, "finding": self.verdict.words })
    }

    /// The sentence, as a warning where nothing explains the difference.
    pub fn warning(&self) -> Option<String> {
        (!self.verdict.is_explained).then(|| self.verdict.words.clone())
    }
}

/// How opinions stand to each other; `stiffer` asks an elastic solver again with stiffer joints.
fn verdict(all: &[Opinion], kn: f64, stiffer: &dyn Fn(SolverName) -> Answer) -> Verdict {
    if let Some(verdict) = ends_differ(all) {
        return verdict;
    }
    let loads: Vec<(SolverName, f64)> =
        all.iter().filter_map(|own| Some((own.solver, own.answer.collapse_multiplier()?))).collect();
    let Some(most) = loads.iter().map(|(_, at)| *at).reduce(f64::max) else {
        let words = format!("all solvers say the same: {}", ended(&all[0].answer));
        return Verdict { is_explained: true, words };
    };
    let near = |a: f64, b: f64| (a - b).abs() <= ALIKE * most;
    let (elastic, rigid): (Vec<_>, Vec<_>) =
        loads.iter().copied().partition(|(solver, _)| solver.is_elastic());
    let findings = [
        rigid_blocks(&rigid, &near),
        elastic_joints(&elastic, &near),
        softness(&rigid, &elastic, &near, kn, &|solver| stiffer(solver).collapse_multiplier()),
    ];
    let findings: Vec<Verdict> = findings.into_iter().flatten().collect();
    if findings.is_empty() {
        let ends: Vec<String> = loads.iter().map(|(_, at)| format!("{at:.4}")).collect();
        let words = format!("collapse multipliers {}", ends.join(", "));
        return Verdict { is_explained: true, words };
    }
    let words: Vec<&str> = findings.iter().map(|own| own.words.as_str()).collect();
    Verdict { is_explained: findings.iter().all(|own| own.is_explained), words: words.join("; ") }
}

/// The verdict where the solvers end in different ways.
fn ends_differ(all: &[Opinion]) -> Option<Verdict> {
    if all.iter().all(|own| own.answer.name() == all[0].answer.name()) {
        return None;
    }
    let said: Vec<String> =
        all.iter().map(|own| format!("{} by {}", ended(&own.answer), own.solver.method())).collect();
    let said = said.join(", ");
    let is_explained = all.iter().any(|own| own.answer.undecided.is_some());
    let words = match is_explained {
        true => format!("the solvers end differently, as rigid blocks leave open which: {said}"),
        false => format!(
            "the solvers contradict each other: {said}; look at the joints: faces that are not one plane (--mend), gaps, wedges"
        ),
    };
    Some(Verdict { is_explained, words })
}

/// Contact dynamics beside limit analysis, where both were asked.
fn rigid_blocks(rigid: &[(SolverName, f64)], near: &dyn Fn(f64, f64) -> bool) -> Option<Verdict> {
    let of = |solver: SolverName| rigid.iter().find(|(own, _)| *own == solver).map(|(_, at)| *at);
    let (bound, found) = (of(SolverName::Limit)?, of(SolverName::Nonsmooth)?);
    let words = if near(bound, found) {
        format!(
            "rigid blocks fall at the same load by limit analysis and by contact dynamics ({bound:.4}, {found:.4})"
        )
    } else if found < bound {
        format!(
            "contact dynamics, {found:.4}, is below limit analysis, {bound:.4}, as it may be: joints that slide do not dilate, and limit \
             analysis is an upper bound; take the lower one"
        )
    } else {
        format!(
            "contact dynamics, {found:.4}, is above limit analysis, {bound:.4}, which is an upper bound: nothing explains that"
        )
    };
    Some(Verdict { is_explained: near(bound, found) || found < bound, words })
}

/// The two elastic solvers beside each other, where they differ.
fn elastic_joints(elastic: &[(SolverName, f64)], near: &dyn Fn(f64, f64) -> bool) -> Option<Verdict> {
    let [(_, a), (_, b)] = elastic[..] else { return None };
    (!near(a, b)).then(|| Verdict {
        is_explained: false,
        words: format!("the two elastic solvers differ, {a:.4} and {b:.4}: the way to the limit matters"),
    })
}

/// Elastic joints beside rigid blocks, where both were asked.
fn softness(
    rigid: &[(SolverName, f64)],
    elastic: &[(SolverName, f64)],
    near: &dyn Fn(f64, f64) -> bool,
    kn: f64,
    stiffer: &dyn Fn(SolverName) -> Option<f64>,
) -> Option<Verdict> {
    let rigid = rigid.iter().map(|(_, at)| *at).reduce(f64::min)?;
    let (solver, soft) = *elastic.first()?;
    let kn = compact(kn);
    if near(rigid, soft) {
        let words = format!("elastic joints of kn {kn} change little ({soft:.4})");
        return Some(Verdict { is_explained: true, words });
    }
    if soft > rigid {
        let words = format!(
            "elastic joints bear more, {soft:.4}, than rigid blocks, {rigid:.4}: nothing explains that"
        );
        return Some(Verdict { is_explained: false, words });
    }
    let stiff = stiffer(solver);
    let is_explained = stiff.is_some_and(|stiff| rigid - stiff <= 0.5 * (rigid - soft));
    let stiff = stiff.map_or_else(|| "none".to_owned(), |stiff| format!("{stiff:.4}"));
    let words = match is_explained {
        true => format!(
            "elastic joints lean before they fall: {soft:.4} at kn {kn}, {stiff} at ten times as much, {rigid:.4} with rigid blocks"
        ),
        false => format!(
            "elastic joints fall at {soft:.4}, at ten times the stiffness at {stiff}, rigid blocks at {rigid:.4}: stiffness does not explain that"
        ),
    };
    Some(Verdict { is_explained, words })
}

/// How a wall ended, in two words.
fn ended(answer: &Answer) -> String {
    match answer.outcome {
        Outcome::Collapsed { .. } => "falls".to_owned(),
        Outcome::Equilibrium => "stands".to_owned(),
        _ => answer.name().replace('_', " "),
    }
}
