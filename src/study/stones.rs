//! Stones of a survey, length and height together: a table beside the study, or a list of pairs.

use crate::random::Pairs;
use crate::study::catalogue::Catalogue;
use crate::study::quantity::of_survey;
use crate::study::raw::{Node, Value};
use crate::study::reader::{Reader, join};
use crate::study::schema::{Interval, Key, Kind};
use crate::study::survey::Asked;

/// Reads the stones of an arm, in m; those of a table may not be longer or higher than the wall, whose length and height (m) are given.
pub fn stones(t: &mut Reader<'_>, catalogue: &mut Catalogue, wall: [Option<f64>; 2]) -> Option<Pairs> {
    let (node, key) = t.given("stones")?;
    let Kind::Stones { within, at_most } = key.kind else {
        crate::check!(false, "`stones` is no list of stones in the key table");
        return None;
    };
    let rows = match &node.value {
        Value::Text(file) => {
            let path = join(&t.path, "stones");
            let asked = Asked { node: &node, path: &path, unit: "m", within };
            catalogue.stones(file, asked, wall).map_err(|fault| t.notes.faults.push(*fault)).ok().flatten()?
        }
        Value::List(list) if (1..=at_most).contains(&list.len()) => {
            let read: Vec<_> = list.iter().map(|stone| pair(t, stone, key, within)).collect();
            read.into_iter().collect::<Option<Vec<_>>>()?
        }
        Value::List(list) => {
            t.refuse(&node, key, format!("it has {} entries", list.len()));
            return None;
        }
        _ => {
            t.refuse(&node, key, format!("{} cannot stand here", node.value.kind()));
            return None;
        }
    };
    let stones = Pairs::of(rows);
    crate::check!(stones.is_some(), "stones that were checked make no survey");
    let stones = stones?;
    let [length, height] = stones.marginals().map(|own| own.mean());
    let means = [("mean_length_m", length), ("mean_height_m", height)];
    t.record("stones", of_survey("surveyed", stones.rows(), &means));
    Some(stones)
}

/// Length and height of one stone.
fn pair(t: &mut Reader<'_>, stone: &Node, key: &Key, within: Interval) -> Option<[f64; 2]> {
    let Value::List(list) = &stone.value else {
        t.refuse(stone, key, "write each stone as [length, height]");
        return None;
    };
    let [length, height] = &list[..] else {
        t.refuse(stone, key, format!("this stone has {} numbers", list.len()));
        return None;
    };
    let (length, height) = (t.one_real(length, key, within), t.one_real(height, key, within));
    Some([length?, height?])
}
