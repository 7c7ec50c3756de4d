//! Limit analysis on named scenes: joints found, feasibility at rest, tilt angle or lateral multiplier.
//!
//! `cargo bench --bench limit`; see `benches/README.md`.

mod record;

use pirca::contact;
use pirca::generate::canonical;
use pirca::law::{CohesionAfterSlip, Coulomb, NormalLaw, Sampling};
use pirca::math::{Vec3, radians, tan};
use pirca::model::Outcome;
use pirca::solve::limit::{Analysis, Cone, Loads, Settings};

use record::Bench;

/// Dry joints of 30 degrees; the stiffnesses play no part.
fn law() -> Coulomb {
    Coulomb {
        normal: NormalLaw::Linear { kn: 1e9 },
        ks: 5e8,
        tan_phi: tan(radians(30.0)),
        cohesion: 0.0,
        tension: 0.0,
        compressive_strength: None,
        cohesion_after_slip: CohesionAfterSlip::Kept,
        weakening: None,
        sampling: Sampling::Area,
        bonded: false,
    }
}

fn main() {
    let mut bench = Bench::start();
    let law = law();
    let contact = contact::Settings::for_size(0.1, [2, 2]);
    for (scene, wall) in [
        ("wall_72", canonical::wall_72().with_base()),
        ("wall_500", canonical::running_bond(25, 19).with_base()),
    ] {
        for (cones, cone) in
            [("", Cone::SecondOrder), (", cones of eight sides", Cone::Linearised { sides: 8 })]
        {
            let analysis = || Analysis::new(&wall, &law, contact, Settings { cone, ..Settings::default() });
            bench.scene(
                [scene, &format!("limit analysis of the tilt{cones}")],
                None,
                || (),
                |()| {
                    let limit = analysis().tilt(Vec3::y(), &[]);
                    assert!(matches!(limit.outcome, Outcome::Collapsed { .. }), "{:?}", limit.outcome);
                },
            );
            bench.scene(
                [scene, &format!("limit analysis of a lateral load{cones}")],
                None,
                || (),
                |()| {
                    let limit = analysis().multiplier(&Loads::lateral(Vec3::x()));
                    assert!(matches!(limit.outcome, Outcome::Collapsed { .. }), "{:?}", limit.outcome);
                },
            );
        }
    }
    // 2,000 stones, 1.67 m high: it topples at atan(0.114 / 1.667).
    let great = canonical::running_bond(40, 49).with_base();
    bench.scene(
        ["wall_2000", "limit analysis of the tilt"],
        None,
        || (),
        |()| {
            let limit = Analysis::new(&great, &law, contact, Settings::default()).tilt(Vec3::y(), &[]);
            assert!((limit.multiplier - 0.0684).abs() < 1e-6, "{:?}", limit.outcome);
        },
    );
    bench.finish();
}
