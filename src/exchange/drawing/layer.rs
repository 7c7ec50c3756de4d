//! What the name of a layer, a group or a property says of the lines in it.

use crate::face::Part;

/// Words of what the wall stands on, in the languages in which walls are drawn.
const GROUND: [&str; 28] = [
    "base",
    "bedrock",
    "boden",
    "cimiento",
    "earth",
    "fixed",
    "floor",
    "fondation",
    "fondazione",
    "footing",
    "foundation",
    "fundacion",
    "fundación",
    "fundament",
    "gelände",
    "ground",
    "platform",
    "plattform",
    "sockel",
    "soil",
    "sol",
    "subsoil",
    "suelo",
    "suolo",
    "support",
    "terrain",
    "terreno",
    "untergrund",
];
/// Words of holes in the wall.
const OPENING: [&str; 24] = [
    "abertura",
    "apertura",
    "aussparung",
    "door",
    "doorway",
    "fenster",
    "fenêtre",
    "finestra",
    "gap",
    "gate",
    "hole",
    "hueco",
    "niche",
    "opening",
    "ouverture",
    "porta",
    "porte",
    "puerta",
    "tor",
    "tür",
    "vano",
    "ventana",
    "void",
    "window",
];
/// Words of stones that go through the wall.
const HEADER: [&str; 18] = [
    "ankerstein",
    "binder",
    "bondstone",
    "boutisse",
    "diatone",
    "diatoni",
    "diatono",
    "durchbinder",
    "header",
    "llave",
    "parpaing",
    "pasante",
    "passante",
    "perpiaño",
    "through",
    "throughstone",
    "tizon",
    "tizón",
];
/// Words of what is drawn about a wall and is no part of it.
const PASSED: [&str; 51] = [
    "achse",
    "acotacion",
    "annotation",
    "anno",
    "axe",
    "axes",
    "axis",
    "background",
    "bemassung",
    "bemaßung",
    "border",
    "cartouche",
    "center",
    "centerline",
    "centreline",
    "cota",
    "cotation",
    "crack",
    "defpoints",
    "dim",
    "dimension",
    "eje",
    "frame",
    "fuge",
    "fugen",
    "grid",
    "guide",
    "hatch",
    "hatching",
    "hilfslinien",
    "joint",
    "junta",
    "label",
    "legend",
    "legende",
    "leader",
    "marco",
    "mortar",
    "note",
    "rahmen",
    "raster",
    "scale",
    "schnitt",
    "schraffur",
    "section",
    "sombreado",
    "texto",
    "text",
    "title",
    "viewport",
    "watermark",
];

/// What is done with the lines of a layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shown {
    /// They are outlines.
    Part(Part),
    /// They are no part of the wall.
    Passed,
}

/// What a name says: stones, unless one of its words says otherwise. `Hatch of the ground` is a hatch.
pub(super) fn shown(name: &str) -> Shown {
    let words = words(name);
    let has = |list: &[&str]| words.iter().any(|word| list.iter().any(|own| is(word, own)));
    if has(&PASSED) {
        Shown::Passed
    } else if has(&OPENING) {
        Shown::Part(Part::Opening)
    } else if has(&GROUND) {
        Shown::Part(Part::Ground)
    } else if has(&HEADER) {
        Shown::Part(Part::Header)
    } else {
        Shown::Part(Part::Stone)
    }
}

/// Whether two words are the same but for a plural.
fn is(word: &str, own: &str) -> bool {
    word == own || word.strip_suffix('s') == Some(own) || word.strip_suffix("es") == Some(own)
}

/// The words of a name in small letters; `GroundLine_2` has two.
fn words(name: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut after_small = false;
    for c in name.chars() {
        let begins = !c.is_alphabetic() || (after_small && c.is_uppercase());
        if begins && words.last().is_some_and(|word| !word.is_empty()) {
            words.push(String::new());
        }
        if let Some(word) = words.last_mut().filter(|_| c.is_alphabetic()) {
            word.extend(c.to_lowercase());
        }
        after_small = c.is_lowercase();
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_any_case_and_number_tell_the_part() {
        let part = |name: &str| match shown(name) {
            Shown::Part(part) => Some(part),
            Shown::Passed => None,
        };
        for stones in ["", "0", "STONES", "Steine_2", "basement", "void-free?no", "Texture"] {
            let expected = if stones.starts_with("void") { Part::Opening } else { Part::Stone };
            assert_eq!(part(stones), Some(expected), "{stones}");
        }
        for header in ["Headers", "through-stones", "DIATONI", "Binder 3", "bondstones"] {
            assert_eq!(part(header), Some(Part::Header), "{header}");
        }
        for ground in ["Ground", "GroundLine_2", "A-BASE-01", "gelände", "fixed blocks", "SUELO"] {
            assert_eq!(part(ground), Some(Part::Ground), "{ground}");
        }
        for opening in ["Windows", "TÜR", "door 1", "VOID"] {
            assert_eq!(part(opening), Some(Part::Opening), "{opening}");
        }
        for other in ["TEXT", "Dimensions", "ground hatch", "A_JOINTS", "Defpoints", "Schraffur"] {
            assert_eq!(part(other), None, "{other}");
        }
    }
}
