//! Reading the blocks of 3DEC out of its command files: what the commands make, and which of it they hold.

mod chosen;
mod kinds;
mod lines;
mod shape;

use std::collections::{BTreeMap, BTreeSet};

use crate::exchange::draft::MOST_BLOCKS;
use crate::exchange::fault::{Fault, WallFaults};
use crate::exchange::mesh::Mesh;
use crate::exchange::threedec::chosen::{Known, chosen};
use crate::exchange::threedec::kinds::{Kind, kind};
use crate::exchange::threedec::lines::{Command, MOST_WORDS, Word, commands};
use crate::exchange::threedec::shape::{block, name};

/// Faults after which the rest of a file is not worth reading.
const MOST_FAULTS: usize = 100;
/// Most corners of a file.
const MOST_VERTICES: usize = 2_000_000;
/// Commands that a warning names.
const NAMED: usize = 8;
/// Functions of FISH that change blocks.
const CHANGING: [&str; 4] = ["block.create", "block.cut", "block.delete", "block.split"];

/// Bodies, and what a careful reader would like to know of the file.
pub(super) type Blocks = (Vec<Mesh>, Vec<String>);

/// The blocks in the text of a command file, in its order, called as their groups or regions are. Commands that hold blocks are followed where their
/// range says exactly which; those that are not followed are told with their lines. Commands that do nothing to blocks are counted.
///
/// # Errors
/// Commands that make or change blocks in a way that is not read, and those that are not known, with their lines.
pub(super) fn read_3dec(text: &str) -> Result<Blocks, WallFaults> {
    let mut reader = Reader::new();
    for command in commands(text) {
        if !reader.command(&command) {
            break;
        }
        if reader.faults.count() >= MOST_FAULTS {
            let last =
                Fault::of("", "the rest of the file was not looked at", "a few faults", "mend these first");
            reader.faults.push_last(last);
            break;
        }
    }
    reader.finished()
}

/// A block with what ranges go by.
#[derive(Debug)]
struct Stone {
    mesh: Mesh,
    region: Option<i64>,
    /// Names and slots of its groups.
    groups: BTreeSet<(String, String)>,
}

#[derive(Debug)]
struct Reader {
    faults: WallFaults,
    stones: Vec<Stone>,
    vertices: usize,
    known: Known,
    /// Whether no block is hidden.
    sees_all: bool,
    /// Within a function of FISH: whether its lines are commands that it gives.
    function: Option<bool>,
    /// Files to which the model was written.
    saved: BTreeSet<String>,
    /// Commands that do nothing to blocks, by their names.
    passed: BTreeMap<String, usize>,
    /// Commands that may hold blocks and were not followed.
    unheld: Vec<String>,
}

impl Reader {
    fn new() -> Reader {
        Reader {
            faults: WallFaults::new("wall.3ddat"),
            stones: Vec::new(),
            vertices: 0,
            known: Known { groups: true, regions: true },
            sees_all: true,
            function: None,
            saved: BTreeSet::new(),
            passed: BTreeMap::new(),
            unheld: Vec::new(),
        }
    }

    /// Follows a command; `false` where the file ends.
    fn command(&mut self, command: &Command<'_>) -> bool {
        if command.is_too_long {
            let found = format!("a command of more than {MOST_WORDS} words");
            self.fault(command, found, "at most so many", "divide or simplify the block");
            return true;
        }
        if let Some(gives) = self.function {
            self.in_function(command, gives);
            return true;
        }
        self.changing(command);
        let words = &command.words;
        let after = |at: usize| words.get(at..).unwrap_or(&[]);
        match kind(words) {
            Kind::Create(at) => self.create(command, after(at)),
            Kind::Fix(at) => self.hold(command, after(at), true),
            Kind::Free(at) => self.hold(command, after(at), false),
            Kind::Group(at) => self.group(command, after(at)),
            Kind::Region => {
                self.known.regions = false;
                self.pass(command);
            }
            Kind::Hide => self.sees_all = false,
            Kind::Show => self.sees_all = true,
            Kind::New => {
                self.stones.clear();
                (self.known, self.sees_all) = (Known { groups: true, regions: true }, true);
            }
            Kind::Save => {
                self.saved.extend(words.iter().map(|word| word.text.to_lowercase()));
                self.pass(command);
            }
            Kind::Restore if words.iter().skip(1).any(|word| self.is_saved(word)) => self.pass(command),
            Kind::Function => self.function = Some(false),
            Kind::End => return false,
            Kind::MayHold => self.unheld(command),
            Kind::Passed => self.pass(command),
            kind => self.refuse(command, kind),
        }
        true
    }

    /// Whether a word is the name of a file to which the model was written before.
    fn is_saved(&self, word: &Word<'_>) -> bool {
        let is_command = ["restore", "model"].iter().any(|own| word.is(own, 4));
        !is_command && self.saved.contains(&word.text.to_lowercase())
    }

    /// Looks at a line of a function, which may give commands.
    fn in_function(&mut self, command: &Command<'_>, gives: bool) {
        let [first, ..] = command.words[..] else { return };
        let ends = |name: &str| first.text.eq_ignore_ascii_case(name);
        if ["endcommand", "end_command", "end-command"].into_iter().any(ends) {
            self.function = Some(false);
        } else if !gives && ends("end") {
            self.function = None;
        } else if !gives && ends("command") {
            self.function = Some(true);
        } else if gives {
            match kind(&command.words) {
                Kind::Passed | Kind::Save | Kind::End => {}
                // Nobody knows how often, and of which blocks.
                Kind::Group(_) => self.known.groups = false,
                Kind::Region => self.known.regions = false,
                Kind::MayHold | Kind::Fix(_) | Kind::Free(_) => self.unheld(command),
                _ => {
                    let found =
                        format!("a function of FISH that makes or changes blocks: \"{}\"", command.shown());
                    let fix = "write a command for each block in its place, with its numbers";
                    self.fault(command, found, "blocks by commands with numbers", fix);
                }
            }
        } else {
            self.changing(command);
        }
    }

    /// Refuses calls of functions that change blocks.
    fn changing(&mut self, command: &Command<'_>) {
        let text = |word: &Word<'_>| word.text.to_ascii_lowercase();
        if command
            .words
            .iter()
            .filter(|word| !word.is_quoted)
            .any(|word| CHANGING.iter().any(|own| text(word).contains(own)))
        {
            let found = format!("FISH that makes or changes blocks: \"{}\"", command.shown());
            let fix = "write a command for each block in its place, with its numbers";
            self.fault(command, found, "blocks by commands with numbers", fix);
        }
    }

    fn create(&mut self, command: &Command<'_>, words: &[Word<'_>]) {
        let made = match block(words) {
            Ok(made) => made,
            Err(wrong) => return self.fault(command, wrong.found, wrong.allowed, wrong.fix),
        };
        self.vertices += made.vertices.len();
        if self.stones.len() >= MOST_BLOCKS || self.vertices > MOST_VERTICES {
            let found = format!("more than {MOST_BLOCKS} blocks, or {MOST_VERTICES} corners");
            return self.fault(command, found, "fewer", "divide the wall");
        }
        let group = made.group.as_ref().map(|(name, _)| name.clone());
        let mesh = Mesh {
            name: group.or(made.region.map(|region| format!("region {region}"))),
            is_support: Some(false),
            line: command.line,
            vertices: made.vertices,
            faces: made.faces,
        };
        self.stones.push(Stone { mesh, region: made.region, groups: made.group.into_iter().collect() });
    }

    /// Follows a range; `None` where it does not say exactly which blocks it chooses.
    fn chosen(&self, range: &[Word<'_>]) -> Option<Vec<bool>> {
        chosen(range, &self.stones, self.known).filter(|own| self.sees_all && own.contains(&true))
    }

    fn hold(&mut self, command: &Command<'_>, range: &[Word<'_>], held: bool) {
        let Some(chosen) = self.chosen(range) else { return self.unheld(command) };
        for (stone, _) in self.stones.iter_mut().zip(chosen).filter(|(_, chosen)| *chosen) {
            stone.mesh.is_support = Some(held);
        }
    }

    fn group(&mut self, command: &Command<'_>, words: &[Word<'_>]) {
        let words = if words.first().is_some_and(|word| word.is("block", 5)) { &words[1..] } else { words };
        let mut rest = words.iter();
        let named = name(&mut rest);
        let chosen = self.chosen(rest.as_slice());
        let (Ok((name, slot)), Some(chosen)) = (named, chosen) else {
            self.known.groups = false;
            return self.pass(command);
        };
        for (stone, _) in self.stones.iter_mut().zip(chosen).filter(|(_, chosen)| *chosen) {
            stone.groups.retain(|(_, own)| *own != slot);
            stone.groups.insert((name.clone(), slot.clone()));
            stone.mesh.name = Some(name.clone());
        }
    }

    fn pass(&mut self, command: &Command<'_>) {
        let name = match &command.words[..] {
            [first, second, ..]
                if ["block", "model", "program", "fish"].iter().any(|own| first.is(own, 4)) =>
            {
                format!("{} {}", first.text, second.text)
            }
            [first, ..] if first.text.starts_with(['@', '[']) => "FISH".to_owned(),
            [first, ..] => first.text.to_owned(),
            [] => return,
        };
        *self.passed.entry(name.to_lowercase()).or_default() += 1;
    }

    fn unheld(&mut self, command: &Command<'_>) {
        self.unheld.push(format!("line {} ({})", command.line, command.shown()));
    }

    /// Refuses what makes or changes blocks in a way that is not read.
    fn refuse(&mut self, command: &Command<'_>, kind: Kind) {
        let (found, fix) = match kind {
            Kind::Call => ("it reads another file", "put the commands of that file in its place"),
            Kind::Restore => {
                ("it reads a model that this file did not save", "give the commands that made the model")
            }
            Kind::Reinforces => (
                "cables and beams hold stones, and are not read",
                "take it out to ask for the wall without them",
            ),
            Kind::Changes => (
                "it changes blocks in a way that is not read",
                "write the blocks as they are after it, by their faces",
            ),
            _ => ("it is not known here", "take it out if it does nothing to blocks"),
        };
        let found = format!("\"{}\": {found}", command.shown());
        self.fault(command, found, "commands that make, hold or describe blocks", fix);
    }

    fn fault(&mut self, command: &Command<'_>, found: String, allowed: &str, fix: &str) {
        self.faults.push(Fault::of("", found, allowed, fix).at(command.line, 0));
    }

    fn finished(mut self) -> Result<Blocks, WallFaults> {
        if self.function.is_some() {
            let fault =
                Fault::of("", "a function of FISH does not end", "\"end\" in a line by itself", "end it");
            self.faults.push_last(fault);
        }
        if self.stones.is_empty() && self.faults.is_empty() {
            let allowed = "commands as poly brick x1 x2 y1 y2 z1 z2, or block create brick ...";
            self.faults.push(Fault::of(
                "",
                "no command makes a block",
                allowed,
                "give the file that makes the blocks",
            ));
        }
        if !self.faults.is_empty() {
            return Err(self.faults);
        }
        let mut warnings = Vec::new();
        if !self.unheld.is_empty() {
            let shown = self.unheld.iter().take(NAMED).cloned().collect::<Vec<_>>().join(", ");
            let more = self.unheld.len().saturating_sub(NAMED);
            let more = if more > 0 { format!(" and {more} more") } else { String::new() };
            warnings.push(format!(
                "commands that may hold blocks were passed over, as they do not say exactly which: {shown}{more}; --fixed holds blocks by their numbers"
            ));
        }
        let count: usize = self.passed.values().sum();
        if count > 0 {
            let named = self.passed.iter().take(NAMED).map(|(name, times)| format!("{name} ({times})"));
            let dots = if self.passed.len() > NAMED { ", ..." } else { "" };
            let named = named.collect::<Vec<_>>().join(", ");
            warnings.push(format!("{count} commands that make no blocks were passed over: {named}{dots}"));
        }
        Ok((self.stones.into_iter().map(|stone| stone.mesh).collect(), warnings))
    }
}

#[cfg(test)]
mod tests;
