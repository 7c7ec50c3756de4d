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
        let (mut multipliers, mut asked) = (vec![collapse.multiplier], 0);
        let ending = loop {
            interrupt::look();
            let found = self.planes(&collapse, &facets, support, cuts.asked);
            asked += found.asked;
            if found.new.is_empty() {
                break if found.asked == collapse.sections.len() { Ending::Exact } else { Ending::Settled };
            }
            if multipliers.len() >= cuts.rounds {
                break Ending::RoundsSpent;
            }
            facets.extend(found.new);
            let before = collapse.multiplier;
            collapse = self.collapse(&facets)?;
            multipliers.push(collapse.multiplier);
            if (before - collapse.multiplier).abs() <= cuts.tolerance * collapse.multiplier.abs() {
                break Ending::Settled;
            }
        };
        Ok(Refined { collapse, facets, multipliers, asked, ending })
    }

    /// Planes that cut stresses off. A section that a plane of this round has cut already is not asked about.
    fn planes(
        &self,
        collapse: &Collapse,
        facets: &[Facet],
        support: &mut dyn FnMut(&Section) -> Option<Facet>,
        most: usize,
    ) -> Planes {
        let units = Units::of(self.weight * self.height, facets);
        let outside = |facet: &Facet, section: &Section| {
            let ((normal, bound), unit) = (units.plane(facet), units.stress());
            (0..6).map(|c| normal[c] * section.stress[c] / unit[c]).sum::<f64>() - bound > VIOLATED
        };
        let mut sections: Vec<&Section> = collapse.sections.iter().collect();
        sections.sort_by(|a, b| flow(b, units.arm).total_cmp(&flow(a, units.arm)));
        let mut planes = Planes { new: Vec::new(), asked: 0 };
        for section in sections {
            if planes.asked == most {
                break;
            }
            if planes.new.iter().any(|facet| outside(facet, section)) {
                continue;
            }
            planes.asked += 1;
            planes.new.extend(support(section).filter(|f| f.is_sound() && outside(f, section)));
        }
        planes
    }
}

/// Planes found in a round, and how many sections were asked about.
struct Planes {
    new: Vec<Facet>,
    asked: usize,
}

/// How much a section flows: the size of its rate, curvatures at an arm (m), times its length or area.
fn flow(section: &Section, arm: f64) -> f64 {
    let scaled = section.rate.iter().enumerate().map(|(c, r)| if c < 3 { *r } else { r * arm });
    section.size * scaled.map(|r| r * r).sum::<f64>().sqrt()
}
