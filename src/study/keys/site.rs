//! Keys of the file that says what a wall is verified against.

use crate::study::keys::{POSITIVE, real};
use crate::study::schema::Presence::{Default, Optional, Required};
use crate::study::schema::{Interval, Key, Kind, Section};

const CODES: &[&str] = &["ntc-2018", "circolare-2009", "en-1998-3"];
const EUROCODE: &[&str] = &["en-1998-3"];
const ITALY: &[&str] = &["ntc-2018", "circolare-2009"];
const WITH_COLLAPSE: &[&str] = &["ntc-2018", "en-1998-3"];
const OF_CODE: &[&str] = &["ntc-2018", "en-1998-1"];
/// Peak acceleration of the ground (g): above 3 it is a slip of the unit.
const GROUND: Interval = Interval::above(0.0, 3.0);
/// Periods (s).
const PERIOD: Interval = Interval::above(0.0, 20.0);
const DAMPING: Interval = Interval::above(0.0, 100.0);
const MOST_POINTS: usize = 10_000;

/// The file as a whole.
pub static SITE: Section = Section {
    title: "site.toml",
    doc: "What `analyse --verify` checks a wall against: a code, the ground, and where the wall stands.",
    chooser: Some("code"),
    keys: &[&[
        Key::new(
            "code",
            Kind::Choice(CODES),
            Required,
            "ntc-2018 is NTC 2018 with Circolare 7/2019, C8.7.1.2.1; circolare-2009 is Circolare 617/2009, C8A.4.2, which that replaced; \
             en-1998-3 takes what the code fixes from `life`, `collapse` and `behaviour_factor`.",
        ),
        Key::new(
            "confidence_factor",
            real("1", Interval::closed(1.0, 3.0)),
            Default("1.35"),
            "Divides the acceleration that the wall bears. 1.35 is that of the lowest level of knowledge, which Circolare 7/2019 asks for where \
             stones are taken to bear any pressure.",
        )
        .only(ITALY),
        Key::new(
            "partial_factor",
            real("1", Interval::closed(1.0, 3.0)),
            Required,
            "Divides the acceleration that the wall bears.",
        )
        .only(EUROCODE),
        Key::new(
            "behaviour_factor",
            real("1", Interval::closed(1.0, 10.0)),
            Required,
            "Multiplies the acceleration at which the mechanism sets in.",
        )
        .only(EUROCODE),
        Key::new(
            "held",
            Kind::Flag,
            Default("false"),
            "Whether what the wall is built into, as cross walls and floors, holds it until the mechanism sets in. A wall that stands free shakes \
             before, and is asked for the spectrum at its period.",
        ),
        Key::new(
            "period_s",
            real("s", PERIOD),
            Optional,
            "Period of a wall that stands free, before the mechanism sets in. Without it the joints' stiffness gives it.",
        ),
        Key::new("spectrum", Kind::Table(&SPECTRUM), Required, "The ground in the state in which life is safe."),
        Key::new(
            "spectrum_collapse",
            Kind::Table(&SPECTRUM),
            Optional,
            "The ground in the state before collapse, where that is to be checked as well.",
        )
        .only(WITH_COLLAPSE),
        Key::new("life", Kind::Table(&LIMIT_STATE), Required, "What the code fixes where life is safe.").only(EUROCODE),
        Key::new("collapse", Kind::Table(&LIMIT_STATE), Optional, "What the code fixes before collapse.").only(EUROCODE),
        Key::new(
            "mode",
            Kind::Tables(&MODE),
            Optional,
            "Modes of the building that carries the wall, the first mode first; without any the wall stands on the ground.",
        ),
    ]],
};

/// A spectrum of the ground.
pub static SPECTRUM: Section = Section {
    title: "[spectrum]",
    doc: "Elastic response spectrum of the horizontal acceleration, at 5 % of critical damping.",
    chooser: Some("form"),
    keys: &[&[
        Key::new(
            "form",
            Kind::Choice(&["ntc-2018", "en-1998-1", "table", "record"]),
            Required,
            "NTC 2018, 3.2.3.2.1; EN 1998-1:2004, 3.2.2.2; a table of periods and accelerations; or the spectrum of a record.",
        ),
        Key::new("ag_g", real("g", GROUND), Required, "Peak acceleration of rigid ground.").only(OF_CODE),
        Key::new(
            "soil_factor",
            real("1", Interval::above(0.0, 5.0)),
            Required,
            "S: of the soil, times that of the topography.",
        )
        .only(OF_CODE),
        Key::new("f0", real("1", Interval::closed(1.0, 5.0)), Required, "F0: amplification of the plateau.")
            .only(&["ntc-2018"]),
        Key::new("tc_s", real("s", PERIOD), Required, "TC: where the plateau ends.").only(OF_CODE),
        Key::new(
            "tb_s",
            real("s", PERIOD),
            Optional,
            "TB: where the plateau begins; without it a third of tc_s.",
        )
        .only(&["ntc-2018"]),
        Key::new(
            "td_s",
            real("s", PERIOD),
            Optional,
            "TD: where the displacement stops growing; without it 4 ag_g + 1.6.",
        )
        .only(&["ntc-2018"]),
        Key::new(
            "tb_s",
            real("s", PERIOD),
            Required,
            "TB: where the plateau begins, as the national annex states it.",
        )
        .only(&["en-1998-1"]),
        Key::new(
            "td_s",
            real("s", PERIOD),
            Required,
            "TD: where the displacement stops growing, as the national annex states it.",
        )
        .only(&["en-1998-1"]),
        Key::new(
            "periods_s",
            Kind::Reals {
                unit: "s",
                within: Interval::closed(0.0, 20.0),
                at_most: MOST_POINTS,
                ascending: true,
            },
            Required,
            "Periods, from 0 on.",
        )
        .only(&["table"]),
        Key::new(
            "accelerations_g",
            Kind::Reals {
                unit: "g",
                within: Interval::closed(0.0, 30.0),
                at_most: MOST_POINTS,
                ascending: false,
            },
            Required,
            "Spectral accelerations at these periods.",
        )
        .only(&["table"]),
        Key::new(
            "record",
            Kind::Text,
            Required,
            "A file with a record of the ground, beside this one: its y axis, or its only component.",
        )
        .only(&["record"]),
        Key::new("scale", real("1", Interval::above(0.0, 100.0)), Default("1"), "Factor on the record.")
            .only(&["record"]),
    ]],
};

/// A mode of the building below.
pub static MODE: Section = Section {
    title: "[[mode]]",
    doc: "A mode of the building that carries the wall (Circolare 7/2019, C7.2.3).",
    chooser: None,
    keys: &[&[
        Key::new("period_s", real("s", PERIOD), Required, "Its period."),
        Key::new("damping_percent", real("%", DAMPING), Default("5"), "Its equivalent viscous damping."),
        Key::new(
            "participation",
            real("1", Interval::closed(-10.0, 10.0)),
            Required,
            "Participation factor; 3 n / (2 n + 1) for n storeys of equal mass in a mode that grows with height.",
        ),
        Key::new(
            "shape",
            real("1", Interval::closed(-10.0, 10.0)),
            Required,
            "The mode's shape at the wall: z / H in a mode that grows with height.",
        ),
    ]],
};

/// What a code fixes for a limit state.
pub static LIMIT_STATE: Section = Section {
    title: "[life]",
    doc: "What a code fixes for the check by displacement of a limit state.",
    chooser: None,
    keys: &[&[
        Key::new(
            "capacity_share",
            real("1", Interval::above(0.0, 1.0)),
            Required,
            "Displacement allowed, as a share of the one at which nothing is borne any more.",
        ),
        Key::new(
            "secant_share",
            real("1", Interval::above(0.0, 1.0)),
            Default("1"),
            "Displacement whose secant gives the period, as a share of the one allowed.",
        ),
        Key::new(
            "period_factor",
            real("1", POSITIVE),
            Default("2"),
            "c of the secant period c pi sqrt(d / a(d)).",
        ),
        Key::new("damping_percent", real("%", DAMPING), Default("5"), "Equivalent viscous damping."),
    ]],
};
