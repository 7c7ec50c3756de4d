//! What was built of a member's wall.

use serde::{Deserialize, Serialize};

use crate::ensemble::columns::{Column, Members, count, real};
use crate::ensemble::record::Row;
use crate::generate::Generated;
use crate::math::degrees;
use crate::model::Wall;
use crate::solve::STANDARD_GRAVITY;
use crate::stats;

/// Numbers of a wall as built; by default nothing was.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Built {
    /// Number of stones (headers and wedges counted).
    pub stones: u32,
    /// Number of joints at rest.
    pub joints: u32,
    /// Wedge stones.
    pub wedges: u32,
    /// Header stones.
    pub headers: u32,
    /// Fresh starts of the generator.
    pub attempts: u32,
    /// Single redraws of the generator.
    pub redraws: u32,
    /// Slivers merged into a neighbour.
    pub merges: u32,
    /// Mean of the realised dips (deg); `None` where nothing dips.
    pub dip_mean_deg: Option<f64>,
    /// Standard deviation of the realised dips (deg).
    pub dip_sd_deg: Option<f64>,
    /// Standard deviation of the dips as first drawn, before rejection (deg).
    pub first_dip_sd_deg: Option<f64>,
    /// Mean realised stone length (m).
    pub length_mean_m: Option<f64>,
    /// Mean realised stone (course) height (m).
    pub height_mean_m: Option<f64>,
    /// Weight of the stones (N).
    pub weight_n: Option<f64>,
}

impl Built {
    /// Of a wall; its joints are counted by who solves it.
    pub(super) fn of(generated: &Generated) -> Built {
        let realised = &generated.realised;
        Built {
            stones: generated.wall.stones().count() as u32,
            joints: 0,
            wedges: realised.wedges,
            headers: realised.headers,
            attempts: generated.attempts,
            redraws: generated.redraws,
            merges: generated.merges,
            dip_mean_deg: stats::mean(&realised.dips).map(degrees),
            dip_sd_deg: stats::sigma(&realised.dips).map(degrees),
            first_dip_sd_deg: stats::sigma(&realised.first_dips).map(degrees),
            length_mean_m: stats::mean(&realised.lengths),
            height_mean_m: stats::mean(&realised.heights),
            weight_n: Some(weight(&generated.wall)),
        }
    }
}

/// Weight of the stones (N), added in the order of their ids.
pub fn weight(wall: &Wall) -> f64 {
    wall.stones().map(|(_, stone)| stone.density * stone.shape.volume()).fold(0.0, |sum, mass| sum + mass)
        * STANDARD_GRAVITY
}

/// Of the table of members.
pub(super) fn members() -> Vec<Column<Members>> {
    type R<'r> = &'r Row;
    vec![
        count("stones", "number of stones, headers and wedges among them", |r: R| r.built.stones.into()),
        count("joints", "number of joints as built", |r: R| r.built.joints.into()),
        count("wedges", "number of wedges", |r: R| r.built.wedges.into()),
        count("headers", "number of headers", |r: R| r.built.headers.into()),
        count("attempts", "fresh starts of the generator", |r: R| r.built.attempts.into()),
        count("redraws", "single redraws of the generator", |r: R| r.built.redraws.into()),
        count("merges", "slivers merged into a neighbour", |r: R| r.built.merges.into()),
        real("dip_mean_deg", "deg", "mean of the dips of its beds as built", |r: R| r.built.dip_mean_deg),
        real("dip_sd_deg", "deg", "their standard deviation", |r: R| r.built.dip_sd_deg),
        real(
            "first_dip_sd_deg",
            "deg",
            "standard deviation of the dips as first drawn, before any was rejected",
            |r: R| r.built.first_dip_sd_deg,
        ),
        real("length_mean_m", "m", "mean length of its stones as built", |r: R| r.built.length_mean_m),
        real("height_mean_m", "m", "mean height of its stones as built", |r: R| r.built.height_mean_m),
        real("weight_n", "N", "weight of its stones", |r: R| r.built.weight_n),
    ]
}
