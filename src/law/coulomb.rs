//! Coulomb's law with cohesion and a tension cut-off, per sub-contact (source paper Eq. 2 and 3, Fig. 8).

use crate::law::weakening::Slipping;
use crate::law::{NormalLaw, Seating, Weakening};

/// The law of one joint. Stresses are per joint area; compression positive.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Coulomb {
    /// Compressive stress from closure.
    pub normal: NormalLaw,
    /// Shear stiffness per joint area (Pa/m).
    pub ks: f64,
    /// tan of the friction angle.
    pub tan_phi: f64,
    /// Cohesion (Pa).
    pub cohesion: f64,
    /// Tensile strength (Pa): a sub-contact that has been pulled harder than this is open for good and carries
    /// compression and friction only.
    pub tension: f64,
    /// Compressive strength (Pa), at which the stress stays as the joint closes on; `None` where it bears any pressure.
    pub compressive_strength: Option<f64>,
    /// What happens to the cohesion of a sub-contact once it has slipped.
    pub cohesion_after_slip: CohesionAfterSlip,
    /// How friction weakens with slip; `None` where it does not.
    pub weakening: Option<Weakening>,
    /// Where the joint's stress is sampled.
    pub sampling: Sampling,
    /// Linear springs that neither open nor slip (an idealised attachment), instead of a joint.
    pub bonded: bool,
}

/// What happens to the cohesion of a sub-contact once it has slipped.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CohesionAfterSlip {
    /// It stays: the envelope of the source paper's Eq. 3.
    Kept,
    /// It is gone: brittle bond.
    Lost,
}

/// Patches along each axis of a joint, see [`Sampling::Patches`].
pub const PATCHES_ALONG: u32 = 8;

/// Where the joint's stress is sampled.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(
    clippy::large_enum_variant,
    reason = "a law is copied freely, as its tables are, and few are alive at a time"
)]
pub enum Sampling {
    /// Integrated over the compressed area of the joint.
    Area,
    /// At the joint's corners only, as older block codes do: a tilting wall then loses its dependence on kn.
    Vertices,
    /// Integrated over the compressed area of some of the 8 x 8 ([`PATCHES_ALONG`]) patches into which the joint is divided: bit `8 i + j` stands
    /// for the patch `i` along its first and `j` along its second axis. The other patches never touch.
    Patches(u64),
    /// Integrated over the compressed area of a few patches of a bed joint, some of them behind the face. Joints of other faces, and of edges and
    /// corners, touch over their whole area.
    Seats(Seating),
}

/// What a point of a sub-contact remembers. A sub-contact that is integrated over its area has four, others one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SubContact {
    /// Shear traction on the incident block (Pa), in the joint's in-plane axes.
    pub tau: [f64; 2],
    /// Its area in contact when it was last looked at (m^2).
    pub area: f64,
    /// Whether it has been pulled harder than the tensile strength.
    pub broken: bool,
    /// Whether it has slipped.
    pub slipped: bool,
    /// How far it has slipped in all (m), where friction weakens with slip.
    pub slip: f64,
}

/// What presses at a point of a sub-contact at this moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pressed {
    /// Where it lies in the joint's plane coordinates (m).
    pub at: [f64; 2],
    /// Its share of the area in contact (m^2), the A_c of the source paper.
    pub area: f64,
    /// Its share of the normal force (N), compression positive.
    pub force: f64,
}

/// Shear displacement increments of the incident block against the reference block, affine over the joint:
/// `base + s by_s + t by_t` (m), components along the in-plane axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion {
    /// At the origin of the plane coordinates (m).
    pub base: [f64; 2],
    /// Per metre along s.
    pub by_s: [f64; 2],
    /// Per metre along t.
    pub by_t: [f64; 2],
}

/// Shear forces on the incident block summed over a joint: the sum and its first moments in the plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ShearSum {
    /// Sum of the forces (N).
    pub force: [f64; 2],
    /// Sum of s times force (N m).
    pub by_s: [f64; 2],
    /// Sum of t times force (N m).
    pub by_t: [f64; 2],
}

impl Motion {
    /// The increment (m) at a point of the joint.
    fn at(&self, [s, t]: [f64; 2]) -> [f64; 2] {
        let component = |k: usize| self.base[k] + s * self.by_s[k] + t * self.by_t[k];
        [component(0), component(1)]
    }
}

impl ShearSum {
    /// Adds a force (N) at a point of the joint.
    fn add(&mut self, [s, t]: [f64; 2], force: [f64; 2]) {
        for (k, f) in force.into_iter().enumerate() {
            self.force[k] += f;
            self.by_s[k] += s * f;
            self.by_t[k] += t * f;
        }
    }
}

impl SubContact {
    /// An open point carries no shear, and starts from none when it closes again.
    pub fn forget_shear(&mut self) {
        self.tau = [0.0; 2];
        self.area = 0.0;
    }
}

impl Coulomb {
    /// The loop over the points of a joint's sub-contacts: elastic shear increments limited by Coulomb's envelope.
    ///
    /// Per point, `dF_s = -ks dU_s A_c` (Eq. 2) with `|F_s| <= c A_c + F_n tan(phi)` (Eq. 3); beyond that the
    /// traction slides back radially onto the envelope. A point without area in contact forgets its shear.
    pub fn shear(&self, states: &mut [SubContact], pressed: &[Pressed], motion: &Motion) -> ShearSum {
        let mut sum = ShearSum::default();
        for (state, load) in states.iter_mut().zip(pressed) {
            if load.area <= 0.0 {
                state.forget_shear();
                continue;
            }
            state.tau = self.elastic(state, load, motion);
            state.area = load.area;
            if !self.bonded {
                let limit = self.strength(state, load);
                let size2 = state.tau[0] * state.tau[0] + state.tau[1] * state.tau[1];
                if size2 > limit * limit {
                    let size = size2.sqrt();
                    let limit = match &self.weakening {
                        Some(weakening) => {
                            let (cohesion, stress) = (self.cohesion_of(state), load.force / load.area);
                            let at = Slipping { cohesion, stress, slip: state.slip };
                            let [limit, slip] = self.weakened(weakening, &at, size);
                            state.slip += slip;
                            limit
                        }
                        None => limit,
                    };
                    let back = limit / size;
                    state.tau = [state.tau[0] * back, state.tau[1] * back];
                    state.slipped = true;
                }
            }
            sum.add(load.at, [state.tau[0] * load.area, state.tau[1] * load.area]);
        }
        sum
    }

    /// Whether a point that presses bears the shear of this motion without slipping.
    pub fn sticks(&self, state: &SubContact, load: &Pressed, motion: &Motion) -> bool {
        let (tau, limit) = (self.elastic(state, load, motion), self.strength(state, load));
        self.bonded || tau[0] * tau[0] + tau[1] * tau[1] <= limit * limit
    }

    /// The traction (Pa) of a point that does not slip. Area that comes into contact brings no shear with it, area that is lost
    /// takes its share away.
    pub(super) fn elastic(&self, state: &SubContact, load: &Pressed, motion: &Motion) -> [f64; 2] {
        let kept = if load.area > state.area { state.area / load.area } else { 1.0 };
        let increment = motion.at(load.at);
        [0, 1].map(|k| state.tau[k] * kept - self.ks * increment[k])
    }

    /// The strength (Pa) of a point before it slips on.
    pub(super) fn strength(&self, state: &SubContact, load: &Pressed) -> f64 {
        (self.cohesion_of(state) + load.force / load.area * self.tan_phi_after(state.slip)).max(0.0)
    }

    /// The cohesion (Pa) that a sub-contact still has.
    pub(super) fn cohesion_of(&self, state: &SubContact) -> f64 {
        let lost = state.broken || (state.slipped && self.cohesion_after_slip == CohesionAfterSlip::Lost);
        if lost { 0.0 } else { self.cohesion }
    }

    /// Whether a sub-contact still pulls: an attachment, or a joint with tensile strength that has not yet broken.
    pub fn holds(&self, state: &SubContact) -> bool {
        self.bonded || (self.tension > 0.0 && !state.broken)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn law() -> Coulomb {
        Coulomb {
            normal: NormalLaw::Linear { kn: 1e8 },
            ks: 5e7,
            tan_phi: 0.5,
            cohesion: 1e3,
            tension: 0.0,
            compressive_strength: None,
            cohesion_after_slip: CohesionAfterSlip::Kept,
            weakening: None,
            sampling: Sampling::Area,
            bonded: false,
        }
    }

    fn push(law: &Coulomb, state: &mut SubContact, force: f64, du: [f64; 2]) -> [f64; 2] {
        let pressed = Pressed { at: [0.0; 2], area: 0.1, force };
        let motion = Motion { base: du, ..Motion::default() };
        law.shear(std::slice::from_mut(state), &[pressed], &motion).force
    }

    #[test]
    fn shear_is_elastic_up_to_the_envelope_and_constant_beyond() {
        let mut state = SubContact::default();
        // ks du A = 5e7 x 1e-5 x 0.1 = 50 N against a limit of 1e3 x 0.1 + 200 x 0.5 = 200 N.
        assert_relative_eq!(push(&law(), &mut state, 200.0, [1e-5, 0.0])[0], -50.0, max_relative = 1e-12);
        assert!(!state.slipped);
        assert_relative_eq!(push(&law(), &mut state, 200.0, [1e-4, 0.0])[0], -200.0, max_relative = 1e-12);
        assert!(state.slipped);
        // Turned by a quarter while sliding: the traction swings round, its size stays on the envelope.
        let f = push(&law(), &mut state, 200.0, [0.0, 1e-2]);
        assert_relative_eq!((f[0] * f[0] + f[1] * f[1]).sqrt(), 200.0, max_relative = 1e-12);
        assert!(f[1] < -199.0);
    }

    #[test]
    fn cohesion_is_kept_or_lost_after_slip_as_asked() {
        let brittle = Coulomb { cohesion_after_slip: CohesionAfterSlip::Lost, ..law() };
        let mut state = SubContact::default();
        push(&brittle, &mut state, 200.0, [1e-3, 0.0]);
        assert_relative_eq!(push(&brittle, &mut state, 200.0, [1e-3, 0.0])[0], -100.0, max_relative = 1e-12);
        let mut state = SubContact { broken: true, ..SubContact::default() };
        assert_relative_eq!(push(&law(), &mut state, 200.0, [1e-3, 0.0])[0], -100.0, max_relative = 1e-12);
    }

    #[test]
    fn area_that_comes_into_contact_brings_no_shear() {
        // Else a sub-contact that flickers between half and whole would gain force, and so energy, each time.
        let mut state = SubContact::default();
        let mut shear = |area: f64, du: f64| {
            let pressed = Pressed { at: [0.0; 2], area, force: 1e4 };
            let motion = Motion { base: [du, 0.0], ..Motion::default() };
            law().shear(std::slice::from_mut(&mut state), &[pressed], &motion).force[0]
        };
        let half = shear(0.05, 1e-5);
        assert_relative_eq!(shear(0.1, 0.0), half, max_relative = 1e-14);
        assert_relative_eq!(shear(0.05, 0.0), half / 2.0, max_relative = 1e-14);
        assert_relative_eq!(shear(0.1, 0.0), half / 2.0, max_relative = 1e-14);
    }

    #[test]
    fn an_open_sub_contact_forgets_its_shear() {
        let mut state = SubContact { tau: [7.0, 8.0], area: 0.1, ..SubContact::default() };
        let open = Pressed::default();
        law().shear(std::slice::from_mut(&mut state), &[open], &Motion::default());
        assert_eq!(state.tau, [0.0; 2]);
    }

    #[test]
    fn friction_weakens_in_a_straight_line_with_slip() {
        let weak =
            Coulomb { cohesion: 0.0, weakening: Some(Weakening { residual: 0.4, distance: 1e-3 }), ..law() };
        // Peak 1000 N x 0.5; ks A = 5e6 N/m, so that the peak is reached after 0.1 mm.
        let strength = |slip: f64| 500.0 * (0.4 + 0.6 * (1.0 - slip / 1e-3).max(0.0));
        for steps in [1, 7, 100] {
            for way in [0.5e-4, 3e-4, 8e-4, 3e-3] {
                let mut state = SubContact::default();
                let mut force = 0.0;
                for _ in 0..steps {
                    force = -push(&weak, &mut state, 1000.0, [way / f64::from(steps), 0.0])[0];
                }
                // What is not elastic is slip: way = F / (ks A) + slip, whatever the steps.
                let slip = (way - force / 5e6).max(0.0);
                assert_relative_eq!(state.slip, if slip > 1e-12 { slip } else { 0.0 }, max_relative = 1e-9);
                if way > 1e-4 {
                    assert_relative_eq!(force, strength(slip), max_relative = 1e-9);
                }
            }
        }
        // Over a distance so short that the joint itself unloads slower, all is lost at once.
        let brittle = Coulomb { weakening: Some(Weakening { residual: 0.4, distance: 1e-5 }), ..weak };
        let mut state = SubContact::default();
        assert_relative_eq!(
            -push(&brittle, &mut state, 1000.0, [1.01e-4, 0.0])[0],
            200.0,
            max_relative = 1e-12
        );
    }
}
