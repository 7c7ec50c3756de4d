//! The walls of a study against a demand: how many do not bear it.

use crate::ensemble::{Failing, Met, Observed, Quantity};
use crate::render::number::{compact, or_dash, shortened, with_interval};
use crate::render::text::{LONGEST_NAME, aligned, wrapped};
use crate::study::Demand;
use crate::verb::run::answer::population::Population;

/// What came of a demand.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct DemandSummary {
    /// As it was stated.
    pub stated: String,
    /// The same in the unit of the quantity.
    pub level: f64,
    /// That unit.
    pub unit: &'static str,
    /// One entry per arm and kn, in the order of the arms.
    pub arms: Vec<ArmDemand>,
    /// What is observed.
    #[serde(skip)]
    pub shown: Quantity,
}

/// What came of it in one arm at one kn.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct ArmDemand {
    /// Name of the arm.
    pub arm: String,
    /// Normal stiffness of the joints (Pa/m).
    pub kn_pa_per_m: f64,
    /// The mean over the demand; of a displacement the demand over the mean. Above 1 the mean wall bears it.
    pub ratio: Option<f64>,
    /// How many walls fail.
    #[serde(flatten)]
    pub failing: Failing,
    /// The share that fails, of those of which it is known.
    pub share: Option<f64>,
    /// Its 95 % interval; null of an arm in which nothing is drawn. Walls of which nothing is known widen it.
    pub share_ci: Option<[f64; 2]>,
}

impl DemandSummary {
    /// Of all populations; `None` where the demand is of something else than what is observed.
    pub fn of(demand: &Demand, quantity: Quantity, populations: &[Population]) -> Option<DemandSummary> {
        let level = quantity.level(demand).ok()?;
        let arms = populations.iter().map(|own| ArmDemand::of(level, own)).collect();
        Some(DemandSummary {
            stated: demand.stated.clone(),
            level,
            unit: quantity.unit(),
            arms,
            shown: quantity,
        })
    }

    /// The demand in words: as it was stated, and in the unit of the quantity where that is another one.
    fn name(&self) -> String {
        let (unit, level) = (self.shown.shown_unit(), self.shown.shown(self.level));
        let own = format!("{} {unit}", crate::math::significant(level, 4));
        match self.stated.ends_with(unit) {
            true => self.stated.clone(),
            false => format!("{} ({own})", self.stated),
        }
    }

    /// The share that walls of any arm show with 95 % confidence not to be exceeded: the largest of all arms, whole where some arm has no wall.
    pub fn at_most(&self) -> f64 {
        let of = |own: &ArmDemand| match own.share_ci {
            // Every wall of the arm is this one.
            None => own.share.filter(|_| own.failing.unknown == 0).unwrap_or(1.0),
            Some(_) => own.failing.at_most().unwrap_or(1.0),
        };
        self.arms.iter().map(of).fold(0.0, f64::max)
    }

    /// In a sentence: of every arm at the first stiffness the share that fails.
    pub fn sentence(&self) -> Option<String> {
        let first = self.arms.first()?;
        let here: Vec<&ArmDemand> =
            self.arms.iter().filter(|own| own.kn_pa_per_m == first.kn_pa_per_m).collect();
        let said = match here[..] {
            [own] => format!("{} of walls fail", own.percent()),
            _ => {
                let one =
                    |own: &&ArmDemand| format!("{} {}", shortened(&own.arm, LONGEST_NAME), own.percent());
                format!("walls fail in {}", here.iter().map(one).collect::<Vec<_>>().join(", "))
            }
        };
        Some(format!("Against {}: {said}.", self.name()))
    }

    /// The heads, and a row per arm and kn.
    pub fn rows(&self) -> Vec<Vec<String>> {
        let ratio = match self.shown {
            Quantity::TopDisplacement => "demand / mean",
            _ => "mean / demand",
        };
        let heads = ["arm", "kn Pa/m", "walls", "fail", "not known", "share %", ratio].map(str::to_owned);
        let row = |own: &ArmDemand| {
            let Failing { fail, unknown, walls } = own.failing;
            let counts = [walls, fail, unknown].map(|count| count.to_string());
            let share = own.percent().trim_end_matches(" %").to_owned();
            let name = [own.arm.clone(), compact(own.kn_pa_per_m)];
            name.into_iter().chain(counts).chain([share, or_dash(own.ratio, 3)]).collect()
        };
        std::iter::once(heads.to_vec()).chain(self.arms.iter().map(row)).collect()
    }

    /// What the table shows.
    pub fn heading(&self) -> String {
        format!("Against the demand {}", self.name())
    }

    /// The same for a terminal.
    pub fn text(&self) -> String {
        let about = "Share: walls that do not bear the demand, of those of which it is known; brackets hold 95 % intervals, which \
                     walls that are not known widen.";
        format!("\n{}\n{}\n{}", self.heading(), wrapped("", about), aligned(self.rows()))
    }
}

impl ArmDemand {
    fn of(level: f64, population: &Population) -> ArmDemand {
        let quantity = population.quantity;
        let mut failing = Failing::default();
        let values = population.values.values().iter().map(|value| Observed::Value(*value));
        let above = population.above.iter().map(|limit| Observed::Above(*limit));
        values.chain(above).for_each(|observed| failing.take(Met::of(quantity, level, observed)));
        for (why, walls) in population.failed() {
            // Who cannot bear its own weight, or falls before it has moved as far as it may, bears no demand.
            let fails =
                why == "unstable at rest" || (why == "collapsed" && quantity == Quantity::TopDisplacement);
            let met = if fails { Met::Fails } else { Met::Unknown };
            (0..walls).for_each(|_| failing.take(met));
        }
        let mean = crate::stats::mean(population.complete());
        let ratio = mean.map(|mean| match quantity {
            Quantity::TopDisplacement => level / mean,
            _ => mean / level,
        });
        ArmDemand {
            arm: population.arm.clone(),
            kn_pa_per_m: population.kn,
            ratio: ratio.filter(|own| own.is_finite()),
            failing,
            share: failing.share(),
            share_ci: failing.interval().filter(|_| !population.fixed),
        }
    }

    /// The share with its interval, in per cent.
    fn percent(&self) -> String {
        let percent = |x: f64| 100.0 * x;
        let share = self.share.map(percent);
        let said = match self.share_ci {
            Some(ci) => with_interval(share, Some(ci.map(percent)), 2),
            None => or_dash(share, 2),
        };
        format!("{said} %")
    }
}
