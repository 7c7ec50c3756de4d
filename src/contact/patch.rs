//! The patch where two blocks touch: a polygon on a face of one and a plane of the other.
//!
//! The block whose face carries the polygon is the incident one; the other, whose plane gives the direction of the
//! pressure, is the reference. The gap between them is affine over the polygon, so the compressed zone is the
//! polygon clipped by a straight line. Blocks that meet at a steep angle, edge to edge or corner to face touch in a
//! patch of stated width instead: a strip along an edge, a square at a point.

use crate::contact::{Cell, EdgeAxis, FaceAxis, best_edge_axis, best_face_axis, patches, seated};
use crate::math::Vec3;
use crate::shape::{Frame, Plane, Polygon, Polyhedron};

/// Cosine of the largest angle between faces that touch as faces, where nothing else is asked for: 20 degrees.
pub const FACE_COSINE: f64 = 0.939_692_620_785_908_4;

/// Settings of contact detection, all lengths in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Pairs with a gap up to this are joints (open ones); blocks are looked at anew before they have moved by half.
    pub reach: f64,
    /// Faces press from this distance on, so that faces that were built touching touch in every frame, whatever rounding
    /// does to them; the pressure grows from zero there.
    pub touch: f64,
    /// Faces that are built no further apart than this touch. What is built further apart carries nothing until it has closed,
    /// within the reach or not.
    pub closed: f64,
    /// Width of the strip or square in which steep contacts touch: its area is width x edge length, or width^2.
    pub steep_width: f64,
    /// Cosine of the largest angle between two faces that touch as faces.
    pub face_cosine: f64,
    /// Sub-contacts along the longer and the shorter extent of a joint.
    pub sub_contacts: [u32; 2],
    /// Width (m, default 0) of the rounded or chipped arris: faces touch only where they are further than this from their
    /// own edges. A joint that is nowhere so wide is none. Strips and squares of steep contacts are not narrowed.
    pub inset: f64,
}

impl Settings {
    /// Settings for stones of a typical size (m): reach 0.5 %, touch 1e-11, closed 1e-9 and steep width 20 % of it; faces up to 20
    /// degrees apart touch as faces. Corners that are computed are off by some 1e-15 of the wall, more where planes meet at a small
    /// angle, and no mason states a gap of a billionth of a stone. A narrower strip would let a stone sink into its neighbour: at 1e8
    /// Pa/m a square of 20 % carries a stone of 0.2 m with 1 mm of closure.
    pub fn for_size(size: f64, sub_contacts: [u32; 2]) -> Self {
        Settings {
            reach: 5e-3 * size,
            touch: 1e-11 * size,
            closed: 1e-9 * size,
            steep_width: 0.2 * size,
            face_cosine: FACE_COSINE,
            sub_contacts,
            inset: 0.0,
        }
    }

    /// By how much an axis must be better (m) before it replaces the preferred one.
    fn preference(&self) -> f64 {
        0.1 * self.reach
    }
}

/// Which features of the two blocks meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feature {
    /// Face of the incident block, face of the reference block.
    Faces(u32, u32),
    /// An edge or a corner of the incident block, face of the reference block.
    Steep(u32, u32),
    /// Two crossing edges.
    Edges([u32; 2], [u32; 2]),
}

/// Where and how two blocks touch, in world coordinates at the time of detection.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    /// Whether the second block of the pair is the reference (and the first the incident one).
    pub reference_is_second: bool,
    /// Frame of the polygon: material to the incident block, normal pointing out of it.
    pub frame: Frame,
    /// The polygon, counter-clockwise in the frame's (s, t) coordinates.
    pub polygon: Polygon,
    /// The frame of the other face, which looks at it, where that is the first block's: what is uneven on a joint lies on that
    /// block, so that it stays where it is when the two change their roles.
    pub uneven: Option<Frame>,
    /// Plane of the reference block, normal pointing out of it.
    pub plane: Plane,
    /// The features that meet.
    pub feature: Feature,
}

impl Patch {
    /// The gap between the faces (m) where it is narrowest, negative where they overlap, and where it is widest.
    pub fn gaps(&self) -> [f64; 2] {
        // The gap is affine over the patch: it is narrowest and widest at a corner.
        let gaps = self.polygon.vertices.iter().map(|st| self.plane.distance(&self.frame.lift(*st)));
        gaps.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], gap| [low.min(gap), high.max(gap)])
    }

    /// The part of an outline on it where the gap is at most `closed` (m).
    pub fn touching(&self, outline: &Polygon, closed: f64) -> Polygon {
        let (frame, normal) = (&self.frame, &self.plane.normal);
        let gap = self.plane.distance(&frame.origin);
        outline.clip(gap - closed, normal.dot(&frame.s), normal.dot(&frame.t))
    }

    /// Those of its `along` by `along` cells, eight at most, on the first block's face whose bit is set (`along i + j` for the cell
    /// `i` along its first and `j` along its second axis), in the coordinates of its polygon.
    pub fn pieces(&self, along: u32, mask: u64) -> Vec<Cell> {
        self.on_first(|polygon| patches(polygon, along, mask))
    }

    /// What bears on the first block's face, in the coordinates of its polygon: a patch about each seat that is at most `deepest` (m) behind the
    /// face. A seat is where it lies, as uniform numbers, and how far behind the face (m); all patches have `share` of the area. `None` where it
    /// is no bed.
    pub fn seats(
        &self,
        share: f64,
        seats: impl Iterator<Item = ([f64; 2], f64)> + Clone,
        deepest: f64,
    ) -> Option<Vec<Cell>> {
        let mut cells =
            self.is_bed().then(|| self.on_first(|polygon| seated(polygon, share, seats.clone())))?;
        cells.retain(|cell| cell.recess <= deepest);
        Some(cells)
    }

    /// Whether it is a joint of two faces that lie closer to the level than to the upright.
    fn is_bed(&self) -> bool {
        const STEEPEST: f64 = std::f64::consts::FRAC_1_SQRT_2;
        matches!(self.feature, Feature::Faces(..)) && self.plane.normal.z.abs() >= STEEPEST
    }

    /// Cells of the patch as it lies on the first block's face, in the coordinates of its polygon.
    fn on_first(&self, divided: impl Fn(&Polygon) -> Vec<Cell>) -> Vec<Cell> {
        let Some(uneven) = &self.uneven else { return divided(&self.polygon) };
        let there = |v: &[f64; 2]| uneven.project(&self.frame.lift(*v));
        let back = |v: &[f64; 2]| {
            let p = uneven.lift(*v);
            let away =
                self.frame.normal.dot(&(self.frame.origin - p)) / self.frame.normal.dot(&uneven.normal);
            self.frame.project(&(p + uneven.normal * away))
        };
        // What runs counter-clockwise here runs clockwise there.
        let over = |polygon: &Polygon, onto: &dyn Fn(&[f64; 2]) -> [f64; 2]| Polygon {
            vertices: polygon.vertices.iter().rev().map(onto).collect(),
        };
        let cells = divided(&over(&self.polygon, &there));
        let lifted = |cell: &Cell| Cell { recess: cell.recess, ..Cell::within(over(&cell.outline, &back)) };
        cells.iter().map(lifted).collect()
    }
}

/// Finds the patch between two blocks, or `None` when they are further apart than the reach or share no area.
///
/// `first` is the preferred reference block: it stays the reference unless the second's face separates clearly better.
pub fn find_patch(first: &Polyhedron, second: &Polyhedron, settings: &Settings) -> Option<Patch> {
    let axis = best_face_axis(first, second, settings.reach, settings.preference())?;
    let (meeting, cosine) = Meeting::of(first, second, &axis, settings);
    // Faces that lie on one another are a face contact whatever their edges do: a joint that leans open has crossing
    // edges which separate better than either face.
    let faces_meet = cosine >= settings.face_cosine;
    if faces_meet {
        match meeting.face_patch() {
            Overlap::Patch(patch) => return Some(*patch),
            Overlap::Worn => return None,
            Overlap::None => {}
        }
    }
    match best_edge_axis(first, second, axis.depth + settings.preference()) {
        Some(edges) if edges.depth > settings.reach => None,
        Some(edges) => edge_patch(first, second, edges, settings),
        None if faces_meet => None,
        None => meeting.steep_patch(),
    }
}

/// The patch that two faces which look at each other across at most `within` (m) would share if they met, like that of
/// [`find_patch`] on faces; `None` where none do.
pub fn facing(first: &Polyhedron, second: &Polyhedron, within: f64, settings: &Settings) -> Option<Patch> {
    let axis = best_face_axis(first, second, within, settings.preference())?;
    let (meeting, cosine) = Meeting::of(first, second, &axis, settings);
    match meeting.face_patch() {
        Overlap::Patch(patch) if cosine >= settings.face_cosine => Some(*patch),
        _ => None,
    }
}

/// What two faces share.
enum Overlap {
    /// An area to press on.
    Patch(Box<Patch>),
    /// An area that lies within the inset of an edge: no joint at all, not one of edges either.
    Worn,
    /// No area.
    None,
}

/// A face of the reference block and the face of the incident block that looks at it most squarely.
struct Meeting<'a> {
    reference: &'a Polyhedron,
    face: usize,
    /// Plane of the reference face.
    plane: Plane,
    incident: &'a Polyhedron,
    opposite: usize,
    reference_is_second: bool,
    settings: &'a Settings,
}

impl<'a> Meeting<'a> {
    /// The face that separates two blocks best, the face that looks at it most squarely, and the cosine of the angle between them.
    fn of(
        first: &'a Polyhedron,
        second: &'a Polyhedron,
        axis: &FaceAxis,
        settings: &'a Settings,
    ) -> (Self, f64) {
        let (reference, incident) = if axis.of_second { (second, first) } else { (first, second) };
        let plane = reference.face_plane(axis.face);
        let (opposite, cosine) = (0..incident.faces.len())
            .map(|f| (f, -incident.face_plane(f).normal.dot(&plane.normal)))
            .fold((0, f64::NEG_INFINITY), |best, next| if next.1 > best.1 { next } else { best });
        let reference_is_second = axis.of_second;
        let face = axis.face;
        (Meeting { reference, face, plane, incident, opposite, reference_is_second, settings }, cosine)
    }

    /// The overlap of the two faces, each without its arrises.
    fn face_patch(&self) -> Overlap {
        let frame = face_frame(self.incident, self.opposite);
        // Both outlines along the reference normal into the incident plane, in its coordinates.
        let onto = |p: Vec3| {
            let shift = frame.normal.dot(&(frame.origin - p)) / frame.normal.dot(&self.plane.normal);
            frame.project(&(p + self.plane.normal * shift))
        };
        let own: Vec<[f64; 2]> =
            self.incident.face_vertices(self.opposite).map(|p| frame.project(&p)).collect();
        // Seen from the incident face the reference face runs clockwise.
        let mut other: Vec<[f64; 2]> = self.reference.face_vertices(self.face).map(onto).collect();
        other.reverse();
        let (own, other) = (Polygon { vertices: own }, Polygon { vertices: other });
        let least = self.settings.reach * self.settings.reach;
        let counts = |polygon: &Polygon| polygon.vertices.len() >= 3 && polygon.area() >= least;
        let whole = own.intersection(&other);
        if !counts(&whole) {
            return Overlap::None;
        }
        let polygon = match self.settings.inset {
            0.0 => whole,
            inset => shared(&inner(&own, inset), &inner(&other, inset)),
        };
        if !counts(&polygon) {
            return Overlap::Worn;
        }
        let feature = Feature::Faces(self.opposite as u32, self.face as u32);
        let uneven = (!self.reference_is_second).then(|| face_frame(self.reference, self.face));
        Overlap::Patch(Box::new(Patch { uneven, ..self.patch(frame, polygon, feature) }))
    }

    /// A corner or an edge of the incident block on the reference face, too steep to touch as faces.
    fn steep_patch(&self) -> Option<Patch> {
        let depth = |v: &Vec3| self.plane.distance(v);
        let vertices = &self.incident.vertices;
        let lowest = (0..vertices.len())
            .fold(0, |best, i| if depth(&vertices[i]) < depth(&vertices[best]) { i } else { best });
        let start = vertices[lowest];
        let half = 0.5 * self.settings.steep_width;
        let (s, range) = match self.lying_edge(lowest) {
            Some(end) => {
                let along = end - self.plane.normal * (depth(&end) - depth(&start)) - start;
                let (s, length) = (along.normalize(), along.norm());
                (s, clip_line(self.reference, self.face, &self.plane, start, s, length)?)
            }
            None => {
                let s = any_tangent(&self.plane.normal);
                clip_line(self.reference, self.face, &self.plane, start, s, 0.0)?;
                (s, (-half, half))
            }
        };
        let normal = -self.plane.normal;
        let frame = Frame { origin: start, s, t: normal.cross(&s), normal };
        let vertices = vec![[range.0, -half], [range.1, -half], [range.1, half], [range.0, half]];
        Some(self.patch(frame, Polygon { vertices }, Feature::Steep(lowest as u32, self.face as u32)))
    }

    /// The other end of an edge of the opposite face that starts at this vertex and lies on the reference face within
    /// about a degree (sine below 0.02).
    fn lying_edge(&self, vertex: usize) -> Option<Vec3> {
        let f = &self.incident.faces[self.opposite];
        let start = self.incident.vertices[vertex];
        f.iter().enumerate().find_map(|(i, &v)| {
            let next = f[(i + 1) % f.len()];
            let other = match vertex as u32 {
                x if x == v => next,
                x if x == next => v,
                _ => return None,
            };
            let end = self.incident.vertices[other as usize];
            let rise = self.plane.distance(&end) - self.plane.distance(&start);
            (rise < 0.02 * (end - start).norm()).then_some(end)
        })
    }

    fn patch(&self, frame: Frame, polygon: Polygon, feature: Feature) -> Patch {
        let (reference_is_second, plane) = (self.reference_is_second, self.plane);
        Patch { reference_is_second, frame, polygon, uneven: None, plane, feature }
    }
}

/// The part shared by two polygons that may be empty.
fn shared(a: &Polygon, b: &Polygon) -> Polygon {
    if b.vertices.len() < 3 { Polygon::default() } else { a.intersection(b) }
}

/// The part of a counter-clockwise convex polygon that is at least `inset` (m) away from all its edges.
fn inner(polygon: &Polygon, inset: f64) -> Polygon {
    let n = polygon.vertices.len();
    let mut part = polygon.clone();
    for (i, a) in polygon.vertices.iter().enumerate() {
        let b = polygon.vertices[(i + 1) % n];
        let (ex, ey) = (b[0] - a[0], b[1] - a[1]);
        // Distance from the edge, positive on its left, is cross(b - a, v - a) / |b - a|.
        let length = (ex * ex + ey * ey).sqrt();
        part = part.clip(ex * a[1] - ey * a[0] + inset * length, ey, -ex);
    }
    part
}

/// The material frame of a face: origin at the mean of its vertices, s along its first edge.
fn face_frame(solid: &Polyhedron, face: usize) -> Frame {
    let plane = solid.face_plane(face);
    let f = &solid.faces[face];
    let origin = solid.face_vertices(face).sum::<Vec3>() / f.len() as f64;
    let edge = solid.vertices[f[1] as usize] - solid.vertices[f[0] as usize];
    let s = (edge - plane.normal * edge.dot(&plane.normal)).normalize();
    Frame { origin, s, t: plane.normal.cross(&s), normal: plane.normal }
}

/// The part of the segment `start + [0, length] direction` above a face, as a range along it; `None` if it misses.
fn clip_line(
    solid: &Polyhedron,
    face: usize,
    plane: &Plane,
    start: Vec3,
    direction: Vec3,
    length: f64,
) -> Option<(f64, f64)> {
    let (mut low, mut high) = (0.0f64, length);
    let corners: Vec<Vec3> = solid.face_vertices(face).collect();
    for (i, corner) in corners.iter().enumerate() {
        let inward = plane.normal.cross(&(corners[(i + 1) % corners.len()] - corner));
        let (at_start, slope) = (inward.dot(&(start - corner)), inward.dot(&direction));
        if slope > 0.0 {
            low = low.max(-at_start / slope);
        } else if slope < 0.0 {
            high = high.min(-at_start / slope);
        } else if at_start < 0.0 {
            return None;
        }
        if length == 0.0 && at_start < 0.0 {
            return None;
        }
    }
    (length == 0.0 || low < high).then_some((low, high.min(length)))
}

/// Two crossing edges: a square of the stated width at the middle of their shortest connection.
fn edge_patch(
    first: &Polyhedron,
    second: &Polyhedron,
    edges: EdgeAxis,
    settings: &Settings,
) -> Option<Patch> {
    let (ea, eb) = (edges.first, edges.second);
    let at = |solid: &Polyhedron, v: u32| solid.vertices[v as usize];
    let (p, u) = (at(first, ea[0]), at(first, ea[1]) - at(first, ea[0]));
    let (q, v) = (at(second, eb[0]), at(second, eb[1]) - at(second, eb[0]));
    let normal = edges.normal;
    // Nearest points of the two lines.
    let (uu, uv, vv, w) = (u.dot(&u), u.dot(&v), v.dot(&v), q - p);
    let det = uu * vv - uv * uv;
    let along_u = (w.dot(&u) * vv - w.dot(&v) * uv) / det;
    let along_v = (w.dot(&u) * uv - w.dot(&v) * uu) / det;
    if !(0.0..=1.0).contains(&along_u) || !(0.0..=1.0).contains(&along_v) {
        return None;
    }
    let (on_first, on_second) = (p + u * along_u, q + v * along_v);
    // The second block is incident: the polygon hangs on its edge, facing the first.
    let out = -normal;
    let s = v.normalize();
    let frame = Frame { origin: on_second, s, t: out.cross(&s), normal: out };
    let half = 0.5 * settings.steep_width;
    let polygon = Polygon { vertices: vec![[-half, -half], [half, -half], [half, half], [-half, half]] };
    let plane = Plane::through(on_first, normal);
    let feature = Feature::Edges(ea, eb);
    Some(Patch { reference_is_second: false, frame, polygon, uneven: None, plane, feature })
}

/// Some unit vector in the plane with this normal.
fn any_tangent(normal: &Vec3) -> Vec3 {
    Frame::on_plane(Vec3::zeros(), *normal).s
}
