//! Designs of experiments: where the uniforms of a few quantities lie, member by member.
//!
//! Members share [`RANDOMISATIONS`] independent randomisations of a design in turn. An estimate from one randomisation knows
//! nothing of the others, so that their differences are its error; points of one design are not independent of each other.

use crate::random::Streams;

/// Independent randomisations of a design: member m belongs to the one of number m mod 16.
pub const RANDOMISATIONS: u64 = 16;
/// From here on, members are partners: m + PARTNER is the other half of the point that m has in twice as many dimensions. No
/// ensemble has so many members.
pub const PARTNER: u64 = 1 << 56;
/// Members that randomisations draw their numbers as.
const FIRST_RANDOMISATION: u64 = 1 << 60;
/// Cells of a coordinate of the Sobol sequence, which comes with 24 bits.
const CELLS: f64 = (1_u64 << 24) as f64;

/// How the uniforms of a few quantities cover their space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Design {
    /// Independent of each other.
    #[default]
    Plain,
    /// Latin hypercubes (McKay, Beckman and Conover 1979): of n points, each of n equal strata of every quantity holds one.
    LatinHypercube,
    /// The Sobol sequence with Owen's scrambling, hashed as by Burley (2020).
    Sobol,
}

/// The place of a member in a design.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// Seed of the study.
    pub seed: u64,
    /// The member, or a partner.
    pub member: u64,
    /// Points of each randomisation, at least 1.
    pub points: u64,
}

impl Design {
    /// Most points that a randomisation may have.
    pub const MOST_POINTS: u64 = 1 << 16;

    /// The uniform in (0, 1) of a quantity; `None` where the design sets none.
    ///
    /// It depends on nothing but the place, the quantity and its number, so that another quantity changes nothing. The
    /// quantity's own stream says where in its cell the uniform lies.
    pub fn uniform(self, place: Place, quantity: &str, number: u32) -> Option<f64> {
        let (own, is_partner) = match place.member.checked_sub(PARTNER) {
            Some(own) => (own, true),
            None => (place.member, false),
        };
        let (randomisation, point) = (own % RANDOMISATIONS, own / RANDOMISATIONS);
        let streams = Streams::new(place.seed, FIRST_RANDOMISATION + randomisation);
        let [cell, cells] = match self {
            Design::Plain => return None,
            Design::LatinHypercube => {
                let half = if is_partner { "partner" } else { "own" };
                let mut order = streams.of(&format!("latin hypercube {half} {quantity}"));
                let count = place.points as usize;
                let mut strata: Vec<usize> = (0..count).collect();
                (0..count).for_each(|k| strata.swap(k, k + order.below(count - k)));
                [strata[point as usize % count] as f64, place.points as f64]
            }
            Design::Sobol => {
                let seed = streams.of("sobol scrambling").below(1 << 32) as u32;
                // A member and its partner take turns: the first dimensions fill their space best.
                let dimension = (2 * number + u32::from(is_partner)) % sobol_burley::NUM_DIMENSIONS;
                let point = (point % Design::MOST_POINTS) as u32;
                [f64::from(sobol_burley::sample(point, dimension, seed)) * CELLS, CELLS]
            }
        };
        let within = Streams::new(place.seed, place.member).of(quantity).uniform();
        let smallest = f64::EPSILON;
        Some(((cell + within) / cells).clamp(smallest, 1.0 - smallest))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column(design: Design, first: u64, points: u64, quantity: &str, number: u32) -> Vec<f64> {
        let member = |k: u64| k * RANDOMISATIONS + first;
        let one = |k: u64| design.uniform(Place { seed: 3, member: member(k), points }, quantity, number);
        (0..points).map(|k| one(k).expect("it sets one")).collect()
    }

    #[test]
    fn every_stratum_of_a_quantity_holds_one_point() {
        for design in [Design::LatinHypercube, Design::Sobol] {
            for randomisation in [0, 15] {
                let mut strata: Vec<u32> = column(design, randomisation, 64, "a", 5)
                    .into_iter()
                    .map(|u| (64.0 * u) as u32)
                    .collect();
                strata.sort_unstable();
                assert_eq!(strata, (0..64).collect::<Vec<_>>(), "{design:?}");
            }
        }
    }

    #[test]
    fn a_scrambled_net_holds_one_point_in_every_elementary_interval_of_a_quantity_and_its_partner() {
        let [a, b] = [2, PARTNER + 2].map(|first| column(Design::Sobol, first, 64, "a", 0));
        for (rows, columns) in [(8.0, 8.0), (2.0, 32.0), (16.0, 4.0)] {
            let mut seen = vec![0; 64];
            for (x, y) in a.iter().zip(&b) {
                seen[((rows * x) as usize) * columns as usize + (columns * y) as usize] += 1;
            }
            assert_eq!(seen, [1; 64], "{rows} x {columns}");
        }
    }

    #[test]
    fn randomisations_partners_and_quantities_differ() {
        for design in [Design::LatinHypercube, Design::Sobol] {
            let one = column(design, 0, 16, "a", 0);
            assert_ne!(one, column(design, 1, 16, "a", 0));
            assert_ne!(one, column(design, 0, 16, "b", 1));
            assert_ne!(one, column(design, PARTNER, 16, "a", 0));
        }
        assert_eq!(Design::Plain.uniform(Place { seed: 3, member: 0, points: 1 }, "a", 0), None);
    }
}
