//! What is wrong with a wall file: which block, what was found, what is allowed, how to mend it.

use std::fmt;

/// Faults listed of one file; more are only counted, so that a file full of faults can still be read about.
const LISTED: usize = 100;
/// Faults listed of one block.
const LISTED_PER_BLOCK: usize = 8;
/// Equal faults listed one by one; more of them are one fault with a count.
const LISTED_ALIKE: usize = 3;
/// Places named of a fault that is there several times.
const PLACES: usize = 5;

/// One fault of a wall file.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Fault {
    /// Line in the file, from 1; 0 where no line is to blame.
    pub line: usize,
    /// Column, from 1; 0 where none is known.
    pub column: usize,
    /// The block, as `block 7`; empty when the fault is the file's.
    pub block: String,
    /// What was found.
    pub found: String,
    /// What is allowed.
    pub allowed: String,
    /// How to mend it.
    pub fix: String,
    /// How often it is there, with other numbers.
    pub times: usize,
    /// Where it is, if it is there several times: the first places, blocks or lines.
    pub places: Vec<String>,
}

impl Fault {
    /// A fault of a block, named as the file names it (`block 7`), or of the file (an empty name).
    pub fn of(
        block: &str,
        found: impl Into<String>,
        allowed: impl Into<String>,
        fix: impl Into<String>,
    ) -> Fault {
        Fault {
            line: 0,
            column: 0,
            block: block.to_owned(),
            found: found.into(),
            allowed: allowed.into(),
            fix: fix.into(),
            times: 1,
            places: Vec::new(),
        }
    }

    /// The same fault with its place in the file.
    pub fn at(self, line: usize, column: usize) -> Fault {
        Fault { line, column, ..self }
    }

    /// Where it is, in words.
    fn place(&self) -> String {
        match (self.block.as_str(), self.line) {
            ("", line) => format!("line {line}"),
            (block, 0) => block.to_owned(),
            (block, line) => format!("{block} (line {line})"),
        }
    }

    /// Whether another one is the same but for its place and its numbers.
    fn is_like(&self, other: &Fault) -> bool {
        let same = |a: &str, b: &str| kind(a).eq(kind(b));
        self.block.is_empty() == other.block.is_empty()
            && same(&self.found, &other.found)
            && same(&self.allowed, &other.allowed)
            && same(&self.fix, &other.fix)
    }
}

/// A text without its numbers and without what it quotes from the file.
fn kind(text: &str) -> impl Iterator<Item = &str> {
    let unquoted =
        text.split('"').step_by(2).flat_map(|part| part.split(&[' ', '(', ')', ',', ';', '[', ']']));
    unquoted.filter(|word| !word.is_empty() && !word.contains(|c: char| c.is_ascii_digit()))
}

/// All faults of a wall file.
#[derive(Clone, Debug, Default, PartialEq, Eq, serde::Serialize, thiserror::Error)]
pub struct WallFaults {
    /// The file, as the user named it.
    pub file: String,
    /// The faults, in the order of the file; about a hundred of them at most. More than three equal ones, in which only
    /// numbers and places differ, are one.
    pub faults: Vec<Fault>,
    /// How many more there are.
    pub more: usize,
}

impl WallFaults {
    /// The faults of a file, none yet.
    pub fn new(file: &str) -> WallFaults {
        WallFaults { file: file.to_owned(), ..WallFaults::default() }
    }

    /// Adds a fault; beyond what one can read, it is only counted.
    pub fn push(&mut self, fault: Fault) {
        let alike: Vec<usize> = (0..self.faults.len()).filter(|&i| self.faults[i].is_like(&fault)).collect();
        if let Some(&first) = alike.first()
            && (self.faults[first].times > 1 || alike.len() >= LISTED_ALIKE)
        {
            return self.gather(&alike, fault);
        }
        let of_block = || self.faults.iter().rev().take_while(|f| f.block == fault.block).count();
        if self.faults.len() >= LISTED || (!fault.block.is_empty() && of_block() >= LISTED_PER_BLOCK) {
            self.more += 1;
        } else {
            self.faults.push(fault);
        }
    }

    /// Makes one fault of those that are alike.
    fn gather(&mut self, alike: &[usize], fault: Fault) {
        let first = alike[0];
        let others: Vec<Fault> = alike[1..].iter().rev().map(|&i| self.faults.remove(i)).collect();
        let one = &mut self.faults[first];
        if one.places.is_empty() {
            one.places.push(one.place());
        }
        for other in others.iter().rev().chain([&fault]) {
            one.times += 1;
            let place = other.place();
            if one.places.len() < PLACES && !one.places.contains(&place) {
                one.places.push(place);
            }
        }
    }

    /// Adds the fault that ended the reading, which is always listed.
    pub fn push_last(&mut self, fault: Fault) {
        self.faults.push(fault);
    }

    /// How many there are, each counted as often as it is there.
    pub fn count(&self) -> usize {
        self.faults.iter().map(|fault| fault.times).sum::<usize>() + self.more
    }

    /// Whether nothing is wrong.
    pub fn is_empty(&self) -> bool {
        self.faults.is_empty()
    }
}

impl fmt::Display for WallFaults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let n = self.faults.len() + self.more;
        writeln!(f, "{n} fault{} in {}:", if n == 1 { "" } else { "s" }, self.file)?;
        for fault in &self.faults {
            write!(f, "{}", self.file)?;
            if fault.line > 0 {
                write!(f, ":{}", fault.line)?;
                if fault.column > 0 {
                    write!(f, ":{}", fault.column)?;
                }
            }
            write!(f, ": ")?;
            if !fault.block.is_empty() {
                write!(f, "{}: ", fault.block)?;
            }
            write!(f, "{}; allowed is {}; {}", fault.found, fault.allowed, fault.fix)?;
            if fault.times > 1 {
                let dots = if fault.times > fault.places.len() { ", ..." } else { "" };
                write!(f, " ({} times: {}{dots})", fault.times, fault.places.join(", "))?;
            }
            writeln!(f)?;
        }
        if self.more > 0 {
            writeln!(f, "... and {} more", self.more)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sized(block: usize, size: f64) -> Fault {
        let found = format!("it measures {size} m from corner to corner (unit m)");
        Fault::of(&format!("block {block}"), found, "0.001 to 25 m for a stone", "set the unit to mm")
    }

    #[test]
    fn many_equal_faults_are_one_with_a_count_and_the_first_places() {
        let mut faults = WallFaults::new("wall.json");
        faults.push(Fault::of("block 0", "density is missing", "a density", "add it"));
        (1..=40).for_each(|block| faults.push(sized(block, 300.0 + block as f64)));
        assert_eq!((faults.faults.len(), faults.count()), (2, 41), "{faults}");
        let said = faults.to_string();
        assert!(said.starts_with("2 faults in wall.json:\n"), "{said}");
        assert!(said.contains("block 1: it measures 301 m"), "{said}");
        assert!(said.contains("(40 times: block 1, block 2, block 3, block 4, block 5, ...)"), "{said}");
    }

    #[test]
    fn a_few_equal_faults_and_different_ones_are_told_one_by_one() {
        let mut faults = WallFaults::new("wall.json");
        (1..=3).for_each(|block| faults.push(sized(block, 300.0)));
        faults.push(Fault::of("block 4", "density is 2.4", "a density", "multiply it"));
        assert_eq!((faults.faults.len(), faults.count()), (4, 4), "{faults}");
        assert!(!faults.to_string().contains("times"));
    }
}
