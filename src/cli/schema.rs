//! `pirca schema`: the JSON Schema of an input file, for editors.

use crate::cli::arguments::{Described, Schema};
use crate::cli::failure::Failure;
use crate::cli::output;
use crate::ensemble::replace_file;
use crate::study;

/// Prints the schema, or writes it to a file.
pub(crate) fn schema(arguments: &Schema) -> Result<(), Failure> {
    let schema = match arguments.of {
        Described::Study => study::Schema::Study,
        Described::ElementStudy => study::Schema::ElementStudy,
        Described::Published => study::Schema::Published,
    };
    match &arguments.out {
        None => output::print_as_it_is(&schema.text()),
        Some(path) => {
            replace_file(path, schema.text().as_bytes())?;
            output::print(&format!("written to {}\n", path.display()))
        }
    }
}
