//! From a figure to its two files: SVG with text as text, and PNG drawn at twice the size and averaged down.

use super::bitmap::Bitmap;
use crate::suite::files::write_whole;
use plotters::coord::Shift;
use plotters::drawing::DrawingAreaErrorKind;
use plotters::prelude::{BitMapBackend, DrawingArea, DrawingBackend, IntoDrawingArea, SVGBackend, WHITE};
use plotters::style::{FontStyle, register_font};
use std::collections::BTreeMap;
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
    let mut text = text.replacen(&header, &shown, 1);
    // What every reader takes for granted.
    for default in [" opacity=\"1\"", " stroke=\"none\""] {
        text = text.replace(default, "");
    }
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
    save(
        path,
        &encoded(&averaged(&pixels, width as usize, height as usize), width, height)?,
    )
}

/// Colours of a PNG: a sixth of the size of one of all colours, and the eye sees no difference.
const COLOURS: usize = 64;

/// `pixels` as a PNG of [`COLOURS`].
fn encoded(pixels: &[[u8; 3]], width: u32, height: u32) -> Drawn<Vec<u8>> {
    let (palette, indices) = indexed(pixels);
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette(palette.concat());
    encoder.set_compression(png::Compression::Best);
    // Neighbouring indices say nothing of neighbouring colours, so filters only hinder.
    encoder.set_filter(png::FilterType::NoFilter);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&indices)?;
    writer.finish()?;
    Ok(bytes)
}

/// The [`COLOURS`] most frequent colours, and for each pixel the index of the nearest of them.
fn indexed(pixels: &[[u8; 3]]) -> (Vec<[u8; 3]>, Vec<u8>) {
    let mut counts: BTreeMap<[u8; 3], usize> = BTreeMap::new();
    for pixel in pixels {
        *counts.entry(*pixel).or_default() += 1;
    }
    let mut colours: Vec<([u8; 3], usize)> = counts.into_iter().collect();
    colours.sort_by_key(|(colour, count)| (std::cmp::Reverse(*count), *colour));
    let palette: Vec<[u8; 3]> = colours.iter().take(COLOURS).map(|(colour, _)| *colour).collect();
    let distance = |a: [u8; 3], b: [u8; 3]| (0..3).map(|k| u32::from(a[k].abs_diff(b[k])).pow(2)).sum::<u32>();
    let nearest = |colour: [u8; 3]| {
        (0..palette.len())
            .min_by_key(|k| distance(palette[*k], colour))
            .unwrap_or(0) as u8
    };
    let known: BTreeMap<[u8; 3], u8> = colours.iter().map(|(colour, _)| (*colour, nearest(*colour))).collect();
    let indices = pixels.iter().map(|pixel| known[pixel]).collect();
    (palette, indices)
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
fn averaged(pixels: &[u8], width: usize, height: usize) -> Vec<[u8; 3]> {
    let fine = FINE as usize;
    let count = (fine * fine) as u32;
    let mean = |x: usize, y: usize, channel: usize| {
        let places = (0..fine * fine).map(|k| (y * fine + k / fine) * width * fine + x * fine + k % fine);
        let sum: u32 = places.map(|place| u32::from(pixels[3 * place + channel])).sum();
        ((sum + count / 2) / count) as u8
    };
    let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    places
        .map(|(x, y)| [mean(x, y, 0), mean(x, y, 1), mean(x, y, 2)])
        .collect()
}

/// Registers the font, once.
pub(super) fn register() {
    static DONE: OnceLock<()> = OnceLock::new();
    DONE.get_or_init(|| {
        // The fonts are constants that parse; were they not, drawing text would say so.
        let _ = register_font(FONT, FontStyle::Normal, dejavu::sans::regular());
        let _ = register_font(FONT, FontStyle::Bold, dejavu::sans::bold());
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_becomes_its_mean() {
        // Two pixels wide, one high: a left block of 0, 0, 0, 255 and a right one of 10 throughout, in every channel.
        let rows = [[0u8, 0, 10, 10], [0, 255, 10, 10]];
        let fine: Vec<u8> = rows.concat().into_iter().flat_map(|value| [value; 3]).collect();
        assert_eq!(averaged(&fine, 2, 1), [[64; 3], [10; 3]]);
    }

    #[test]
    fn rare_colours_become_their_nearest() {
        let frequent = 2 * COLOURS;
        let mut pixels: Vec<[u8; 3]> = (0..COLOURS as u8).flat_map(|value| [[value; 3]; 2]).collect();
        pixels.push([9, 9, 10]);
        let (palette, indices) = indexed(&pixels);
        assert_eq!(palette.len(), COLOURS);
        assert_eq!(palette[indices[frequent] as usize], [9; 3]);
        for (pixel, index) in pixels.iter().zip(&indices).take(frequent) {
            assert_eq!(palette[*index as usize], *pixel);
        }
    }
}
