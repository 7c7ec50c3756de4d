//! What is seen of one long piece of work that has no members to count: what is being done, and for how long.

use std::sync::{Condvar, Mutex, MutexGuard};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::model::Level;
use crate::terminal::output;

/// Work that ends sooner says nothing.
const FIRST: Duration = Duration::from_secs(2);
/// Where lines are written each waits twice as long as the one before, at most this.
const LONGEST: Duration = Duration::from_secs(60);
/// How often a terminal is drawn.
const TICK: Duration = Duration::from_millis(500);

/// What is being done; the work itself may say how far it is.
pub(crate) struct Doing {
    what: String,
    state: Mutex<State>,
    over: Condvar,
}

#[derive(Default)]
struct State {
    far: String,
    ended: bool,
}

/// Does some work; from the second second on standard error says what it is, how far it is and for how long: a line that is drawn
/// anew on a terminal, lines elsewhere.
pub(crate) fn doing<T>(what: &str, work: impl FnOnce(&Doing) -> T) -> T {
    let doing = Doing { what: what.to_owned(), state: Mutex::new(State::default()), over: Condvar::new() };
    std::thread::scope(|scope| {
        scope.spawn(|| doing.show());
        // Also where the work panics: the scope waits for its threads.
        let _ended = Ended(&doing);
        work(&doing)
    })
}

struct Ended<'d>(&'d Doing);

impl Drop for Ended<'_> {
    fn drop(&mut self) {
        self.0.lock().ended = true;
        self.0.over.notify_all();
    }
}

impl Doing {
    /// How far the work is: "at a tilt of 12.5 deg".
    pub fn say(&self, far: String) {
        self.lock().far = far;
    }

    /// That a level of its load has been borne.
    pub fn at(&self, level: Level) {
        self.say(format!("at {level}"));
    }

    fn show(&self) {
        let begun = Instant::now();
        if self.ends_within(FIRST) {
            return;
        }
        match output::can_draw() {
            true => self.draw(begun),
            false => self.write(begun),
        }
    }

    /// A line on the terminal, which goes when the work has ended.
    fn draw(&self, begun: Instant) {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
        bar.set_style(
            ProgressStyle::with_template("{wide_msg}").unwrap_or_else(|_| ProgressStyle::default_bar()),
        );
        loop {
            bar.set_message(self.line(begun));
            if self.ends_within(TICK) {
                return bar.finish_and_clear();
            }
        }
    }

    fn write(&self, begun: Instant) {
        let mut wait = FIRST;
        loop {
            output::note(&self.line(begun));
            if self.ends_within(wait) {
                return;
            }
            wait = (2 * wait).min(LONGEST);
        }
    }

    fn line(&self, begun: Instant) -> String {
        let far = self.lock().far.clone();
        let far = if far.is_empty() { far } else { format!(", {far}") };
        format!("{}{far}: {} s", self.what, begun.elapsed().as_secs())
    }

    /// Waits until the work has ended, but no longer than that.
    fn ends_within(&self, time: Duration) -> bool {
        let waited = self.over.wait_timeout_while(self.lock(), time, |state| !state.ended);
        waited.map_or(true, |(state, _)| state.ended)
    }

    /// A panic of the work must not hide that it has ended.
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_that_panics_does_not_hang() {
        let begun = Instant::now();
        let broken = std::panic::catch_unwind(|| doing::<()>("nothing", |_| panic!("as asked")));
        assert!(broken.is_err());
        assert_eq!(doing("nothing", |doing| doing.line(begun)), "nothing: 0 s");
    }

    #[test]
    fn what_the_work_says_is_shown() {
        let begun = Instant::now();
        let line = doing("solving 72 blocks", |doing| {
            doing.say("at a tilt of 12.5 deg".to_owned());
            doing.line(begun)
        });
        assert_eq!(line, "solving 72 blocks, at a tilt of 12.5 deg: 0 s");
    }
}
