//! Closed lines put together of pieces whose ends meet: of lines, arcs and open polylines.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use crate::math::atan2;
use crate::shape::moments;

/// A piece of a line, from its first point to its last one.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    /// Line of the file.
    pub line: usize,
    /// Two or more.
    pub points: Vec<[f64; 2]>,
}

/// A line put together.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Put {
    /// Line of the file of its first piece.
    pub line: usize,
    pub points: Vec<[f64; 2]>,
    pub closed: bool,
}

/// What pieces make together.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Joined {
    /// Chains and loops; where more than two ends meet, the cells between the pieces.
    pub lines: Vec<Put>,
    /// Ends of pieces that fork elsewhere and meet nothing here: the line of the file, and the place.
    pub loose: Vec<(usize, [f64; 2])>,
    /// How many of the lines are cells of a net, and where its first fork is.
    pub cells: usize,
    pub fork: Option<(usize, [f64; 2])>,
    /// Straight pieces that are there again, and are left out.
    pub repeated: usize,
}

/// Places where ends meet, each within a tolerance.
struct Places {
    cell: f64,
    tolerance: f64,
    known: HashMap<[i64; 2], Vec<usize>>,
    all: Vec<[f64; 2]>,
}

impl Places {
    fn new(tolerance: f64) -> Places {
        // A point's neighbourhood is seldom in more than one cell of this size, and few places are in one.
        Places { cell: 4.0 * tolerance, tolerance, known: HashMap::new(), all: Vec::new() }
    }

    /// The number of the place at a point.
    fn of(&mut self, point: [f64; 2]) -> usize {
        let cell = |x: f64| (x / self.cell).floor() as i64;
        let [x, z] = point.map(|x| [cell(x - self.tolerance), cell(x + self.tolerance)]);
        let near = |i: &usize| (0..2).all(|k| (self.all[*i][k] - point[k]).abs() <= self.tolerance);
        for key in [[x[0], z[0]], [x[1], z[0]], [x[0], z[1]], [x[1], z[1]]] {
            if let Some(found) = self.known.get(&key).and_then(|own| own.iter().find(|i| near(i))) {
                return *found;
            }
        }
        self.all.push(point);
        self.known.entry(point.map(cell)).or_default().push(self.all.len() - 1);
        self.all.len() - 1
    }
}

/// The pieces as a graph. Half `2 i` leads along piece `i`, half `2 i + 1` back.
struct Net {
    pieces: Vec<Piece>,
    /// The place from which a half leads; that of its twin is where it leads.
    from: Vec<usize>,
    /// The halves that lead from a place.
    leaving: Vec<Vec<usize>>,
    places: Vec<[f64; 2]>,
}

/// Puts pieces together, whose ends meet within `tolerance`.
pub(super) fn join(pieces: Vec<Piece>, tolerance: f64) -> Joined {
    let mut joined = Joined::default();
    let mut net = Net::of(pieces, tolerance, &mut joined);
    let mut used = vec![false; net.pieces.len()];
    for first in 0..net.pieces.len() {
        if used[first] {
            continue;
        }
        let own = net.component(2 * first, &mut used);
        let degree = |half: &usize| net.leaving[net.from[*half]].len();
        if let Some(fork) = own.iter().flat_map(|i| [2 * i, 2 * i + 1]).find(|half| degree(half) > 2) {
            joined.fork = joined.fork.or(Some((net.pieces[fork / 2].line, net.places[net.from[fork]])));
            net.prune(&own, &mut joined.loose);
            let cells = net.cells(&own);
            joined.cells += cells.len();
            joined.lines.extend(cells);
        } else {
            // A chain begins at a loose end, a loop anywhere.
            let start = own.iter().flat_map(|i| [2 * i, 2 * i + 1]).find(|half| degree(half) == 1);
            let (points, closed) = net.walk(start.unwrap_or(2 * first));
            joined.lines.push(Put { line: net.pieces[first].line, points, closed });
        }
    }
    joined
}

impl Net {
    fn of(pieces: Vec<Piece>, tolerance: f64, joined: &mut Joined) -> Net {
        let mut net = Net { pieces: Vec::new(), from: Vec::new(), leaving: Vec::new(), places: Vec::new() };
        let (mut places, mut straight) = (Places::new(tolerance), BTreeSet::new());
        for piece in pieces {
            let [Some(first), Some(last)] = [piece.points.first(), piece.points.last()] else { continue };
            let ends = [places.of(*first), places.of(*last)];
            if ends[0] == ends[1] && piece.points.len() > 2 {
                joined.lines.push(Put { line: piece.line, points: piece.points, closed: true });
                continue;
            }
            // The side that two stones share may be drawn twice; a side without length joins nothing.
            let sorted = [ends[0].min(ends[1]), ends[0].max(ends[1])];
            let again = piece.points.len() == 2 && !straight.insert(sorted);
            if again || ends[0] == ends[1] {
                joined.repeated += usize::from(ends[0] != ends[1]);
                continue;
            }
            net.pieces.push(piece);
            net.from.extend(ends);
        }
        net.leaving = vec![Vec::new(); places.all.len()];
        for (half, place) in net.from.iter().enumerate() {
            net.leaving[*place].push(half);
        }
        net.places = places.all;
        net
    }

    /// The pieces that hang together with a half, in order.
    fn component(&self, half: usize, used: &mut [bool]) -> Vec<usize> {
        let (mut own, mut open) = (vec![half / 2], vec![half / 2]);
        used[half / 2] = true;
        while let Some(piece) = open.pop() {
            for end in [2 * piece, 2 * piece + 1] {
                for other in &self.leaving[self.from[end]] {
                    if !std::mem::replace(&mut used[other / 2], true) {
                        own.push(other / 2);
                        open.push(other / 2);
                    }
                }
            }
        }
        own.sort_unstable();
        own
    }

    /// The points along a half, without its last one.
    fn along(&self, half: usize) -> Box<dyn Iterator<Item = [f64; 2]> + '_> {
        let points = &self.pieces[half / 2].points;
        let count = points.len() - 1;
        if half.is_multiple_of(2) {
            Box::new(points.iter().copied().take(count))
        } else {
            Box::new(points.iter().rev().copied().take(count))
        }
    }

    /// The points of a chain or a loop from a half on, and whether it is a loop.
    fn walk(&self, start: usize) -> (Vec<[f64; 2]>, bool) {
        let (mut points, mut half) = (Vec::new(), start);
        loop {
            points.extend(self.along(half));
            let arrived = half ^ 1;
            match self.leaving[self.from[arrived]].iter().find(|other| **other != arrived) {
                Some(next) if *next == start => return (points, true),
                Some(next) => half = *next,
                None => {
                    points.push(self.places[self.from[arrived]]);
                    return (points, false);
                }
            }
        }
    }

    /// Takes pieces away that lead nowhere, and tells where they end.
    fn prune(&mut self, own: &[usize], loose: &mut Vec<(usize, [f64; 2])>) {
        let ends = own.iter().flat_map(|i| [2 * i, 2 * i + 1]);
        let mut open: Vec<usize> = ends.filter(|half| self.leaving[self.from[*half]].len() == 1).collect();
        loose.extend(open.iter().map(|half| (self.pieces[half / 2].line, self.places[self.from[*half]])));
        while let Some(half) = open.pop() {
            for end in [half, half ^ 1] {
                self.leaving[self.from[end]].retain(|other| *other != end);
            }
            if let [last] = self.leaving[self.from[half ^ 1]][..] {
                open.push(last);
            }
        }
    }

    /// The cells between the pieces of a net: at each place, go on along the next piece clockwise.
    fn cells(&self, own: &[usize]) -> Vec<Put> {
        let mut next = BTreeMap::new();
        let halves = || own.iter().flat_map(|i| [2 * i, 2 * i + 1]);
        let angle = |half: usize| {
            let [a, b] = [0, 1].map(|i| self.along(half).nth(i).unwrap_or(self.places[self.from[half ^ 1]]));
            atan2(b[1] - a[1], b[0] - a[0])
        };
        let places: BTreeSet<usize> = halves().map(|half| self.from[half]).collect();
        for place in places {
            let mut around: Vec<(f64, usize)> =
                self.leaving[place].iter().map(|half| (angle(*half), *half)).collect();
            around.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            for (i, (_, half)) in around.iter().enumerate() {
                let clockwise = around[(i + around.len() - 1) % around.len()].1;
                next.insert(half ^ 1, clockwise);
            }
        }
        let mut cells = Vec::new();
        for start in halves() {
            let (mut points, mut line, mut half) = (Vec::new(), usize::MAX, start);
            while let Some(after) = next.remove(&half) {
                points.extend(self.along(half));
                line = line.min(self.pieces[half / 2].line);
                half = after;
            }
            // Around the whole net the way goes clockwise.
            if moments(&points).area > 0.0 {
                cells.push(Put { line, points, closed: true });
            }
        }
        cells
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pieces(lines: &[[f64; 4]]) -> Vec<Piece> {
        (1..)
            .zip(lines)
            .map(|(line, [a, b, c, d])| Piece { line, points: vec![[*a, *b], [*c, *d]] })
            .collect()
    }

    #[test]
    fn lines_in_any_direction_make_a_loop_and_others_a_chain() {
        let square =
            [[0.0, 0.0, 1.0, 0.0], [1.0, 1.0, 1.0, 1e-7], [1.0, 1.0, 0.0, 1.0], [0.0, 1.0, 0.0, 0.0]];
        let joined = join(pieces(&square), 1e-6);
        assert_eq!(joined.lines.len(), 1, "{joined:?}");
        assert!(joined.lines[0].closed && joined.lines[0].points.len() == 4 && joined.lines[0].line == 1);
        let joined = join(pieces(&square[1..]), 1e-6);
        let ends = [[1.0, 1e-7], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]];
        assert_eq!(joined.lines, [Put { line: 1, points: ends.to_vec(), closed: false }]);
        let bow = Piece { line: 9, points: vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, 0.0]] };
        assert!(join(vec![bow], 1e-6).lines[0].closed);
    }

    #[test]
    fn stones_that_share_a_side_are_cells() {
        let two = [
            [0.0, 0.0, 1.0, 0.0],
            [1.0, 0.0, 1.0, 1.0],
            [1.0, 1.0, 0.0, 1.0],
            [0.0, 1.0, 0.0, 0.0],
            [1.0, 0.0, 2.0, 0.0],
            [2.0, 0.0, 2.0, 1.0],
            [2.0, 1.0, 1.0, 1.0],
            // The shared side again, backwards, and one that leads nowhere.
            [1.0, 1.0, 1.0, 0.0],
            [2.0, 1.0, 3.0, 1.0],
        ];
        let joined = join(pieces(&two), 1e-6);
        assert_eq!((joined.lines.len(), joined.cells, joined.repeated), (2, 2, 1), "{joined:?}");
        assert!(joined.lines.iter().all(|line| line.points.len() == 4 && moments(&line.points).area > 0.0));
        assert_eq!(joined.loose, [(9, [3.0, 1.0])]);
        assert_eq!(joined.fork.map(|fork| fork.1), Some([1.0, 0.0]));
    }
}
