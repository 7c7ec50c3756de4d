//! Random streams (skeleton).

/// All streams of one member.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Streams {
    /// Seed of the study.
    pub seed: u64,
    /// Index of the member.
    pub member: u64,
}

/// One stream of uniforms.
pub struct Stream(rand_chacha::ChaCha12Rng);

impl Streams {
    /// The streams of a member.
    pub fn new(seed: u64, member: u64) -> Self {
        Streams { seed, member }
    }
    /// The stream of a named quantity.
    pub fn of(&self, _quantity: &str) -> Stream {
        unimplemented!()
    }
}

impl Stream {
    /// A uniform in the open interval (0, 1).
    pub fn uniform(&mut self) -> f64 {
        let _ = &self.0;
        unimplemented!()
    }
    /// A whole number below `n`.
    pub fn below(&mut self, _n: usize) -> usize {
        unimplemented!()
    }
}
