//! The mechanisms that the base model leaves out, as a study asks for them.

use crate::math::{degrees, radians, tan};
use crate::protocol::{Compliance, Creep};
use crate::study::inventory::INVENTORY;
use crate::study::reader::Reader;

/// What a study asks for, checked; nothing by default. Angles in radians, the rest in SI units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mechanisms {
    /// Width of the rounded arris (m).
    pub contact_inset: Option<f64>,
    /// Hyperbolic closure of the joints.
    pub joint_closure: Option<JointClosure>,
    /// Stiffness of the joints that grows with the stress.
    pub stress_stiffening: Option<StressStiffening>,
    /// Share of each joint in contact.
    pub contact_area: Option<f64>,
    /// Another friction.
    pub friction: Option<FrictionChange>,
    /// Cohesion (Pa) added to that of the joints.
    pub cohesion: Option<f64>,
    /// Out-of-plumb towards downhill (rad).
    pub lean: Option<f64>,
    /// Springs under the platform.
    pub base_compliance: Option<Compliance>,
    /// Wedges that are lost.
    pub wedge_loss: Option<WedgeLoss>,
    /// Slack (m) added to that of the ropes.
    pub rope_slack: Option<f64>,
    /// Factor on the deviation of stone sizes from their means.
    pub size_scatter: Option<f64>,
    /// Factor on the density.
    pub density: Option<f64>,
    /// Added (m) to every displacement read after the zero reading.
    pub gauge_offset: Option<f64>,
    /// Factor on every displacement read.
    pub gauge_scale: Option<f64>,
    /// Creep of the joints.
    pub creep: Option<Creep>,
    /// Scatter from specimen to specimen.
    pub specimen_scatter: Option<SpecimenScatter>,
    /// Less interlocked ends.
    pub end_release: Option<EndRelease>,
    /// Tangent of the friction angle on platform and strip.
    pub platform_friction: Option<f64>,
}

/// Hyperbolic closure in series with kn; see [`crate::law::NormalLaw::Hyperbolic`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointClosure {
    /// Initial stiffness (Pa/m).
    pub initial: f64,
    /// Maximum closure (m).
    pub closure: f64,
}

/// Stiffness that grows as a power of the stress, between a floor and kn; see [`crate::law::Stiffening`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StressStiffening {
    /// Stiffness (Pa/m) of the power law at 1 MPa.
    pub at_1_mpa: f64,
    /// Exponent.
    pub exponent: f64,
    /// Smallest stiffness (Pa/m).
    pub floor: f64,
}

/// Another friction of the stones' joints; see [`crate::law::Weakening`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionChange {
    /// Factor on tan(phi).
    pub factor: f64,
    /// Share of it that is left after slip.
    pub residual: f64,
    /// Slip (m) over which it falls to that.
    pub distance: f64,
}

/// Wedges that are crushed or fall out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WedgeLoss {
    /// Share of the wedges, each drawn on its own.
    pub share: f64,
    /// The last tilt (rad) at which they are there.
    pub beyond: f64,
}

/// Lognormal factors of mean 1, drawn once per wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpecimenScatter {
    /// COV of the factor on kn and ks.
    pub kn: f64,
    /// COV of the factor on tan(phi).
    pub friction: f64,
}

/// Less interlocked ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndRelease {
    /// Distance from the wall's ends (m) within which the middle of a joint lies.
    pub within: f64,
    /// Share of tan(phi).
    pub friction: f64,
    /// Share of the shear stiffness.
    pub stiffness: f64,
}

impl Mechanisms {
    /// Whether one of them draws random numbers, so that walls of fixed stones and joints differ from member to member.
    pub fn draws(&self) -> bool {
        let Mechanisms { contact_area, wedge_loss, specimen_scatter, .. } = self;
        contact_area.is_some() || wedge_loss.is_some() || specimen_scatter.is_some()
    }

    /// Reads `[mechanism]`.
    pub(super) fn read(t: &mut Reader<'_>) -> Option<Mechanisms> {
        let (mut read, mut sound) = (Mechanisms::default(), true);
        for entry in &INVENTORY {
            if t.has(entry.name) {
                sound &= t.table(entry.name).and_then(|mut own| read.one(entry.name, &mut own)).is_some();
            }
        }
        sound.then_some(read)
    }

    /// Reads the mechanism of that name.
    fn one(&mut self, name: &str, t: &mut Reader<'_>) -> Option<()> {
        match name {
            "contact_inset" => self.contact_inset = Some(t.real("radius_m")?),
            "joint_closure" => {
                let [initial, closure] = t.reals(["initial_pa_per_m", "closure_m"])?;
                self.joint_closure = Some(JointClosure { initial, closure });
            }
            "stress_stiffening" => {
                let [at_1_mpa, exponent, floor] =
                    t.reals(["at_1_mpa_pa_per_m", "exponent", "floor_pa_per_m"])?;
                self.stress_stiffening = Some(StressStiffening { at_1_mpa, exponent, floor });
            }
            "contact_area" => self.contact_area = Some(t.real("share")?),
            "friction" => {
                let [factor, residual, distance] =
                    t.reals(["factor", "residual_share", "slip_distance_m"])?;
                self.friction = Some(FrictionChange { factor, residual, distance });
            }
            "cohesion" => self.cohesion = Some(t.real("added_pa")?),
            "lean" => self.lean = Some(radians(t.real("angle_deg")?)),
            "base_compliance" => {
                let [settlement, rotation] = t.reals(["settlement_n_per_m", "rotation_n_m_per_rad"])?;
                self.base_compliance = Some(Compliance { settlement, rotation });
            }
            "wedge_loss" => {
                let [share, beyond] = t.reals(["share", "beyond_deg"])?;
                self.wedge_loss = Some(WedgeLoss { share, beyond: radians(beyond) });
            }
            "rope_slack" => self.rope_slack = Some(t.real("added_m")?),
            "size_scatter" => self.size_scatter = Some(t.real("factor")?),
            "density" => self.density = Some(t.real("factor")?),
            "gauge_offset" => self.gauge_offset = Some(t.real("offset_m")?),
            "gauge_scale" => self.gauge_scale = Some(t.real("factor")?),
            "creep" => {
                let [rate, hold_share, every] = t.reals(["rate_per_deg", "hold_share", "hold_every_deg"])?;
                self.creep = Some(Creep { rate: degrees(rate), hold_share, hold_every: radians(every) });
            }
            "specimen_scatter" => {
                let [kn, friction] = t.reals(["kn_cov", "friction_cov"])?;
                self.specimen_scatter = Some(SpecimenScatter { kn, friction });
            }
            "end_release" => {
                let [within, friction, stiffness] =
                    t.reals(["within_m", "friction_share", "stiffness_share"])?;
                self.end_release = Some(EndRelease { within, friction, stiffness });
            }
            "platform_friction" => self.platform_friction = Some(tan(radians(t.real("phi_deg")?))),
            other => {
                crate::check!(false, "the mechanism `{other}` of the catalogue is not read");
                return None;
            }
        }
        Some(())
    }
}
