//! The commands of a 3DEC file: words between spaces, commas, brackets and equal signs, over lines that go on.

/// Most words of a command; a block with more of them is no stone.
pub(super) const MOST_WORDS: usize = 100_000;

/// A word of a command.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Word<'a> {
    pub text: &'a str,
    /// Whether it stands in quotes, and so is a name.
    pub is_quoted: bool,
}

impl Word<'_> {
    /// Whether it is a keyword, of which the first `least` letters are enough.
    pub fn is(&self, keyword: &str, least: usize) -> bool {
        let beginning = keyword.get(..self.text.len());
        !self.is_quoted
            && self.text.len() >= least
            && beginning.is_some_and(|own| own.eq_ignore_ascii_case(self.text))
    }

    /// The number that it is.
    pub fn number(&self) -> Option<f64> {
        let is_number =
            !self.is_quoted && self.text.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c));
        self.text.parse().ok().filter(|own: &f64| is_number && own.is_finite())
    }
}

/// A command with the line on which it begins, from 1.
#[derive(Debug, Default)]
pub(super) struct Command<'a> {
    pub line: usize,
    pub words: Vec<Word<'a>>,
    /// Whether it has more words than are kept.
    pub is_too_long: bool,
}

impl Command<'_> {
    /// Its beginning, as messages quote it.
    pub fn shown(&self) -> String {
        let words: Vec<&str> = self.words.iter().take(6).map(|word| word.text).collect();
        words.join(" ").chars().filter(|c| !c.is_control() && *c != '"').take(50).collect()
    }
}

/// The commands of a text. A line that ends with `&` or `...` goes on in the next; what follows a semicolon is a remark. The line that
/// follows a `title` by itself is one.
pub(super) fn commands(text: &str) -> impl Iterator<Item = Command<'_>> {
    let mut lines = (1..).zip(text.lines());
    std::iter::from_fn(move || {
        let mut command = Command::default();
        loop {
            let Some((number, line)) = lines.next() else {
                return (!command.words.is_empty()).then_some(command);
            };
            if command.words.is_empty() {
                command.line = number;
            }
            let goes_on = split(line, &mut command);
            if let [only] = command.words[..]
                && ["title", "heading"].iter().any(|name| only.is(name, 4))
            {
                lines.next();
            }
            if !goes_on && !command.words.is_empty() {
                return Some(command);
            }
        }
    })
}

/// Adds the words of a line to a command; whether it goes on in the next line.
fn split<'a>(line: &'a str, command: &mut Command<'a>) -> bool {
    let mut rest = line;
    loop {
        rest = rest.trim_start_matches(|c: char| c.is_whitespace() || "(),=".contains(c));
        let after = |mark: &str| rest.strip_prefix(mark).map(|rest| rest.trim_start());
        let Some(first) = rest.chars().next().filter(|c| *c != ';') else { return false };
        if let Some(end) = after("&").or_else(|| after("..."))
            && (end.is_empty() || end.starts_with(';'))
        {
            return true;
        }
        let (word, more) = match first {
            '\'' | '"' => quoted(rest, first),
            // A calculation of FISH is one word.
            '[' => rest.split_once(']').map_or((rest, ""), |(own, more)| (&rest[..own.len() + 1], more)),
            _ => {
                let ends = |c: char| c.is_whitespace() || "(),=;&".contains(c);
                rest.split_at(rest.find(ends).unwrap_or(rest.len()).max(first.len_utf8()))
            }
        };
        // `0.5...` goes on as well as `0.5 ...`.
        let (word, more) = match word.strip_suffix("...") {
            Some(own) if more.trim_start().is_empty() && !own.is_empty() && first != '[' => (own, "..."),
            _ => (word, more),
        };
        rest = more;
        command.is_too_long |= command.words.len() >= MOST_WORDS;
        if !command.is_too_long {
            command.words.push(Word { text: word, is_quoted: "'\"".contains(first) });
        }
    }
}

/// A name between quotes, and what follows it.
fn quoted(rest: &str, mark: char) -> (&str, &str) {
    rest[1..].split_once(mark).unwrap_or((&rest[1..], ""))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_go_over_lines_and_remarks_are_none() {
        let text = "; a remark\n\npoly Brick (0,1) &   ; goes on\n0 .5...\n -1e-1 1 r=3 group 'a; b'; ends\nTITLE\nfix all\nnew [a = (1, 2)]\ncut &";
        let all: Vec<Command> = commands(text).collect();
        let words = |at: usize| all[at].words.iter().map(|word| word.text).collect::<Vec<_>>();
        assert_eq!(words(0), ["poly", "Brick", "0", "1", "0", ".5", "-1e-1", "1", "r", "3", "group", "a; b"]);
        assert_eq!((words(1), words(2), words(3)), (vec!["TITLE"], vec!["new", "[a = (1, 2)]"], vec!["cut"]));
        assert_eq!(all.iter().map(|own| own.line).collect::<Vec<_>>(), [3, 6, 8, 9]);
        assert!(
            all[0].words[11].is_quoted && all[0].words[1].is("brick", 3) && !all[0].words[0].is("brick", 1)
        );
        assert_eq!(all[0].words[5].number(), Some(0.5));
        assert_eq!(["nan", "1e999", "1,2"].map(|text| Word { text, is_quoted: false }.number()), [None; 3]);
    }
}
