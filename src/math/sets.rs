//! Disjoint sets of numbers, with their members.

/// So many numbers in sets, each by itself at first.
pub struct Sets {
    of: Vec<usize>,
    members: Vec<Vec<usize>>,
}

impl Sets {
    /// The numbers below `count`, each by itself.
    pub fn new(count: usize) -> Sets {
        Sets { of: (0..count).collect(), members: (0..count).map(|member| vec![member]).collect() }
    }

    /// The number by which the set of a member is known.
    pub fn root(&self, member: usize) -> usize {
        self.of[member]
    }

    /// The members of the set that is known by a number, in no order; none where it is known by another one.
    pub fn members(&self, root: usize) -> &[usize] {
        &self.members[root]
    }

    /// The sets of more than one member.
    pub fn shared(&self) -> impl Iterator<Item = &[usize]> {
        self.members.iter().map(Vec::as_slice).filter(|set| set.len() > 1)
    }

    /// Makes one set of those of two members.
    pub fn join(&mut self, (a, b): (usize, usize)) {
        let (mut into, mut from) = (self.root(a), self.root(b));
        if into == from {
            return;
        }
        // The smaller set moves, so that all of it takes n log n.
        if self.members[into].len() < self.members[from].len() {
            std::mem::swap(&mut into, &mut from);
        }
        let moved = std::mem::take(&mut self.members[from]);
        moved.iter().for_each(|member| self.of[*member] = into);
        self.members[into].extend(moved);
    }
}
