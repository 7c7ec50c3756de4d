//! A figure within a page: its SVG with a name and a description for those who do not see it.

use serde::Serialize;

use crate::render::document::ReadOff;
use crate::render::markup::escaped;

/// A figure of a page.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Drawing {
    /// What links lead to it by; once in a page.
    pub id: String,
    /// What it shows.
    pub caption: String,
    /// Its SVG.
    pub svg: String,
    /// The numbers behind it as JSON, where they can be read off.
    pub chart: Option<String>,
}

impl Drawing {
    /// A picture: a reader of screens meets it as one thing, with its title and its caption.
    pub fn picture(id: &str, title: &str, caption: &str, svg: &str) -> Drawing {
        Drawing::of(id, (title, caption), svg, "img")
    }

    /// A picture that says itself what its caption need not repeat.
    pub fn described(id: &str, title: &str, described: &str, svg: &str) -> Drawing {
        Drawing { caption: title.to_owned(), ..Drawing::of(id, (title, described), svg, "img") }
    }

    /// A figure whose marks are links: a reader of screens goes into it.
    pub fn with_links(id: &str, title: &str, caption: &str, svg: &str) -> Drawing {
        Drawing::of(id, (title, caption), svg, "group")
    }

    /// With the numbers behind it, if there are any. They stand in a script: what would end it is written out.
    pub(crate) fn with_numbers(self, numbers: Option<&ReadOff>) -> Drawing {
        let written =
            |numbers: &ReadOff| serde_json::to_string(numbers).ok().map(|text| text.replace('<', "\\u003c"));
        Drawing { chart: numbers.and_then(written), ..self }
    }

    fn of(id: &str, (title, described): (&str, &str), svg: &str, role: &str) -> Drawing {
        // An SVG of ours begins with its own tag.
        let (tag, rest) = svg.split_once('>').unwrap_or((svg, ""));
        let (title, caption) = (escaped(title), described.to_owned());
        let described = escaped(described);
        let svg = format!(
            "{tag} role=\"{role}\" aria-labelledby=\"{id}-title {id}-desc\"><title id=\"{id}-title\">{title}</title>\
             <desc id=\"{id}-desc\">{described}</desc>{rest}"
        );
        Drawing { id: id.to_owned(), caption, svg, chart: None }
    }
}
