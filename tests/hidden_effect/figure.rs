//! The rates that were asked for, as a picture: every row with its interval in both designs, beside its bounds.

use std::fmt::Write as _;

use crate::printed::interval;
use crate::table::Line;
use crate::truth::designs::Design;
use crate::wanted::asked;

/// Widths (pixels) of the words and of the axis from 0 to 100 %, height of a row, and what is left free around.
const WORDS: f64 = 380.0;
const AXIS: f64 = 420.0;
const ROW: f64 = 26.0;
const FREE: f64 = 24.0;
/// Where the two designs lie in a row, and their colours.
const PLACES: [f64; Design::ALL.len()] = [8.0, 18.0];
const COLOURS: [&str; Design::ALL.len()] = ["#1f5fa8", "#c2571a"];

/// Rows in which something was counted; an SVG.
pub fn svg(lines: &[Line]) -> String {
    let rows: Vec<_> = asked(lines)
        .into_iter()
        .filter(|(_, own)| own.iter().any(|(line, _)| line.is_some_and(|line| interval(line).is_some())))
        .collect();
    let bottom = FREE + ROW * rows.len() as f64;
    let (width, height) = (WORDS + AXIS + FREE, bottom + 2.5 * FREE);
    let x = |share: f64| WORDS + AXIS * share;
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
    );
    let mut put = |what: String| writeln!(text, "{what}").expect("text can grow");
    for tick in 0..=5 {
        let (share, at) = (20 * tick, x(0.2 * f64::from(tick)));
        put(format!("<line x1=\"{at}\" x2=\"{at}\" y1=\"{FREE}\" y2=\"{bottom}\" stroke=\"#dddddd\"/>"));
        put(format!("<text x=\"{at}\" y=\"{}\" text-anchor=\"middle\">{share} %</text>", bottom + 18.0));
    }
    for (row, (what, own)) in rows.iter().enumerate() {
        let top = FREE + ROW * row as f64;
        put(format!("<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{what}</text>", WORDS - 12.0, top + 17.0));
        for (((line, bounds), place), colour) in own.iter().zip(PLACES).zip(COLOURS) {
            let y = top + place;
            for bound in bounds.iter().flatten().filter(|bound| bound.is_finite()) {
                let at = x(*bound);
                put(format!(
                    "<line x1=\"{at}\" x2=\"{at}\" y1=\"{}\" y2=\"{}\" stroke=\"{colour}\" stroke-width=\"3\"/>",
                    y - 6.0,
                    y + 6.0
                ));
            }
            let Some((line, [low, high])) = line.and_then(|line| Some((line, interval(line)?))) else {
                continue;
            };
            put(format!(
                "<line x1=\"{}\" x2=\"{}\" y1=\"{y}\" y2=\"{y}\" stroke=\"{colour}\"/>",
                x(low),
                x(high)
            ));
            put(format!(
                "<circle cx=\"{}\" cy=\"{y}\" r=\"4\" fill=\"{colour}\"/>",
                x(line.value.unwrap_or(low))
            ));
        }
    }
    for (k, (design, colour)) in Design::ALL.iter().zip(COLOURS).enumerate() {
        put(format!(
            "<text x=\"{}\" y=\"{}\" fill=\"{colour}\">{} (bar: bound)</text>",
            x(0.45 * k as f64),
            bottom + 42.0,
            design.name()
        ));
    }
    text + "</svg>\n"
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table;

    #[test]
    fn a_row_has_its_point_its_interval_and_its_bound() {
        let mut lines = table::of(&[], &[]);
        assert_eq!(svg(&lines).matches("<circle").count(), 0);
        for line in lines.iter_mut().filter(|line| (&line.group[..], line.measure) == ("decoys", "named")) {
            (line.counts, line.value) = (Some([1, 10]), Some(0.1));
        }
        let text = svg(&lines);
        assert_eq!((text.matches("<circle").count(), text.matches("stroke-width=\"3\"").count()), (2, 2));
        assert!(text.contains("decoys: named") && text.contains(&format!("cx=\"{}\"", WORDS + 0.1 * AXIS)));
    }
}
