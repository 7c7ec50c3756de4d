//! Texts on which a parser of XML would work for ever.

use crate::exchange::fault::Fault;

/// Most attributes of an element: the parser compares each with each.
const MOST_ATTRIBUTES: usize = 500;
/// Most letters that entities may declare, and the same times the places that may use one.
const MOST_DECLARED: usize = 8_192;
const MOST_REPLACED: usize = 1_000_000;

/// The fault of a file on which the parser would work for ever.
pub(super) fn overgrown(text: &str) -> Option<Fault> {
    let fault = |found: &str, allowed: String| Some(Fault::of("", found, allowed, "save it as plain SVG"));
    if let Some(begin) = text.find("<!ENTITY") {
        let end = text
            .rfind("<!ENTITY")
            .and_then(|last| Some(last + text[last..].find('>')?))
            .unwrap_or(text.len());
        let (declared, uses) = (end - begin, text.matches('&').count());
        if declared > MOST_DECLARED || declared * uses > MOST_REPLACED {
            return fault(
                "its entities are too large",
                format!("at most {MOST_DECLARED} letters, seldom used"),
            );
        }
    }
    let (mut quote, mut attributes) = (None, None);
    for (at, byte) in text.bytes().enumerate() {
        match (quote, byte) {
            (Some(own), _) if own == byte => quote = None,
            (Some(_), _) => {}
            (None, b'"' | b'\'') if attributes.is_some() => quote = Some(byte),
            (None, b'<') if !matches!(text.as_bytes().get(at + 1), Some(b'!' | b'?' | b'/')) => {
                attributes = Some(0)
            }
            (None, b'>') => attributes = None,
            (None, b'=') => attributes = attributes.map(|n| n + 1),
            _ => {}
        }
        if attributes > Some(MOST_ATTRIBUTES) {
            return fault("an element has too many attributes", format!("at most {MOST_ATTRIBUTES}"));
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn usual_drawings_pass_and_others_are_told() {
        let usual = "<!DOCTYPE svg [<!ENTITY ns 'http://x/'>]><svg xmlns:x='&ns;'><text>a=b=c</text></svg>";
        assert_eq!(overgrown(usual), None);
        let many = format!("<svg {}/>", "a='>' ".repeat(501));
        assert!(overgrown(&many).is_some_and(|fault| fault.found.contains("attributes")));
        assert_eq!(overgrown(&format!("<svg a='{}'/>", "a='".repeat(501).replace('\'', "\""))), None);
        let laughs =
            format!("<!DOCTYPE svg [<!ENTITY a '{}'>]><svg>{}</svg>", "a".repeat(5000), "&a;".repeat(201));
        assert!(overgrown(&laughs).is_some_and(|fault| fault.found.contains("entities")));
    }
}
