use super::*;
use crate::exchange::mesh::twisted::twisted;
use crate::math::Vec3;

/// A file of each version: blocks of every shape, and what goes with them.
const OLD: &str = "; a wall\nnew\nconfig dyn\n\
poly brick -0.24 4.14, -0.5 0.5, -0.24 0 region 1\n\
POLY region 2 prism &\na (0 0 0) (1 0 0) (1 1 0)&\n  (0,1,0) &\nb (0 0 1) (1 0 1) &\n (1 1 1) (0 1 1)\n\
poly face 0,0,1 1,0,1 0,1,1 face 0 0 1 0 0 2 1 0 1.0000000001 &\nface 1 0 1 0 0 2 0 1 1 face 0 1 1 0 0 2 0 0 1 r=3 m=2\n\
prop mat 1 dens 1800\nhist unbal\nhist @f\nfix region 1\nsave wall.sav\nrest wall.sav\nreturn\npoly cube";
const NEW: &str = "model new\nblock create brick 0 1\n\
block create group \"Supports\" poly face 0,0,-1 1,0,-1 1,1,-1 0,1,-1 face 0,0,-1 0,0,0 1,0,0 1,0,-1 ...\n\
face 1,0,-1 1,0,0 1,1,0 1,1,-1 face 1,1,-1 1,1,0 0,1,0 0,1,-1 face 0,1,-1 0,1,0 0,0,0 0,0,-1 face 0,0,0 0,1,0 1,1,0 1,0,0 r=0\n\
block create tetrahedron (0,0,1) (1,0,1) (0,1,1) (0,0,2) group 'Top' slot 'Parts'\n\
block create prism face-1 1 0 0 2 0 0 1 1 0 face-2 1 0 1 2 0 1 1 1 1 group 'Wedge'\n\
block property density 2400 range group 'Supports'\nblock contact generate-subcontacts\nblock fix range group 'supports'\n\
fish define f\n loop n (1, 3)\n  command\n   model solve\n  endcommand\n endloop\nend\n@f\n[a = 3]\nmodel solve ratio 1e-5\n";

fn read(text: &str) -> Blocks {
    read_3dec(text).unwrap_or_else(|faults| panic!("{faults}"))
}

/// Six times the volume within faces that look anywhere, by the greatest and the least corner.
fn bounds(mesh: &Mesh) -> [[f64; 3]; 2] {
    let used = || mesh.faces.iter().flatten().map(|corner| mesh.vertices[*corner as usize]);
    let fold = |of: fn(f64, f64) -> f64| used().reduce(|a, b| a.zip_map(&b, of)).expect("corners").into();
    [fold(f64::min), fold(f64::max)]
}

#[test]
fn each_command_makes_its_block_and_fix_holds_those_of_its_range() {
    let (blocks, warnings) = read(OLD);
    assert_eq!(blocks.iter().map(|own| own.line).collect::<Vec<_>>(), [4, 5, 10]);
    assert_eq!(blocks.iter().map(|own| own.faces.len()).collect::<Vec<_>>(), [6, 6, 4]);
    assert_eq!(bounds(&blocks[0]), [[-0.24, -0.5, -0.24], [4.14, 0.5, 0.0]]);
    assert_eq!(bounds(&blocks[1]), [[0.0; 3], [1.0; 3]]);
    // Corners that differ by their rounding are one.
    let corners: BTreeSet<u32> = blocks[2].faces.iter().flatten().copied().collect();
    assert_eq!((corners.len(), bounds(&blocks[2])), (4, [[0.0, 0.0, 1.0], [1.0, 1.0, 2.0]]));
    assert_eq!(
        blocks.iter().map(|own| own.is_support).collect::<Vec<_>>(),
        [Some(true), Some(false), Some(false)]
    );
    assert_eq!(blocks[1].name.as_deref(), Some("region 2"));
    assert_eq!(
        warnings,
        [
            "6 commands that make no blocks were passed over: config (1), hist (2), prop (1), rest (1), save (1)"
        ]
    );
    let (blocks, warnings) = read(NEW);
    assert_eq!(
        blocks.iter().map(|own| own.name.as_deref()).collect::<Vec<_>>(),
        [None, Some("supports"), Some("top"), Some("wedge")]
    );
    assert_eq!(bounds(&blocks[0]), [[0.0; 3], [1.0; 3]]);
    assert_eq!((blocks[2].faces.len(), blocks[3].faces.len()), (4, 5));
    assert_eq!(blocks[3].vertices[4], Vec3::new(2.0, 0.0, 1.0));
    assert_eq!(
        blocks.iter().map(|own| own.is_support == Some(true)).collect::<Vec<_>>(),
        [false, true, false, false]
    );
    assert!(warnings[0].starts_with("5 commands that make no blocks") && warnings.len() == 1, "{warnings:?}");
}

#[test]
fn a_range_is_followed_only_where_it_says_exactly_which_blocks() {
    let wall =
        "poly brick 0 1 0 1 -1 0 reg 1\npoly brick 0 1 0 1 0 1 group 'low'\npoly brick 0 1 0 1 1 2 reg 3\n";
    for (range, held) in [
        ("fix", Some(vec![0, 1, 2])),
        ("fix range z -1 0", Some(vec![0])),
        ("block fix range position-z -1 1", Some(vec![0, 1])),
        ("fix range zr -2 1 group 'LOW'", Some(vec![1])),
        ("group block 'a' range z 0 2\nfix range group a", Some(vec![1, 2])),
        ("block group 'a' slot 'b' range reg 3\nblock fix range group 'a' slot 'b'", Some(vec![2])),
        ("fix reg 3\nfree range z 1 2", Some(vec![])),
        ("hide reg 3\nshow\nfix reg 3", Some(vec![2])),
        // Blocks without a region may be in 0 or in 1; they are in no other.
        ("fix range region 1", None),
        ("fix range z -1 0.5", None),
        ("fix range id 1", None),
        ("fix range name low", None),
        ("fix range not reg 3", None),
        ("fix range reg 7", None),
        ("hide reg 3\nfix", None),
        ("block hide range reg 3\nfix reg 3", None),
        ("mark region 3 range z 0 1\nfix reg 3", None),
        ("group 'low' range name all\nfix range group 'low'", None),
        ("bound xvel 0 range z -1 0", None),
        ("block gridpoint apply velocity-x 0", None),
    ] {
        let (blocks, warnings) = read(&format!("{wall}{range}"));
        let own: Vec<usize> = (0..3).filter(|at| blocks[*at].is_support == Some(true)).collect();
        assert_eq!(own, held.clone().unwrap_or_default(), "{range}");
        let line = 3 + range.lines().count();
        let told = warnings
            .iter()
            .any(|own| own.contains("may hold blocks") && own.contains(&format!("line {line} (")));
        assert_eq!(told, held.is_none(), "{range}: {warnings:?}");
    }
}

#[test]
fn what_makes_or_changes_blocks_and_is_not_read_is_refused_with_its_line() {
    let wall = "poly brick 0 1 0 1 0 1\n";
    for (text, line, found) in [
        ("jset dip 30", 2, "changes blocks"),
        ("\ndelete range z 0 1", 3, "changes blocks"),
        ("block cut joint-set dip 30", 2, "changes blocks"),
        ("block generate from-vrml filename 'wall.wrl'", 2, "changes blocks"),
        ("block join on", 2, "changes blocks"),
        ("block frobnicate", 2, "changes blocks"),
        ("call geometry.dat", 2, "reads another file"),
        ("program call 'geometry.dat'", 2, "reads another file"),
        ("restore other.sav", 2, "did not save"),
        ("model restore 'other'", 2, "did not save"),
        ("struct cable begin 0 0 0", 2, "cables"),
        ("frobnicate 3", 2, "not known"),
        (
            "def f\nloop n (1, 2)\ncommand\npoly brick 0 1 0 1 @z1 @z2\nendcommand\nendloop\nend\n@f",
            5,
            "function of FISH",
        ),
        ("fish define f\n command\n  frobnicate\n end_command\nend", 4, "function of FISH"),
        ("fish define f\n b = block.create.brick(1)\nend", 3, "FISH that makes"),
        ("[block.delete(b)]", 2, "FISH that makes"),
        ("def f\n a = 1\n", 0, "does not end"),
        ("poly brick 0 1 0 1 @z1 @z2", 2, "@z1 is a value of FISH"),
        ("poly brick [0] 1", 2, "[0] is a value of FISH"),
        ("poly brick 0 1 0 1 1", 2, "a brick of 5 numbers"),
        ("poly brick 0 nan 0 1 1 2", 2, "\"nan\""),
        ("poly brick 0 1 0 1 1 1e999", 2, "\"1e999\""),
        ("poly prism a 0 0 0 1 0 0 1 1 0", 2, "a prism with 1 faces"),
        ("poly prism a 0 0 0 1 0 0 1 1 0 b 0 0 1 1 0 1", 2, "3 and 2 corners"),
        ("poly prism a 0 0 0 1 0 0 1 1 b 0 0 1 1 0 1", 2, "8 numbers for corners"),
        ("poly face 0 0 0 1 0 0 1 1 0", 2, "a polyhedron with 1 faces"),
        ("poly face 0 0 0 1 0 0", 2, "a face with 2 corners"),
        ("block create tetrahedron 0 0 0 1 0 0 1 1 0", 2, "a tetrahedron with 3 corners"),
        ("block create drum center-1 0 0 0", 2, "\"drum\""),
        ("block create tunnel", 2, "\"tunnel\""),
        ("block create brick 0 1 prism a", 2, "two shapes"),
        ("block create", 2, "without a shape"),
        ("poly brick 0 1 0 1 0 1 region", 2, "the command ends"),
        ("poly brick 0 1 0 1 0 1 range z 0 1", 2, "\"range\""),
    ] {
        let faults = read_3dec(&format!("{wall}{text}")).expect_err(text);
        let first = &faults.faults[0];
        assert!(
            first.found.contains(found) && first.line == line && !first.fix.is_empty(),
            "{text}: {first:?}"
        );
    }
    let faults = read_3dec("prop mat 1\nnew\n").expect_err("no blocks").to_string();
    assert!(faults.contains("no command makes a block"), "{faults}");
    let faults = read_3dec(&format!("{wall}new\n")).expect_err("no blocks").to_string();
    assert!(faults.contains("no command makes a block"), "{faults}");
}

#[test]
fn huge_files_take_little_memory() {
    let faults =
        read_3dec(&format!("poly face {}", "1 ".repeat(2_000_000))).expect_err("too long").to_string();
    assert!(faults.contains("more than 100000 words"), "{faults}");
    let faults =
        read_3dec(&format!("poly face {}", "0 0 1 ".repeat(20_000))).expect_err("too many").to_string();
    assert!(faults.contains("20000 corners together"), "{faults}");
    let faults = read_3dec(&"poly brick 0 1\n".repeat(MOST_BLOCKS + 200)).expect_err("too many").to_string();
    assert!(faults.contains("more than 50000 blocks") && faults.contains("not looked at"), "{faults}");
}

#[test]
fn nothing_that_is_twisted_breaks_it() {
    for whole in [OLD, NEW] {
        twisted(whole.as_bytes(), |bytes| {
            let (blocks, _) = read_3dec(&String::from_utf8_lossy(bytes)).unwrap_or_default();
            for mesh in blocks {
                assert!(mesh.vertices.iter().flatten().all(|c| c.is_finite()));
                assert!(mesh.faces.iter().flatten().all(|&c| (c as usize) < mesh.vertices.len()));
            }
        });
    }
}
