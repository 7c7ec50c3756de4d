//! The harness of all benches: named scenes, their processor time, and their last record on such a machine beside it.
//!
//! A scene is run again and again; the median of its runs counts, by the processor time of the whole program, so that
//! other programs disturb it little. `README.md` beside this folder tells how to run and record.

mod history;
mod machine;

use std::hint::black_box;
use std::io::Write;
use std::path::PathBuf;
use std::thread::available_parallelism;
use std::time::{SystemTime, UNIX_EPOCH};
use std::{env, fs};

use cpu_time::ProcessTime;
use pirca::stats::quantile;

use history::{Dated, History, Row, rows, short, warning, written};

/// So often a scene is run, after a first time that does not count.
const RUNS: usize = 11;
/// A scene that takes long is run until this much processor time (s) is spent on it, and [`LEAST_RUNS`] times at least; one whose
/// first run takes longer is run no second time.
const ENOUGH: f64 = 10.0;
const LEAST_RUNS: usize = 3;
/// What is shorter (s) is repeated within a run: asking the clock takes a microsecond.
const SHORTEST: f64 = 5e-3;

/// The scene that is none of ours: where it has become slower, it is the machine that has.
const YARDSTICK: [&str; 2] = ["machine", "time of a fixed sum of square roots"];

/// A bench while it runs.
pub struct Bench {
    filters: Vec<String>,
    /// Whether times are taken: `cargo test --benches` only asks that every scene runs.
    is_timed: bool,
    is_recorded: bool,
    machine: String,
    processor: String,
    history: History,
    measured: Vec<Row>,
}

impl Bench {
    /// Reads the arguments and the records of such a machine, and measures the machine itself.
    pub fn start() -> Bench {
        let arguments: Vec<String> = env::args().skip(1).collect();
        let has = |name: &str| arguments.iter().any(|argument| argument == name);
        let unknown =
            arguments.iter().find(|a| a.starts_with('-') && !["--bench", "--record"].contains(&a.as_str()));
        assert!(
            unknown.is_none(),
            "unknown option {unknown:?}: there is --record, and parts of scenes' names"
        );
        let cpuinfo = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
        let machine = machine::kind(available_parallelism().map_or(1, usize::from), &cpuinfo);
        let history = History::read(&folder(), &machine).unwrap_or_else(|fault| panic!("{fault}"));
        let mut bench = Bench {
            is_timed: has("--bench"),
            is_recorded: has("--record"),
            filters: arguments.into_iter().filter(|argument| !argument.starts_with('-')).collect(),
            processor: machine::processor(&cpuinfo),
            machine,
            history,
            measured: Vec::new(),
        };
        if bench.is_timed {
            println!("{}, {}; median of processor time, and quartiles", bench.machine, bench.processor);
            let sum = || (0..4_000_000).fold(1.0, |sum: f64, k| (sum + f64::from(k)).sqrt());
            let row = bench.row(YARDSTICK, None, &samples(&mut || (), &mut |()| black_box(sum())));
            bench.keep(row);
        }
        bench
    }

    /// Whether one of a scene's quantities is asked for: what it needs may take long to make.
    pub fn wants(&self, scene: &str, quantities: &[&str]) -> bool {
        let names = quantities.iter().map(|quantity| format!("{scene}, {quantity}"));
        self.filters.is_empty()
            || names.into_iter().any(|name| self.filters.iter().any(|part| name.contains(part)))
    }

    /// Measures a scene, which is named by what is run and what is asked of it: the processor time of a call, or the pieces that are
    /// done in a second where one call does so many. What the call uses up is made anew each time, which does not count.
    pub fn scene<S, R>(
        &mut self,
        name: [&str; 2],
        pieces: Option<u64>,
        mut make: impl FnMut() -> S,
        mut call: impl FnMut(&mut S) -> R,
    ) {
        if !self.wants(name[0], &name[1..]) {
            return;
        }
        if self.is_timed {
            let row = self.row(name, pieces, &samples(&mut make, &mut call));
            self.keep(row);
        } else {
            black_box(call(&mut make()));
            println!("{}, {}: runs", name[0], name[1]);
        }
    }

    fn row(&self, [scene, quantity]: [&str; 2], pieces: Option<u64>, samples: &[f64]) -> Row {
        let value = |time: &f64| pieces.map_or(*time, |pieces| pieces as f64 / time);
        let values: Vec<f64> = samples.iter().map(value).collect();
        let [low, median, high] = [0.25, 0.5, 0.75].map(|p| quantile(&values, p).expect("there are runs"));
        let (scale, unit) = match pieces {
            Some(_) => (1.0, "1/s"),
            None if median < 0.1 => (1e3, "ms"),
            None => (1.0, "s"),
        };
        Row {
            scene: scene.to_owned(),
            quantity: quantity.to_owned(),
            median: median * scale,
            low: low * scale,
            high: high * scale,
            unit: unit.to_owned(),
            runs: samples.len().to_string(),
            processor: self.processor.clone(),
            note: String::new(),
        }
    }

    /// Prints what was measured beside its last record.
    fn keep(&mut self, row: Row) {
        let [median, low, high] = [row.median, row.low, row.high].map(short);
        let beside = match self.history.last(&row) {
            Some(Dated { date, row: before }) => {
                let ratio = row
                    .ratio_to(before)
                    .map_or_else(|| "another unit".to_owned(), |ratio| format!("{ratio:.2}"));
                let loud = if row.is_slower_than(before) { "  SLOWER" } else { "" };
                format!("{ratio} times the cost of {date}{loud}")
            }
            None => "no record".to_owned(),
        };
        println!("{}: {median} {} ({low} to {high}), {beside}", row.name(), row.unit);
        std::io::stdout().flush().expect("standard output is there");
        self.measured.push(row);
    }

    /// Says which scenes have become slower, and writes the record if it was asked for.
    pub fn finish(self) {
        if let Some(warning) = warning(&self.history, &self.measured) {
            println!("\n{warning}");
        }
        if !self.is_recorded || !self.is_timed {
            return;
        }
        let since = SystemTime::now().duration_since(UNIX_EPOCH).expect("it is after 1970");
        let name = format!("{}-{}.csv", machine::date(since.as_secs() / 86_400), self.machine);
        let path = folder().join(&name);
        let there = match fs::read_to_string(&path) {
            Ok(text) => rows(&text).unwrap_or_else(|fault| panic!("{name}: {fault}")),
            Err(_) => Vec::new(),
        };
        fs::write(&path, written(there, &self.measured)).unwrap_or_else(|error| panic!("{name}: {error}"));
        println!("\nrecorded in benches/history/{name}");
    }
}

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("benches/history")
}

/// Processor time (s) of a call, run by run.
fn samples<S, R>(make: &mut impl FnMut() -> S, call: &mut impl FnMut(&mut S) -> R) -> Vec<f64> {
    let mut time = || {
        let mut made = make();
        let start = ProcessTime::now();
        black_box(call(&mut made));
        start.elapsed().as_secs_f64()
    };
    let first = time();
    if first > ENOUGH {
        return vec![first];
    }
    let repeated = (SHORTEST / first).ceil().clamp(1.0, 1e6) as usize;
    let (mut samples, mut spent) = (Vec::new(), 0.0);
    while samples.len() < RUNS && (samples.len() < LEAST_RUNS || spent < ENOUGH) {
        let sum: f64 = (0..repeated).map(|_| time()).sum();
        samples.push(sum / repeated as f64);
        spent += sum;
    }
    samples
}
