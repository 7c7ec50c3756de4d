//! From the raw tables `[wall]` and `[[arm]]` to layouts, with the checks that need more than one key.

use crate::generate::{Arrangement, BatteredFace, Layout, Limits, Outline, Sizes, Wedges, Wythes};
use crate::math::radians;
use crate::protocol::Protocol;
use crate::random::Family;
use crate::study::catalogue::Catalogue;
use crate::study::cause::{Beside, Clash, Mechanisms};
use crate::study::checked::{Arm, Joint, Until};
use crate::study::fault::{Fault, Found};
use crate::study::keys;
use crate::study::quantity::quantity;
use crate::study::reader::Reader;
use crate::study::schema::Short;
use crate::study::setting::{Joints, Setting};
use crate::study::stones::stones;
use crate::study::uncertain::take_up;
use crate::study::wall_file;

/// Tables of the study that say nothing of walls from files.
const OF_DRAWN: [&str; 2] = ["wall", "block"];

/// What `[wall]` says, as far as it is not faulty.
#[derive(Clone, Copy, Debug, Default)]
pub struct WallKeys {
    height: Option<f64>,
    length: Option<f64>,
    base_thickness: Option<f64>,
    top_thickness: Option<f64>,
    battered_face: Option<BatteredFace>,
    turned: bool,
    bond: BondKeys,
}

/// How stones span the thickness and meet at head joints.
#[derive(Clone, Copy, Debug, Default)]
struct BondKeys {
    wythes: Option<u32>,
    header_share: Option<f64>,
    head_joint_gap: Option<f64>,
}

/// A stone's expected length and height (m) and the names of the keys that state them.
struct Stone {
    length: Option<f64>,
    height: Option<f64>,
    length_key: &'static str,
    height_key: &'static str,
}

/// Reads `[wall]`.
pub fn wall(t: &mut Reader<'_>) -> WallKeys {
    let keys = WallKeys {
        height: t.real("height_m"),
        length: t.real("length_m"),
        base_thickness: t.real("base_thickness_m"),
        top_thickness: t.real("top_thickness_m"),
        battered_face: t.choice("battered_face"),
        turned: t.flag("turned").unwrap_or(false),
        bond: BondKeys {
            wythes: t.whole32("wythes"),
            header_share: t.real("header_share"),
            head_joint_gap: t.real("head_joint_gap_m"),
        },
    };
    if let (Some(base), Some(top)) = (keys.base_thickness, keys.top_thickness)
        && top > base
    {
        t.fault(
            "top_thickness_m",
            format!("at most base_thickness_m = {base}"),
            "reduce it: the wall is built upside down",
        );
    }
    check_headers(t, keys.bond);
    keys
}

impl WallKeys {
    fn outline(&self) -> Option<Outline> {
        Some(Outline {
            length: self.length?,
            height: self.height?,
            base_thickness: self.base_thickness?,
            top_thickness: self.top_thickness?,
            battered_face: self.battered_face?,
        })
    }
}

/// Reads all `[[arm]]` tables.
pub fn arms(
    top: &mut Reader<'_>,
    shared: &Setting,
    protocol: Option<&Protocol>,
    catalogue: &mut Catalogue,
) -> Option<Vec<Arm>> {
    let mut arms: Vec<Option<Arm>> = Vec::new();
    let mut names: Vec<String> = Vec::new();
    let mut all_files = true;
    for (node, path) in top.tables("arm") {
        let Some(mut t) = Reader::open(&node, &path, &keys::ARM, top.notes) else {
            arms.push(None);
            all_files = false;
            continue;
        };
        let name = t.name("name");
        all_files &= t.chosen() == Some("file");
        if let Some(name) = &name {
            if names.contains(name) {
                t.fault("name", "every name once", "rename one of the arms");
            }
            names.push(name.clone());
        }
        arms.push(arm(&mut t, name, (shared, protocol), catalogue));
    }
    check_of_drawn(top, all_files && !arms.is_empty());
    top.record("arm", names.join(", "));
    let arms: Vec<Arm> = arms.into_iter().collect::<Option<_>>()?;
    (!arms.is_empty()).then_some(arms)
}

fn arm(
    t: &mut Reader<'_>,
    name: Option<String>,
    (shared, protocol): (&Setting, Option<&Protocol>),
    catalogue: &mut Catalogue,
) -> Option<Arm> {
    let setting = shared.of_arm(t, catalogue);
    let members = members(t);
    let vertical_load = if t.has("vertical_load_n") { Some(t.real("vertical_load_n")?) } else { None };
    let curve = if t.has("curve") { t.name("curve") } else { None };
    let layout = match t.chosen() {
        Some("file") => wall_file::layout(t, setting.density.as_ref().filter(|_| t.has("block")), catalogue),
        _ => drawn(t, &setting, catalogue),
    }?;
    let is_file = layout.arrangement.is_file();
    let Joints { joint, kn_points, sub_contacts } = setting.joints?;
    let mechanisms = setting.mechanisms?;
    check_mechanisms(t, &mechanisms, &joint, &layout)?;
    let (members, until) = members?;
    let arm = Arm {
        name: name?,
        members,
        until,
        curve,
        layout: mechanisms.layout(layout),
        turned: setting.wall.turned && !is_file,
        joint,
        kn_points,
        restraint: mechanisms.restraint(setting.restraint?),
        vertical_load,
        sub_contacts,
        mechanisms,
        uncertain: Vec::new(),
    };
    let arm = take_up(t, arm, setting.uncertain?, protocol)?;
    if until.is_some() && !arm.is_random() {
        t.fault("members", "a number where nothing is random", "set members = 1: every wall is the same");
        return None;
    }
    Some(arm)
}

/// The layout of walls that are drawn.
fn drawn(t: &mut Reader<'_>, setting: &Setting, catalogue: &mut Catalogue) -> Option<Layout> {
    let (wall, bond) = (&setting.wall, setting.wall.bond);
    let (arrangement, stone) = arrangement(t, catalogue, [wall.length, wall.height]);
    let has_wedges = t.has("wedges");
    let wedges = t.table("wedges").and_then(|mut w| wedges(&mut w, wall, &stone, catalogue));
    let limits = t.table("limits").and_then(|mut l| limits(&mut l, wall, &stone, bond));
    check_stone(t, &stone, wall, bond);
    if has_wedges && wedges.is_none() {
        return None;
    }
    Some(Layout {
        outline: wall.outline()?,
        arrangement: arrangement?,
        density: setting.density.clone()?,
        wythes: Wythes { count: bond.wythes?, header_share: bond.header_share? },
        head_joint_gap: bond.head_joint_gap?,
        wedges,
        limits: limits?,
    })
}

/// Tables that walls need which are drawn, and walls from files do not take.
fn check_of_drawn(top: &mut Reader<'_>, all_files: bool) {
    for name in OF_DRAWN {
        let place = top.place_of(name).clone();
        if !top.has(name) && !all_files {
            let allowed = format!("a table [{name}]");
            let fix = format!("add {name} to study.toml");
            top.notes.faults.push(Fault::at(&place, name, Found::Missing, allowed, fix));
        }
        if top.has(name) && all_files {
            let found = Found::Words(
                "has nothing to act on: files say where all stones are, and how heavy".to_owned(),
            );
            let fix = "remove it; another mean density belongs in [arm.block]";
            top.notes.faults.push(Fault::at(&place, name, found, "an arm whose walls are drawn", fix));
        }
    }
}

/// How many walls, at most, and when fewer are enough.
fn members(t: &mut Reader<'_>) -> Option<(u64, Option<Until>)> {
    if !t.is_table("members") {
        return Some((t.whole("members")?, None));
    }
    let mut rule = t.table("members")?;
    let (what, of, below, at_most) =
        (rule.choice_name("until"), rule.statistic("of"), rule.real("below"), rule.whole("at_most"));
    what?;
    let at_most = at_most?;
    Some((at_most, Some(Until { of: of?, below: below?, at_most })))
}

/// The arrangement of stones, none longer or higher than the wall, whose length and height (m) are given.
fn arrangement(
    t: &mut Reader<'_>,
    catalogue: &mut Catalogue,
    wall: [Option<f64>; 2],
) -> (Option<Arrangement>, Stone) {
    match t.chosen() {
        Some("continuous") => {
            let sizes = regular(t);
            (sizes.0.map(|[length, height]| Arrangement::Continuous { length, height }), sizes.1)
        }
        Some("discontinuous") => {
            let (sizes, stone) = regular(t);
            let overlap = t.real("overlap");
            let bond = sizes.zip(overlap);
            (
                bond.map(|([length, height], overlap)| Arrangement::Discontinuous {
                    length,
                    height,
                    overlap,
                }),
                stone,
            )
        }
        Some(random) => irregular(t, random, catalogue, wall),
        None => (None, Stone { length: None, height: None, length_key: "length_m", height_key: "height_m" }),
    }
}

fn regular(t: &mut Reader<'_>) -> (Option<[f64; 2]>, Stone) {
    let (length, height) = (t.real("block_length_m"), t.real("course_height_m"));
    let stone = Stone { length, height, length_key: "block_length_m", height_key: "course_height_m" };
    (length.zip(height).map(|(length, height)| [length, height]), stone)
}

fn irregular(
    t: &mut Reader<'_>,
    chosen: &str,
    catalogue: &mut Catalogue,
    wall: [Option<f64>; 2],
) -> (Option<Arrangement>, Stone) {
    let (sizes, stone) = sizes(t, catalogue, wall);
    let wall_size_factor = quantity(t, "wall_size_factor", catalogue);
    let dip = quantity(t, "dip_deg", catalogue).map(|dip| dip.scaled(radians(1.0)));
    let coursed = chosen == "coursed";
    let least_overlap = if coursed { t.real("least_overlap") } else { None };
    let dip_about = if coursed { None } else { t.choice("dip_about") };
    let build = || {
        let (sizes, wall_size_factor, dip) = (sizes?, wall_size_factor?, dip?);
        Some(if coursed {
            Arrangement::Coursed { sizes, wall_size_factor, dip, least_overlap: least_overlap? }
        } else {
            Arrangement::Cut { sizes, wall_size_factor, dip, dip_about: dip_about? }
        })
    };
    (build(), stone)
}

/// Lengths and heights of stones: two quantities, or the stones of a survey in their place.
fn sizes(t: &mut Reader<'_>, catalogue: &mut Catalogue, wall: [Option<f64>; 2]) -> (Option<Sizes>, Stone) {
    if t.has("stones") {
        let apart: Vec<&str> = ["length_m", "height_m"].into_iter().filter(|key| t.has(key)).collect();
        for key in &apart {
            t.fault(
                key,
                "only where the arm has no stones, which have lengths and heights",
                "remove one of the two",
            );
        }
        let stones = stones(t, catalogue, wall).filter(|_| apart.is_empty());
        let means = stones.as_ref().map(|own| own.marginals().map(|one| one.mean()));
        let [length, height] = [0, 1].map(|which| means.map(|own| own[which]));
        let stone = Stone { length, height, length_key: "stones", height_key: "stones" };
        return (stones.map(|stones| Sizes::Together { stones }), stone);
    }
    let length = quantity(t, "length_m", catalogue);
    let height = quantity(t, "height_m", catalogue);
    let stone = Stone {
        length: length.as_ref().map(Family::mean),
        height: height.as_ref().map(Family::mean),
        length_key: "length_m",
        height_key: "height_m",
    };
    (length.zip(height).map(|(length, height)| Sizes::Apart { length, height }), stone)
}

fn check_headers(t: &mut Reader<'_>, bond: BondKeys) {
    if let (Some(1), Some(share)) = (bond.wythes, bond.header_share)
        && share > 0.0
    {
        t.fault(
            "header_share",
            "0 where wythes = 1",
            "headers tie two or more wythes: raise wythes or remove the share",
        );
    }
}

fn wedges(t: &mut Reader<'_>, wall: &WallKeys, stone: &Stone, catalogue: &mut Catalogue) -> Option<Wedges> {
    let share = t.real("share");
    let height = quantity(t, "height_m", catalogue);
    let depth = quantity(t, "depth_m", catalogue);
    check_mean(t, "height_m", height.as_ref(), stone.height, "a stone's height");
    check_mean(t, "depth_m", depth.as_ref(), wall.base_thickness, "the wall's thickness at the base");
    Some(Wedges { share: share?, height: height?, depth: depth? })
}

/// The mean of a wedge's size must be below the size of what it is cut from.
fn check_mean(t: &mut Reader<'_>, name: &str, size: Option<&Family>, limit: Option<f64>, what: &str) {
    if let (Some(mean), Some(limit)) = (size.map(Family::mean), limit)
        && mean >= limit
    {
        t.fault(
            name,
            format!("a mean below {what}, {}", Short(limit)),
            format!("its mean is {}: reduce it", Short(mean)),
        );
    }
}

fn limits(t: &mut Reader<'_>, wall: &WallKeys, stone: &Stone, bond: BondKeys) -> Option<Limits> {
    let reals = t.reals(["min_size_m", "max_aspect", "min_volume_m3"]);
    let (redraws, attempts) = (t.whole32("max_redraws"), t.whole32("max_attempts"));
    let [min_size, max_aspect, min_volume] = reals?;
    let depth = wall.top_thickness.zip(bond.wythes).map(|(top, wythes)| top / f64::from(wythes));
    let extents = [(stone.length, "length"), (stone.height, "height"), (depth, "depth at the top")];
    for (extent, what) in extents {
        if let Some(extent) = extent.filter(|extent| min_size > *extent) {
            t.fault(
                "min_size_m",
                format!("at most a stone's {what}, {}", Short(extent)),
                "reduce it: no stone would pass",
            );
        }
    }
    Some(Limits { min_size, max_aspect, min_volume, max_redraws: redraws?, max_attempts: attempts? })
}

/// A stone must fit into the wall, and a head joint's gap into a stone.
fn check_stone(t: &mut Reader<'_>, stone: &Stone, wall: &WallKeys, bond: BondKeys) {
    let sides = [
        (stone.length_key, stone.length, wall.length, "wall.length_m"),
        (stone.height_key, stone.height, wall.height, "wall.height_m"),
    ];
    for (key, size, limit, limit_key) in sides {
        if let (Some(size), Some(limit)) = (size, limit)
            && size > limit
        {
            t.fault(
                key,
                format!("at most {limit_key} = {}", Short(limit)),
                "the block is larger than the wall: reduce it",
            );
        }
    }
    if let (Some(gap), Some(length)) = (bond.head_joint_gap, stone.length)
        && 2.0 * gap > length
    {
        let found = Found::Words(format!("does not fit stones of length {}", Short(length)));
        let allowed = format!("a gap of at most half a stone, {}", Short(0.5 * length));
        let key = crate::study::reader::join(&t.path, "head_joint_gap_m");
        let fault = Fault::at(t.place_of("head_joint_gap_m"), &key, found, allowed, "reduce the gap");
        t.notes.faults.push(fault);
    }
}

/// What a mechanism needs of the other tables.
fn check_mechanisms(
    t: &mut Reader<'_>,
    mechanisms: &Mechanisms,
    joint: &Joint,
    layout: &Layout,
) -> Option<()> {
    let before = t.notes.faults.len();
    for (name, Clash { what, allowed, fix }) in mechanisms.clashes(&Beside { joint, layout, mechanisms }) {
        let key = crate::study::reader::join(&t.path, &format!("mechanism.{name}"));
        let fault = Fault::at(t.place_of("mechanism"), &key, Found::Words(what), allowed, fix);
        t.notes.faults.push(fault);
    }
    (t.notes.faults.len() == before).then_some(())
}
