//! Tables 2 and 3 of the source paper: its specimens' values must give its printed means, sigmas and COVs.

use pirca::stats::Summary;

/// One column of a table: values, and the printed mean, sigma and COV (%), each with its number of decimals.
struct Column {
    name: &'static str,
    values: [f64; 3],
    mean: (f64, u32),
    sigma: (f64, u32),
    cov: (f64, u32),
}

fn agree(found: f64, (printed, decimals): (f64, u32), what: &str) {
    // Half a unit of the last printed digit, and the rounding of a tie.
    let half = 0.5 / f64::from(10_u32.pow(decimals)) + 1e-9;
    assert!((found - printed).abs() <= half, "{what}: {found}, printed {printed}");
}

fn check(columns: &[Column]) {
    for column in columns {
        let found = Summary::of(&column.values);
        agree(found.mean.value.expect("a mean"), column.mean, column.name);
        agree(found.sigma.value.expect("a sigma"), column.sigma, column.name);
        agree(100.0 * found.cov.value.expect("a COV"), column.cov, column.name);
    }
}

#[test]
fn table_2_collapse_angles() {
    check(&[
        Column { name: "CBL", values: [19.0, 19.0, 18.5], mean: (18.8, 1), sigma: (0.29, 2), cov: (1.53, 2) },
        Column { name: "SBL", values: [13.5, 14.5, 15.0], mean: (14.3, 1), sigma: (0.76, 2), cov: (5.33, 2) },
        Column { name: "SBR", values: [18.0, 19.0, 21.5], mean: (19.5, 1), sigma: (1.80, 2), cov: (9.25, 2) },
    ]);
}

/// From the forces with two decimals, as printed; the sines themselves give other COVs.
#[test]
fn table_2_forces() {
    check(&[
        Column { name: "CBL", values: [0.33, 0.33, 0.32], mean: (0.33, 2), sigma: (0.01, 2), cov: (1.77, 2) },
        Column { name: "SBL", values: [0.23, 0.25, 0.26], mean: (0.25, 2), sigma: (0.02, 2), cov: (6.19, 2) },
        Column { name: "SBR", values: [0.31, 0.33, 0.37], mean: (0.34, 2), sigma: (0.03, 2), cov: (9.07, 2) },
    ]);
}

/// The COV of SBR at 10 deg is 77.77 %, printed 77.7: cut, not rounded.
#[test]
fn table_3_displacements() {
    check(&[
        Column { name: "SBL 5", values: [1.9, 1.2, 0.9], mean: (1.3, 1), sigma: (0.51, 2), cov: (38.5, 1) },
        Column { name: "SBL 10", values: [2.9, 2.0, 1.7], mean: (2.2, 1), sigma: (0.62, 2), cov: (28.4, 1) },
        Column { name: "SBR 5", values: [0.1, 0.3, 0.2], mean: (0.2, 1), sigma: (0.1, 1), cov: (50.0, 0) },
        Column { name: "SBR 10", values: [0.9, 0.9, 3.1], mean: (1.6, 1), sigma: (1.3, 1), cov: (77.77, 2) },
        Column { name: "SBR 15", values: [3.4, 2.0, 4.0], mean: (3.1, 1), sigma: (1.03, 2), cov: (32.8, 1) },
    ]);
}
