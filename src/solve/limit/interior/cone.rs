//! The cones of the interior-point method and their Nesterov-Todd scaling: `|(u_1, u_2)| <= u_0`, and `u >= 0`.
//!
//! For `s` and `z` inside a cone there is one scaling `W` with `W z = W^-1 s`, which is called `lambda` (Nesterov and Todd
//! 1997; formulas as in Vandenberghe 2010, "The CVXOPT linear and quadratic cone program solvers", sections 4 and 5).

/// Force or velocity at a contact point: along the normal and the two axes of the joint.
pub(super) type Triple = [f64; 3];

pub(super) fn dot(a: Triple, b: Triple) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// `u` with its last two components turned round.
fn mirrored([u0, u1, u2]: Triple) -> Triple {
    [u0, -u1, -u2]
}

/// By how much `u` lies inside the cone: negative outside.
pub(super) fn depth([u0, u1, u2]: Triple) -> f64 {
    u0 - (u1 * u1 + u2 * u2).sqrt()
}

/// `u_0^2 - u_1^2 - u_2^2`, as a product that does not cancel.
fn determinant(u: Triple) -> f64 {
    let rim = (u[1] * u[1] + u[2] * u[2]).sqrt();
    (u[0] - rim) * (u[0] + rim)
}

/// The scaling of a second-order cone.
#[derive(Clone, Copy, Debug)]
pub(super) struct Second {
    eta: f64,
    /// `W^2 = eta^2 (2 w w' - J)`.
    pub w: Triple,
    /// `W = eta (2 v v' - J)`.
    v: Triple,
    pub lambda: Triple,
}

impl Second {
    /// The scaling that does nothing.
    pub const UNIT: Second =
        Second { eta: 1.0, w: [1.0, 0.0, 0.0], v: [1.0, 0.0, 0.0], lambda: [1.0, 0.0, 0.0] };

    /// The scaling of two vectors; `None` unless both lie inside the cone.
    pub fn of(s: Triple, z: Triple) -> Option<Second> {
        let (of_s, of_z) = (determinant(s), determinant(z));
        if !(of_s > 0.0 && of_z > 0.0 && s[0] > 0.0 && z[0] > 0.0) {
            return None;
        }
        let (size_s, size_z) = (of_s.sqrt(), of_z.sqrt());
        let (s, z) = (s.map(|x| x / size_s), z.map(|x| x / size_z));
        let gamma = (0.5 * (1.0 + dot(s, z))).sqrt();
        let mirror = mirrored(z);
        let mut w: Triple = std::array::from_fn(|k| 0.5 * (s[k] + mirror[k]) / gamma);
        // On the unit hyperboloid but for rounding.
        w[0] = (1.0 + w[1] * w[1] + w[2] * w[2]).sqrt();
        let root = (2.0 * (w[0] + 1.0)).sqrt();
        let v = [(w[0] + 1.0) / root, w[1] / root, w[2] / root];
        let mut scaling = Second { eta: (size_s / size_z).sqrt(), w, v, lambda: [0.0; 3] };
        scaling.lambda = scaling.scale(z.map(|x| x * size_z));
        Some(scaling)
    }

    /// `W u`.
    pub fn scale(&self, u: Triple) -> Triple {
        let (along, mirror) = (2.0 * dot(self.v, u), mirrored(u));
        std::array::from_fn(|k| self.eta * (along * self.v[k] - mirror[k]))
    }

    /// `W^-1 u`.
    pub fn unscale(&self, u: Triple) -> Triple {
        let (v, mirror) = (mirrored(self.v), mirrored(u));
        let along = 2.0 * dot(v, u);
        std::array::from_fn(|k| (along * v[k] - mirror[k]) / self.eta)
    }

    /// `W^2`.
    pub fn squared(&self) -> [Triple; 3] {
        let (w, square) = (self.w, self.eta * self.eta);
        let entry = |i: usize, j: usize| {
            let mirror = if i != j {
                0.0
            } else if i == 0 {
                1.0
            } else {
                -1.0
            };
            square * (2.0 * w[i] * w[j] - mirror)
        };
        std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
    }

    /// The inverse of the last two rows and columns of `W^-2`.
    pub fn sliding(&self) -> [[f64; 2]; 2] {
        let (w, square) = (self.w, self.eta * self.eta);
        let bend = 2.0 / (2.0 * w[0] * w[0] - 1.0);
        let entry =
            |i: usize, j: usize| square * (if i == j { 1.0 } else { 0.0 } - bend * w[1 + i] * w[1 + j]);
        std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
    }

    /// `W^-2 u` by its last two components: the first one is `first u_0 + rest . (W^-2 u)_(1, 2)`; gives `first` and `rest`.
    pub fn first_by_rest(&self) -> (f64, [f64; 2]) {
        let (w, size) = (self.w, 2.0 * self.w[0] * self.w[0] - 1.0);
        let share = -2.0 * w[0] / size;
        (1.0 / (self.eta * self.eta * size), [share * w[1], share * w[2]])
    }

    /// The largest step along a scaled direction that stays in the cone.
    pub fn largest_step(&self, direction: Triple) -> f64 {
        let size = determinant(self.lambda).max(f64::MIN_POSITIVE).sqrt();
        let l = self.lambda.map(|x| x / size);
        let first = dot(mirrored(l), direction);
        let share = (first + direction[0]) / (l[0] + 1.0);
        let [r1, r2] = [direction[1] - share * l[1], direction[2] - share * l[2]];
        size / ((r1 * r1 + r2 * r2).sqrt() - first).max(f64::MIN_POSITIVE)
    }
}

/// The product of the cone's algebra.
pub(super) fn product(a: Triple, b: Triple) -> Triple {
    [dot(a, b), a[0] * b[1] + b[0] * a[1], a[0] * b[2] + b[0] * a[2]]
}

/// `x` with `lambda o x = r`.
pub(super) fn quotient(r: Triple, lambda: Triple) -> Triple {
    let [l0, l1, l2] = lambda;
    let x0 = (l0 * r[0] - l1 * r[1] - l2 * r[2]) / determinant(lambda).max(f64::MIN_POSITIVE);
    [x0, (r[1] - x0 * l1) / l0, (r[2] - x0 * l2) / l0]
}

#[cfg(test)]
mod tests {
    use super::*;

    const S: Triple = [2.0, 0.3, -1.1];
    const Z: Triple = [0.7, -0.5, 0.2];

    fn close(a: Triple, b: Triple) {
        // Sums of a few products of numbers near 1.
        assert!((0..3).all(|k| (a[k] - b[k]).abs() < 1e-13), "{a:?} {b:?}");
    }

    #[test]
    fn the_scaling_takes_both_to_the_same_point_and_its_inverses_take_back() {
        let w = Second::of(S, Z).unwrap();
        close(w.scale(Z), w.lambda);
        close(w.unscale(S), w.lambda);
        close(w.unscale(w.scale(Z)), Z);
        let twice = |u| w.unscale(w.unscale(u));
        close(twice(S), Z);
        let square = w.squared();
        close([dot(square[0], Z), dot(square[1], Z), dot(square[2], Z)], S);
        // W^-2 of a sliding vector, its last two components, and back.
        let [_, a, b] = twice([0.0, 0.4, -0.9]);
        let back = w.sliding().map(|row| row[0] * a + row[1] * b);
        close([0.0, back[0], back[1]], [0.0, 0.4, -0.9]);
        let (first, rest) = w.first_by_rest();
        assert!((first * S[0] + rest[0] * Z[1] + rest[1] * Z[2] - Z[0]).abs() < 1e-13);
        assert!(Second::of([1.0, 1.0, 0.0], Z).is_none(), "on the rim");
    }

    #[test]
    fn the_largest_step_ends_on_the_rim() {
        let w = Second::of(S, Z).unwrap();
        let direction = [-0.4, 0.9, 0.1];
        let step = w.largest_step(direction);
        let end = std::array::from_fn(|k| w.lambda[k] + step * direction[k]);
        assert!(depth(end).abs() < 1e-13, "{}", depth(end));
        assert!(w.largest_step([1.0, 0.5, 0.5]) > 1e300, "a direction of the cone has no end");
        close(product(w.lambda, quotient(direction, w.lambda)), direction);
    }
}
