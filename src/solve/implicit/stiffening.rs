//! Joints that are soft until they have closed, stiffened little by little.
//!
//! Where little presses such a joint is a thousand times softer than where it has closed: it is a gap that closes, and which gaps close
//! depends on all others. From a wall as built Newton's method then goes many closures too far, each joint by its own way, blocks
//! turn, and no step leads back. With a share `s` of its stiffness the law bends less, and Newton's method works; from there the
//! solution is followed to the law itself. As joints stiffen what they carry grows at the same closure, and Newton's method comes
//! down to a stress from above in few steps:
//!
//! ```text
//! r(x, s kn, s ks) = 0,   s = s_0 ... 1
//! ```
//!
//! What each joint remembers, its contacts and the loads stay those of the solve that failed: the equations at the end are the same.

use crate::law::Coulomb;
use crate::math::pow;
use crate::solve::bodies::Body;
use crate::solve::implicit::Settings;
use crate::solve::implicit::newton::Newton;

/// The share falls by this factor until a solution is found.
const FALL: f64 = 4.0;
/// Below this share nothing is looked for.
const SMALLEST: f64 = 1.0 / 4096.0;
/// It rises from there by this factor at most.
const RISE: f64 = 1.6;
/// A step that does not converge is tried with the root of its factor, down to this one; after one that does the factor grows to
/// this power.
const SHORTEST: f64 = 1.1;
const GROWTH: f64 = 1.2;
/// Unbalanced force ratio on the way: the next step begins near enough to the path.
const ROUGH: f64 = 1e-3;
/// Factorisations of a solve on the way; one that needs more goes too far.
const MOST_FACTORISATIONS: u32 = 8;

impl Newton<'_, '_> {
    /// [`Newton::solve`] from the positions where a solve began that failed.
    pub(super) fn solve_stiffening(&mut self, start: &[Body]) -> (bool, f64) {
        let laws: Vec<Coulomb> = self.assembly.joints.all.iter().map(|joint| joint.law).collect();
        let rough = Settings {
            unbalanced_ratio: ROUGH.max(self.settings.unbalanced_ratio),
            max_factorisations: MOST_FACTORISATIONS.min(self.settings.max_factorisations),
            ..*self.settings
        };
        let mut way = Newton {
            assembly: &mut *self.assembly,
            system: &mut *self.system,
            anchors: self.anchors,
            settings: &rough,
            effort: &mut *self.effort,
            loose: &mut *self.loose,
        };
        let arrived = way.stiffen(&laws, start);
        self.set_share(&laws, 1.0);
        if arrived { self.solve(false) } else { (false, self.assembly.unbalanced_ratio()) }
    }

    /// Follows the equilibria, roughly, from joints so soft that one is found to the joints as they are. Says whether it got there.
    fn stiffen(&mut self, laws: &[Coulomb], start: &[Body]) -> bool {
        let (mut share, mut factor) = (1.0, RISE);
        loop {
            share /= FALL;
            if share < SMALLEST {
                return false;
            }
            self.assembly.bodies.all.clone_from_slice(start);
            if self.balances_at(laws, share) {
                break;
            }
        }
        while share < 1.0 {
            let here = self.assembly.bodies.all.clone();
            let next = f64::min(share * factor, 1.0);
            if self.balances_at(laws, next) {
                share = next;
                factor = f64::min(pow(factor, GROWTH), RISE);
            } else if factor > SHORTEST {
                self.assembly.bodies.all.clone_from_slice(&here);
                factor = factor.sqrt();
            } else {
                return false;
            }
        }
        true
    }

    /// Whether a state in balance is found with a share of the stiffness, stable or not.
    fn balances_at(&mut self, laws: &[Coulomb], share: f64) -> bool {
        self.set_share(laws, share);
        let (_, ratio) = self.solve(false);
        ratio < self.settings.unbalanced_ratio.max(self.rounding())
    }

    /// Gives every joint that is soft until it has closed a share of its stiffness.
    fn set_share(&mut self, laws: &[Coulomb], share: f64) {
        for (joint, law) in self.assembly.joints.all.iter_mut().zip(laws) {
            if let Some(normal) = law.normal.softened(share) {
                joint.law = Coulomb { normal, ks: share * law.ks, ..*law };
            }
        }
    }
}
