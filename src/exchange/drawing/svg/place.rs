//! Affine maps of SVG: where a shape goes.

use svgtypes::{TransformListParser, TransformListToken};

use crate::math::{cos, radians, sin, tan};

/// `x` goes to `a x + c y + e`, `y` to `b x + d y + f`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Map {
    columns: [[f64; 2]; 3],
}

impl Map {
    /// The map to axes that point right and up.
    pub const UPRIGHT: Map = Map { columns: [[1.0, 0.0], [0.0, -1.0], [0.0, 0.0]] };

    fn of(a: f64, b: f64, c: f64, d: f64, e: f64, f: f64) -> Map {
        Map { columns: [[a, b], [c, d], [e, f]] }
    }

    /// A shift.
    pub fn shift(x: f64, y: f64) -> Map {
        Map::of(1.0, 0.0, 0.0, 1.0, x, y)
    }

    /// What an attribute `transform` says; `None` of what cannot be read.
    pub fn read(text: &str) -> Option<Map> {
        let mut all = Map::shift(0.0, 0.0);
        for token in TransformListParser::from(text) {
            all = all.after(&match token.ok()? {
                TransformListToken::Matrix { a, b, c, d, e, f } => Map::of(a, b, c, d, e, f),
                TransformListToken::Translate { tx, ty } => Map::shift(tx, ty),
                TransformListToken::Scale { sx, sy } => Map::of(sx, 0.0, 0.0, sy, 0.0, 0.0),
                TransformListToken::Rotate { angle } => {
                    let (s, c) = (sin(radians(angle)), cos(radians(angle)));
                    Map::of(c, s, -s, c, 0.0, 0.0)
                }
                TransformListToken::SkewX { angle } => Map::of(1.0, 0.0, tan(radians(angle)), 1.0, 0.0, 0.0),
                TransformListToken::SkewY { angle } => Map::of(1.0, tan(radians(angle)), 0.0, 1.0, 0.0, 0.0),
            });
        }
        Some(all)
    }

    /// This map after another one.
    pub fn after(&self, first: &Map) -> Map {
        let [x, y, _] = self.columns;
        let direction = |v: [f64; 2]| [0, 1].map(|k| x[k] * v[0] + y[k] * v[1]);
        let [along, up, origin] = first.columns;
        Map { columns: [direction(along), direction(up), self.point(origin)] }
    }

    /// Where a point goes.
    pub fn point(&self, point: [f64; 2]) -> [f64; 2] {
        let [x, y, origin] = self.columns;
        [0, 1].map(|k| x[k] * point[0] + y[k] * point[1] + origin[k])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_map_of_a_list_comes_first() {
        let map = Map::read("translate(10, 20) scale(2) rotate(90)").unwrap();
        let [x, y] = map.point([1.0, 0.0]);
        assert!((x - 10.0).abs() < 1e-12 && (y - 22.0).abs() < 1e-12, "{x} {y}");
        let around = Map::read("rotate(180 1 1)").unwrap().point([0.0, 0.0]);
        assert!((around[0] - 2.0).abs() < 1e-12 && (around[1] - 2.0).abs() < 1e-12);
        assert_eq!(Map::UPRIGHT.after(&Map::read("").unwrap()).point([3.0, 4.0]), [3.0, -4.0]);
        assert_eq!(Map::read("turn(3)"), None);
    }
}
