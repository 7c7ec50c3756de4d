//! The colours: a sequential scale for joints that is told apart with every colour vision deficiency, and shaded stone.

/// ColorBrewer's sequential scale YlOrRd in five steps, lightest first (colorbrewer2.org; safe for colour-blind readers).
const SCALE: [[f64; 3]; 5] = [
    [255.0, 255.0, 178.0],
    [254.0, 204.0, 92.0],
    [253.0, 141.0, 60.0],
    [240.0, 59.0, 32.0],
    [189.0, 0.0, 38.0],
];
/// A stone in full light.
const STONE: [f64; 3] = [226.0, 228.0, 230.0];

/// The colour of a share of the largest value, as SVG writes it; shares outside 0 to 1 take the nearest end.
pub fn of_share(share: f64) -> String {
    let at = share.clamp(0.0, 1.0) * (SCALE.len() - 1) as f64;
    let from = (at.floor() as usize).min(SCALE.len() - 2);
    let along = at - from as f64;
    hex([0, 1, 2].map(|k| SCALE[from][k] * (1.0 - along) + SCALE[from + 1][k] * along))
}

/// Stone of a brightness from 0 to 1.
pub fn stone(brightness: f64) -> String {
    hex(STONE.map(|channel| channel * brightness.clamp(0.0, 1.0)))
}

fn hex(colour: [f64; 3]) -> String {
    let [r, g, b] = colour.map(|channel| channel.round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}
