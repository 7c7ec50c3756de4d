//! Where the scatter of an arm's walls comes from, by pick-freeze: a wall, its partner with other random numbers, and for each source
//! the wall with the partner's numbers of that source; see [`sensitivity`](crate::stats::sensitivity).

use std::collections::BTreeMap;

use polars::prelude::{Column, NamedFrom, Series};
use serde::{Deserialize, Serialize};

use crate::ensemble::ledger::Ledger;
use crate::ensemble::table::parquet;
use crate::ensemble::{Observed, Quantity, RunError, Task, evaluate};
use crate::generate::{Arrangement, Unseen};
use crate::random::{Family, PARTNER, Quantities};
use crate::stats::BasePoint;
use crate::study::{Arm, Study, TakenFrom, parameters};

/// A source of scatter: quantities that are drawn, independent of all others.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// Its name: the path of a parameter's key, `layout`, or what of the layout.
    pub name: String,
    /// Its quantities.
    pub quantities: Quantities,
    /// Whether it is one of those that the layout consists of.
    pub is_in_layout: bool,
}

/// Name of the source that the layout is as a whole.
pub const LAYOUT: &str = "layout";
/// Quantities of a wall's layout, how they begin.
const IN_LAYOUT: [(&str, &[&str]); 10] = [
    ("dips", &["bed dip", "joint dip"]),
    ("sizes", &["course height", "stone length", "stone height"]),
    ("wedges", &["wedge", "wedge loss"]),
    ("wythes", &["header"]),
    ("densities", &["density"]),
    ("throughs", &["unseen through"]),
    ("depths", &["unseen depths"]),
    ("core", &["unseen core share"]),
    ("beds through the wall", &["unseen dip"]),
    ("joints", &["joint kn_factor", "joint phi", "joint cohesion", "joint contact_area", "joint bearing"]),
];

/// The sources of an arm: every parameter that is drawn once per wall, the layout as a whole, and, where it has several, what it
/// consists of. The scatter from joint to joint counts as part of the layout.
pub fn sources(arm: &Arm) -> Vec<Source> {
    let beginning = |streams: &[&str]| streams.iter().map(|own| (*own).to_owned()).collect();
    let per_wall = parameters(std::slice::from_ref(arm));
    let mut sources: Vec<Source> = per_wall
        .iter()
        .map(|own| Source {
            name: own.key.to_owned(),
            quantities: Quantities { beginnings: beginning(&[own.stream]), others: false },
            is_in_layout: false,
        })
        .collect();
    let drawn: Vec<Source> = IN_LAYOUT
        .iter()
        .filter(|(name, _)| is_drawn(arm, name))
        .map(|(name, streams)| Source {
            name: (*name).to_owned(),
            quantities: Quantities { beginnings: beginning(streams), others: false },
            is_in_layout: true,
        })
        .collect();
    if !drawn.is_empty() {
        let others: Vec<&str> = per_wall.iter().map(|own| own.stream).collect();
        let quantities = Quantities { beginnings: beginning(&others), others: true };
        sources.push(Source { name: LAYOUT.to_owned(), quantities, is_in_layout: false });
    }
    if drawn.len() > 1 {
        sources.extend(drawn);
    }
    sources
}

/// Whether something of the layout is drawn.
fn is_drawn(arm: &Arm, name: &str) -> bool {
    let scatters = |family: &Family| family.sd() > 0.0;
    let (layout, joint) = (&arm.layout, &arm.joint);
    let has_wedges = layout.wedges.as_ref().is_some_and(|wedges| wedges.share > 0.0);
    // What an arrangement does not draw of a wall behind its face has no source.
    let unseen = |drawn: fn(&Unseen) -> bool| match &layout.arrangement {
        Arrangement::File { unseen, .. } => unseen.as_ref().is_some_and(drawn),
        _ => false,
    };
    match (name, &layout.arrangement) {
        ("dips", Arrangement::Coursed { dip, .. } | Arrangement::Cut { dip, .. }) => scatters(dip),
        ("sizes", Arrangement::Coursed { sizes, .. } | Arrangement::Cut { sizes, .. }) => sizes.scatter(),
        ("wedges", _) => has_wedges,
        ("wythes", _) => {
            layout.wythes.count > 1 && layout.wythes.header_share > 0.0 && layout.wythes.header_share < 1.0
        }
        ("throughs", _) => unseen(Unseen::draws_throughs),
        ("depths", _) => unseen(Unseen::draws_depths),
        ("core", _) => unseen(|own| own.core_share.sd() > 0.0),
        ("beds through the wall", _) => unseen(|own| own.dip.sd() > 0.0),
        ("densities", _) => scatters(&layout.density),
        ("joints", _) => {
            [&joint.kn_factor, &joint.phi_deg, &joint.cohesion].into_iter().any(scatters)
                || ["contact_area", "bearing_points"].iter().any(|cause| arm.mechanisms.has(cause))
                || joint.bearing.is_some()
        }
        _ => false,
    }
}

/// Which wall of a base point.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Wall {
    /// The wall itself.
    Own,
    /// The one with other numbers throughout.
    Partner,
    /// The wall with its partner's numbers of a source.
    Mixed(String),
}

/// An evaluation: base point and wall. With the study and the arm it gives the same wall again.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Evaluation {
    /// Number of the base point: the member that the own wall is.
    pub base: u64,
    /// Which of its walls.
    pub wall: Wall,
}

/// What an evaluation came to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SensitivityValue {
    /// The value; `None` of a wall that failed or whose value is only known to lie above something.
    pub value: Option<f64>,
    /// How the wall ended.
    pub outcome: String,
}

/// Base points whose walls are evaluated before the answer so far is told.
const TOLD: usize = 16;

/// The walls of a study of one arm whose scatter is asked for.
pub struct SensitivityWalls<'s> {
    /// The study.
    pub study: &'s Study,
    /// Index of the arm.
    pub arm: u32,
    /// Index of the kn point.
    pub point: u32,
    /// Its sources.
    pub sources: &'s [Source],
    /// What was evaluated before, and is kept.
    pub ledger: &'s Ledger<Evaluation, SensitivityValue>,
}

impl SensitivityWalls<'_> {
    /// The walls of a base point in the order own, partner, source by source.
    pub fn walls(&self, base: u64) -> Vec<Evaluation> {
        let mixed = self.sources.iter().map(|source| Wall::Mixed(source.name.clone()));
        [Wall::Own, Wall::Partner].into_iter().chain(mixed).map(|wall| Evaluation { base, wall }).collect()
    }

    /// Evaluates all walls of so many base points; `tell` hears after each few what there is.
    ///
    /// # Errors
    /// The fault of the disk, if what was evaluated could not be kept.
    pub fn evaluated(
        &self,
        points: u64,
        tell: &mut dyn FnMut(&[Vec<SensitivityValue>]),
    ) -> Result<Vec<Vec<SensitivityValue>>, RunError> {
        let mut all: Vec<Vec<SensitivityValue>> = Vec::new();
        let bases: Vec<u64> = (0..points).collect();
        for some in bases.chunks(TOLD) {
            let walls: Vec<Evaluation> = some.iter().flat_map(|base| self.walls(*base)).collect();
            let rows = self.rows(&walls, &|_, _| {})?;
            let mut rows = rows.into_iter().map(|row| row.expect("a ledger that is no shard knows all rows"));
            all.extend(some.iter().map(|base| rows.by_ref().take(self.walls(*base).len()).collect()));
            tell(&all);
        }
        Ok(all)
    }

    /// Evaluates the walls of so many base points that are its shard's. `finished` is told, from the worker threads, how many of how many
    /// are done.
    ///
    /// # Errors
    /// As of [`SensitivityWalls::evaluated`].
    pub fn evaluate_shard(
        &self,
        points: u64,
        finished: &(dyn Fn(usize, usize) + Sync),
    ) -> Result<(), RunError> {
        let walls: Vec<Evaluation> = (0..points).flat_map(|base| self.walls(base)).collect();
        self.rows(&walls, finished).map(|_| ())
    }

    fn rows(
        &self,
        walls: &[Evaluation],
        finished: &(dyn Fn(usize, usize) + Sync),
    ) -> Result<Vec<Option<SensitivityValue>>, RunError> {
        self.ledger.rows(walls, Evaluation::clone, finished, |wall| self.evaluate(wall))
    }

    fn evaluate(&self, evaluation: &Evaluation) -> SensitivityValue {
        let (own, partner) = (evaluation.base, evaluation.base + PARTNER);
        let task = |member: u64| Task { arm: self.arm, point: self.point, member };
        let row = match &evaluation.wall {
            Wall::Own => evaluate(self.study, task(own)),
            Wall::Partner => evaluate(self.study, task(partner)),
            Wall::Mixed(name) => {
                let source = self.sources.iter().find(|source| source.name == *name);
                let quantities = source.expect("walls are mixed by sources").quantities.clone();
                let study = self.study.clone().with_taken(TakenFrom { quantities, member: partner });
                evaluate(&study, task(own))
            }
        };
        let (value, outcome) = match Quantity::of(self.study).observed(&row) {
            Observed::Value(value) => (Some(value), row.outcome.name()),
            Observed::Above(_) => (None, "stood_to_the_end"),
            Observed::Nothing => (None, row.outcome.name()),
        };
        SensitivityValue { value, outcome: outcome.to_owned() }
    }
}

/// The values of base points, from their walls in the order own, partner, source by source.
pub fn base_points(evaluated: &[Vec<SensitivityValue>]) -> Vec<BasePoint> {
    let point = |walls: &Vec<SensitivityValue>| BasePoint {
        own: walls[0].value,
        partner: walls[1].value,
        mixed: walls[2..].iter().map(|wall| wall.value).collect(),
    };
    evaluated.iter().map(point).collect()
}

/// One row per evaluation as Parquet: base point, its randomisation, which wall, how it ended, its value.
///
/// # Errors
/// [`RunError::Table`] where it cannot be encoded.
pub fn sensitivity_table(
    sources: &[Source],
    evaluated: &[Vec<SensitivityValue>],
    randomisations: u64,
) -> Result<Vec<u8>, RunError> {
    let names: Vec<&str> =
        ["own", "partner"].into_iter().chain(sources.iter().map(|s| s.name.as_str())).collect();
    let bases =
        || (0_u64..).zip(evaluated).flat_map(|(base, walls)| walls.iter().map(move |wall| (base, wall)));
    let walls: Vec<&str> = evaluated.iter().flat_map(|_| names.iter().copied()).collect();
    let columns = vec![
        Column::from(Series::new("base_point".into(), bases().map(|(base, _)| base).collect::<Vec<_>>())),
        Column::from(Series::new(
            "randomisation".into(),
            bases().map(|(base, _)| base % randomisations).collect::<Vec<_>>(),
        )),
        Column::from(Series::new("numbers_from_the_partner".into(), walls)),
        Column::from(Series::new(
            "outcome".into(),
            bases().map(|(_, wall)| wall.outcome.as_str()).collect::<Vec<_>>(),
        )),
        Column::from(Series::new("value".into(), bases().map(|(_, wall)| wall.value).collect::<Vec<_>>())),
    ];
    parquet("sensitivity.parquet", evaluated.iter().map(Vec::len).sum(), columns)
}

/// Walls without a value, by how they ended.
pub fn without_value(evaluated: &[Vec<SensitivityValue>]) -> BTreeMap<String, u64> {
    let mut counts = BTreeMap::new();
    for wall in evaluated.iter().flatten().filter(|wall| wall.value.is_none()) {
        *counts.entry(wall.outcome.clone()).or_default() += 1;
    }
    counts
}
