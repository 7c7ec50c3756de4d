//! Joints of hollow clumps: two beds of balls pressed and sheared, against closed forms.

use crate::led_clump::{Slid, Slide, slide};
use crate::regular_rows::RegularRows;
use pirca::law::Frictional;
use pirca::math::{Vec3, degrees, radians};
use pirca::model::{Clump, Heap, Hollow, Support};
use pirca::shape::{Polyhedron, Rows};
use pirca::solve::{STANDARD_GRAVITY as G, Status, grains};

const DENSITY: f64 = 2400.0;
const KS_OVER_KN: f64 = 0.5;
/// Rows and distances of the upper bed along x and across.
const LONG: u32 = 4;
const BROAD: u32 = 2;

/// Two beds of balls: the lower one fixed, the upper one on it by its balls' places.
pub struct Beds {
    pub rows: RegularRows,
    pub model: Hollow,
    /// How far behind the crests it stands along x, as a share of the spacing: 0 on them, 0.5 in the hollows.
    pub offset: f64,
    /// Closure of one ball on one ball (m) under the weight, shared by the balls of the upper bed.
    pub closure: f64,
}

impl Beds {
    fn balls(&self) -> f64 {
        match self.model {
            Hollow::Plane => f64::from(LONG + 1),
            Hollow::Space => f64::from((LONG + 1) * (BROAD + 1)),
        }
    }

    /// A stone around a grid of centres that begins at a corner.
    fn stone(&self, corner: Vec3, long: u32, broad: u32) -> Polyhedron {
        let RegularRows { radius, spacing, .. } = self.rows;
        let grid = Vec3::new(f64::from(long), f64::from(broad), 2.0) * spacing;
        Polyhedron::cuboid(corner.add_scalar(-radius), (corner + grid).add_scalar(radius))
    }

    fn heap(&self) -> Heap {
        let RegularRows { radius, spacing, between, phi } = self.rows;
        let x = spacing * (1.0 + self.offset);
        let across = match self.model {
            Hollow::Plane => 0.0,
            Hollow::Space => spacing * if between { 1.5 } else { 1.0 },
        };
        let broad = if self.model == Hollow::Space { BROAD + 2 } else { BROAD };
        // Below, centres begin at the origin and end at a height of twice the spacing.
        let lower = self.stone(Vec3::zeros(), LONG + 6, broad);
        let z = 2.0 * spacing + self.rows.height(self.offset * spacing);
        let upper = self.stone(Vec3::new(x, across, z), LONG, BROAD);
        let weight = upper.volume() * DENSITY * G;
        let young = weight / (self.balls() * self.closure * radius);
        let material = Frictional { young, ks_over_kn: KS_OVER_KN, phi };
        let rows = Rows { radius, spacing, phase: 0.0 };
        let hollow = |solid: &Polyhedron| Clump::hollow(solid, DENSITY, self.model, &rows, material).unwrap();
        let clumps = vec![Clump { support: Support::Fixed, ..hollow(&lower) }, hollow(&upper)];
        Heap { clumps, planes: Vec::new(), plane_material: material }
    }

    /// Led over `spacings`, with a hundred readings to each.
    pub fn slid(&self, spacings: u32) -> Slid {
        let speed = 0.02 * (G * self.closure).sqrt();
        let readings = 100 * spacings;
        let way = self.rows.spacing * f64::from(spacings);
        slide(
            &self.heap(),
            grains::Settings::default(),
            &Slide { body: 1, speed, way, readings, rest_ratio: 1e-7 },
        )
    }

    /// The place of a reading as a way behind a crest (m).
    pub fn behind_a_crest(&self, way: f64) -> f64 {
        way + self.offset * self.rows.spacing
    }
}

pub fn rows(radius: f64, spacing: f64, between: bool, phi_deg: f64) -> RegularRows {
    RegularRows { radius, spacing, between, phi: radians(phi_deg) }
}

#[test]
fn pressed_beds_close_as_their_contacts_say() {
    for (model, between, in_hollow) in [
        (Hollow::Plane, false, false),
        (Hollow::Plane, false, true),
        (Hollow::Space, false, false),
        (Hollow::Space, false, true),
        (Hollow::Space, true, false),
        (Hollow::Space, true, true),
    ] {
        let rows = rows(0.01, 0.02, between, 40.0);
        let offset = if in_hollow { 0.5 } else { 0.0 };
        let beds = Beds { rows, model, offset, closure: 1e-7 };
        let slid = beds.slid(0);
        assert_eq!(slid.rest, Status::Equilibrium);
        let expected = beds.closure / rows.stiffening(in_hollow, KS_OVER_KN);
        println!(
            "{model:?}, between {between}, hollow {in_hollow}: {:.4e}, closed form {expected:.4e}",
            slid.sunk
        );
        // The angle of a contact changes with the closure by some 1e-5; rest is to 1e-7 of the weight.
        assert!((slid.sunk / expected - 1.0).abs() < 1e-4, "{:e} against {expected:e}", slid.sunk);
    }
}

#[test]
fn a_joint_of_hollow_clumps_has_the_kn_it_was_mapped_from() {
    // A stone of 0.2 x 0.12 m in balls of 10 mm: 10 x 6 of them, ball on ball. Each stands for a mesh of 20 x 20 mm.
    let (kn, radius, spacing) = (5e7, 0.01, 0.02);
    let material = Frictional::for_joint(kn, KS_OVER_KN, radians(30.0), radius, 1.0 / (spacing * spacing));
    let stone = |z: f64| Polyhedron::cuboid(Vec3::new(0.0, 0.0, z), Vec3::new(0.2, 0.12, z + 0.06));
    let rows = Rows { radius, spacing, phase: 0.0 };
    let hollow = |z: f64| Clump::hollow(&stone(z), DENSITY, Hollow::Space, &rows, material).unwrap();
    let clumps = vec![Clump { support: Support::Fixed, ..hollow(0.0) }, hollow(0.06)];
    let heap = Heap { clumps, planes: Vec::new(), plane_material: material };
    let still = Slide { body: 1, speed: 1.0, way: 0.0, readings: 0, rest_ratio: 1e-9 };
    let sunk = slide(&heap, grains::Settings::default(), &still).sunk;
    // The joint of a polyhedron: weight over kn times area, which is that of the meshes.
    let expected = 0.06 * DENSITY * G / kn;
    println!("{sunk:e} against {expected:e}");
    assert!((sunk / expected - 1.0).abs() < 1e-6, "{sunk:e} against {expected:e}");
}

/// Compares every reading with the closed form.
fn compare(beds: &Beds) {
    let slid = beds.slid(3);
    assert_eq!(slid.rest, Status::Equilibrium);
    let rows = beds.rows;
    let step = rows.spacing / 100.0;
    let rest = rows.height(beds.behind_a_crest(0.0));
    let (mut worst, mut highest) = (0.0f64, 0.0f64);
    for reading in &slid.readings[1..] {
        let at = beds.behind_a_crest(reading.way);
        // A reading across a hollow is a mean of up and down.
        if (at / rows.spacing - 0.5 - (at / rows.spacing - 0.5).round()).abs() * rows.spacing < step {
            continue;
        }
        let off = (reading.ratio / rows.ratio(at) - 1.0).abs().min((reading.ratio - rows.ratio(at)).abs());
        worst = worst.max(off);
        highest = highest.max((reading.rise - (rows.height(at) - rest)).abs() / rows.rise());
    }
    let mean = slid.mean_from(0.0);
    println!(
        "{:?}, offset {}: peak {:.4} of {:.4}, mean {mean:.4} of {:.4}, dilatancy {:.2} of {:.2} deg, rise {:.4e} of {:.4e}, \
         worst reading {worst:.1e}, worst height {highest:.1e}; {} steps",
        beds.rows,
        beds.offset,
        slid.peak(),
        rows.peak(),
        rows.mean(),
        degrees(slid.dilatancy()),
        degrees(rows.steepest()),
        slid.rise(),
        rows.rise(),
        slid.steps
    );
    // It is led at a fiftieth of sqrt(g d): up to 1 % (see Slide::speed).
    assert!(worst < 0.015, "{worst}");
    // Springs give by some closures, each 4e-3 of the rise.
    assert!(highest < 0.01, "{highest}");
    // A reading is a mean over 1 % of a spacing, on which the ratio falls by 2 %, and in the first one the load comes on.
    assert!((slid.peak() / rows.peak() - 1.0).abs() < 0.025, "{} against {}", slid.peak(), rows.peak());
    assert!((mean / rows.mean() - 1.0).abs() < 0.01, "{mean} against {}", rows.mean());
    // Between the first two readings it has gone one of them.
    assert!((slid.dilatancy() - rows.slope(step - 0.5 * rows.spacing)).abs() < radians(0.1));
    assert!((slid.rise() / rows.rise() - 1.0).abs() < 0.02);
}

#[test]
fn rows_on_rows_slip_as_the_closed_form_says() {
    for offset in [0.0, 0.25, 0.5] {
        compare(&Beds { rows: rows(0.01, 0.02, false, 25.0), model: Hollow::Plane, offset, closure: 1e-5 });
    }
}

#[test]
fn balls_in_pockets_slip_over_the_saddles_between_them() {
    compare(&Beds { rows: rows(0.01, 0.016, true, 25.0), model: Hollow::Space, offset: 0.5, closure: 1e-5 });
}
