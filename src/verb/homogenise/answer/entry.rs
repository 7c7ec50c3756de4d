//! The numbers of masonry seen as a plate, every statistic with its interval.

use std::collections::BTreeMap;

use crate::ensemble::{AskedOfCells, CellRow, WallRow, is_random};
use crate::homogenise::{Border, CellAnswer, Direction, Found, Method, Moduli};
use crate::stats;
use crate::stats::{Estimate, SizeEffect, size_effect};
use crate::study::Study;
use crate::verb::homogenise::answer::walls::WallsAsPlates;

/// A modulus or a coupling below this share of the root of its two moduli is rounding.
const NOTHING: f64 = 1e-9;
/// Indices of a plate's stresses and strains by name.
const PAIRS: [&str; 3] = ["11", "22", "12"];

/// What masonry of the arms is as a plate.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct HomogenisedSummary {
    /// Name of the study.
    pub study: String,
    /// The variant, if one was asked for.
    pub variant: Option<String>,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Hash of the study's values.
    pub study_hash: String,
    /// What the numbers are measured in.
    pub units: PlateUnits,
    /// An entry per arm.
    pub arms: Vec<PlateArm>,
}

/// What the numbers are measured in.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct PlateUnits {
    /// Of `A` and of the transverse shear moduli `F`.
    #[serde(rename = "A_F")]
    pub membrane: &'static str,
    /// Of the couplings `B`.
    #[serde(rename = "B")]
    pub coupling: &'static str,
    /// Of `D`.
    #[serde(rename = "D")]
    pub bending: &'static str,
    /// Of the surface: multiples of the direction.
    pub surface: &'static str,
}

const UNITS: PlateUnits = PlateUnits {
    membrane: "N/m",
    coupling: "N",
    bending: "N m",
    surface: "value times direction: N11, N22, N12 over p, M11, M22, M12 over p times the thickness, beside N22 = -p",
};

/// An arm, at its largest cells.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct PlateArm {
    /// Name of the arm.
    pub arm: String,
    /// Normal stiffness of the joints (Pa/m).
    pub kn_pa_per_m: f64,
    /// The largest cells.
    pub cell: PlateCells,
    /// Moduli with the periodic border by name: `A` membrane, `D` bending and torsion, `B` coupling of both, `F` transverse shear of
    /// stones that do not turn. Those that vanish in all cells are left out.
    pub moduli: BTreeMap<String, PlateValue>,
    /// Points of the surface, method by method.
    pub surface: Vec<SurfaceEntry>,
    /// Its walls beside their plates, where that was asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub walls: Option<WallsAsPlates>,
}

/// The cells of an arm that the numbers are of.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct PlateCells {
    /// Stones along the wall and courses.
    pub stones: [u32; 2],
    /// Cells of each size.
    pub cells: usize,
    /// Cells that could not be built, of this size, by reason.
    pub failed: BTreeMap<String, usize>,
    /// Thickness of the plate (m).
    pub thickness_m: Option<f64>,
    /// Open gap in every head joint (m). Heads that are open carry nothing, as strains are small.
    pub head_joint_gap_m: f64,
    /// Vertical stress resultant p at which strength was looked for (N/m).
    pub pressure_n_per_m: Option<f64>,
    /// Of how many cells of all sizes the moduli lie between their bounds.
    pub nested: NestedCells,
}

/// How many cells keep their bounds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct NestedCells {
    /// Cells whose moduli lie between those with the kinematic and the static border.
    pub held: usize,
    /// Cells of which that is known.
    pub of: usize,
}

/// A value over cells of the largest size.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct PlateValue {
    /// Number of cells that have it.
    pub n: usize,
    /// Arithmetic mean.
    pub mean: Option<f64>,
    /// 95 % interval of the mean.
    pub interval: Option<[f64; 2]>,
    /// Standard deviation between cells.
    pub sigma: Option<f64>,
    /// 95 % interval of sigma.
    pub sigma_interval: Option<[f64; 2]>,
    /// Sigma over the mean.
    pub cov: Option<f64>,
    /// 95 % interval of the COV.
    pub cov_interval: Option<[f64; 2]>,
    /// Means with the kinematic and the static border; moduli alone have them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bounds: Option<ModulusBounds>,
    /// What became of it as the cells grew; null with cells of one size.
    pub by_size: Option<ValueBySize>,
}

/// Means of a modulus with the other two borders.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct ModulusBounds {
    /// From above; of couplings no bound.
    pub kinematic: Option<f64>,
    /// From below.
    #[serde(rename = "static")]
    pub fixed: Option<f64>,
}

/// A value over the sizes of cells.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct ValueBySize {
    /// Stones along the wall and courses.
    pub stones: Vec<[u32; 2]>,
    /// Mean and COV at each.
    pub mean: Vec<Option<f64>>,
    /// Sigma over the mean at each.
    pub cov: Vec<Option<f64>>,
    /// What the sizes show; null where a size has fewer than two values.
    #[serde(flatten)]
    pub shown: Option<SizeEffect>,
}

/// A point of the surface.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct SurfaceEntry {
    /// With or without dilatancy.
    pub method: Method,
    /// Where it was looked for.
    pub direction: Direction,
    /// How many times the direction are borne.
    pub value: PlateValue,
    /// Cells that bear any number of times, or more than were asked for.
    pub unbounded: usize,
    /// Cells that do not even bear the vertical stress; they count with 0.
    pub fall_at_rest: usize,
    /// Cells of which no answer can be believed.
    pub not_converged: usize,
}

impl PlateValue {
    fn of(samples: &[Vec<f64>], sizes: &[[u32; 2]], random: bool) -> PlateValue {
        let last = samples.last().map_or(&[][..], Vec::as_slice);
        let summary = stats::Summary::of(last);
        let sides: Vec<f64> = sizes.iter().map(|[x, z]| (f64::from(*x) * f64::from(*z)).sqrt()).collect();
        let Estimate { value: mean, interval } = summary.mean;
        PlateValue {
            n: summary.n,
            mean,
            interval,
            sigma: summary.sigma.value,
            sigma_interval: summary.sigma.interval,
            cov: summary.cov.value,
            cov_interval: summary.cov.interval,
            bounds: None,
            by_size: (random && sizes.len() > 1).then(|| ValueBySize {
                stones: sizes.to_vec(),
                mean: samples.iter().map(|sample| stats::mean(sample)).collect(),
                cov: samples.iter().map(|sample| stats::cov(sample)).collect(),
                shown: size_effect(&sides, samples),
            }),
        }
    }
}

/// Sums up cells, which come in the order of arms, sizes and cells, and walls where some were asked.
pub fn homogenised_summary(
    study: &Study,
    asked: &AskedOfCells,
    rows: &[CellRow],
    walls: &[WallRow],
) -> HomogenisedSummary {
    let arms = asked.arms.iter().map(|&arm| {
        let own: Vec<&CellRow> = rows.iter().filter(|row| row.task.arm == arm).collect();
        let walls = walls.iter().any(|row| row.task.arm == arm).then(|| WallsAsPlates::of(arm, walls));
        PlateArm { walls, ..arm_entry(study, asked, arm, &own) }
    });
    HomogenisedSummary {
        study: study.name.clone(),
        variant: study.variant.clone(),
        seed: study.seed,
        study_hash: study.hash.clone(),
        units: UNITS,
        arms: arms.collect(),
    }
}

fn arm_entry(study: &Study, asked: &AskedOfCells, arm: u32, rows: &[&CellRow]) -> PlateArm {
    let own = &study.arms[arm as usize];
    let random = is_random(own);
    let last = asked.sizes.len() - 1;
    let of_size = |size: usize| rows.iter().filter(move |row| row.task.size == size);
    let answers: Vec<Vec<&CellAnswer>> = (0..asked.sizes.len())
        .map(|size| of_size(size).filter_map(|row| row.found.as_ref().ok()).collect())
        .collect();
    let mut failed = BTreeMap::new();
    for fault in of_size(last).filter_map(|row| row.found.as_ref().err()) {
        *failed.entry(fault.to_string()).or_insert(0) += 1;
    }
    let known: Vec<bool> = answers.iter().flatten().filter_map(|answer| answer.is_nested()).collect();
    let first = answers[last].first();
    let mut surface = Vec::new();
    for (place, method) in asked.of.methods.iter().enumerate() {
        for (at, direction) in asked.of.directions.iter().enumerate() {
            surface.push(surface_entry(&answers, (place, *method), (at, *direction), &asked.sizes, random));
        }
    }
    PlateArm {
        arm: own.name.clone(),
        kn_pa_per_m: own.kn_points[asked.point as usize],
        cell: PlateCells {
            stones: asked.sizes[last],
            cells: of_size(last).count(),
            failed,
            thickness_m: first.map(|answer| answer.thickness),
            head_joint_gap_m: own.layout.head_joint_gap,
            pressure_n_per_m: first.map(|answer| answer.pressure),
            nested: NestedCells { held: known.iter().filter(|held| **held).count(), of: known.len() },
        },
        moduli: moduli(&answers, &asked.sizes, random),
        surface,
        walls: None,
    }
}

fn surface_entry(
    answers: &[Vec<&CellAnswer>],
    (place, method): (usize, Method),
    (at, direction): (usize, Direction),
    sizes: &[[u32; 2]],
    random: bool,
) -> SurfaceEntry {
    let found = |answer: &&CellAnswer| answer.surfaces[place][at].found.clone();
    let samples: Vec<Vec<f64>> =
        answers.iter().map(|size| size.iter().filter_map(|own| found(own).value()).collect()).collect();
    let last = answers.last().map_or(&[][..], Vec::as_slice);
    let count = |is: fn(&Found) -> bool| last.iter().filter(|own| is(&found(own))).count();
    SurfaceEntry {
        method,
        direction,
        value: PlateValue::of(&samples, sizes, random),
        unbounded: count(|own| matches!(own, Found::Unbounded | Found::AtLeast(_))),
        fall_at_rest: count(|own| matches!(own, Found::FallsAtRest)),
        not_converged: count(|own| matches!(own, Found::NotConverged(_))),
    }
}

/// Every modulus that does not vanish in all cells, with its bounds.
fn moduli(answers: &[Vec<&CellAnswer>], sizes: &[[u32; 2]], random: bool) -> BTreeMap<String, PlateValue> {
    let of = |border: Border, size: &[&CellAnswer], modulus: &Modulus| -> Vec<f64> {
        let place = Border::ALL.iter().position(|own| *own == border).unwrap_or_default();
        size.iter().filter_map(|own| own.moduli[place].as_ref().ok()).map(|own| (modulus.of)(own)).collect()
    };
    let mut all = BTreeMap::new();
    for modulus in named() {
        let samples: Vec<Vec<f64>> =
            answers.iter().map(|size| of(Border::Periodic, size, &modulus)).collect();
        if samples.iter().flatten().all(|value| *value == 0.0) {
            continue;
        }
        let last = answers.last().map_or(&[][..], Vec::as_slice);
        let mean = |border| stats::mean(&of(border, last, &modulus));
        let bounds = ModulusBounds { kinematic: mean(Border::Kinematic), fixed: mean(Border::Static) };
        all.insert(
            modulus.name,
            PlateValue { bounds: Some(bounds), ..PlateValue::of(&samples, sizes, random) },
        );
    }
    all
}

/// A modulus by its name.
pub(crate) struct Modulus {
    pub name: String,
    pub of: Box<dyn Fn(&Moduli) -> f64>,
}

/// All moduli: six of the membrane, six of bending, nine couplings, three of transverse shear.
pub(crate) fn named() -> Vec<Modulus> {
    let mut all = Vec::new();
    let mut add = |name: String, i: usize, j: usize| {
        let of = Box::new(move |own: &Moduli| {
            significant(own.stiffness[i][j], own.stiffness[i][i], own.stiffness[j][j])
        });
        all.push(Modulus { name, of });
    };
    for (letter, from) in [("A", 0), ("D", 3)] {
        for (i, j) in [(0, 0), (1, 1), (0, 1), (2, 2), (0, 2), (1, 2)] {
            add(format!("{letter}{}{}", PAIRS[i], PAIRS[j]), from + i, from + j);
        }
    }
    for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
        add(format!("B{}{}", PAIRS[i], PAIRS[j]), i, 3 + j);
    }
    for (i, j) in [(0, 0), (1, 1), (0, 1)] {
        let of = Box::new(move |own: &Moduli| significant(own.shear[i][j], own.shear[i][i], own.shear[j][j]));
        all.push(Modulus { name: format!("F{}{}", i + 1, j + 1), of });
    }
    all
}

/// A coupling, or 0 where it is rounding beside the moduli that it couples.
fn significant(coupling: f64, a: f64, b: f64) -> f64 {
    if coupling.abs() < NOTHING * (a * b).abs().sqrt() { 0.0 } else { coupling }
}
