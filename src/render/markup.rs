//! Text within SVG and HTML.

/// A text as markup shows it: what would be read as a tag, an entity or the end of an attribute is written out.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
