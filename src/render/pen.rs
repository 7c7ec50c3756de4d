//! The pen that all figures are drawn with: scale and font, the frame and the grid of a chart, the words of a legend.

use plotters::chart::MeshStyle;
use plotters::coord::Shift;
use plotters::coord::ranged1d::Ranged;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Name of the bundled font; also the `font-family` of the SVG, hence the alternatives.
pub const FONT_NAME: &str = "DejaVu Sans, Verdana, sans-serif";

/// Height of a line of the legend, and where its text begins (pixels at scale 1).
pub const LINE: u32 = 26;
const LEGEND_TEXT: i32 = 150;
/// From where to where the mark of a line of the legend reaches (pixels at scale 1).
const LEGEND_MARK: [i32; 2] = [98, 138];

/// What drawing gives.
pub type Drawn<DB> = Result<(), DrawingAreaErrorKind<<DB as DrawingBackend>::ErrorType>>;

/// A pen of some scale: 1 for SVG, more for images.
#[derive(Clone, Copy, Debug)]
pub struct Pen {
    /// Pixels per pixel at scale 1.
    pub scale: u32,
}

impl Pen {
    /// A length in pixels.
    pub fn px(&self, length: i32) -> i32 {
        length * self.scale as i32
    }

    /// A point in pixels.
    pub fn at(&self, x: i32, y: i32) -> (i32, i32) {
        (self.px(x), self.px(y))
    }

    /// Black letters of a size.
    pub fn font(&self, size: i32) -> TextStyle<'static> {
        TextStyle::from((FONT_NAME, self.px(size))).color(&BLACK)
    }

    /// A chart with its caption in letters of a size, and room for its axes; `left` is the width of the labels on the left.
    pub fn frame<'a, DB: DrawingBackend>(
        &self,
        area: &'a DrawingArea<DB, Shift>,
        (caption, letters): (&str, i32),
        left: i32,
    ) -> ChartBuilder<'a, 'static, DB> {
        let mut chart = ChartBuilder::on(area);
        chart
            .caption(caption, self.font(letters))
            .margin(self.px(12))
            .margin_right(self.px(28))
            .x_label_area_size(self.px(62))
            .y_label_area_size(self.px(left));
        chart
    }

    /// Grey lines across, black axes, and the sizes of their letters.
    pub fn grid<'m, 'a, 'b, X: Ranged, Y: Ranged, DB: DrawingBackend>(
        &self,
        mesh: &'m mut MeshStyle<'a, 'b, X, Y, DB>,
    ) -> &'m mut MeshStyle<'a, 'b, X, Y, DB> {
        mesh.disable_x_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(RGBColor(215, 215, 215).stroke_width(self.scale))
            .axis_style(BLACK.stroke_width(self.scale))
            .set_all_tick_mark_size(self.px(6))
            .label_style(self.font(18))
            .axis_desc_style(self.font(19))
    }

    /// Where the mark of a line of the legend begins and ends, and its height.
    pub fn mark(&self, line: usize) -> ([i32; 2], i32) {
        let y = self.px(LINE as i32) * line as i32 + self.px(LINE as i32 / 2);
        (LEGEND_MARK.map(|x| self.px(x)), y)
    }

    /// The words beside the mark of a line of the legend.
    pub fn words<DB: DrawingBackend>(
        &self,
        area: &DrawingArea<DB, Shift>,
        line: usize,
        words: &str,
    ) -> Drawn<DB> {
        self.line_of_text(area, line, LEGEND_TEXT, words)
    }

    /// Words that begin where the marks do.
    pub fn remark<DB: DrawingBackend>(
        &self,
        area: &DrawingArea<DB, Shift>,
        line: usize,
        words: &str,
    ) -> Drawn<DB> {
        self.line_of_text(area, line, LEGEND_MARK[0], words)
    }

    fn line_of_text<DB: DrawingBackend>(
        &self,
        area: &DrawingArea<DB, Shift>,
        line: usize,
        x: i32,
        words: &str,
    ) -> Drawn<DB> {
        let (_, y) = self.mark(line);
        // Letters stand above the middle of their line box: this brings them level with the marks.
        let at = (self.px(x), y + self.px(2));
        area.draw(&Text::new(words, at, self.font(18).pos(left())))
    }
}

/// Letters that begin at a point and stand level with it.
pub fn left() -> Pos {
    Pos::new(HPos::Left, VPos::Center)
}

/// Letters about a point.
pub fn centred() -> Pos {
    Pos::new(HPos::Center, VPos::Center)
}
