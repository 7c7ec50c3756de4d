//! Ties: springs from points of bodies to the surroundings, as ropes across the face of a wall are, or jacks that push it.

use crate::math::Vec3;
use crate::solve::bodies::Body;

/// A spring that does not let a point of a body go in one fixed direction.
///
/// With `u` the displacement of the point along the direction since it was built, less the travel of the tie's other end, it
/// pulls against the direction with
///
/// ```text
/// T = max(0, T0 + k (u - slack))                        one that only pulls
/// T = T0 + k (u - u clamped to [-slack, slack])         one that pushes as well, beyond the slack on either side
/// ```
///
/// It remembers nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tie {
    /// The body that it holds.
    pub body: usize,
    /// Where it is fixed to the body, as built (m).
    pub point: Vec3,
    /// Unit vector of the direction.
    pub direction: Vec3,
    /// Stiffness `k` (N/m).
    pub stiffness: f64,
    /// Force `T0` (N) as built, without slack.
    pub pretension: f64,
    /// Displacement (m) before it resists, at least 0.
    pub slack: f64,
    /// Whether it also pushes.
    pub two_sided: bool,
    /// How far (m) its other end goes along the direction at load factor 1: a jack. 0 for what is fixed to the surroundings.
    pub travel: f64,
}

/// Derivatives of a tie's force and moment, see [`Held::stiffness`].
pub type Stiffness = [[f64; 6]; 6];

/// A tie fixed to its body.
#[derive(Clone, Copy, Debug)]
pub struct Held {
    /// As built.
    pub tie: Tie,
    /// Where it is fixed, in the body's axes from its centroid (m).
    lever: Vec3,
}

impl Tie {
    /// The pull (N), and its slope (N/m), at a displacement (m) of the point.
    pub fn pull(&self, u: f64) -> (f64, f64) {
        if self.two_sided {
            let beyond = u - u.clamp(-self.slack, self.slack);
            let rattles = beyond == 0.0 && self.slack > 0.0;
            return (self.pretension + self.stiffness * beyond, if rattles { 0.0 } else { self.stiffness });
        }
        let pull = self.pretension + self.stiffness * (u - self.slack);
        if pull > 0.0 { (pull, self.stiffness) } else { (0.0, 0.0) }
    }
}

impl Held {
    /// A tie on a body that is where the tie was built.
    pub fn new(tie: Tie, body: &Body) -> Held {
        Held { tie, lever: body.rotation.tr_mul(&(tie.point - body.position)) }
    }

    /// The point's lever from the body's centroid (m, world axes), and its displacement along the direction from where the
    /// other end is at a load factor (m).
    fn place(&self, body: &Body, load_factor: f64) -> (Vec3, f64) {
        let lever = body.rotation * self.lever;
        let moved = (body.position + lever - self.tie.point).dot(&self.tie.direction);
        (lever, moved - self.tie.travel * load_factor)
    }

    /// Size of its force now (N); negative where it pushes.
    pub fn force(&self, body: &Body, load_factor: f64) -> f64 {
        self.tie.pull(self.place(body, load_factor).1).0
    }

    /// Displacement (m) of its point along the direction since it was built.
    pub fn displacement(&self, body: &Body) -> f64 {
        self.place(body, 0.0).1
    }

    /// Adds its force to its body.
    pub fn apply(&self, body: &mut Body, load_factor: f64) {
        let (lever, u) = self.place(body, load_factor);
        let force = self.tie.direction * -self.tie.pull(u).0;
        body.force += force;
        body.torque += lever.cross(&force);
    }

    /// By what each component of the body's displacement and turn stretches it, and its slope (N/m).
    pub fn stretch(&self, body: &Body, load_factor: f64) -> ([f64; 6], f64) {
        let (lever, u) = self.place(body, load_factor);
        let (direction, turn) = (self.tie.direction, lever.cross(&self.tie.direction));
        let row = [direction.x, direction.y, direction.z, turn.x, turn.y, turn.z];
        (row, self.tie.pull(u).1)
    }

    /// The negative derivatives of force and moment on the body (rows) with respect to its displacement and turn (rad,
    /// world axes; columns), with the change of the moment arm: `d(r x F) = (w x r) x F + r x dF`.
    pub fn stiffness(&self, body: &Body, load_factor: f64) -> Stiffness {
        let (lever, u) = self.place(body, load_factor);
        let (pull, slope) = self.tie.pull(u);
        let (direction, force) = (self.tie.direction, self.tie.direction * -pull);
        let column = |shift: Vec3, turn: Vec3| {
            let moved = turn.cross(&lever);
            let d_force = direction * (-slope * (shift + moved).dot(&direction));
            (d_force, moved.cross(&force) + lever.cross(&d_force))
        };
        let columns: [(Vec3, Vec3); 6] = std::array::from_fn(|k| match k {
            0..3 => column(Vec3::ith(k, 1.0), Vec3::zeros()),
            _ => column(Vec3::zeros(), Vec3::ith(k - 3, 1.0)),
        });
        std::array::from_fn(|row| {
            std::array::from_fn(|k| match row {
                0..3 => -columns[k].0[row],
                _ => -columns[k].1[row - 3],
            })
        })
    }

    /// Where it acts and which way, in the body's axes: lever (m) and unit vector.
    pub fn own(&self, body: &Body) -> (Vec3, Vec3) {
        (self.lever, body.rotation.tr_mul(&self.tie.direction))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Block, Wall};
    use crate::shape::Polyhedron;
    use crate::solve::bodies::Bodies;

    const ROPE: Tie = Tie {
        body: 0,
        point: Vec3::new(0.35, 0.3, 0.02),
        direction: Vec3::new(0.0, 1.0, 0.0),
        stiffness: 1e6,
        pretension: 300.0,
        slack: 0.0,
        two_sided: false,
        travel: 0.0,
    };

    #[test]
    fn it_pulls_beyond_its_slack_and_pushes_only_if_it_can() {
        let slack = Tie { slack: 1e-3, ..ROPE };
        assert_eq!(ROPE.pull(1e-3), (1300.0, 1e6));
        assert_eq!(ROPE.pull(-1e-3), (0.0, 0.0));
        assert_eq!(Tie { two_sided: true, ..ROPE }.pull(-1e-3), (-700.0, 1e6));
        // Its pretension is used up by the slack.
        assert_eq!(slack.pull(5e-4), (0.0, 0.0));
        assert_eq!(slack.pull(1e-3), (300.0, 1e6));
        let strut = Tie { two_sided: true, pretension: 0.0, ..slack };
        assert_eq!(
            [-3e-3, -1e-3, 0.0, 1e-3].map(|u| strut.pull(u)),
            [(-2000.0, 1e6), (0.0, 0.0), (0.0, 0.0), (0.0, 0.0)]
        );
        assert_eq!(strut.pull(3e-3), (2000.0, 1e6));
    }

    #[test]
    fn a_jack_pushes_as_far_as_its_other_end_goes() {
        let block = Block::stone(Polyhedron::cuboid(Vec3::zeros(), Vec3::new(0.4, 0.3, 0.1)), 2400.0);
        let mut body = Bodies::from_wall(&Wall { blocks: vec![block] }).all.remove(0);
        let jack = Tie { travel: 2.0, two_sided: true, pretension: 0.0, ..ROPE };
        let held = Held::new(jack, &body);
        body.position += Vec3::new(0.0, 3e-3, 0.0);
        // Its other end has gone 2 m x 0.002 = 4 mm, its point 3 mm.
        assert!((held.force(&body, 2e-3) + 1000.0).abs() < 1e-6, "{}", held.force(&body, 2e-3));
        assert!((held.displacement(&body) - 3e-3).abs() < 1e-12);
        held.apply(&mut body, 2e-3);
        assert!((body.force.y - 1000.0).abs() < 1e-6);
    }

    #[test]
    fn its_stiffness_is_that_of_central_differences() {
        let shape = Polyhedron::cuboid(Vec3::zeros(), Vec3::new(0.4, 0.3, 0.1));
        let block = Block::stone(shape, 2400.0);
        let mut body = Bodies::from_wall(&Wall { blocks: vec![block] }).all.remove(0);
        let here = body.clone();
        body.place(&here, &Vec3::new(1e-3, 2e-3, -1e-3), &Vec3::new(0.02, -0.03, 0.05));
        // Its lever has turned away from where it was built, and the pull is large: the arm matters.
        let held = Held::new(Tie { pretension: 5e4, ..ROPE }, &here);
        let at = |k: usize, h: f64| {
            let mut moved = body.clone();
            let step = Vec3::ith(k % 3, h);
            let (shift, turn) = if k < 3 { (step, Vec3::zeros()) } else { (Vec3::zeros(), step) };
            moved.place(&body, &shift, &turn);
            (moved.force, moved.torque) = (Vec3::zeros(), Vec3::zeros());
            held.apply(&mut moved, 1.0);
            [moved.force.x, moved.force.y, moved.force.z, moved.torque.x, moved.torque.y, moved.torque.z]
        };
        let stiffness = held.stiffness(&body, 1.0);
        let differences: Vec<_> = (0..6).map(|column| (at(column, 1e-5), at(column, -1e-5))).collect();
        for (row, entries) in stiffness.iter().enumerate() {
            for (column, (entry, (plus, minus))) in entries.iter().zip(&differences).enumerate() {
                let exact = -(plus[row] - minus[row]) / 2e-5;
                // Third differences of the turn, 1e-10, and the rounding of 5e4 N over 1e-5.
                assert!((entry - exact).abs() < 1e-2, "{row} {column}: {exact}");
            }
        }
        // Beyond the pull's own stiffness the arm's share is there to be seen: F . r = 5e4 x 0.15.
        assert!((stiffness[5][5] - stiffness[3][3]).abs() > 1e3);
    }
}
