//! Kinds of joint, and on which of them a cause acts.

use crate::critic::simulate::causes::{Causes, Scope};
use crate::critic::simulate::truth::Truth;
use crate::critic::simulate::world::World;
use crate::random::Streams;
use crate::study::{Acts, Arm, Parameter};

/// What a score of a truth's parameters is of.
#[derive(Clone, Copy, Debug)]
pub struct Scored<'s> {
    /// Index of the mechanism.
    pub cause: usize,
    /// Its parameter.
    pub parameter: &'s Parameter,
    /// The kind of joint that it acts on; none where that is every one.
    pub kind: Option<usize>,
}

impl<'s> World<'s> {
    /// Kinds of joints that differ in what is stated of them.
    pub fn joint_kinds(&self) -> usize {
        self.kinds.iter().max().map_or(0, |last| last + 1)
    }

    /// The kind of joint of an arm.
    pub fn kind(&self, arm: usize) -> usize {
        self.kinds[arm]
    }

    /// The kinds of joint on which a cause acts with a scope, ascending; none where it acts on everything.
    pub fn kinds_of(&self, cause: usize, scope: Scope) -> Option<Vec<usize>> {
        match scope {
            Scope::All => None,
            Scope::Kind(kind) => Some(vec![kind]),
            Scope::Each => Some(self.acted[cause].clone()),
        }
    }

    /// The scopes that a cause may have, each with its probability beforehand: on all joints alike in one half of the cases, the others
    /// evenly. What acts on anything else than joints, or on those of one kind alone, has one.
    pub fn scopes(&self, cause: usize) -> Vec<(Scope, f64)> {
        let kinds = &self.acted[cause];
        if kinds.len() < 2 || self.mechanisms[cause].acts != Acts::Joints {
            return vec![(Scope::All, 1.0)];
        }
        let rest = 0.5 / (kinds.len() + 1) as f64;
        let others = kinds.iter().map(|kind| Scope::Kind(*kind)).chain([Scope::Each]);
        std::iter::once((Scope::All, 0.5)).chain(others.map(|scope| (scope, rest))).collect()
    }

    /// The models of a cause, one for each [scope](Self::scopes), each with its probability beforehand; of none the base model.
    pub fn models(&self, cause: Option<usize>) -> Vec<(Causes, f64)> {
        let Some(cause) = cause else { return vec![(Causes::default(), 1.0)] };
        self.scopes(cause).into_iter().map(|(scope, p)| (Causes::one(cause, scope), p)).collect()
    }

    /// One of the [models](Self::models) of a cause, drawn.
    pub fn scoped(&self, cause: Option<usize>, streams: &Streams) -> Causes {
        let models = self.models(cause);
        let mut left = streams.of("scope").uniform();
        let chosen = models.iter().find(|(_, p)| {
            left -= p;
            left < 0.0
        });
        chosen.unwrap_or(&models[0]).0
    }

    /// What each score of a truth's parameters is of, in their order: those of a cause kind by kind, where each has its own.
    pub fn scored(&self, causes: impl Into<Causes>) -> impl Iterator<Item = Scored<'s>> {
        let mechanisms = self.mechanisms;
        let sets = causes.into().scoped().flat_map(|(cause, scope)| {
            let kinds = self.kinds_of(cause, scope);
            let kinds = kinds.map_or(vec![None], |kinds| kinds.into_iter().map(Some).collect());
            kinds.into_iter().map(move |kind| (cause, kind))
        });
        let scores = move |(cause, kind): (usize, Option<usize>)| {
            mechanisms[cause].parameters.iter().map(move |parameter| Scored { cause, parameter, kind })
        };
        sets.flat_map(scores)
    }

    /// The parameters of the causes of a truth, in the units of their keys, each [in its place](Self::scored).
    pub fn parameters(&self, truth: &Truth) -> Vec<f64> {
        let scored = self.scored(truth.causes).zip(&truth.parameters);
        scored.map(|(scored, score)| scored.parameter.search.at_score(*score)).collect()
    }

    /// Each cause of a truth that acts on joints of a kind, with the scores of its parameters there.
    pub(super) fn acting<'t>(
        &self,
        truth: &'t Truth,
        kind: usize,
    ) -> impl Iterator<Item = (usize, &'t [f64])> {
        let mut left = &truth.parameters[..];
        truth.causes.scoped().filter_map(move |(cause, scope)| {
            let (count, each) = (self.mechanisms[cause].parameters.len(), &self.acted[cause]);
            let sets = if scope == Scope::Each { each.len() } else { 1 };
            let (scores, others) = left.split_at(sets * count);
            left = others;
            let set = match scope {
                Scope::All => 0,
                Scope::Kind(only) => (only == kind).then_some(0)?,
                Scope::Each => each.iter().position(|acted| *acted == kind)?,
            };
            Some((cause, &scores[set * count..(set + 1) * count]))
        })
    }
}

/// Numbers the kinds of joints.
pub(super) fn kinds(arms: &[Arm]) -> Vec<usize> {
    let mut seen: Vec<&Arm> = Vec::new();
    arms.iter()
        .map(|arm| {
            let same_joints = |other: &&Arm| other.joint == arm.joint && other.kn_points == arm.kn_points;
            seen.iter().position(same_joints).unwrap_or_else(|| {
                seen.push(arm);
                seen.len() - 1
            })
        })
        .collect()
}
