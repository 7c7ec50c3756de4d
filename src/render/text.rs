//! Tables and paragraphs for a terminal.

use crate::render::number::shortened;

/// Widest line of text and of tables that are split.
pub(crate) const WIDTH: usize = 100;

/// Columns behind a first one, heads included, in as many tables as the width needs.
pub(crate) fn side_by_side(first: &[String], columns: &[Vec<String>]) -> String {
    let table = |group: &[Vec<String>]| {
        let row = |row: usize| {
            let cells = std::iter::once(first).chain(group.iter().map(Vec::as_slice));
            cells.map(|column| column.get(row).cloned().unwrap_or_default()).collect()
        };
        aligned((0..first.len()).map(row).collect())
    };
    fitting(first, columns).into_iter().map(table).collect::<Vec<_>>().join("\n")
}

/// Splits columns into groups that fit the width beside the first column.
fn fitting<'a>(first: &[String], columns: &'a [Vec<String>]) -> Vec<&'a [Vec<String>]> {
    let mut groups = Vec::new();
    let (mut start, mut used) = (0, width(first));
    for (index, column) in columns.iter().enumerate() {
        let own = width(column) + 2;
        if index > start && used + own > WIDTH {
            groups.push(&columns[start..index]);
            (start, used) = (index, width(first));
        }
        used += own;
    }
    groups.push(&columns[start..]);
    groups
}

/// Names longer than this are cut in tables.
pub(crate) const LONGEST_NAME: usize = 18;

/// Rows as text: the first column to the left, numbers to the right, a rule below the first row.
pub(crate) fn aligned(rows: Vec<Vec<String>>) -> String {
    aligned_to(rows, LONGEST_NAME)
}

/// The same with names of at most so many characters.
pub(crate) fn aligned_to(mut rows: Vec<Vec<String>>, longest: usize) -> String {
    for row in &mut rows {
        row[0] = shortened(&row[0], longest);
    }
    let columns = rows.first().map_or(0, Vec::len);
    let widths: Vec<usize> = (0..columns)
        .map(|column| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0))
        .collect();
    let mut text = String::new();
    for (index, row) in rows.iter().enumerate() {
        let cells: Vec<String> = row
            .iter()
            .zip(&widths)
            .enumerate()
            .map(
                |(column, (cell, &width))| {
                    if column == 0 { format!("{cell:<width$}") } else { format!("{cell:>width$}") }
                },
            )
            .collect();
        text.push_str(cells.join("  ").trim_end());
        text.push('\n');
        if index == 0 {
            text.push_str(&"-".repeat(widths.iter().sum::<usize>() + 2 * (columns - 1)));
            text.push('\n');
        }
    }
    text
}

fn width(column: &[String]) -> usize {
    column.iter().map(|cell| cell.chars().count()).max().unwrap_or(0)
}

/// Breaks a text at spaces; the first line begins with `lead`, the others with as many spaces.
pub(crate) fn wrapped(lead: &str, text: &str) -> String {
    let indent = " ".repeat(lead.chars().count());
    let (mut lines, mut line, mut used) = (String::new(), lead.to_string(), 0);
    for word in text.split_whitespace() {
        if used > 0 && line.chars().count() + 1 + word.chars().count() > WIDTH {
            lines.push_str(&line);
            lines.push('\n');
            (line, used) = (indent.clone(), 0);
        }
        if used > 0 {
            line.push(' ');
        }
        line.push_str(word);
        used += 1;
    }
    lines + line.trim_end() + "\n"
}
