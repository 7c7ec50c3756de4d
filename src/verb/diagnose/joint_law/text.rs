//! What is printed of a law.

use crate::critic::{Bend, KnownLaw};
use crate::render::number::{significant, with_interval};
use crate::verb::diagnose::joint_law::LawSummary;

/// Some lines, the conclusion first.
pub fn law_text(summary: &LawSummary) -> String {
    let three = |x: f64| significant(x, 3);
    let bend = match summary.bend {
        Bend::Stiffening => "the joints stiffen with the stress",
        Bend::Softening => "the joints soften with the stress",
        Bend::NotShown => "the readings do not show the stiffness to change with the stress",
    };
    let [from, to] = summary.seen_pa.map(|stress| stress / 1e3);
    let mut lines = vec![
        format!(
            "A free law of the joints ({}): {bend} (probability of stiffening {}; exponent {}).",
            summary.families.join(", "),
            three(summary.stiffening),
            with_interval(Some(summary.exponent.median), Some(summary.exponent.interval), 3)
        ),
        format!(
            "The readings know {} numbers of it, between {} and {} kPa.",
            significant(summary.resolved, 2),
            three(from),
            three(to)
        ),
    ];
    if let Some(nearest) = summary.named.first() {
        let parameters: Vec<String> =
            nearest.parameters.iter().map(|(name, value)| format!("{name} {}", three(*value))).collect();
        lines.push(format!(
            "Nearest: {}, {}; it loses {} nats of what is known.",
            nearest.name,
            parameters.join(", "),
            significant(nearest.lost_nats, 2)
        ));
    }
    let [stays, goes_on] = summary.beyond_closure_m.map(|closure| 1e3 * closure);
    lines.push(format!(
        "Beyond, at {} kPa, it has closed by {} mm if the stiffness stays, by {} mm if it goes on changing.",
        three(summary.beyond_pa / 1e3),
        three(stays),
        three(goes_on)
    ));
    lines.extend(summary.collapse.iter().filter_map(|own| {
        let KnownLaw { median, interval } = own.collapse_deg?;
        let angle = with_interval(Some(median), Some(interval), 3);
        Some(format!("One more wall of {} falls at {angle} deg under it.", own.family))
    }));
    lines.push(match &summary.gain {
        None => "There are too few specimens to hold some out: the law is not taken on.".to_owned(),
        Some(gain) => format!(
            "Specimens held out: gain {} nats a specimen over joints of constant stiffness: {}.",
            with_interval(Some(gain.mean), Some(gain.interval), 3),
            if summary.is_accepted { "it is taken on" } else { "it is not taken on" }
        ),
    });
    lines.join("\n") + "\n"
}
