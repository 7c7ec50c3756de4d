//! The program in the form that the method works on: groups of six stresses, each with planes of its own, one after another.

use crate::homogenise::plate::motion::Term;
use crate::homogenise::plate::program::Program;

/// Six stress resultants, or six rates.
pub(super) type Six = [f64; 6];

/// A facet in the program's units.
#[derive(Clone, Copy)]
pub(super) struct Plane {
    pub normal: Six,
    pub bound: f64,
}

/// The plane of a rope, which pulls or is slack; its force is the first of six stresses, and the others are nothing.
const ROPE: Plane = Plane { normal: [-1.0, 0.0, 0.0, 0.0, 0.0, 0.0], bound: 0.0 };

/// Stresses that share their planes.
pub(super) struct Group {
    /// Their rates from the velocities.
    pub rate: Vec<Term<Six>>,
    /// The first of its planes among those of all groups, and how many it has.
    pub first: usize,
    planes: usize,
}

/// The program.
pub(super) struct Problem {
    pub groups: Vec<Group>,
    planes: Vec<Plane>,
    pub dead: Vec<f64>,
    pub live: Vec<f64>,
    /// Planes of all groups together.
    pub count: usize,
}

impl Problem {
    pub fn of(program: &Program) -> Self {
        let units = program.units;
        let facets: Vec<Plane> = program.facets.iter().map(|f| units.plane(f)).map(plane).collect();
        let scale = units.stress().map(|s| s / units.force);
        let mut planes = Vec::new();
        let mut groups = Vec::with_capacity(program.places.len() + program.ropes.len());
        for (place, own) in program.places.iter().zip(program.own) {
            let scaled = |rate: &Six| std::array::from_fn(|c| place.size * rate[c] * scale[c]);
            let rate = place.rate.iter().map(|(v, rate)| (*v, scaled(rate))).collect();
            groups.push(Group { rate, first: planes.len(), planes: own.len() });
            planes.extend(own.iter().map(|&facet| facets[facet]));
        }
        for rope in program.ropes {
            let pull = |&(v, share): &Term<f64>| (v, [share, 0.0, 0.0, 0.0, 0.0, 0.0]);
            groups.push(Group { rate: rope.iter().map(pull).collect(), first: planes.len(), planes: 1 });
            planes.push(ROPE);
        }
        let load = |power: &[f64]| power.iter().map(|p| p / units.force).collect();
        let (dead, live) = (load(program.dead), load(program.live));
        Self { groups, count: planes.len(), planes, dead, live }
    }

    /// The planes of a group.
    pub fn planes(&self, group: &Group) -> &[Plane] {
        &self.planes[group.first..group.first + group.planes]
    }

    /// The bounds of all groups' planes.
    pub fn bounds(&self) -> impl Iterator<Item = f64> + '_ {
        self.planes.iter().map(|p| p.bound)
    }

    /// What stresses do to the velocities.
    pub fn forces(&self, stresses: &[Six]) -> Vec<f64> {
        let mut forces = vec![0.0; self.dead.len()];
        for (group, stress) in self.groups.iter().zip(stresses) {
            for (velocity, rate) in &group.rate {
                forces[*velocity] += dot(rate, stress);
            }
        }
        forces
    }

    /// Rates of the groups.
    pub fn rates(&self, velocities: &[f64]) -> Vec<Six> {
        let of = |group: &Group| {
            let mut sum = [0.0; 6];
            for (velocity, rate) in &group.rate {
                add(&mut sum, rate, velocities[*velocity]);
            }
            sum
        };
        self.groups.iter().map(of).collect()
    }

    /// How far stresses reach along the normals of all planes.
    pub fn reaches(&self, stresses: &[Six]) -> Vec<f64> {
        let mut reaches = Vec::with_capacity(self.count);
        for (group, stress) in self.groups.iter().zip(stresses) {
            reaches.extend(self.planes(group).iter().map(|p| dot(&p.normal, stress)));
        }
        reaches
    }

    /// Sums of the planes' normals by group, each times its weight.
    pub fn flows(&self, weights: &[f64]) -> Vec<Six> {
        let of = |group: &Group| {
            let mut sum = [0.0; 6];
            for (plane, weight) in self.planes(group).iter().zip(&weights[group.first..]) {
                add(&mut sum, &plane.normal, *weight);
            }
            sum
        };
        self.groups.iter().map(of).collect()
    }
}

fn plane((normal, bound): (Six, f64)) -> Plane {
    Plane { normal, bound }
}

pub(super) fn dot(a: &Six, b: &Six) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] + a[4] * b[4] + a[5] * b[5]
}

fn add(sum: &mut Six, what: &Six, times: f64) {
    sum.iter_mut().zip(what).for_each(|(s, w)| *s += w * times);
}
