//! The causes that act in a model: none, one, or two of them together.

/// The causes of a model, as indices of mechanisms; none in the base model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Causes([Option<usize>; 2]);

impl Causes {
    /// Two causes together.
    pub fn pair(one: usize, other: usize) -> Causes {
        Causes([Some(one.min(other)), Some(one.max(other))])
    }

    /// Each of them, ascending.
    pub fn each(self) -> impl Iterator<Item = usize> {
        self.0.into_iter().flatten()
    }

    /// The cause, if it is one alone.
    pub(in crate::critic) fn single(self) -> Option<usize> {
        self.0[0].filter(|_| self.0[1].is_none())
    }

    /// A number of its own, by which random streams are kept apart: 0 for the base model.
    pub(in crate::critic) fn number(self) -> u64 {
        self.each().fold(0, |number, cause| (number << 16) + 1 + cause as u64)
    }
}

impl From<Option<usize>> for Causes {
    fn from(cause: Option<usize>) -> Causes {
        Causes([cause, None])
    }
}
