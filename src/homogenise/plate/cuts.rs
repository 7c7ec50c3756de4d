//! A surface that is known by its supporting planes only: solve, ask for planes that cut the stresses off, solve again.

use crate::interrupt;

use super::collapse::{Collapse, Section};
use super::facet::{Facet, Units};
use super::wall::{Plate, PlateFault};

/// Excess of a stress over a plane, over the greatest force of the wall, that counts: well above what the solver leaves.
const VIOLATED: f64 = 1e-6;

/// How long to cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuts {
    /// Relative change of the multiplier, from one round to the next, at which it is taken as settled.
    pub tolerance: f64,
    /// Rounds at most; the first one has the facets given.
    pub rounds: usize,
    /// Sections at most that are asked about in a round, those that flow most before the others.
    pub asked: usize,
}

impl Default for Cuts {
    /// A round that changes the multiplier by less than 0.2 %: with all the rounds that would follow it is some 0.5 % too high.
    fn default() -> Self {
        Cuts { tolerance: 2e-3, rounds: 30, asked: 100 }
    }
}

/// Why the cutting ended. A wall that falls at rest with the facets so far, or bears anything, is a [`PlateFault`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// No plane cuts the stress of any section off: the multiplier is that of the surface itself on this mesh.
    Exact,
    /// The multiplier changed by no more than the tolerance, or no section asked about is cut while others were not asked about.
    Settled,
    /// The rounds are spent: the multiplier is too high by an unknown amount.
    RoundsSpent,
}

/// A collapse with the planes found on the way.
#[derive(Clone, Debug, PartialEq)]
pub struct Refined {
    /// The last collapse.
    pub collapse: Collapse,
    /// The facets given, then those found.
    pub facets: Vec<Facet>,
    /// The multiplier of every round; none above the one before but for the solver's rounding.
    pub multipliers: Vec<f64>,
    /// Sections asked about in all.
    pub asked: usize,
    /// Why it ended.
    pub ending: Ending,
}

impl Plate {
    /// The collapse when sections bear what is within a convex surface that only `support` knows. `facets` bound it from outside and
    /// must make a multiplier finite.
    ///
    /// `support` gives a supporting plane of the surface: one that cuts the section's stress off where that is outside, else any or
    /// none. For a surface whose bounds are not zero the plane across the section's rate will do; a cone has all its planes through
    /// the origin, and those across the rates that its facets allow do not cut it: there the plane is to be found from the stress.
    ///
    /// # Errors
    /// Those of [`Plate::collapse`], in whichever round.
    pub fn collapse_by_cuts(
        &self,
        mut facets: Vec<Facet>,
        support: &mut dyn FnMut(&Section) -> Option<Facet>,
        cuts: &Cuts,
    ) -> Result<Refined, PlateFault> {
        let mut collapse = self.collapse(&facets)?;
        let mut own = vec![(0..facets.len()).collect::<Vec<_>>(); collapse.sections.len()];
        let (mut multipliers, mut asked) = (vec![collapse.multiplier], 0);
        let ending = loop {
            interrupt::look();
            let found = self.cut(&collapse, (&mut facets, &mut own), support, cuts.asked);
            asked += found.asked;
            if found.cut == 0 {
                break if found.asked == collapse.sections.len() { Ending::Exact } else { Ending::Settled };
            }
            if multipliers.len() >= cuts.rounds {
                break Ending::RoundsSpent;
            }
            let before = collapse.multiplier;
            collapse = self.collapse_within(&facets, &own)?;
            multipliers.push(collapse.multiplier);
            if (before - collapse.multiplier).abs() <= cuts.tolerance * collapse.multiplier.abs() {
                break Ending::Settled;
            }
        };
        Ok(Refined { collapse, facets, multipliers, asked, ending })
    }

    /// Cuts stresses off, each by the known plane that it is farthest outside of, else by one that is asked for. A plane is put to the
    /// sections that it cuts alone: a wall has some thousand of them, and takes some hundred planes.
    fn cut(
        &self,
        collapse: &Collapse,
        (facets, own): (&mut Vec<Facet>, &mut [Vec<usize>]),
        support: &mut dyn FnMut(&Section) -> Option<Facet>,
        most: usize,
    ) -> Cut {
        let units = Units::of(self.weight * self.height, facets);
        let unit = units.stress();
        let outside = |(normal, bound): &([f64; 6], f64), section: &Section| {
            (0..6).map(|c| normal[c] * section.stress[c] / unit[c]).sum::<f64>() - bound
        };
        let mut planes: Vec<_> = facets.iter().map(|facet| units.plane(facet)).collect();
        let mut order: Vec<usize> = (0..collapse.sections.len()).collect();
        let flows = |k: usize| flow(&collapse.sections[k], units.arm);
        order.sort_by(|a, b| flows(*b).total_cmp(&flows(*a)));
        let mut done = Cut { cut: 0, asked: 0 };
        for place in order {
            let section = &collapse.sections[place];
            let excess = planes.iter().enumerate().map(|(facet, plane)| (facet, outside(plane, section)));
            let worst = excess
                .filter(|(facet, excess)| *excess > VIOLATED && !own[place].contains(facet))
                .max_by(|a, b| a.1.total_cmp(&b.1));
            let facet = match worst {
                Some((facet, _)) => Some(facet),
                None if done.asked < most => {
                    done.asked += 1;
                    let new = support(section).filter(Facet::is_sound);
                    let plane = new.as_ref().map(|new| units.plane(new));
                    plane.filter(|plane| outside(plane, section) > VIOLATED).zip(new).map(|(plane, new)| {
                        planes.push(plane);
                        facets.push(new);
                        facets.len() - 1
                    })
                }
                None => None,
            };
            if let Some(facet) = facet {
                own[place].push(facet);
                done.cut += 1;
            }
        }
        done
    }
}

/// Sections cut in a round, and how many were asked about.
struct Cut {
    cut: usize,
    asked: usize,
}

/// How much a section flows: the size of its rate, curvatures at an arm (m), times its length or area.
fn flow(section: &Section, arm: f64) -> f64 {
    let scaled = section.rate.iter().enumerate().map(|(c, r)| if c < 3 { *r } else { r * arm });
    section.size * scaled.map(|r| r * r).sum::<f64>().sqrt()
}
