//! What a wall or its load may demand beyond blocks with Coulomb joints under loads that grow. Each solver refuses in its `mod.rs` what it
//! does not have.

/// Something that not every solver has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Demand {
    /// Joints that close more and more stiffly.
    Closure,
    /// Joints whose stiffness grows with the stress on them.
    StressStiffening,
    /// Joints that close along a table.
    ClosureTable,
    /// Joints that bear a bounded pressure.
    CompressiveStrength,
    /// Joints that touch over a share of their area.
    ContactArea,
    /// Friction that weakens with slip.
    Weakening,
    /// Springs under the platform.
    BaseCompliance,
    /// Blocks that go lost on the way.
    WedgeLoss,
    /// Shear of joints that relaxes.
    Creep,
    /// A platform that turns steadily.
    Turning,
    /// Displacements on the way to the fall.
    Displacements,
    /// The displacement under a service load.
    ServiceDisplacement,
    /// What is left of displacements.
    Remainders,
    /// A base that moves in time.
    BaseMotion,
    /// Damping by a ratio at two frequencies.
    RayleighDamping,
    /// Impacts that give back a part of the speed.
    Restitution,
    /// Another answer than that of limit analysis, to compare with it.
    Agreement,
}
