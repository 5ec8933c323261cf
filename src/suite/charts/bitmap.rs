//! plotters' bitmap backend with its text set where an SVG reader sets it.

use plotters::prelude::{BitMapBackend, DrawingBackend};
use plotters_backend::text_anchor::VPos;
use plotters_backend::{BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingErrorKind};

/// [`BitMapBackend`], but for text: with `ab_glyph` plotters puts the baseline half a font size under the top of the
/// box, whatever the anchor, so that text stands too high. The shifts follow from DejaVu Sans, whose capitals are
/// 0.626 of the font size as `ab_glyph` takes it.
pub(super) struct Bitmap<'a>(pub(super) BitMapBackend<'a>);

type Outcome<'a> = Result<(), DrawingErrorKind<<BitMapBackend<'a> as DrawingBackend>::ErrorType>>;

impl<'a> DrawingBackend for Bitmap<'a> {
    type ErrorType = <BitMapBackend<'a> as DrawingBackend>::ErrorType;

    fn get_size(&self) -> (u32, u32) {
        self.0.get_size()
    }

    fn ensure_prepared(&mut self) -> Outcome<'a> {
        self.0.ensure_prepared()
    }

    fn present(&mut self) -> Outcome<'a> {
        self.0.present()
    }

    fn draw_pixel(&mut self, point: BackendCoord, colour: BackendColor) -> Outcome<'a> {
        self.0.draw_pixel(point, colour)
    }

    fn draw_rect<S: BackendStyle>(&mut self, a: BackendCoord, b: BackendCoord, style: &S, fill: bool) -> Outcome<'a> {
        self.0.draw_rect(a, b, style, fill)
    }

    fn draw_text<S: BackendTextStyle>(&mut self, text: &str, style: &S, at: BackendCoord) -> Outcome<'a> {
        let share = match style.anchor().v_pos {
            VPos::Top => 0.15,
            VPos::Center => 0.216,
            VPos::Bottom => 0.09,
        };
        let shift = (share * style.size()).round() as i32;
        let (dx, dy) = style.transform().transform(0, shift);
        self.0.draw_text(text, style, (at.0 + dx, at.1 + dy))
    }
}
