//! The table as text.

use std::fmt::Write as _;

use pirca::stats::clopper_pearson_at;

use crate::looks::LEVEL;
use crate::table::Line;
use crate::truth::designs::Design;

/// All numbers as a file.
pub fn csv(lines: &[Line]) -> String {
    let mut text = "design,group,measure,hits,trials,value,low,high\n".to_owned();
    let number = |x: Option<f64>| x.map_or_else(String::new, |x| x.to_string());
    for line in lines {
        let [hits, trials] = line.counts.map_or([None; 2], |counts| counts.map(|count| Some(count as f64)));
        let [low, high] = interval(line).or(line.between).map_or([None; 2], |interval| interval.map(Some));
        let cells = [hits, trials, line.value, low, high].map(number).join(",");
        writeln!(text, "{},\"{}\",\"{}\",{cells}", line.design, line.group, line.measure)
            .expect("text can grow");
    }
    text
}

/// The head of a table with a column for each design after these.
pub fn head(first: &[&str]) -> String {
    let columns = [first, &Design::ALL.map(Design::name)].concat();
    format!("| {} |\n|{}\n", columns.join(" | "), "---|".repeat(columns.len()))
}

/// A table with a column for each design.
pub fn markdown(lines: &[Line]) -> String {
    let mut text = head(&["group", "measure"]);
    for line in lines.iter().filter(|line| line.design == Design::ALL[0].name()) {
        let same = |other: &&Line| (&other.group, other.measure) == (&line.group, line.measure);
        if lines.iter().filter(same).all(|line| line.value.is_none()) {
            // A part of the full size may have no such campaign.
            continue;
        }
        let cells: Vec<String> = lines.iter().filter(same).map(cell).collect();
        writeln!(text, "| {} | {} | {} |", line.group, line.measure, cells.join(" | "))
            .expect("text can grow");
    }
    text
}

fn cell(line: &Line) -> String {
    match (line.counts, interval(line), line.value) {
        (Some([hits, trials]), Some([low, high]), Some(value)) => {
            let [value, low, high] = [value, low, high].map(|share| format!("{:.0}", 100.0 * share));
            format!("{hits}/{trials} {value} % [{low}, {high}]")
        }
        (.., Some(value)) => {
            let between = line.between.map(|[low, high]| format!(" [{low:.2}, {high:.2}]"));
            format!("{value:.2}{}", between.unwrap_or_default())
        }
        _ => "-".to_owned(),
    }
}

/// The interval of a share (Clopper and Pearson), at the level of all looks together.
pub fn interval(line: &Line) -> Option<[f64; 2]> {
    let [hits, trials] = line.counts.filter(|[_, trials]| *trials > 0)?;
    Some(clopper_pearson_at(hits, trials, LEVEL))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_of_the_file_has_a_cell_for_every_column() {
        let counts = Some([1, 2]);
        let line = Line {
            design: "rich",
            group: "pairs, all".to_owned(),
            measure: "one, or both",
            counts,
            value: Some(0.5),
            between: None,
        };
        let text = csv(&[line]);
        let rows: Vec<&str> = text.lines().collect();
        // Commas between quotes part nothing.
        let cells =
            |row: &str| row.split('"').step_by(2).map(|part| part.matches(',').count()).sum::<usize>();
        assert_eq!((cells(rows[0]), cells(rows[1])), (7, 7), "{text}");
        assert!(rows[1].starts_with(r#"rich,"pairs, all","one, or both",1,2,0.5,"#), "{text}");
    }
}
