use super::standard_normal;
use super::{BadFamily, Family, Move, Streams};

fn first(seed: u64, member: u64, quantity: &str, n: usize) -> Vec<f64> {
    let mut stream = Streams::new(seed, member).of(quantity);
    (0..n).map(|_| stream.uniform()).collect()
}

/// From an own ChaCha12 in Python (quarter rounds of RFC 8439, twelve rounds, 64-bit counter and stream number), run
/// once with the key and the stream number that `Streams::of` documents. The fortieth number comes from the fifth block.
#[test]
fn streams_give_the_numbers_of_an_independent_chacha12() {
    let cases = [
        (
            20260101,
            3,
            "stone length",
            [0.569137272338314, 0.6005749307649041, 0.8784099587821382],
            0.6462062920018953,
        ),
        (
            20260101,
            4,
            "stone length",
            [0.43513874254699136, 0.2861373875362251, 0.9553263378966766],
            0.6366173916142227,
        ),
        (0, 0, "bed dip", [0.03052393110176721, 0.6792305362322696, 0.47572678345009856], 0.6751488763059771),
    ];
    for (seed, member, quantity, start, fortieth) in cases {
        let found = first(seed, member, quantity, 40);
        assert_eq!(found[..3], start, "{quantity} of member {member}");
        assert_eq!(found[39], fortieth, "{quantity} of member {member}");
    }
}

#[test]
fn a_stream_does_not_feel_what_is_asked_of_the_others() {
    let alone = first(7, 2, "stone length", 50);
    let streams = Streams::new(7, 2);
    let mut dip = streams.of("bed dip");
    let mut length = streams.of("stone length");
    let mut mixed = Vec::new();
    for k in 0..50 {
        mixed.push(length.uniform());
        for _ in 0..k {
            dip.uniform();
            dip.below(3);
        }
        streams.of("density").uniform();
    }
    assert_eq!(alone, mixed);
}

#[test]
fn seed_member_and_name_each_change_the_stream() {
    let base = first(7, 2, "stone length", 8);
    for other in
        [first(8, 2, "stone length", 8), first(7, 3, "stone length", 8), first(7, 2, "stone lengths", 8)]
    {
        // Two independent 52-bit numbers agree with probability 2^-52.
        assert!(base.iter().zip(&other).all(|(a, b)| a != b));
    }
    // Seed and member must not be exchangeable.
    assert_ne!(first(2, 7, "stone length", 8), base);
}

#[test]
fn uniforms_lie_in_the_open_interval_and_mirror_exactly() {
    for u in first(1, 0, "mirror", 10_000) {
        assert!(0.0 < u && u < 1.0);
        assert_eq!(1.0 - (1.0 - u), u);
    }
}

/// Chi-square of 6 equal cells from 60,000 draws: five degrees of freedom, upper 0.1 % point 20.515.
#[test]
fn whole_numbers_below_six_are_equally_likely() {
    let mut stream = Streams::new(11, 0).of("die");
    let mut counts = [0_u32; 6];
    for _ in 0..60_000 {
        counts[stream.below(6)] += 1;
    }
    let chi_square: f64 = counts.iter().map(|&c| (f64::from(c) - 1e4) * (f64::from(c) - 1e4) / 1e4).sum();
    assert!(chi_square < 20.515, "{counts:?}");
    assert_eq!(stream.below(1), 0);
}

/// With n = 3 x 2^62 a plain remainder would put half of the draws into the lowest third, and a plain high word of the
/// product would make half of the draws divisible by three. Both shares must be a third.
#[test]
fn whole_numbers_below_a_huge_bound_are_unbiased() {
    let n = 3_usize << 62;
    let mut stream = Streams::new(12, 0).of("huge");
    let draws: Vec<usize> = (0..3000).map(|_| stream.below(n)).collect();
    let lowest_third = draws.iter().filter(|&&k| k < n / 3).count();
    let divisible = draws.iter().filter(|&&k| k % 3 == 0).count();
    // Binomial (3000, 1/3): mean 1000, sd 25.8; four sd.
    assert!((897..=1103).contains(&lowest_third), "{lowest_third}");
    assert!((897..=1103).contains(&divisible), "{divisible}");
}

/// Values to 17 digits or more from a 40-digit solution of erfc(-z / sqrt 2) / 2 = p (mpmath).
#[test]
fn normal_quantile_has_sixteen_digits() {
    let exact = [
        (1e-300, -37.0470962993612),
        (1e-100, -21.273453560965326),
        (1e-20, -9.262340089798407),
        (1e-10, -6.361340902404057),
        (0.001, -3.0902323061678136),
        (0.025, -1.9599639845400543),
        (0.07, -1.4757910281791706),
        (0.08, -1.4050715603096327),
        (0.3, -0.5244005127080408),
        (0.6, 0.2533471031357998),
        (0.9, 1.2815515655446006),
    ];
    for (p, z) in exact {
        let found = standard_normal::quantile(p);
        // Wichura states 1 part in 1e16; a few roundings of the polynomials and of p itself come on top.
        assert!((found - z).abs() <= 2e-15 * z.abs(), "p = {p}: {found} instead of {z}");
    }
    assert_eq!(standard_normal::quantile(0.5), 0.0);
}

#[test]
fn the_smallest_and_the_largest_uniform_give_finite_draws() {
    let ends = [2.0_f64.recip() / (1_u64 << 52) as f64, 1.0 - 2.0_f64.recip() / (1_u64 << 52) as f64];
    for family in one_of_each() {
        let (low, high) = family.support();
        for u in ends {
            let x = family.quantile(u);
            assert!(x.is_finite() && low <= x && x <= high, "{family:?} at {u}: {x}");
        }
    }
}

#[test]
fn every_family_takes_exactly_one_uniform() {
    for family in one_of_each() {
        let mut stream = Streams::new(5, 1).of("one");
        let u = first(5, 1, "one", 2);
        assert_eq!(family.sample(&mut stream), family.quantile(u[0]), "{family:?}");
        assert_eq!(stream.uniform(), u[1], "{family:?}");
    }
}

fn one_of_each() -> Vec<Family> {
    let families = [
        Family::Constant { value: 2.0 },
        Family::Uniform { low: -1.0, high: 0.1 },
        Family::Normal { mean: 0.12, sd: 0.03 },
        Family::TruncatedNormal { mean: 0.0, sd: 1.0, low: 8.0, high: 9.0 },
        Family::Lognormal { mean: 0.2, sd: 0.1 },
        Family::Triangular { low: 0.1, mode: 0.1, high: 0.3 },
        Family::Empirical { values: vec![3.0, 1.0, 2.0] },
    ];
    families.map(|f| f.checked().expect("good parameters")).to_vec()
}

#[test]
fn empirical_quantile_inverts_its_cdf() {
    let family = Family::Empirical { values: vec![3.0, 1.0, 2.0, 2.0] }.checked().expect("good list");
    assert_eq!(family, Family::Empirical { values: vec![1.0, 2.0, 2.0, 3.0] });
    for (u, x) in [(0.1, 1.0), (0.25, 1.0), (0.26, 2.0), (0.75, 2.0), (0.76, 3.0), (0.99, 3.0)] {
        assert_eq!(family.quantile(u), x, "at {u}");
    }
    for (x, p) in [(0.9, 0.0), (1.0, 0.25), (2.5, 0.75), (3.0, 1.0)] {
        assert_eq!(family.cdf(x), p, "at {x}");
    }
    assert_eq!((family.mean(), family.sd(), family.support()), (2.0, 0.5_f64.sqrt(), (1.0, 3.0)));
    assert_eq!(family.density(2.0), None);
}

#[test]
fn constant_has_all_its_probability_in_one_point() {
    let family = Family::Constant { value: 2.0 };
    assert_eq!((family.cdf(1.999), family.cdf(2.0)), (0.0, 1.0));
    assert_eq!(
        (family.mean(), family.sd(), family.support(), family.density(2.0)),
        (2.0, 0.0, (2.0, 2.0), None)
    );
}

fn faults_of(family: Family) -> Vec<&'static str> {
    family.checked().err().unwrap_or_default().iter().map(|f: &BadFamily| f.parameter).collect()
}

#[test]
fn every_bad_parameter_is_named() {
    use Family::*;
    let (nan, inf) = (f64::NAN, f64::INFINITY);
    let cases = [
        (Constant { value: nan }, vec!["value"]),
        (Constant { value: inf }, vec!["value"]),
        (Constant { value: -1e101 }, vec!["value"]),
        (Uniform { low: 1.0, high: 1.0 }, vec!["high"]),
        (Uniform { low: 2.0, high: 1.0 }, vec!["high"]),
        (Uniform { low: nan, high: inf }, vec!["low", "high"]),
        (Normal { mean: nan, sd: 0.0 }, vec!["mean", "sd"]),
        (Normal { mean: 0.0, sd: -1.0 }, vec!["sd"]),
        (Normal { mean: 0.0, sd: nan }, vec!["sd"]),
        (Normal { mean: 0.0, sd: inf }, vec!["sd"]),
        (TruncatedNormal { mean: inf, sd: 0.0, low: nan, high: -inf }, vec!["mean", "sd", "low", "high"]),
        (TruncatedNormal { mean: 0.0, sd: 1.0, low: 1.0, high: -1.0 }, vec!["high"]),
        (TruncatedNormal { mean: 0.0, sd: 1.0, low: 1.0, high: 1.0 + 1e-7 }, vec!["high"]),
        (TruncatedNormal { mean: 0.0, sd: 1.0, low: 38.0, high: 50.0 }, vec!["low"]),
        (TruncatedNormal { mean: 0.0, sd: 1.0, low: -50.0, high: -38.0 }, vec!["high"]),
        (Lognormal { mean: 0.0, sd: 1.0 }, vec!["mean"]),
        (Lognormal { mean: -1.0, sd: 0.0 }, vec!["sd", "mean"]),
        (Lognormal { mean: nan, sd: 1.0 }, vec!["mean"]),
        (Lognormal { mean: 1.0, sd: 1e-13 }, vec!["sd"]),
        (Lognormal { mean: 1e-10, sd: 1e41 }, vec!["sd"]),
        (
            TruncatedLognormal { median: 0.0, log_sd: 0.0, low: nan, high: 1.0 },
            vec!["median", "log_sd", "low"],
        ),
        (TruncatedLognormal { median: 1.0, log_sd: 1.0, low: 0.0, high: 1.0 }, vec!["low"]),
        (TruncatedLognormal { median: 1.0, log_sd: 1.0, low: 1e-60, high: 1e60 }, vec!["high"]),
        (TruncatedLognormal { median: 1.0, log_sd: 1.0, low: 1.0, high: 1.0 + 1e-7 }, vec!["high"]),
        (TruncatedLognormal { median: 1.0, log_sd: 0.1, low: 100.0, high: 200.0 }, vec!["low"]),
        (Triangular { low: 0.0, mode: 2.0, high: 1.0 }, vec!["mode"]),
        (Triangular { low: 0.0, mode: -0.1, high: 1.0 }, vec!["mode"]),
        (Triangular { low: 1.0, mode: 1.0, high: 1.0 }, vec!["high"]),
        (Triangular { low: nan, mode: nan, high: nan }, vec!["mode", "low", "high"]),
        (Empirical { values: vec![] }, vec!["number of values"]),
        (Empirical { values: vec![1.0, nan, 2.0, inf] }, vec!["values", "values"]),
    ];
    for (family, expected) in cases {
        assert_eq!(faults_of(family.clone()), expected, "{family:?}");
    }
}

#[test]
fn extreme_but_accepted_parameters_stay_finite() {
    let families = [
        Family::Normal { mean: 1e100, sd: 1e100 },
        Family::Uniform { low: -1e100, high: 1e100 },
        Family::Triangular { low: -1e100, mode: 1e100, high: 1e100 },
        Family::Triangular { low: 0.0, mode: 0.0, high: 1e-100 },
        Family::Lognormal { mean: 1.0, sd: 1e-12 },
        Family::Lognormal { mean: 1e50, sd: 1e100 },
        Family::TruncatedNormal { mean: 0.0, sd: 1e-100, low: -1e100, high: 1e100 },
        Family::TruncatedNormal { mean: 0.0, sd: 1e100, low: 0.0, high: 1e95 },
        Family::TruncatedNormal { mean: 0.0, sd: 1.0, low: 37.0, high: 1e100 },
        Family::TruncatedLognormal { median: 1e100, log_sd: 1e-12, low: 1e50, high: 1e100 },
        Family::TruncatedLognormal { median: 1.0, log_sd: 10.0, low: 1e-50, high: 1e50 },
    ];
    for family in families {
        let family = family.checked().expect("accepted");
        assert!(family.mean().is_finite() && family.sd() > 0.0 && family.sd().is_finite(), "{family:?}");
        for u in [1e-15, 0.5, 1.0 - 1e-15] {
            let x = family.quantile(u);
            let density = family.density(x).expect("continuous");
            assert!(
                x.is_finite() && density.is_finite() && (0.0..=1.0).contains(&family.cdf(x)),
                "{family:?} at {u}"
            );
        }
    }
}

#[test]
fn families_are_written_by_name_and_refuse_unknown_parameters() {
    let read = |text: &str| toml::from_str::<Family>(text);
    let family = read("family = \"truncated_normal\"\nmean = 0.0\nsd = 1.0\nlow = -1.0\nhigh = 2.0");
    assert_eq!(
        family.expect("well formed"),
        Family::TruncatedNormal { mean: 0.0, sd: 1.0, low: -1.0, high: 2.0 }
    );
    assert!(read("family = \"constant\"\nvalue = 1.0\nsd = 0.1").is_err());
    assert!(read("family = \"uniform\"\nlow = 1.0").is_err());
    assert!(read("family = \"gumbel\"\nmean = 1.0").is_err());
}

/// The scores of a stream after moves.
fn moved(member: u64, moves: &[Move], n: usize) -> Vec<f64> {
    let mut stream = Streams::new(5, member).after(moves.into()).of("stone length");
    (0..n).map(|_| standard_normal::quantile(stream.uniform())).collect()
}

#[test]
fn moved_numbers_are_distributed_as_before_and_go_with_what_they_were() {
    let n = 40_000;
    let one = Move { from: [5, 1 << 48], keep: 0.8, moved: 1.0 };
    let before = moved(3, &[], n);
    let mean = |of: &dyn Fn(usize) -> f64| (0..n).map(of).sum::<f64>() / n as f64;
    for (moves, kept) in [
        (vec![one], 0.8),
        // Of a tenth of the numbers.
        (vec![Move { moved: 0.1, ..one }], 1.0 - 0.1 * 0.2),
        (vec![one, Move { from: [5, 1 << 49], keep: 0.5, ..one }], 0.4),
    ] {
        let after = moved(3, &moves, n);
        // Standard errors of 0.005 and 0.007.
        assert!(mean(&|k| after[k]).abs() < 0.02 && (mean(&|k| after[k] * after[k]) - 1.0).abs() < 0.03);
        assert!((mean(&|k| before[k] * after[k]) - kept).abs() < 0.03, "{moves:?}");
    }
    // Nothing moved is what it was to the bit; whole numbers move with the rest.
    let same = Move { moved: 0.0, ..one };
    assert_eq!(moved(3, &[same], 50), moved(3, &[], 50));
    let whole = |moves: &[Move]| {
        let mut stream = Streams::new(5, 3).after(moves.into()).of("stone length");
        (0..200).map(|_| stream.below(7)).collect::<Vec<_>>()
    };
    assert_eq!(whole(&[same]), whole(&[]));
    let others = whole(&[one]).iter().zip(whole(&[])).filter(|(a, b)| **a != *b).count();
    assert!((40..160).contains(&others), "{others} of 200");
    // All moves are a pure function of what they are taken from.
    assert_eq!(moved(3, &[one], 50), moved(3, &[one], 50));
    assert_ne!(moved(3, &[one], 50), moved(4, &[one], 50));
}
