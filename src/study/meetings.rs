//! Where the blocks of a wall from elsewhere meet: what makes the wall unfit, and what its user should know.

use crate::contact;
use crate::contact::{Pair, Survey, survey};
use crate::exchange::{Fault, WallFaults, WallFile};
use crate::math::{Vec3, cbrt};
use crate::model::{Support, Wall};
use crate::protocol::pile_thicknesses;
use crate::shape::Polyhedron;

/// An overlap deeper than this share of the smaller block's size (edge of the cube of its volume) is no modelling gap.
const DEEPEST: f64 = 0.01;
/// Overlaps and gaps of a kind that are named.
const LISTED: usize = 3;
/// Faces that look at each other across at most this share of a stone's size are told of: they may be meant as a joint.
const TOLD_WITHIN: f64 = 0.1;
/// A gap that is to be a joint needs a tolerance above it by this factor.
const ABOVE: f64 = 1.1;
/// Contacts are looked for up to so many tolerances, so that what touches is well within.
const REACHES: f64 = 2.0;
/// Sub-contacts along the longer and the shorter side of a joint. Friction acts at the middle of a sub-contact and not where
/// the pressure is, which turns a block that slides under an eccentric load: on a joint of any shape 2 x 2 cost up to 1.2 deg.
const SUB_CONTACTS: [u32; 2] = [4, 4];

/// How far apart blocks may be that touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tolerance {
    /// Share of the size of the part that moves, corner to corner.
    Share(f64),
    /// Length (m).
    Length(f64),
}

/// Share of the size within which blocks touch where no tolerance is asked for.
pub const TOUCH: f64 = 1e-6;

/// A wall that is fit to be solved.
pub struct Fit {
    /// Tolerances of contact detection; gaps up to `closed` are joints, for the survey and for all solvers.
    pub contact: contact::Settings,
    /// Thickness (m) of the pile of every block, and of the thinnest one.
    pub piles: Vec<f64>,
    pub thickness: f64,
    /// Number of joints.
    pub joints: usize,
    /// Deepest overlap of a joint (m).
    pub deepest: f64,
    /// Overlaps and gaps with their size.
    pub warnings: Vec<String>,
}

/// Looks where the blocks meet; messages call the file `path`.
///
/// # Errors
/// Overlaps that are no modelling gaps, blocks that float, and walls too entangled to be looked over.
pub fn look(file: &WallFile, tolerance: Tolerance, path: &str) -> Result<Fit, WallFaults> {
    let mut faults = WallFaults::new(path);
    let size = stone_size(&file.wall);
    let standard = contact::Settings::for_size(size, SUB_CONTACTS);
    let (low, high) = bounds(&file.wall);
    let touch = match tolerance {
        Tolerance::Share(share) => share * (high - low).norm(),
        Tolerance::Length(length) => length,
    };
    let within = TOLD_WITHIN * size;
    if let Some(fault) = above_a_tenth("--touch-tolerance", touch, size, "or close the gaps in the file") {
        faults.push(fault);
        return Err(faults);
    }
    let contact = contact::Settings {
        closed: touch.max(standard.touch),
        reach: standard.reach.max(REACHES * touch),
        ..standard
    };
    let Some(found) = survey(&file.wall, &contact, within) else {
        faults.push(entangled());
        return Err(faults);
    };
    let mut deepest_first: Vec<&Pair> = found.overlaps.iter().collect();
    deepest_first.sort_by(|a, b| b.length.total_cmp(&a.length));
    for pair in deepest_first {
        let depth_allowed = deepest_allowed(&file.wall, pair);
        if pair.length > depth_allowed {
            faults.push(Fault::of(
                &file.names[pair.blocks.0],
                format!("it overlaps {} by {}", file.names[pair.blocks.1], length(pair.length)),
                format!("at most {} ({DEEPEST} of the smaller block)", length(depth_allowed)),
                "move or trim one of them; or remove the one that is there twice",
            ));
        }
    }
    for group in &found.floating {
        faults.push(floating(file, group, &found));
    }
    if !faults.is_empty() {
        return Err(faults);
    }
    let piles = pile_thicknesses(&file.wall, found.joints.iter().copied());
    Ok(Fit {
        contact,
        thickness: piles.iter().copied().filter(|own| *own > 0.0).fold(f64::INFINITY, f64::min),
        piles,
        joints: found.joints.len(),
        deepest: found.deepest,
        warnings: told(file, &found, touch),
    })
}

/// The fault of a length (m) that was asked for by an option and is above a tenth of a stone of a size (m).
pub(super) fn above_a_tenth(option: &str, asked: f64, size: f64, or: &str) -> Option<Fault> {
    let most = TOLD_WITHIN * size;
    (asked > most).then(|| {
        let allowed = format!("at most {}, a tenth of a stone", length(most));
        Fault::of("", format!("{option} is {}", length(asked)), allowed, format!("give a shorter one, {or}"))
    })
}

/// The fault of a wall with too many near pairs to be looked over.
pub(super) fn entangled() -> Fault {
    Fault::of(
        "",
        "the blocks are entangled: far too many of them overlap or nearly touch",
        "blocks that touch their neighbours only",
        "check the unit and whether blocks are there several times",
    )
}

fn floating(file: &WallFile, group: &[usize], found: &Survey) -> Fault {
    let outside = |pair: &&Pair| group.contains(&pair.blocks.0) != group.contains(&pair.blocks.1);
    let nearest = found.gaps.iter().filter(outside).min_by(|a, b| a.length.total_cmp(&b.length));
    let fix = match nearest {
        Some(pair) => format!(
            "the nearest, {} and {}, are {} apart: close the gap, or raise --touch-tolerance",
            file.names[pair.blocks.0],
            file.names[pair.blocks.1],
            length(pair.length)
        ),
        None => "put something under it, or set \"fixed\": true".to_owned(),
    };
    let (whom, what) = match group {
        [_] => (file.names[group[0]].clone(), "it floats free".to_owned()),
        _ => {
            let names: Vec<&str> = group.iter().take(8).map(|&i| file.names[i].as_str()).collect();
            let dots = if group.len() > 8 { ", ..." } else { "" };
            let all = format!("{} blocks float free together: {}{dots}", group.len(), names.join(", "));
            (file.names[group[0]].clone(), all)
        }
    };
    Fault::of(&whom, what, "a chain of touching blocks from every block to a fixed one", fix)
}

/// Overlaps, the deepest first, and gaps, the narrowest first: one warning of each kind.
fn told(file: &WallFile, found: &Survey, touch: f64) -> Vec<String> {
    let names = |pair: &Pair| {
        let [a, b] = [pair.blocks.0, pair.blocks.1].map(|at| file.names[at].as_str());
        format!("{a} and {b}")
    };
    let sorted = |pairs: &[Pair], sign: f64| {
        let mut pairs = pairs.to_vec();
        pairs.sort_by(|a, b| (sign * a.length).total_cmp(&(sign * b.length)));
        pairs
    };
    // Of many the number, the range and the first ones say where to look.
    let listed = |pairs: &[Pair]| {
        let first =
            pairs.iter().take(LISTED).map(|pair| format!("{} ({})", names(pair), length(pair.length)));
        let more = if pairs.len() > LISTED { ", ..." } else { "" };
        format!("{}{more}", first.collect::<Vec<_>>().join(", "))
    };
    let kind =
        |pairs: &[Pair], one: &dyn Fn(&Pair) -> String, many: &dyn Fn([String; 2]) -> String| match pairs {
            [] => None,
            [only] => Some(one(only)),
            [first, .., last] => {
                let said = many([length(first.length), length(last.length)]);
                Some(format!("{} {said}: {}", pairs.len(), listed(pairs)))
            }
        };
    let tolerance = length(touch);
    let gaps = sorted(&found.gaps, 1.0);
    let group = |pair: &Pair| file.wall.blocks[pair.blocks.0].group.as_deref().unwrap_or_default();
    let kinds = [
        kind(
            &sorted(&found.overlaps, -1.0),
            &|pair| format!("{} overlap by {}", names(pair), length(pair.length)),
            &|[most, least]| format!("pairs of blocks overlap, by {most} down to {least}"),
        ),
        kind(
            &sorted(&found.shared, -1.0),
            &|pair| {
                let (names, by) = (names(pair), length(pair.length));
                format!(
                    "{names} overlap by {by}: parts of group \"{}\": what they share weighs twice",
                    group(pair)
                )
            },
            &|[most, _]| {
                format!("pairs of parts of one stone overlap, by up to {most}; what they share weighs twice")
            },
        ),
        kind(
            &gaps,
            &|pair| {
                let (names, wide) = (names(pair), length(pair.length));
                format!("a gap of {wide} between {names}: they do not touch (tolerance {tolerance})")
            },
            &|[least, most]| {
                format!(
                    "gaps between blocks, {least} to {most} wide: they do not touch (tolerance {tolerance})"
                )
            },
        ),
        kind(
            &sorted(&found.gaping, -1.0),
            &|pair| {
                let (names, wide) = (names(pair), length(pair.length));
                format!("the joint between {names} gapes by up to {wide}: it carries only where it touches")
            },
            &|[most, _]| format!("joints gape, by up to {most}, and carry only where they touch"),
        ),
    ];
    let mut warnings: Vec<String> = kinds.into_iter().flatten().collect();
    if let Some(narrowest) = gaps.first() {
        warnings.push(format!(
            "gaps carry nothing; for those that are meant as joints raise the tolerance, as --touch-tolerance {:.3}mm does for the narrowest",
            1e3 * ABOVE * narrowest.length
        ));
    }
    warnings.extend(uneven(found, TOUCH * (bounds(&file.wall).1 - bounds(&file.wall).0).norm()));
    for lead in &found.scattered {
        let group = file.wall.blocks[*lead].group.as_deref().unwrap_or_default();
        warnings.push(format!(
            "the parts of group \"{group}\" do not all touch one another; they are one body all the same"
        ));
    }
    warnings
}

/// Joints whose faces are not one plane, which a wider tolerance than usual hides: by more than rounding (m).
fn uneven(found: &Survey, rounding: f64) -> Option<String> {
    let joints = found.uneven.iter().filter(|pair| pair.length > rounding);
    let (count, most) = joints.fold((0, 0.0_f64), |(count, most), pair| (count + 1, most.max(pair.length)));
    (count > 0).then(|| {
        format!(
            "in {count} of {} joints the faces are not one plane, by up to {}: wedges, edges and overlaps, which every solver reads in its own way; \
             --mend {:.3}mm makes them planes",
            found.joints.len(),
            length(most),
            1e3 * ABOVE * most
        )
    })
}

/// A length in millimetres.
pub(super) fn length(metres: f64) -> String {
    let mm = 1000.0 * metres;
    if mm >= 0.001 { format!("{} mm", (mm * 1e4).round() / 1e4) } else { format!("{mm:.1e} mm") }
}

fn deepest_allowed(wall: &Wall, pair: &Pair) -> f64 {
    let edge = |i: usize| cbrt(wall.blocks[i].volume());
    DEEPEST * edge(pair.blocks.0).min(edge(pair.blocks.1))
}

fn free(wall: &Wall) -> impl Iterator<Item = &Polyhedron> {
    wall.blocks.iter().filter(|b| b.support != Support::Fixed).map(|b| &b.shape)
}

/// Box around the blocks that move (m): a large ground does not loosen the tolerance.
pub fn bounds(wall: &Wall) -> (Vec3, Vec3) {
    let corners = free(wall).flat_map(|shape| shape.vertices.iter().copied()).collect();
    Polyhedron { vertices: corners, faces: Vec::new() }.bounds()
}

/// Edge of the cube with the mean volume of the stones that move (m), the parts of one taken together.
pub(super) fn stone_size(wall: &Wall) -> f64 {
    let leads = wall.leads();
    let bodies =
        wall.blocks.iter().enumerate().filter(|(id, b)| b.support != Support::Fixed && leads[*id] == *id);
    let volume: f64 = free(wall).map(Polyhedron::volume).sum();
    cbrt(volume / bodies.count().max(1) as f64)
}
