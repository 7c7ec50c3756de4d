//! What was done to the corners of a file, for its reader to know.

use crate::exchange::solid::Solid;

/// Blocks named of those whose faces have been made plane.
const SHOWN: usize = 5;
/// Corners that have been put together are told of from this share of their block on: less is the rounding of single precision.
const TOLD_APART: f64 = 1e-6;
/// What was done to the corners of the file's blocks.
#[derive(Default)]
pub struct Mended {
    /// Blocks whose corners were put together, and how far apart (m) they were at most.
    welded: (usize, f64),
    /// Blocks whose faces were made plane: how far (m) corners were moved, and the block.
    flattened: Vec<(f64, String)>,
}

impl Mended {
    /// What was done to a block of this size (m).
    pub fn note(&mut self, name: &str, solid: &Solid, size: f64) {
        if solid.apart > TOLD_APART * size {
            self.welded = (self.welded.0 + 1, self.welded.1.max(solid.apart));
        }
        self.flattened.extend(solid.moved.map(|moved| (moved, name.to_owned())));
    }

    /// The same in words; `flatness` (m) is what was allowed.
    pub fn told(mut self, flatness: Option<f64>) -> Vec<String> {
        let mut told = Vec::new();
        if let (blocks @ 1.., apart) = self.welded {
            told.push(format!(
                "in {blocks} block(s) the corners of neighbouring faces lay up to {:.1e} mm apart; they are taken as one",
                1e3 * apart
            ));
        }
        if let (false, Some(flatness)) = (self.flattened.is_empty(), flatness) {
            self.flattened.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
            let first = self.flattened.iter().take(SHOWN);
            let first: Vec<String> =
                first.map(|(moved, name)| format!("{name} by {:.3} mm", 1e3 * moved)).collect();
            let more = self.flattened.len().saturating_sub(SHOWN);
            let more = if more > 0 { format!(" and {more} more by less") } else { String::new() };
            told.push(format!(
                "warped faces made plane within {} mm in {} block(s), which moved corners: {}{more}",
                1e3 * flatness,
                self.flattened.len(),
                first.join(", ")
            ));
        }
        told
    }
}
