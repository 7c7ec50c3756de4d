//! Walls from files: an arm whose stones a file beside the study describes.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::exchange::{
    self, Choice, Format, Nature, ReadOptions, Unit, Up, WallFaults, WallFile, leaves_units_open,
    read_wall_bytes, states_no_units, wall_bytes,
};
use crate::generate::{Arrangement, BatteredFace, Layout, Limits, Outline, Unseen, Wythes, mean_density};
use crate::math::radians;
use crate::model::{Support, Tag, Wall};
use crate::random::Family;
use crate::study::catalogue::Catalogue;
use crate::study::checked::InputFile;
use crate::study::fault::{Fault, Found};
use crate::study::files::sha256;
use crate::study::meetings::{TOUCH, Tolerance, look};
use crate::study::mending::{mended, wider};
use crate::study::quantity::quantity;
use crate::study::reader::{Reader, join};

/// Stones whose depths differ by less than this share go through the wall alike: rounding.
const SAME_DEPTH: f64 = 1e-9;

/// A file as an arm reads it.
#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    /// What it does not say about itself.
    options: ReadOptions,
    /// Up to which length (m) joints are mended.
    mend: Option<f64>,
    /// How far apart blocks may be that touch.
    tolerance: Tolerance,
}

/// A wall that was read and looked over.
#[derive(Debug)]
pub struct Standing {
    /// The stones, and behind them the fixed blocks that it stands on, if the file has any.
    wall: Arc<Wall>,
    joints: usize,
    /// Gap (m) up to which faces touch.
    touch: f64,
    sha256: String,
    warnings: Vec<String>,
}

/// What came of reading a wall.
type Read = Result<Arc<Standing>, Vec<Fault>>;

/// The files of walls beside a study, each read once.
#[derive(Debug, Default)]
pub struct WallFiles {
    /// The bytes of the files by their names, as the study gives them.
    pub bytes: BTreeMap<String, Arc<[u8]>>,
    read: Vec<(String, Asked, Read)>,
    /// The files read, in that order.
    pub inputs: Vec<InputFile>,
}

impl WallFiles {
    /// Whether a file states its unit and its densities. One that cannot be read is told as such later.
    fn states_units(&self, file: &str, path: &Path) -> bool {
        match self.bytes.get(file) {
            Some(bytes) => !states_no_units(file, bytes),
            None => !leaves_units_open(path),
        }
    }

    /// The wall in a file, which lies at `path` where its bytes are not known already.
    fn wall(&mut self, file: &str, path: PathBuf, asked: &Asked) -> Read {
        if let Some((.., known)) = self.read.iter().find(|(name, how, _)| name == file && how == asked) {
            return known.clone();
        }
        // Behind the surveys and the records.
        let rank = 3000 + self.read.len();
        let found = self.standing(file, path, asked);
        let found = found.map(Arc::new).map_err(|faults| as_faults(file, rank, faults));
        self.read.push((file.to_owned(), asked.clone(), found.clone()));
        found
    }

    fn standing(&mut self, file: &str, path: PathBuf, asked: &Asked) -> Result<Standing, WallFaults> {
        let bytes = match self.bytes.get(file) {
            Some(bytes) => bytes.clone(),
            None => {
                let bytes: Arc<[u8]> = wall_bytes(&path, file)?.into();
                self.inputs.push(InputFile { path: PathBuf::from(file), sha256: sha256(&bytes) });
                self.bytes.insert(file.to_owned(), bytes.clone());
                bytes
            }
        };
        let mut read = stones_first(read_wall_bytes(file, &bytes, &asked.options)?);
        let is_drawn = Format::of(file).is_some_and(Format::is_drawn);
        if let Some(within) = asked.mend.filter(|_| !is_drawn) {
            read = mended(&read.on_ground(), within, file)?.0.without_platform(&read);
        }
        let fit = look(&read.on_ground(), asked.tolerance, file)?;
        Ok(Standing {
            wall: Arc::new(read.wall),
            joints: fit.joints,
            touch: fit.contact.closed,
            sha256: sha256(&bytes),
            warnings: [read.warnings, fit.warnings].concat(),
        })
    }
}

/// The blocks that move before those that are fixed. Fixed blocks are the base, and blocks that move are stones, whatever they are called.
fn stones_first(file: WallFile) -> WallFile {
    let WallFile { wall, ids, names, warnings, .. } = file;
    let mut all: Vec<_> = wall.blocks.into_iter().zip(ids).zip(names).collect();
    all.sort_by_key(|((block, _), _)| block.support == Support::Fixed);
    // What was drawn is of the blocks in their former order, and nobody asks for it here.
    let mut ordered =
        WallFile { wall: Wall::default(), ids: Vec::new(), names: Vec::new(), warnings, drawn: None };
    for ((mut block, id), name) in all {
        block.tag = match (block.support, block.tag) {
            (Support::Fixed, _) => Tag::Base,
            (_, Tag::Base | Tag::End) => Tag::Stone,
            (_, tag) => tag,
        };
        ordered.wall.blocks.push(block);
        ordered.ids.push(id);
        ordered.names.push(name);
    }
    ordered
}

/// What is wrong with a file, among the faults of a study.
fn as_faults(file: &str, rank: usize, faults: WallFaults) -> Vec<Fault> {
    let more = faults.more;
    let mut all: Vec<Fault> = faults.faults.iter().map(|fault| as_fault(file, rank, fault)).collect();
    if more > 0 {
        let found = format!("has {more} more faults");
        all.push(Fault::of_file(file, rank, &found, "none", "mend the first ones, and see what is left"));
    }
    all
}

fn as_fault(file: &str, rank: usize, fault: &exchange::Fault) -> Fault {
    let block = if fault.block.is_empty() { String::new() } else { format!("{}: ", fault.block) };
    let times = if fault.times > 1 { format!(" ({} times)", fault.times) } else { String::new() };
    let found = format!("{block}{}{times}", fault.found);
    let keys = same_keys(&format!("{found} {} {}", fault.allowed, fault.fix));
    let fix = format!("{}{keys}", fault.fix);
    Fault::of_file(file, rank, &found, &fault.allowed, fix).in_line(fault.line)
}

/// Behind a message, the keys that stand for the options which it names.
fn same_keys(message: &str) -> String {
    let named = [("--touch-tolerance", "touch_tolerance_m"), ("--fixed", "fixed")];
    let all = Choice::ALL.map(|own| (own.option(), own.key())).into_iter().chain(named);
    let said = all.filter(|(option, _)| message.contains(option));
    said.map(|(option, key)| format!(" ({option} is {key} of the arm)")).collect()
}

/// Reads an arm whose stones a file describes. `density` (kg/m^3) is what the arm says of its stones in the place of the file.
pub fn layout(t: &mut Reader<'_>, density: Option<&Family>, catalogue: &mut Catalogue) -> Option<Layout> {
    let (file, node) = t.file("file")?;
    let path = join(&t.path, "file");
    let fault = |allowed: String, fix: &str| {
        Box::new(Fault::at(&node.place, &path, Found::Value(node.shown.clone()), allowed, fix))
    };
    let place = match catalogue.place_of_wall(&file, &fault) {
        Ok(place) => place,
        Err(fault) => {
            t.notes.faults.push(*fault);
            return None;
        }
    };
    let states_units = catalogue.walls.states_units(&file, &place);
    let asked = asked(t, &file, states_units)?;
    let standing = match catalogue.walls.wall(&file, place, &asked) {
        Ok(standing) => standing,
        Err(faults) => {
            t.notes.faults.extend(faults);
            return None;
        }
    };
    t.record("file", format_args!("{file} {}", standing.sha256));
    for warning in &standing.warnings {
        let found = Found::Words(format!("{file}: {warning}{}", same_keys(warning)));
        let fix = "look whether it is meant, and change the file if not";
        t.notes.warnings.push(Fault::at(&node.place, &path, found, "this", fix));
    }
    let density = mean(t, density, mean_density(&standing.wall))?;
    let has_unseen = t.has("unseen");
    if has_unseen && !goes_through(&standing.wall) {
        let allowed =
            "only for a wall whose file shows its face alone: stones of this file have depths of their own";
        t.fault("unseen", allowed, "remove it");
        return None;
    }
    let unseen = t.table("unseen").and_then(|mut own| unseen(&mut own, &standing.wall, catalogue));
    if has_unseen && unseen.is_none() {
        return None;
    }
    Some(of_standing(file, &standing, density, unseen))
}

/// The layout of a wall that was read, with a mean density (kg/m^3).
fn of_standing(file: String, standing: &Standing, density: f64, unseen: Option<Unseen>) -> Layout {
    let (low, high) = standing.wall.bounds_of_stones();
    let size = high - low;
    Layout {
        outline: Outline {
            length: size.x,
            height: size.z,
            base_thickness: size.y,
            top_thickness: size.y,
            battered_face: BatteredFace::Both,
        },
        arrangement: Arrangement::File {
            file,
            sha256: standing.sha256.clone(),
            joints: standing.joints,
            touch: standing.touch,
            wall: standing.wall.clone(),
            unseen,
        },
        density: Family::Constant { value: density },
        wythes: Wythes { count: 1, header_share: 0.0 },
        head_joint_gap: 0.0,
        wedges: None,
        // Nothing is drawn that could be too small, or be drawn anew.
        limits: Limits {
            min_size: 0.0,
            max_aspect: f64::INFINITY,
            min_volume: 0.0,
            max_redraws: 0,
            max_attempts: 1,
        },
    }
}

/// Whether every stone goes through the wall, as those do of which a file shows the face.
fn goes_through(wall: &Wall) -> bool {
    let (low, high) = wall.bounds_of_stones();
    wall.stones().all(|(_, block)| {
        let (near, far) = block.shape.bounds();
        block.scan.is_none() && (near.y - low.y).max(high.y - far.y) <= SAME_DEPTH * (high.y - low.y)
    })
}

/// What is drawn behind the face of a wall.
fn unseen(t: &mut Reader<'_>, wall: &Wall, catalogue: &mut Catalogue) -> Option<Unseen> {
    let [through_share, depth_share, core_share] =
        ["through_share", "depth_share", "core_share"].map(|key| quantity(t, key, catalogue));
    let dip = quantity(t, "dip_deg", catalogue).map(|dip| dip.scaled(radians(1.0)));
    let (dip, core_share, depth_share, through_share) = (dip?, core_share?, depth_share?, through_share?);
    if wall.has_base() && dip != (Family::Constant { value: 0.0 }) {
        t.fault(
            "dip_deg",
            "0 on a ground that the file shows: beds dip where the wall stands on the plane z = 0",
            "set it to 0",
        );
        return None;
    }
    Some(Unseen { through_share, depth_share, core_share, dip })
}

/// How the file is to be read.
fn asked(t: &mut Reader<'_>, file: &str, states_units: bool) -> Option<Asked> {
    let before = t.notes.faults.len();
    let nature = Nature { format: Format::of(file), states_units };
    let stated: Vec<Choice> = Choice::ALL.into_iter().filter(|own| t.has(own.key())).collect();
    for choice in &stated {
        if let Some(why) = choice.in_vain(nature, &stated) {
            t.fault(choice.key(), why, "remove it");
        }
    }
    let fixed: Vec<u64> = match t.has("fixed").then(|| t.list("fixed")).flatten() {
        Some(ids) if ids.iter().any(|id| id.fract() != 0.0) => {
            t.fault("fixed", "ids of blocks, which are whole numbers", "write them as in the file");
            Vec::new()
        }
        ids => ids.unwrap_or_default().into_iter().map(|id| id as u64).collect(),
    };
    let thickness = t.has("thickness_m").then(|| t.real("thickness_m")).flatten();
    let parts = t.has("parts").then(|| t.flag("parts")).flatten().unwrap_or(false);
    let section = t.has("section").then(|| t.flag("section")).flatten().unwrap_or(false);
    let unit = if t.has("unit") { t.choice_name("unit").and_then(Unit::named) } else { None };
    let up = if t.has("up_axis") { t.choice_name("up_axis") } else { None };
    let mut real = |key: &str| if t.has(key) { t.real(key) } else { None };
    let density = real("unstated_density_kg_per_m3");
    let (flatness, mend, touch) = (real("flatness_m"), real("mend_m"), real("touch_tolerance_m"));
    let (scan_bearing, turn) = (real("scan_bearing_m"), real("turn_deg"));
    let (pixel, width) = (real("pixel_m"), real("width_m"));
    let options = ReadOptions {
        unit,
        density,
        up: up.and_then(Up::named),
        any_shape: Format::of(file).is_some_and(Format::is_mesh),
        flatness: wider(flatness, mend),
        scan_bearing,
        parts,
        thickness,
        pixel,
        width,
        closing: mend,
        section,
        fixed,
        turn: radians(turn.unwrap_or(0.0)),
        on_platform: true,
    };
    let asked = Asked { options, mend, tolerance: touch.map_or(Tolerance::Share(TOUCH), Tolerance::Length) };
    (t.notes.faults.len() == before).then_some(asked)
}

/// Mean density (kg/m^3) of the stones: that of the file, or what the arm says, to which all are made as much heavier or lighter.
fn mean(t: &mut Reader<'_>, stated: Option<&Family>, of_file: f64) -> Option<f64> {
    match stated {
        None => Some(of_file),
        Some(Family::Constant { value }) => Some(*value),
        Some(_) => {
            let allowed = "one number, the mean density: the file says how those of its stones differ";
            let fix = "write the distribution of the mean as \"block.density_kg_per_m3\" in [arm.uncertain]";
            t.fault("block", allowed, fix);
            None
        }
    }
}
