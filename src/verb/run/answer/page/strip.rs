//! The distribution of an ensemble: a mark for every wall, stacked where walls are alike, each a link to its row.

use plotters::style::RGBColor;

use crate::ensemble::Quantity;
use crate::render::axes::decimals;
use crate::render::marker::colour;
use crate::render::markup::escaped;
use crate::render::number::{compact, range, shortened, significant};
use crate::render::pen::FONT_NAME;

/// Size of the figure, and where its axis begins and ends (pixels).
const WIDTH: f64 = 960.0;
const LEFT: f64 = 250.0;
const RIGHT: f64 = 930.0;
/// Height of a line of walls, of what stands below them, and radius of a mark (pixels).
const ROW: f64 = 72.0;
const BELOW: f64 = 56.0;
const RADIUS: f64 = 5.0;
/// Names longer than this are cut.
const LONGEST_NAME: usize = 24;

/// A line of the figure: the walls of an arm at one stiffness.
pub struct Row {
    /// Name of the arm.
    pub arm: String,
    /// Its place among the arms of the study, which gives it its colour.
    pub place: usize,
    /// Normal stiffness of the joints (Pa/m).
    pub kn: f64,
    /// Its walls.
    pub marks: Vec<Mark>,
}

/// A wall.
pub struct Mark {
    /// Its number.
    pub member: u64,
    /// Its value, in the unit shown.
    pub value: f64,
    /// Whether it stood to the end, so that its value lies above.
    pub stood: bool,
    /// Where a link leads; `None` where there is nothing to lead to.
    pub to: Option<String>,
    /// Whether it is drawn on the page.
    pub is_drawn: bool,
}

/// The figure.
pub fn strip(rows: &[Row], quantity: Quantity) -> String {
    let [low, high] =
        range(rows.iter().flat_map(|row| &row.marks).map(|mark| mark.value)).unwrap_or([0.0, 1.0]);
    let room = if high > low { 0.03 * (high - low) } else { 0.05 * high.abs().max(1e-3) };
    let ends = [low - room, high + room];
    let place = |value: f64| LEFT + (RIGHT - LEFT) * (value - ends[0]) / (ends[1] - ends[0]);
    let tall = ROW * rows.len() as f64 + BELOW;
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{tall}\" viewBox=\"0 0 {WIDTH} {tall}\" \
         font-family=\"{FONT_NAME}\" font-size=\"14\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
    );
    let floor = ROW * rows.len() as f64;
    let digits = decimals(ends[1] - ends[0]);
    for tick in ticks(ends) {
        let x = place(tick);
        text += &format!("<path d=\"M{x:.1},0V{floor}\" stroke=\"#dddddd\"/>\n");
        text += &format!(
            "<text x=\"{x:.1}\" y=\"{}\" text-anchor=\"middle\">{tick:.digits$}</text>\n",
            floor + 20.0
        );
    }
    let middle = 0.5 * (LEFT + RIGHT);
    text += &format!(
        "<text x=\"{middle}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n",
        floor + 44.0,
        quantity.axis()
    );
    for (number, row) in rows.iter().enumerate() {
        let ground = ROW * (number + 1) as f64;
        text += &format!("<path d=\"M{LEFT},{ground}H{RIGHT}\" stroke=\"#666666\"/>\n");
        for (below, words) in
            [(30.0, shortened(&row.arm, LONGEST_NAME)), (11.0, format!("kn {} Pa/m", compact(row.kn)))]
        {
            text += &format!("<text x=\"8\" y=\"{}\">{}</text>\n", ground - below, escaped(&words));
        }
        text += &walls(row, &place, ground, quantity);
    }
    text + "</svg>"
}

/// The marks of a line, stacked in columns of their own width; a column that is too high is pressed together.
fn walls(row: &Row, place: &dyn Fn(f64) -> f64, ground: f64, quantity: Quantity) -> String {
    let RGBColor(red, green, blue) = colour(row.place);
    let own = format!("#{red:02x}{green:02x}{blue:02x}");
    let column = |mark: &Mark| ((place(mark.value) - LEFT) / (2.0 * RADIUS)).floor() as i64;
    let mut ordered: Vec<&Mark> = row.marks.iter().collect();
    ordered.sort_by(|a, b| a.value.total_cmp(&b.value));
    let mut text = String::new();
    for same in ordered.chunk_by(|a, b| column(a) == column(b)) {
        let most = ROW - 3.0 * RADIUS;
        let up = (2.0 * RADIUS).min(most / same.len() as f64);
        for (above, mark) in same.iter().enumerate() {
            let (x, y) = (place(mark.value), ground - RADIUS - up * above as f64);
            let value = significant(mark.value, 4);
            let beyond = if mark.stood { "above " } else { "" };
            let said =
                format!("{}, wall {}: {beyond}{value} {}", row.arm, mark.member, quantity.shown_unit());
            let fill = match (mark.is_drawn, mark.stood) {
                (true, _) => "#000000",
                (false, true) => "#ffffff",
                (false, false) => &own,
            };
            // What is drawn below has a ring about it, which is seen in the colour of any arm.
            let (radius, edge) = if mark.is_drawn { (RADIUS + 1.0, &own[..]) } else { (RADIUS, "#333333") };
            let circle = format!(
                "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" fill=\"{fill}\" stroke=\"{edge}\"><title>{}</title></circle>",
                escaped(&said)
            );
            text += &match &mark.to {
                Some(id) => format!("<a href=\"#{id}\" aria-label=\"{}\">{circle}</a>\n", escaped(&said)),
                None => circle + "\n",
            };
        }
    }
    text
}

/// Four to ten round numbers within two ends.
fn ticks([low, high]: [f64; 2]) -> Vec<f64> {
    let span = high - low;
    let mut step = 1.0;
    while step > span {
        step /= 10.0;
    }
    while step * 10.0 <= span {
        step *= 10.0;
    }
    if span / step < 2.0 {
        step /= 5.0;
    } else if span / step < 5.0 {
        step /= 2.0;
    }
    let first = (low / step).ceil();
    (0..).map(|k| (first + f64::from(k)) * step).take_while(|tick| *tick <= high).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_within_the_ends() {
        let near = |found: Vec<f64>, wanted: &[f64]| {
            assert!(
                found.len() == wanted.len() && found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-9),
                "{found:?}"
            );
        };
        near(ticks([10.7, 15.2]), &[11.0, 11.5, 12.0, 12.5, 13.0, 13.5, 14.0, 14.5, 15.0]);
        near(ticks([0.0, 1.0]), &[0.0, 0.2, 0.4, 0.6, 0.8, 1.0]);
        near(ticks([-30.0, 60.0]), &[-30.0, -20.0, -10.0, 0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0]);
    }

    #[test]
    fn a_mark_leads_to_its_wall_and_names_it() {
        let mark = |member, value| Mark {
            member,
            value,
            stood: false,
            to: Some(format!("wall-{member}")),
            is_drawn: false,
        };
        let rows = [Row {
            arm: "a<b".into(),
            place: 1,
            kn: 5e7,
            marks: vec![mark(0, 13.0), mark(1, 13.0), mark(2, 15.0)],
        }];
        let text = strip(&rows, Quantity::CollapseAngle);
        assert!(text.contains("<a href=\"#wall-2\" aria-label=\"a&lt;b, wall 2: 15.00 deg\">"), "{text}");
        assert!(!text.contains("a<b"), "{text}");
        assert_eq!(text.matches("fill=\"#d55e00\"").count(), 3, "in the colour of its arm: {text}");
        // Two walls alike stand one on the other.
        let heights: Vec<&str> =
            text.split("cy=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
        assert_eq!(heights, ["67.0", "57.0", "67.0"]);
    }
}
