//! Exponentials of many numbers at once.
//!
//! The operations of libm's `exp` (FreeBSD's `e_exp.c`) in the same order, so that bits are the same, but without a branch: the
//! compiler works on several numbers at a time.

use std::f64::consts::LOG2_E;

use crate::math::exp;

/// In two parts: of the first whole multiples are exact.
const LN2: [f64; 2] = [0.6931471803691238, 1.9082149292705877e-10];
/// Of Remez, from the lowest power of the square.
const P: [f64; 5] = [
    0.16666666666666602,
    -0.0027777777777015593,
    6.613756321437934e-5,
    -1.6533902205465252e-6,
    4.1381367970572385e-8,
];
/// 1.5 times 2^52: a number that is added to it has its whole part in the last bits of the sum.
const SHIFT: f64 = 6_755_399_441_055_744.0;
/// Below this, half of ln 2 by its leading 32 bits, nothing is reduced.
const REDUCED: f64 = f64::from_bits(0x3fd6_2e43 << 32);

/// Exponential of each, with the bits of [`exp`].
pub fn exp_all(x: &mut [f64]) {
    // Neither lost beside one nor close to what has no number.
    if x.iter().all(|x| (1e-8..=708.0).contains(&x.abs())) {
        x.iter_mut().for_each(|x| *x = usual(*x));
    } else {
        x.iter_mut().for_each(|x| *x = exp(*x));
    }
}

#[inline(always)]
fn usual(x: f64) -> f64 {
    // Towards zero, as from what is nearest.
    let halves = LOG2_E * x + 0.5_f64.copysign(x);
    let nearest = (halves + SHIFT) - SHIFT;
    let back = if nearest.abs() > halves.abs() { 1.0_f64.copysign(x) } else { 0.0 };
    let k = if x.abs() < REDUCED { 0.0 } else { nearest - back };
    let (high, low) = (x - k * LN2[0], k * LN2[1]);
    let rest = high - low;
    let square = rest * rest;
    let polynomial = P[0] + square * (P[1] + square * (P[2] + square * (P[3] + square * P[4])));
    let c = rest - square * polynomial;
    let y = 1.0 + (rest * c / (2.0 - c) - low + high);
    // 2^k by its bits.
    y * f64::from_bits((k + SHIFT).to_bits().wrapping_add(1023) << 52)
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    #[test]
    fn exponentials_have_the_bits_of_one_at_a_time() {
        let mut draws = ChaCha8Rng::seed_from_u64(1);
        let half_of_ln_2 = 0.5 * std::f64::consts::LN_2;
        let mut x: Vec<f64> = Vec::new();
        for scale in [1e-7, 0.1, 0.3466, 1.04, 5.0, 40.0, 708.0] {
            x.extend((0..200_000).map(|_| scale * draws.random_range(-1.0..1.0)));
        }
        // Where the whole part changes, and what is reduced.
        for k in -1021_i32..=1021 {
            let edge = f64::from(2 * k + 1) * half_of_ln_2;
            x.extend((-300_i64..=300).map(|step| f64::from_bits((edge.to_bits() as i64 + step) as u64)));
        }
        let reduced = REDUCED.to_bits() as i64;
        let near = (-(1 << 32)..=(1 << 32)).step_by(1 << 14);
        x.extend(near.map(|step: i64| f64::from_bits((reduced + step) as u64)));
        x.retain(|x| (1e-8..=708.0).contains(&x.abs()));
        let mut all = x.clone();
        exp_all(&mut all);
        for (x, all) in x.iter().zip(&all) {
            assert_eq!(all.to_bits(), exp(*x).to_bits(), "{x:e}");
        }
    }

    #[test]
    fn what_is_unusual_is_taken_one_at_a_time() {
        let unusual =
            [0.0, -0.0, 1e-300, 710.0, -709.0, -746.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 1.0];
        let mut all = unusual;
        exp_all(&mut all);
        for (x, all) in unusual.iter().zip(&all) {
            assert_eq!(all.to_bits(), exp(*x).to_bits(), "{x:e}");
        }
        exp_all(&mut []);
    }
}
