//! What is hidden in a campaign, as it is written down and sealed.

use pirca::study::Study;
use serde::{Deserialize, Serialize};

use super::decoys::decoy;
use super::effect::{Effect, TwoStones};
use super::strength::Strength;
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
    /// A mechanism of the catalogue.
    Mechanism,
    /// Two of them.
    Pair,
    /// An effect that is in no catalogue.
    Unknown,
    /// A blunder.
    Decoy,
}

/// Something hidden.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hidden {
    pub name: String,
    /// Of a mechanism.
    pub strength: Option<Strength>,
    /// Whether it is written in another code than the catalogue's.
    pub other_code: bool,
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
            _ if self.other_code => other_code(&self.name, &|key| self.value(key)),
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
            (Group::Mechanism, [Hidden { name, strength: Some(strength), .. }]) => {
                format!("{name} {}", strength.name())
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

    fn two_stones(&self, test: TwoStones) -> TwoStones {
        match self.0.name.as_str() {
            "contact_area" => TwoStones { kn: test.kn * self.0.value("share"), ..test },
            "friction" => TwoStones { tan_phi: test.tan_phi * self.0.value("factor"), ..test },
            _ => test,
        }
    }
}
