//! Random walls whose collapse angle is known in closed form: blocks, rows, stacks, wedges, grooves, and a block that topples.
//!
//! What is never drawn, and why:
//! - joints that close by more than 1 % of the least size of a block under its load: the closed forms are those of rigid blocks
//!   on a thin bed, and a block that sinks that far changes the shape it slides on;
//! - sliding where the toppling angle on the elastic bed is nearer than 2 deg: the lesser of two nearly equal angles is
//!   neither, as the bed opens before it slides;
//! - stacks whose blocks lean by more than 0.006 deg on soft beds: the beds between them lean with them;
//! - wedges whose reaction would have to act outside the middle third of a flank: they roll out of their groove;
//! - walls that are within 1 deg of sliding at rest: they have no angle of their own;
//! - a stack that topples: its loss is that of all its beds, for which there is no closed form. A single block has one.
//!
//! A wedge that is tilted across its line of intersection begins to slide above its closed form. As the load turns it shears across
//! the line; friction keeps that in, and it wedges the block: one began at 17.744 deg and slid on at 17.649 deg, its closed form,
//! as its path showed. Such a wedge has to fall between its closed form and the bound of limit analysis.

use pirca::law::Coulomb;
use pirca::math::{Vec3, atan, atan2, cos, degrees, exp, ln, radians, sin, tan};
use pirca::model::{Block, Support, Tag, Wall};
use pirca::protocol::Direction;
use pirca::random::{Stream, Streams};
use pirca::shape::Polyhedron;

use crate::fixture::{G, dry, stone};

/// Density of all blocks (kg/m^3).
const DENSITY: f64 = 2000.0;

/// What is loaded, and what is to come out.
#[derive(Clone, Debug)]
pub struct Case {
    pub family: &'static str,
    pub wall: Wall,
    pub law: Coulomb,
    pub towards: Direction,
    pub step_deg: f64,
    /// Whether a horizontal force grows, to the tangent of the angle, instead of the tilt.
    pub lateral: bool,
    /// Angle of collapse (deg).
    pub right_deg: f64,
    /// Whether the closed form is only the angle at which it slides on once it slides, and limit analysis bounds that at which it
    /// begins to.
    pub begins_later: bool,
    /// How far (deg) an answer may lie from the closed form.
    pub within_deg: f64,
}

/// The bracket is 0.01 deg wide, and its lower end is the answer.
const WITHIN_DEG: f64 = 0.02;
/// The closed form of a block that topples over its bed leaves out terms of the second order in its turn (rad): where its shear acts
/// is known to the first. Largest in 200 walls is 0.23 times its square, of the angle.
const SECOND_ORDER: f64 = 0.3;

/// Draws a case; `None` where its closed form does not hold.
type Family = fn(&mut Draw) -> Option<Case>;

/// The families, and how many of 20 cases belong to each.
const FAMILIES: [(Family, usize); 7] =
    [(block, 5), (row, 3), (stack, 3), (wedge, 3), (turned_wedge, 1), (groove, 3), (toppling, 2)];

/// A random case, the same for the same member.
pub fn case(member: u64) -> Case {
    let mut place = member as usize % 20;
    let family = FAMILIES.iter().find(|(_, share)| {
        let found = place < *share;
        place = place.wrapping_sub(if found { 0 } else { *share });
        found
    });
    let (make, _) = family.expect("the shares add up to 20");
    let mut draw = Draw(Streams::new(33, member).of("case"));
    (0..10_000).find_map(|_| make(&mut draw)).expect("a case that has a closed form")
}

/// What a case is drawn from.
struct Draw(Stream);

impl Draw {
    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.uniform()
    }

    fn evenly_in_log(&mut self, low: f64, high: f64) -> f64 {
        exp(self.within(ln(low), ln(high)))
    }

    fn direction(&mut self) -> Direction {
        [Direction::XPlus, Direction::XMinus, Direction::YPlus, Direction::YMinus][self.0.below(4)]
    }

    /// A dry joint of any stiffness whose closure under a pressure (Pa) stays below 1 % of a length (m).
    fn law(&mut self, phi_deg: f64, pressure: f64, length: f64) -> Option<Coulomb> {
        let kn = self.evenly_in_log(1e6, 1e12);
        let ks = kn * self.within(0.1, 1.0);
        (pressure / kn < 0.01 * length).then_some(Coulomb { ks, ..dry(kn, phi_deg) })
    }

    fn case(&mut self, family: &'static str, blocks: Vec<Block>, law: Coulomb, right_deg: f64) -> Case {
        Case {
            family,
            wall: Wall { blocks },
            law,
            towards: self.direction(),
            step_deg: self.evenly_in_log(0.05, 2.0),
            lateral: self.0.below(6) == 0,
            right_deg,
            begins_later: false,
            within_deg: WITHIN_DEG,
        }
    }
}

fn fixed(shape: Polyhedron) -> Block {
    Block { support: Support::Fixed, tag: Tag::Base, ..stone(shape, DENSITY) }
}

/// A floor that is wide enough for a block that slides a metre to stay on it.
fn floor() -> Block {
    fixed(Polyhedron::cuboid(Vec3::new(-4.0, -4.0, -0.2), Vec3::new(4.0, 4.0, 0.0)))
}

/// The angle (deg) at which a block of width `b` and height `h` (m) topples over its elastic bed, by the closed form of
/// `tilting::closed_form`: the shear acts in the middle of the pressed width; and how far (rad) it has turned on the bed by then.
fn topples(b: f64, h: f64, kn: f64) -> (f64, f64) {
    let weight = DENSITY * G * b * h;
    let balance = |t: f64, a: f64| {
        let (n, slope) = (weight * cos(a), kn * sin(t));
        let c = (2.0 * n / slope).sqrt();
        let (ne, middle) =
            if c >= b { (slope * b * b * b / 12.0, 0.0) } else { (n * (b / 2.0 - c / 3.0), (b - c) / 2.0) };
        cos(t) * ne - sin(t) * weight * sin(a) * middle - weight * 0.5 * h * sin(a + t)
    };
    let largest_at = |t: f64| {
        let (mut low, mut high) = (0.0, atan(b / h) + 0.01);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if balance(t, middle) > 0.0 { low = middle } else { high = middle }
        }
        low
    };
    // Hill-shaped over the logarithm of t: thirds of the interval, until they are narrower than any angle that is asked for.
    let (mut low, mut high) = (ln(1e-9), ln(0.5));
    for _ in 0..80 {
        let (one, two) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if largest_at(exp(one)) < largest_at(exp(two)) { low = one } else { high = two }
    }
    (degrees(largest_at(exp(low))), exp(low))
}

/// A block on a plane slides at phi.
fn block(draw: &mut Draw) -> Option<Case> {
    let [a, b, h] = [draw.within(0.1, 0.8), draw.within(0.1, 0.8), draw.within(0.05, 0.3)];
    let phi = draw.within(8.0, 40.0);
    let law = draw.law(phi, DENSITY * G * h, h)?;
    (topples(a.min(b), h, kn(&law)).0 > phi + 2.0).then_some(())?;
    let shape = Polyhedron::cuboid(Vec3::new(-a / 2.0, -b / 2.0, 0.0), Vec3::new(a / 2.0, b / 2.0, h));
    Some(draw.case("block", vec![floor(), stone(shape, DENSITY)], law, phi))
}

/// Blocks that touch one another in a row on a plane slide together at phi: what they pass on to one another is internal.
fn row(draw: &mut Draw) -> Option<Case> {
    let (phi, width, along_x) = (draw.within(8.0, 40.0), draw.within(0.1, 0.6), draw.0.below(2) == 0);
    let count = 2 + draw.0.below(4);
    let sizes: Vec<[f64; 2]> = (0..count).map(|_| [draw.within(0.1, 0.5), draw.within(0.05, 0.3)]).collect();
    let highest = sizes.iter().map(|[_, h]| *h).fold(0.0, f64::max);
    let law = draw.law(phi, DENSITY * G * highest, 0.05)?;
    let stands = sizes.iter().all(|[l, h]| topples(l.min(width), *h, kn(&law)).0 > phi + 2.0);
    stands.then_some(())?;
    let mut blocks = vec![floor()];
    let mut at = -0.5 * sizes.iter().map(|[l, _]| l).sum::<f64>();
    for [length, height] in sizes {
        let (x, y) = ([at, at + length], [-width / 2.0, width / 2.0]);
        let (x, y) = if along_x { (x, y) } else { (y, x) };
        let shape = Polyhedron::cuboid(Vec3::new(x[0], y[0], 0.0), Vec3::new(x[1], y[1], height));
        blocks.push(stone(shape, DENSITY));
        at += length;
    }
    Some(draw.case("row", blocks, law, phi))
}

/// A stack of full-width blocks on beds that dip by random angles slides on the bed that dips most, at phi less its dip.
fn stack(draw: &mut Draw) -> Option<Case> {
    let (phi, count) = (draw.within(12.0, 40.0), 2 + draw.0.below(5));
    let [b, c] = [draw.within(0.2, 0.8), draw.within(0.2, 0.8)];
    let most = draw.within(0.0, 8.0);
    let dips: Vec<f64> = (0..count).map(|_| draw.within(-most, most)).collect();
    let heights: Vec<f64> = (0..count).map(|_| draw.within(0.08, 0.2)).collect();
    let (height, steepest) = (heights.iter().sum::<f64>(), dips.iter().copied().fold(-90.0, f64::max));
    let right = phi - steepest;
    let law = draw.law(phi, DENSITY * G * height, 0.08)?;
    // Softer than the stack is: all its beds under its base, and the dip of that added.
    let stands = topples(b, height, kn(&law) / count as f64).0 - most > right + 2.0;
    // Moment of a column of this height under the slope of its load, over the bed's rotational stiffness, for every bed.
    let pressure = DENSITY * G * height;
    let lean = count as f64 * 6.0 * pressure * height * tan(radians(right + most)) / (kn(&law) * b * b);
    (lean < 1e-4).then_some(())?;
    // Wedges between beds must not vanish at their thin end.
    (stands && right > 1.0 && 0.5 * b * tan(radians(most)) < 0.03).then_some(())?;
    let mut case = draw.case("stack", Vec::new(), law, right);
    let (down, across) = (case.towards.unit(), Vec3::z().cross(&case.towards.unit()));
    // The four corners of a bed, counter-clockwise seen from above, for a column of this half width and half depth.
    let bed = |z: f64, dip: f64, half: f64, side: f64| {
        let corner = |s: f64, t: f64| down * s + across * t + Vec3::z() * (z - s * tan(radians(dip)));
        [corner(-half, -side), corner(half, -side), corner(half, side), corner(-half, side)]
    };
    let prism = |low: [Vec3; 4], high: [Vec3; 4]| {
        let corner = |k: usize| if k < 4 { low[k] } else { high[k - 4] };
        Polyhedron::hexahedron(std::array::from_fn(corner))
    };
    let base = prism(bed(-1.0, 0.0, 2.0 * b, c), bed(0.0, dips[0], 2.0 * b, c));
    case.wall.blocks.push(fixed(base));
    let mut z = 0.0;
    for (k, h) in heights.iter().enumerate() {
        let above = dips.get(k + 1).copied().unwrap_or(0.0);
        let shape = prism(bed(z, dips[k], 0.5 * b, 0.5 * c), bed(z + h, above, 0.5 * b, 0.5 * c));
        case.wall.blocks.push(stone(shape, DENSITY));
        z += h;
    }
    Some(case)
}

/// A slender block topples over its elastic bed.
fn toppling(draw: &mut Draw) -> Option<Case> {
    let [b, c, h] = [draw.within(0.1, 0.3), draw.within(0.4, 1.0), draw.within(0.2, 0.6)];
    let law = draw.law(75.0, DENSITY * G * h, h)?;
    let (right, turn) = topples(b, h, kn(&law));
    // A bed that is too soft to bear the block upright, or a block that is hardly slender.
    (right > 3.0 && right < 45.0).then_some(())?;
    let mut case = draw.case("toppling", vec![floor()], law, right);
    case.lateral = false;
    case.within_deg = WITHIN_DEG + SECOND_ORDER * turn * turn * right;
    let half = case.towards.unit().map(|along| if along == 0.0 { c / 2.0 } else { b / 2.0 });
    let (low, high) = (Vec3::new(-half.x, -half.y, 0.0), Vec3::new(half.x, half.y, h));
    case.wall.blocks.push(stone(Polyhedron::cuboid(low, high), DENSITY));
    Some(case)
}

fn kn(law: &Coulomb) -> f64 {
    law.normal.first_stiffness()
}

/// A prism on two planes that meet in a line; its cross-section is a triangle that stands on its corner in the line.
struct Wedge {
    /// Down the line, across it to the right, and away from the groove.
    axes: [Vec3; 3],
    /// How steeply (rad) the right and the left flank rise from the line, in the cross-section.
    flanks: [f64; 2],
    /// Depth of the groove and length of the prism (m).
    depth: f64,
    length: f64,
}

impl Wedge {
    /// Right (+1) or left (-1) flank: the way up it in the cross-section, and its normal into the groove.
    fn flank(&self, side: usize) -> (Vec3, Vec3) {
        let ([_, across, away], sign) = (self.axes, [1.0, -1.0][side]);
        let (s, c) = (sin(self.flanks[side]), cos(self.flanks[side]));
        (across * (sign * c) + away * s, away * c - across * (sign * s))
    }

    /// Length of a flank in the cross-section.
    fn wide(&self, side: usize) -> f64 {
        self.depth / sin(self.flanks[side])
    }

    fn prism(section: &[Vec3], from: Vec3, to: Vec3) -> Polyhedron {
        let n = section.len() as u32;
        let vertices = [from, to].iter().flat_map(|end| section.iter().map(move |p| p + end)).collect();
        let sides = (0..n).map(|k| vec![(k + 1) % n, k, n + k, n + (k + 1) % n]);
        let ends = [(0..n).collect(), (n..2 * n).rev().collect()];
        Polyhedron { vertices, faces: ends.into_iter().chain(sides).collect() }
    }

    /// The prism between two slabs that reach 2 m beyond it on both sides.
    fn blocks(&self) -> Vec<Block> {
        let (down, half) = (self.axes[0], 0.5 * self.length);
        let mut blocks: Vec<Block> = (0..2)
            .map(|side| {
                let (up, normal) = self.flank(side);
                let end = up * (1.3 * self.wide(side));
                let thick = normal * -0.3;
                // Counter-clockwise seen from up the line.
                let mut section = [Vec3::zeros(), end, end + thick, thick];
                if side == 1 {
                    section.reverse();
                }
                fixed(Self::prism(&section, down * (-half - 2.0), down * (half + 2.0)))
            })
            .collect();
        let [right, left] = [0, 1].map(|side| self.flank(side).0 * self.wide(side));
        let shape = Self::prism(&[Vec3::zeros(), left, right], down * -half, down * half);
        blocks.push(stone(shape, DENSITY));
        blocks
    }

    /// Pressures on the right and the left flank under a load, as shares of it.
    fn normals(&self, load: &Vec3) -> [f64; 2] {
        let [(_, right), (_, left)] = [self.flank(0), self.flank(1)];
        // In the cross-section, N_r n_r + N_l n_l = - load.
        let down = self.axes[0];
        let det = right.cross(&left).dot(&down);
        [load.cross(&left).dot(&down) / -det, right.cross(load).dot(&down) / -det]
    }

    /// Whether the prism slides under a load: down the line on both flanks, or down one of them and off the other.
    fn slides(&self, load: &Vec3, mu: f64) -> bool {
        let on = self.normals(load);
        if on[0] >= 0.0 && on[1] >= 0.0 {
            return load.dot(&self.axes[0]).abs() >= mu * (on[0] + on[1]);
        }
        (0..2).any(|side| {
            let normal = self.flank(side).1;
            let pressure = -load.dot(&normal);
            on[side] > 0.0 && on[1 - side] < 0.0 && (load + normal * pressure).norm() >= mu * pressure
        }) || (on[0] <= 0.0 && on[1] <= 0.0)
    }

    /// Whether the reactions to a load can act within the middle third of the flanks that are pressed.
    fn is_held(&self, load: &Vec3) -> bool {
        let [_, across, away] = self.axes;
        let (on, wide) = (self.normals(load), [self.wide(0), self.wide(1)]);
        let centroid = [0, 1].map(|side| self.flank(side).0 * (wide[side] / 3.0)).iter().sum::<Vec3>();
        let weight = centroid.dot(&across) * load.dot(&away) - centroid.dot(&away) * load.dot(&across);
        // Both flanks have some of the load, or the reaction wanders along one that opens.
        if on[0].min(on[1]) < 0.1 * load.norm() {
            return false;
        }
        let (right, left) = (on[0] * wide[0], on[1] * wide[1]);
        let range = [right / 3.0 - left * 2.0 / 3.0, right * 2.0 / 3.0 - left / 3.0];
        (range[0]..range[1]).contains(&-weight)
    }
}

/// The load (as a share of the weight) at a tilt.
fn load(towards: Direction, tilt: f64) -> Vec3 {
    towards.unit() * sin(tilt) - Vec3::z() * cos(tilt)
}

/// A prism in a groove that plunges by `plunge` (rad) towards an azimuth, and slides at the first tilt at which it is not held.
fn in_groove(
    draw: &mut Draw,
    family: &'static str,
    towards: Direction,
    (azimuth, plunge): (f64, f64),
    flanks: [f64; 2],
) -> Option<Case> {
    let level = Vec3::new(cos(azimuth), sin(azimuth), 0.0);
    let down = level * cos(plunge) - Vec3::z() * sin(plunge);
    let away = level * sin(plunge) + Vec3::z() * cos(plunge);
    let depth = draw.within(0.1, 0.3);
    let length = draw.within(2.0, 4.0) * depth * (1.0 / tan(flanks[0]) + 1.0 / tan(flanks[1])).max(1.0);
    let wedge = Wedge { axes: [down, away.cross(&down), away], flanks, depth, length };
    let phi = draw.within(8.0, 40.0);
    let law = draw.law(phi, DENSITY * G * depth, 0.1)?;
    let slides = |deg: f64| wedge.slides(&load(towards, radians(deg)), tan(radians(phi)));
    let first = (0..1600).map(|k| 0.05 * f64::from(k)).find(|&deg| slides(deg)).filter(|deg| *deg > 1.0)?;
    let (mut low, mut high) = (first - 0.05, first);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if slides(middle) { high = middle } else { low = middle }
    }
    let held = (0..=10).all(|k| wedge.is_held(&load(towards, radians(low) * 0.1 * f64::from(k))));
    held.then(|| Case { towards, ..draw.case(family, wedge.blocks(), law, low) })
}

/// A wedge on two planes of any dip that meet in a line along the load.
fn wedge(draw: &mut Draw) -> Option<Case> {
    let towards = draw.direction();
    let line = (azimuth(towards), radians(draw.within(-5.0, 30.0)));
    let flanks = [radians(draw.within(15.0, 70.0)), radians(draw.within(15.0, 70.0))];
    let mut case = in_groove(draw, "wedge", towards, line, flanks)?;
    // Soft in shear: flanks of unlike dip close unlike, and shear across the line by that.
    case.law.ks *= 0.1;
    Some(case)
}

/// A wedge on two planes of any dip that meet in any line.
fn turned_wedge(draw: &mut Draw) -> Option<Case> {
    let towards = draw.direction();
    let line = (radians(draw.within(0.0, 360.0)), radians(draw.within(0.0, 35.0)));
    let flanks = [radians(draw.within(15.0, 70.0)), radians(draw.within(15.0, 70.0))];
    let case = in_groove(draw, "turned wedge", towards, line, flanks)?;
    Some(Case { begins_later: true, ..case })
}

/// The azimuth (rad) of a direction.
fn azimuth(towards: Direction) -> f64 {
    atan2(towards.unit().y, towards.unit().x)
}

/// A groove of even flanks along the load: slides at tan(tilt) = tan(phi) / sin(half angle) less its plunge.
fn groove(draw: &mut Draw) -> Option<Case> {
    let towards = draw.direction();
    let line = (azimuth(towards), radians(draw.within(-5.0, 20.0)));
    let flank = radians(draw.within(20.0, 65.0));
    let case = in_groove(draw, "groove", towards, line, [flank, flank])?;
    let half = radians(90.0) - flank;
    let known = degrees(atan(case.law.tan_phi / sin(half)) - line.1);
    assert!((case.right_deg - known).abs() < 1e-6, "{} against {known}", case.right_deg);
    Some(case)
}
