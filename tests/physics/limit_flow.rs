//! Limit analysis without dilatancy, against the associative answer and by hand.

use pirca::generate::canonical;
use pirca::law::Coulomb;
use pirca::math::Vec3;
use pirca::solve::limit::{Cone, Flow, Limit, Loads, Settings};

use crate::fixture::dry;
use crate::limit_known::{analysis, ferris_tin_loi, with};

#[test]
fn explore() {
    for (courses, mu) in [(6, 0.65), (10, 0.65), (6, 0.4), (10, 0.4), (6, 0.3)] {
        let law = Coulomb { tan_phi: mu, ..dry(1e9, 30.0) };
        let wall = ferris_tin_loi(courses);
        for cone in [Cone::SecondOrder, Cone::Linearised { sides: 8 }] {
            let a = analysis(&wall, &law, with(cone)).multiplier(&Loads::lateral(Vec3::x()));
            let t = std::time::Instant::now();
            let n = analysis(&wall, &law, Settings { flow: Flow::NonAssociative, ..with(cone) })
                .multiplier(&Loads::lateral(Vec3::x()));
            println!(
                "{courses} {mu} {cone:?}: assoc {:.6} non {:.6} {:?} {:?} {:?}",
                a.multiplier,
                n.multiplier,
                n.outcome.reason(),
                n.fixed_point,
                t.elapsed()
            );
        }
    }
    for mu in [0.65, 0.4, 0.3, 0.25] {
        let law = Coulomb { tan_phi: mu, ..dry(1e9, 30.0) };
        let wall = canonical::wall_72().with_base();
        for d in [Vec3::x(), Vec3::y()] {
            let a = analysis(&wall, &law, Settings::default()).tilt(d, &[]);
            let t = std::time::Instant::now();
            let n = analysis(&wall, &law, Settings { flow: Flow::NonAssociative, ..Settings::default() })
                .tilt(d, &[]);
            println!(
                "72 {mu} {d:?}: assoc {:.6} non {:.6} {:?} {:?} {:?}",
                a.multiplier,
                n.multiplier,
                n.outcome.reason(),
                n.fixed_point,
                t.elapsed()
            );
        }
    }
}
