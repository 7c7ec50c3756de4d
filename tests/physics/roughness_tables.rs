//! The tables and the figure of `studies/roughness/README.md`, made anew:
//!
//!     cargo test --release --test physics -- --ignored --nocapture --test-threads 1 roughness_tables
//!
//! With `PIRCA_FIGURES=write` the figure is written as well.

use crate::regular_rows::RegularRows;
use std::fmt::Write as _;
use std::path::Path;

use cpu_time::ThreadTime;
use pirca::generate::canonical::{THICKNESS, running_bond};
use pirca::math::{atan, degrees};
use pirca::model::{Hollow, Wall};
use pirca::protocol::{Direction, TiltedHeap};
use pirca::solve::{Solver, explicit, implicit, limit};

use crate::roughness::{Beds, rows as regular};
use crate::roughness_walls::{IN_PLANE, column, in_clumps, in_polyhedra, middle, rows};

const PHI: f64 = 30.0;

/// Slips the beds over two spacings and prints a line beside the closed form.
fn line(name: &str, rows: RegularRows, model: Hollow, offset: f64) {
    let beds = Beds { rows, model, offset, closure: 1e-3 * rows.radius };
    let slid = beds.slid(2);
    let angle = |ratio: f64| degrees(atan(ratio));
    println!(
        "| {name} | {:.0} | {:.2} | {offset} | {:.1} ({:.1}) | {:.1} ({:.1}) | {:.1} ({:.1}) | {:.1} ({:.1}) | {:.2} ({:.2}) |",
        1e3 * rows.radius,
        rows.spacing / rows.radius,
        angle(slid.readings[1].ratio),
        angle(rows.ratio(beds.behind_a_crest(slid.readings[1].way))),
        angle(slid.peak()),
        angle(rows.peak()),
        angle(slid.mean_from(0.0)),
        angle(rows.mean()),
        degrees(slid.dilatancy()),
        degrees(rows.steepest()),
        1e3 * slid.rise(),
        1e3 * rows.rise(),
    );
    // As in the tests of the joint: the speed is a fiftieth of sqrt(g d).
    assert!((slid.mean_from(0.0) / rows.mean() - 1.0).abs() < 0.01);
    assert!((slid.peak() / rows.peak() - 1.0).abs() < 0.03);
}

#[test]
#[ignore = "slow: 11 s, prints a table"]
fn shear_of_two_stones() {
    println!("| rows | r (mm) | s / r | offset / s | start (deg) | peak | mean | dilatancy | rise (mm) |");
    for (radius, spacing, offset) in [
        (0.01, 2.0, 0.5),
        (0.005, 2.0, 0.5),
        (0.0025, 2.0, 0.5),
        (0.01, 1.5, 0.5),
        (0.01, 1.0, 0.5),
        (0.01, 0.5, 0.5),
        (0.01, 1.5, 0.75),
        (0.01, 1.5, 0.0),
        (0.01, 1.5, 0.25),
    ] {
        line("plane", regular(radius, spacing * radius, false, PHI), Hollow::Plane, offset);
    }
    for (name, spacing, between, offset) in [
        ("space, above rows", 1.5, false, 0.5),
        ("space, above rows", 1.5, false, 0.0),
        ("space, between rows", 1.5, true, 0.5),
        ("space, between rows", 1.5, true, 0.0),
    ] {
        line(name, regular(0.01, spacing * 0.01, between, PHI), Hollow::Space, offset);
    }
}

fn implicit() -> Solver {
    Solver::Implicit(implicit::Settings::default())
}

/// The inset (m) with which polyhedra fall at an angle (deg), to 1e-5 m; 0 where they do with full faces already.
fn matching_inset(wall: &Wall, towards: Direction, [kn, phi]: [f64; 2], angle: f64) -> f64 {
    let falls = |inset| middle(in_polyhedra(wall, towards, [kn, phi, inset], &implicit()).bracket);
    let (mut low, mut high) = (0.0, 0.4 * THICKNESS);
    if falls(low) <= angle {
        return 0.0;
    }
    while high - low > 1e-5 {
        let half = 0.5 * (low + high);
        if falls(half) > angle { low = half } else { high = half }
    }
    0.5 * (low + high)
}

/// A result, with the processor time (s) that it took.
fn timed<T>(of: impl FnOnce() -> T) -> (T, f64) {
    let begun = ThreadTime::now();
    let result = of();
    (result, begun.elapsed().as_secs_f64())
}

fn fell(tilted: &TiltedHeap) -> String {
    match tilted.bracket {
        Some(_) => format!("{:.2}", middle(tilted.bracket)),
        None => format!("{} ({})", tilted.outcome.name(), tilted.outcome.reason()),
    }
}

/// What polyhedra with full faces do, by all solvers.
fn polyhedra(wall: &Wall, towards: Direction, kn: f64) {
    for (name, solver) in [
        ("implicit", implicit()),
        ("explicit", Solver::Explicit(explicit::Settings::default())),
        ("limit", Solver::Limit(limit::Settings::default())),
    ] {
        let (run, time) = timed(|| in_polyhedra(wall, towards, [kn, PHI, 0.0], &solver));
        let cycles: u64 = run.steps.iter().map(|step| step.solver_steps).sum();
        println!("| {kn:.1e} | polyhedra, {name} | {:.2} | | {cycles} | {time:.2} |", middle(run.bracket));
    }
}

fn clumps(wall: &Wall, model: (Hollow, Direction), kn: f64, radii: &[f64]) {
    for &radius in radii {
        for in_hollows in [false, true] {
            let rows = rows(radius, 2.0, in_hollows);
            let (tilted, time) = timed(|| in_clumps(wall, model, &rows, [kn, PHI]));
            let inset = matching_inset(wall, model.1, [kn, PHI], middle(tilted.bracket));
            println!(
                "| {kn:.1e} | clumps, r = {} mm, {} | {} | {:.1} mm | {} | {time:.2} |",
                1e3 * radius,
                if in_hollows { "in hollows" } else { "ball on ball" },
                fell(&tilted),
                1e3 * inset,
                tilted.cycles,
            );
            // However stiff, it turns over no more than its last contact.
            assert!(inset < radius * if in_hollows { 1.5 } else { 1.0 });
        }
    }
}

#[test]
#[ignore = "slow: 200 s, prints a table"]
fn a_column_in_plane() {
    println!("| kn (Pa/m) | model | falls at (deg) | inset that matches | cycles | processor time (s) |");
    for kn in [5e7, 1e9, 2e10] {
        polyhedra(&column(9), Direction::XPlus, kn);
        clumps(&column(9), IN_PLANE, kn, &[0.01, 0.005, 0.0025]);
    }
}

#[test]
#[ignore = "slow: 170 s, prints a table"]
fn a_wall_in_space() {
    println!("| kn (Pa/m) | model | falls at (deg) | inset that matches | cycles | processor time (s) |");
    let wall = running_bond(9, 2);
    for kn in [5e7, 1e9] {
        polyhedra(&wall, Direction::YPlus, kn);
        clumps(&wall, (Hollow::Space, Direction::YPlus), kn, &[0.01]);
    }
}

#[test]
#[ignore = "slow: 10 s, prints a table of a study"]
fn a_column_in_space() {
    println!("| kn (Pa/m) | model | falls at (deg) | inset that matches | cycles | processor time (s) |");
    clumps(&column(9), (Hollow::Space, Direction::XPlus), 5e7, &[0.01]);
}

#[test]
#[ignore = "slow: 1 s, prints a table of a study"]
fn friction_of_a_wall_that_slides() {
    println!(
        "| balls' phi | s / r | clumps fall at | phi + theta_max | mean | polyhedra: balls' phi | peak's | mean's |"
    );
    let wall = column(3);
    for (phi, share) in [(5.0, 1.0), (5.0, 2.0), (15.0, 0.5), (15.0, 1.0)] {
        let kn = 1e9;
        let rows = rows(0.0095, share, true);
        let regular = regular(rows.radius, rows.spacing, false, phi);
        let tilted = in_clumps(&wall, IN_PLANE, &rows, [kn, phi]);
        let [peak, mean] = [regular.peak(), regular.mean()].map(|ratio| degrees(atan(ratio)));
        let of = |phi: f64| {
            middle(in_polyhedra(&wall, Direction::XPlus, [kn, phi, rows.radius], &implicit()).bracket)
        };
        println!(
            "| {phi} | {share} | {} | {peak:.2} | {mean:.2} | {:.2} | {:.2} | {:.2} |",
            fell(&tilted),
            of(phi),
            of(peak),
            of(mean)
        );
        // Near a right angle of phi and slope together, springs that give by a closure matter most.
        assert!((middle(tilted.bracket) - of(peak)).abs() < 1.2);
    }
}

/// Width and height of the figure, and its margins (px).
const SIZE: [f64; 2] = [640.0, 300.0];
const MARGIN: [f64; 2] = [56.0, 40.0];

#[test]
#[ignore = "slow: 1 s, draws a figure of a study"]
fn figure_of_the_shear_ratio() {
    let (x, y) = (
        |spacings: f64| MARGIN[0] + (SIZE[0] - MARGIN[0] - 120.0) * spacings / 2.0,
        |ratio: f64| SIZE[1] - MARGIN[1] - (SIZE[1] - MARGIN[1] - 16.0) * (ratio + 0.1) / 1.9,
    );
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <title>Shear over normal force of two stones of balls against the way, for three spacings: points of the model on the \
         curves of the closed form</title>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        SIZE[0], SIZE[1]
    );
    for tick in 0..=3 {
        let ratio = 0.5 * f64::from(tick);
        let (left, right) = (x(0.0), x(2.0));
        let at = y(ratio);
        let _ = writeln!(
            svg,
            "<path d=\"M{left:.1} {at:.1}H{right:.1}\" stroke=\"#ddd\"/><text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{ratio}</text>",
            left - 6.0,
            at + 4.0
        );
    }
    for tick in 0..=4 {
        let way = 0.5 * f64::from(tick);
        let _ = writeln!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{way}</text>",
            x(way),
            SIZE[1] - 24.0
        );
    }
    let _ = writeln!(
        svg,
        "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">way / s</text>",
        x(1.0),
        SIZE[1] - 6.0
    );
    let _ = writeln!(
        svg,
        "<text x=\"12\" y=\"{:.1}\" transform=\"rotate(-90 12 {0:.1})\" text-anchor=\"middle\">T / N</text>",
        y(0.8)
    );
    for (share, colour) in [(2.0, "#b2182b"), (1.0, "#2166ac"), (0.5, "#4d9221")] {
        let rows = regular(0.01, share * 0.01, false, PHI);
        let beds = Beds { rows, model: Hollow::Plane, offset: 0.5, closure: 1e-5 };
        let slid = beds.slid(2);
        let mut path = String::new();
        for k in 0..400 {
            let way = (f64::from(k) + 0.5) / 200.0;
            let at = y(rows.ratio(beds.behind_a_crest(way * rows.spacing)));
            let _ = write!(path, "{}{:.1} {at:.1}", if k == 0 { "M" } else { "L" }, x(way));
        }
        let _ = writeln!(svg, "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\"/>");
        for reading in slid.readings.iter().skip(2).step_by(8) {
            let (cx, cy) = (x(reading.way / rows.spacing), y(reading.ratio));
            let _ = writeln!(svg, "<circle cx=\"{cx:.1}\" cy=\"{cy:.1}\" r=\"2.2\" fill=\"{colour}\"/>");
        }
        let _ = writeln!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.1}\" fill=\"{colour}\">s = {share} r</text>",
            x(2.0) + 8.0,
            y(rows.ratio(0.45 * rows.spacing)) + 4.0
        );
    }
    svg.push_str("</svg>\n");
    if std::env::var("PIRCA_FIGURES").as_deref() == Ok("write") {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/roughness/figures/slip.svg");
        std::fs::write(&file, &svg).expect("the figure can be written");
    }
    println!("{} bytes", svg.len());
}
