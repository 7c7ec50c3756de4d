//! A label is sealed before anything is judged: beside the data lies a hash of it that cannot be guessed, the label itself lies
//! elsewhere.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// What salts come from. Only this file has it; with it a run can be repeated.
const SECRET: &str = "what is hidden here is told at the end";

/// A label with the salt of its seal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sealed {
    salt: String,
    label: String,
}

impl Sealed {
    /// Seals a label.
    pub fn new(label: String) -> Sealed {
        Sealed { salt: sha256(&format!("{SECRET}\n{label}")), label }
    }

    /// The seal: it tells nothing of the label, and fits no other.
    pub fn seal(&self) -> String {
        sha256(&format!("{}\n{}", self.salt, self.label))
    }

    /// The label, if it is the one that was sealed.
    pub fn opened(&self, seal: &str) -> Result<&str, String> {
        match self.seal() == seal {
            true => Ok(&self.label),
            false => Err(format!("the label `{}` is not the one that was sealed as {seal}", self.label)),
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
        let sealed = Sealed::new(r#"{"hidden":"lean"}"#.to_owned());
        let seal = sealed.seal();
        assert_eq!(sealed.opened(&seal), Ok(r#"{"hidden":"lean"}"#));
        let other_label = Sealed { label: r#"{"hidden":"creep"}"#.to_owned(), ..sealed.clone() };
        let other_salt = Sealed { salt: sha256("another"), ..sealed.clone() };
        assert!(other_label.opened(&seal).is_err() && other_salt.opened(&seal).is_err());
        // Without the salt the seal is not the label's hash.
        assert_ne!(seal, sha256(r#"{"hidden":"lean"}"#));
        assert_eq!(Sealed::new(r#"{"hidden":"lean"}"#.to_owned()).seal(), seal);
    }
}
