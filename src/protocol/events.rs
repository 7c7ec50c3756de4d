//! A wall falls in parts: the first stone, a part of its weight, most of it.
//!
//! A stone that slips out does not bring the wall down. When a part has fallen the test goes on with what is left: the wall without
//! these stones is taken along the load path from its beginning, and what falls at a lower load than the part before falls with it.

use crate::model::{Level, Outcome, Support, Wall};
use crate::protocol::Run;
use crate::protocol::observe::movable;

/// What of a wall has fallen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Event {
    /// The first stone.
    FirstStone,
    /// A part of the weight.
    Part,
    /// Most of the weight.
    Most,
}

impl Event {
    /// Name in files.
    pub fn name(self) -> &'static str {
        match self {
            Event::FirstStone => "first_stone",
            Event::Part => "part",
            Event::Most => "most",
        }
    }

    /// What has come about, in a sentence on a wall.
    pub fn words(self) -> &'static str {
        match self {
            Event::FirstStone => "its first stone has fallen",
            Event::Part => "a part of its weight has fallen",
            Event::Most => "most of its weight has fallen",
        }
    }
}

/// Which shares of a wall's weight are looked at, and which of them is its capacity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EventShares {
    /// Share of the weight of all stones that can move at which a part has fallen, above 0; default a tenth.
    pub part: f64,
    /// The same for most of the wall, not below `part`; default a half.
    pub most: f64,
    /// Whose load is the capacity of the wall; default that of most of it.
    pub capacity: Event,
}

impl Default for EventShares {
    fn default() -> Self {
        EventShares { part: 0.1, most: 0.5, capacity: Event::Most }
    }
}

/// The loads at which the events came, the last one borne before each; `None` where one did not come.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Events {
    /// The first stone fell.
    pub first_stone: Option<Level>,
    /// A part had fallen.
    pub part: Option<Level>,
    /// Most had fallen.
    pub most: Option<Level>,
}

impl Events {
    /// The load of an event.
    pub fn of(&self, event: Event) -> Option<Level> {
        match event {
            Event::FirstStone => self.first_stone,
            Event::Part => self.part,
            Event::Most => self.most,
        }
    }

    /// A share of the weight has fallen at a load.
    fn reach(&mut self, share: f64, at: Level, shares: &EventShares) {
        // A millionth for the rounding of sums of weights.
        let reached = |wanted: f64| share >= wanted * (1.0 - 1e-6);
        self.first_stone.get_or_insert(at);
        if reached(shares.part) {
            self.part.get_or_insert(at);
        }
        if reached(shares.most) {
            self.most.get_or_insert(at);
        }
    }
}

/// Takes a wall along its load path until the event that is its capacity; `run` takes what is left of it, `none` being the load
/// at the beginning of the path.
pub fn in_parts(wall: &Wall, shares: &EventShares, none: Level, run: impl Fn(&Wall) -> Run) -> Run {
    let weight = |wall: &Wall| movable(wall).map(|(_, stone)| stone.mass()).fold(0.0, |sum, w| sum + w);
    let all = weight(wall);
    let (mut left, mut events) = (wall.clone(), Events::default());
    let mut seen: Option<Run> = None;
    loop {
        let next = run(&left);
        let next = match seen {
            Some(before) => after(before, next, none),
            None => next,
        };
        let moving = next.failure.as_ref().map(|failure| failure.moving.clone()).unwrap_or_default();
        let at = match next.outcome {
            Outcome::Collapsed { at } => at,
            Outcome::UnstableAtRest => none,
            _ => return Run { events, ..next },
        };
        moving.iter().for_each(|&id| left.blocks[id as usize].support = Support::Absent);
        let rest = weight(&left);
        // A fall that nobody watched is one of the whole wall.
        let share = if moving.is_empty() { 1.0 } else { 1.0 - rest / all };
        events.reach(share, at, shares);
        if events.of(shares.capacity).is_some() || moving.is_empty() || rest <= 0.0 {
            return Run { events, ..next };
        }
        seen = Some(next);
    }
}

/// What was seen of a wall and then of what was left of it, as one run: what was borne before the first part fell counts.
fn after(before: Run, next: Run, none: Level) -> Run {
    let fell = match before.outcome {
        Outcome::Collapsed { at } => Some(at),
        _ => None,
    };
    let from = fell.unwrap_or(none).value();
    let (outcome, bracket) = match (&next.outcome, fell) {
        // What is left falls no later than the part did: with it.
        (Outcome::Collapsed { at }, Some(first)) if at.value() < first.value() => {
            (Outcome::Collapsed { at: first }, before.bracket)
        }
        (Outcome::UnstableAtRest, Some(first)) => (Outcome::Collapsed { at: first }, before.bracket),
        _ => (next.outcome.clone(), next.bracket),
    };
    let mut steps = before.steps;
    // The last of a wall that fell is the level at which it did.
    steps.pop();
    let went_on: Vec<_> =
        next.steps.iter().filter(|step| steps.is_empty() || step.level.value() > from).cloned().collect();
    match (went_on.is_empty(), next.steps.last()) {
        (true, Some(last)) => steps.push(last.clone()),
        _ => steps.extend(went_on),
    }
    // What is open of the load of the first part is open of all that falls with it.
    Run { outcome, bracket, steps, undecided: before.undecided.or(next.undecided.clone()), ..next }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::radians;

    #[test]
    fn events_come_in_the_order_of_their_shares() {
        let tilt = |deg: f64| Level::Tilt(radians(deg));
        let (mut events, shares) = (Events::default(), EventShares::default());
        events.reach(0.003, tilt(0.0), &shares);
        assert_eq!(events, Events { first_stone: Some(tilt(0.0)), ..Events::default() });
        events.reach(0.2, tilt(9.0), &shares);
        events.reach(0.3, tilt(10.0), &shares);
        assert_eq!((events.part, events.most), (Some(tilt(9.0)), None));
        events.reach(1.0, tilt(12.0), &shares);
        assert_eq!(
            [Event::FirstStone, Event::Part, Event::Most].map(|e| events.of(e)),
            [0.0, 9.0, 12.0].map(|d| Some(tilt(d)))
        );
        let mut at_once = Events::default();
        at_once.reach(0.5, tilt(3.0), &shares);
        assert_eq!(at_once.most, Some(tilt(3.0)));
    }
}
