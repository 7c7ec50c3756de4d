//! What one cell is as a plate: stiffness under three borders, strength in some directions.

use serde::{Deserialize, Serialize};

use crate::contact;
use crate::homogenise::{Border, Direction, Loose, Method, Moduli, Point, Springs, surface};
use crate::model::{Cell, JointLaws};

/// What is asked of a cell.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AskedOfCell {
    /// In which directions strength is looked for.
    pub directions: Vec<Direction>,
    /// By which methods.
    pub methods: Vec<Method>,
}

/// What was found of a cell.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CellAnswer {
    /// Number of stones.
    pub stones: usize,
    /// Number of joints between faces, each once.
    pub joints: usize,
    /// Thickness of the plate (m).
    pub thickness: f64,
    /// Vertical stress resultant (N/m, pressure positive).
    pub pressure: f64,
    /// Stiffness by border, in the order of [`Border::ALL`]; else why there is none.
    pub moduli: [Result<Moduli, Loose>; 3],
    /// Points of the surface, method by method, direction by direction.
    pub surfaces: Vec<Vec<Point>>,
}

impl AskedOfCell {
    /// Asks it of a cell under a vertical `stress` (Pa, pressure positive). `laws` is asked with the stones' numbers, for an image with
    /// that of its stone.
    pub fn answer(
        &self,
        cell: &Cell,
        laws: &dyn JointLaws,
        contact: contact::Settings,
        stress: f64,
    ) -> CellAnswer {
        let springs = Springs::of_cell(cell, laws, &contact, stress);
        let pressure = stress * cell.thickness;
        let borne = |method: &Method| surface(cell, laws, contact, *method, pressure, &self.directions);
        CellAnswer {
            stones: springs.stones(),
            joints: springs.joints(),
            thickness: cell.thickness,
            pressure,
            moduli: Border::ALL.map(|border| Moduli::of(&springs, border)),
            surfaces: self.methods.iter().map(borne).collect(),
        }
    }
}

impl CellAnswer {
    /// Whether the stiffness lies between its bounds; `None` where it or the upper one is not known. Without a static bound there is
    /// none from below.
    pub fn is_nested(&self) -> Option<bool> {
        let [kinematic, periodic, fixed] = &self.moduli;
        let periodic = periodic.as_ref().ok()?;
        let above = fixed.as_ref().map_or(true, |fixed| periodic.is_above(fixed));
        Some(kinematic.as_ref().ok()?.is_above(periodic) && above)
    }
}
