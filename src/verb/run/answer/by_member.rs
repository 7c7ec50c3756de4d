//! Values by the numbers of the walls that bring them, in little memory.

use std::borrow::Cow;

/// Values by member, members ascending. Most members follow each other: each value takes 8 bytes, and each gap in the numbers 16 more.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ByMember {
    values: Vec<f64>,
    runs: Vec<Run>,
}

/// Members that follow each other without a gap.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Run {
    /// The first one.
    member: u64,
    /// The place of its value.
    place: usize,
}

impl ByMember {
    /// Adds the value of a member, whose number is larger than all before.
    pub fn push(&mut self, member: u64, value: f64) {
        let next = self.runs.last().map(|run| run.member + (self.values.len() - run.place) as u64);
        crate::check!(next.is_none_or(|next| next <= member), "the value of member {member} comes too late");
        if next != Some(member) {
            self.runs.push(Run { member, place: self.values.len() });
        }
        self.values.push(value);
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// The values in the order of their members.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The same, with what they take.
    pub fn into_values(self) -> Vec<f64> {
        self.values
    }

    /// Each value with its member.
    pub fn iter(&self) -> impl Iterator<Item = (u64, f64)> {
        let ends = self.runs.iter().skip(1).map(|run| run.place).chain([self.values.len()]);
        self.runs
            .iter()
            .zip(ends)
            .flat_map(|(run, end)| (run.member..).zip(&self.values[run.place..end]))
            .map(|(member, value)| (member, *value))
    }

    /// The values of members that both have, side by side.
    pub fn pairs(&self, other: &ByMember) -> impl Iterator<Item = (u64, [f64; 2])> {
        let mut theirs = other.iter().peekable();
        self.iter().filter_map(move |(member, own)| {
            while theirs.next_if(|(number, _)| *number < member).is_some() {}
            theirs.next_if(|(number, _)| *number == member).map(|(_, their)| (member, [own, their]))
        })
    }

    /// The same as two samples; without a copy where both have the same members.
    pub fn paired<'v>(&'v self, other: &'v ByMember) -> [Cow<'v, [f64]>; 2] {
        if (self.len(), &self.runs) == (other.len(), &other.runs) {
            return [Cow::Borrowed(&self.values), Cow::Borrowed(&other.values)];
        }
        let (own, their): (Vec<f64>, Vec<f64>) =
            self.pairs(other).map(|(_, [own, their])| (own, their)).unzip();
        [Cow::Owned(own), Cow::Owned(their)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(values: &[(u64, f64)]) -> ByMember {
        let mut own = ByMember::default();
        values.iter().for_each(|(member, value)| own.push(*member, *value));
        own
    }

    #[test]
    fn members_are_known_across_gaps() {
        let all = [(0, 3.0), (1, 1.0), (4, 2.0), (5, 7.0), (6, -1.0), (1 << 40, 0.5)];
        let own = of(&all);
        assert_eq!(own.iter().collect::<Vec<_>>(), all);
        assert_eq!((own.len(), own.runs.len()), (6, 3));
        assert_eq!(own.values(), all.map(|(_, value)| value));
        assert_eq!(of(&[]).iter().count(), 0);
    }

    #[test]
    fn pairs_are_of_members_that_both_have() {
        let (a, b) =
            (of(&[(0, 1.0), (1, 2.0), (3, 3.0), (7, 4.0)]), of(&[(1, 20.0), (2, 1.0), (3, 30.0), (9, 1.0)]));
        assert_eq!(a.pairs(&b).collect::<Vec<_>>(), [(1, [2.0, 20.0]), (3, [3.0, 30.0])]);
        assert_eq!(a.paired(&b), [vec![2.0, 3.0], vec![20.0, 30.0]]);
        // As many, and the same runs but the last, which begins at another member.
        let c = of(&[(0, 5.0), (1, 6.0), (3, 7.0), (8, 8.0)]);
        assert_eq!(a.paired(&c), [vec![1.0, 2.0, 3.0], vec![5.0, 6.0, 7.0]]);
        let same = of(&[(0, 5.0), (1, 6.0), (3, 7.0), (7, 8.0)]);
        let paired = a.paired(&same);
        assert!(matches!(paired, [Cow::Borrowed(_), Cow::Borrowed(_)]) && paired[1] == same.values());
    }

    #[test]
    #[should_panic(expected = "member 2 comes too late")]
    fn a_member_that_comes_too_late_is_our_own_fault() {
        of(&[(0, 1.0), (2, 1.0), (2, 3.0)]);
    }
}
