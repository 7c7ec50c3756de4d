//! What is seen of a run while it goes on: a bar on a terminal, a line per tenth elsewhere.

use std::collections::BTreeMap;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::ensemble::{Grown, Observed, Progress, Quantity, Row, Task};
use crate::study::Study;
use crate::terminal::output;

/// Tables of fewer evaluations are written at once.
const LONG_TABLES: usize = 100_000;
/// Where lines are written, none waits longer than this for the next one.
const LONGEST_SILENCE: Duration = Duration::from_secs(30);

/// A progress on standard error, fit for what standard error is.
pub(crate) fn on_stderr(study: &Study) -> Box<dyn Progress> {
    let name = study.name.clone();
    let quantity = Quantity::of(study);
    match output::can_draw() {
        true => Box::new(Bar { bar: ProgressBar::hidden(), tally: Mutex::new(Tally::new(quantity)) }),
        false => Box::new(Lines { name, quantity, state: Mutex::new(None) }),
    }
}

/// Counts and the running mean of the wall population that the last member belongs to. Only shown: the statistics
/// are computed from the finished table.
struct Tally {
    quantity: Quantity,
    failed: usize,
    /// Walls that bring a value and the sum of these, by arm and point.
    sums: BTreeMap<(u32, u32), (u64, f64)>,
    /// What is said of that population, from the comma on.
    last: String,
}

impl Tally {
    fn new(quantity: Quantity) -> Tally {
        Tally { quantity, failed: 0, sums: BTreeMap::new(), last: String::new() }
    }

    fn take(&mut self, row: &Row) {
        let observed = self.quantity.observed(row);
        if observed == Observed::Nothing {
            self.failed += 1;
        }
        if let Observed::Value(value) = observed {
            let (n, sum) = self.sums.entry((row.arm_index, row.point)).or_default();
            *n += 1;
            *sum += value;
            let (mean, unit) = (self.quantity.shown(*sum / *n as f64), self.quantity.shown_unit());
            self.last = format!(", mean {mean:.4} {unit} ({n} {} at kn {:.2e})", row.arm, row.kn_pa_per_m);
        }
    }
}

/// A bar with done, failed, running mean and the time that is left.
struct Bar {
    bar: ProgressBar,
    tally: Mutex<Tally>,
}

impl Bar {
    fn show(&self, tally: &Tally) {
        self.bar.set_message(format!("{} failed{}", tally.failed, tally.last));
    }
}

impl Progress for Bar {
    fn grown(&self, grown: &Grown) {
        output::note(&grown.to_string());
    }

    fn begin(&self, total: usize, recorded: &[&Row]) {
        let style = ProgressStyle::with_template("{bar:12} {pos}/{len} done, ETA {eta}, {wide_msg}");
        self.bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        self.bar.set_length(total as u64);
        self.bar.set_position(recorded.len() as u64);
        self.bar.reset_eta();
        let mut tally = lock(&self.tally);
        recorded.iter().for_each(|row| tally.take(row));
        self.show(&tally);
        self.bar.set_draw_target(ProgressDrawTarget::stderr());
        self.bar.enable_steady_tick(Duration::from_millis(500));
    }

    fn finished(&self, row: &Row) {
        let mut tally = lock(&self.tally);
        tally.take(row);
        self.show(&tally);
        self.bar.inc(1);
    }

    fn broken(&self, _task: Task) {
        let mut tally = lock(&self.tally);
        tally.failed += 1;
        self.show(&tally);
    }

    fn end(&self) {
        self.bar.abandon();
    }

    fn writes(&self, evaluations: usize) {
        say_writes("", evaluations);
    }
}

/// Says that tables are written, where that takes long.
fn say_writes(name: &str, evaluations: usize) {
    if evaluations >= LONG_TABLES {
        output::note(&format!("{name}writing the tables of {evaluations} evaluations"));
    }
}

/// A time that is left, in words: seconds, minutes or hours.
fn left(seconds: f64) -> String {
    match seconds {
        ..=120.0 => format!("{seconds:.0} s left"),
        ..=7200.0 => format!("{:.0} min left", seconds / 60.0),
        _ => format!("{:.1} h left", seconds / 3600.0),
    }
}

/// So many of a total are done since then, of which some were done before: the time that is left, in words.
fn left_of(begun: Instant, [before, done, total]: [usize; 3]) -> String {
    let here = done.saturating_sub(before).max(1) as f64;
    left(begun.elapsed().as_secs_f64() / here * total.saturating_sub(done) as f64)
}

/// A line at the beginning, at every tenth, and when the last one is half a minute old.
struct Lines {
    name: String,
    quantity: Quantity,
    state: Mutex<Option<Count>>,
}

struct Count {
    total: usize,
    recorded: usize,
    done: usize,
    begun: Instant,
    /// When the last line was written.
    said: Instant,
    tally: Tally,
}

impl Count {
    fn line(&self) -> String {
        let Count { total, recorded, done, begun, tally, .. } = self;
        let left = left_of(*begun, [*recorded, *done, *total]);
        format!("{done}/{total} done, {} failed{}, {left}", tally.failed, tally.last)
    }
}

impl Progress for Lines {
    fn grown(&self, grown: &Grown) {
        output::note(&format!("{}: {grown}", self.name));
    }

    fn begin(&self, total: usize, recorded: &[&Row]) {
        let mut tally = Tally::new(self.quantity);
        recorded.iter().for_each(|row| tally.take(row));
        let done = recorded.len();
        output::note(&format!("{}: {total} evaluations, {done} of them recorded before", self.name));
        let now = Instant::now();
        *lock(&self.state) = Some(Count { total, recorded: done, done, begun: now, said: now, tally });
    }

    fn finished(&self, row: &Row) {
        let mut state = lock(&self.state);
        let Some(count) = state.as_mut() else { return };
        count.tally.take(row);
        let tenth = |done: usize| 10 * done / count.total;
        let passed = tenth(count.done + 1) > tenth(count.done);
        count.done += 1;
        if passed || count.said.elapsed() >= LONGEST_SILENCE {
            count.said = Instant::now();
            output::note(&format!("{}: {}", self.name, count.line()));
        }
    }

    fn broken(&self, task: Task) {
        if let Some(count) = lock(&self.state).as_mut() {
            count.tally.failed += 1;
        }
        output::note(&format!("{}: member {} broke an invariant", self.name, task.member));
    }

    fn end(&self) {}

    fn writes(&self, evaluations: usize) {
        say_writes(&format!("{}: ", self.name), evaluations);
    }
}

/// A panic of one member while it was shown must not silence the others.
fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
}

/// A line on standard error at every tenth of walls that have no mean to show together, of several mechanisms, or readings, and when the
/// last line is half a minute old.
pub(crate) struct Tenths {
    /// What the walls are simulated for.
    what: &'static str,
    state: Mutex<Tenth>,
}

/// How far they are.
struct Tenth {
    total: usize,
    recorded: usize,
    done: usize,
    begun: Instant,
    said: Instant,
}

impl Tenths {
    /// Nothing done yet.
    pub(crate) fn of(what: &'static str) -> Tenths {
        let now = Instant::now();
        Tenths { what, state: Mutex::new(Tenth { total: 0, recorded: 0, done: 0, begun: now, said: now }) }
    }
}

impl Progress for Tenths {
    fn grown(&self, grown: &Grown) {
        output::note(&format!("{}: {grown}", self.what));
    }

    fn begin(&self, total: usize, recorded: &[&Row]) {
        let (done, now) = (recorded.len(), Instant::now());
        *lock(&self.state) = Tenth { total, recorded: done, done, begun: now, said: now };
        let before = if done > 0 { format!(", {done} of them recorded before") } else { String::new() };
        output::note(&format!("{}: {total} walls{before}", self.what));
    }

    fn finished(&self, _row: &Row) {
        let mut state = lock(&self.state);
        state.done += 1;
        let Tenth { total, recorded, done, begun, said } = *state;
        if 10 * done / total > 10 * (done - 1) / total || said.elapsed() >= LONGEST_SILENCE {
            state.said = Instant::now();
            let left = left_of(begun, [recorded, done, total]);
            output::note(&format!("{}: {done}/{total} walls done, {left}", self.what));
        }
    }

    fn broken(&self, _task: Task) {}

    fn end(&self) {}
}

/// A line on standard error at every 500 walls of a number that is not known beforehand, and when the last line is half a minute old.
pub(crate) struct Spent {
    name: String,
    /// Most walls.
    budget: u64,
    begun: Instant,
    /// Walls, and when the last line was written.
    state: Mutex<(usize, Instant)>,
}

/// Walls between two lines.
const STRIDE: usize = 500;

impl Spent {
    /// Nothing done yet.
    pub(crate) fn of(name: &str, budget: u64) -> Spent {
        let now = Instant::now();
        Spent { name: name.to_owned(), budget, begun: now, state: Mutex::new((0, now)) }
    }

    /// So many more are done.
    pub(crate) fn tell(&self, more: usize) {
        let mut state = lock(&self.state);
        let before = state.0;
        state.0 += more;
        if state.0 / STRIDE > before / STRIDE || state.1.elapsed() >= LONGEST_SILENCE {
            state.1 = Instant::now();
            let seconds = self.begun.elapsed().as_secs();
            let Spent { name, budget, .. } = self;
            output::note(&format!("{name}: {} of at most {budget} walls evaluated, {seconds} s", state.0));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_time_that_is_left_is_said_in_fitting_units() {
        for (seconds, words) in
            [(0.4, "0 s left"), (119.6, "120 s left"), (121.0, "2 min left"), (7201.0, "2.0 h left")]
        {
            assert_eq!(left(seconds), words);
        }
        let begun = Instant::now() - Duration::from_secs(60);
        // 60 s for 20 of them, and 38 are left.
        assert_eq!(left_of(begun, [10, 30, 68]), "114 s left");
    }
}
