//! What is seen of a run while it goes on: a bar on a terminal, a line per tenth elsewhere.

use std::collections::BTreeMap;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::cli::output;
use crate::ensemble::{Grown, Observed, Progress, Quantity, Row, Task};
use crate::study::Study;

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
}

/// A line at the beginning and at every tenth.
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
    tally: Tally,
}

impl Count {
    fn line(&self) -> String {
        let here = (self.done - self.recorded) as f64;
        let left = self.begun.elapsed().as_secs_f64() / here * (self.total - self.done) as f64;
        let Count { total, done, tally, .. } = self;
        format!("{done}/{total} done, {} failed{}, {left:.0} s left", tally.failed, tally.last)
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
        *lock(&self.state) = Some(Count { total, recorded: done, done, begun: Instant::now(), tally });
    }

    fn finished(&self, row: &Row) {
        let mut state = lock(&self.state);
        let Some(count) = state.as_mut() else { return };
        count.tally.take(row);
        let tenth = |done: usize| 10 * done / count.total;
        let passed = tenth(count.done + 1) > tenth(count.done);
        count.done += 1;
        if passed {
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
}

/// A panic of one member while it was shown must not silence the others.
fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
}

/// A line on standard error at every tenth of walls that have no mean to show together: of several mechanisms, or readings.
pub(crate) struct Tenths {
    /// What the walls are simulated for.
    what: &'static str,
    total: AtomicUsize,
    done: AtomicUsize,
}

impl Tenths {
    /// Nothing done yet.
    pub(crate) fn of(what: &'static str) -> Tenths {
        Tenths { what, total: AtomicUsize::new(0), done: AtomicUsize::new(0) }
    }
}

impl Progress for Tenths {
    fn grown(&self, grown: &Grown) {
        output::note(&format!("{}: {grown}", self.what));
    }

    fn begin(&self, total: usize, _recorded: &[&Row]) {
        self.total.store(total, Ordering::Relaxed);
        self.done.store(0, Ordering::Relaxed);
        output::note(&format!("{}: {total} walls", self.what));
    }

    fn finished(&self, _row: &Row) {
        let (total, done) = (self.total.load(Ordering::Relaxed), self.done.fetch_add(1, Ordering::Relaxed));
        if 10 * (done + 1) / total > 10 * done / total {
            output::note(&format!("{}: {}/{total} walls done", self.what, done + 1));
        }
    }

    fn broken(&self, _task: Task) {}

    fn end(&self) {}
}
