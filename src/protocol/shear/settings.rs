//! What is done to a wall that is sheared.

/// The widest drift is a step's end if it is beyond that by less than this share of a step.
const ROUNDING: f64 = 1e-6;

/// A constant vertical load through a rigid beam on the wall's top, and a displacement of the beam along the wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shear {
    /// What the beam weighs (N): the load on the wall's top, a dead load at the middle of the beam.
    pub vertical_load: f64,
    /// Height (m) of the jack and of the beam's middle above the wall's foot: more than the wall's own height.
    pub force_height: f64,
    /// What the beam can do.
    pub head: Head,
    /// Where the beam goes.
    pub history: History,
    /// Way of the jack from step to step over its height; default 1e-4.
    pub step: f64,
    /// The wall falls when the centroid of any block moves by this share of the wall's base thickness in one step; default 0.1.
    pub collapse_share: f64,
}

/// Whether the beam may turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Head {
    /// It does: the wall is a cantilever.
    Turns,
    /// It stays level: a wall between two slabs.
    Level,
}

/// Where the beam goes; drifts are displacements over the height of the jack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum History {
    /// Along x+ to a drift.
    Monotonic {
        /// The drift at the end.
        to: f64,
    },
    /// There, back and as far the other way, so many times, each cycle wider by the same amount.
    Cycles {
        /// The drift of the widest cycle, the last one.
        to: f64,
        /// Number of cycles, at least 1.
        count: u32,
    },
}

impl History {
    /// The widest drift.
    pub fn widest(&self) -> f64 {
        match *self {
            History::Monotonic { to } | History::Cycles { to, .. } => to,
        }
    }

    /// The drifts at which the beam stops or turns back, in order.
    pub(super) fn turns(&self) -> Vec<f64> {
        match *self {
            History::Monotonic { to } => vec![to],
            History::Cycles { to, count } => {
                let wide = |cycle: u32| to * f64::from(cycle) / f64::from(count);
                (1..=count).flat_map(|cycle| [wide(cycle), -wide(cycle)]).collect()
            }
        }
    }
}

impl Shear {
    /// The drifts at the ends of its steps along x+, up to the widest one, ascending.
    pub fn drifts(&self) -> Vec<f64> {
        let steps = (self.history.widest() / self.step + ROUNDING).floor() as u32;
        (1..=steps).map(|step| f64::from(step) * self.step).collect()
    }
}

impl Default for Shear {
    /// 100 kN at 1.325 m on a beam that turns, to 2 %.
    fn default() -> Self {
        Shear {
            vertical_load: 1e5,
            force_height: 1.325,
            head: Head::Turns,
            history: History::Monotonic { to: 0.02 },
            step: 1e-4,
            collapse_share: 0.1,
        }
    }
}
