//! What was built of a member's wall.

use serde::{Deserialize, Serialize};

use crate::ensemble::field::record;
use crate::generate::Generated;
use crate::math::degrees;
use crate::model::Wall;
use crate::solve::STANDARD_GRAVITY;
use crate::stats;

record! {
    /// Numbers of a wall as built; by default nothing was.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
    Built {
        stones: u32 = "stones", "", "number of stones, headers and wedges among them";
        joints: u32 = "joints", "", "number of joints as built";
        wedges: u32 = "wedges", "", "number of wedges";
        headers: u32 = "headers", "", "number of headers";
        attempts: u32 = "attempts", "", "fresh starts of the generator";
        redraws: u32 = "redraws", "", "single redraws of the generator";
        merges: u32 = "merges", "", "slivers merged into a neighbour";
        dip_mean_deg: Option<f64> = "dip_mean_deg", "deg", "mean of the dips of its beds as built";
        dip_sd_deg: Option<f64> = "dip_sd_deg", "deg", "their standard deviation";
        first_dip_sd_deg: Option<f64> =
            "first_dip_sd_deg", "deg", "standard deviation of the dips as first drawn, before any was rejected";
        length_mean_m: Option<f64> = "length_mean_m", "m", "mean length of its stones as built";
        height_mean_m: Option<f64> = "height_mean_m", "m", "mean height of its stones as built";
        weight_n: Option<f64> = "weight_n", "N", "weight of its stones";
    }
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
    wall.stones().map(|(_, stone)| stone.mass()).fold(0.0, |sum, mass| sum + mass) * STANDARD_GRAVITY
}
