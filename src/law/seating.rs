//! The few points of a bed joint on which a stone bears.

/// Most points of a joint.
pub const MOST_SEATS: usize = 16;

/// Where a joint bears, in place of its whole face.
///
/// Every point of the face belongs to the nearest seat. What bears of a seat's part is that part, shrunk about the seat until `share` of its
/// area is left: patches never overlap, have `share` of the face together, and are the whole face where that is 1.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Seating {
    /// Share of the face that bears, above 0 and up to 1.
    pub share: f64,
    seats: [Seat; MOST_SEATS],
    count: usize,
}

/// A point on which a stone bears.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Seat {
    /// Where it lies, in numbers from 0 to 1: the share of the face on the lower side of it along the face's first axis, and how far along the
    /// second axis. Uniform numbers are uniform points of a convex face.
    pub at: [f64; 2],
    /// How far it lies behind the face (m), 0 or more: the gap with which the stone was laid there.
    pub recess: f64,
}

impl Seating {
    /// Seats with that share of the face, in their order; of more than [`MOST_SEATS`] the first.
    pub fn new(share: f64, seats: &[Seat]) -> Seating {
        let mut all = [Seat::default(); MOST_SEATS];
        all.iter_mut().zip(seats).for_each(|(kept, seat)| *kept = *seat);
        Seating { share, seats: all, count: seats.len().min(MOST_SEATS) }
    }

    /// Its seats.
    pub fn seats(&self) -> &[Seat] {
        &self.seats[..self.count]
    }

    /// Its seats as numbers: where each lies, and how far behind the face (m).
    pub fn laid(&self) -> impl Iterator<Item = ([f64; 2], f64)> + Clone + '_ {
        self.seats().iter().map(|seat| (seat.at, seat.recess))
    }
}
