//! The outline of an area of pixels, along their sides.

/// Steps along sides of pixels, each to the left of the one before.
const STEPS: [[i64; 2]; 4] = [[0, 1], [1, 0], [0, -1], [-1, 0]];

/// The outline of the area whose first pixel, from above and from the left, is at `start`: counter-clockwise seen with y upwards, as corners of
/// pixels with x from the left and y from above. It goes down the left side first, the area on the left hand. Holes are left out.
pub fn around(of_pixel: &[u32], width: usize, start: usize) -> Vec<[u32; 2]> {
    let area = of_pixel[start];
    let height = of_pixel.len() / width;
    let is_own = |x: i64, y: i64| {
        let inside = x >= 0 && y >= 0 && (x as usize) < width && (y as usize) < height;
        inside && of_pixel[y as usize * width + x as usize] == area
    };
    let begin = [(start % width) as i64, (start / width) as i64];
    let (mut at, mut step) = (begin, 0);
    let mut corners = Vec::new();
    loop {
        // The pixels ahead, left and right of the way, by the direction it goes.
        let [x, y] = at;
        let (left, right) = match step {
            0 => ([x, y], [x - 1, y]),
            1 => ([x, y - 1], [x, y]),
            2 => ([x - 1, y - 1], [x, y - 1]),
            _ => ([x - 1, y], [x - 1, y - 1]),
        };
        let turned = if !is_own(left[0], left[1]) {
            (step + 1) % 4
        } else if is_own(right[0], right[1]) {
            (step + 3) % 4
        } else {
            step
        };
        if turned != step || corners.is_empty() {
            corners.push([x as u32, y as u32]);
            step = turned;
        }
        at = [x + STEPS[step][0], y + STEPS[step][1]];
        // Nothing of the area is above the begin, or left of it: the way comes by once.
        if at == begin {
            return corners;
        }
    }
}
