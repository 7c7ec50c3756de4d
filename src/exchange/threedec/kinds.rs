//! What the commands of 3DEC do, as far as blocks are concerned.
//!
//! Sources: Itasca, 3DEC 5.2 Command Reference; 3DEC 7.0 documentation, "block create" and "Creating Single Blocks". Older versions take the
//! first letters of a command for it.

use crate::exchange::threedec::lines::Word;

/// What a command does; numbers are those of the word after it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    /// Makes a block.
    Create(usize),
    /// Holds blocks.
    Fix(usize),
    /// Lets them go.
    Free(usize),
    /// Gives blocks a group.
    Group(usize),
    /// Gives blocks regions.
    Region,
    /// Hides blocks, so that the commands after it do not see them.
    Hide,
    /// Shows all again.
    Show,
    /// Begins anew.
    New,
    /// Writes the model to a file.
    Save,
    /// Reads it back.
    Restore,
    /// Begins a function of FISH.
    Function,
    /// Ends the file.
    End,
    /// Moves or holds corners, which may hold a block.
    MayHold,
    /// Does nothing to blocks.
    Passed,
    /// Changes blocks in a way that is not read.
    Changes,
    /// Reads another file.
    Call,
    /// Adds cables or beams.
    Reinforces,
    /// Is not known here.
    Unknown,
}

/// The older commands, each with the letters that are enough.
const FIRST: [(&str, usize, Kind); 73] = [
    ("polyhedron", 4, Kind::Create(1)),
    ("fix", 3, Kind::Fix(1)),
    ("free", 4, Kind::Free(1)),
    ("group", 3, Kind::Group(1)),
    ("mark", 3, Kind::Region),
    ("hide", 3, Kind::Hide),
    ("show", 3, Kind::Show),
    ("seek", 3, Kind::Show),
    ("new", 3, Kind::New),
    ("save", 3, Kind::Save),
    ("restore", 4, Kind::Restore),
    ("define", 3, Kind::Function),
    ("return", 3, Kind::End),
    ("exit", 4, Kind::End),
    ("quit", 4, Kind::End),
    ("stop", 4, Kind::End),
    ("boundary", 3, Kind::MayHold),
    ("apply", 3, Kind::MayHold),
    ("call", 3, Kind::Call),
    ("structure", 5, Kind::Reinforces),
    ("cable", 3, Kind::Reinforces),
    ("jset", 4, Kind::Changes),
    ("tunnel", 3, Kind::Changes),
    ("cut", 3, Kind::Changes),
    ("split", 3, Kind::Changes),
    ("densify", 4, Kind::Changes),
    ("delete", 3, Kind::Changes),
    ("remove", 4, Kind::Changes),
    ("excavate", 4, Kind::Changes),
    ("join", 4, Kind::Changes),
    ("merge", 4, Kind::Changes),
    ("import", 3, Kind::Changes),
    ("property", 4, Kind::Passed),
    ("change", 4, Kind::Passed),
    ("configure", 4, Kind::Passed),
    ("set", 3, Kind::Passed),
    ("gravity", 4, Kind::Passed),
    ("insitu", 3, Kind::Passed),
    ("initial", 3, Kind::Passed),
    ("history", 3, Kind::Passed),
    ("plot", 3, Kind::Passed),
    ("print", 3, Kind::Passed),
    ("list", 4, Kind::Passed),
    ("reset", 4, Kind::Passed),
    ("solve", 4, Kind::Passed),
    ("cycle", 3, Kind::Passed),
    ("step", 4, Kind::Passed),
    ("damping", 4, Kind::Passed),
    ("mscale", 4, Kind::Passed),
    ("table", 3, Kind::Passed),
    ("label", 3, Kind::Passed),
    ("log", 3, Kind::Passed),
    ("log-file", 4, Kind::Passed),
    ("title", 4, Kind::Passed),
    ("heading", 4, Kind::Passed),
    ("pause", 3, Kind::Passed),
    ("echo", 4, Kind::Passed),
    ("range", 5, Kind::Passed),
    ("generate", 3, Kind::Passed),
    ("zone", 4, Kind::Passed),
    ("water", 5, Kind::Passed),
    ("fluid", 5, Kind::Passed),
    ("thermal", 4, Kind::Passed),
    ("geometry", 4, Kind::Passed),
    ("fracture", 4, Kind::Passed),
    ("dfn", 3, Kind::Passed),
    ("data", 4, Kind::Passed),
    ("project", 4, Kind::Passed),
    ("python-reset-state", 18, Kind::Passed),
    ("movie", 4, Kind::Passed),
    ("info", 4, Kind::Passed),
    ("warning", 4, Kind::Passed),
    ("ucs", 3, Kind::Passed),
];

/// What may follow `block` in 7.0, where it does not change blocks.
const OF_BLOCKS: [(&str, usize, Kind); 24] = [
    ("create", 2, Kind::Create(2)),
    ("fix", 3, Kind::Fix(2)),
    ("free", 4, Kind::Free(2)),
    ("group", 2, Kind::Group(2)),
    ("region", 3, Kind::Region),
    ("hide", 3, Kind::Hide),
    ("apply", 3, Kind::MayHold),
    ("property", 4, Kind::Passed),
    ("contact", 3, Kind::Passed),
    ("subcontact", 4, Kind::Passed),
    ("zone", 3, Kind::Passed),
    ("mechanical", 4, Kind::Passed),
    ("history", 3, Kind::Passed),
    ("insitu", 3, Kind::Passed),
    ("initialize", 3, Kind::Passed),
    ("list", 3, Kind::Passed),
    ("constitutive", 4, Kind::Passed),
    ("export", 3, Kind::Passed),
    ("face", 4, Kind::Passed),
    ("edge", 4, Kind::Passed),
    ("results", 3, Kind::Passed),
    ("thermal", 4, Kind::Passed),
    ("fluid", 4, Kind::Passed),
    ("large-strain", 5, Kind::Passed),
];

/// What may follow `model` and `program`, where it is more than a setting or a step.
const OF_MODELS: [(&str, usize, Kind); 3] =
    [("new", 3, Kind::New), ("save", 2, Kind::Save), ("restore", 4, Kind::Restore)];
const OF_PROGRAMS: [(&str, usize, Kind); 5] = [
    ("call", 3, Kind::Call),
    ("return", 3, Kind::End),
    ("exit", 2, Kind::End),
    ("quit", 3, Kind::End),
    ("stop", 3, Kind::End),
];
const OF_FISH: [(&str, usize, Kind); 2] = [("define", 3, Kind::Function), ("operator", 4, Kind::Function)];

/// What a command does.
pub(super) fn kind(words: &[Word<'_>]) -> Kind {
    let Some(first) = words.first() else { return Kind::Passed };
    let second = words.get(1);
    let of = |list: &[(&str, usize, Kind)], other: Kind| {
        let found = second.and_then(|word| list.iter().find(|(name, least, _)| word.is(name, *least)));
        found.map_or(other, |(.., kind)| *kind)
    };
    if first.is("block", 2) {
        let corners = second.is_some_and(|word| word.is("gridpoint", 4));
        let sets = words
            .get(2)
            .is_some_and(|word| word.is("initialize", 3) || word.is("list", 3) || word.is("history", 3));
        return match of(&OF_BLOCKS, Kind::Changes) {
            Kind::Hide if words.get(2).is_some_and(|word| word.is("off", 2) || word.is("false", 5)) => {
                Kind::Show
            }
            Kind::Changes if corners && sets => Kind::Passed,
            Kind::Changes if corners => Kind::MayHold,
            own => own,
        };
    }
    if first.is("model", 5) {
        return of(&OF_MODELS, Kind::Passed);
    }
    if first.is("program", 4) {
        return of(&OF_PROGRAMS, Kind::Passed);
    }
    if first.is("fish", 4) {
        return of(&OF_FISH, Kind::Passed);
    }
    // A function that is called, and a calculation: what functions do was looked at where they were defined.
    if first.text.starts_with(['@', '[']) {
        return Kind::Passed;
    }
    let found = FIRST.iter().find(|(name, least, _)| first.is(name, *least));
    found.map_or(Kind::Unknown, |(.., kind)| *kind)
}
