//! A label is sealed before anything is judged: beside the data lies a hash of it that cannot be guessed, the label itself lies
//! elsewhere.

use std::hash::{BuildHasher, Hasher, RandomState};

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// Length of a campaign's name.
const NAME: usize = 16;

/// What the salts of a run come from: nobody's choice, unless it is one that an earlier run has told at its end.
pub fn secret() -> String {
    let random = |_| RandomState::new().build_hasher().finish();
    sha256(&format!("{:?}", [0; 4].map(random)))
}

/// A label with the salt of its seal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sealed {
    salt: String,
    label: String,
}

impl Sealed {
    /// Seals a label with a run's secret.
    pub fn new(secret: &str, label: String) -> Sealed {
        Sealed { salt: sha256(&format!("{secret}\n{label}")), label }
    }

    /// The seal: it tells nothing of the label, and fits no other.
    pub fn seal(&self) -> String {
        sha256(&format!("{}\n{}", self.salt, self.label))
    }

    /// What the campaign is called: the beginning of its seal. No other label of the roster has the same.
    pub fn name(&self) -> String {
        self.seal()[..NAME].to_owned()
    }

    /// The label, if it is the one that was sealed under a name.
    pub fn opened(&self, name: &str) -> Result<&str, String> {
        match self.name() == name {
            true => Ok(&self.label),
            false => Err(format!("the label `{}` is not the one that was sealed as {name}", self.label)),
        }
    }
}

fn sha256(text: &str) -> String {
    Sha256::digest(text.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sealed_label_cannot_be_changed_unnoticed() {
        let label = r#"{"hidden":"lean"}"#;
        let sealed = Sealed::new("of this run", label.to_owned());
        let (seal, name) = (sealed.seal(), sealed.name());
        assert_eq!(sealed.opened(&name), Ok(label));
        assert!(seal.starts_with(&name) && name.len() == 16);
        let other_label = Sealed { label: r#"{"hidden":"creep"}"#.to_owned(), ..sealed.clone() };
        let other_salt = Sealed { salt: sha256("another"), ..sealed.clone() };
        assert!(other_label.opened(&name).is_err() && other_salt.opened(&name).is_err());
        // Without the salt the seal is not the label's hash.
        assert_ne!(seal, sha256(label));
        // Nor can it be guessed by who knows all labels, but not the run's secret; who is told it, finds the seal again.
        assert_ne!(Sealed::new("of another run", label.to_owned()).seal(), seal);
        assert_eq!(Sealed::new("of this run", label.to_owned()).seal(), seal);
        assert_ne!(secret(), secret());
    }
}
