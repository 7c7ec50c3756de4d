//! Random streams: ChaCha with 12 rounds, keyed by seed and member, one numbered stream per name of a quantity.

use std::sync::Arc;

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha12Rng;
use sha2::{Digest, Sha256};

use crate::random::standard_normal::{cdf, quantile};

/// First half of every key. It keeps our streams apart from other uses of the same generator; changing it changes
/// every wall that was ever generated.
const DOMAIN: &[u8; 16] = b"pirca streams v1";

/// All streams of one member of an ensemble.
///
/// A stream is keyed by (seed, member, name of the quantity) and by nothing else: neither the order in which streams
/// are asked for nor what is drawn from the others has any effect. So two studies that differ in one quantity share
/// all other random numbers.
///
/// ```
/// use pirca::random::Streams;
/// let streams = Streams::new(1, 0);
/// let first = streams.of("stone length").uniform();
/// streams.of("bed dip").uniform();
/// assert_eq!(first, streams.of("stone length").uniform());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Streams {
    /// Seed of the study.
    pub seed: u64,
    /// Index of the member.
    pub member: u64,
    /// What its numbers were moved by since they were drawn.
    pub moves: Arc<[Move]>,
    /// First uniforms that a design sets, by quantity; see [`Design`](crate::random::Design).
    pub placed: Arc<[(&'static str, f64)]>,
    /// Numbers that are another member's.
    pub taken: Option<Arc<Taken>>,
}

/// Quantities of which a member has the numbers of another one, for pick-freeze estimates; see
/// [`sensitivity`](crate::stats::sensitivity).
#[derive(Clone, Debug, PartialEq)]
pub struct Taken {
    /// Which quantities.
    pub quantities: Quantities,
    /// The streams of the other member.
    pub from: Streams,
}

/// Quantities by how their names begin. A name belongs to the beginning if it is that, or goes on with a blank.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Quantities {
    /// How their names begin.
    pub beginnings: Vec<String>,
    /// Whether all quantities are meant but these.
    pub others: bool,
}

impl Quantities {
    /// Whether the quantity of that name is one of them.
    ///
    /// ```
    /// use pirca::random::Quantities;
    /// let dips = Quantities { beginnings: vec!["bed dip".to_owned()], others: false };
    /// assert!(dips.contains("bed dip 3") && !dips.contains("bed dips") && !dips.contains("density 3"));
    /// assert!(Quantities { others: true, ..dips }.contains("density 3"));
    /// ```
    pub fn contains(&self, quantity: &str) -> bool {
        let begins = |own: &String| {
            quantity.strip_prefix(own.as_str()).is_some_and(|rest| rest.is_empty() || rest.starts_with(' '))
        };
        self.beginnings.iter().any(begins) != self.others
    }
}

/// A move of the numbers of a member: some of them, as standard normals, keep a share of what they were and take the rest from the same
/// place of another member's streams. The numbers stay distributed as they were drawn, so that moves make a Markov chain of walls, each
/// a pure function of its seed, its member and its moves (conditional sampling, see [`subset`](crate::stats::subset)).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move {
    /// Seed and member of the other streams.
    pub from: [u64; 2],
    /// The share kept, 0 to 1.
    pub keep: f64,
    /// Share of the numbers that are moved, by draws of the other streams.
    pub moved: f64,
}

/// One stream of independent uniforms; a clone continues from the same place.
#[derive(Clone, Debug)]
pub struct Stream {
    generator: ChaCha12Rng,
    /// What the first uniform is set to.
    placed: Option<f64>,
    /// Those that it was moved by, in their order.
    moves: Vec<(Move, ChaCha12Rng)>,
}

impl Streams {
    /// The streams of a member.
    pub fn new(seed: u64, member: u64) -> Self {
        Streams { seed, member, moves: Arc::default(), placed: Arc::default(), taken: None }
    }

    /// The streams with the first uniforms of quantities set, each in (0, 1).
    pub fn placed(self, placed: Arc<[(&'static str, f64)]>) -> Self {
        Streams { placed, ..self }
    }

    /// The streams with the numbers of some quantities taken from others.
    pub fn taking(self, taken: Taken) -> Self {
        Streams { taken: Some(Arc::new(taken)), ..self }
    }

    /// The streams after moves, the first one first.
    pub fn after(self, moves: Arc<[Move]>) -> Self {
        Streams { moves, ..self }
    }

    /// The stream of a named quantity, from its beginning.
    ///
    /// The 256-bit key is the domain, the seed and the member (little-endian); the 64-bit stream number is the first
    /// eight bytes (little-endian) of the SHA-256 of the name.
    pub fn of(&self, quantity: &str) -> Stream {
        if let Some(taken) = self.taken.as_ref().filter(|taken| taken.quantities.contains(quantity)) {
            return taken.from.of(quantity);
        }
        let mut number = [0_u8; 8];
        number.copy_from_slice(&Sha256::digest(quantity.as_bytes())[..8]);
        let keyed = |[seed, member]: [u64; 2]| {
            let mut key = [0_u8; 32];
            key[..16].copy_from_slice(DOMAIN);
            key[16..24].copy_from_slice(&seed.to_le_bytes());
            key[24..].copy_from_slice(&member.to_le_bytes());
            let mut generator = ChaCha12Rng::from_seed(key);
            generator.set_stream(u64::from_le_bytes(number));
            generator
        };
        Stream {
            generator: keyed([self.seed, self.member]),
            placed: self.placed.iter().find(|(name, _)| *name == quantity).map(|(_, uniform)| *uniform),
            moves: self.moves.iter().map(|own| (*own, keyed(own.from))).collect(),
        }
    }
}

/// Width of the cells that uniforms are the middles of.
const CELL: f64 = 1.0 / (1_u64 << 52) as f64;

fn uniform(generator: &mut ChaCha12Rng) -> f64 {
    ((generator.next_u64() >> 12) as f64 + 0.5) * CELL
}

impl Stream {
    /// A uniform in the open interval (0, 1): the middle of one of 2^52 equal cells.
    ///
    /// Neither end can come out, so every inverse CDF is finite; `1.0 - u` is exact and just as likely as `u`.
    pub fn uniform(&mut self) -> f64 {
        // The generator goes on where the uniform is set, so that the second one is the same in every design.
        let drawn = uniform(&mut self.generator);
        let drawn = self.placed.take().unwrap_or(drawn);
        self.moved(drawn)
    }

    /// A uniform after the moves; it is what it was to the bit where none moves it.
    fn moved(&mut self, drawn: f64) -> f64 {
        let mut score = None;
        for (own, generator) in &mut self.moves {
            let [chosen, other] = [0; 2].map(|_| uniform(generator));
            if chosen < own.moved {
                let before = score.unwrap_or_else(|| quantile(drawn));
                score =
                    Some(own.keep * before + (1.0 - own.keep * own.keep).max(0.0).sqrt() * quantile(other));
            }
        }
        // Neither end can come out.
        score.map_or(drawn, |score| cdf(score).clamp(0.5 * CELL, 1.0 - 0.5 * CELL))
    }

    /// A whole number from 0 to `n - 1`, each exactly as likely (Lemire 2019: multiply, and reject the few numbers
    /// that would favour some results).
    ///
    /// `n` must not be 0: there is no number below it.
    pub fn below(&mut self, n: usize) -> usize {
        crate::check!(n > 0, "no whole number lies below 0");
        if !self.moves.is_empty() {
            // The same number as below, but for one in 2^52.
            return ((self.uniform() * n as f64) as usize).min(n - 1);
        }
        let n = n as u64;
        let favoured = n.wrapping_neg() % n;
        loop {
            let product = u128::from(self.generator.next_u64()) * u128::from(n);
            if product as u64 >= favoured {
                return (product >> 64) as usize;
            }
        }
    }
}
