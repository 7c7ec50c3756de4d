//! One wall of a study: drawn as it falls, or written to a file for other programs.

pub(crate) mod ask;
pub(crate) mod condition;
pub(crate) mod drawn;
pub(crate) mod frames;
pub(crate) mod one_wall;
pub(crate) mod picture;
pub(crate) mod replayed;
mod written;

use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::verb::wall::ask::Wall;
use crate::verb::wall::written::Format;

/// Draws the wall, or writes it to a file, as the ending of the file says.
pub(crate) fn wall(arguments: &Wall) -> Result<Answer, Failure> {
    let ending = arguments.out.extension().and_then(|ending| ending.to_str());
    match (ending, ending.and_then(Format::named)) {
        (Some("svg"), _) => {
            no_option(
                &[("--solved", arguments.solved), ("--with-base", arguments.with_base)],
                "a .vtu, .obj or .json file",
            )?;
            picture::picture(arguments)
        }
        (_, Some(format)) => {
            let of_a_picture = [
                ("--colour", arguments.colour.is_some()),
                ("--magnify", arguments.magnify.is_some()),
                ("--frames", arguments.frames.is_some()),
                ("--series", arguments.series.is_some()),
            ];
            no_option(&of_a_picture, "a picture, --out FILE.svg")?;
            written::write(arguments, format)
        }
        _ => Err(Failure::Usage(format!(
            "--out {}: the ending of the file says what is written and must be .svg, .vtu, .obj or .json",
            arguments.out.display()
        ))),
    }
}

/// That no option is given which belongs to another kind of file.
fn no_option(given: &[(&str, bool)], belongs_to: &str) -> Result<(), Failure> {
    match given.iter().find(|(_, is_given)| *is_given) {
        Some((name, _)) => Err(Failure::Usage(format!("{name} is for {belongs_to}; leave it out"))),
        None => Ok(()),
    }
}
