//! What an Excel workbook is packed of: texts in XML, in an archive.

use std::io::{Cursor, Read};

use quick_xml::Reader;
use quick_xml::XmlVersion::Implicit1_0;
use quick_xml::escape::resolve_predefined_entity;
use quick_xml::events::{BytesStart, Event};
use zip::ZipArchive;

use crate::exchange::fault::Fault;
use crate::exchange::mesh::{quoted, refusal};

/// Most bytes of all parts of a workbook that are read, unpacked.
pub(super) const MOST_UNPACKED: u64 = 32 << 20;
pub(super) const ALLOWED: &str = "an Excel workbook (.xlsx)";
pub(super) const SAVE: &str = "save the table as .xlsx without a password, or as .csv";

/// A fault of what is no workbook.
pub(super) fn broken(why: &str) -> Box<Fault> {
    let found = format!("it cannot be read as a workbook ({})", quoted(why.as_bytes()));
    refusal("", found, ALLOWED, SAVE)
}

/// The path of what is in a folder.
pub(super) fn within(folder: &str, path: &str) -> String {
    if folder.is_empty() { path.to_owned() } else { format!("{folder}/{path}") }
}

/// A part of a workbook as another one names it.
pub(super) struct Relation {
    pub(super) id: String,
    /// What it is, as `worksheet`.
    pub(super) kind: String,
    pub(super) path: String,
}

/// The parts of a workbook.
pub(super) struct Package<'a> {
    zip: ZipArchive<Cursor<&'a [u8]>>,
    /// Bytes that may still be unpacked.
    left: u64,
}

impl Package<'_> {
    /// The parts of a file.
    pub(super) fn of(bytes: &[u8]) -> Result<Package<'_>, Box<Fault>> {
        let zip = ZipArchive::new(Cursor::new(bytes)).map_err(|error| broken(&error.to_string()))?;
        Ok(Package { zip, left: MOST_UNPACKED })
    }

    /// A part, as text.
    pub(super) fn part(&mut self, path: &str) -> Result<String, Box<Fault>> {
        let part = self.zip.by_name(path).map_err(|error| broken(&format!("{path}: {error}")))?;
        let mut text = Vec::new();
        // What a part says of its size may be wrong.
        let read = part.take(self.left + 1).read_to_end(&mut text);
        read.map_err(|error| broken(&format!("{path}: {error}")))?;
        self.left = match self.left.checked_sub(text.len() as u64) {
            Some(left) => left,
            None => {
                let found = format!("it unpacks to more than {} MiB", MOST_UNPACKED >> 20);
                let fix = "leave only the table of the stones in it, or save that as .csv";
                return Err(refusal("", found, "a table of a few hundred stones", fix));
            }
        };
        String::from_utf8(text).map_err(|_| broken(&format!("{path} is not in UTF-8")))
    }

    /// The parts that such a list names, which are in a folder unless it says otherwise.
    pub(super) fn relations(&mut self, path: &str, folder: &str) -> Result<Vec<Relation>, Box<Fault>> {
        let (text, mut all) = (self.part(path)?, Vec::new());
        events(&text, |event| {
            if let Event::Start(tag) = event
                && tag.local_name().as_ref() == "Relationship"
            {
                let own = |name| attribute(&tag, name).unwrap_or_default();
                let target = own("Target");
                let path = match target.strip_prefix('/') {
                    Some(whole) => whole.to_owned(),
                    None => within(folder, &target),
                };
                let kind = own("Type").rsplit('/').next().unwrap_or_default().to_owned();
                all.push(Relation { id: own("Id"), kind, path });
            }
            Ok(())
        })?;
        Ok(all)
    }
}

/// Hands over what is in an XML text, an empty element as its start and its end.
pub(super) fn events(
    text: &str,
    mut each: impl FnMut(Event) -> Result<(), Box<Fault>>,
) -> Result<(), Box<Fault>> {
    let mut reader = Reader::from_str(text.trim_start_matches('\u{feff}'));
    reader.config_mut().expand_empty_elements = true;
    loop {
        match reader.read_event().map_err(|error| broken(&error.to_string()))? {
            Event::Eof => return Ok(()),
            event => each(event)?,
        }
    }
}

/// A value that an element has by this name, whatever its namespace.
pub(super) fn attribute(tag: &BytesStart, name: &str) -> Option<String> {
    // Checks for names that are there twice would take a time with the square of their number.
    let mut all = tag.attributes();
    let own = all.with_checks(false).flatten().find(|own| own.key.local_name().as_ref() == name)?;
    own.normalized_value(Implicit1_0).ok().map(|value| value.into_owned())
}

/// A text in the making: what is in elements `t` or `v`, but for what says how it is pronounced.
#[derive(Default)]
pub(super) struct Writing {
    pub(super) text: String,
    open: bool,
    spoken: bool,
}

impl Writing {
    /// Takes what an event adds.
    pub(super) fn take(&mut self, event: &Event) {
        match event {
            Event::Start(tag) | Event::Empty(tag) => match tag.local_name().as_ref() {
                "rPh" => self.spoken = true,
                "t" | "v" => self.open = !self.spoken,
                _ => {}
            },
            Event::End(tag) => match tag.local_name().as_ref() {
                "rPh" => self.spoken = false,
                "t" | "v" => self.open = false,
                _ => {}
            },
            Event::Text(text) if self.open => self.text.push_str(&text.xml_content(Implicit1_0)),
            Event::CData(text) if self.open => self.text.push_str(&text.xml_content(Implicit1_0)),
            Event::GeneralRef(name) if self.open => match name.resolve_char_ref() {
                Ok(Some(c)) => self.text.push(c),
                _ => self.text.push_str(resolve_predefined_entity(name.as_ref()).unwrap_or("")),
            },
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;
    use zip::ZipWriter;
    use zip::write::SimpleFileOptions;

    #[test]
    fn what_unpacks_to_far_more_is_refused() {
        let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
        for (path, text) in [("small", "a".to_owned()), ("large", " ".repeat(100_000))] {
            zip.start_file(path, SimpleFileOptions::default()).expect("a part");
            zip.write_all(text.as_bytes()).expect("its text");
        }
        let bytes = zip.finish().expect("a file").into_inner();
        let mut package = Package { left: 100_000, ..Package::of(&bytes).expect("parts") };
        assert_eq!(package.part("small").expect("small"), "a");
        let fault = package.part("large").expect_err("large");
        assert!(bytes.len() < 1000 && fault.found.contains("unpacks to more than"), "{fault:?}");
    }

    #[test]
    fn texts_leave_out_how_they_are_spoken() {
        let mut writing = Writing::default();
        let text = "<si>no<r><t>le</t></r><rPh><t>no</t></rPh><t>ft &lt;&#65;<![CDATA[<]]></t></si>";
        events(text, |event| {
            writing.take(&event);
            Ok(())
        })
        .expect("it reads");
        assert_eq!(writing.text, "left <A<");
    }
}
