//! Rigid bodies made of spheres, and a heap of them within fixed planes.

use crate::law::Frictional;
use crate::math::Vec3;
use crate::shape::{Ball, Plane};

/// A rigid body made of spheres: one sphere, or several that may overlap.
#[derive(Clone, Debug, PartialEq)]
pub struct Clump {
    /// Its spheres at rest, in world coordinates (m); at least one.
    pub spheres: Vec<Ball>,
    /// Density of what the spheres fill (kg/m^3); where several share a place it counts once.
    pub density: f64,
    /// What it is made of.
    pub material: Frictional,
}

/// Clumps within fixed planes. Axes: x along, y out of plane (the direction of a lateral load), z up (m).
#[derive(Clone, Debug, PartialEq)]
pub struct Heap {
    /// The clumps; a clump's id is its index.
    pub clumps: Vec<Clump>,
    /// Fixed planes, normals into the side where the clumps are.
    pub planes: Vec<Plane>,
    /// What the planes are made of.
    pub plane_material: Frictional,
}

impl Heap {
    /// Clumps of one density and one material on ground of the same material, the plane z = 0.
    pub fn on_ground(clumps: Vec<Vec<Ball>>, density: f64, material: Frictional) -> Heap {
        Heap {
            clumps: clumps.into_iter().map(|spheres| Clump { spheres, density, material }).collect(),
            planes: vec![Plane { normal: Vec3::z(), offset: 0.0 }],
            plane_material: material,
        }
    }
}
