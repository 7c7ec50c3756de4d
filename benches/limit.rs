//! Limit analysis on named scenes: joints found, feasibility at rest, tilt angle or lateral multiplier.
//!
//! `cargo bench --bench limit` prints criterion's medians. Records go to `benches/history/`.

use criterion::{Criterion, criterion_group, criterion_main};
use pirca::contact;
use pirca::generate::canonical;
use pirca::law::{CohesionAfterSlip, Coulomb, NormalLaw, Sampling};
use pirca::math::{Vec3, radians, tan};
use pirca::model::Outcome;
use pirca::solve::limit::{Analysis, Cone, Loads, Settings};

/// Dry joints of 30 degrees; the stiffnesses play no part.
fn law() -> Coulomb {
    Coulomb {
        normal: NormalLaw::Linear { kn: 1e9 },
        ks: 5e8,
        tan_phi: tan(radians(30.0)),
        cohesion: 0.0,
        tension: 0.0,
        cohesion_after_slip: CohesionAfterSlip::Kept,
        weakening: None,
        sampling: Sampling::Area,
        bonded: false,
    }
}

fn collapse(c: &mut Criterion) {
    let law = law();
    let contact = contact::Settings::for_size(0.1, [2, 2]);
    let mut group = c.benchmark_group("limit");
    group.sample_size(10);
    for (name, wall) in [
        ("wall_72", canonical::wall_72().with_base()),
        ("wall_500", canonical::running_bond(25, 19).with_base()),
    ] {
        for (cone_name, cone) in [("socp", Cone::SecondOrder), ("lp8", Cone::Linearised { sides: 8 })] {
            let settings = Settings { cone, ..Settings::default() };
            group.bench_function(format!("{name}/tilt/{cone_name}"), |b| {
                b.iter(|| {
                    let limit = Analysis::new(&wall, &law, contact, settings).tilt(Vec3::y(), &[]);
                    assert!(matches!(limit.outcome, Outcome::Collapsed { .. }), "{:?}", limit.outcome);
                });
            });
            group.bench_function(format!("{name}/lateral/{cone_name}"), |b| {
                b.iter(|| {
                    let analysis = Analysis::new(&wall, &law, contact, settings);
                    let limit = analysis.multiplier(&Loads::lateral(Vec3::x()));
                    assert!(matches!(limit.outcome, Outcome::Collapsed { .. }), "{:?}", limit.outcome);
                });
            });
        }
    }
    // 2,000 stones, 1.67 m high: it topples at atan(0.114 / 1.667).
    let great = canonical::running_bond(40, 49).with_base();
    group.bench_function("wall_2000/tilt/socp", |b| {
        b.iter(|| {
            let limit = Analysis::new(&great, &law, contact, Settings::default()).tilt(Vec3::y(), &[]);
            assert!((limit.multiplier - 0.0684).abs() < 1e-6, "{:?}", limit.outcome);
        });
    });
    group.finish();
}

criterion_group!(benches, collapse);
criterion_main!(benches);
