//! Small good walls to be spoilt, and a folder for them.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::atomic::{AtomicUsize, Ordering};

/// A ground, two stones on one another, a tetrahedron beside them.
pub const GOOD_JSON: &str = r#"{"unit":"m","blocks":[
{"id":0,"vertices":[[-1,-1,-0.1],[2,-1,-0.1],[2,2,-0.1],[-1,2,-0.1],[-1,-1,0],[2,-1,0],[2,2,0],[-1,2,0]],"faces":[[3,2,1,0],[4,5,6,7],[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7]],"fixed":true},
{"id":4,"vertices":[[0,0,0],[0.5,0,0],[0.5,0.3,0],[0,0.3,0],[0,0,0.2],[0.5,0,0.2000],[0.5,0.3,0.2],[0,0.3,0.2]],"faces":[[3,2,1,0],[4,5,6,7],[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7]],"density":2400,"fixed":false,"tag":"stone"},
{"id":7,"vertices":[[0,0,0.2],[0.5,0,0.2],[0.5,0.3,0.2],[0,0.3,0.2],[0,0,0.4],[0.5,0,0.4],[0.5,0.3,0.4],[0,0.3,0.4]],"faces":[[3,2,1,0],[4,5,6,7],[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7]],"density":2300,"fixed":false},

{"id":9,"vertices":[[0.8,0,0],[1.1,0,0],[0.9,0.3,0],[0.9,0.1,0.2]],"faces":[[0,2,1],[0,1,3],[0,3,2],[1,2,3]],"density":2400,"fixed":false}
]}
"#;

/// A base and two stones on it.
pub const GOOD_OBJ: &str = "\
# a wall
mtllib wall.mtl
o Base
v -1 -1 -0.1
v 2 -1 -0.1
v 2 2 -0.1
v -1 2 -0.1
v -1 -1 0
v 2 -1 0
v 2 2 0
v -1 2 0
f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8
o Stone
v 0 0 0 0.5 0.5 0.5\nv 0.5 0 0.0\nv 0.5 0.3 0\nv 0 0.3 0\nv 0 0 0.2\nv 0.5 0 0.20\nv 0.5 0.3 0.2\nv 0 0.3 0.2
vn 0 0 1
f -5//1 -6//1 -7//1 -8//1\nf 13/1/1 14/1/1 15/1/1 16/1/1\nf 9 10 14 13\nf 10 11 15 14\nf 11 12 16 15\nf 12 9 13 16
# density 2300 kg/m^3
o Upper.001
v 0 0 0.2
v 0.5 0 0.2
v 0.5 0.3 0.2\nv 0 0.3 0.2\nv 0 0 0.4\nv 0.5 0 0.4\nv 0.5 0.3 0.4\nv 0 0.3 0.4
f 20 19 18 17\nf 21 22 23 24\nf 17 18 22 21\nf 18 19 23 22\nf 19 20 24 23\nf 20 17 \\\n21 24
";

/// An example wall of the fixtures.
pub fn example(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cli/fixtures/walls").join(name)
}

/// A working folder, gone at the end of the test.
pub struct Folder(PathBuf);

impl Folder {
    /// An empty one.
    pub fn new() -> Folder {
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let folder =
            Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("walls-{}-{number}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("the scratch folder can be made");
        Folder(folder)
    }

    /// A path in it.
    pub fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    /// Runs the program in it.
    pub fn pirca(&self, arguments: &[&str]) -> Output {
        let mut command = Command::new(env!("CARGO_BIN_EXE_pirca"));
        command.current_dir(&self.0).args(arguments).output().expect("the program starts")
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}
