//! Surveyed stones sorted for courses, as a mason sorts them: by their height.

use crate::random::{Family, Pairs};

/// Stones in groups of like height. A course takes its height from one stone and its lengths from that stone's group.
pub(crate) struct Sorted {
    /// Height of each stone (m), ascending, and the share of all lengths up to and with it.
    heights: Vec<(f64, f64)>,
    groups: Vec<Group>,
}

/// Stones of like height.
struct Group {
    /// Number of the first stone of the next group.
    end: usize,
    lengths: Family,
}

impl Sorted {
    /// As many groups as the square root of the number of stones, rounded down, of as many stones each as goes.
    pub(crate) fn of(stones: &Pairs) -> Sorted {
        let mut rows = stones.rows().to_vec();
        rows.sort_by(|a, b| a[1].total_cmp(&b[1]).then(a[0].total_cmp(&b[0])));
        let total: f64 = rows.iter().map(|row| row[0]).sum();
        let mut below = 0.0;
        let heights = rows.iter().map(|[length, height]| {
            below += length;
            (*height, below / total)
        });
        let heights = heights.collect();
        let count = rows.len().isqrt().max(1);
        let end = |group: usize| group * rows.len() / count;
        let group = |group: usize| {
            let mut values: Vec<f64> = rows[end(group)..end(group + 1)].iter().map(|row| row[0]).collect();
            values.sort_by(f64::total_cmp);
            Group { end: end(group + 1), lengths: Family::Empirical { values } }
        };
        Sorted { heights, groups: (0..count).map(group).collect() }
    }

    /// Height (m) of the course at `u` in (0, 1), and the number of its group.
    ///
    /// A stone is as likely as it is long: a course of long stones holds fewer of them, so that in the end each stone of the survey
    /// comes as often as any other.
    pub(crate) fn course(&self, u: f64) -> (f64, usize) {
        let stone = self.heights.partition_point(|(_, share)| *share < u).min(self.heights.len() - 1);
        let group = self.groups.partition_point(|group| group.end <= stone);
        (self.heights[stone].0, group)
    }

    /// Lengths (m) of the stones of a group.
    pub(crate) fn lengths(&self, group: usize) -> &Family {
        &self.groups[group].lengths
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_course_takes_stones_of_like_height_and_every_stone_comes_as_often() {
        // Nine stones in three groups; the higher the longer.
        let stones: Vec<[f64; 2]> = (1..=9).map(|k| [0.1 * f64::from(k), 0.01 * f64::from(10 + k)]).collect();
        let sorted = Sorted::of(&Pairs::of(stones.clone()).expect("finite"));
        let mut expected = [0.0; 9];
        let cells = 90_000;
        for cell in 0..cells {
            let (height, group) = sorted.course((f64::from(cell) + 0.5) / f64::from(cells));
            let Family::Empirical { values } = sorted.lengths(group) else { panic!("a list") };
            let own = stones.iter().position(|stone| stone[1] == height).expect("a stone's height");
            assert_eq!(own / 3, group);
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            for length in values {
                let stone = stones.iter().position(|stone| stone[0] == *length).expect("a stone's length");
                assert_eq!(stone / 3, group, "stones of a course are of like height");
                // Stones per metre of such a course, each of the group as often.
                expected[stone] += 1.0 / mean / values.len() as f64 / f64::from(cells);
            }
        }
        // Each stone of a survey with lengths that sum to 4.5 m comes 1 / 4.5 times in a metre of course.
        assert!(expected.iter().all(|often| (often * 4.5 - 1.0).abs() < 1e-3), "{expected:?}");
    }

    #[test]
    fn one_stone_makes_courses_of_itself() {
        let sorted = Sorted::of(&Pairs::of(vec![[0.4, 0.2]]).expect("finite"));
        for u in [1e-12, 0.5, 1.0 - 1e-12] {
            assert_eq!(sorted.course(u), (0.2, 0));
        }
        assert_eq!(sorted.lengths(0).mean(), 0.4);
    }
}
