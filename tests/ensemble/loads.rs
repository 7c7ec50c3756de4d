//! The small study under other loads.

use crate::fixture::changed;

/// The load of the small study itself.
pub const LATERAL: &str = "protocol = \"lateral\"\nmean_pressure_pa = 200\nbase_over_top = 2";
/// A tilting table.
pub const TILTING: &str = "protocol = \"tilting\"\ntowards = \"y+\"\nstep_deg = 4\nbracket_deg = 0.5";
/// A push along the wall.
pub const SHEAR: &str = "protocol = \"shear\"\nvertical_load_n = 2e3\nforce_height_m = 0.32\nhead = \"turns\"\n\
     drift_percent = 0.4\nstep_percent = 0.1";
/// A motion that hardly moves its stones, and one that throws them off.
pub const BASE_MOTION: &str = "protocol = \"base_motion\"\npga_m_per_s2 = [1, 40]\nafter_s = 1\ntwice = false\n\n[load.records]\n\
     from = \"kanai_tajimi\"\ncount = 1\nground_hz = 1\ncorner_hz = 0.4\ncorner_damping = 1\nrise_s = 0.2\n\
     strong_s = 1\ndecay_per_s = 8";

/// The small study with another load between free ends, and another solver.
pub fn loaded(load: &str, solver: &str) -> String {
    changed(LATERAL, load).replace("joint_springs", "free").replace("unbalanced_ratio = 1e-4", solver)
}
