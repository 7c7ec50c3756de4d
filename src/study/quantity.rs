//! A quantity that may be random: a number, a distribution written in place, or a reference to an entry below
//! `distributions`.

use crate::random::Family;
use crate::study::catalogue::Catalogue;
use crate::study::fault::{Fault, Found};
use crate::study::files::sha256;
use crate::study::keys;
use crate::study::raw::{Node, Value};
use crate::study::reader::{Reader, join};
use crate::study::schema::{Interval, Key, Kind, Short};
use crate::study::survey::Asked;
use crate::study::with_unit;

/// A list of more values than this is recorded by its hash.
const LONG: usize = 20;

/// Reads a quantity in the unit that its key states.
pub fn quantity(reader: &mut Reader<'_>, name: &str, catalogue: &mut Catalogue) -> Option<Family> {
    let (node, key) = reader.given(name)?;
    let (Kind::Quantity { unit, within } | Kind::Distribution { unit, within }) = key.kind else {
        crate::check!(false, "`{name}` is no quantity in the key table");
        return None;
    };
    let path = join(&reader.path, name);
    let family = match &node.value {
        Value::Whole(_) | Value::Real(_) if matches!(key.kind, Kind::Distribution { .. }) => {
            reader.refuse(&node, key, "a number belongs where the study states it; write { family = ... }");
            return None;
        }
        Value::Whole(_) | Value::Real(_) => {
            let value = reader.one_real(&node, key, within)?;
            Family::Constant { value }
        }
        Value::Text(number) if with_unit::is_number(number) && matches!(key.kind, Kind::Quantity { .. }) => {
            let value = reader.one_real(&node, key, within)?;
            Family::Constant { value }
        }
        Value::Text(reference) => {
            let family = match catalogue.family(reference, unit, &node, &path) {
                Ok(family) => family?,
                Err(fault) => {
                    reader.notes.faults.push(*fault);
                    return None;
                }
            };
            check_range(reader, &node, key, within, &family)?;
            family
        }
        Value::Table(_) => {
            let mut inline = Reader::open(&node, &path, &keys::FAMILY, reader.notes)?;
            let mut column =
                |reference: &str, asked: Asked| catalogue.column(reference, Asked { unit, within, ..asked });
            let family = family(&mut inline, &mut column)?;
            check_range(reader, &node, key, within, &family)?;
            family
        }
        _ => {
            let fix = format!(
                "{} cannot stand here: write a number, {{ family = ... }} or \"block/size:name\"",
                node.value.kind()
            );
            reader.refuse(&node, key, fix);
            return None;
        }
    };
    reader.record(name, recorded(&family));
    Some(family)
}

/// How a distribution stands among the values that decide a result: a long list by its hash, which changes with every value in it.
fn recorded(family: &Family) -> String {
    match family {
        Family::Empirical { values } if values.len() > LONG => {
            of_survey("empirical", values, &[("mean", family.mean())])
        }
        _ => serde_json::to_string(family).unwrap_or_default(),
    }
}

/// How the rows of a survey stand among the values that decide a result.
pub fn of_survey<R: serde::Serialize>(family: &str, rows: &[R], means: &[(&str, f64)]) -> String {
    let means: String = means.iter().map(|(name, mean)| format!(",\"{name}\":{mean:?}")).collect();
    let hash = sha256(&serde_json::to_vec(rows).unwrap_or_default());
    format!("{{\"family\":\"{family}\",\"rows\":{}{means},\"sha256\":\"{hash}\"}}", rows.len())
}

/// Where a column of a table comes from: by its reference, and what is asked of it.
pub type Columns<'a> = dyn FnMut(&str, Asked) -> Result<Option<Vec<f64>>, Box<Fault>> + 'a;

/// The values of a list, or of a column of a table.
fn values(reader: &mut Reader<'_>, columns: &mut Columns<'_>) -> Option<Vec<f64>> {
    let (node, _) = reader.given("values")?;
    let Value::Text(reference) = &node.value else { return reader.list("values") };
    let path = join(&reader.path, "values");
    let asked = Asked { node: &node, path: &path, unit: "1", within: Interval::any() };
    columns(reference, asked).map_err(|fault| reader.notes.faults.push(*fault)).ok().flatten()
}

/// Reads family and parameters from a table that has them, and checks them. `columns` gives the values that stand in a table.
pub fn family(reader: &mut Reader<'_>, columns: &mut Columns<'_>) -> Option<Family> {
    let family =
        match reader.chosen()? {
            "constant" => reader.reals(["value"]).map(|[value]| Family::Constant { value }),
            "uniform" => reader.reals(["low", "high"]).map(|[low, high]| Family::Uniform { low, high }),
            "normal" => reader.reals(["mean", "sd"]).map(|[mean, sd]| Family::Normal { mean, sd }),
            "truncated_normal" => reader
                .reals(["mean", "sd", "low", "high"])
                .map(|[mean, sd, low, high]| Family::TruncatedNormal { mean, sd, low, high }),
            "lognormal" => reader.reals(["mean", "sd"]).map(|[mean, sd]| Family::Lognormal { mean, sd }),
            "truncated_lognormal" => reader
                .reals(["median", "log_sd", "low", "high"])
                .map(|[median, log_sd, low, high]| Family::TruncatedLognormal { median, log_sd, low, high }),
            "triangular" => reader
                .reals(["low", "mode", "high"])
                .map(|[low, mode, high]| Family::Triangular { low, mode, high }),
            "empirical" => values(reader, columns).map(|values| Family::Empirical { values }),
            other => {
                crate::check!(false, "the family `{other}` of the key table is not read");
                None
            }
        }?;
    match family.checked() {
        Ok(family) => Some(family),
        Err(bad) => {
            for bad in bad {
                let found = Found::Value(Short(bad.found).to_string());
                let path = join(&reader.path, bad.parameter);
                let allowed = format!("a value that {}", bad.allowed);
                let fault =
                    Fault::at(reader.place_of(bad.parameter), &path, found, allowed, "mend the parameters");
                reader.notes.faults.push(fault);
            }
            None
        }
    }
}

/// The whole distribution must lie where the key allows values; a continuous one may touch an open bound.
fn check_range(
    reader: &mut Reader<'_>,
    node: &Node,
    key: &Key,
    within: Interval,
    family: &Family,
) -> Option<()> {
    let (low, high) = family.support();
    let inside = match family {
        Family::Constant { .. } | Family::Empirical { .. } => within.contains(low) && within.contains(high),
        _ => low >= within.low && high <= within.high,
    };
    if !inside {
        reader.refuse(
            node,
            key,
            format!("its values run from {} to {}: truncate or shift it", Short(low), Short(high)),
        );
        return None;
    }
    reader.warn_if_unusual(node, key, family.mean());
    let ends = [0.05, 0.95].map(|p| family.quantile(p));
    let farthest = if ends[0].abs() > ends[1].abs() { ends[0] } else { ends[1] };
    reader.warn_if_in_radians(node, key, farthest);
    Some(())
}
