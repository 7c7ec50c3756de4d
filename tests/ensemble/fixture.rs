//! A small study in a folder of its own, and the program to run on it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Three courses of stones 0.2 m long, stack bond and random courses, at two stiffnesses.
pub const STUDY: &str = r#"
[study]
question = "Does the machinery hold?"
seed = 7

[wall]
height_m = 0.3
length_m = 0.8
base_thickness_m = 0.2
top_thickness_m = 0.16
battered_face = "both"

[block]
density_kg_per_m3 = 2400

[joint]
kn_pa_per_m = [5e7, 1.75e8]
kn_over_ks = 2
phi_deg = 35
cohesion_pa = 0

[load]
protocol = "lateral"
mean_pressure_pa = 200
base_over_top = 2

[restraint]
base = "fixed"
ends = "joint_springs"

[solver]
unbalanced_ratio = 1e-4

[[arm]]
name = "stack"
members = 1
arrangement = "continuous"
block_length_m = 0.2
course_height_m = 0.1

[[arm]]
name = "random"
members = 8
arrangement = "coursed"
length_m = { family = "uniform", low = 0.15, high = 0.25 }
height_m = { family = "uniform", low = 0.09, high = 0.11 }
dip_deg = { family = "uniform", low = -3, high = 3 }

[[variant]]
name = "slippery"
why = "Wet joints."
set = { "joint.phi_deg" = 30 }
"#;

/// A working folder that is removed at the end of the test.
pub struct Folder(PathBuf);

impl Folder {
    /// A folder with the study `tiny` in it, in the place where studies are.
    pub fn with_study(text: &str) -> Self {
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let folder = Folder(std::env::temp_dir().join(format!("pirca-test-{}-{number}", std::process::id())));
        fs::create_dir_all(folder.path("studies/tiny")).unwrap();
        folder.write_study(text);
        folder
    }

    /// Replaces the study's text.
    pub fn write_study(&self, text: &str) {
        fs::write(self.path("studies/tiny/study.toml"), text).unwrap();
    }

    /// A path in it.
    pub fn path(&self, below: impl AsRef<Path>) -> PathBuf {
        self.0.join(below)
    }

    /// The program in this folder, to be given more arguments.
    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_pirca"));
        command.current_dir(&self.0).args(arguments);
        command
    }

    /// Runs the program to its end.
    pub fn pirca(&self, arguments: &[&str]) -> Output {
        self.command(arguments).output().unwrap()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// What a finished program wrote to standard error.
pub fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// The study's text with one line changed.
pub fn changed(from: &str, to: &str) -> String {
    assert_eq!(STUDY.matches(from).count(), 1, "{from} must stand once in the study");
    STUDY.replacen(from, to, 1)
}
