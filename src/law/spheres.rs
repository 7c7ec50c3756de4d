//! Contact of two spheres: a linear normal spring and an incremental shear spring with Coulomb's limit, YADE's FrictMat
//! with the law of Cundall and Strack (1979).

use crate::math::{Vec3, tan};

/// What spheres are made of (YADE's `FrictMat`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frictional {
    /// Contact modulus E (Pa): a stiffness of the contact, not of a continuum.
    pub young: f64,
    /// Ratio of shear to normal stiffness (YADE's `poisson`).
    pub ks_over_kn: f64,
    /// Friction angle (rad).
    pub phi: f64,
}

/// The springs of one contact; forces, not stresses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphereSpring {
    /// Normal stiffness (N/m).
    pub kn: f64,
    /// Shear stiffness (N/m).
    pub ks: f64,
    /// tan of the friction angle.
    pub tan_phi: f64,
}

impl Frictional {
    /// The contact of a sphere of this material with another one (`Ip2_FrictMat_FrictMat_FrictPhys`):
    ///
    /// ```text
    /// kn = 2 E1 r1 E2 r2 / (E1 r1 + E2 r2)      ks = 2 E1 r1 v1 E2 r2 v2 / (E1 r1 v1 + E2 r2 v2)      phi = min(phi1, phi2)
    /// ```
    ///
    /// with `v` the ratio of shear to normal stiffness. A plane takes the part of an equal sphere: `kn = E r` where
    /// the materials are the same.
    ///
    /// A joint of such spheres is as stiff per area as its contacts are together, see [`Frictional::joint_stiffness`].
    pub fn spring(&self, radius: f64, other: &Frictional, other_radius: f64) -> SphereSpring {
        let (a, b) = (self.young * radius, other.young * other_radius);
        let (sa, sb) = (a * self.ks_over_kn, b * other.ks_over_kn);
        let ks = if sa + sb > 0.0 { 2.0 * sa * sb / (sa + sb) } else { 0.0 };
        SphereSpring { kn: 2.0 * a * b / (a + b), ks, tan_phi: tan(self.phi.min(other.phi)) }
    }
}

impl Frictional {
    /// The material whose spheres of one radius (m), ball on ball, give a joint the normal stiffness `kn` (Pa/m): each of
    /// `contacts_per_area` (1/m^2) has `E r` (N/m), so `E = kn / (r c)`.
    ///
    /// Balls at the distance s in square rows have one contact per `s^2`; in a plane model of depth b (m) one per `s b`. Where
    /// they touch, `s = 2 r` and `E = 4 r kn`. Balls in the hollows of the bed below are stiffer or softer than that, see
    /// `RegularRows::stiffening` of the tests.
    pub fn for_joint(kn: f64, ks_over_kn: f64, phi: f64, radius: f64, contacts_per_area: f64) -> Frictional {
        Frictional { young: kn / (radius * contacts_per_area), ks_over_kn, phi }
    }

    /// The way back: normal stiffness (Pa/m) of a joint of `contacts_per_area` (1/m^2) spheres of a radius (m), ball on ball.
    pub fn joint_stiffness(&self, radius: f64, contacts_per_area: f64) -> f64 {
        self.young * radius * contacts_per_area
    }
}

impl SphereSpring {
    /// Force on the second sphere (N), and the shear force in it that the contact remembers.
    ///
    /// `normal` points from the first sphere to the second, `closure` (m) is positive, `slip` is the displacement of the
    /// second against the first at the contact since the last step (m), `twist` the mean turn of the two about the normal
    /// (rad). The remembered shear follows the contact: it is laid into the plane of the contact as that is now, and
    /// turns with the twist; both are exact in the limit of small steps.
    pub fn force(&self, shear: &mut Vec3, closure: f64, normal: &Vec3, slip: &Vec3, twist: f64) -> Vec3 {
        let trial = *shear + normal.cross(shear) * twist - slip * self.ks;
        *shear = trial - normal * normal.dot(&trial);
        let pressure = self.kn * closure;
        let limit = pressure * self.tan_phi;
        let size2 = shear.norm_squared();
        if size2 > limit * limit {
            *shear *= limit / size2.sqrt();
        }
        normal * pressure + *shear
    }

    /// Energy stored in the springs (J).
    pub fn energy(&self, shear: &Vec3, closure: f64) -> f64 {
        let sheared = if self.ks > 0.0 { shear.norm_squared() / self.ks } else { 0.0 };
        0.5 * (self.kn * closure * closure + sheared)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const STONE: Frictional = Frictional { young: 1e6, ks_over_kn: 0.5, phi: 0.5 };

    #[test]
    fn stiffness_is_the_harmonic_mean_and_friction_the_smaller() {
        let other = Frictional { young: 3e6, ks_over_kn: 0.2, phi: 0.3 };
        let spring = STONE.spring(0.2, &other, 0.1);
        // E r = 2e5 and 3e5: 2 x 6e10 / 5e5; shear 1e5 and 6e4: 2 x 6e9 / 1.6e5.
        assert_relative_eq!(spring.kn, 2.4e5, max_relative = 1e-14);
        assert_relative_eq!(spring.ks, 7.5e4, max_relative = 1e-14);
        assert_relative_eq!(spring.tan_phi, 0.309_336_249_609_623_2, max_relative = 1e-14);
        assert_eq!(spring, other.spring(0.1, &STONE, 0.2));
    }

    #[test]
    fn a_square_mesh_has_one_contact_for_four_square_radii() {
        let (kn, r) = (5e7, 0.01);
        let material = Frictional::for_joint(kn, 0.5, 0.6, r, 1.0 / (4.0 * r * r));
        assert_relative_eq!(material.young, 4.0 * r * kn, max_relative = 1e-14);
        assert_relative_eq!(material.joint_stiffness(r, 2500.0), kn, max_relative = 1e-14);
        // One contact has E r: 4 r^2 of the joint.
        assert_relative_eq!(material.spring(r, &material, r).kn, 4.0 * r * r * kn, max_relative = 1e-14);
    }

    #[test]
    fn shear_grows_with_slip_up_to_friction_and_stays_in_the_plane() {
        let spring = SphereSpring { kn: 1e6, ks: 5e5, tan_phi: 0.5 };
        let mut shear = Vec3::zeros();
        let force = spring.force(&mut shear, 1e-3, &Vec3::z(), &Vec3::new(2e-4, 0.0, 7.0), 0.0);
        // Normal 1e3 N; shear -5e5 x 2e-4 = -100 N of at most 500; what the slip has along the normal does not count.
        assert_relative_eq!(force, Vec3::new(-100.0, 0.0, 1e3), max_relative = 1e-14);
        let force = spring.force(&mut shear, 1e-3, &Vec3::z(), &Vec3::new(3e-3, 0.0, 0.0), 0.0);
        assert_relative_eq!(force, Vec3::new(-500.0, 0.0, 1e3), max_relative = 1e-14);
        // Turned by the twist from -x towards -y, by the sine of the small angle.
        spring.force(&mut shear, 2e-3, &Vec3::z(), &Vec3::zeros(), 1e-6);
        assert_relative_eq!(shear, Vec3::new(-500.0, -5e-4, 0.0), max_relative = 1e-12);
    }
}
