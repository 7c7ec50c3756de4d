//! Keys of published.toml.

use crate::study::keys::{POSITIVE, SHARE, real};
use crate::study::schema::Presence::{Default, Optional, Required};
use crate::study::schema::{Interval, Key, Kind, Section};

/// published.toml as a whole.
pub static PUBLISHED: Section = Section {
    title: "published.toml",
    doc: "Statements of others to compare with; decides no result.",
    chooser: None,
    keys: &[&[Key::new("claim", Kind::Tables(&CLAIM), Required, "The statements.")]],
};

const RATIO: &[&str] = &["ratio_of_means", "ratio_of_sines"];
const NUMBER: &[&str] = &["ratio_of_means", "ratio_of_sines", "mean"];
const AT_ONE_KN: &[&str] = &["ratio_of_sines", "mean"];
const WORDS: &[&str] = &["cov", "mechanism"];
const BAND: &[&str] = &["ratio_of_means", "ratio_of_sines", "mean", "cov"];
const OF_AN_ARM: &[&str] = &["ratio_of_means", "ratio_of_sines", "mean", "cov", "between", "mechanism"];
const FAILING: &[&str] = &["mechanism"];
const ANY_SHARE: Kind =
    Kind::Reals { unit: "1", within: Interval::closed(0.0, 1.0), at_most: 2, ascending: true };

/// A statement.
pub static CLAIM: Section = Section {
    title: "[[claim]]",
    doc: "One statement and how it is judged, at every kn. A reading that leaves one of its arms out says nothing of it.",
    chooser: Some("test"),
    keys: &[&[
        Key::new("claim", Kind::Text, Required, "The statement, in our words."),
        Key::new("source", Kind::Text, Required, "Where it stands."),
        Key::new("why", Kind::Text, Required, "Why the tolerance is what it is."),
        Key::new(
            "test",
            Kind::Choice(&[
                "ratio_of_means",
                "ratio_of_sines",
                "mean",
                "cov",
                "between",
                "falls_with_kn",
                "rises_with_kn",
                "mechanism",
            ]),
            Required,
            "How it is judged.",
        ),
        Key::new("arm", Kind::Name, Required, "The arm it speaks of; above the line in a ratio.")
            .only(OF_AN_ARM),
        Key::new("over", Kind::Name, Required, "The arm below the line.").only(RATIO),
        Key::new("at_kn_pa_per_m", real("Pa/m", POSITIVE), Optional, "The kn that is meant, if it is one.")
            .only(AT_ONE_KN),
        Key::new(
            "stated",
            real("1", POSITIVE),
            Required,
            "The value stated, an angle in deg, a length in m.",
        )
        .only(NUMBER),
        Key::new("stated", Kind::Text, Required, "What is stated, in words.").only(WORDS),
        Key::new(
            "low",
            real("1", Interval::below(0.0, f64::INFINITY)),
            Required,
            "Lowest value that counts as reproduced.",
        )
        .only(BAND),
        Key::new("high", real("1", POSITIVE), Required, "Highest value that counts as reproduced.")
            .only(BAND),
        Key::new(
            "mode",
            Kind::Choice(&["sliding", "rocking", "bulging"]),
            Optional,
            "How the moving part moves.",
        )
        .only(FAILING),
        Key::new(
            "weight_share",
            ANY_SHARE,
            Default("[0, 1]"),
            "Smallest and largest share of the weight that moves.",
        )
        .only(FAILING),
        Key::new(
            "length_share",
            ANY_SHARE,
            Default("[0, 1]"),
            "Smallest and largest share of the length that moves by half of the largest movement or more.",
        )
        .only(FAILING),
        Key::new("place", ANY_SHARE, Default("[0, 1]"), "Where along the length it moves most, from and to.")
            .only(FAILING),
        Key::new("least_share", real("1", SHARE), Default("0.5"), "Share of the walls that must fail so.")
            .only(FAILING),
        Key::new("of", Kind::NamePair, Required, "The two arms on either side.").only(&["between"]),
    ]],
};
