//! Sketches of the causes: what each one is of a wall or of a test, at a glance.

use crate::render::document::Drawing;
use crate::study::Cause;

/// The sketch of a cause.
pub fn sketch(name: &str, title: &str) -> Drawing {
    let cause = Cause::named(name);
    crate::check!(cause.is_some(), "no sketch of {name}");
    let (svg, described) = cause
        .map_or(("<svg xmlns=\"http://www.w3.org/2000/svg\"></svg>", title), |cause| {
            (cause.sketch, cause.shows)
        });
    Drawing::described(&format!("sketch-{name}"), title, described, svg)
}

#[cfg(test)]
mod tests {
    use crate::study::CAUSES;

    #[test]
    fn every_mechanism_has_a_sketch_and_a_description() {
        for cause in CAUSES {
            let (name, described, svg) = (cause.name, cause.shows, cause.sketch);
            assert!(described.ends_with('.') && described.len() > 20, "{name}: {described}");
            assert!(svg.starts_with("<svg ") && svg.trim_end().ends_with("</svg>"), "{name}");
        }
    }
}
