//! The causes that act in a model: none, one, or two of them together; and on which joints they act.

/// On which joints a cause acts. Arms whose joints are stated alike have joints of one kind: regular blocks and irregular stones need not
/// have the same.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Scope {
    /// On all alike; the only scope of a cause that acts on something else than joints.
    #[default]
    All,
    /// On those of one kind alone, by its number among the [kinds](crate::critic::World::kind).
    Kind(usize),
    /// On those of every kind, by parameters of their own.
    Each,
}

/// The causes of a model, as indices of mechanisms, each with its scope; none in the base model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Causes([Option<(usize, Scope)>; 2]);

impl Causes {
    /// One cause with a scope.
    pub fn one(cause: usize, scope: Scope) -> Causes {
        Causes([Some((cause, scope)), None])
    }

    /// Two causes together, on all joints.
    pub fn pair(one: usize, other: usize) -> Causes {
        Causes::both([(one, Scope::All), (other, Scope::All)])
    }

    /// Two causes together, each with its scope.
    pub fn both(mut two: [(usize, Scope); 2]) -> Causes {
        two.sort_unstable();
        Causes(two.map(Some))
    }

    /// Each of them with its scope, ascending.
    pub fn scoped(self) -> impl Iterator<Item = (usize, Scope)> {
        self.0.into_iter().flatten()
    }

    /// Each of them, ascending.
    pub fn each(self) -> impl Iterator<Item = usize> {
        self.scoped().map(|(cause, _)| cause)
    }

    /// Whether it is one alone.
    pub(in crate::critic) fn is_single(self) -> bool {
        self.0[0].is_some() && self.0[1].is_none()
    }

    /// A number by which random streams are kept apart: 0 for the base model.
    pub(in crate::critic) fn number(self) -> u64 {
        self.scoped().fold(0, |number, (cause, scope)| {
            let scope = match scope {
                Scope::All => 0,
                Scope::Each => 1,
                Scope::Kind(kind) => 2 + kind as u64,
            };
            (number << 24) + (scope << 16) + 1 + cause as u64
        })
    }
}

impl From<Option<usize>> for Causes {
    /// On all joints.
    fn from(cause: Option<usize>) -> Causes {
        Causes([cause.map(|cause| (cause, Scope::All)), None])
    }
}
