//! The joints of a cell as springs between rigid stones.

use crate::contact::{self, Feature, Patch, area_shares, periodic_joints};
use crate::law::{PATCHES_ALONG, Sampling};
use crate::math::Vec3;
use crate::model::{Cell, JointLaws};
use crate::shape::Polygon;

/// Share of a joint's area that is none: faces that gape from an edge on touch along that edge alone, but for the tolerance.
const NO_AREA: f64 = 1e-6;

/// Stones, the springs between them, and how large a piece of the plate they are.
///
/// A joint counts where its faces are built touching, whatever presses on it: the moduli are those of small strains of a wall whose
/// joints neither open nor close. What is built apart ([`contact::Settings::closed`]) carries nothing. Where stiffness grows with
/// closure it is that at a stated pressure.
#[derive(Clone, Debug)]
pub struct Springs {
    /// Centroids of the stones (m).
    pub(super) stones: Vec<Vec3>,
    pub(super) joints: Vec<Spring>,
    /// Thickness of the plate (m) and area of the piece (m^2).
    pub(super) thickness: f64,
    pub(super) area: f64,
}

/// A joint.
#[derive(Clone, Debug)]
pub(super) struct Spring {
    pub first: usize,
    /// The stone on the other side.
    pub second: usize,
    /// From the other stone to the image of it that is meant (m); zero inside a cell.
    pub shift: Vec3,
    /// Whether it lies on the border of the cell.
    pub border: bool,
    /// Unit normal out of the first stone.
    pub normal: Vec3,
    /// Normal and shear stiffness (Pa/m).
    pub kn: f64,
    pub ks: f64,
    /// Points and weights (m^2) that integrate quartic polynomials over the joint exactly.
    pub points: Vec<(Vec3, f64)>,
}

impl Springs {
    /// The joints of a cell at a `pressure` (Pa). `laws` is asked with the stones' numbers, for an image with that of its stone.
    pub fn of_cell(cell: &Cell, laws: &dyn JointLaws, contact: &contact::Settings, pressure: f64) -> Springs {
        let joints = periodic_joints(cell, contact)
            .into_iter()
            .filter_map(|joint| {
                let border = joint.shift != Vec3::zeros();
                let spring =
                    spring([joint.first, joint.second], (&joint.patch, contact.closed), laws, pressure)?;
                Some(Spring { shift: joint.shift, border, ..spring })
            })
            .collect();
        let stones = cell.blocks.iter().map(|block| block.shape.mass_properties().centroid).collect();
        Springs { stones, joints, thickness: cell.thickness, area: cell.area() }
    }

    /// Number of stones.
    pub fn stones(&self) -> usize {
        self.stones.len()
    }

    /// Number of joints, each once.
    pub fn joints(&self) -> usize {
        self.joints.len()
    }
}

/// Unit normal of a patch out of the first stone.
pub(super) fn outward(patch: &Patch) -> Vec3 {
    if patch.reference_is_second { -patch.plane.normal } else { patch.plane.normal }
}

/// The spring of a patch between two stones; `None` where they do not touch over an area.
fn spring(
    [first, second]: [usize; 2],
    (patch, closed): (&Patch, f64),
    laws: &dyn JointLaws,
    pressure: f64,
) -> Option<Spring> {
    let law = laws.of(first as u32, second as u32);
    let points = points(patch, closed, law.sampling, quadrature);
    (!points.is_empty()).then(|| Spring {
        first,
        second,
        shift: Vec3::zeros(),
        border: false,
        normal: outward(patch),
        kn: law.normal.stiffness(law.normal.closure(pressure)),
        ks: law.ks,
        points,
    })
}

/// Points and weights over a joint where its stress is sampled: by a `rule` in each of its pieces, or its corners with their shares; of
/// what is built no further apart than `closed` (m).
///
/// None where two faces do not meet: edges and corners that touch carry nothing, as they have no area before anything moves.
pub(super) fn points(
    patch: &Patch,
    closed: f64,
    sampling: Sampling,
    rule: impl Fn(&Polygon) -> Vec<([f64; 2], f64)>,
) -> Vec<(Vec3, f64)> {
    if !matches!(patch.feature, Feature::Faces(..)) {
        return Vec::new();
    }
    let least = NO_AREA * patch.polygon.area();
    let touching = |outline: &Polygon| {
        let part = patch.touching(outline, closed);
        (part.vertices.len() > 2 && part.area() > least).then_some(part)
    };
    let pieces: Vec<Polygon> = match sampling {
        Sampling::Vertices => {
            let Some(Polygon { vertices }) = touching(&patch.polygon) else { return Vec::new() };
            let shares = area_shares(&vertices);
            return vertices.iter().zip(shares).map(|(&v, share)| (patch.frame.lift(v), share)).collect();
        }
        Sampling::Patches(mask) => {
            let cells = patch.pieces(PATCHES_ALONG, mask);
            cells.iter().filter_map(|cell| touching(&cell.outline)).collect()
        }
        Sampling::Seats(seating) => match patch.seats(seating.share, seating.laid(), closed) {
            Some(cells) => cells.iter().filter_map(|cell| touching(&cell.outline)).collect(),
            None => touching(&patch.polygon).into_iter().collect(),
        },
        Sampling::Area => touching(&patch.polygon).into_iter().collect(),
    };
    let all = pieces.iter().flat_map(rule);
    all.map(|(st, weight)| (patch.frame.lift(st), weight)).collect()
}

/// Six points in each triangle of a fan: exact for polynomials of degree four (Dunavant 1985).
fn quadrature(polygon: &Polygon) -> Vec<([f64; 2], f64)> {
    const RULE: [(f64, f64); 2] = [
        (0.445_948_490_915_964_9, 0.223_381_589_678_011_47),
        (0.091_576_213_509_770_74, 0.109_951_743_655_321_87),
    ];
    let Some((&o, rest)) = polygon.vertices.split_first() else { return Vec::new() };
    let mut all = Vec::with_capacity(6 * rest.len());
    for pair in rest.windows(2) {
        let corners = [o, pair[0], pair[1]];
        let [p, q] = [pair[0], pair[1]].map(|v| [v[0] - o[0], v[1] - o[1]]);
        let area = 0.5 * (p[0] * q[1] - p[1] * q[0]);
        for (share, weight) in RULE {
            for opposite in 0..3 {
                let of = |corner: usize| if corner == opposite { 1.0 - 2.0 * share } else { share };
                let at = |k: usize| (0..3).map(|corner| of(corner) * corners[corner][k]).sum();
                all.push(([at(0), at(1)], weight * area));
            }
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::pow;

    #[test]
    fn quartics_are_integrated_exactly() {
        // x^i y^j over the rectangle 2 x 3 from (1, -1).
        let corners = vec![[1.0, -1.0], [3.0, -1.0], [3.0, 2.0], [1.0, 2.0]];
        let points = quadrature(&Polygon { vertices: corners });
        for i in 0..=4 {
            for j in 0..=4 - i {
                let sum: f64 =
                    points.iter().map(|([x, y], w)| pow(*x, f64::from(i)) * pow(*y, f64::from(j)) * w).sum();
                let along = |low: f64, high: f64, n: i32| {
                    (pow(high, f64::from(n + 1)) - pow(low, f64::from(n + 1))) / f64::from(n + 1)
                };
                let exact = along(1.0, 3.0, i) * along(-1.0, 2.0, j);
                // Sums of twelve products of numbers up to 81.
                assert!((sum - exact).abs() < 1e-11, "{i} {j}: {sum} {exact}");
            }
        }
    }
}
