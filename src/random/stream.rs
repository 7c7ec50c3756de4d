//! Random streams: ChaCha with 12 rounds, keyed by seed and member, one numbered stream per name of a quantity.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha12Rng;
use sha2::{Digest, Sha256};

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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Streams {
    /// Seed of the study.
    pub seed: u64,
    /// Index of the member.
    pub member: u64,
}

/// One stream of independent uniforms; a clone continues from the same place.
#[derive(Clone, Debug)]
pub struct Stream(ChaCha12Rng);

impl Streams {
    /// The streams of a member.
    pub fn new(seed: u64, member: u64) -> Self {
        Streams { seed, member }
    }

    /// The stream of a named quantity, from its beginning.
    ///
    /// The 256-bit key is the domain, the seed and the member (little-endian); the 64-bit stream number is the first
    /// eight bytes (little-endian) of the SHA-256 of the name.
    pub fn of(&self, quantity: &str) -> Stream {
        let mut key = [0_u8; 32];
        key[..16].copy_from_slice(DOMAIN);
        key[16..24].copy_from_slice(&self.seed.to_le_bytes());
        key[24..].copy_from_slice(&self.member.to_le_bytes());
        let mut number = [0_u8; 8];
        number.copy_from_slice(&Sha256::digest(quantity.as_bytes())[..8]);
        let mut generator = ChaCha12Rng::from_seed(key);
        generator.set_stream(u64::from_le_bytes(number));
        Stream(generator)
    }
}

impl Stream {
    /// A uniform in the open interval (0, 1): the middle of one of 2^52 equal cells.
    ///
    /// Neither end can come out, so every inverse CDF is finite; `1.0 - u` is exact and just as likely as `u`.
    pub fn uniform(&mut self) -> f64 {
        const CELL: f64 = 1.0 / (1_u64 << 52) as f64;
        ((self.0.next_u64() >> 12) as f64 + 0.5) * CELL
    }

    /// A whole number from 0 to `n - 1`, each exactly as likely (Lemire 2019: multiply, and reject the few numbers
    /// that would favour some results).
    ///
    /// `n` must not be 0: there is no number below it.
    pub fn below(&mut self, n: usize) -> usize {
        crate::check!(n > 0, "no whole number lies below 0");
        let n = n as u64;
        let favoured = n.wrapping_neg() % n;
        loop {
            let product = u128::from(self.0.next_u64()) * u128::from(n);
            if product as u64 >= favoured {
                return (product >> 64) as usize;
            }
        }
    }
}
