//! The standard normal distribution.

use crate::math::{erf, erfc, exp, ln};
use std::f64::consts::FRAC_1_SQRT_2;

/// Density at `z`.
pub fn density(z: f64) -> f64 {
    const ONE_OVER_ROOT_2_PI: f64 = 0.398_942_280_401_432_7;
    ONE_OVER_ROOT_2_PI * exp(-0.5 * z * z)
}

/// Probability of a value up to `z`; keeps its relative accuracy in the lower tail. The upper tail is `cdf(-z)`.
pub fn cdf(z: f64) -> f64 {
    0.5 * erfc(-z * FRAC_1_SQRT_2)
}

/// Probability of a value between `a` and `b`, with `a <= b`, without the cancellation of `cdf(b) - cdf(a)` in the
/// upper tail or across zero.
pub fn between(a: f64, b: f64) -> f64 {
    if a > 0.0 {
        cdf(-a) - cdf(-b)
    } else if b < 0.0 {
        cdf(b) - cdf(a)
    } else {
        0.5 * (erf(b * FRAC_1_SQRT_2) - erf(a * FRAC_1_SQRT_2))
    }
}

/// Inverse CDF of `p` in (0, 1), with about 16 digits: algorithm AS 241, routine PPND16 (Wichura 1988).
pub fn quantile(p: f64) -> f64 {
    crate::check!(p > 0.0 && p < 1.0, "the normal quantile of {p} is not finite");
    let q = p - 0.5;
    if q.abs() <= 0.425 {
        let r = 0.180625 - q * q;
        return q * polynomial(&CENTRE.0, r) / polynomial(&CENTRE.1, r);
    }
    let r = (-ln(if q < 0.0 { p } else { 1.0 - p })).sqrt();
    let z = if r <= 5.0 {
        polynomial(&TAIL.0, r - 1.6) / polynomial(&TAIL.1, r - 1.6)
    } else {
        polynomial(&FAR_TAIL.0, r - 5.0) / polynomial(&FAR_TAIL.1, r - 5.0)
    };
    if q < 0.0 { -z } else { z }
}

/// A numerator and a denominator, constant term first.
type Rational = ([f64; 8], [f64; 8]);

fn polynomial(coefficients: &[f64; 8], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// |p - 0.5| up to 0.425, in 0.425^2 - (p - 0.5)^2.
#[rustfmt::skip]
const CENTRE: Rational = (
    [3.387_132_872_796_366_5, 133.141_667_891_784_38, 1_971.590_950_306_551_3, 13_731.693_765_509_46,
     45_921.953_931_549_87, 67_265.770_927_008_7, 33_430.575_583_588_13, 2_509.080_928_730_122_7],
    [1.0, 42.313_330_701_600_91, 687.187_007_492_057_9, 5_394.196_021_424_751,
     21_213.794_301_586_597, 39_307.895_800_092_71, 28_729.085_735_721_943, 5_226.495_278_852_854],
);

/// Tail probability down to exp(-25), in sqrt(-ln(tail)) - 1.6.
#[rustfmt::skip]
const TAIL: Rational = (
    [1.423_437_110_749_683_5, 4.630_337_846_156_546, 5.769_497_221_460_691, 3.647_848_324_763_204_5,
     1.270_458_252_452_368_4, 0.241_780_725_177_450_6, 0.022_723_844_989_269_184, 7.745_450_142_783_414e-4],
    [1.0, 2.053_191_626_637_759, 1.676_384_830_183_803_8, 0.689_767_334_985_1,
     0.148_103_976_427_480_08, 0.015_198_666_563_616_457, 5.475_938_084_995_345e-4, 1.050_750_071_644_416_9e-9],
);

/// Tail probability below exp(-25), in sqrt(-ln(tail)) - 5.
#[rustfmt::skip]
const FAR_TAIL: Rational = (
    [6.657_904_643_501_104, 5.463_784_911_164_114, 1.784_826_539_917_291_3, 0.296_560_571_828_504_9,
     0.026_532_189_526_576_124, 1.242_660_947_388_078_4e-3, 2.711_555_568_743_487_6e-5, 2.010_334_399_292_288_1e-7],
    [1.0, 0.599_832_206_555_888, 0.136_929_880_922_735_8, 0.014_875_361_290_850_615,
     7.868_691_311_456_133e-4, 1.846_318_317_510_054_8e-5, 1.421_511_758_316_446e-7, 2.044_263_103_389_939_8e-15],
);
