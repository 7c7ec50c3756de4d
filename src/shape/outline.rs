//! The outline of a convex solid in balls: rows of them just inside its faces, nothing within.

use crate::math::{Vec3, sin};
use crate::shape::{Ball, Frame, Polygon, Polyhedron};

/// Share of the solid's size within which corners lie on a plane and an edge has no length: rounding alone.
const ROUNDING: f64 = 1e-9;

/// How balls follow the outline of a solid.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Rows {
    /// Radius of the balls (m).
    pub radius: f64,
    /// Distance of neighbouring centres that is asked for (m). Along an edge or across a face it is changed as little as a
    /// whole number of distances between its ends needs.
    pub spacing: f64,
    /// Where the rows of faces that look down begin, as a share of the spacing from their edge, in [0, 1). Those of other
    /// faces begin at the edge. 0: beds meet ball on ball. 0.5: balls meet the hollows of an equal bed below.
    ///
    /// Shifted rows leave out the edges of their face, which the faces beside it would fill otherwise. They lie as far below the
    /// face as they need to touch the balls of an equal bed below, so that stones laid face on face interlock without a gap.
    pub phase: f64,
}

/// Why a solid has no outline in such balls.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum OutlineFault {
    /// A radius or spacing that is not positive, or a phase outside of [0, 1).
    #[error(
        "rows of radius {} m, spacing {} m, phase {}: radius and spacing must be positive, the phase in [0, 1)",
        .0.radius, .0.spacing, .0.phase
    )]
    Rows(Rows),
    /// Shifted rows would fall through the bed below.
    #[error(
        "balls of radius {radius} m fall between others that are {spacing} m apart: take a smaller spacing or a phase of 0"
    )]
    TooWide {
        /// Their radius (m).
        radius: f64,
        /// The spacing asked for (m).
        spacing: f64,
    },
    /// No centre is a radius away from all faces.
    #[error("balls of radius {radius} m do not fit into a solid {width} m thick: take a smaller radius")]
    TooThin {
        /// Their radius (m).
        radius: f64,
        /// Smallest width of the solid (m).
        width: f64,
    },
}

impl Rows {
    /// Balls that touch the faces of a convex solid from inside: one in every corner, rows along all edges and over all faces,
    /// none within. Rows of a face run along its longest edge.
    ///
    /// # Errors
    /// [`OutlineFault`].
    pub fn around(&self, solid: &Polyhedron) -> Result<Vec<Ball>, OutlineFault> {
        self.check()?;
        let size = solid.diameter();
        let planes: Vec<_> = (0..solid.faces.len())
            .map(|face| {
                let mut plane = solid.face_plane(face);
                plane.offset -= self.radius;
                plane
            })
            .collect();
        // The centres lie on the surface of what is at least a radius away from all faces.
        let inner = Polyhedron::behind(&planes, &solid.vertices, size, ROUNDING * size)
            .filter(|inner| inner.volume() > 0.0)
            .ok_or_else(|| self.too_thin(solid.smallest_width()))?;
        let shifted: Vec<bool> =
            (0..inner.faces.len()).map(|face| self.shifts(inner.face_plane(face).normal.z)).collect();
        let beside = |corners: &[u32]| {
            let mut faces = inner.faces.iter().zip(&shifted);
            faces.any(|(face, shifted)| *shifted && corners.iter().all(|corner| face.contains(corner)))
        };
        let mut centres: Vec<Vec3> = Vec::new();
        for (corner, at) in (0u32..).zip(&inner.vertices) {
            if !beside(&[corner]) {
                centres.push(*at);
            }
        }
        for face in &inner.faces {
            for (k, &a) in face.iter().enumerate() {
                let b = face[(k + 1) % face.len()];
                // Every edge is met once in each direction.
                if a < b && !beside(&[a, b]) {
                    let (from, to) = (inner.vertices[a as usize], inner.vertices[b as usize]);
                    centres.extend(self.between((to - from).norm()).map(|share| from + (to - from) * share));
                }
            }
        }
        for (face, shifted) in shifted.iter().enumerate() {
            self.over(&inner, face, *shifted, &mut centres)?;
        }
        Ok(centres.into_iter().map(|centre| Ball { centre, radius: self.radius }).collect())
    }

    /// Balls along the outline of a prism's section through its centroid, normal to y: the outline of a plane model. Faces that
    /// look along y take no part.
    ///
    /// # Errors
    /// [`OutlineFault`].
    pub fn around_section(&self, solid: &Polyhedron) -> Result<Vec<Ball>, OutlineFault> {
        self.check()?;
        let y = solid.mass_properties().centroid.y;
        let (low, high) = solid.bounds();
        let corners = [[low.x, low.z], [high.x, low.z], [high.x, high.z], [low.x, high.z]];
        let mut inner = Polygon { vertices: corners.to_vec() };
        for face in 0..solid.faces.len() {
            let plane = solid.face_plane(face);
            let [a, b] = [plane.normal.x, plane.normal.z];
            let steep = (a * a + b * b).sqrt();
            if steep > ROUNDING {
                inner = inner.clip(
                    (plane.normal.y * y - plane.offset) / steep + self.radius,
                    a / steep,
                    b / steep,
                );
            }
        }
        let inner = Polygon::around(inner.vertices);
        let corners = &inner.vertices;
        if corners.len() < 3 || inner.area() <= 0.0 {
            return Err(self.too_thin((high.x - low.x).min(high.z - low.z)));
        }
        let n = corners.len();
        // The outward normal of an edge a -> b of a counter-clockwise polygon is (dz, -dx).
        let shifted = |k: usize| {
            let ([ax, az], [bx, bz]) = (corners[k % n], corners[(k + 1) % n]);
            self.shifts((ax - bx) / ((bx - ax) * (bx - ax) + (bz - az) * (bz - az)).sqrt())
        };
        let mut centres = Vec::new();
        for k in 0..n {
            let ([ax, az], [bx, bz]) = (corners[k], corners[(k + 1) % n]);
            if !shifted(k) && !shifted(k + n - 1) {
                centres.push([ax, az]);
            }
            let length = ((bx - ax) * (bx - ax) + (bz - az) * (bz - az)).sqrt();
            let at = |share: f64| [ax + (bx - ax) * share, az + (bz - az) * share];
            if shifted(k) {
                let deep = self.deep(&[self.fitted(length)])? / length;
                let lower = |[x, z]: [f64; 2]| [x + (bz - az) * deep, z - (bx - ax) * deep];
                centres.extend(self.begun(length).map(at).map(lower));
            } else {
                centres.extend(self.between(length).map(at));
            }
        }
        Ok(centres
            .into_iter()
            .map(|[x, z]| Ball { centre: Vec3::new(x, y, z), radius: self.radius })
            .collect())
    }

    /// The distance of neighbouring centres along an edge whose corner balls are `length` (m) apart.
    pub fn fitted(&self, length: f64) -> f64 {
        length / f64::from(self.intervals(length))
    }

    fn check(&self) -> Result<(), OutlineFault> {
        let positive = |x: f64| x > 0.0 && x.is_finite();
        if positive(self.radius) && positive(self.spacing) && (0.0..1.0).contains(&self.phase) {
            Ok(())
        } else {
            Err(OutlineFault::Rows(*self))
        }
    }

    fn too_thin(&self, width: f64) -> OutlineFault {
        OutlineFault::TooThin { radius: self.radius, width }
    }

    /// Whether the rows of a face are shifted whose outward normal has this part upwards: it looks down by more than half a
    /// right angle.
    fn shifts(&self, up: f64) -> bool {
        self.phase > 0.0 && up < -sin(std::f64::consts::FRAC_PI_4)
    }

    fn intervals(&self, length: f64) -> u32 {
        (length / self.spacing).round().max(1.0) as u32
    }

    /// Shares of an edge at which balls lie between its ends.
    fn between(&self, length: f64) -> impl Iterator<Item = f64> {
        let n = self.intervals(length);
        (1..n).map(move |i| f64::from(i) / f64::from(n))
    }

    /// The same in shifted rows, which have no balls at the ends.
    fn begun(&self, length: f64) -> impl Iterator<Item = f64> {
        let (n, phase) = (self.intervals(length), self.phase);
        (0..n).map(move |i| (f64::from(i) + phase) / f64::from(n))
    }

    /// How far shifted rows lie below their face (m), given the distances of neighbours along their axes (m).
    fn deep(&self, spacings: &[f64]) -> Result<f64, OutlineFault> {
        let aside = self.phase.min(1.0 - self.phase);
        let square = |s: &f64| (aside * s) * (aside * s);
        let height = 4.0 * self.radius * self.radius - spacings.iter().map(square).sum::<f64>();
        if height <= 0.0 {
            return Err(OutlineFault::TooWide { radius: self.radius, spacing: self.spacing });
        }
        Ok(2.0 * self.radius - height.sqrt())
    }

    /// Adds the centres over a face, without those on its edges.
    fn over(
        &self,
        inner: &Polyhedron,
        face: usize,
        shifted: bool,
        centres: &mut Vec<Vec3>,
    ) -> Result<(), OutlineFault> {
        let corners: Vec<Vec3> = inner.face_vertices(face).collect();
        let edge = |k: usize| corners[(k + 1) % corners.len()] - corners[k];
        let longer = |best: usize, k: usize| {
            if edge(k).norm() > edge(best).norm() * (1.0 + ROUNDING) { k } else { best }
        };
        let longest = (1..corners.len()).fold(0, longer);
        let s = edge(longest).normalize();
        let normal = inner.face_plane(face).normal;
        let frame = Frame { origin: corners[longest], s, t: normal.cross(&s), normal };
        let flat: Vec<[f64; 2]> = corners.iter().map(|corner| frame.project(corner)).collect();
        let breadth = flat.iter().map(|at| at[1]).fold(0.0, f64::max);
        let rows: Vec<f64> =
            if shifted { self.begun(breadth).collect() } else { self.between(breadth).collect() };
        for t in rows.into_iter().map(|share| share * breadth) {
            let Some([from, to]) = chord(&flat, t) else { continue };
            let at = |share: f64| frame.lift([from + (to - from) * share, t]);
            if shifted {
                let deep = self.deep(&[self.fitted(to - from), self.fitted(breadth)])?;
                centres.extend(self.begun(to - from).map(|share| at(share) + normal * deep));
            } else {
                centres.extend(self.between(to - from).map(at));
            }
        }
        Ok(())
    }
}

/// The part of a line of constant t within a convex polygon.
fn chord(polygon: &[[f64; 2]], t: f64) -> Option<[f64; 2]> {
    let mut ends = [f64::INFINITY, f64::NEG_INFINITY];
    for (k, [sa, ta]) in polygon.iter().enumerate() {
        let [sb, tb] = polygon[(k + 1) % polygon.len()];
        if (*ta <= t) != (tb <= t) {
            let s = sa + (sb - sa) * (t - ta) / (tb - ta);
            ends = [ends[0].min(s), ends[1].max(s)];
        }
    }
    (ends[0] <= ends[1]).then_some(ends)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROWS: Rows = Rows { radius: 0.01, spacing: 0.02, phase: 0.0 };

    fn stone() -> Polyhedron {
        Polyhedron::cuboid(Vec3::new(0.3, -0.1, 0.05), Vec3::new(0.5, 0.02, 0.11))
    }

    /// Smallest distance of a ball's centre from the faces (m).
    fn depth(solid: &Polyhedron, ball: &Ball) -> f64 {
        (0..solid.faces.len())
            .map(|f| -solid.face_plane(f).distance(&ball.centre))
            .fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn a_box_has_the_surface_of_a_grid() {
        let balls = ROWS.around(&stone()).unwrap();
        // Centres 0.18 x 0.10 x 0.04 m apart: 10 x 6 x 3 of them, less the 8 x 4 x 1 within.
        assert_eq!(balls.len(), 10 * 6 * 3 - 8 * 4);
        for (k, ball) in balls.iter().enumerate() {
            // Rounding of a few numbers below 1.
            assert!((depth(&stone(), ball) - 0.01).abs() < 1e-15, "{ball:?}");
            assert!(balls[..k].iter().all(|other| ball.overlap(other) < 1e-15), "neighbours touch, no more");
        }
    }

    #[test]
    fn shifted_beds_lie_over_the_hollows_of_the_bed_below() {
        let rows = Rows { phase: 0.5, ..ROWS };
        let balls = rows.around(&stone()).unwrap();
        let at = |z: f64| balls.iter().filter(|b| (b.centre.z - z).abs() < 1e-12).collect::<Vec<_>>();
        // As far below the face as the hollow is deep: a ball on four has its centre sqrt(2) r higher than theirs.
        let (below, above) = (at(0.06 - 0.01 * (2.0 - 2.0_f64.sqrt())), at(0.10));
        // 9 x 5 hollows of 10 x 6.
        assert_eq!((below.len(), above.len()), (45, 60));
        let reach = |ball: &Ball| {
            let flat = |other: &&&Ball| (other.centre - ball.centre).xy().norm();
            above.iter().map(|other| flat(&other)).fold(f64::INFINITY, f64::min)
        };
        // Half the diagonal of a mesh.
        assert!(below.iter().all(|ball| (reach(ball) - 0.01 * 2.0_f64.sqrt()).abs() < 1e-15));
        // What stands beside them is one row shorter.
        assert_eq!(balls.len(), 45 + 60 + 2 * (10 + 6 - 2));
    }

    #[test]
    fn a_section_is_the_outline_of_its_polygon() {
        let balls = ROWS.around_section(&stone()).unwrap();
        assert_eq!(balls.len(), 2 * (9 + 2));
        assert!(balls.iter().all(|b| b.centre.y == -0.04 && (depth(&stone(), b) - 0.01).abs() < 1e-15));
        let shifted = Rows { phase: 0.5, ..ROWS }.around_section(&stone()).unwrap();
        // Nine below, ten above, one beside them at either end.
        assert_eq!(shifted.len(), 9 + 10 + 2);
        let lowest = shifted.iter().map(|b| b.centre.z).fold(f64::INFINITY, f64::min);
        // On two balls, sqrt(3) r.
        assert!((lowest - (0.06 - 0.01 * (2.0 - 3.0_f64.sqrt()))).abs() < 1e-15);
    }

    #[test]
    fn leaning_faces_are_followed() {
        let wedge = Polyhedron::hexahedron([
            Vec3::new(0.0, 0.0, 0.0),
            Vec3::new(0.3, 0.0, 0.0),
            Vec3::new(0.3, 0.2, 0.0),
            Vec3::new(0.0, 0.2, 0.0),
            Vec3::new(0.05, 0.0, 0.15),
            Vec3::new(0.25, 0.0, 0.15),
            Vec3::new(0.25, 0.2, 0.15),
            Vec3::new(0.05, 0.2, 0.15),
        ]);
        let (whole, section) = (ROWS.around(&wedge).unwrap(), ROWS.around_section(&wedge).unwrap());
        assert!(whole.iter().chain(&section).all(|b| depth(&wedge, b) > 0.01 - 1e-12));
        // Every face is touched, in the section those that it crosses.
        let touched = |balls: &[Ball], f: usize| {
            balls.iter().filter(|b| (wedge.face_plane(f).distance(&b.centre) + 0.01).abs() < 1e-12).count()
        };
        assert!((0..6).all(|f| touched(&whole, f) > 20));
        assert_eq!((0..6).filter(|&f| touched(&section, f) > 5).count(), 4);
    }

    #[test]
    fn what_does_not_fit_is_said() {
        let thick = Rows { radius: 0.04, ..ROWS };
        for fault in [thick.around(&stone()), thick.around_section(&stone())] {
            let OutlineFault::TooThin { radius, width } = fault.unwrap_err() else {
                panic!("it is too thin")
            };
            assert!(radius == 0.04 && (width - 0.06).abs() < 1e-15);
        }
        let wide = Rows { spacing: 0.04, phase: 0.5, ..ROWS };
        assert!(matches!(wide.around(&stone()), Err(OutlineFault::TooWide { .. })));
        for rows in
            [Rows { radius: 0.0, ..ROWS }, Rows { spacing: f64::NAN, ..ROWS }, Rows { phase: 1.0, ..ROWS }]
        {
            assert!(matches!(rows.around(&stone()), Err(OutlineFault::Rows(_))), "{rows:?}");
        }
    }
}
