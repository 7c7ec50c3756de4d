//! The checked study: what every other module works from.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use crate::generate::{Arrangement, BatteredFace, Layout};
use crate::law::{ClosureTable, CohesionAfterSlip, Sampling};
use crate::protocol::{BaseMotion, Contacts, FailureMode, Protocol, Restraint, Shear};
use crate::random::standard_normal::{cdf, quantile};
use crate::random::{Design, Family, Move, Place, Quantities, RANDOMISATIONS, Streams, Taken};
use crate::solve::Solver;
use crate::stats::Statistic;
use crate::study::bearing::Bearing;
use crate::study::cause::Mechanisms;
use crate::study::demand::Demand;
use crate::study::earthquakes::Earthquakes;
use crate::study::measured::Measurement;
use crate::study::uncertain::{Uncertain, parameters};
use crate::study::variant;

/// A study whose every value has been checked.
#[derive(Clone, Debug, PartialEq)]
pub struct Study {
    /// Name: that of its folder.
    pub name: String,
    /// The question it answers, in words.
    pub question: String,
    /// Seed of all random streams.
    pub seed: u64,
    /// What the numbers of every member are moved by after they were drawn; none in a study from files.
    pub moves: Arc<[Move]>,
    /// What standard normals of parameters, by their streams, are shifted by after they were drawn; none in a study from files.
    pub shift: Arc<[(&'static str, f64)]>,
    /// How what is drawn once per wall covers its space.
    pub design: Design,
    /// Quantities of which every wall has the numbers of another member; none in a study from files.
    pub taken: Option<TakenFrom>,
    /// Named variant that was asked for, if any.
    pub variant: Option<String>,
    /// The arms, in the order of the file.
    pub arms: Vec<Arm>,
    /// What a sweep set in its arms; empty where there is none.
    pub sweep: Vec<SweptArm>,
    /// What is done to each wall.
    pub protocol: Protocol,
    /// The records of walls that are shaken, with the intensities that they are scaled to; `None` of other protocols.
    pub earthquakes: Option<Earthquakes>,
    /// Which solver, with its settings.
    pub solver: Solver,
    /// Whether limit analysis is asked about every wall as well.
    pub agreement: bool,
    /// Statements of other codes or papers to compare with, from published.toml.
    pub published: Vec<Claim>,
    /// What was measured on specimens of the arms, from measured.csv; decides no simulated result.
    pub measured: Vec<Measurement>,
    /// What its walls must bear, or how far they may move; none in a study from files, and decides no simulated result.
    pub demand: Option<Demand>,
    /// Every input file with its SHA-256, in the order read.
    pub inputs: Vec<InputFile>,
    /// Every value that decides a result, after the variant has been applied and with defaults and referenced
    /// distributions filled in, by the path of its key.
    pub effective: BTreeMap<String, String>,
    /// SHA-256 (hex) over [`Study::effective`]; comments, layout and prose do not matter. Guards results against
    /// mixing, never keys a random stream.
    pub hash: String,
}

/// An arm that a sweep made.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct SweptArm {
    /// Its name.
    pub arm: String,
    /// Name of the arm of the file that it was made from.
    pub of: String,
    /// What was set, key by key in the order of their names.
    pub settings: Vec<SweptValue>,
}

/// A key that a sweep has set.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct SweptValue {
    /// Path of the key, as the study writes it.
    pub key: String,
    /// Its value, as the study writes it.
    pub value: String,
    /// The value where it is a number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub number: Option<f64>,
}

/// Quantities of which walls have the numbers of another member.
#[derive(Clone, Debug, PartialEq)]
pub struct TakenFrom {
    /// Which quantities.
    pub quantities: Quantities,
    /// The other member.
    pub member: u64,
}

/// One arm: a population of walls.
#[derive(Clone, Debug, PartialEq)]
pub struct Arm {
    /// Name, unique in the study.
    pub name: String,
    /// Number of walls, at least 1; at most so many where there may be enough before.
    pub members: u64,
    /// When there are enough walls; `None` where their number is fixed.
    pub until: Option<Until>,
    /// The curve over the walls' length that the arm is a point of, if any.
    pub curve: Option<String>,
    /// What each wall is asked to be.
    pub layout: Layout,
    /// Whether each wall as built is turned round on the platform by half a turn.
    pub turned: bool,
    /// Joint properties other than kn.
    pub joint: Joint,
    /// Normal stiffnesses of the joints (Pa/m), ascending: the points at which the arm is evaluated.
    pub kn_points: Vec<f64>,
    /// What holds each wall.
    pub restraint: Restraint,
    /// Vertical load (N) on walls that are sheared, where it is not the study's.
    pub vertical_load: Option<f64>,
    /// Sub-contacts of a joint along its two in-plane axes.
    pub sub_contacts: [u32; 2],
    /// Mechanisms beyond the base model; those that change layout, joints' families or restraint are in these already.
    pub mechanisms: Mechanisms,
    /// What is drawn once per wall in the place of the number stated.
    pub uncertain: Vec<Uncertain>,
}

impl Study {
    /// Whether its variant says itself what it sets a key to, as `--variant joint.phi_deg=32` does.
    pub fn is_asked_for(&self, key: &str) -> bool {
        self.variant.as_deref().is_some_and(|variant| variant::says(variant, key))
    }

    /// The random streams of a member: what is drawn once per wall by the study's design, all else by itself.
    pub fn streams(&self, member: u64) -> Streams {
        let own = self.placed(member).after(self.moves.clone());
        match &self.taken {
            Some(TakenFrom { quantities, member }) => {
                own.taking(Taken { quantities: quantities.clone(), from: self.placed(*member) })
            }
            None => own,
        }
    }

    fn placed(&self, member: u64) -> Streams {
        let streams = Streams::new(self.seed, member);
        if self.design == Design::Plain {
            let shifted = |&(stream, by): &(&'static str, f64)| {
                let drawn = streams.of(stream).uniform();
                (stream, cdf(quantile(drawn) + by).clamp(f64::EPSILON, 1.0 - f64::EPSILON))
            };
            let placed = self.shift.iter().map(shifted).collect();
            return streams.placed(placed);
        }
        let points = (self.walls_of_design() / RANDOMISATIONS).max(1);
        let place = Place { seed: self.seed, member, points };
        let placed = parameters(&self.arms).into_iter().filter_map(|parameter| {
            let uniform = self.design.uniform(place, parameter.stream, parameter.number())?;
            Some((parameter.stream, uniform))
        });
        streams.placed(placed.collect())
    }

    /// Walls of the arms that a design covers: all arms with more than one wall have as many.
    pub fn walls_of_design(&self) -> u64 {
        self.arms.iter().map(|arm| arm.members).max().unwrap_or(1)
    }

    /// Independent randomisations that its members share in turn; 1 where each is drawn by itself.
    pub fn randomisations(&self) -> u64 {
        if self.design == Design::Plain { 1 } else { RANDOMISATIONS }
    }

    /// Whether a wall depends on how many there are: each stratum of a Latin hypercube holds one.
    pub fn depends_on_members(&self) -> bool {
        self.design == Design::LatinHypercube
    }

    /// The study whose walls have the numbers of another member for some quantities.
    pub fn with_taken(mut self, taken: TakenFrom) -> Study {
        self.taken = Some(taken);
        self
    }

    /// The study with its members' numbers moved.
    pub fn with_moves(mut self, moves: Arc<[Move]>) -> Study {
        self.moves = moves;
        self
    }

    /// The study with the standard normals of parameters shifted, by their streams.
    pub fn with_shift(mut self, shift: Arc<[(&'static str, f64)]>) -> Study {
        self.shift = shift;
        self
    }

    /// What is done to the walls of an arm.
    pub fn protocol_of(&self, arm: &Arm) -> Protocol {
        match (self.protocol, arm.vertical_load) {
            (Protocol::Shear(shear), Some(vertical_load)) => {
                Protocol::Shear(Shear { vertical_load, ..shear })
            }
            (protocol, _) => protocol,
        }
    }

    /// What all motions of walls that are shaken have in common; `None` of other protocols.
    pub fn base_motion(&self) -> Option<BaseMotion> {
        match self.protocol {
            Protocol::BaseMotion(base) => Some(base),
            _ => None,
        }
    }

    /// The drifts at the ends of the steps of walls that are sheared, ascending; empty of others.
    pub fn drifts(&self) -> Vec<f64> {
        match self.protocol {
            Protocol::Shear(shear) => shear.drifts(),
            _ => Vec::new(),
        }
    }

    /// The arms, by index, of which something was measured.
    pub fn measured_arms(&self) -> Vec<usize> {
        let measured = |arm: &usize| self.measured.iter().any(|m| m.family == self.arms[*arm].name);
        (0..self.arms.len()).filter(measured).collect()
    }
}

/// When an arm has walls enough: half the width of a statistic's interval over the statistic lies below a bound at every stiffness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Until {
    /// The statistic of the study's quantity.
    pub of: Statistic,
    /// The bound (a number: 0.05 is 5 %).
    pub below: f64,
    /// Most walls, come what may.
    pub at_most: u64,
}

impl Arm {
    /// Whether its walls differ from one to the next: in their stones, in their joints, as a whole, or by a mechanism that draws.
    pub fn is_random(&self) -> bool {
        let drawn = |family: &Family| !matches!(family, Family::Constant { .. });
        let Joint { kn_factor, phi_deg, cohesion, bearing, .. } = &self.joint;
        let drawn_joints = [kn_factor, phi_deg, cohesion].into_iter().any(drawn) || bearing.is_some();
        !self.layout.is_fixed() || drawn_joints || self.mechanisms.draws() || !self.uncertain.is_empty()
    }

    /// Whether the section of its walls is known to have no back and no front.
    pub fn is_alike_from_both_sides(&self) -> bool {
        let outline = &self.layout.outline;
        if self.layout.arrangement.is_file() {
            return false;
        }
        outline.battered_face == BatteredFace::Both || outline.base_thickness == outline.top_thickness
    }

    /// How joints of its walls are found and divided.
    pub fn contacts(&self) -> Contacts {
        let closed = match self.layout.arrangement {
            Arrangement::File { touch, .. } => Some(touch),
            _ => None,
        };
        Contacts { closed, ..self.mechanisms.contacts(self.sub_contacts) }
    }

    /// The file that says where its stones are; `None` of walls that are drawn.
    pub fn file(&self) -> Option<&str> {
        match &self.layout.arrangement {
            Arrangement::File { file, .. } => Some(file),
            _ => None,
        }
    }

    /// The height (m) of the top of its walls above the plane z = 0.
    pub fn top(&self) -> f64 {
        match &self.layout.arrangement {
            Arrangement::File { wall, unseen, .. } => {
                let rise =
                    unseen.as_ref().map_or(0.0, |own| own.most_rise() * self.layout.outline.base_thickness);
                wall.bounds_of_stones().1.z + rise
            }
            _ => self.layout.outline.height,
        }
    }

    /// The middle of its points in kn, the lower of two.
    pub fn middle_point(&self) -> usize {
        self.kn_points.len().saturating_sub(1) / 2
    }
}

/// Joint properties; those that are families are drawn once per joint from a stream keyed by the pair of blocks.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Factor on the point's kn (mean 1 for pure scatter).
    pub kn_factor: Family,
    /// kn over ks.
    pub kn_over_ks: f64,
    /// Friction angle (deg, as stated; converted when the law is made).
    pub phi_deg: Family,
    /// Cohesion (Pa).
    pub cohesion: Family,
    /// Tensile strength (Pa).
    pub tension: f64,
    /// Compressive strength (Pa), if any.
    pub compressive_strength: Option<f64>,
    /// What happens to the cohesion of a sub-contact once it has slipped.
    pub cohesion_after_slip: CohesionAfterSlip,
    /// The normal law.
    pub normal_law: StatedLaw,
    /// Where stress is sampled.
    pub sampling: Sampling,
    /// The few points of a bed on which stones bear; `None` where they bear on the whole face.
    pub bearing: Option<Bearing>,
}

/// The normal law as a study states it.
#[derive(Clone, Debug, PartialEq)]
pub enum StatedLaw {
    /// [`NormalLaw::Linear`](crate::law::NormalLaw::Linear); its stiffness is the point's kn.
    Linear,
    /// [`NormalLaw::Table`](crate::law::NormalLaw::Table); the point's kn gives the shear stiffness alone.
    Table(Box<ClosureTable>),
}

impl StatedLaw {
    /// The law of joints that are so many times as stiff as stated; what hangs on kn goes with kn.
    pub fn scaled(&self, factor: f64) -> StatedLaw {
        match self {
            StatedLaw::Linear => StatedLaw::Linear,
            StatedLaw::Table(table) => StatedLaw::Table(Box::new(table.scaled(factor))),
        }
    }
}

/// A statement of somebody else's about the quantity that the study computes.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// The statement, in our words.
    pub claim: String,
    /// Where it stands.
    pub source: String,
    /// How it is judged.
    pub test: ClaimTest,
    /// Why the tolerance is what it is.
    pub why: String,
}

/// How a statement is judged against our numbers.
#[derive(Clone, Debug, PartialEq)]
pub enum ClaimTest {
    /// Mean of one arm over the mean of another lies within [low, high] at every kn.
    RatioOfMeans {
        /// The arm above the line.
        arm: String,
        /// The arm below the line.
        over: String,
        /// The value stated.
        stated: f64,
        /// Lowest ratio that counts as reproduced.
        low: f64,
        /// Highest ratio that counts as reproduced.
        high: f64,
    },
    /// COV of an arm lies within [low, high] at every kn.
    Cov {
        /// The arm.
        arm: String,
        /// The value stated, in words ("0.21 to 0.25").
        stated: String,
        /// Lowest COV that counts as reproduced.
        low: f64,
        /// Highest COV that counts as reproduced.
        high: f64,
    },
    /// Mean of an arm lies within [low, high].
    Mean {
        /// The arm.
        arm: String,
        /// The joint stiffness of which it is said (Pa/m); `None` for every one.
        at_kn: Option<f64>,
        /// The value stated, in the unit of the quantity.
        stated: f64,
        /// Lowest mean that counts as reproduced.
        low: f64,
        /// Highest mean that counts as reproduced.
        high: f64,
    },
    /// Sine of the mean angle of one arm over that of another lies within [low, high]: on a tilting table the ratio of the
    /// out-of-plane forces at collapse over the weight.
    RatioOfSines {
        /// The arm above the line.
        arm: String,
        /// The arm below the line.
        over: String,
        /// The joint stiffness of which it is said (Pa/m); `None` for every one.
        at_kn: Option<f64>,
        /// The value stated.
        stated: f64,
        /// Lowest ratio that counts as reproduced.
        low: f64,
        /// Highest ratio that counts as reproduced.
        high: f64,
    },
    /// At least a share of an arm's walls fails as stated.
    Mechanism {
        /// The arm.
        arm: String,
        /// How it is said to fail, in words.
        stated: String,
        /// How the moving part moves; `None` where that is not said.
        mode: Option<FailureMode>,
        /// Smallest and largest share of the weight that moves.
        weight_share: [f64; 2],
        /// Smallest and largest share of the wall's length that moves by half of the largest movement or more.
        length_share: [f64; 2],
        /// Where along the wall it moves most, as shares of the length.
        place: [f64; 2],
        /// Share of the walls that must do so.
        least_share: f64,
    },
    /// The mean of an arm lies between the means of two others at every kn.
    Between {
        /// The arm in the middle.
        arm: String,
        /// The two others.
        of: [String; 2],
    },
    /// The mean of every arm falls as kn grows.
    FallsWithKn,
    /// The mean of every arm rises as kn grows.
    RisesWithKn,
}

/// An input file of a study and its hash.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InputFile {
    /// Path relative to the study's folder, or to the folder above its `distributions`.
    pub path: PathBuf,
    /// SHA-256 in hex.
    pub sha256: String,
}

impl ClaimTest {
    /// The arms that it speaks of; none where it speaks of all.
    pub fn arms(&self) -> Vec<&str> {
        match self {
            ClaimTest::RatioOfMeans { arm, over, .. } | ClaimTest::RatioOfSines { arm, over, .. } => {
                vec![arm, over]
            }
            ClaimTest::Mean { arm, .. } | ClaimTest::Cov { arm, .. } | ClaimTest::Mechanism { arm, .. } => {
                vec![arm]
            }
            ClaimTest::Between { arm, of } => vec![arm, &of[0], &of[1]],
            ClaimTest::FallsWithKn | ClaimTest::RisesWithKn => Vec::new(),
        }
    }
}
