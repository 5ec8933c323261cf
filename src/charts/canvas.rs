//! From a figure to its two files: SVG with text as text, and PNG drawn at twice the size and averaged down.

use super::bitmap::Bitmap;
use crate::files::write_whole;
use plotters::coord::Shift;
use plotters::drawing::DrawingAreaErrorKind;
use plotters::prelude::{BitMapBackend, DrawingArea, DrawingBackend, IntoDrawingArea, SVGBackend, WHITE};
use plotters::style::{FontStyle, register_font};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// Drawing units per pixel of the finished picture. plotters' backends round to whole units, which would show.
pub(super) const FINE: i32 = 2;

/// The one font family. Generic, so that an SVG names a font every reader has; PNG and layout use DejaVu Sans, which
/// is wider than most, so that text laid out for it fits.
pub(super) const FONT: &str = "sans-serif";

/// Why a figure could not be made.
#[derive(Debug, thiserror::Error)]
pub enum ChartError {
    /// The drawing itself failed.
    #[error("could not draw: {0}")]
    Draw(String),
    /// The picture could not be encoded.
    #[error("could not encode the picture")]
    Encode(#[from] png::EncodingError),
    /// The file could not be written.
    #[error("could not write {}", path.display())]
    Write {
        /// Which file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
}

impl<E: std::error::Error + Send + Sync> From<DrawingAreaErrorKind<E>> for ChartError {
    fn from(error: DrawingAreaErrorKind<E>) -> Self {
        Self::Draw(format!("{error:?}"))
    }
}

/// What drawing returns.
pub(super) type Drawn<T = ()> = Result<T, ChartError>;

/// A part of the picture, in drawing units from its upper left corner.
pub(super) type Area<DB> = DrawingArea<DB, Shift>;

/// A figure: drawn the same way on either backend.
pub(super) trait Figure {
    /// Width and height of the finished picture in pixels.
    fn size(&self) -> (u32, u32) {
        (1200, 750)
    }

    /// Draws onto a white area.
    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Drawn;
}

/// Writes `stem.svg` and `stem.png`.
pub(super) fn write_both(figure: &impl Figure, stem: &Path) -> Drawn {
    write_svg(figure, &stem.with_extension("svg"))?;
    write_png(figure, &stem.with_extension("png"))
}

/// Writes `figure` as SVG to `path`.
pub(super) fn write_svg(figure: &impl Figure, path: &Path) -> Drawn {
    register();
    let (width, height) = figure.size();
    let fine = fine_size(figure);
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, fine).into_drawing_area();
        area.fill(&WHITE)?;
        figure.draw(&area)?;
        area.present()?;
    }
    let header = format!("width=\"{}\" height=\"{}\" viewBox", fine.0, fine.1);
    let shown = format!("width=\"{width}\" height=\"{height}\" viewBox");
    let text = text.replacen(&header, &shown, 1).replace(" opacity=\"1\"", "");
    save(path, text.as_bytes())
}

/// Writes `figure` as PNG to `path`.
pub(super) fn write_png(figure: &impl Figure, path: &Path) -> Drawn {
    register();
    let (width, height) = figure.size();
    let fine = fine_size(figure);
    let mut pixels = vec![255; 3 * fine.0 as usize * fine.1 as usize];
    {
        let area = Bitmap(BitMapBackend::with_buffer(&mut pixels, fine)).into_drawing_area();
        figure.draw(&area)?;
        area.present()?;
    }
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Best);
    encoder.set_adaptive_filter(png::AdaptiveFilterType::Adaptive);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&averaged(&pixels, width as usize, height as usize))?;
    writer.finish()?;
    save(path, &bytes)
}

fn fine_size(figure: &impl Figure) -> (u32, u32) {
    let (width, height) = figure.size();
    (width * FINE as u32, height * FINE as u32)
}

fn save(path: &Path, bytes: &[u8]) -> Drawn {
    write_whole(path, bytes).map_err(|source| ChartError::Write {
        path: path.to_path_buf(),
        source,
    })
}

/// One pixel from each `FINE` × `FINE` block, the mean of each channel.
fn averaged(pixels: &[u8], width: usize, height: usize) -> Vec<u8> {
    let fine = FINE as usize;
    let mut result = Vec::with_capacity(3 * width * height);
    for y in 0..height {
        for x in 0..width {
            for channel in 0..3 {
                let block = (0..fine * fine).map(|k| {
                    let (dx, dy) = (k % fine, k / fine);
                    u32::from(pixels[3 * ((y * fine + dy) * width * fine + x * fine + dx) + channel])
                });
                let count = (fine * fine) as u32;
                result.push(((block.sum::<u32>() + count / 2) / count) as u8);
            }
        }
    }
    result
}

/// Registers the font, once.
fn register() {
    static DONE: OnceLock<()> = OnceLock::new();
    DONE.get_or_init(|| {
        // The fonts are constants that parse; were they not, drawing text would say so.
        let _ = register_font(FONT, FontStyle::Normal, dejavu::sans::regular());
        let _ = register_font(FONT, FontStyle::Bold, dejavu::sans::bold());
    });
}
