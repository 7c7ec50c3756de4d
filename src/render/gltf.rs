//! A wall that moves as binary glTF 2.0 (`.glb`), for browsers, viewers and slides: one mesh per block, one animation over all states of
//! its replay.
//!
//! Blocks keep their shape: each is a node with a translation and a rotation, and between two key frames a viewer turns it about one
//! axis, which is how a mechanism turns it. A block that has fallen out shrinks to nothing. Numbers are of single precision, as the format has it, and a root node turns our upward z
//! to its upward y.

use std::collections::BTreeMap;

use gltf_json::accessor::{ComponentType, GenericComponentType, Type};
use gltf_json::animation::{Channel, Interpolation, Property, Sampler, Target};
use gltf_json::buffer::{self, View};
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::scene::UnitQuaternion;
use gltf_json::validation::{Checked::Valid, USize64};
use gltf_json::{Accessor, Animation, Buffer, Index, Material, Mesh, Node, Root, Scene};
use nalgebra::Quaternion;

use crate::math::{Vec3, cos, sin};
use crate::model::{Movement, Replay};
use crate::shape::Polyhedron;

/// For how long a viewer shows the states at rest, and for how long the fall (s).
const RESTS: f64 = 4.0;
const FALLS: f64 = 4.0;
/// A quarter turn about x, backwards: from z upwards to y upwards.
const UPRIGHT: [f32; 4] = [-std::f32::consts::FRAC_1_SQRT_2, 0.0, 0.0, std::f32::consts::FRAC_1_SQRT_2];

/// What a block is, for its colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Role {
    /// It is held.
    Fixed,
    /// It stands.
    Standing,
    /// It takes part in the mechanism.
    Moving,
}

impl Role {
    const ALL: [Role; 3] = [Role::Fixed, Role::Standing, Role::Moving];

    /// Name and colour (linear RGB).
    fn look(self) -> (&'static str, [f32; 3]) {
        match self {
            Role::Fixed => ("fixed", [0.25, 0.25, 0.25]),
            Role::Standing => ("standing", [0.55, 0.52, 0.46]),
            Role::Moving => ("moving", [0.80, 0.35, 0.08]),
        }
    }
}

/// A block of the animation.
pub struct Actor<'a> {
    /// Its name in the viewer.
    pub name: String,
    /// Its shape as built (m).
    pub shape: &'a Polyhedron,
    /// What it is.
    pub role: Role,
}

/// The file: the blocks, by id, in all states of their wall's replay, their movements times `magnification`. The states at rest take the
/// first four seconds, evenly, and those of the fall the four seconds from the last one at rest on. What is followed in time is shown in time.
pub fn write_glb(title: &str, actors: &[Actor], replay: &Replay, magnification: f64) -> Vec<u8> {
    let mut file = File::new();
    let materials: BTreeMap<Role, Index<Material>> =
        Role::ALL.into_iter().map(|role| (role, file.material(role))).collect();
    let times = file.accessor(&times(replay), Type::Scalar, None);
    let mut animation = Animation {
        channels: Vec::new(),
        samplers: Vec::new(),
        name: Some("replay".to_owned()),
        extensions: None,
        extras: Default::default(),
    };
    let mut nodes = Vec::new();
    for (id, Actor { name, shape, role }) in actors.iter().enumerate() {
        let mesh = file.mesh(name, shape, materials[role]);
        let centroid = shape.mass_properties().centroid;
        let node = file.root.push(Node {
            mesh: Some(mesh),
            name: Some(name.clone()),
            translation: Some([centroid.x, centroid.y, centroid.z].map(|x| x as f32)),
            ..Node::default()
        });
        nodes.push(node);
        let poses: Vec<Movement> =
            replay.states.iter().map(|state| state.poses[id].times(magnification)).collect();
        let mut channel = |path, interpolation, output| {
            let sampler = Sampler {
                input: times,
                interpolation: Valid(interpolation),
                output,
                extensions: None,
                extras: Default::default(),
            };
            let sampler = Index::push(&mut animation.samplers, sampler);
            let target = Target { node, path: Valid(path), extensions: None, extras: Default::default() };
            animation.channels.push(Channel {
                sampler,
                target,
                extensions: None,
                extras: Default::default(),
            });
        };
        if poses.iter().any(|pose| *pose != Movement::NONE) {
            let places: Vec<[f64; 3]> = poses.iter().map(|pose| (centroid + pose.shift).into()).collect();
            let places = file.accessor(&places, Type::Vec3, None);
            channel(Property::Translation, Interpolation::Linear, places);
            let turns = file.accessor(&turns(&poses), Type::Vec4, None);
            channel(Property::Rotation, Interpolation::Linear, turns);
        }
        let gone = |at: usize| replay.states[at].gone.binary_search(&(id as u32)).is_ok();
        if (0..poses.len()).any(gone) {
            let sizes: Vec<[f64; 3]> =
                (0..poses.len()).map(|at| if gone(at) { [0.0; 3] } else { [1.0; 3] }).collect();
            let sizes = file.accessor(&sizes, Type::Vec3, None);
            channel(Property::Scale, Interpolation::Step, sizes);
        }
    }
    file.finish(title, nodes, animation)
}

/// When each state is shown (s).
fn times(replay: &Replay) -> Vec<[f64; 1]> {
    if replay.is_in_time() {
        return replay.states.iter().map(|state| [state.level.value()]).collect();
    }
    let rests = replay.states.iter().filter(|state| state.is_equilibrium).count();
    let falls = replay.states.len() - rests;
    let last = if rests > 1 { RESTS } else { 0.0 };
    let at = |number: usize| match number < rests {
        true => last * number as f64 / (rests.max(2) - 1) as f64,
        // A fall without any rest before it begins at once.
        false => last + FALLS * (number - rests + usize::from(rests > 0)) as f64 / falls as f64,
    };
    (0..replay.states.len()).map(|number| [at(number)]).collect()
}

/// How a block is turned (quaternions, their scalars last), each the shorter way from the one before.
fn turns(poses: &[Movement]) -> Vec<[f64; 4]> {
    let mut before = Quaternion::identity();
    let turn = |pose: &Movement| {
        let own = rotation(&pose.turn);
        before = if own.dot(&before) < 0.0 { -own } else { own };
        [before.i, before.j, before.k, before.w]
    };
    poses.iter().map(turn).collect()
}

/// A rotation vector (rad) as a quaternion.
fn rotation(turn: &Vec3) -> Quaternion<f64> {
    let angle = turn.norm();
    if angle == 0.0 {
        return Quaternion::identity();
    }
    let axis = turn * (sin(0.5 * angle) / angle);
    Quaternion::new(cos(0.5 * angle), axis.x, axis.y, axis.z)
}

/// A file in the making: what is described, and the numbers.
struct File {
    root: Root,
    bytes: Vec<u8>,
}

impl File {
    fn new() -> File {
        let mut root = Root::default();
        root.asset.generator = Some(format!("pirca {}", env!("CARGO_PKG_VERSION")));
        // The one buffer is what follows the description; its length is known at the end.
        root.push(Buffer {
            byte_length: USize64(0),
            name: None,
            uri: None,
            extensions: None,
            extras: Default::default(),
        });
        File { root, bytes: Vec::new() }
    }

    fn material(&mut self, role: Role) -> Index<Material> {
        let (name, [red, green, blue]) = role.look();
        let mut material = Material { name: Some(name.to_owned()), ..Material::default() };
        material.pbr_metallic_roughness.base_color_factor.0 = [red, green, blue, 1.0];
        material.pbr_metallic_roughness.metallic_factor.0 = 0.0;
        material.pbr_metallic_roughness.roughness_factor.0 = 0.9;
        self.root.push(material)
    }

    /// Numbers in rows, with the least and the greatest of each column.
    fn accessor<const N: usize>(
        &mut self,
        rows: &[[f64; N]],
        kind: Type,
        of: Option<buffer::Target>,
    ) -> Index<Accessor> {
        let rows: Vec<[f32; N]> = rows.iter().map(|row| row.map(|x| x as f32)).collect();
        let start = self.bytes.len();
        rows.iter().flatten().for_each(|x| self.bytes.extend(x.to_le_bytes()));
        let view = self.root.push(View {
            buffer: Index::new(0),
            byte_length: USize64::from(self.bytes.len() - start),
            byte_offset: Some(USize64::from(start)),
            byte_stride: None,
            name: None,
            target: of.map(Valid),
            extensions: None,
            extras: Default::default(),
        });
        let column = |of: fn(f32, f32) -> f32| {
            let ends: Vec<f32> =
                (0..N).map(|at| rows.iter().map(|row| row[at]).reduce(of).unwrap_or(0.0)).collect();
            Some(serde_json::json!(ends))
        };
        self.root.push(Accessor {
            buffer_view: Some(view),
            byte_offset: None,
            count: USize64::from(rows.len()),
            component_type: Valid(GenericComponentType(ComponentType::F32)),
            type_: Valid(kind),
            min: column(f32::min),
            max: column(f32::max),
            name: None,
            normalized: false,
            sparse: None,
            extensions: None,
            extras: Default::default(),
        })
    }

    /// The block about its centroid: triangles with the normals of their faces, so that edges stay sharp.
    fn mesh(&mut self, name: &str, shape: &Polyhedron, material: Index<Material>) -> Index<Mesh> {
        let centroid = shape.mass_properties().centroid;
        let (mut corners, mut normals) = (Vec::new(), Vec::new());
        for face in &shape.faces {
            let at = |k: usize| shape.vertices[face[k] as usize] - centroid;
            for k in 1..face.len() - 1 {
                let triangle = [at(0), at(k), at(k + 1)];
                let normal = (triangle[1] - triangle[0]).cross(&(triangle[2] - triangle[0])).normalize();
                for corner in triangle {
                    corners.push([corner.x, corner.y, corner.z]);
                    normals.push([normal.x, normal.y, normal.z]);
                }
            }
        }
        let vertices = Some(buffer::Target::ArrayBuffer);
        let attributes = BTreeMap::from([
            (Valid(Semantic::Positions), self.accessor(&corners, Type::Vec3, vertices)),
            (Valid(Semantic::Normals), self.accessor(&normals, Type::Vec3, vertices)),
        ]);
        let primitive = Primitive {
            attributes,
            indices: None,
            material: Some(material),
            mode: Valid(Mode::Triangles),
            targets: None,
            extensions: None,
            extras: Default::default(),
        };
        self.root.push(Mesh {
            primitives: vec![primitive],
            weights: None,
            name: Some(name.to_owned()),
            extensions: None,
            extras: Default::default(),
        })
    }

    /// The bytes of the file: a header, the description padded by blanks, the numbers, which come in fours.
    fn finish(mut self, title: &str, blocks: Vec<Index<Node>>, animation: Animation) -> Vec<u8> {
        let wall = self.root.push(Node {
            children: Some(blocks),
            rotation: Some(UnitQuaternion(UPRIGHT)),
            name: Some(title.to_owned()),
            ..Node::default()
        });
        let scene = self.root.push(Scene {
            nodes: vec![wall],
            name: Some(title.to_owned()),
            extensions: None,
            extras: Default::default(),
        });
        self.root.scene = Some(scene);
        if !animation.channels.is_empty() {
            self.root.push(animation);
        }
        self.root.buffers[0].byte_length = USize64::from(self.bytes.len());
        let mut json =
            serde_json::to_vec(&self.root).expect("a description has string keys and finite numbers only");
        json.resize(json.len().next_multiple_of(4), b' ');
        let mut file = Vec::new();
        file.extend(b"glTF");
        let length = 12 + 8 + json.len() + 8 + self.bytes.len();
        [2, length as u32].iter().for_each(|number| file.extend(number.to_le_bytes()));
        for (kind, chunk) in [(b"JSON", &json), (b"BIN\0", &self.bytes)] {
            file.extend((chunk.len() as u32).to_le_bytes());
            file.extend(kind);
            file.extend(chunk);
        }
        file
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::radians;
    use crate::model::{Level, ReplayState};
    use gltf_json::validation::Validate;
    use std::f64::consts::FRAC_PI_2;

    /// The description and the numbers of a file, which is valid glTF.
    fn parts(file: &[u8]) -> (Root, Vec<f32>) {
        let number =
            |at: usize| u32::from_le_bytes(file[at..at + 4].try_into().expect("four bytes")) as usize;
        assert_eq!((&file[..4], number(4), number(8)), (&b"glTF"[..], 2, file.len()));
        let json = number(12);
        assert_eq!((&file[16..20], json % 4), (&b"JSON"[..], 0));
        let root: Root = serde_json::from_slice(&file[20..20 + json]).expect("a description");
        root.validate(&root, gltf_json::Path::new, &mut |path, error| panic!("{}: {error}", path()));
        assert_eq!((number(20 + json), &file[24 + json..28 + json]), (file.len() - 28 - json, &b"BIN\0"[..]));
        let numbers =
            file[28 + json..].chunks(4).map(|four| f32::from_le_bytes(four.try_into().expect("four")));
        (root, numbers.collect())
    }

    /// A block that sinks to rest, then moves and turns by a quarter turn while the one under it, which is held, is still, and a third
    /// one falls out before.
    fn replay() -> Replay {
        let sunk = Movement { shift: Vec3::new(0.0, 0.0, -0.01), turn: Vec3::zeros() };
        let fallen = Movement { shift: Vec3::new(0.0, 0.2, -0.01), turn: Vec3::new(-FRAC_PI_2, 0.0, 0.0) };
        let state = |is_equilibrium, second, gone| ReplayState {
            level: Level::Tilt(0.1),
            is_equilibrium,
            poses: vec![Movement::NONE, second, Movement::NONE],
            joints: Vec::new(),
            gone,
        };
        let states = vec![
            state(true, Movement::NONE, vec![]),
            state(true, sunk, vec![2]),
            state(false, fallen, vec![2]),
        ];
        Replay { states, ..Replay::default() }
    }

    #[test]
    fn a_block_goes_to_rest_and_turns_from_there_about_one_axis() {
        let shape = Polyhedron::cuboid(Vec3::new(0.0, 0.0, 0.0), Vec3::new(0.2, 0.2, 0.4));
        let actor = |name: &str, role| Actor { name: name.to_owned(), shape: &shape, role };
        let actors = [actor("0", Role::Fixed), actor("1", Role::Moving), actor("2", Role::Standing)];
        let (root, numbers) = parts(&write_glb("tower", &actors, &replay(), 1.0));
        let channels = &root.animations[0].channels;
        // The one that is held has none.
        let nodes: Vec<usize> = channels.iter().map(|channel| channel.target.node.value()).collect();
        assert_eq!((nodes, root.meshes.len(), root.nodes.len()), (vec![1, 1, 2], 3, 4));
        let numbers_of = |accessor: Index<Accessor>| {
            let view =
                &root.buffer_views[root.accessors[accessor.value()].buffer_view.expect("a view").value()];
            let from = view.byte_offset.expect("an offset").0 as usize / 4;
            numbers[from..from + view.byte_length.0 as usize / 4].to_vec()
        };
        let sampler = |channel: usize| &root.animations[0].samplers[channel];
        assert_eq!(numbers_of(sampler(0).input), [0.0, 4.0, 8.0]);
        assert_eq!(numbers_of(sampler(0).output), [0.1, 0.1, 0.2, 0.1, 0.1, 0.19, 0.1, 0.3, 0.19]);
        let half = std::f32::consts::FRAC_1_SQRT_2;
        let (turns, wanted) =
            (numbers_of(sampler(1).output), [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, -half, 0.0, 0.0, half]);
        assert!(turns.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-6), "{turns:?}");
        assert_eq!(numbers_of(sampler(2).output), [1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        // Twelve triangles, each corner with the normal of its face.
        let [corners, normals] = [Semantic::Positions, Semantic::Normals]
            .map(|of| &root.accessors[root.meshes[0].primitives[0].attributes[&Valid(of)].value()]);
        assert_eq!((corners.count.0, normals.count.0), (36, 36));
        assert_eq!(corners.max, Some(serde_json::json!([0.1_f32, 0.1_f32, 0.2_f32])));
    }

    #[test]
    fn turns_beyond_half_a_turn_go_on_the_same_way() {
        let by = |angle: f64| Movement { shift: Vec3::zeros(), turn: Vec3::x() * angle };
        // 170 degrees, and 190 degrees as the shorter turn the other way round.
        let [first, second] = [170.0, -170.0].map(|deg| by(radians(deg)));
        let both = turns(&[first, second]);
        let dot: f64 = both[0].iter().zip(both[1]).map(|(a, b)| a * b).sum();
        assert!(dot > 0.98, "{both:?}");
    }

    #[test]
    fn states_at_rest_and_falls_have_their_times() {
        let all = replay();
        let of = |states: &[usize]| {
            let states = states.iter().map(|at| all.states[*at].clone()).collect();
            times(&Replay { states, ..Replay::default() }).concat()
        };
        assert_eq!(of(&[0, 0, 1, 2, 2]), [0.0, 2.0, 4.0, 6.0, 8.0]);
        assert_eq!(of(&[0, 2, 2]), [0.0, 2.0, 4.0]);
        assert_eq!(of(&[2, 2]), [0.0, 2.0]);
        assert_eq!(of(&[0]), [0.0]);
    }
}
