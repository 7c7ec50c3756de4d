//! pirca: a stochastic masonry generator and analyser.
//!
//! How strong is a dry stone wall whose every stone is different, and how sure are we? Which arrangement of joints is
//! better? A study draws many walls, solves each as an assembly of rigid blocks with deformable joints, and reports
//! statistics with their intervals. Walls that others made are solved as well.
//!
//! # The equations
//!
//! **Balance of a rigid block** (`solve::explicit`: central differences, step `dt`). Forces `F` and moments `T` about the centroid are sums
//! over gravity, dead loads and joints; `L = R I R^T w` is the angular momentum; local damping takes `alpha |F|` against
//! the motion:
//!
//! ```text
//! m (v(n+1/2) - v(n-1/2)) / dt = F(n) - alpha |F(n)| v / |v|        x(n+1) = x(n) + dt v(n+1/2)
//!   (L(n+1/2) - L(n-1/2)) / dt = T(n) - alpha |T(n)| w / |w|        R(n+1) = turn(dt w(n+1/2)) R(n)
//! ```
//!
//! **Joint** (source paper Eq. 2, 3, Fig. 8). Two faces overlap in a polygon; the gap `g` between them is affine over it.
//! Where `u = -g >= 0` the normal law presses, integrated exactly over the compressed part `A_c` of the polygon; shear
//! grows with the relative displacement and slides on Coulomb's envelope, per sub-contact:
//!
//! ```text
//! F_n = integral over A_c of kn u dA        dF_s = -ks A_c dU_s        |F_s| <= c A_c + F_n tan(phi)
//! ```
//!
//! The pressure acts along the normal of one face (the reference) at the points of the other (the incident one), so
//! that it is the gradient of the energy `integral 1/2 kn u^2 dA`. A tensile strength holds a sub-contact together
//! until it is exceeded once.
//!
//! **Critical step.** `omega_max^2 <= 2 max_block lambda_max(M^-1 K_block)`, with `K_block` the 6 x 6 stiffness of a block
//! against fixed neighbours, bounded by Gershgorin's row sums; `dt <= 2 / omega_max`. For a rest state inertia may be
//! scaled per block so that all blocks share one critical step.
//!
//! **Equilibrium** (`solve::implicit`). At rest the residual `r`, the forces and moments of every block under the loads on the
//! displaced blocks, vanishes; Newton's method finds it, with the consistent tangent `K` of the joints, the turned contact
//! forces and the loads, unsymmetric where joints slip, and `s` from a line search:
//!
//! ```text
//! r(x) = loads(x) + joints(x, what they remember) = 0        K = -dr/dx        K dx = r        x <- x + s dx
//! ```
//!
//! A wall falls at a limit point of the path `r(x, load) = 0`: no equilibrium is found at the shortest step, and limit analysis
//! or explicit relaxation confirms it. The load is bracketed by halving.
//!
//! **Limit analysis** (`solve::limit`). Rigid blocks with forces `(n, t)` at the vertices of their joints, each with a share
//! `A` of the joint's area; `E` collects forces and moments, `d` the dead loads, `l` the live loads. The largest multiplier in
//! balance is an upper bound on the capacity with any Coulomb joints (Radenkovic 1961); its dual is the mechanism:
//!
//! ```text
//! max lambda    such that    E (n, t) + d + lambda l = 0        n >= 0        |t| <= c A + n tan(phi)
//! ```
//!
//! The state without dilatancy is the fixed point of such problems with `|t| <= s`, each `s` the strength `c A + n tan(phi)` under
//! the forces last found (Gilbert et al. 2006): neither a bound nor unique. Under tilt `tan(angle) = lambda` where `c = 0`.
//!
//! **Contact dynamics** (`solve::nonsmooth`; Moreau 1988, Jean 1999). Rigid blocks, velocities `v` and impulses `(r_N, r_T)` of a step `h`,
//! relative velocities `u = H^T v`; Coulomb's law without dilatancy:
//!
//! ```text
//! M (v - v_free) = H r        0 <= max(g, 0) / h + u_N  perp  r_N >= 0        |r_T| <= h c A + r_N tan(phi)
//! ```
//!
//! **Plate** (`homogenise::plate`). A cell of stones bears the stresses `(N, M)` of a polyhedron with facets `n_k . (N, M) <= b_k`. A wall falls at
//! the least multiplier over mechanisms with strains `E`, curvatures `chi` and folds whose rates are sums of the facets' normals:
//!
//! ```text
//! min lambda = sum mu_k b_k - dead power    such that    (E, chi) = sum mu_k n_k,  mu_k >= 0,  live power = 1
//! ```
//!
//! **At rest** when the mean unbalanced force of the blocks is below a given share of the mean joint force.
//!
//! **Statistics asked for.** For walls `i = 1..n` with displacement `d_i`: mean, sigma (n - 1) and COV = sigma / mean, with
//! 95 % intervals (Student t; chi-square and BCa bootstrap; Vangel's for the COV), quantiles, ratios of means between
//! arms (Fieller), and the count of walls by how they ended.
//!
//! # Symbols and units
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | x, y, z | along the wall, out of plane (positive = downhill, away from the loaded back), up | m |
//! | kn, ks | normal and shear stiffness of a joint per area | Pa/m |
//! | phi, c | friction angle, cohesion | rad (deg in files), Pa |
//! | u, g | closure and gap, u = -g | m |
//! | sigma, tau | stress on a joint, compression positive | Pa |
//! | lambda | load multiplier; live load over weight | - |
//! | alpha | local damping coefficient | - |
//! | dip | lean of a joint plane against the horizontal | rad (deg in files) |
//!
//! SI units inside, f64 throughout; degrees only in files and arguments whose names end in `_deg`.
//!
//! # The modules, in reading order
//!
//! | module | what is in it |
//! |---|---|
//! | [`interrupt`] | long work that is told to stop |
//! | [`math`] | vectors, elementary functions on libm, the invariant check |
//! | [`shape`] | convex polygons and polyhedra: cut, clip, inertia, overlap, validity; unions of balls |
//! | [`random`] | seed streams keyed by (seed, member, quantity); distribution families |
//! | [`stats`] | moments, COV, intervals, bootstrap, ratios, distances |
//! | [`motion`] | ground motions: records read, generated, measured |
//! | [`law`] | constitutive laws: normal laws, Coulomb, weakening, contact of spheres, damping |
//! | [`model`] | the nouns: block, wall, cell, clump of spheres, outcome |
//! | [`face`] | outlines of stones as polygons that share the lines of their joints |
//! | [`exchange`] | walls from and to other programs, drawings and pictures; names their faults |
//! | [`render`] | numbers and tables as text, CSV, charts, documents, pictures of walls, VTU, glTF; knows no verb and no study |
//! | [`contact`] | broad phase, separating axes, patches, sub-contacts |
//! | [`mend`] | joints made planes in a wall that was measured |
//! | [`generate`] | layouts to walls; `canonical` holds walls with known answers |
//! | [`solve`] | bodies, joints with history; the solvers `explicit`, `implicit`, `nonsmooth`, `limit`; `grains` for bodies made of spheres |
//! | [`homogenise`] | a wall as a plate: cells of stones, their stiffness and their strength |
//! | [`protocol`] | load paths (lateral, tilting, shear, retaining), base motion, restraint, what is observed, when a collapse is confirmed |
//! | [`verify`] | local mechanisms checked as codes ask for it: spectra, capacity curves, limit states |
//! | [`study`] | text to checked studies, every fault at once |
//! | [`ensemble`] | plan, run in parallel, record, resume |
//! | [`critic`] | measured beside simulated; the joint stiffness that measured collapse angles speak for |
//! | [`terminal`] | progress, messages, exit codes |
//! | [`verb`] | a room for each verb: options and help, work, answer; a run's summary is shared |
//! | [`cli`] | the list of verbs, as the command line reads it |
//!
//! Imports go one way, down this list to what stands above; a test holds the table. Six loops, six files:
//! realisations `ensemble/run.rs`, load steps `protocol/drive.rs`, time steps `solve/explicit/step.rs`, Newton's iterations
//! `solve/implicit/newton.rs`, contacts `solve/joints/mod.rs`, sub-contacts `law/coulomb.rs`. A diagnosis reads from top to bottom in
//! `critic/method.rs`. Papers are listed in `src/references.md`.

pub mod cli;
pub mod contact;
pub mod critic;
pub mod ensemble;
pub mod exchange;
pub mod face;
pub mod generate;
pub mod homogenise;
pub mod interrupt;
pub mod law;
pub mod math;
pub mod mend;
pub mod model;
pub mod motion;
pub mod protocol;
pub mod random;
pub mod render;
pub mod shape;
pub mod solve;
pub mod stats;
pub mod study;
pub mod terminal;
pub mod verb;
pub mod verify;
