//! The tables of `studies/rocking/README.md`, made anew:
//!
//!     cargo test --release --test physics -- --ignored --nocapture --test-threads 1 rocking_tables

use crate::rocking_block::{Block, Impact};
use crate::rocking_pairs::{Distance, counted, difference};
use crate::rocking_records::{
    Imperfection, OVERTURNED, beside, measure, overturned, paired, ratios, record, reference, referred, seen,
};
use pirca::protocol::InTime;
use pirca::solve::explicit::{self, Rayleigh};
use pirca::stats::{Sorted, clopper_pearson, quantile, quantile_interval};

/// Records.
const N: u64 = 200;
/// The stones: half width and half height (m).
const LARGE: [f64; 2] = [0.2, 0.6];
const SMALL: [f64; 2] = [0.05, 0.2];
/// Peak ground velocity (m/s) of the tables of a single amplitude, under which the large stone is shaken.
const PGV: f64 = 0.6;
const PERFECT: Imperfection = Imperfection { slope: 0.0, size: 0.0, worn: 0.0 };
/// Time step (s) of contact dynamics.
const STEP: f64 = 2e-3;

/// A share in percent with the interval of Clopper and Pearson.
fn share(hits: usize, of: usize) -> String {
    let [low, high] = clopper_pearson(hits, of).map(|end| 100.0 * end);
    format!("{:.1} ({low:.1} to {high:.1})", 100.0 * hits as f64 / of as f64)
}

/// What two samples of pairs have in common.
fn line(name: &str, pairs: &[[f64; 2]]) {
    let fell = overturned(pairs);
    let counts = counted(&fell);
    let [both, first, second, _] = counts;
    let (found, interval) = difference(counts);
    let distance = Distance::of(pairs);
    let ratios = ratios(pairs);
    let median = quantile(&ratios, 0.5).unwrap_or(f64::NAN);
    let [low, high] = quantile_interval(&ratios, 0.5).unwrap_or([f64::NAN; 2]);
    println!(
        "| {name} | {} | {} | {first}, {second} | {:.1} ({:.1} to {:.1}) | {:.3} | {:.3} | {:.4} | {median:.3} ({low:.3} to {high:.3}) of {} |",
        share(both + first, pairs.len()),
        share(both + second, pairs.len()),
        100.0 * found,
        100.0 * interval[0],
        100.0 * interval[1],
        distance.found,
        distance.critical,
        distance.p_value,
        ratios.len(),
    );
}

const HEAD: &str = "| | first overturns (%) | second (%) | first only, second only | difference (%) | KS | critical | p | median ratio |";

/// Quantiles of the peaks with their intervals.
fn quantiles(name: &str, values: Vec<f64>) {
    let sorted = Sorted::of(values);
    let told = |value: f64| if value == OVERTURNED { "falls".to_owned() } else { format!("{value:.3}") };
    let cells: Vec<String> = [0.1, 0.25, 0.5, 0.75, 0.9]
        .map(|p| {
            let found = sorted.quantile(p);
            let [low, high] = found.interval.expect("enough values");
            // Between a stone that fell and one that did not no quantile is read.
            let value = found.value.map_or(f64::NAN, |value| if value > 1.7 { OVERTURNED } else { value });
            format!("{} ({} to {})", told(value), told(low), told(high))
        })
        .to_vec();
    println!("| {name} | {} |", cells.join(" | "));
}

fn column(pairs: &[[f64; 2]], which: usize) -> Vec<f64> {
    pairs.iter().map(|pair| pair[which]).collect()
}

#[test]
#[ignore = "slow: 9 minutes, prints the tables of a study"]
fn contact_dynamics_beside_housner() {
    for (name, half, amplitudes) in [("large", LARGE, [0.5, 0.6, 0.7]), ("small", SMALL, [0.2, 0.25, 0.3])] {
        for pgv in amplitudes {
            let [perfect, imperfect] =
                [PERFECT, Imperfection::ALL].map(|own| paired(half, pgv, &own, STEP, N));
            println!("\n{name}, {pgv} m/s\n{HEAD}");
            line("contact dynamics, Housner; perfect", &perfect);
            line("contact dynamics, Housner; imperfect", &imperfect);
            line(
                "perfect, imperfect; contact dynamics",
                &beside(&column(&perfect, 0), &column(&imperfect, 0)),
            );
            line("perfect, imperfect; Housner", &beside(&column(&perfect, 1), &column(&imperfect, 1)));
            for (name, pairs) in [("perfect", &perfect), ("imperfect", &imperfect)] {
                quantiles(&format!("contact dynamics, {name}"), column(pairs, 0));
                quantiles(&format!("Housner, {name}"), column(pairs, 1));
            }
        }
    }
}

#[test]
#[ignore = "slow: 20 minutes, prints a table of a study"]
fn the_time_step() {
    println!("{HEAD}");
    for (stone, half, pgv) in [("large", LARGE, PGV), ("small", SMALL, 0.3)] {
        for step in [5e-3, 2e-3, 1e-3] {
            for (base, own) in [("perfect", PERFECT), ("imperfect", Imperfection::ALL)] {
                let pairs = paired(half, pgv, &own, step, N);
                line(&format!("{stone}, {base}, {} ms, Housner", 1e3 * step), &pairs);
                let apart: Vec<f64> = pairs.iter().map(|[a, b]| (a - b).abs()).collect();
                let beyond = apart.iter().filter(|apart| **apart > 0.1).count();
                let median = quantile(&apart, 0.5).expect("there are records");
                println!(
                    "record by record: median {median:.4}, by more than 0.1: {}",
                    share(beyond, apart.len())
                );
            }
        }
    }
}

#[test]
#[ignore = "slow: 30 s, prints a table of a study"]
fn restitutions_that_are_told_apart() {
    println!("{HEAD}");
    let housner = referred(LARGE, PGV, &PERFECT, Impact::Housner, N);
    for kept in [0.5, 0.7, 0.8, 0.82, 0.83, 0.84, 0.849, 0.86, 0.87, 0.88, 0.9, 1.0] {
        let other = referred(LARGE, PGV, &PERFECT, Impact::Kept(kept), N);
        line(&format!("Housner, {kept}"), &beside(&housner, &other));
    }
}

#[test]
#[ignore = "slow: 20 s, prints a table of a study"]
fn imperfections_one_by_one() {
    println!("{HEAD}");
    let of = |own: &Imperfection| referred(LARGE, PGV, own, Impact::Housner, N);
    let perfect = of(&PERFECT);
    for (name, own) in [
        ("slope", Imperfection { slope: Imperfection::ALL.slope, ..PERFECT }),
        ("size", Imperfection { size: Imperfection::ALL.size, ..PERFECT }),
        ("slope and size", Imperfection { worn: 0.0, ..Imperfection::ALL }),
        ("bearing", Imperfection { worn: Imperfection::ALL.worn, ..PERFECT }),
        ("all", Imperfection::ALL),
    ] {
        line(&format!("perfect, {name}"), &beside(&perfect, &of(&own)));
    }
    // What bears less on average, the same at either end of every stone.
    let block = Block { ends: [0.95 * LARGE[0]; 2], ..Block::perfect(LARGE[0], LARGE[1]) };
    let even: Vec<f64> = (0..N)
        .map(|member| measure(reference(&block, &record(member, PGV), Impact::Housner), LARGE))
        .collect();
    let bearing = of(&Imperfection { worn: Imperfection::ALL.worn, ..PERFECT });
    line("bearing 5 % less at either end, bearing drawn", &beside(&even, &bearing));
    line("bearing 5 % less at either end, all", &beside(&even, &of(&Imperfection::ALL)));
}

#[test]
#[ignore = "slow: half a minute, prints a table of a study"]
fn elastic_joints() {
    println!("{HEAD}");
    let n = N / 2;
    let housner = referred(LARGE, PGV, &PERFECT, Impact::Housner, n);
    for kn in [1e9, 1e10] {
        for stiffness in [0.0, 1e-3] {
            let rayleigh = Rayleigh { mass: 0.0, stiffness };
            let solver = InTime::Explicit(explicit::Settings::default(), rayleigh);
            let elastic = seen(LARGE, PGV, &PERFECT, (solver, kn), n);
            line(
                &format!("explicit, kn {kn:e} Pa/m, beta {stiffness} s; Housner"),
                &beside(&elastic, &housner),
            );
        }
    }
}
