//! Rigid bodies made of spheres, and a heap of them within fixed planes.

use crate::law::Frictional;
use crate::math::Vec3;
use crate::model::{Block, Support, Wall};
use crate::shape::{Ball, MassProperties, OutlineFault, Plane, Polyhedron, Rows, union_of_balls};

/// A rigid body made of spheres: one sphere, or several that may overlap.
#[derive(Clone, Debug, PartialEq)]
pub struct Clump {
    /// Its spheres at rest, in world coordinates (m); at least one, unless the body has the mass of a solid.
    pub spheres: Vec<Ball>,
    /// What its mass is that of.
    pub filling: Filling,
    /// Density of what fills it (kg/m^3).
    pub density: f64,
    /// What its surface is made of.
    pub material: Frictional,
    /// How it is held.
    pub support: Support,
}

/// What gives a clump its mass, its centroid and its inertia.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Filling {
    /// Its spheres; where several share a place it counts once.
    Spheres,
    /// A solid with these properties at unit density, whose outline the spheres are: a hollow clump.
    Solid(MassProperties),
}

/// Which outline hollow clumps follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Hollow {
    /// The whole surface of the stone.
    Space,
    /// Its section normal to y, one sphere deep: a plane model, as made of discs. A stone that is free cannot move along y nor
    /// turn out of the plane; mass and inertia are those of the stone in its full depth along y.
    Plane,
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

/// Why a wall cannot be made of hollow clumps.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum HollowFault {
    /// The spheres do not fit a block.
    #[error("block {block}: {fault}")]
    Outline {
        /// Id of the block.
        block: usize,
        /// Why not.
        fault: OutlineFault,
    },
    /// The block is a part of a stone of several.
    #[error(
        "block {block} is a part of the stone {group:?}: a hollow clump is made of one convex block; give the part no group"
    )]
    Part {
        /// Id of the block.
        block: usize,
        /// The stone's name.
        group: String,
    },
}

impl Clump {
    /// A free clump with the mass of its spheres.
    pub fn of_spheres(spheres: Vec<Ball>, density: f64, material: Frictional) -> Clump {
        Clump { spheres, filling: Filling::Spheres, density, material, support: Support::Free }
    }

    /// A hollow clump: the outline of a convex solid in spheres, with the mass, the centroid and the inertia of the solid. It is free
    /// within its model.
    ///
    /// The stone's roughness is that of its spheres: a joint of two such stones dilates and is rougher than its spheres
    /// (`tests/physics/regular_rows.rs`). What the source paper's reference 19 calls by this name is a model of discs in a plane.
    ///
    /// # Errors
    /// [`OutlineFault`] where the spheres do not fit.
    pub fn hollow(
        solid: &Polyhedron,
        density: f64,
        model: Hollow,
        rows: &Rows,
        material: Frictional,
    ) -> Result<Clump, OutlineFault> {
        let (spheres, support) = match model {
            Hollow::Space => (rows.around(solid)?, Support::Free),
            Hollow::Plane => (rows.around_section(solid)?, Support::OutOfPlane),
        };
        Ok(Clump { spheres, filling: Filling::Solid(solid.mass_properties()), density, material, support })
    }

    /// Volume, centroid and inertia of what gives it its mass, at unit density.
    pub fn mass_properties(&self) -> MassProperties {
        match self.filling {
            Filling::Spheres => union_of_balls(&self.spheres),
            Filling::Solid(properties) => properties,
        }
    }
}

impl Heap {
    /// Clumps of one density and one material on ground of the same material, the plane z = 0.
    pub fn on_ground(clumps: Vec<Vec<Ball>>, density: f64, material: Frictional) -> Heap {
        let clump = |spheres| Clump::of_spheres(spheres, density, material);
        Heap {
            clumps: clumps.into_iter().map(clump).collect(),
            planes: vec![Plane { normal: Vec3::z(), offset: 0.0 }],
            plane_material: material,
        }
    }

    /// A wall in hollow clumps, without planes: clump k is block k, held as that is. A block that is absent has no spheres.
    ///
    /// # Errors
    /// [`HollowFault`], the first one.
    pub fn hollow(
        wall: &Wall,
        model: Hollow,
        rows: &Rows,
        material: Frictional,
    ) -> Result<Heap, HollowFault> {
        let clump = |(id, block): (usize, &Block)| {
            if let Some(group) = &block.group {
                return Err(HollowFault::Part { block: id, group: group.clone() });
            }
            let made = Clump::hollow(&block.shape, block.density, model, rows, material);
            let clump = made.map_err(|fault| HollowFault::Outline { block: id, fault })?;
            Ok(match block.support {
                Support::Free => clump,
                Support::Absent => Clump { spheres: Vec::new(), support: Support::Absent, ..clump },
                support => Clump { support, ..clump },
            })
        };
        let clumps = wall.blocks.iter().enumerate().map(clump).collect::<Result<_, _>>()?;
        Ok(Heap { clumps, planes: Vec::new(), plane_material: material })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROWS: Rows = Rows { radius: 0.01, spacing: 0.02, phase: 0.0 };
    const MATERIAL: Frictional = Frictional { young: 1e7, ks_over_kn: 0.5, phi: 0.5 };

    fn block(support: Support, group: Option<&str>) -> Block {
        let shape = Polyhedron::cuboid(Vec3::zeros(), Vec3::new(0.2, 0.12, 0.06));
        Block { support, group: group.map(str::to_owned), ..Block::stone(shape, 2400.0) }
    }

    #[test]
    fn a_hollow_clump_weighs_as_its_stone() {
        let stone = block(Support::Free, None).shape;
        for (model, support) in [(Hollow::Space, Support::Free), (Hollow::Plane, Support::OutOfPlane)] {
            let clump = Clump::hollow(&stone, 2400.0, model, &ROWS, MATERIAL).unwrap();
            assert_eq!((clump.mass_properties(), clump.support), (stone.mass_properties(), support));
            let own = union_of_balls(&clump.spheres).volume;
            assert!(own < 0.7 * stone.volume(), "its spheres do not: {own}");
        }
    }

    #[test]
    fn a_wall_keeps_its_ids_and_its_supports() {
        let supports = [Support::Fixed, Support::Free, Support::Absent, Support::Upright];
        let wall = Wall { blocks: supports.iter().map(|s| block(*s, None)).collect() };
        let heap = Heap::hollow(&wall, Hollow::Plane, &ROWS, MATERIAL).unwrap();
        let held: Vec<Support> = heap.clumps.iter().map(|c| c.support).collect();
        assert_eq!(held, [Support::Fixed, Support::OutOfPlane, Support::Absent, Support::Upright]);
        assert_eq!(
            heap.clumps.iter().map(|c| c.spheres.is_empty()).collect::<Vec<_>>(),
            [false, false, true, false]
        );
    }

    #[test]
    fn what_cannot_be_hollow_is_named() {
        let wall = Wall { blocks: vec![block(Support::Free, None), block(Support::Free, Some("corner"))] };
        let fault = Heap::hollow(&wall, Hollow::Space, &ROWS, MATERIAL).unwrap_err();
        assert!(fault.to_string().starts_with("block 1 is a part of the stone \"corner\""), "{fault}");
        let rows = Rows { radius: 0.05, ..ROWS };
        let fault = Heap::hollow(&wall, Hollow::Space, &rows, MATERIAL).unwrap_err();
        assert!(fault.to_string().starts_with("block 0: balls of radius 0.05 m do not fit"), "{fault}");
    }
}
