//! What presses on the back of one wall at every height of the fill or the water behind it.

use crate::math::{Vec3, atan, cos, degrees, sin};
use crate::model::Wall;
use crate::protocol::Direction;
use crate::protocol::faces::{Face, faces_against};
use crate::protocol::pressure::Load;
use crate::protocol::retaining::retained::{Acts, Pressure, Retained};

/// A wall with what it holds back. The faces are those of the wall as built: what presses does not follow a wall that moves.
#[derive(Clone, Debug, PartialEq)]
pub struct Behind {
    faces: Vec<Face>,
    towards: Vec3,
    pressures: Vec<Pressure>,
    /// Height (m) of the foot of its back, from which heights of the fill count.
    pub foot: f64,
    /// From there to the top of its back (m).
    pub height: f64,
    /// Lean of its back (rad): above 0 where it goes away from the fill as it rises. That of the plane that fits its faces best, by area.
    pub lean: f64,
    /// Coefficient of the pressure of soil; `None` of water.
    pub coefficient: Option<f64>,
}

/// Why nothing presses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoBack {
    /// No face of a stone that moves looks to the fill.
    NoFace,
    /// On a back of that lean (rad) the soil has no wedge.
    NoWedge(f64),
}

impl NoBack {
    /// In words.
    pub fn reason(&self) -> String {
        match self {
            NoBack::NoFace => {
                "no face of a stone that moves looks to the side of the fill: what it pushes towards is the other side".to_owned()
            }
            NoBack::NoWedge(lean) => format!(
                "the back leans by {:.1} deg, on which Coulomb's wedge does not slide",
                degrees(*lean)
            ),
        }
    }
}

impl Behind {
    /// Behind a wall that it pushes towards a direction.
    ///
    /// # Errors
    /// [`NoBack`] says why nothing can press.
    pub fn new(wall: &Wall, towards: Direction, retained: &Retained) -> Result<Behind, NoBack> {
        let towards = towards.unit();
        let faces = faces_against(wall, towards);
        let [foot, top] = faces
            .iter()
            .map(Face::heights)
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], [own_low, own_high]| {
                [low.min(own_low), high.max(own_high)]
            });
        if top <= foot {
            return Err(NoBack::NoFace);
        }
        let lean = lean(&faces, &towards);
        let (pressures, coefficient) = retained.pressures(lean).ok_or(NoBack::NoWedge(lean))?;
        Ok(Behind { faces, towards, pressures, foot, height: top - foot, lean, coefficient })
    }

    /// The forces of what is so high (m) above the foot, on the stones' faces below its surface: exact integrals. The depth of a place is counted
    /// from where the surface meets the back.
    pub fn loads(&self, height: f64) -> Vec<Load> {
        let surface = self.foot + height;
        let below = self.faces.iter().filter_map(|face| face.below(surface));
        below
            .flat_map(|face| {
                self.pressures.iter().filter_map(move |own| self.on(&face, own, surface)).collect::<Vec<_>>()
            })
            .collect()
    }

    fn on(&self, face: &Face, pressure: &Pressure, surface: f64) -> Option<Load> {
        let Pressure { surface: least, deeper, acts } = *pressure;
        let (total, point) = face.pressed(least + deeper * (surface - face.frame.origin.z), -deeper)?;
        let force = match acts {
            Acts::Across => -face.frame.normal * total,
            Acts::Inclined(angle) => {
                let along = self.towards * cos(angle) - Vec3::z() * sin(angle);
                // Coulomb's thrust is one per height, however a face leans.
                along * (total * -face.frame.normal.dot(&self.towards))
            }
        };
        Some(Load { block: face.block, point, force })
    }
}

/// The lean (rad) of the plane along the wall that fits its back best: least squares of how far it lies along `towards` over its height, by the faces' areas as seen
/// along that.
fn lean(faces: &[Face], towards: &Vec3) -> f64 {
    // About a point on the back, against cancellation.
    let about = faces.first().map_or_else(Vec3::zeros, |face| face.frame.origin);
    let mut sums = [0.0; 5];
    for face in faces {
        let (m, frame) = (face.moments(), &face.frame);
        let seen = -frame.normal.dot(towards);
        let from = frame.origin - about;
        // A coordinate over the face is c + cs s + ct t.
        let [y, z] =
            [*towards, Vec3::z()].map(|axis| [from.dot(&axis), frame.s.dot(&axis), frame.t.dot(&axis)]);
        let one = |[c, cs, ct]: [f64; 3]| c * m.area + cs * m.s + ct * m.t;
        let two = |[a, at_s, at_t]: [f64; 3], b: [f64; 3]| {
            a * one(b)
                + at_s * (b[0] * m.s + b[1] * m.ss + b[2] * m.st)
                + at_t * (b[0] * m.t + b[1] * m.st + b[2] * m.tt)
        };
        for (sum, own) in sums.iter_mut().zip([m.area, one(y), one(z), two(y, z), two(z, z)]) {
            *sum += seen * own;
        }
    }
    let [area, y, z, yz, zz] = sums;
    let spread = zz - z * z / area;
    if spread > 0.0 { atan((yz - y * z / area) / spread) } else { 0.0 }
}
