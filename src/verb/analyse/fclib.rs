//! The contact problem of one step as JSON, with the fields of FCLib's global problems (Acary et al. 2014).

use std::path::Path;

use serde_json::{Value, json};

use crate::ensemble::replace_file;
use crate::exchange::WallFile;
use crate::law::Coulomb;
use crate::math::{degrees, radians, tan};
use crate::solve::nonsmooth::{GlobalProblem, Settings, Simulation, Solution, Triplets};
use crate::solve::{Equilibrate, STANDARD_GRAVITY};
use crate::study::Fit;
use crate::terminal::failure::Failure;
use crate::verb::analyse::answer::Answer;
use crate::verb::analyse::ask::{Analyse, Growing};
use crate::verb::analyse::solve::{LARGEST_MULTIPLIER, LARGEST_TILT_DEG, task};

/// What stands in the file.
const WHAT: &str = "Frictional contact of rigid blocks in one step of contact dynamics from rest: M v = H r + f, u = H^T v + w, and at \
                    each contact -(u + mu |u_T| n) lies in the normal cone of Coulomb's cone at r";
const ORDER: &str = "v: for each body vx, vy, vz, wx, wy, wz along the world's axes about its centroid; u and r: for each contact the normal \
                     component (u opens, r presses), then two in the plane. Matrices are triplets: row i, column p, value x, from 0";

/// Writes the problem of a wall as built under the load asked for.
pub(crate) fn write(
    path: &Path,
    asked: &Analyse,
    file: &WallFile,
    (law, fit): (&Coulomb, &Fit),
    answer: &Answer,
) -> Result<(), Failure> {
    let task = task(asked, (&file.wall, &[]), law, fit);
    let level = match (asked.growing(), asked.at_deg.map(radians)) {
        (Growing::Tilt, Some(tilt)) => tilt,
        (Growing::Tilt, None) => answer.borne(radians(LARGEST_TILT_DEG)),
        // The others that --fclib does not go with are refused before anything is solved.
        (_, Some(tilt)) => tan(tilt),
        (_, None) => answer.borne(LARGEST_MULTIPLIER),
    };
    let mut wall = Simulation::new(&file.wall, law, Settings::default(), task.contact);
    let (gravity, factor) = task.path.loads(level);
    wall.set_loads(gravity, factor);
    let Some((problem, solution)) = wall.global_problem() else {
        return Err(Failure::Run("the joints are not dry: --fclib has no form for them".to_owned()));
    };
    let load = match asked.growing() {
        Growing::Tilt => json!({ "kind": "tilt", "tilt_deg": degrees(level) }),
        _ => json!({ "kind": asked.load.name(), "multiplier": level }),
    };
    let object = object(&asked.title(), file, (&problem, &solution), load);
    replace_file(path, format!("{object}\n").as_bytes())?;
    Ok(())
}

fn object(
    title: &str,
    file: &WallFile,
    (problem, solution): (&GlobalProblem, &Solution),
    load: Value,
) -> Value {
    let id = |body: &usize| file.ids[*body];
    json!({
        "title": title,
        "description": WHAT,
        "math_info": ORDER,
        "units": {
            "M": "kg, kg m^2", "H": "1, m", "f": "N s, N m s", "w": "m/s", "mu": "1", "gap": "m", "step": "s",
            "v": "m/s, rad/s", "u": "m/s", "r": "N s"
        },
        "load": load,
        "gravity_m_per_s2": STANDARD_GRAVITY,
        "spacedim": 3,
        "bodies": problem.bodies.iter().map(id).collect::<Vec<_>>(),
        "contacts": problem.pairs.iter().map(|pair| [id(&pair[0]), id(&pair[1])]).collect::<Vec<_>>(),
        "M": matrix(&problem.mass),
        "H": matrix(&problem.h),
        "f": problem.f,
        "w": problem.w,
        "mu": problem.mu,
        "gap": problem.gap,
        "step": problem.step,
        "solution": solution,
    })
}

/// A matrix as FCLib writes triplets: `nz` of them, rows `i`, columns `p`.
fn matrix(of: &Triplets) -> Value {
    let rows: Vec<usize> = of.entries.iter().map(|entry| entry.0).collect();
    let columns: Vec<usize> = of.entries.iter().map(|entry| entry.1).collect();
    let values: Vec<f64> = of.entries.iter().map(|entry| entry.2).collect();
    json!({ "m": of.rows, "n": of.columns, "nz": values.len(), "i": rows, "p": columns, "x": values })
}
