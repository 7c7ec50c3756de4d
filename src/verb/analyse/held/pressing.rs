//! What presses on a wall, from the arguments.

use crate::math::{Vec3, cos, radians, sin};
use crate::model::Wall;
use crate::protocol::{self, Fill, Load, NoBack, OnCrest, Retained, WATER, crest_loads, trapezoid};
use crate::terminal::failure::Failure;
use crate::verb::analyse::ask::{Analyse, Growing, LoadName};

/// What the wall holds back, where it holds back something that rises.
pub(crate) fn retained(asked: &Analyse) -> Option<Retained> {
    let behind = &asked.behind;
    match asked.load {
        LoadName::Water => Some(Retained::Water(WATER)),
        LoadName::Fill => Some(Retained::Fill(Fill {
            density: behind.fill_density?,
            phi: radians(behind.fill_phi_deg?),
            wall_friction: behind.wall_friction.unwrap_or(0.0),
            slope: radians(behind.fill_slope_deg.unwrap_or(0.0)),
            surcharge: behind.surcharge_pa.unwrap_or(0.0),
            drained: !behind.undrained,
        })),
        _ => None,
    }
}

/// Fill or water behind a wall; `None` under another load.
pub(crate) fn behind(asked: &Analyse, wall: &Wall) -> Option<Result<protocol::Behind, NoBack>> {
    retained(asked).map(|retained| protocol::Behind::new(wall, asked.direction, &retained))
}

/// The loads that grow by a factor; none under another load.
pub(crate) fn factored(asked: &Analyse, wall: &Wall) -> Vec<Load> {
    let (behind, towards) = (&asked.behind, asked.direction);
    let down = radians(behind.crest_down_deg.unwrap_or(0.0));
    let along = |size: f64| (towards.unit() * cos(down) - Vec3::z() * sin(down)) * size;
    let on_crest = || {
        let point = behind.crest_force.map(|force| OnCrest::Point(along(force), behind.crest_at));
        point.or(behind.crest_line.map(|line| OnCrest::Line(along(line))))
    };
    match asked.load {
        LoadName::Pressure => behind.pressure_pa.map_or_else(Vec::new, |mean| {
            trapezoid(wall, towards, mean, behind.base_over_top.unwrap_or(1.0))
        }),
        LoadName::Point => on_crest().map_or_else(Vec::new, |on| crest_loads(wall, towards, on)),
        _ => Vec::new(),
    }
}

/// That something of the wall can be pressed on.
pub(crate) fn checked(asked: &Analyse, wall: &Wall) -> Result<(), Failure> {
    let refused = |why: String| Err(Failure::Input(format!("{}: {why}", asked.title())));
    match behind(asked, wall) {
        Some(Err(fault)) => refused(format!(
            "{}; --direction is {}, and the {} lies on the other side",
            fault.reason(),
            asked.direction,
            asked.load.name()
        )),
        None if asked.growing() == Growing::Factor && factored(asked, wall).is_empty() => refused(format!(
            "no face of a stone is there for --load {} towards {}",
            asked.load.name(),
            asked.direction
        )),
        _ => Ok(()),
    }
}
