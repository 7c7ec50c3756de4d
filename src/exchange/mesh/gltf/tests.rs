use serde_json::{Value, json};

use super::*;
use crate::exchange::mesh::twisted::twisted;
use crate::math::Vec3;

const CORNERS: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0], [0.0, 0.0, 0.1]];
const FACES: [[u8; 3]; 5] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3], [1, 1, 2]];

/// The bytes of a tetrahedron and of a triangle without area: corners 16 bytes apart, then the numbers of corners in 8, in 16 and in 32 bits.
fn bytes() -> Vec<u8> {
    let mut all = Vec::new();
    for corner in CORNERS {
        corner.iter().for_each(|number| all.extend(number.to_le_bytes()));
        all.extend([9; 4]);
    }
    let corners = || FACES.iter().flatten().copied();
    all.extend(corners());
    all.push(0);
    corners().for_each(|corner| all.extend(u16::from(corner).to_le_bytes()));
    all.extend([0; 2]);
    corners().for_each(|corner| all.extend(u32::from(corner).to_le_bytes()));
    all
}

/// A file with that mesh at two nodes, one of them below a turned one.
fn description() -> Value {
    let view = |from: u64, size: u64| json!({ "buffer": 0, "byteOffset": from, "byteLength": size });
    let accessor = |view: u64, code: u64, count: u64, kind: &str| json!({ "bufferView": view, "componentType": code, "count": count, "type": kind });
    json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0, 2] }],
        "nodes": [
            { "name": "turned", "children": [1], "rotation": [0.0, 0.0, 0.5, 0.5], "translation": [1.0, 0.0, 0.0], "scale": [2.0, 2.0, 2.0] },
            { "name": "stone 7", "mesh": 0, "translation": [0.0, 1.0, 0.0] },
            { "mesh": 0, "matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1] }
        ],
        "meshes": [{ "name": "tetrahedron", "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1, "material": 0 }] }],
        "materials": [{ "name": "limestone" }],
        "accessors": [accessor(0, 5126, 4, "VEC3"), accessor(1, 5121, 15, "SCALAR"), accessor(2, 5123, 15, "SCALAR"), accessor(3, 5125, 15, "SCALAR")],
        "bufferViews": [
            { "buffer": 0, "byteLength": 64, "byteStride": 16 },
            view(64, 15),
            view(80, 30),
            view(112, 60)
        ],
        "buffers": [{ "byteLength": 172 }]
    })
}

fn glb(description: &Value) -> Vec<u8> {
    let mut text = description.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let bytes = bytes();
    let mut all = b"glTF".to_vec();
    all.extend(2_u32.to_le_bytes());
    all.extend((28 + text.len() as u32 + bytes.len() as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", &text), (b"BIN\0", &bytes)] {
        all.extend((chunk.len() as u32).to_le_bytes());
        all.extend(kind);
        all.extend(chunk);
    }
    all
}

/// The same file as a text with its bytes in it.
fn gltf(description: &Value) -> Vec<u8> {
    let mut own = description.clone();
    own["buffers"][0]["uri"] = json!(format!("data:application/octet-stream;base64,{}", letters(&bytes())));
    own.to_string().into_bytes()
}

fn letters(bytes: &[u8]) -> String {
    use base64::Engine;
    base64::engine::general_purpose::STANDARD_NO_PAD.encode(bytes)
}

/// The first fault of a file that differs in one place.
fn refused(place: &str, value: Value) -> Fault {
    let mut own = description();
    let (parent, key) = place.rsplit_once('/').expect("a place");
    let parent = own.pointer_mut(parent).expect("there");
    match key.parse::<usize>() {
        Ok(number) if parent.is_array() => parent[number] = value,
        _ => parent[key] = value,
    }
    let faults = read_gltf(&glb(&own)).expect_err(place);
    faults.faults[0].clone()
}

#[test]
fn a_stone_for_each_node_is_where_the_nodes_above_it_put_it() {
    let read = read_gltf(&glb(&description())).expect("it reads");
    assert_eq!(
        read.iter().map(|mesh| mesh.name.as_deref()).collect::<Vec<_>>(),
        [Some("stone 7"), Some("tetrahedron")]
    );
    assert_eq!(
        read[0].faces,
        [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
        "without the triangle that has no area"
    );
    let small = f64::from(0.1_f32);
    // Moved by 1 along y, doubled, turned by a quarter turn about z, moved by 1 along x.
    let near = |at: &Vec3, wanted: [f64; 3]| assert!((at - Vec3::from(wanted)).norm() < 1e-15, "{at}");
    near(&read[0].vertices[0], [-1.0, 0.0, 0.0]);
    near(&read[0].vertices[1], [-1.0, 2.0 * small, 0.0]);
    near(&read[0].vertices[2], [-1.0 - 2.0 * small, 0.0, 0.0]);
    near(&read[0].vertices[3], [-1.0, 0.0, 2.0 * small]);
    near(&read[1].vertices[1], [5.0, 6.0 + small, 7.0]);
    assert!(read.iter().all(|mesh| mesh.is_support.is_none() && mesh.line == 0));
}

#[test]
fn text_and_bytes_and_numbers_of_each_size_give_the_same() {
    let wanted = read_gltf(&glb(&description())).expect("it reads");
    assert_eq!(read_gltf(&gltf(&description())).expect("it reads"), wanted);
    for indices in [2, 3] {
        let mut own = description();
        own["meshes"][0]["primitives"][0]["indices"] = json!(indices);
        assert_eq!(read_gltf(&glb(&own)).expect("it reads"), wanted, "{indices}");
    }
    // Corners without numbers are those of triangles in turn.
    let mut own = description();
    own["meshes"][0]["primitives"][0].as_object_mut().expect("one").remove("indices");
    own["accessors"][0]["count"] = json!(3);
    let read = read_gltf(&glb(&own)).expect("it reads");
    assert_eq!((read[0].faces.len(), read[0].vertices.len()), (1, 3));
    // Without a scene the nodes below none are shown; a material can say what is held.
    let mut own = description();
    ["scene", "scenes"].iter().for_each(|key| drop(own.as_object_mut().expect("one").remove(*key)));
    own["materials"][0]["name"] = json!("Ground.001");
    let read = read_gltf(&glb(&own)).expect("it reads");
    assert!(read.len() == 2 && read.iter().all(|mesh| mesh.is_support == Some(true)));
}

#[test]
fn what_is_not_read_is_refused_with_its_mesh_and_how_to_mend_it() {
    let primitive = "/meshes/0/primitives/0";
    let title = "mesh tetrahedron (node stone 7)";
    for (place, value, found) in [
        ("/mode", json!(5), "drawn as a strip of triangles"),
        ("/mode", json!(0), "drawn as points"),
        ("/mode", json!(99), "in the mode 99"),
        ("/targets", json!([{ "POSITION": 0 }]), "shapes to morph into"),
        (
            "/extensions",
            json!({ "KHR_draco_mesh_compression": { "bufferView": 0 } }),
            "compressed (KHR_draco",
        ),
        ("/attributes", json!({ "NORMAL": 0 }), "no POSITION"),
        ("/attributes/POSITION", json!(9), "positions are in accessor 9, and there are 4"),
        ("/attributes/POSITION", json!(1), "positions are of the kind SCALAR (5121)"),
        ("/indices", json!(0), "indices are of the kind VEC3 (5126)"),
    ] {
        let fault = refused(&format!("{primitive}{place}"), value);
        assert!(
            fault.found.contains(found) && fault.block == title && !fault.fix.is_empty(),
            "{found}: {fault:?}"
        );
    }
    for (place, value, found) in [
        ("/accessors/0/sparse", json!({ "count": 1 }), "sparse"),
        ("/accessors/0/bufferView", Value::Null, "in no buffer"),
        ("/accessors/0/bufferView", json!(7), "buffer view 7"),
        ("/accessors/0/count", json!(5), "reach beyond their bytes: 5 items"),
        ("/accessors/0/count", json!(0), "0 items"),
        ("/accessors/0/count", json!(u64::MAX), "reach beyond"),
        ("/accessors/0/count", json!(3), "names corner 3"),
        ("/accessors/1/count", json!(14), "triangles have 14 corners"),
        ("/accessors/1/byteOffset", json!(u64::MAX), "reach beyond"),
        ("/bufferViews/0/byteStride", json!(4), "one every 4 bytes"),
        ("/bufferViews/0/byteLength", json!(500), "reach beyond"),
        ("/bufferViews/0/byteOffset", json!(u64::MAX), "reach beyond"),
        ("/bufferViews/0/buffer", json!(1), "buffer 1, and there are 1"),
        ("/bufferViews/0/extensions", json!({ "EXT_meshopt_compression": {} }), "compressed (EXT_meshopt"),
        ("/buffers/0/byteLength", json!(173), "172 of its 173 bytes"),
        ("/buffers/0/uri", json!("stones.bin"), "lies in another file, stones.bin"),
        ("/buffers/0/uri", json!("data:;base64,$$"), "no base64"),
        ("/buffers/0/uri", json!("data:text,abc"), "not written as base64"),
        ("/nodes/1/skin", json!(0), "a skin"),
        ("/nodes/1/extensions", json!({ "EXT_mesh_gpu_instancing": {} }), "several times"),
        ("/meshes/0/primitives", json!([]), "no triangles"),
    ] {
        let fault = refused(place, value);
        assert!(
            fault.found.contains(found) && fault.block == title && !fault.fix.is_empty(),
            "{found}: {fault:?}"
        );
    }
    for (place, value, block, found) in [
        ("/nodes/1/mesh", json!(3), "node stone 7", "its mesh is 3"),
        ("/nodes/1/children", json!([0]), "node turned", "below itself"),
        ("/nodes/2/children", json!([1]), "node stone 7", "below two nodes"),
        ("/nodes/0/children", json!([9]), "", "node 9 is named, and there are 3"),
        ("/nodes/0/rotation", json!([0, 0, 0, 0]), "node turned", "its rotation (0, 0, 0, 0)"),
        ("/nodes/2/matrix/3", json!(1), "node 2", "the row 0, 0, 0, 1"),
        ("/nodes/1/translation", json!([1e308, 0, 0]), "mesh tetrahedron (node stone 7)", "corner 0 is at"),
        ("/scene", json!(1), "", "scene 1"),
        ("/scenes/0/nodes", json!([]), "", "shows no meshes"),
        ("/asset/version", json!("1.0"), "", "it is glTF 1.0"),
        ("/extensionsRequired", json!(["XX_curves"]), "", "extension XX_curves"),
        ("/accessors/0/count", json!(-1), "", "not what is expected"),
        ("/asset", json!({}), "", "missing field"),
    ] {
        let fault = refused(place, value);
        assert!(fault.found.contains(found) && fault.block == block, "{found}: {fault:?}");
    }
    let mut own = description();
    own["extensionsRequired"] = json!(["KHR_texture_transform", "KHR_materials_unlit"]);
    assert!(read_gltf(&glb(&own)).is_ok(), "what changes the looks alone");
}

#[test]
fn files_that_are_cut_or_too_large_are_refused_in_little_memory() {
    let whole = glb(&description());
    for end in 0..whole.len() {
        assert!(read_gltf(&whole[..end]).is_err(), "{end}");
    }
    // One mesh of four corners at very many nodes, and one node very often.
    let mut own = description();
    own["nodes"] = json!(vec![json!({ "mesh": 0 }); MOST_BLOCKS + 1]);
    own["scenes"][0]["nodes"] = json!((0..=MOST_BLOCKS).collect::<Vec<_>>());
    let faults = read_gltf(&glb(&own)).expect_err("too many").to_string();
    assert!(faults.contains("50001 nodes with meshes"), "{faults}");
    own["meshes"][0]["primitives"] = json!(vec![own["meshes"][0]["primitives"][0].clone(); 1_000]);
    own["nodes"] = json!(vec![json!({ "mesh": 0 }); 501]);
    own["scenes"][0]["nodes"] = json!((0..501).collect::<Vec<_>>());
    let faults = read_gltf(&glb(&own)).expect_err("too many").to_string();
    assert!(faults.contains("(node 500): with it there are 2000004 corners"), "{faults}");
    let faults = read_gltf("{".repeat(1_000_001).as_bytes()).expect_err("too many").to_string();
    assert!(faults.contains("objects describe it"), "{faults}");
}

#[test]
fn nothing_that_is_twisted_breaks_it() {
    for whole in [glb(&description()), gltf(&description())] {
        twisted(&whole, |bytes| {
            for mesh in read_gltf(bytes).unwrap_or_default() {
                assert!(mesh.vertices.iter().flatten().all(|c| c.is_finite()));
                assert!(mesh.faces.iter().flatten().all(|&c| (c as usize) < mesh.vertices.len()));
            }
        });
    }
}
