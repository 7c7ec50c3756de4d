//! The house: which module may import which. A forbidden import, a folder without a row and `super::super::` fail. The stages of
//! the critic have a table of their own.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Module and what it may import besides itself, in reading order.
const HOUSE: &[(&str, &[&str])] = &[
    ("interrupt", &[]),
    ("math", &[]),
    ("shape", &["math"]),
    ("random", &["math"]),
    ("stats", &["math", "random"]),
    ("motion", &["math", "random"]),
    ("law", &["math"]),
    ("model", &["math", "shape", "law"]),
    // Outlines become polygons that share the lines of their joints.
    ("face", &["math", "shape"]),
    ("exchange", &["math", "shape", "face", "model"]),
    // How an answer is written: a leaf that knows no verb and no study.
    ("render", &["math", "shape", "model"]),
    ("contact", &["math", "shape", "model"]),
    // Joints made planes in a wall that was measured.
    ("mend", &["math", "shape", "model", "contact"]),
    ("generate", &["math", "shape", "random", "law", "model"]),
    ("solve", &["interrupt", "math", "shape", "law", "model", "contact"]),
    // A wall seen as a plate: solvers' answers for cells of stones, put together.
    ("homogenise", &["interrupt", "math", "shape", "law", "model", "contact", "solve"]),
    // `shape`, beyond the house's first plan: a pressure is integrated over faces, and end blocks are shapes.
    ("protocol", &["math", "shape", "law", "motion", "model", "contact", "solve"]),
    // What codes ask of a mechanism: numbers against numbers.
    ("verify", &["math", "motion"]),
    // `exchange` and `contact`: an arm may be a wall from a file, which is looked over (which blocks touch, overlap, float) as it is read.
    (
        "study",
        &[
            "math", "shape", "random", "stats", "motion", "law", "model", "exchange", "contact", "mend",
            "generate", "solve", "protocol", "verify",
        ],
    ),
    (
        "ensemble",
        &[
            "interrupt",
            "math",
            "random",
            "stats",
            "model",
            "generate",
            "solve",
            "homogenise",
            "protocol",
            "study",
        ],
    ),
    ("critic", &["interrupt", "math", "random", "stats", "model", "protocol", "study", "ensemble"]),
    // Progress and messages: below the verbs, which tell how far they are.
    ("terminal", &["interrupt", "model", "study", "ensemble"]),
    // `math`, `shape` and `contact`, beyond the house's first plan: degrees end at the command line, and a wall from
    // elsewhere is looked over (which blocks touch, overlap, float) before a solver sees it.
    (
        "verb",
        &[
            "math",
            "shape",
            "law",
            "motion",
            "model",
            "exchange",
            "render",
            "contact",
            "mend",
            "solve",
            "homogenise",
            "protocol",
            "verify",
            "stats",
            "study",
            "ensemble",
            "critic",
            "terminal",
        ],
    ),
    ("cli", &["interrupt", "study", "terminal", "verb"]),
];

/// The solvers check each other, so none may lean on another.
const SOLVERS: [&str; 5] = ["explicit", "grains", "implicit", "limit", "nonsmooth"];

/// The stages of the critic, in the order of the method: the folder, and the folders that it may import besides itself.
const STAGES: &[(&str, &[&str])] = &[
    // Measured beside simulated, reading by reading.
    ("compare", &[]),
    ("calibrate", &["compare"]),
    ("detectability", &["compare"]),
    // The diagnosis.
    ("simulate", &["compare"]),
    ("screening", &["simulate"]),
    ("discrepancy", &["compare", "simulate"]),
    ("causes", &["compare", "simulate", "discrepancy"]),
    ("check", &["simulate", "discrepancy", "causes"]),
    ("conflict", &["simulate", "discrepancy", "causes"]),
    ("verdict", &["simulate", "discrepancy", "causes", "check", "conflict"]),
    ("joint_law", &["compare", "simulate"]),
    ("extend", &["simulate", "discrepancy", "causes", "verdict"]),
    ("gain", &["simulate", "discrepancy", "causes", "verdict"]),
    ("advise", &["compare", "simulate", "discrepancy", "causes", "verdict"]),
];

/// The verbs and what they share, each with what it may import besides itself: a verb knows no other verb but the run, whose summary and page are
/// everybody's, and those named here.
const VERBS: &[(&str, &[&str])] = &[
    ("arguments", &[]),
    ("arms", &[]),
    ("share", &[]),
    ("locate", &["arguments"]),
    ("demand", &["locate"]),
    ("question", &["demand"]),
    ("reference", &["arguments"]),
    ("init", &["arguments", "locate"]),
    ("wall", &["arguments", "question", "arms", "locate"]),
    ("run", &["arguments", "question", "locate", "demand", "wall"]),
    ("capacity", &["arguments", "question", "locate", "demand", "run"]),
    ("compare", &["arguments", "question", "arms", "locate", "run"]),
    ("sensitivity", &["arguments", "question", "arms", "locate", "share", "run"]),
    ("homogenise", &["arguments", "question", "arms", "locate", "share", "run"]),
    ("plan_tests", &["arguments", "question", "arms", "locate", "run"]),
    ("readings", &["arguments", "locate", "run"]),
    ("detectability", &["arguments", "locate", "run"]),
    // The bank is the diagnosis's; shards compute it, and a table of measurements is checked as it is read there.
    ("diagnose", &["arguments", "locate", "run"]),
    ("check", &["arguments", "locate", "diagnose"]),
    ("shards", &["arguments", "question", "locate", "run", "diagnose"]),
    ("analyse", &["arguments", "question", "locate", "demand", "wall", "run"]),
    // The page of a wall is what `analyse` says of it.
    ("report", &["arguments", "locate", "wall", "run", "analyse"]),
];

/// Most files of a stage, or of a folder in one.
const MOST_FILES: usize = 12;

/// What a file (path below `src`, with `/`) imports against the house's rules.
fn violations(path: &str, text: &str) -> Vec<String> {
    let code = without_comments(text);
    let mut found = Vec::new();
    if code.contains("super::super::") {
        found.push(format!("{path} climbs with super::super::; write crate::"));
    }
    let Some((module, inner)) = path.split_once('/') else { return found };
    let Some((_, allowed)) = HOUSE.iter().find(|(name, _)| *name == module) else {
        found.push(format!("{path} lies in src/{module}, which has no row in the table of the house"));
        return found;
    };
    // From the top of a module, `super` is the crate.
    let mut imports = paths_after("crate::", &code);
    if inner == "mod.rs" {
        imports.extend(paths_after("super::", &code).into_iter().filter(|p| is_row(&p[0])));
    }
    for import in imports {
        if is_row(&import[0]) && import[0] != module && !allowed.contains(&import[0].as_str()) {
            found.push(format!("{path} imports {}; {module} may import only {allowed:?}", import[0]));
        }
        if let (Some(own), [root, other, ..]) =
            (SOLVERS.iter().find(|s| inner.starts_with(&format!("{s}/"))), &import[..])
            && module == "solve"
            && root == "solve"
            && other != own
            && SOLVERS.contains(&other.as_str())
        {
            found.push(format!("{path}: the {own} solver imports the {other} solver"));
        }
    }
    found.extend(stage_violations(path, &code));
    found.extend(verb_violations(path, &code));
    found.sort();
    found.dedup();
    found
}

/// What a file of a stage of the critic imports against the table of stages. Tests may import any stage, and so may the files
/// beside the stages, which put them together.
fn stage_violations(path: &str, code: &str) -> Vec<String> {
    let Some((stage, inner)) = path.strip_prefix("critic/").and_then(|inner| inner.split_once('/')) else {
        return Vec::new();
    };
    let Some((_, allowed)) = STAGES.iter().find(|(name, _)| *name == stage) else {
        return vec![format!("{path} lies in src/critic/{stage}, which has no row in the table of stages")];
    };
    if inner.ends_with("tests.rs") {
        return Vec::new();
    }
    let code = code.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    let mut imports = paths_after("crate::critic::", code);
    if inner == "mod.rs" {
        // From the top of a stage, `super` is the critic.
        imports.extend(paths_after("super::", code));
    }
    imports
        .iter()
        .filter(|import| import[0] != stage && !allowed.contains(&import[0].as_str()))
        .map(|import| format!("{path} imports critic::{}; {stage} may import only {allowed:?}", import[0]))
        .collect()
}

/// What a file of a verb imports against the table of verbs. Their common tests may import any.
fn verb_violations(path: &str, code: &str) -> Vec<String> {
    let Some(inner) = path.strip_prefix("verb/") else { return Vec::new() };
    let verb = inner.split('/').next().unwrap_or_default().trim_end_matches(".rs");
    if ["mod", "tests"].contains(&verb) {
        return Vec::new();
    }
    let Some((_, allowed)) = VERBS.iter().find(|(name, _)| *name == verb) else {
        return vec![format!("{path} lies in src/verb/{verb}, which has no row in the table of verbs")];
    };
    // What only tests import is no arrow.
    let code = code.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    paths_after("crate::verb::", code)
        .iter()
        .filter(|import| import[0] != verb && import[0] != "codes" && !allowed.contains(&import[0].as_str()))
        .map(|import| format!("{path} imports verb::{}; {verb} may import only {allowed:?}", import[0]))
        .collect()
}

fn is_row(name: &str) -> bool {
    HOUSE.iter().any(|(row, _)| *row == name)
}

/// The code without line comments: what a docstring links to is no import.
fn without_comments(text: &str) -> String {
    text.lines().map(|line| line.split("//").next().unwrap_or("")).collect::<Vec<_>>().join("\n")
}

/// The paths that follow `root`, opened where braces group several; a macro of the crate's root is no import.
fn paths_after(root: &str, code: &str) -> Vec<Vec<String>> {
    let mut paths = Vec::new();
    for (at, _) in code.match_indices(root) {
        let joined =
            code[..at].chars().next_back().is_some_and(|c| c.is_alphanumeric() || c == '_' || c == ':');
        if !joined {
            paths.extend(opened(&code[at + root.len()..]));
        }
    }
    paths
}

/// The paths at the beginning of a text: `a::b`, or `{a::b, c::{d, e}}`.
fn opened(text: &str) -> Vec<Vec<String>> {
    let text = text.trim_start();
    if let Some(group) = text.strip_prefix('{') {
        return items(group).into_iter().flat_map(opened).collect();
    }
    let end = text.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(text.len());
    let (name, rest) = text.split_at(end);
    if name.is_empty() || rest.starts_with('!') {
        return Vec::new();
    }
    let below = rest.strip_prefix("::").map(opened).unwrap_or_default();
    if below.is_empty() {
        return vec![vec![name.to_owned()]];
    }
    below.into_iter().map(|path| [vec![name.to_owned()], path].concat()).collect()
}

/// The items of a group whose opening brace has been read.
fn items(group: &str) -> Vec<&str> {
    let (mut depth, mut start, mut items) = (0, 0, Vec::new());
    for (at, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            ',' if depth == 0 => {
                items.push(&group[start..at]);
                start = at + 1;
            }
            '}' if depth == 0 => {
                items.push(&group[start..at]);
                break;
            }
            '}' => depth -= 1,
            _ => {}
        }
    }
    items
}

fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).expect("src can be listed").flatten() {
        let path = entry.path();
        if path.is_dir() {
            files.extend(sources(&path));
        } else if path.extension().is_some_and(|e| e == "rs") {
            files.push(path);
        }
    }
    files.sort();
    files
}

#[test]
fn every_import_follows_the_house() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let files = sources(&src);
    assert!(files.len() > 30, "only {} files were read", files.len());
    let mut found = Vec::new();
    for file in files {
        let path = file.strip_prefix(&src).expect("it lies below src").to_string_lossy().replace('\\', "/");
        found.extend(violations(&path, &fs::read_to_string(&file).expect("a source is text")));
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// The tables themselves must be one-way: nobody may import what stands below it.
#[test]
fn the_house_the_stages_and_the_verbs_have_one_direction() {
    for table in [HOUSE, STAGES, VERBS] {
        for (i, (module, allowed)) in table.iter().enumerate() {
            for name in *allowed {
                assert!(
                    table[..i].iter().any(|(row, _)| row == name),
                    "{module} may import {name}, which is not above it"
                );
            }
        }
    }
}

#[test]
fn every_stage_is_a_folder_of_few_files() {
    let critic = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/critic");
    let mut count: BTreeMap<PathBuf, usize> = BTreeMap::new();
    for file in sources(&critic) {
        *count.entry(file.parent().expect("it lies in a folder").to_path_buf()).or_default() += 1;
    }
    let full: Vec<_> = count.iter().filter(|(_, files)| **files > MOST_FILES).collect();
    assert!(full.is_empty(), "{full:?}");
    for (stage, _) in STAGES {
        assert!(count.contains_key(&critic.join(stage)), "the table has {stage}, and src/critic has not");
    }
}

#[test]
fn the_page_of_the_house_and_the_library_show_every_module_in_order() {
    let rows: Vec<&str> = HOUSE.iter().map(|(row, _)| *row).collect();
    for (file, head) in
        [("docs/house.md", "| Module | What it does |"), ("src/lib.rs", "| module | what is in it |")]
    {
        let text = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(file)).expect("it is there");
        let (_, table) = text.split_once(head).expect("the table of modules");
        let table = table.lines().map(|line| line.trim_start_matches("//!").trim()).skip(2);
        let first = |line: &str| line.split('|').nth(1).unwrap_or_default().replace(['`', '[', ']'], "");
        let shown: Vec<String> = table.take_while(|line| line.starts_with('|')).map(first).collect();
        assert_eq!(shown.join(",").replace(' ', ""), rows.join(","), "{file}");
    }
}

/// A recipe that names a file which has moved sends its reader astray.
#[test]
fn every_file_of_the_recipes_is_there() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = fs::read_to_string(root.join("docs/how-to-add.md")).expect("the page");
    let code = page.split('`').skip(1).step_by(2);
    let places = ["src", "tests", "docs", "distributions", "schemas", "benches"];
    let files: Vec<&str> = code
        .filter(|text| places.contains(&text.split('/').next().unwrap_or_default()))
        .filter(|text| !text.contains("NAME"))
        .collect();
    assert!(files.len() > 40, "{files:?}");
    let missing: Vec<_> = files.iter().filter(|file| !root.join(file).exists()).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

#[test]
fn bad_imports_are_found() {
    let bad = [
        ("law/coulomb.rs", "use crate::model::Wall;", "law/coulomb.rs imports model"),
        ("law/coulomb.rs", "use crate::{math::Vec3, model::{Block, Wall}};", "imports model"),
        ("law/coulomb.rs", "fn f() { let x = crate::solve::Solver::default(); }", "imports solve"),
        ("law/mod.rs", "use super::model::Wall;", "imports model"),
        ("contact/patch.rs", "use crate::random::Streams;", "imports random"),
        ("solve/explicit/step.rs", "use crate::solve::implicit::Newton;", "imports the implicit solver"),
        (
            "solve/explicit/step.rs",
            "use crate::solve::{Solver, limit::Multiplier};",
            "imports the limit solver",
        ),
        ("helpers/mod.rs", "", "has no row"),
        ("study/load.rs", "use super::super::law::Coulomb;", "climbs"),
        ("lib.rs", "use super::super::x;", "climbs"),
        ("critic/causes/ranking.rs", "use crate::critic::check::Check;", "imports critic::check"),
        ("critic/causes/mod.rs", "pub use super::advise::offers;", "imports critic::advise"),
        ("critic/simulate/bank/plan.rs", "use crate::critic::{verdict::Judge};", "imports critic::verdict"),
        // The face of the critic has all stages.
        ("critic/simulate/world.rs", "use crate::critic::Judge;", "imports critic::Judge"),
        ("critic/helpers/sums.rs", "", "no row in the table of stages"),
        ("render/text.rs", "use crate::study::Study;", "imports study"),
        ("terminal/output.rs", "use crate::verb::locate;", "imports verb"),
        ("verb/run/work.rs", "use crate::verb::capacity::CapacitySummary;", "imports verb::capacity"),
        (
            "verb/capacity/answer/text.rs",
            "use crate::verb::{compare::ask::Compare};",
            "imports verb::compare",
        ),
        ("verb/helpers/sums.rs", "", "no row in the table of verbs"),
    ];
    for (path, text, part) in bad {
        let found = violations(path, text).join("\n");
        assert!(found.contains(part), "{path}: `{text}` gave `{found}`");
    }
}

#[test]
fn good_imports_pass() {
    let good = [
        (
            "law/coulomb.rs",
            "use crate::math::{cos, sin};\nuse crate::law::NormalLaw;\ncrate::check!(true, \"x\");",
        ),
        ("law/coulomb.rs", "/// See [`crate::model::Wall`].\n// use crate::solve::Solver;"),
        ("model/mod.rs", "#[cfg(test)]\nmod tests { use super::*; use super::block::Block; }"),
        ("solve/explicit/step.rs", "use crate::solve::{assembly::Arrays, explicit::Settings};"),
        ("verb/run/answer/table.rs", "use crate::{\n    ensemble::Row,\n    study::{Arm, Study},\n};"),
        ("lib.rs", "pub mod law;"),
        (
            "critic/causes/ranking.rs",
            "use crate::critic::causes::network::Network;\nuse crate::critic::simulate::World;",
        ),
        (
            "critic/simulate/world.rs",
            "use crate::math::ln;\n#[cfg(test)]\nmod tests {\n    use crate::critic::verdict::Judge;\n}",
        ),
        ("critic/simulate/world/tests.rs", "use crate::critic::verdict::Judge;"),
        ("critic/method.rs", "use crate::critic::verdict::Judge;"),
        ("verb/capacity/work.rs", "use crate::verb::codes;\nuse crate::verb::run::page;"),
    ];
    for (path, text) in good {
        assert_eq!(violations(path, text), Vec::<String>::new(), "{path}: {text}");
    }
}
