//! The file that says what a wall is verified against: code, ground, place.

use std::path::Path;

use crate::math::Vec3;
use crate::motion::Motion;
use crate::study::fault::Faults;
use crate::study::reader::{Notes, Reader};
use crate::study::{files, keys, raw};
use crate::verify::{Code, Corners, LimitState, Mode, Place, Spectrum};

/// What a wall is verified against, as its file says it.
#[derive(Clone, Debug, PartialEq)]
pub struct Site {
    /// The code.
    pub code: Code,
    /// Confidence factor.
    pub confidence: f64,
    /// Spectrum for the state in which life is safe.
    pub life: Spectrum,
    /// Spectrum for the state before collapse.
    pub collapse: Option<Spectrum>,
    /// Where the wall stands.
    pub place: Place,
    /// Whether the wall is held until the mechanism sets in.
    pub held: bool,
    /// Period (s) of a wall that stands free, where it is stated.
    pub period: Option<f64>,
    /// What the file says that its reader should know.
    pub warnings: Vec<String>,
    /// SHA-256 of the file (hex).
    pub sha256: String,
}

/// What no table of this program holds.
const NOT_LOOKED_UP: &str = "EN 1998-3: what the code fixes is taken from the file as it stands, shares, damping and factors: compare them with the clauses in force";

impl Site {
    /// Reads a file.
    ///
    /// # Errors
    /// All that is wrong with it: file, line, key, what was found, what is expected, how to mend it.
    pub fn read(path: &Path) -> Result<Site, Faults> {
        let one = |fault| Faults::sorted(vec![fault]);
        let text =
            files::read(path, &path.display().to_string(), 0, raw::FORMAT).map_err(|fault| one(*fault))?;
        let root = raw::parse(&text.source).map_err(|fault| one(*fault))?;
        let mut notes = Notes::default();
        let folder = path.parent().unwrap_or(Path::new(""));
        let read =
            Reader::open(&root, "", &keys::SITE, &mut notes).and_then(|mut top| site(&mut top, folder));
        let warnings = notes.warnings.iter().map(ToString::to_string);
        match read {
            Some(site) if notes.faults.is_empty() => {
                let warnings = warnings.chain(site.warnings.iter().cloned()).collect();
                Ok(Site { warnings, sha256: text.sha256, ..site })
            }
            _ => Err(Faults::sorted(notes.faults)),
        }
    }
}

fn site(top: &mut Reader<'_>, folder: &Path) -> Option<Site> {
    let is_eurocode = top.chosen()? == "en-1998-3";
    let confidence = top.real(if is_eurocode { "partial_factor" } else { "confidence_factor" });
    let held = top.flag("held");
    let period = if top.has("period_s") { Some(top.real("period_s")) } else { None };
    if held == Some(true) && period.is_some() {
        top.fault(
            "period_s",
            "nothing, where held = true: a wall that is held does not shake before",
            "remove it",
        );
        return None;
    }
    let life = top.table("spectrum").and_then(|mut t| spectrum(&mut t, folder));
    let collapse = spectrum_of_collapse(top, folder);
    let place = place(top);
    let code = match top.chosen()? {
        "ntc-2018" => Some(Code::ntc_2018()),
        "circolare-2009" => Some(Code::circolare_2009()),
        _ => eurocode(top),
    };
    let mut warnings = Vec::new();
    if is_eurocode {
        warnings.push(NOT_LOOKED_UP.to_owned());
    }
    Some(Site {
        code: code?,
        confidence: confidence?,
        life: life?,
        collapse: collapse?,
        place: place?,
        held: held?,
        period: period.map_or(Some(None), |read| read.map(Some))?,
        warnings,
        sha256: String::new(),
    })
}

fn spectrum_of_collapse(top: &mut Reader<'_>, folder: &Path) -> Option<Option<Spectrum>> {
    if !top.has("spectrum_collapse") {
        return Some(None);
    }
    let is_asked = top.chosen() != Some("en-1998-3") || top.has("collapse");
    if !is_asked {
        top.fault(
            "spectrum_collapse",
            "a [collapse] beside it, with what the code fixes there",
            "add it, or remove this",
        );
        return None;
    }
    top.table("spectrum_collapse").and_then(|mut t| spectrum(&mut t, folder)).map(Some)
}

fn spectrum(t: &mut Reader<'_>, folder: &Path) -> Option<Spectrum> {
    let form = t.chosen()?;
    match form {
        "table" => return table(t),
        "record" => return recorded(t, folder),
        _ => {}
    }
    let [ag, soil, c] = t.reals(["ag_g", "soil_factor", "tc_s"])?;
    let f0 = if form == "ntc-2018" { t.real("f0")? } else { 0.0 };
    // The code of Italy derives the other corners where they are not stated.
    let mut or = |name, usual| if t.has(name) || form != "ntc-2018" { t.real(name) } else { Some(usual) };
    let (b, d) = (or("tb_s", c / 3.0), or("td_s", 4.0 * ag + 1.6));
    let corners = Corners { b: b?, c, d: d? };
    if !(corners.b < corners.c && corners.c < corners.d) {
        t.fault("tc_s", "between tb_s and td_s", "put the periods in order");
        return None;
    }
    Some(match form {
        "ntc-2018" => Spectrum::Ntc { ag, soil, f0, corners },
        _ => Spectrum::En { ag, soil, corners },
    })
}

fn table(t: &mut Reader<'_>) -> Option<Spectrum> {
    let (periods, accelerations) = (t.list("periods_s"), t.list("accelerations_g"));
    let (periods, accelerations) = (periods?, accelerations?);
    if periods.len() != accelerations.len() {
        let allowed = format!("as many numbers as periods_s, {}", periods.len());
        t.fault("accelerations_g", allowed, format!("it has {}", accelerations.len()));
        return None;
    }
    if periods.len() < 2 || periods[0] != 0.0 {
        t.fault(
            "periods_s",
            "two periods or more, the first of them 0",
            "begin with the acceleration of the ground",
        );
        return None;
    }
    Some(Spectrum::Table(periods.into_iter().zip(accelerations).map(|(t, a)| [t, a]).collect()))
}

/// The spectrum of a record at 5 % of critical damping.
fn recorded(t: &mut Reader<'_>, folder: &Path) -> Option<Spectrum> {
    let (name, scale) = (t.text("record"), t.real("scale"));
    let (name, scale) = (name?, scale?);
    let read = Motion::read(&folder.join(name))
        .map(|motion| motion.towards(&Vec3::y()).unwrap_or_else(|_| motion.clone()));
    match read {
        Ok(motion) => Some(Spectrum::of_record(&motion.scaled(scale).accelerogram(&Vec3::y()))),
        Err(fault) => {
            t.fault("record", format!("a record that can be read; {fault}"), "mend it, or name another");
            None
        }
    }
}

fn place(top: &mut Reader<'_>) -> Option<Place> {
    if !top.has("mode") {
        return Some(Place::Ground);
    }
    let read: Vec<Option<Mode>> = top
        .tables("mode")
        .into_iter()
        .map(|(node, path)| {
            let mut t = Reader::open(&node, &path, &keys::MODE, top.notes)?;
            let [period, damping_percent, participation, shape] =
                t.reals(["period_s", "damping_percent", "participation", "shape"])?;
            Some(Mode { period, damping_percent, share: participation * shape })
        })
        .collect();
    let modes: Option<Vec<Mode>> = read.into_iter().collect();
    modes.filter(|modes| !modes.is_empty()).map(Place::Height)
}

/// What the file states for a code whose numbers the program does not hold.
fn eurocode(top: &mut Reader<'_>) -> Option<Code> {
    let life = limit_state(top, "life", "significant damage");
    let collapse = if top.has("collapse") {
        limit_state(top, "collapse", "near collapse").map(Some)
    } else {
        Some(None)
    };
    let behaviour_factor = top.real("behaviour_factor");
    Some(Code {
        name: "EN 1998-3, with the numbers of the file".to_owned(),
        life: life?,
        collapse: collapse?,
        behaviour_factor: behaviour_factor?,
    })
}

fn limit_state(top: &mut Reader<'_>, name: &str, state: &str) -> Option<LimitState> {
    let mut t = top.table(name)?;
    let [capacity_share, secant_share, period_factor, damping_percent] =
        t.reals(["capacity_share", "secant_share", "period_factor", "damping_percent"])?;
    Some(LimitState { name: state.to_owned(), capacity_share, secant_share, period_factor, damping_percent })
}
