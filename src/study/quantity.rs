//! A quantity that may be random: a number, a distribution written in place, or a reference to an entry below
//! `distributions`.

use crate::random::Family;
use crate::study::catalogue::Catalogue;
use crate::study::fault::{Fault, Found};
use crate::study::keys;
use crate::study::raw::{Node, Value};
use crate::study::reader::{Reader, join};
use crate::study::schema::{Interval, Key, Kind, Short};

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
            let family = family(&mut inline)?;
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
    let written = serde_json::to_string(&family).unwrap_or_default();
    reader.record(name, written);
    Some(family)
}

/// Reads family and parameters from a table that has them, and checks them.
pub fn family(reader: &mut Reader<'_>) -> Option<Family> {
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
            "empirical" => reader.list("values").map(|values| Family::Empirical { values }),
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
    Some(())
}
