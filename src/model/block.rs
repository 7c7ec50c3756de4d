//! A block: a rigid convex stone, a wedge, or a piece of the surroundings.

use crate::math::{Mat3, Vec3};
use crate::shape::{MassProperties, Polyhedron};

/// A rigid convex block in world coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// Its shape at rest, in world coordinates (m).
    pub shape: Polyhedron,
    /// Density (kg/m^3).
    pub density: f64,
    /// How it is held.
    pub support: Support,
    /// What it is.
    pub tag: Tag,
    /// The stone that it is a part of: all blocks of one group are one rigid body, held as the first of them is, so that
    /// convex parts make a concave stone. They may touch and overlap without a joint; what they share weighs twice.
    /// `None` (usual): a body of its own.
    pub group: Option<String>,
    /// What the stone holds where `shape` is only the convex hull of its scan, by which it touches others: volume, centroid and inertia
    /// of the scan. `None` (usual): the shape is the stone.
    pub scan: Option<MassProperties>,
}

impl Block {
    /// A stone that moves freely, a body of its own: its shape at rest (m) and its density (kg/m^3).
    pub fn stone(shape: Polyhedron, density: f64) -> Block {
        Block { shape, density, support: Support::Free, tag: Tag::Stone, group: None, scan: None }
    }

    /// The same block after x -> turn x + shift.
    pub fn moved(&self, turn: &Mat3, shift: &Vec3) -> Block {
        let scan = self.scan.map(|own| MassProperties {
            centroid: turn * own.centroid + shift,
            inertia: turn * own.inertia * turn.transpose(),
            ..own
        });
        Block { shape: self.shape.moved(turn, shift), scan, ..self.clone() }
    }

    /// Volume (m^3), centroid (m) and inertia (m^5) of the stone at unit density, in world coordinates.
    pub fn mass_properties(&self) -> MassProperties {
        self.scan.unwrap_or_else(|| self.shape.mass_properties())
    }

    /// Volume of the stone (m^3).
    pub fn volume(&self) -> f64 {
        self.mass_properties().volume
    }

    /// Mass (kg).
    pub fn mass(&self) -> f64 {
        self.density * self.volume()
    }

    /// Moves it along `by` (m).
    pub fn shift(&mut self, by: &Vec3) {
        self.shape = self.shape.translated(by);
        if let Some(scan) = &mut self.scan {
            scan.centroid += by;
        }
    }
}

/// How a block is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Support {
    /// Moves freely.
    Free,
    /// Does not move.
    Fixed,
    /// Cannot move out of plane (y) nor turn about x or z; free in the wall's plane.
    OutOfPlane,
    /// Neither moves out of plane nor turns: it shifts in the wall's plane.
    Upright,
    /// Not there any more: a stone that has fallen out. It has neither weight nor joints; the others keep their ids.
    Absent,
}

/// What a block is, for reports and for the rules that treat it.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Tag {
    /// A stone of the wall.
    Stone,
    /// A stone that spans all wythes.
    Header,
    /// A small wedge stone in a joint.
    Wedge,
    /// The ground or the platform under the wall.
    Base,
    /// A block that restrains an end of the wall, or presses on its top.
    End,
    /// A stone that its owner calls something else, for example a keystone.
    #[serde(untagged)]
    Other(String),
}

impl Tag {
    /// By its name in files; a name that is none of the known ones is the owner's own.
    pub fn named(name: &str) -> Tag {
        match name {
            "stone" => Tag::Stone,
            "header" => Tag::Header,
            "wedge" => Tag::Wedge,
            "base" => Tag::Base,
            "end" => Tag::End,
            other => Tag::Other(other.to_owned()),
        }
    }

    /// Its name in files.
    pub fn name(&self) -> &str {
        match self {
            Tag::Stone => "stone",
            Tag::Header => "header",
            Tag::Wedge => "wedge",
            Tag::Base => "base",
            Tag::End => "end",
            Tag::Other(name) => name,
        }
    }
}
