//! The critical time step of grains.

use crate::math::Vec3;
use crate::shape::Frame;
use crate::solve::gershgorin::RowSums;
use crate::solve::grains::Grains;

/// The smaller of two steps (s): YADE's `PWaveTimeStep`, `min r sqrt(rho / E)` over the spheres that bodies have their mass from, and `2 / omega` of the bound
/// `omega^2 <= 2 max_body lambda_max(M^-1 K_body)`, with Gershgorin's row sums over all listed contacts, whether they
/// touch now or not (see [`crate::solve::explicit`]). A body with the mass of a solid has `sqrt(m / (E r))` for the first: the
/// step of its mass on one contact, which counts where nothing is near.
pub fn step(grains: &Grains) -> f64 {
    let mut stiffness = vec![RowSums::default(); grains.bodies.len()];
    let spheres = &grains.spheres;
    let mut add = |sphere: u32, at: &Vec3, normal: &Vec3, kn: f64, ks: f64| {
        let id = spheres.body[sphere as usize] as usize;
        let body = &grains.bodies[id];
        let frame = Frame::on_plane(*at, *normal);
        let local = |v: Vec3| body.rotation.tr_mul(&v);
        let lever = local(at - body.position);
        for (axis, k) in [(frame.normal, kn), (frame.s, ks), (frame.t, ks)] {
            stiffness[id].add_spring(&lever, &local(axis), k);
        }
    };
    for contact in &grains.contacts.pairs {
        let (i, j) = (contact.sphere as usize, contact.other as usize);
        let normal = (spheres.centre[j] - spheres.centre[i]).normalize();
        let at = spheres.centre[i] + normal * spheres.radius[i];
        add(contact.sphere, &at, &normal, contact.spring.kn, contact.spring.ks);
        add(contact.other, &at, &normal, contact.spring.kn, contact.spring.ks);
    }
    for contact in &grains.contacts.seats {
        let (i, normal) = (contact.sphere as usize, grains.planes[contact.other as usize].normal);
        let at = spheres.centre[i] - normal * spheres.radius[i];
        add(contact.sphere, &at, &normal, contact.spring.kn, contact.spring.ks);
    }
    let moving = stiffness.iter().zip(&grains.bodies).filter(|(_, body)| body.moves());
    let bounds = moving.map(|(own, body)| own.bound(body));
    let bound = bounds.fold(0.0, f64::max);
    p_wave(grains).min(2.0 / (2.0 * bound).sqrt())
}

/// YADE's P-wave step (s), or what stands for it.
fn p_wave(grains: &Grains) -> f64 {
    let of = |(&radius, &id): (&f64, &u32)| {
        let id = id as usize;
        let young = grains.materials[id].young;
        match grains.densities[id] {
            Some(density) => radius * (density / young).sqrt(),
            None => (grains.bodies[id].mass / (young * radius)).sqrt(),
        }
    };
    grains.spheres.radius.iter().zip(&grains.spheres.body).map(of).fold(f64::INFINITY, f64::min)
}
