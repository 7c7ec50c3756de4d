//! Areas of one colour in a picture, without specks, and parted where they hang together by a bridge.

/// What belongs to no area.
pub const NONE: u32 = u32::MAX;
/// Areas smaller than this share of the median one are specks.
const SPECK: f64 = 0.01;
/// An area that falls apart without its rim is several stones where the second largest part has this share of the median area.
const PART: f64 = 0.1;

/// The areas of a picture, numbered by their first pixel.
pub struct Areas {
    /// The area of each pixel; [`NONE`] of what is none.
    pub of_pixel: Vec<u32>,
    /// How many there are.
    pub count: usize,
    /// The first pixel of each, from above.
    pub first: Vec<usize>,
    /// What was passed over and what was parted.
    pub notes: Vec<String>,
}

/// The areas of pixels of one value that meet along their sides, where `wanted` says that the value is one of stones.
///
/// A pixel whose neighbours are not all of its value is a rim pixel. What has only rim pixels is a speck, or the colours between two that
/// smoothing makes. What two areas share through rim pixels alone is a bridge.
pub fn areas(values: &[u64], width: usize, wanted: &dyn Fn(u64) -> bool) -> Areas {
    let is_core: Vec<bool> =
        (0..values.len()).map(|at| wanted(values[at]) && is_core(values, width, at)).collect();
    let grown = connected(values, width, &|at| is_core[at]);
    let cores = &grown.sizes;
    let whole = connected(values, width, &|at| wanted(values[at]));
    let mut notes = Vec::new();
    let mut sorted = cores.clone();
    sorted.sort_unstable();
    let median = sorted.get(sorted.len() / 2).copied().unwrap_or(0) as f64;
    // Cores that count, by the whole area that holds them.
    let mut largest = vec![(0_usize, NONE); whole.sizes.len()];
    let area_of = |core: usize| whole.of_pixel[grown.first[core]] as usize;
    for (core, size) in cores.iter().enumerate() {
        let best = &mut largest[area_of(core)];
        if *size > best.0 {
            *best = (*size, core as u32);
        }
    }
    let counts: Vec<bool> = cores
        .iter()
        .enumerate()
        .map(|(core, size)| {
            let size = *size as f64;
            let is_largest = largest[area_of(core)].1 == core as u32;
            if is_largest { size >= SPECK * median } else { size >= PART * median }
        })
        .collect();
    let specks =
        whole.sizes.len() - largest.iter().filter(|own| own.1 != NONE && counts[own.1 as usize]).count();
    let kept = counts.iter().filter(|own| **own).count();
    let bridges = kept + specks - whole.sizes.len();
    if specks > 0 {
        notes.push(format!("{specks} area(s) are no stones: below {} pixels, or thinner than 3 (specks, and what smoothing makes of edges)", (SPECK * median).ceil()));
    }
    if bridges > 0 {
        notes.push(format!(
            "{bridges} pair(s) of stones hung together by a bridge of at most 2 pixels and were parted"
        ));
    }
    let mut of_pixel: Vec<u32> = grown
        .of_pixel
        .iter()
        .map(|own| if *own != NONE && counts[*own as usize] { *own } else { NONE })
        .collect();
    spread(&mut of_pixel, values, width);
    // Numbered from above to below, left to right, as they are met.
    let mut number = vec![NONE; cores.len()];
    let mut first = Vec::new();
    for (at, own) in of_pixel.iter_mut().enumerate().filter(|(_, own)| **own != NONE) {
        let number = &mut number[*own as usize];
        if *number == NONE {
            *number = first.len() as u32;
            first.push(at);
        }
        *own = *number;
    }
    Areas { of_pixel, count: first.len(), first, notes }
}

/// Whether all eight neighbours have a pixel's value; beyond the picture all do.
fn is_core(values: &[u64], width: usize, at: usize) -> bool {
    let (x, y, height) = (at % width, at / width, values.len() / width);
    let rows = y.saturating_sub(1)..=(y + 1).min(height - 1);
    rows.flat_map(|row| {
        (x.saturating_sub(1)..=(x + 1).min(width - 1)).map(move |column| row * width + column)
    })
    .all(|other| values[other] == values[at])
}

/// Areas of equal values that meet along sides.
struct Connected {
    of_pixel: Vec<u32>,
    sizes: Vec<usize>,
    first: Vec<usize>,
}

fn connected(values: &[u64], width: usize, is_of_one: &dyn Fn(usize) -> bool) -> Connected {
    let mut found = Connected { of_pixel: vec![NONE; values.len()], sizes: Vec::new(), first: Vec::new() };
    let mut open = Vec::new();
    for start in 0..values.len() {
        if found.of_pixel[start] != NONE || !is_of_one(start) {
            continue;
        }
        let area = found.sizes.len() as u32;
        found.first.push(start);
        found.sizes.push(0);
        found.of_pixel[start] = area;
        open.push(start);
        while let Some(at) = open.pop() {
            found.sizes[area as usize] += 1;
            for other in beside(at, width, values.len()) {
                if found.of_pixel[other] == NONE && values[other] == values[start] && is_of_one(other) {
                    found.of_pixel[other] = area;
                    open.push(other);
                }
            }
        }
    }
    found
}

/// Gives pixels of a value to the area of that value which reaches them first.
fn spread(of_pixel: &mut [u32], values: &[u64], width: usize) {
    let mut rim: Vec<usize> = (0..of_pixel.len()).filter(|at| of_pixel[*at] != NONE).collect();
    while !rim.is_empty() {
        let mut next = Vec::new();
        for at in rim {
            for other in beside(at, width, values.len()) {
                if of_pixel[other] == NONE && values[other] == values[at] {
                    of_pixel[other] = of_pixel[at];
                    next.push(other);
                }
            }
        }
        rim = next;
    }
}

/// The pixels that share a side with one.
fn beside(at: usize, width: usize, count: usize) -> impl Iterator<Item = usize> {
    let x = at % width;
    let left = (x > 0).then(|| at - 1);
    let right = (x + 1 < width).then_some(at + 1);
    let above = at.checked_sub(width);
    let below = (at + width < count).then_some(at + width);
    [left, right, above, below].into_iter().flatten()
}
