//! The program in the form that the method works on: groups of six stresses, each with planes of its own.

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
    /// Its planes, as a part of [`Problem::planes`].
    planes: (usize, usize),
    /// The first of the planes among those of all groups.
    pub first: usize,
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
        let mut planes: Vec<Plane> = program.facets.iter().map(|f| units.plane(f)).map(plane).collect();
        let facets = planes.len();
        planes.push(ROPE);
        let scale = units.stress().map(|s| s / units.force);
        let mut count = 0;
        let mut group = |rate: Vec<Term<Six>>, planes: (usize, usize)| {
            count += planes.1 - planes.0;
            Group { rate, planes, first: count + planes.0 - planes.1 }
        };
        let mut groups = Vec::with_capacity(program.places.len() + program.ropes.len());
        for place in program.places {
            let scaled = |rate: &Six| std::array::from_fn(|c| place.size * rate[c] * scale[c]);
            groups.push(group(place.rate.iter().map(|(v, rate)| (*v, scaled(rate))).collect(), (0, facets)));
        }
        for rope in program.ropes {
            let pull = |&(v, share): &Term<f64>| (v, [share, 0.0, 0.0, 0.0, 0.0, 0.0]);
            groups.push(group(rope.iter().map(pull).collect(), (facets, facets + 1)));
        }
        let load = |power: &[f64]| power.iter().map(|p| p / units.force).collect();
        Self { groups, planes, dead: load(program.dead), live: load(program.live), count }
    }

    /// The planes of a group.
    pub fn planes(&self, group: &Group) -> &[Plane] {
        &self.planes[group.planes.0..group.planes.1]
    }

    /// The bounds of all groups' planes.
    pub fn bounds(&self) -> impl Iterator<Item = f64> + '_ {
        self.groups.iter().flat_map(|g| self.planes(g)).map(|p| p.bound)
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
