//! Discrete Fourier transform of a power of two of samples.

use std::f64::consts::TAU;

use crate::math::{cos, sin};

/// Transforms in place: `X_k = sum over j of x_j exp(-2 pi i j k/n)`, for `n` a power of two (Cooley and Tukey 1965, radix 2).
///
/// Every twiddle factor is computed by itself, so that the error grows with the logarithm of `n` only. Operations have a fixed order.
pub(super) fn transform(re: &mut [f64], im: &mut [f64]) {
    let n = re.len();
    crate::check!(n.is_power_of_two() && im.len() == n, "a transform of {n} samples was asked");
    if n == 1 {
        return;
    }
    let shift = usize::BITS - n.trailing_zeros();
    for k in 0..n {
        let mirrored = k.reverse_bits() >> shift;
        if k < mirrored {
            re.swap(k, mirrored);
            im.swap(k, mirrored);
        }
    }
    let angle = |k: usize| TAU * k as f64 / n as f64;
    let twiddles: Vec<[f64; 2]> = (0..n / 2).map(|k| [cos(angle(k)), -sin(angle(k))]).collect();
    let mut half = 1;
    while half < n {
        let stride = n / (2 * half);
        for first in (0..n).step_by(2 * half) {
            for k in 0..half {
                let [c, s] = twiddles[k * stride];
                let (a, b) = (first + k, first + k + half);
                let (x, y) = (c * re[b] - s * im[b], c * im[b] + s * re[b]);
                (re[b], im[b]) = (re[a] - x, im[a] - y);
                (re[a], im[a]) = (re[a] + x, im[a] + y);
            }
        }
        half *= 2;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_sum_of_its_definition() {
        let n = 16;
        let x: Vec<[f64; 2]> = (0..n).map(|j| [f64::from(j * j % 7) - 2.0, f64::from(j * 5 % 11)]).collect();
        let (mut re, mut im): (Vec<f64>, Vec<f64>) = x.iter().map(|z| (z[0], z[1])).unzip();
        transform(&mut re, &mut im);
        for k in 0..n {
            let (mut a, mut b) = (0.0, 0.0);
            for (j, [p, q]) in x.iter().enumerate() {
                let angle = -TAU * f64::from(k) * j as f64 / f64::from(n);
                a += p * cos(angle) - q * sin(angle);
                b += q * cos(angle) + p * sin(angle);
            }
            // Sums of sixteen numbers of about ten.
            assert!((re[k as usize] - a).abs() < 1e-12 && (im[k as usize] - b).abs() < 1e-12, "{k}");
        }
    }
}
