//! What single entities of a DXF drawing look like: points in the world's axes.

use crate::exchange::drawing::curve::{arc, bulged, circle};
use crate::exchange::drawing::dxf::place::Placing;
use crate::exchange::drawing::dxf::records::Record;
use crate::exchange::drawing::gather::Unread;
use crate::math::radians;

/// A line in space.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Path {
    pub points: Vec<[f64; 3]>,
    pub closed: bool,
}

/// A corner of a polyline, and how much the edge after it bulges.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    pub point: [f64; 3],
    pub bulge: f64,
}

/// The line of an entity that says everything in one record; `None` of other kinds.
pub(super) fn path(record: &Record<'_>) -> Option<Result<Path, Unread>> {
    match record.kind {
        "LINE" => Some(straight(record)),
        "ARC" | "CIRCLE" => Some(round(record)),
        "LWPOLYLINE" => Some(light_polyline(record)),
        _ => None,
    }
}

/// The axes in which a flat entity states its points.
pub(super) fn own_axes(record: &Record<'_>) -> Result<Placing, Unread> {
    Ok(Placing::facing([record.number(210, 0.0)?, record.number(220, 0.0)?, record.number(230, 1.0)?]))
}

fn straight(record: &Record<'_>) -> Result<Path, Unread> {
    Ok(Path { points: vec![record.point(10)?, record.point(11)?], closed: false })
}

fn round(record: &Record<'_>) -> Result<Path, Unread> {
    let axes = own_axes(record)?;
    let [x, y, z] = record.point(10)?;
    let radius = record.number(40, 0.0)?;
    let closed = record.kind == "CIRCLE";
    let points = if closed {
        circle([x, y], radius)
    } else {
        let [from, to] = [record.number(50, 0.0)?, record.number(51, 360.0)?];
        // Arcs go counter-clockwise.
        let sweep = (to - from).rem_euclid(360.0);
        arc([x, y], radius, radians(from), radians(if sweep == 0.0 { 360.0 } else { sweep }))
    };
    Ok(Path { points: points.into_iter().map(|[x, y]| axes.of([x, y, z])).collect(), closed })
}

fn light_polyline(record: &Record<'_>) -> Result<Path, Unread> {
    let (axes, level) = (own_axes(record)?, record.number(38, 0.0)?);
    let mut corners: Vec<Corner> = Vec::new();
    for group in &record.groups {
        match (group.code, corners.last_mut()) {
            (10, _) => corners.push(Corner { point: [group.number("x")?, 0.0, level], bulge: 0.0 }),
            (20, Some(last)) => last.point[1] = group.number("y")?,
            (42, Some(last)) => last.bulge = group.number("a bulge")?,
            _ => {}
        }
    }
    let path = rounded(&corners, record.flags(70) & 1 != 0);
    Ok(Path { points: path.points.into_iter().map(|point| axes.of(point)).collect(), ..path })
}

/// A polyline with its bulging edges as arcs.
pub(super) fn rounded(corners: &[Corner], closed: bool) -> Path {
    let mut points = Vec::with_capacity(corners.len());
    for (i, corner) in corners.iter().enumerate() {
        points.push(corner.point);
        let next = corners.get(i + 1).or(corners.first().filter(|_| closed));
        if let Some(next) = next.filter(|_| corner.bulge != 0.0) {
            let [from, to] = [corner, next].map(|own| [own.point[0], own.point[1]]);
            points.extend(bulged(from, to, corner.bulge).into_iter().map(|[x, y]| [x, y, corner.point[2]]));
        }
    }
    Path { points, closed }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exchange::drawing::dxf::records::Records;

    fn read(text: &str) -> Option<Result<Path, Unread>> {
        path(&Records::of(text).next().unwrap().unwrap())
    }

    #[test]
    fn a_polyline_with_bulges_has_points_on_its_arcs() {
        let text = "0\nLWPOLYLINE\n70\n1\n38\n4\n10\n0\n20\n0\n42\n1\n10\n2\n20\n0\n10\n2\n20\n3\n";
        let own = read(text).unwrap().unwrap();
        assert!(own.closed && own.points.len() > 12, "{own:?}");
        let lowest = own.points.iter().map(|p| p[1]).fold(0.0, f64::min);
        assert!((-1.0..-0.98).contains(&lowest), "{lowest}");
        assert!(own.points.iter().all(|p| p[2] == 4.0));
    }

    #[test]
    fn an_arc_goes_counter_clockwise_across_zero_degrees() {
        let own = read("0\nARC\n10\n1\n20\n1\n40\n2\n50\n270\n51\n90\n").unwrap().unwrap();
        assert!(!own.closed && own.points.iter().all(|p| p[0] > 1.0 - 1e-9), "{own:?}");
        let last = own.points[own.points.len() - 1];
        assert!((last[0] - 1.0).abs() < 1e-9 && (last[1] - 3.0).abs() < 1e-9);
        assert_eq!(read("0\nCIRCLE\n40\n2\n").unwrap().unwrap().points.len(), 32);
    }

    #[test]
    fn a_number_that_is_none_is_told_with_its_line() {
        let unread = read("0\nLWPOLYLINE\n10\n1\n20\n1e400\n").unwrap().unwrap_err();
        assert_eq!((unread.line, unread.found.as_str()), (6, "y is \"1e400\""));
        assert!(read("0\nSPLINE\n10\n1\n").is_none());
    }
}
