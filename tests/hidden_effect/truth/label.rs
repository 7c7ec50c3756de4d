//! What is hidden in a campaign, as it is written down and sealed.

use pirca::study::Study;
use serde::{Deserialize, Serialize};

use super::decoys::decoy;
use super::effect::Effect;
use super::laws::{self, LAWS};
use super::strength::{Strength, Within};
use super::unknown::UNKNOWN;
use super::variants::other_code;

/// Why a campaign is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Group {
    /// Nothing is hidden.
    Nothing,
    /// Nothing but joints that are far from where they are thought to be.
    PriorWrong,
    /// A mechanism of the catalogue, within its search prior.
    Mechanism,
    /// A mechanism as another code has it.
    OtherCode,
    /// A mechanism further from the centre of its physical prior than anybody expects.
    Outside,
    /// Joints that close along a law of no catalogue.
    Law,
    /// Two mechanisms.
    Pair,
    /// An effect that is in no catalogue.
    Unknown,
    /// A blunder.
    Decoy,
}

impl Group {
    pub const ALL: [Group; 9] = [
        Group::Nothing,
        Group::PriorWrong,
        Group::Mechanism,
        Group::OtherCode,
        Group::Outside,
        Group::Law,
        Group::Pair,
        Group::Unknown,
        Group::Decoy,
    ];

    pub fn name(self) -> &'static str {
        [
            "nothing hidden",
            "prior wrong",
            "mechanisms",
            "another code",
            "outside the prior",
            "laws",
            "pairs",
            "out of the catalogue",
            "decoys",
        ][self as usize]
    }
}

/// Something hidden.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hidden {
    pub name: String,
    /// Of a mechanism, and the prior that it was drawn from.
    pub strength: Option<(Strength, Within)>,
    /// Standard deviations of its physical prior from its centre, where it lies outside.
    pub spreads: Option<u32>,
    /// Its parameters, by key and in the key's unit.
    pub parameters: Vec<(String, f64)>,
}

/// What is true of a campaign.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Label {
    pub group: Group,
    /// Seed of its stones, joints and errors.
    pub seed: u64,
    /// Scores in their priors of kn, the friction angle and kn over ks, for blocks and for stones.
    pub joints: [[f64; 3]; 2],
    pub hidden: Vec<Hidden>,
}

impl Hidden {
    pub fn value(&self, key: &str) -> f64 {
        let own = self.parameters.iter().find(|(own, _)| own == key);
        own.unwrap_or_else(|| panic!("{} has no {key}", self.name)).1
    }

    fn effect(&self, group: Group) -> Box<dyn Effect> {
        match group {
            Group::Unknown => {
                let unknown = UNKNOWN.iter().find(|unknown| unknown.name == self.name).expect("it is listed");
                let values: Vec<f64> = unknown.parameters.iter().map(|(key, ..)| self.value(key)).collect();
                (unknown.effect)(&values)
            }
            Group::Decoy => decoy(&self.name, self.value("which")),
            Group::OtherCode => other_code(&self.name, &|key| self.value(key)),
            Group::Law => Box::new(laws::Hidden {
                law: LAWS.iter().find(|law| law.name == self.name).expect("it is listed"),
                soft_share: self.value("soft_share"),
                knee: self.value("knee_pa"),
            }),
            _ => Box::new(OurCode(self.clone())),
        }
    }
}

impl Label {
    /// What it is one of so many of.
    pub fn kind(&self) -> String {
        match (self.group, &self.hidden[..]) {
            (Group::Nothing, _) => "nothing".to_owned(),
            (Group::PriorWrong, _) => "prior wrong".to_owned(),
            (Group::Mechanism, [Hidden { name, strength: Some((strength, _)), .. }]) => {
                format!("{name} {}", strength.name())
            }
            (Group::OtherCode, [hidden]) => format!("{} in another code", hidden.name),
            (Group::Outside, [Hidden { name, spreads: Some(spreads), .. }]) => {
                format!("{name} {spreads} out")
            }
            (Group::Pair, _) => "pair".to_owned(),
            (_, hidden) => hidden[0].name.clone(),
        }
    }

    /// All that is hidden.
    pub fn effects(&self) -> Vec<Box<dyn Effect>> {
        self.hidden.iter().map(|hidden| hidden.effect(self.group)).collect()
    }
}

/// A mechanism as the catalogue has it.
struct OurCode(Hidden);

impl Effect for OurCode {
    fn study(&self, study: Study) -> Study {
        let values: Vec<(&str, f64)> = self.0.parameters.iter().map(|(key, x)| (key.as_str(), *x)).collect();
        study.with_mechanism(&self.0.name, &values).unwrap_or_else(|faults| panic!("{faults}")).study
    }
}
