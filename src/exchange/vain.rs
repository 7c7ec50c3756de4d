//! What may be said of how a file is read, and for which files it means something. The rest is refused: nobody sees that it was ignored.

use crate::exchange::Format;

/// Something that is said of how a file is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choice {
    /// The unit of its coordinates.
    Unit,
    /// Which of its axes points up.
    Up,
    /// The density where it states none.
    Density,
    /// The depth of the stones.
    Thickness,
    /// The size of a pixel.
    Pixel,
    /// The length of all stones together.
    Width,
    /// That it shows a section.
    Section,
    /// Up to where warped faces are made plane.
    Flatness,
    /// That concave stones are divided.
    Parts,
    /// Up to where the underside of a scan bears.
    ScanBearing,
    /// Up to which width joints are mended.
    Mend,
}

/// A file, as far as it decides what means something.
#[derive(Clone, Copy, Debug)]
pub struct Nature {
    /// Its format; `None` of a folder, and of an ending that nobody knows.
    pub format: Option<Format>,
    /// Whether it states its unit and its densities itself.
    pub states_units: bool,
}

impl Choice {
    /// All of them.
    pub const ALL: [Choice; 11] = [
        Choice::Unit,
        Choice::Up,
        Choice::Density,
        Choice::Thickness,
        Choice::Pixel,
        Choice::Width,
        Choice::Section,
        Choice::Flatness,
        Choice::Parts,
        Choice::ScanBearing,
        Choice::Mend,
    ];

    /// Its option of `pirca analyse`.
    pub fn option(self) -> &'static str {
        match self {
            Choice::Unit => "--unit",
            Choice::Up => "--up",
            Choice::Density => "--density-kg-per-m3",
            Choice::Thickness => "--thickness",
            Choice::Pixel => "--pixel",
            Choice::Width => "--width",
            Choice::Section => "--section",
            Choice::Flatness => "--flatness",
            Choice::Parts => "--parts",
            Choice::ScanBearing => "--scan-bearing",
            Choice::Mend => "--mend",
        }
    }

    /// Its key of an arm.
    pub fn key(self) -> &'static str {
        match self {
            Choice::Unit => "unit",
            Choice::Up => "up_axis",
            Choice::Density => "unstated_density_kg_per_m3",
            Choice::Thickness => "thickness_m",
            Choice::Pixel => "pixel_m",
            Choice::Width => "width_m",
            Choice::Section => "section",
            Choice::Flatness => "flatness_m",
            Choice::Parts => "parts",
            Choice::ScanBearing => "scan_bearing_m",
            Choice::Mend => "mend_m",
        }
    }

    /// Why it means nothing for a file of which all of `stated` is said; behind "is". `None` where it means something.
    pub fn in_vain(self, file: Nature, stated: &[Choice]) -> Option<&'static str> {
        let format = file.format?;
        let says = |choice: Choice| stated.contains(&choice);
        let (is_picture, is_drawn) = (format == Format::Picture, format.is_drawn());
        // Joints of a picture are closed in any case.
        let is_closed = is_picture || (is_drawn && says(Choice::Mend));
        let why = [
            (
                Choice::Unit,
                is_picture,
                "for coordinates; the size of a picture is that of a pixel, or its width",
            ),
            (
                Choice::Unit,
                file.states_units,
                "for files that state no unit (OBJ, COMPAS); a wall.json states its own",
            ),
            (
                Choice::Density,
                file.states_units,
                "for files that state no density (OBJ, COMPAS); a wall.json states its own",
            ),
            (Choice::Up, format.is_elevation(), "for meshes and .obj files; in an elevation z points up"),
            (Choice::Up, file.states_units, "for meshes and .obj files; in a wall.json z points up"),
            (
                Choice::Thickness,
                !format.is_elevation(),
                "for elevations, which are tables, drawings and pictures; other files state it themselves",
            ),
            (Choice::Pixel, !is_picture, "for pictures; the size of a drawing is its unit, or its width"),
            (Choice::Width, !is_drawn, "for drawings and pictures; other files state their unit"),
            (
                Choice::Width,
                says(Choice::Unit) || says(Choice::Pixel),
                "the size a second time: the unit, or the size of a pixel, says it",
            ),
            (
                Choice::Section,
                !is_drawn,
                "for drawings and pictures; other files state the depth of their stones",
            ),
            (
                Choice::Flatness,
                is_closed,
                "for warped faces; a stone of a drawing whose joints are closed has none",
            ),
            (
                Choice::Parts,
                is_closed,
                "for concave stones; a stone of a drawing whose joints are closed becomes convex",
            ),
            (
                Choice::ScanBearing,
                format != Format::Obj,
                "for scans in an .obj file; a wall.json has the scan of a block itself",
            ),
        ];
        why.into_iter().find(|(own, is_vain, _)| *own == self && *is_vain).map(|(.., why)| why)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(name: &str, states_units: bool, stated: &[Choice]) -> Vec<Choice> {
        let file = Nature { format: Format::of(name), states_units };
        stated.iter().copied().filter(|own| own.in_vain(file, stated).is_some()).collect()
    }

    #[test]
    fn what_means_nothing_for_a_file_is_refused() {
        use Choice::{Density, Flatness, Parts, Pixel, ScanBearing, Section, Thickness, Unit, Up, Width};
        let all = |name: &str, states_units: bool| {
            Choice::ALL
                .into_iter()
                .filter(|own| !refused(name, states_units, &[*own]).is_empty())
                .collect::<Vec<_>>()
        };
        assert_eq!(
            all("wall.json", true),
            [Unit, Up, Density, Thickness, Pixel, Width, Section, ScanBearing]
        );
        assert_eq!(all("compas.json", false), [Thickness, Pixel, Width, Section, ScanBearing]);
        assert_eq!(all("wall.obj", false), [Thickness, Pixel, Width, Section]);
        assert_eq!(all("stone.ply", false), [Thickness, Pixel, Width, Section, ScanBearing]);
        assert_eq!(all("face.csv", false), [Up, Pixel, Width, Section, ScanBearing]);
        assert_eq!(all("face.dxf", false), [Up, Pixel, ScanBearing]);
        assert_eq!(all("face.png", false), [Unit, Up, Flatness, Parts, ScanBearing]);
        assert_eq!(all("folder", false), [], "what cannot be known is left to the reader");
    }

    #[test]
    fn the_size_is_said_once_and_a_mended_drawing_has_convex_stones() {
        use Choice::{Flatness, Mend, Parts, Pixel, Unit, Width};
        assert_eq!(refused("face.dxf", false, &[Unit, Width]), [Width]);
        assert_eq!(refused("face.png", false, &[Pixel, Width]), [Width]);
        assert_eq!(refused("face.dxf", false, &[Flatness, Parts, Mend]), [Flatness, Parts]);
        assert_eq!(refused("face.dxf", false, &[Flatness, Parts]), []);
        assert_eq!(refused("wall.obj", false, &[Flatness, Parts, Mend]), []);
    }
}
