//! The columns of a run's tables for people and for programs.
//!
//! The schemas are [Table Schemas](https://datapackage.org/standard/table-schema/) of the Frictionless standard and not JSON Schemas: those
//! describe JSON objects, these are made for the columns of a table, with units beside the types, and programs check a CSV file against
//! them (`frictionless validate members.csv --schema members.schema.json`).

use serde_json::{Value as Json, json};

use crate::ensemble::columns::{Column, Table, documented};
use crate::ensemble::field::Kind;

/// The schema of a table with these columns; `key` names its lines.
pub(crate) fn schema<T: Table>(columns: &[Column<T>], key: &[&str]) -> String {
    let field = |column: &Column<T>| {
        let mut field = json!({
            "name": column.name, "type": kind(column.kind), "description": column.meaning,
        });
        if !column.unit.is_empty() {
            field["unit"] = json!(column.unit);
        }
        if key.contains(&column.name.as_str()) || column.kind == Kind::Count {
            field["constraints"] = json!({"required": true});
        }
        field
    };
    let fields: Vec<Json> = columns.iter().map(field).collect();
    let schema = json!({
        "$schema": "https://datapackage.org/profiles/2.0/tableschema.json",
        "fields": fields, "missingValues": [""], "primaryKey": key,
    });
    format!("{schema:#}\n")
}

/// All columns that the tables of a run may have, for people: a line for each with its unit, its type and its meaning.
pub fn column_reference() -> String {
    let (members, steps) = documented();
    let mut text = String::from("members.parquet, members.csv: a line per wall and stiffness\n");
    members.iter().for_each(|column| text += &line(column));
    text += "\nsteps.parquet, steps.csv: a line per load step of each\n";
    steps.iter().for_each(|column| text += &line(column));
    text
}

fn line<T: Table>(column: &Column<T>) -> String {
    let unit = if column.unit.is_empty() { "-" } else { column.unit };
    format!("  {:<33} {unit:<5} {:<8} {}\n", column.name, kind(column.kind), column.meaning)
}

/// The type in the words of the standard.
fn kind(kind: Kind) -> &'static str {
    match kind {
        Kind::Text => "string",
        Kind::Count => "integer",
        Kind::Real => "number",
    }
}
