//! What pictures of all examples have in common: colours, text, and the way from SVG to pixels.

use plotters::coord::Shift;
use plotters::prelude::*;

/// A part of the picture.
pub type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Kirchhoff, Newton–Euler, hybrid, Lagrange: from the palette of Okabe and Ito, told apart by every kind of colour
/// vision.
pub const COLOURS: [RGBColor; 4] =
    [RGBColor(0, 114, 178), RGBColor(213, 94, 0), RGBColor(0, 158, 115), RGBColor(204, 121, 167)];
/// Text and axes.
pub const INK: RGBColor = RGBColor(45, 45, 45);
/// Grids and shadows.
pub const PALE: RGBColor = RGBColor(222, 222, 222);

/// Text of a size in a colour.
#[must_use]
pub fn text_style(size: u32, colour: RGBColor) -> TextStyle<'static> {
    ("sans-serif", f64::from(size)).into_font().color(&colour)
}

/// The picture in pixels. Text is set in DejaVu Sans, which comes with the program: nothing is asked of the system.
///
/// # Errors
/// When the SVG is not one.
#[cfg(feature = "png")]
pub fn png(svg: &str) -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    use resvg::{tiny_skia, usvg};

    let mut options = usvg::Options::default();
    let fonts = options.fontdb_mut();
    fonts.load_font_data(dejavu::sans::regular().to_vec());
    fonts.set_sans_serif_family("DejaVu Sans");
    let tree = usvg::Tree::from_str(svg, &options)?;
    let size = tree.size().to_int_size();
    let mut pixels = tiny_skia::Pixmap::new(size.width(), size.height()).ok_or("the picture has no size")?;
    resvg::render(&tree, tiny_skia::Transform::default(), &mut pixels.as_mut());
    Ok(pixels.encode_png()?)
}
