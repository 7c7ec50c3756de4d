//! Collapse of a plate: its least multiplier, the mechanism, and the stresses that go with it.

use super::facet::{Facet, Units};
use super::mesh::Mesh;
use super::motion::{Motions, Term};
use super::program::{Program, Solved};
use super::wall::{Plate, PlateFault};

/// How a plate collapses.
#[derive(Clone, Debug, PartialEq)]
pub struct Collapse {
    /// The multiplier of the live load: an upper bound of that of a plate with these facets, by the mechanism below.
    pub multiplier: f64,
    /// By how much that is above the multiplier of the stresses: what the solver left open.
    pub gap: f64,
    /// The multiplier at which the whole wall slides out on its base, where the friction of that is given and nothing but the base
    /// hinders it. The lesser of the two is the wall's.
    pub sliding: Option<f64>,
    /// Velocities of the mechanism, scaled so that the live load at a multiplier of one has the power 1 W.
    pub mechanism: Mechanism,
    /// Stress and rate of strain wherever the plate can yield: first in every triangle, then at both ends of every edge that is
    /// within the plate or held.
    pub sections: Vec<Section>,
    /// Force (N) of every rope, along -y.
    pub ropes: Vec<f64>,
    /// Iterations of the solver.
    pub iterations: u32,
}

/// A field of velocities on the triangles of the mesh. A point at y out of the middle plane moves in the plane by that of the middle
/// plane minus y times the slope of the deflection.
#[derive(Clone, Debug, PartialEq)]
pub struct Mechanism {
    /// Positions (x, z) in m: corners of the triangles, then middles of their edges.
    pub nodes: Vec<[f64; 2]>,
    /// Nodes of every triangle: its corners, counter-clockwise where x is to the right and z up, then the middles of the edges after
    /// each of them.
    pub triangles: Vec<[usize; 6]>,
    /// Velocity (m/s) along +y of every node; quadratic in a triangle.
    pub deflection: Vec<f64>,
    /// Velocity (m/s) along x and z of the middle plane at the corners of every triangle; linear in it, and with jumps from one to
    /// the next.
    pub in_plane: Vec<[[f64; 2]; 3]>,
}

/// A place where the plate can yield.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// Position (x, z) in m; the middle of a triangle.
    pub at: [f64; 2],
    /// Unit normal (x, z) of the edge that it is an end of; `None` in a triangle.
    pub normal: Option<[f64; 2]>,
    /// What stress times rate is multiplied by for the power: half of the edge's length (m), or the triangle's area (m^2).
    pub size: f64,
    /// Rate (E11, E22, 2 E12, chi11, chi22, 2 chi12): strains in 1/s and curvatures in 1/(m s) in a triangle; on an edge their jumps,
    /// in m/s and 1/s.
    pub rate: [f64; 6],
    /// Stress resultants (N11, N22, N12 in N/m, M11, M22, M12 in N). On an edge only the three that act on it are in balance; the
    /// others are any with which the section bears those.
    pub stress: [f64; 6],
}

impl Plate {
    /// The least multiplier of the live load at which the plate collapses, when its sections bear what is within all `facets`.
    ///
    /// Negative where the dead load alone is not borne but for a live load against its direction.
    ///
    /// # Errors
    /// A plate or facets that make no sense; a live load that is borne whatever its size; a wall that no multiplier keeps up; a
    /// program that was not solved.
    pub fn collapse(&self, facets: &[Facet]) -> Result<Collapse, PlateFault> {
        self.collapse_by(facets, |program| program.solve())
    }

    /// The collapse when every section has facets of its own, by their numbers; a section without a list has all.
    pub(super) fn collapse_within(
        &self,
        facets: &[Facet],
        own: &[Vec<usize>],
    ) -> Result<Collapse, PlateFault> {
        self.collapse_of(facets, own, |program| program.solve())
    }

    /// The collapse by one way or another to solve the program.
    pub(super) fn collapse_by(
        &self,
        facets: &[Facet],
        solve: impl FnOnce(&Program) -> Result<Solved, PlateFault>,
    ) -> Result<Collapse, PlateFault> {
        self.collapse_of(facets, &[], solve)
    }

    fn collapse_of(
        &self,
        facets: &[Facet],
        own: &[Vec<usize>],
        solve: impl FnOnce(&Program) -> Result<Solved, PlateFault>,
    ) -> Result<Collapse, PlateFault> {
        self.check(facets)?;
        let mesh = Mesh::new([self.length, self.height], self.mesh);
        let motions = Motions::new(self, &mesh);
        let places = motions.places(self, &mesh);
        let ropes: Vec<_> = self.ropes.iter().map(|&at| motions.deflection_at(&mesh, at)).collect();
        let all = || (0..facets.len()).collect();
        let own: Vec<Vec<usize>> =
            (0..places.len()).map(|place| own.get(place).cloned().unwrap_or_else(all)).collect();
        let program = Program {
            places: &places,
            facets,
            own: &own,
            dead: &motions.power(&mesh, [0.0, 0.0, -self.weight], 1.0),
            live: &motions.power(&mesh, self.live, self.base_over_top),
            ropes: &ropes,
            units: Units::of(self.weight * self.height, facets),
        };
        let solved = solve(&program)?;
        let sections = places.iter().zip(&solved.stresses).map(|(place, &stress)| Section {
            at: place.at,
            normal: place.normal,
            size: place.size,
            rate: rate(&place.rate, &solved.velocities),
            stress,
        });
        Ok(Collapse {
            multiplier: solved.multiplier,
            gap: solved.gap,
            sliding: self.sliding(),
            sections: sections.collect(),
            mechanism: mechanism(mesh, &motions, &solved.velocities),
            ropes: solved.ropes,
            iterations: solved.iterations,
        })
    }
}

fn rate(terms: &[Term<[f64; 6]>], velocities: &[f64]) -> [f64; 6] {
    let mut rate = [0.0; 6];
    for (velocity, per_unit) in terms {
        rate.iter_mut().zip(per_unit).for_each(|(sum, unit)| *sum += unit * velocities[*velocity]);
    }
    rate
}

fn mechanism(mesh: Mesh, motions: &Motions, velocities: &[f64]) -> Mechanism {
    let of = |node| motions.deflection(node).map_or(0.0, |velocity| velocities[velocity]);
    let at = |t, corner| [0, 1].map(|axis| velocities[motions.in_plane(t, corner, axis)]);
    Mechanism {
        deflection: (0..mesh.nodes.len()).map(of).collect(),
        in_plane: (0..mesh.triangles.len()).map(|t| [0, 1, 2].map(|corner| at(t, corner))).collect(),
        triangles: mesh
            .triangles
            .iter()
            .map(|t| {
                let ([a, b, c], [ab, bc, ca]) = (t.corners, t.middles);
                [a, b, c, ab, bc, ca]
            })
            .collect(),
        nodes: mesh.nodes,
    }
}
