//! Which faces become one plane, and which.

use crate::math::Sets;
use crate::mend::ROUNDING;
use crate::mend::face::{Face, farthest, nearest_plane};
use crate::mend::link::Link;
use crate::shape::Plane;

/// What faces lie in when the wall is mended.
#[derive(Clone, Debug)]
pub struct Shared {
    /// The plane of each face, looking out of its block; `None` where it stays as it is.
    pub planes: Vec<Option<Plane>>,
    /// Pairs of faces that see each other within the tolerance and do not become one plane: it would lie further than the tolerance from a corner of
    /// those that are one already.
    pub parted: Vec<(usize, usize)>,
}

/// Puts linked faces into shared planes, the largest joints first, as long as no corner is further than `within` (m) from the plane of its
/// face.
pub fn shared_planes(faces: &[Face], links: Vec<Link>, within: f64) -> Shared {
    let mut sets = Sets::new(faces.len());
    for whole in components(faces.len(), &links) {
        // Usually all that hangs together is one bed, or one face of the wall.
        if fit(faces, &whole.faces, within).is_some() {
            whole.links.iter().for_each(|link| sets.join(link.faces));
            continue;
        }
        for link in whole.links {
            let (a, b) = (sets.root(link.faces.0), sets.root(link.faces.1));
            if a != b && fit(faces, &[sets.members(a), sets.members(b)].concat(), within).is_some() {
                sets.join((a, b));
            }
        }
    }
    let mut planes = vec![None; faces.len()];
    for set in sets.shared() {
        let plane = fit(faces, set, within).expect("it has been found before");
        for &member in set {
            let own = &faces[member];
            let turned = if plane.normal.dot(&own.plane.normal) < 0.0 { plane.flipped() } else { plane };
            planes[member] = Some(turned);
        }
    }
    let parted = links.iter().filter(|link| !link.is_slit).map(|link| link.faces);
    let parted = parted.filter(|(a, b)| sets.root(*a) != sets.root(*b)).collect();
    Shared { planes, parted }
}

/// The plane of some faces: that of the fixed ones among them, else that of the largest where all lie in it, else the nearest. `None` where a corner is
/// further than `within` (m) from it.
fn fit(faces: &[Face], members: &[usize], within: f64) -> Option<Plane> {
    let all: Vec<&Face> = members.iter().map(|member| &faces[*member]).collect();
    let reaches = |plane: &Plane, most: f64| all.iter().all(|face| farthest(face, plane) <= most);
    let fixed = all.iter().filter(|face| face.is_fixed);
    if let Some(first) = fixed.clone().next() {
        let is_one = fixed.clone().all(|face| farthest(face, &first.plane) <= ROUNDING * face.area.sqrt());
        return (is_one && reaches(&first.plane, within)).then_some(first.plane);
    }
    let largest = all.iter().fold(all[0], |best, face| if face.area > best.area { face } else { best });
    if all.iter().all(|face| farthest(face, &largest.plane) <= ROUNDING * face.area.sqrt()) {
        return Some(largest.plane);
    }
    nearest_plane(&all).filter(|plane| reaches(plane, within))
}

/// Faces that hang together by links, with these.
struct Component {
    faces: Vec<usize>,
    links: Vec<Link>,
}

fn components(count: usize, links: &[Link]) -> Vec<Component> {
    let mut sets = Sets::new(count);
    links.iter().for_each(|link| sets.join(link.faces));
    let mut place = vec![usize::MAX; count];
    let mut all: Vec<Component> = Vec::new();
    for link in links {
        let root = sets.root(link.faces.0);
        if place[root] == usize::MAX {
            place[root] = all.len();
            let mut faces = sets.members(root).to_vec();
            faces.sort_unstable();
            all.push(Component { faces, links: Vec::new() });
        }
        all[place[root]].links.push(*link);
    }
    all
}
