//! One measured value.

use crate::study::measured::unit::Dimension;

/// A value measured on a specimen, or a bound of one. SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    /// Name of the specimen.
    pub specimen: String,
    /// Name of the arm that it is a specimen of.
    pub family: String,
    /// Tilt of the platform at the reading, of a remainder that from which it has gone back (rad); `None` where the quantity has none of its own.
    pub tilt: Option<f64>,
    /// Drift at the reading, displacement over height of the push; `None` where the quantity has none of its own.
    pub drift: Option<f64>,
    /// Which motion of the base it was read under; `None` where the base did not move.
    pub under: Option<Under>,
    /// What was measured.
    pub quantity: MeasuredQuantity,
    /// The value, or the bound of a censored reading. Of an outcome the logarithm of the motion's scale: the scale at which the wall would just
    /// fall lies below that of a motion under which it fell, and above that of one under which it stood.
    pub value: f64,
    /// How the value is to be read.
    pub kind: MeasuredKind,
    /// Random error of the value, one standard deviation.
    pub error: f64,
    /// Error that all readings of the [instrument](MeasuredQuantity::instrument) share, one standard deviation.
    pub common_error: f64,
    /// Whether nobody knows how much of the error is shared: half of the variance then stands in either.
    pub unknown_share: bool,
    /// Distance of neighbouring values of a rounded reading; 0 of any other.
    pub resolution: f64,
    /// Place of the specimen in the order of the tests, from 1.
    pub order: Option<u32>,
    /// Place of the reading in the sequence on its specimen.
    pub stage: u32,
    /// Line of the file.
    pub line: usize,
}

impl Measurement {
    /// The tilt (rad) or the drift at which it was read; `None` where the quantity has neither.
    pub fn at(&self) -> Option<f64> {
        self.tilt.or(self.drift)
    }

    /// The random and the common error (one standard deviation each), where the common one has this share of the variance if that
    /// is not known.
    pub fn errors(&self, share: f64) -> [f64; 2] {
        if !self.unknown_share {
            return [self.error, self.common_error];
        }
        let whole = self.error * self.error + self.common_error * self.common_error;
        [(1.0 - share) * whole, share * whole].map(f64::sqrt)
    }
}

/// A motion of the base.
#[derive(Clone, Debug, PartialEq)]
pub struct Under {
    /// Name of the record, as the study has it.
    pub record: String,
    /// Factor on the record as it was recorded.
    pub scale: f64,
}

/// How a value is to be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum MeasuredKind {
    /// The reading.
    Exact,
    /// The reading is smaller than this: left-censored.
    Below,
    /// The reading is larger than this: right-censored.
    Above,
    /// The reading, rounded to the nearest multiple of the resolution.
    Rounded,
}

impl MeasuredKind {
    /// Names in the file.
    pub const NAMES: [&str; 4] = ["exact", "below", "above", "rounded"];

    /// The kind of that name.
    pub fn named(name: &str) -> Option<MeasuredKind> {
        use MeasuredKind::{Above, Below, Exact, Rounded};
        [Exact, Below, Above, Rounded]
            .into_iter()
            .zip(Self::NAMES)
            .find(|(_, n)| *n == name)
            .map(|(kind, _)| kind)
    }

    /// Whether only a bound is known.
    pub fn is_censored(self) -> bool {
        matches!(self, MeasuredKind::Below | MeasuredKind::Above)
    }
}

/// What was measured. Displacements are along the platform's +y at the wall's top, relative to the reading at rest at
/// 0 deg.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum MeasuredQuantity {
    /// Tilt at which the wall fell (rad).
    CollapseAngle,
    /// Displacement at the left end (m).
    DisplacementLeft,
    /// Displacement at the centre (m).
    DisplacementCentre,
    /// Displacement at the right end (m).
    DisplacementRight,
    /// Mean of the displacements at the left, the centre and the right (m).
    DisplacementMean,
    /// Displacement at the centre less the mean of those at the two ends (m).
    DisplacementCentreMinusEnds,
    /// What is left of the displacement at the left end when the platform has gone back to 0 deg from a tilt (m).
    RemainderLeft,
    /// The same at the centre (m).
    RemainderCentre,
    /// The same at the right end (m).
    RemainderRight,
    /// Mean of what is left at the left, the centre and the right (m).
    RemainderMean,
    /// What is left at the centre less the mean of that at the two ends (m).
    RemainderCentreMinusEnds,
    /// Normal stiffness of a joint in a two-stone test (Pa/m).
    JointKn,
    /// Friction angle of a joint in a two-stone test (rad).
    JointPhi,
    /// Weight of a specimen (N).
    SpecimenWeight,
    /// Weight of one block (N).
    BlockWeight,
    /// What the gauge shows of a target that does not move (m).
    FixedTarget,
    /// Push along a sheared wall when it first came to a drift (N).
    ForceAtDrift,
    /// Whether the wall fell or stood under a motion of its base.
    Outcome,
    /// Largest displacement against the base, under a motion of it, of a stone that did not fall (m).
    PeakDisplacement,
    /// What is left of the displacements when the motion has ended, the largest of any stone (m).
    ResidualDisplacement,
}

impl MeasuredQuantity {
    /// All of them.
    pub const ALL: [MeasuredQuantity; 20] = [
        MeasuredQuantity::CollapseAngle,
        MeasuredQuantity::DisplacementLeft,
        MeasuredQuantity::DisplacementCentre,
        MeasuredQuantity::DisplacementRight,
        MeasuredQuantity::DisplacementMean,
        MeasuredQuantity::DisplacementCentreMinusEnds,
        MeasuredQuantity::RemainderLeft,
        MeasuredQuantity::RemainderCentre,
        MeasuredQuantity::RemainderRight,
        MeasuredQuantity::RemainderMean,
        MeasuredQuantity::RemainderCentreMinusEnds,
        MeasuredQuantity::JointKn,
        MeasuredQuantity::JointPhi,
        MeasuredQuantity::SpecimenWeight,
        MeasuredQuantity::BlockWeight,
        MeasuredQuantity::FixedTarget,
        MeasuredQuantity::ForceAtDrift,
        MeasuredQuantity::Outcome,
        MeasuredQuantity::PeakDisplacement,
        MeasuredQuantity::ResidualDisplacement,
    ];

    /// Name in files.
    pub fn name(self) -> &'static str {
        match self {
            MeasuredQuantity::CollapseAngle => "collapse_angle",
            MeasuredQuantity::DisplacementLeft => "displacement_left",
            MeasuredQuantity::DisplacementCentre => "displacement_centre",
            MeasuredQuantity::DisplacementRight => "displacement_right",
            MeasuredQuantity::DisplacementMean => "displacement_mean",
            MeasuredQuantity::DisplacementCentreMinusEnds => "displacement_centre_minus_ends",
            MeasuredQuantity::RemainderLeft => "remainder_left",
            MeasuredQuantity::RemainderCentre => "remainder_centre",
            MeasuredQuantity::RemainderRight => "remainder_right",
            MeasuredQuantity::RemainderMean => "remainder_mean",
            MeasuredQuantity::RemainderCentreMinusEnds => "remainder_centre_minus_ends",
            MeasuredQuantity::JointKn => "joint_kn",
            MeasuredQuantity::JointPhi => "joint_phi",
            MeasuredQuantity::SpecimenWeight => "specimen_weight",
            MeasuredQuantity::BlockWeight => "block_weight",
            MeasuredQuantity::FixedTarget => "fixed_target",
            MeasuredQuantity::ForceAtDrift => "force_at_drift",
            MeasuredQuantity::Outcome => "outcome",
            MeasuredQuantity::PeakDisplacement => "peak_displacement",
            MeasuredQuantity::ResidualDisplacement => "residual_displacement",
        }
    }

    /// The quantity of that name.
    pub fn named(name: &str) -> Option<MeasuredQuantity> {
        Self::ALL.into_iter().find(|quantity| quantity.name() == name)
    }

    /// What it is, as far as its units go.
    pub fn dimension(self) -> Dimension {
        match self {
            MeasuredQuantity::CollapseAngle | MeasuredQuantity::JointPhi => Dimension::Angle,
            MeasuredQuantity::JointKn => Dimension::Stiffness,
            MeasuredQuantity::SpecimenWeight
            | MeasuredQuantity::BlockWeight
            | MeasuredQuantity::ForceAtDrift => Dimension::Force,
            MeasuredQuantity::Outcome => Dimension::Outcome,
            _ => Dimension::Length,
        }
    }

    /// The quantities that are read at a tilt, each with what is left of it when the platform has gone back from there.
    const LEFT_OF: [(MeasuredQuantity, MeasuredQuantity); 5] = [
        (MeasuredQuantity::DisplacementLeft, MeasuredQuantity::RemainderLeft),
        (MeasuredQuantity::DisplacementCentre, MeasuredQuantity::RemainderCentre),
        (MeasuredQuantity::DisplacementRight, MeasuredQuantity::RemainderRight),
        (MeasuredQuantity::DisplacementMean, MeasuredQuantity::RemainderMean),
        (MeasuredQuantity::DisplacementCentreMinusEnds, MeasuredQuantity::RemainderCentreMinusEnds),
    ];

    /// What is left of a displacement when the platform has gone back; `None` for any other quantity.
    pub fn remainder(self) -> Option<MeasuredQuantity> {
        Self::LEFT_OF.into_iter().find(|(whole, _)| *whole == self).map(|(_, left)| left)
    }

    /// The displacement that it is a remainder of; `None` for any other quantity.
    pub fn remains_of(self) -> Option<MeasuredQuantity> {
        Self::LEFT_OF.into_iter().find(|(_, left)| *left == self).map(|(whole, _)| whole)
    }

    /// Whether it is what is left of a displacement when the platform has gone back.
    pub fn is_remainder(self) -> bool {
        self.remains_of().is_some()
    }

    /// Whether it is measured apart from the loading of walls.
    pub fn is_apart(self) -> bool {
        !self.has_tilt() && !self.has_drift() && !self.is_shaken() && self != MeasuredQuantity::CollapseAngle
    }

    /// Whether it is read at a drift of the wall.
    pub fn has_drift(self) -> bool {
        self == MeasuredQuantity::ForceAtDrift
    }

    /// Whether it is read under a motion of the base.
    pub fn is_shaken(self) -> bool {
        use MeasuredQuantity as Q;
        matches!(self, Q::Outcome | Q::PeakDisplacement | Q::ResidualDisplacement)
    }

    /// The quantity that stands for all that share its common error: what a gauge is off at every point of a wall it is off at all of
    /// them, on the way up, after going back, and on a target that does not move. A difference of points is free of that, and has its own.
    pub fn instrument(self) -> MeasuredQuantity {
        use MeasuredQuantity as Q;
        match self {
            Q::DisplacementCentreMinusEnds | Q::RemainderCentreMinusEnds => Q::DisplacementCentreMinusEnds,
            Q::PeakDisplacement | Q::ResidualDisplacement => Q::PeakDisplacement,
            other if other.dimension() == Dimension::Length => Q::DisplacementMean,
            other => other,
        }
    }

    /// How it stands to its tilt: what remains is read after it.
    pub fn at_or_after(self) -> &'static str {
        if self.is_remainder() { "after" } else { "at" }
    }

    /// Whether it is read at a tilt of the platform, or after it has gone back from one.
    pub fn has_tilt(self) -> bool {
        self.dimension() == Dimension::Length && self != MeasuredQuantity::FixedTarget && !self.is_shaken()
    }
}
