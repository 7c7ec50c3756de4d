//! Walls in three dimensions, to be turned and taken along their load path, from rest through the collapse. The page's script, view.js,
//! shows them.

use serde::Serialize;

use crate::math::Vec3;
use crate::model::{BuiltJoint, JointReading, Movement, Replay, ReplayState};
use crate::shape::Polyhedron;

/// The script with the library that it needs.
pub const VIEWER: &str = include_str!("solid/solid.min.js");
/// Lengths are given in micrometres and angles in microradians, as whole numbers: a small movement is magnified a thousand times and
/// more.
const FINE: f64 = 1e6;
/// Points of blocks and joints as built are given to a hundredth of a millimetre.
const COARSE: f64 = 1e5;
/// Pressures are given in pascals.
const PASCALS: f64 = 1.0;
/// Without being asked the largest movement at rest is drawn as this share of the wall's height.
const SHARE_OF_HEIGHT: f64 = 0.05;
/// Of several walls on a page, all but the first have so many states at most: it is to stay small enough to be sent.
const STATES_OF_OTHERS: usize = 50;

/// A wall that is shown.
#[derive(Clone, Copy, Debug)]
pub struct SolidWall<'w> {
    /// What it is called among others.
    pub name: &'w str,
    /// Its blocks as built (m).
    pub shapes: &'w [Polyhedron],
    /// Its states.
    pub replay: &'w Replay,
    /// Whether it is seen from its front (+y) at first.
    pub from_front: bool,
}

/// A figure in three dimensions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Solid {
    /// What links lead to it by; once in a page.
    pub id: String,
    /// What it shows.
    pub caption: String,
    /// Names of the walls that can be chosen.
    pub walls: Vec<String>,
    /// The walls as JSON: a list with an object each.
    pub data: String,
}

/// A wall, as the script takes it.
#[derive(Serialize)]
struct Data {
    from_front: bool,
    /// Whether the collapse is a mechanism that has no size.
    is_mechanism: bool,
    /// How many times a movement at rest is drawn at first.
    magnification: f64,
    blocks: Vec<Block>,
    joints: Vec<Joint>,
    states: Vec<State>,
}

/// A block where it was built.
#[derive(Serialize)]
struct Block {
    /// Whether it never moves.
    still: bool,
    /// Coordinates of its corners, one after the other.
    vertices: Vec<f64>,
    faces: Vec<Vec<u32>>,
    centroid: [f64; 3],
}

/// A joint where it was built, on the block that it moves with.
#[derive(Serialize)]
struct Joint {
    block: u32,
    polygon: Vec<f64>,
}

/// A state.
#[derive(Serialize)]
struct State {
    /// The load and whether the wall is at rest, in words.
    said: String,
    rest: bool,
    gone: Vec<u32>,
    /// Displacement and rotation vector of each block, six numbers.
    poses: Vec<i64>,
    /// Opening, slip and pressure of each joint, three numbers.
    joints: Vec<i64>,
}

impl Solid {
    /// A figure of some walls, of which one is shown at a time; `None` where none of them ever came to rest or fell.
    pub fn of(id: &str, caption: &str, walls: &[SolidWall<'_>]) -> Option<Solid> {
        let seen: Vec<&SolidWall<'_>> = walls.iter().filter(|wall| !wall.replay.states.is_empty()).collect();
        let most = |place: usize| if place == 0 { usize::MAX } else { STATES_OF_OTHERS };
        let all: Vec<Data> =
            seen.iter().enumerate().map(|(place, wall)| Data::of(wall, most(place))).collect();
        let data = serde_json::to_string(&all);
        crate::check!(data.is_ok(), "a wall is not finite: {data:?}");
        (!all.is_empty()).then(|| Solid {
            id: id.to_owned(),
            caption: caption.to_owned(),
            walls: seen.iter().map(|wall| wall.name.to_owned()).collect(),
            // The words of a state are ours; what a script ends with is none of them.
            data: data.unwrap_or_default(),
        })
    }
}

impl Data {
    fn of(wall: &SolidWall<'_>, most: usize) -> Data {
        let states = thinned(&wall.replay.states, most);
        let never = |id: usize| states.iter().all(|state| state.poses[id] == Movement::NONE);
        Data {
            from_front: wall.from_front,
            is_mechanism: wall.replay.is_mechanism,
            magnification: magnification(wall, &states),
            blocks: wall.shapes.iter().enumerate().map(|(id, shape)| Block::of(shape, never(id))).collect(),
            joints: wall.replay.joints.iter().map(Joint::of).collect(),
            states: states.iter().map(|state| State::of(state, wall.replay.said(state))).collect(),
        }
    }
}

/// At most so many of the states, evenly spread; the first one, the last one at rest and the last one of all are among them.
fn thinned(states: &[ReplayState], most: usize) -> Vec<&ReplayState> {
    let last_at_rest = states.iter().rposition(|state| state.is_equilibrium);
    let every = states.len().div_ceil(most.max(1));
    let kept = |place: &usize| {
        place.is_multiple_of(every) || Some(*place) == last_at_rest || place + 1 == states.len()
    };
    (0..states.len()).filter(kept).map(|place| &states[place]).collect()
}

/// What draws the largest movement at rest as a share of the wall's height; 1 where it is none, or larger. To two digits, so that it can
/// be said in words.
fn magnification(wall: &SolidWall<'_>, states: &[&ReplayState]) -> f64 {
    let at_rest = states.iter().filter(|state| state.is_equilibrium).flat_map(|state| &state.poses);
    let furthest = at_rest.map(|pose| pose.shift.norm()).fold(0.0, f64::max);
    let ends = wall.shapes.iter().map(Polyhedron::bounds);
    let (low, high) = ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (from, to)| {
        (low.min(from.z), high.max(to.z))
    });
    if furthest == 0.0 || wall.replay.is_mechanism || wall.replay.is_in_time() {
        return 1.0;
    }
    let exact = SHARE_OF_HEIGHT * (high - low) / furthest;
    format!("{exact:.1e}").parse().unwrap_or(exact).max(1.0)
}

fn coordinates(points: &[Vec3]) -> Vec<f64> {
    points.iter().flat_map(|v| [v.x, v.y, v.z]).map(|x| (x * COARSE).round() / COARSE).collect()
}

fn whole(x: f64, scale: f64) -> i64 {
    (x * scale).round() as i64
}

impl Block {
    fn of(shape: &Polyhedron, still: bool) -> Block {
        let centroid = shape.mass_properties().centroid;
        let rounded = |x: f64| (x * COARSE).round() / COARSE;
        Block {
            still,
            vertices: coordinates(&shape.vertices),
            faces: shape.faces.clone(),
            centroid: [centroid.x, centroid.y, centroid.z].map(rounded),
        }
    }
}

impl Joint {
    fn of(joint: &BuiltJoint) -> Joint {
        Joint { block: joint.blocks[0], polygon: coordinates(&joint.polygon) }
    }
}

impl State {
    fn of(state: &ReplayState, said: String) -> State {
        let pose = |Movement { shift, turn }: &Movement| {
            [shift.x, shift.y, shift.z, turn.x, turn.y, turn.z].map(|x| whole(x, FINE))
        };
        let joint = |own: &JointReading| {
            [whole(own.opening, FINE), whole(own.slip, FINE), whole(own.normal_stress, PASCALS)]
        };
        State {
            said,
            rest: state.is_equilibrium,
            gone: state.gone.clone(),
            poses: state.poses.iter().flat_map(pose).collect(),
            joints: state.joints.iter().flat_map(joint).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Level;
    use serde_json::Value;

    fn state(shift: f64, is_equilibrium: bool) -> ReplayState {
        ReplayState {
            level: Level::Factor(shift),
            is_equilibrium,
            poses: vec![Movement::NONE, Movement { shift: Vec3::y() * shift, turn: Vec3::x() * 1e-5 }],
            joints: vec![JointReading {
                opening: 2e-3,
                slip: 1e-6,
                normal_stress: 1234.4,
                shear_stress: 7.0,
            }],
            gone: Vec::new(),
        }
    }

    fn replay(at_rest: usize) -> Replay {
        let polygon = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]].map(|[x, y]| Vec3::new(x, y, 1.0)).to_vec();
        let joint = BuiltJoint {
            blocks: [0, 1],
            gaps: vec![0.0; 3],
            polygon,
            normal: Vec3::z(),
            middle: Vec3::z(),
            area: 0.5,
        };
        let mut states: Vec<_> = (0..at_rest).map(|k| state(1e-4 * k as f64, true)).collect();
        states.extend([state(0.1, false), state(0.4, false)]);
        Replay { joints: vec![joint], states, is_mechanism: false }
    }

    fn shapes() -> Vec<Polyhedron> {
        let at = |z: f64| Polyhedron::cuboid(Vec3::new(0.0, 0.0, z), Vec3::new(1.0, 1.0, z + 1.0));
        vec![at(0.0), at(1.0)]
    }

    fn data(walls: &[SolidWall<'_>]) -> Value {
        let solid = Solid::of("figure-solid", "Walls.", walls).expect("there are states");
        serde_json::from_str(&solid.data).expect("it is JSON")
    }

    #[test]
    fn states_are_whole_numbers_of_micrometres_and_pascals() {
        let (shapes, replay) = (shapes(), replay(3));
        let all = data(&[SolidWall { name: "only", shapes: &shapes, replay: &replay, from_front: true }]);
        let wall = &all[0];
        assert_eq!((&wall["blocks"][0]["still"], &wall["blocks"][1]["still"]), (&true.into(), &false.into()));
        assert_eq!(wall["states"].as_array().map(Vec::len), Some(5));
        let second = &wall["states"][1];
        assert_eq!(second["said"], "at rest at load factor 0.0001");
        assert_eq!(second["poses"], serde_json::json!([0, 0, 0, 0, 0, 0, 0, 100, 0, 10, 0, 0]));
        assert_eq!(second["joints"], serde_json::json!([2000, 1, 1234]));
        let said = wall["states"][4]["said"].as_str().unwrap_or_default();
        assert!(said.ends_with("beyond the limit at load factor 0.0002"), "{said}");
        // 0.2 mm at rest are drawn as a twentieth of 2 m.
        assert_eq!(wall["magnification"], 500.0);
    }

    #[test]
    fn walls_beside_the_first_have_fewer_states_and_their_ends() {
        let (shapes, long) = (shapes(), replay(98));
        let wall = |name| SolidWall { name, shapes: &shapes, replay: &long, from_front: false };
        let all = data(&[wall("weakest"), wall("median")]);
        let count = |of: &Value| of["states"].as_array().map_or(0, Vec::len);
        assert_eq!(count(&all[0]), 100);
        // Every second one, the last one at rest and the last one of all.
        assert_eq!(count(&all[1]), 52);
        assert_eq!(all[1]["states"][51], all[0]["states"][99]);
        let empty = Replay::default();
        assert_eq!(Solid::of("a", "b", &[SolidWall { replay: &empty, ..wall("none") }]), None);
    }

    /// The budget of a page that is sent: 200 stones in 100 states within 5 MB, viewer and all.
    #[test]
    fn two_hundred_stones_in_a_hundred_states_fit_into_five_megabytes() {
        let shapes: Vec<Polyhedron> = (0..200).flat_map(|_| shapes()).take(200).collect();
        let small = replay(1);
        let joint = |k: u32| BuiltJoint { blocks: [k % 200, (k + 1) % 200], ..small.joints[0].clone() };
        let reading =
            JointReading { opening: 0.123_456, slip: 0.098_765, normal_stress: 123_456.0, shear_stress: 0.0 };
        let pose = Movement {
            shift: Vec3::new(-0.123_456, 0.234_567, -0.345_678),
            turn: Vec3::new(0.1, 0.2, 0.3) * 1.234_567,
        };
        let one =
            ReplayState { poses: vec![pose; 200], joints: vec![reading; 700], ..small.states[0].clone() };
        let replay =
            Replay { joints: (0..700).map(joint).collect(), states: vec![one; 100], is_mechanism: false };
        let wall = SolidWall { name: "only", shapes: &shapes, replay: &replay, from_front: true };
        let solid = Solid::of("figure-solid", "A wall.", &[wall]).expect("there are states");
        let bytes = solid.data.len() + VIEWER.len();
        assert!(bytes < 5_000_000, "{bytes}");
    }
}
