//! Limit analysis without dilatancy: against the associative answer, and against a closed form in which they differ.

use pirca::generate::canonical;
use pirca::law::Coulomb;
use pirca::math::{Vec3, atan, degrees};
use pirca::model::{Outcome, Support};
use pirca::shape::Polyhedron;
use pirca::solve::limit::{Flow, Limit, Loads, Settings};

use crate::fixture::{dry, on_floor, resting, stone};
use crate::limit_known::{CONES, analysis, collapse, ferris_tin_loi, with};

fn without_dilatancy(settings: Settings) -> Settings {
    Settings { flow: Flow::NonAssociative, ..settings }
}

/// The multiplier of a state without dilatancy that was found.
fn found(limit: &Limit) -> f64 {
    let search = limit.fixed_point.unwrap_or_else(|| panic!("no search: {:?}", limit.outcome));
    assert!(
        search.converged && matches!(limit.outcome, Outcome::Collapsed { .. }),
        "{:?} {search:?}",
        limit.outcome
    );
    assert_eq!(limit.flow, Flow::NonAssociative);
    limit.multiplier
}

#[test]
fn a_single_block_slides_and_topples_alike_with_and_without_dilatancy() {
    for (size, mu) in [([0.3, 0.4, 0.1], 0.5), ([0.3, 0.2, 0.5], 0.7)] {
        let law = Coulomb { tan_phi: mu, ..dry(1e9, 30.0) };
        let wall = on_floor(vec![resting(size, 2000.0)]);
        for cone in CONES {
            let lambda = found(
                &analysis(&wall, &law, without_dilatancy(with(cone))).multiplier(&Loads::lateral(Vec3::y())),
            );
            // Isostatic up to the shares of the corners: what is left is the search's own accuracy of 1e-5.
            assert!((lambda - f64::min(mu, size[1] / size[2])).abs() < 1e-5, "{size:?} {cone:?}: {lambda}");
        }
    }
}

#[test]
fn dilatancy_jams_a_block_between_two_planes() {
    // A block that just touches a fixed slab above cannot rise, so it cannot slide and dilate: nothing moves it. Nor is there
    // then a collapse from which to look for one without dilatancy.
    let mut slab = stone(Polyhedron::cuboid(Vec3::new(-1.0, -1.0, 0.2), Vec3::new(1.0, 1.0, 0.4)), 2000.0);
    slab.support = Support::Fixed;
    let jammed = on_floor(vec![resting([0.4, 0.4, 0.2], 2000.0), slab]);
    let alone = on_floor(vec![resting([0.4, 0.4, 0.2], 2000.0)]);
    let law = dry(1e9, 30.0);
    for cone in CONES {
        for settings in [with(cone), without_dilatancy(with(cone))] {
            let limit = analysis(&jammed, &law, settings).multiplier(&Loads::lateral(Vec3::x()));
            assert_eq!((limit.outcome, limit.fixed_point), (Outcome::Unbounded, None));
        }
        let free = analysis(&alone, &law, with(cone)).multiplier(&Loads::lateral(Vec3::x()));
        assert!((collapse(&free) - law.tan_phi).abs() < 1e-8);
    }
}

#[test]
fn without_dilatancy_a_wall_never_bears_more() {
    // A state at rest obeys Coulomb's law, so its multiplier is one of the associative problem's; the search's accuracy is
    // 1e-5. In wall_72 tilted out of plane nothing slips before it topples at 0.304, and the two are equal.
    let mut differed = 0;
    for courses in [6, 10] {
        let wall = ferris_tin_loi(courses);
        let law = Coulomb { tan_phi: 0.65, ..dry(1e9, 30.0) };
        for cone in CONES {
            let lateral = Loads::lateral(Vec3::x());
            let most = collapse(&analysis(&wall, &law, with(cone)).multiplier(&lateral));
            let limit = analysis(&wall, &law, without_dilatancy(with(cone))).multiplier(&lateral);
            let lambda = found(&limit);
            println!("{courses} courses {cone:?}: {lambda:.5} of {most:.5}, {:?}", limit.fixed_point);
            assert!(lambda < most * (1.0 + 1e-5), "{lambda} of {most}");
            assert!(lambda > 0.9 * most, "{lambda} of {most}");
            differed += u32::from(lambda < most * 0.999);
        }
    }
    assert!(differed >= 2, "a search that always gives the associative answer shows nothing");
    let wall = canonical::wall_72().with_base();
    let settings = without_dilatancy(Settings::default());
    let angle = degrees(atan(found(&analysis(&wall, &dry(1e9, 40.0), settings).tilt(Vec3::y(), &[]))));
    assert!((angle - degrees(atan(0.114 / 0.375))).abs() < 1e-4, "{angle}");
}

#[test]
fn a_sliding_block_rises_only_with_dilatancy() {
    let wall = on_floor(vec![resting([0.4, 0.4, 0.1], 2000.0)]);
    let law = dry(1e9, 25.0);
    for (flow, rise) in [(Flow::Associative, law.tan_phi), (Flow::NonAssociative, 0.0)] {
        let settings = Settings { flow, ..Settings::default() };
        let limit = analysis(&wall, &law, settings).multiplier(&Loads::lateral(Vec3::y()));
        let motion = limit.mechanism[0];
        let along = motion.velocity.y;
        assert!(along > 0.1, "{motion:?}");
        assert!(
            (motion.velocity.z - rise * along).abs() < 1e-6 && motion.velocity.x.abs() < 1e-6,
            "{motion:?}"
        );
        // No spin: 0.2 m away it would be felt as 1e-6 of the velocity.
        assert!(motion.spin.norm() < 5e-6, "{motion:?}");
    }
}
