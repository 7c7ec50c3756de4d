//! What is wrong with a wall file: which block, what was found, what is allowed, how to mend it.

use std::fmt;

/// Faults listed of one file; more are only counted, so that a file full of faults can still be read about.
const LISTED: usize = 100;
/// Faults listed of one block.
const LISTED_PER_BLOCK: usize = 8;

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
        }
    }

    /// The same fault with its place in the file.
    pub fn at(self, line: usize, column: usize) -> Fault {
        Fault { line, column, ..self }
    }
}

/// All faults of a wall file.
#[derive(Clone, Debug, Default, PartialEq, Eq, serde::Serialize, thiserror::Error)]
pub struct WallFaults {
    /// The file, as the user named it.
    pub file: String,
    /// The faults, in the order of the file; about a hundred of them at most.
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
        let of_block = || self.faults.iter().rev().take_while(|f| f.block == fault.block).count();
        if self.faults.len() >= LISTED || (!fault.block.is_empty() && of_block() >= LISTED_PER_BLOCK) {
            self.more += 1;
        } else {
            self.faults.push(fault);
        }
    }

    /// Adds the fault that ended the reading, which is always listed.
    pub fn push_last(&mut self, fault: Fault) {
        self.faults.push(fault);
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.faults.len() + self.more
    }

    /// Whether nothing is wrong.
    pub fn is_empty(&self) -> bool {
        self.faults.is_empty()
    }
}

impl fmt::Display for WallFaults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let n = self.count();
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
            writeln!(f, "{}; allowed is {}; {}", fault.found, fault.allowed, fault.fix)?;
        }
        if self.more > 0 {
            writeln!(f, "... and {} more", self.more)?;
        }
        Ok(())
    }
}
