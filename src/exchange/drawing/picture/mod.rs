//! Pictures of a wall's face in which the stones are areas of one colour each: labels, or stones and joints in two colours.

mod stones;
mod trace;

use std::collections::{BTreeMap, HashMap};
use std::io::Cursor;

use image::{DynamicImage, GenericImageView, GrayImage, ImageDecoder, ImageReader, Limits};

use crate::exchange::drawing::Drawing;
use crate::exchange::drawing::picture::stones::{Areas, NONE, areas};
use crate::exchange::drawing::picture::trace::around;
use crate::exchange::fault::{Fault, WallFaults};
use crate::face::{Outline, Part};

/// Longest side of a picture (pixels), and most bytes of it in memory.
const LONGEST: u32 = 32_768;
const MOST_BYTES: u64 = 1 << 30;
/// Most stones.
const MOST_STONES: usize = 50_000;
/// A picture of labels has no more colours than this that fill an area.
const MOST_COLOURS: usize = 20_000;
/// A picture of two colours has at most this share of pixels that are neither.
const BETWEEN: f64 = 0.1;
/// Least difference of both, in grey levels of 255, and what each scatters at most.
const CONTRAST: f64 = 32.0;
const NOISE: f64 = 10.0;
/// Channels of what is no grey differ by more than this.
const COLOURED: u8 = 24;
/// The share of a picture that areas of one colour fill at least, where they are labels.
const COVERED: f64 = 0.6;
/// A picture in which more than this share is transparent shows stones as what is not.
const TRANSPARENT: f64 = 0.01;
/// A colour is that of the joints where it meets this share of all areas.
const MEETS: f64 = 0.5;
/// A pixel is transparent below this share of 255.
const OPAQUE: u8 = 128;

/// The outlines of the stones in a picture, in pixels: x from its left, z from its lower end.
pub(in crate::exchange) fn read_picture(bytes: &[u8]) -> Result<Drawing, WallFaults> {
    let picture = decoded(bytes).map_err(|fault| refused(*fault))?;
    let (width, height) = picture.dimensions();
    let mut drawing = Drawing { picture: Some([width, height].map(f64::from)), ..Drawing::default() };
    let colours = colours(&picture);
    let grey = picture.to_luma8();
    let tones = Tones::of(&grey);
    let labels = if is_two_toned(&picture, &tones) { None } else { labelled(&colours, width as usize) };
    let found = match labels {
        Some(areas) => areas,
        None => two_tones(&grey, &tones, &colours, &mut drawing.warnings).map_err(|fault| refused(*fault))?,
    };
    let Areas { of_pixel, count, first, notes } = found;
    drawing.warnings.extend(notes);
    if count > MOST_STONES {
        let found = format!("{count} areas of one colour");
        return Err(refused(told(
            found,
            format!("at most {MOST_STONES} stones"),
            "divide the picture, or clean it of specks",
        )));
    }
    if count == 0 {
        let allowed = "one colour per stone, or light stones and dark joints";
        return Err(refused(told("no stones are seen in it", allowed, "fill each stone with a colour")));
    }
    let outlines = first.into_iter().enumerate().map(|(stone, start)| Outline {
        name: format!("stone {stone}"),
        line: 0,
        part: Part::Stone,
        points: around(&of_pixel, width as usize, start)
            .into_iter()
            .map(|[x, y]| [f64::from(x), f64::from(height) - f64::from(y)])
            .collect(),
    });
    drawing.outlines = outlines.collect();
    Ok(drawing)
}

/// A fault of the picture as a whole.
fn told(found: impl Into<String>, allowed: impl Into<String>, fix: &str) -> Fault {
    Fault::of("", found, allowed, fix)
}

fn refused(fault: Fault) -> WallFaults {
    let mut faults = WallFaults::new("picture");
    faults.push(fault);
    faults
}

/// The picture, upright as its camera says.
fn decoded(bytes: &[u8]) -> Result<DynamicImage, Box<Fault>> {
    let fault = |error: &dyn std::fmt::Display| {
        let found = format!("it cannot be read as a picture: {error}");
        Box::new(told(found, "PNG, TIFF or JPEG", "save it anew as PNG"))
    };
    let mut reader =
        ImageReader::new(Cursor::new(bytes)).with_guessed_format().map_err(|error| fault(&error))?;
    let mut limits = Limits::default();
    limits.max_image_width = Some(LONGEST);
    limits.max_image_height = Some(LONGEST);
    limits.max_alloc = Some(MOST_BYTES);
    reader.limits(limits);
    let mut decoder = reader.into_decoder().map_err(|error| fault(&error))?;
    let upright = decoder.orientation().map_err(|error| fault(&error))?;
    let mut picture = DynamicImage::from_decoder(decoder).map_err(|error| fault(&error))?;
    picture.apply_orientation(upright);
    Ok(picture)
}

/// The colour of each pixel as a number; 0 where it is transparent.
fn colours(picture: &DynamicImage) -> Vec<u64> {
    // Labels of more than 255 stones are grey values of 16 bits.
    if let DynamicImage::ImageLuma16(grey) = picture {
        return grey.pixels().map(|own| 1 + u64::from(own.0[0])).collect();
    }
    let rgba = picture.to_rgba8();
    rgba.pixels()
        .map(|own| {
            let [r, g, b, opaque] = own.0;
            if opaque < OPAQUE { 0 } else { 1 + u64::from(u32::from_be_bytes([0, r, g, b])) }
        })
        .collect()
}

/// The stones of a picture of labels; `None` of one in which areas have no colour of their own.
fn labelled(colours: &[u64], width: usize) -> Option<Areas> {
    let found = areas(colours, width, &|_| true);
    let mut of_colour = BTreeMap::<u64, Vec<usize>>::new();
    for (area, at) in found.first.iter().enumerate() {
        of_colour.entry(colours[*at]).or_default().push(area);
    }
    let covered = found.of_pixel.iter().filter(|own| **own != NONE).count() as f64 / colours.len() as f64;
    if !(3..=MOST_COLOURS).contains(&of_colour.len()) || covered < COVERED {
        return None;
    }
    let ground = behind(colours, width, &found, &of_colour);
    let mut kept = areas(colours, width, &|colour| !ground.contains(&colour));
    for colour in &ground {
        kept.notes.push(format!("what is {} is taken for joints and background", named(*colour)));
    }
    Some(kept)
}

/// The colours of joints and of what lies around the wall: transparent; else black or white where it is at the rim; and any that most areas meet.
fn behind(colours: &[u64], width: usize, found: &Areas, of_colour: &BTreeMap<u64, Vec<usize>>) -> Vec<u64> {
    let mut meets: HashMap<u64, Vec<u32>> = HashMap::new();
    let height = colours.len() / width;
    for at in 0..colours.len() {
        let right = ((at + 1) % width != 0).then_some(at + 1);
        let below = (at / width + 1 < height).then_some(at + width);
        for other in [right, below].into_iter().flatten() {
            let [one, two] = [found.of_pixel[at], found.of_pixel[other]];
            if colours[at] != colours[other] {
                if two != NONE {
                    meets.entry(colours[at]).or_default().push(two);
                }
                if one != NONE {
                    meets.entry(colours[other]).or_default().push(one);
                }
            }
        }
    }
    let areas = found.count;
    let mut degree: Vec<(usize, u64)> = meets
        .into_iter()
        .filter(|(colour, _)| of_colour.contains_key(colour) || *colour == 0)
        .map(|(colour, mut own)| {
            own.sort_unstable();
            own.dedup();
            (own.len(), colour)
        })
        .collect();
    degree.sort_unstable_by(|a, b| b.cmp(a));
    let rim: Vec<u64> = (0..colours.len())
        .filter(|at| at % width == 0 || (at + 1) % width == 0 || at / width == 0 || at / width + 1 == height)
        .map(|at| colours[at])
        .collect();
    let usual = [0, BLACK, WHITE, BLACK_16, WHITE_16];
    let at_rim = degree.iter().find(|(_, colour)| usual.contains(colour) && rim.contains(colour));
    let of_joints = degree.first().filter(|(own, _)| *own as f64 > MEETS * areas as f64 && areas >= 5);
    let mut all: Vec<u64> = at_rim.into_iter().chain(of_joints).map(|(_, colour)| *colour).collect();
    if colours.contains(&0) {
        all.push(0);
    }
    all.sort_unstable();
    all.dedup();
    all
}

const BLACK: u64 = 1;
const WHITE: u64 = 1 + 0xff_ff_ff;
const BLACK_16: u64 = 1;
const WHITE_16: u64 = 1 + 0xff_ff;

fn named(colour: u64) -> String {
    match colour {
        0 => "transparent".to_owned(),
        BLACK => "black".to_owned(),
        WHITE | WHITE_16 => "white".to_owned(),
        other => format!("of the colour #{:06x}", other - 1),
    }
}

/// Grey levels of a picture in two tones.
struct Tones {
    /// The level between both.
    threshold: f64,
    /// The mean levels of both.
    means: [f64; 2],
    /// Share of the pixels that are neither.
    unclear: f64,
    /// Root mean square distance of the others from the mean of theirs.
    noise: f64,
}

/// Whether a picture shows two greys with what smoothing or compression makes of them, rather than labels.
fn is_two_toned(picture: &DynamicImage, tones: &Tones) -> bool {
    if matches!(picture, DynamicImage::ImageLuma16(_)) || !tones.is_clear() || tones.noise >= NOISE {
        return false;
    }
    let rgb = picture.to_rgb8();
    let coloured = rgb.pixels().filter(|own| {
        own.0.iter().max() > own.0.iter().min().map(|low| low.saturating_add(COLOURED)).as_ref()
    });
    (coloured.count() as f64) < 0.01 * f64::from(rgb.width()) * f64::from(rgb.height())
}

/// The stones of a picture in two tones: the one of which there are more areas. What is transparent is no stone.
fn two_tones(
    grey: &GrayImage,
    tones: &Tones,
    colours: &[u64],
    warnings: &mut Vec<String>,
) -> Result<Areas, Box<Fault>> {
    let width = grey.width() as usize;
    let transparent = colours.iter().filter(|own| **own == 0).count() as f64 / colours.len() as f64;
    if transparent > TRANSPARENT {
        warnings.push("stones are what is not transparent".to_owned());
        let tones: Vec<u64> = colours.iter().map(|own| u64::from(*own > 0)).collect();
        return Ok(areas(&tones, width, &|tone| tone == 1));
    }
    if !tones.is_clear() {
        return Err(Box::new(told(
            "it looks like a photograph: neither one colour per stone nor two colours",
            "one colour per stone, or light stones and dark joints",
            "outline the stones in a drawing program, fill each with a colour of its own, and save that as PNG",
        )));
    }
    let light: Vec<u64> = grey.pixels().map(|own| u64::from(f64::from(own.0[0]) > tones.threshold)).collect();
    let [dark_ones, light_ones] = [0, 1].map(|own| areas(&light, width, &|tone| tone == own));
    let stones_are_light = light_ones.count >= dark_ones.count;
    let (stones, joints) = if stones_are_light { ("light", "dark") } else { ("dark", "light") };
    warnings
        .push(format!("stones are what is {stones}; joints, and what lies around the wall, are {joints}"));
    Ok(if stones_are_light { light_ones } else { dark_ones })
}

impl Tones {
    fn of(grey: &GrayImage) -> Tones {
        let mut counts = [0_u64; 256];
        grey.pixels().for_each(|own| counts[usize::from(own.0[0])] += 1);
        let (threshold, [low, high]) = parted(&counts);
        let quarter = (high - low) / 4.0;
        let (mut all, mut unclear, mut squares) = (0.0, 0.0, 0.0);
        for (level, count) in counts.iter().enumerate() {
            let (level, count) = (level as f64, *count as f64);
            all += count;
            if level > low + quarter && level < high - quarter {
                unclear += count;
            } else {
                let off = (level - low).abs().min((level - high).abs());
                squares += count * off * off;
            }
        }
        let noise = (squares / (all - unclear)).sqrt();
        Tones { threshold, means: [low, high], unclear: unclear / all, noise }
    }

    fn is_clear(&self) -> bool {
        self.unclear < BETWEEN && self.means[1] - self.means[0] > CONTRAST
    }
}

/// The grey level that parts dark and light best (Otsu 1979), and the mean levels of both.
fn parted(counts: &[u64; 256]) -> (f64, [f64; 2]) {
    let all: f64 = counts.iter().map(|own| *own as f64).sum();
    let sum: f64 = counts.iter().enumerate().map(|(level, own)| level as f64 * *own as f64).sum();
    let (mut below, mut sum_below, mut best) = (0.0, 0.0, (f64::NEG_INFINITY, 0.0, 0.0, 0.0));
    for (level, own) in counts.iter().enumerate() {
        below += *own as f64;
        sum_below += level as f64 * *own as f64;
        if below == 0.0 || below == all {
            continue;
        }
        let (low, high) = (sum_below / below, (sum - sum_below) / (all - below));
        let parted = below * (all - below) * (high - low) * (high - low);
        if parted > best.0 {
            best = (parted, 0.5 * (low + high), low, high);
        }
    }
    (best.1, [best.2, best.3])
}
