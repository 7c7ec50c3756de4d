//! Back to the wall: a plate whose sections bear what a cell bears, scaled by the pressure there.
//!
//! Without cohesion all that a cell bears is proportional to the vertical stress, so one cone of stresses serves the whole wall,
//! whatever its weight does from the top to the foot. The planes of the cone are found where they are needed: a section whose
//! stress lies outside asks the cell along that stress, and the mechanism of the cell is the plane that cuts it off.

use crate::contact;
use crate::homogenise::plate::{Cuts, Facet, Plate, PlateFault, Refined, Section};
use crate::homogenise::{Direction, IN_PLANE, Method, out_of_plane, surface};
use crate::model::{Cell, JointLaws, Six};
use crate::solve::limit::{Analysis, Settings};

/// Vertical stress resultant at which the cell is asked (N/m): any one does.
const PRESSURE: f64 = 1.0;
/// A section that bears less than this share of the pressure at the wall's foot bears nothing.
const NOTHING: f64 = 1e-6;
/// Multiples of a stress from which on it counts as borne: the accuracy of the cell's answer.
const BORNE: f64 = 1.0 - 1e-6;
/// The collapse of a wall as a plate with the associative surface of a cell.
///
/// The multiplier is an upper bound of that of a plate with this surface, by the mesh's mechanisms; shear across the thickness is
/// in no thin plate, see [`Plate::base_friction`].
///
/// # Errors
/// [`PlateFault`]: above all a wall that falls at rest, or that bears any load.
pub fn plate_collapse(
    cell: &Cell,
    laws: &dyn JointLaws,
    contact: contact::Settings,
    plate: &Plate,
    cuts: &Cuts,
) -> Result<Refined, PlateFault> {
    let stones = cell.blocks.len() as u32;
    let bonds = |a, b| {
        let law = laws.of(a, b);
        law.bonded || law.cohesion != 0.0 || law.tension != 0.0
    };
    if (0..stones).any(|a| (a..stones).any(|b| bonds(a, b))) {
        return Err(PlateFault::Bond);
    }
    let directions: Vec<Direction> = IN_PLANE.into_iter().chain(out_of_plane()).collect();
    let points = surface(cell, laws, contact, Method::Associative, PRESSURE, &directions);
    let unit = |k: usize| if k < 3 { 1.0 } else { cell.thickness };
    let mut facets = vec![Facet { normal: [0.0, 1.0, 0.0, 0.0, 0.0, 0.0], bound: 0.0 }];
    for point in points.iter().filter(|point| point.found.value().is_some()) {
        facets.push(Facet { normal: std::array::from_fn(|k| point.normal[k] / unit(k)), bound: 0.0 });
    }
    let analysis = Analysis::of_cell(cell, laws, contact, Settings::default(), PRESSURE);
    let foot = plate.weight * plate.height;
    let mut cut = |section: &Section| {
        let pressure = -section.stress[1];
        if pressure <= NOTHING * foot {
            return None;
        }
        let mut live: Six = section.stress.map(|stress| stress / pressure);
        live[1] = 0.0;
        let bearing = analysis.bears([0.0, -PRESSURE, 0.0, 0.0, 0.0, 0.0], &[live]).pop()?;
        let outside = bearing.limit.multiplier < BORNE && bearing.rate.iter().any(|rate| *rate != 0.0);
        outside.then_some(Facet { normal: bearing.rate, bound: 0.0 })
    };
    plate.collapse_by_cuts(facets, &mut cut, cuts)
}
