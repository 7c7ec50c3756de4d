//! Numbers as Fortran and others write them.

/// The numbers of a word. Fortran's fields leave no blank between numbers that fill them: a number may be followed by another one that
/// begins with a sign (`-.1234E-01-.5678E-02`). Exponents are `E`, `D` or, of three digits, nothing but a sign (`.12-104`).
///
/// # Errors
/// What is wrong with the word, in words.
fn numbers(word: &str) -> Result<Vec<f64>, String> {
    let mut found = Vec::new();
    let mut rest = word;
    while !rest.is_empty() {
        let Some((mantissa, exponent, after)) = first(rest) else { return Err(fault(word)) };
        if !found.is_empty() && !rest.starts_with(['+', '-']) {
            return Err(fault(word));
        }
        let written = format!("{mantissa}e{}", if exponent.is_empty() { "0" } else { exponent });
        // A mantissa like `.` or `-` has no digit, which is refused here.
        match written.parse::<f64>() {
            Ok(value) if value.is_finite() => found.push(value),
            Ok(_) => return Err(format!("{:?} is beyond all numbers", shortened(word))),
            Err(_) => return Err(fault(word)),
        }
        rest = after;
    }
    Ok(found)
}

/// The numbers of a line.
///
/// # Errors
/// What is wrong with the first word that is none, in words.
pub(super) fn values(line: &str) -> Result<Vec<f64>, String> {
    let mut found = Vec::new();
    for word in line.split_whitespace() {
        found.extend(numbers(word)?);
    }
    Ok(found)
}

/// The one number that a word is.
///
/// # Errors
/// What is wrong with the word, in words.
pub(super) fn number(word: &str) -> Result<f64, String> {
    match numbers(word)?[..] {
        [one] => Ok(one),
        _ => Err(fault(word)),
    }
}

/// Mantissa and exponent (empty without one) of the number that a text begins with, and what follows.
fn first(text: &str) -> Option<(&str, &str, &str)> {
    let bytes = text.as_bytes();
    let digits = |from: usize| bytes[from..].iter().take_while(|byte| byte.is_ascii_digit()).count();
    let sign = |at: usize| usize::from(matches!(bytes.get(at), Some(b'+' | b'-')));
    let mut end = sign(0);
    end += digits(end);
    if bytes.get(end) == Some(&b'.') {
        end += 1 + digits(end + 1);
    }
    if end == sign(0) {
        return None;
    }
    let (begin, stop) = match bytes.get(end) {
        Some(b'e' | b'E' | b'd' | b'D') => {
            let after = end + 1 + sign(end + 1);
            let stop = after + digits(after);
            if stop == after {
                return None;
            }
            (end + 1, stop)
        }
        // Three digits and no more: else it is the next number.
        Some(b'+' | b'-')
            if digits(end + 1) == 3
                && !matches!(bytes.get(end + 4), Some(b'.' | b'e' | b'E' | b'd' | b'D')) =>
        {
            (end, end + 4)
        }
        _ => (end, end),
    };
    Some((&text[..end], &text[begin..stop], &text[stop..]))
}

fn fault(word: &str) -> String {
    let plain = word.trim_start_matches(['+', '-']).to_ascii_lowercase();
    let word = shortened(word);
    if plain.starts_with("nan") || plain.starts_with("inf") {
        format!("{word:?} stands among the values")
    } else if plain.starts_with('*') {
        format!("{word:?}: stars, where a value was too long for its field")
    } else if word.contains(',') {
        format!("{word:?} has a comma")
    } else {
        format!("{word:?} is no number")
    }
}

/// A word as a message quotes it.
pub(super) fn shortened(word: &str) -> String {
    let mut short: String = word.chars().take(40).collect();
    if short.len() < word.len() {
        short.push_str("...");
    }
    short
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fortran_is_read_with_and_without_blanks() {
        let good: [(&str, &[f64]); 12] = [
            ("0.5", &[0.5]),
            ("-.1234E-01-.5678E-02", &[-0.01234, -0.005678]),
            ("1.5D+00", &[1.5]),
            (".25d-1", &[0.025]),
            ("1.-2.5", &[1.0, -2.5]),
            (".12-104", &[0.12e-104]),
            (".12-104-.5", &[0.12e-104, -0.5]),
            ("0.12345-0.23456+3", &[0.12345, -0.23456, 3.0]),
            ("-.5-100.", &[-0.5, -100.0]),
            ("+7", &[7.0]),
            ("1E-400", &[0.0]),
            ("-0.1E+00-0.2E+00-0.3E+00", &[-0.1, -0.2, -0.3]),
        ];
        for (word, expected) in good {
            assert_eq!(numbers(word).as_deref(), Ok(expected), "{word}");
        }
    }

    #[test]
    fn what_is_no_number_is_told() {
        let bad = [
            ("1.2.3", "is no number"),
            ("1.5E", "is no number"),
            ("1E5E5", "is no number"),
            ("-", "is no number"),
            (".", "is no number"),
            ("0x10", "is no number"),
            ("1_000", "is no number"),
            ("NaN", "stands among the values"),
            ("-Infinity", "stands among the values"),
            ("*******", "stars"),
            ("0,5", "has a comma"),
            ("1E400", "beyond all numbers"),
            ("²", "is no number"),
        ];
        for (word, said) in bad {
            let found = numbers(word).unwrap_err();
            assert!(found.contains(said), "{word}: {found}");
        }
        assert!(number("-1-2").is_err());
    }
}
