//! PNG export of figures: resvg rasterizes the SVG with an embedded font.

use std::sync::Arc;

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb};

use crate::figure::{Figure, figure_svg};

/// Image pixels per SVG pixel: sharp in print and on high-density screens.
const PIXELS: f32 = 2.0;

/// Why a figure was not rasterized.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PngError {
    /// The SVG renderer rejected the SVG.
    #[error("cannot render the figure as PNG ({0}); save it as SVG")]
    Svg(#[from] resvg::usvg::Error),
    /// There is not enough memory for the image.
    #[error("not enough memory for an image of {0} pixels; save the figure as SVG")]
    Memory(u64),
    /// The image could not be encoded as PNG.
    #[error("cannot encode the figure as PNG ({0}); save it as SVG")]
    Encode(String),
}

/// Renders a figure as PNG, with two image pixels per SVG pixel.
///
/// # Errors
/// [`PngError`] if the SVG is rejected, or memory for the image or its file is insufficient.
pub fn figure_png(figure: &Figure) -> Result<Vec<u8>, PngError> {
    let mut fonts = fontdb::Database::new();
    fonts.load_font_data(epaint_default_fonts::UBUNTU_LIGHT.to_vec());
    let family = fonts.faces().next().and_then(|face| face.families.first()).map(|(name, _)| name.clone());
    if let Some(family) = family {
        fonts.set_sans_serif_family(family);
    }
    let options = Options { fontdb: Arc::new(fonts), ..Options::default() };
    let tree = Tree::from_str(&figure_svg(figure), &options)?;
    let size = tree.size();
    let pixels = |length: f32| (length * PIXELS).ceil() as u32;
    let (width, height) = (pixels(size.width()), pixels(size.height()));
    let mut picture =
        Pixmap::new(width, height).ok_or(PngError::Memory(u64::from(width) * u64::from(height)))?;
    resvg::render(&tree, Transform::from_scale(PIXELS, PIXELS), &mut picture.as_mut());
    picture.encode_png().map_err(|error| PngError::Encode(error.to_string()))
}

#[cfg(test)]
mod tests {
    use super::figure_png;
    use crate::figure::{Figure, Table};

    /// The image has twice the size of the SVG, and dark pixels where there is text.
    #[test]
    fn a_figure_becomes_pixels_with_its_words() {
        let figure = |title: &str| {
            Figure::Table(Table {
                title: title.to_owned(),
                columns: Vec::new(),
                rows: Vec::new(),
                decimals: 1,
                n_counts: 0,
                source: String::new(),
            })
        };
        let dark = |title: &str| {
            let picture = image::load_from_memory(&figure_png(&figure(title)).unwrap()).unwrap().to_luma8();
            assert_eq!(picture.dimensions(), (1520, 1240));
            picture.pixels().filter(|pixel| pixel.0[0] < 128).count()
        };
        assert_eq!(dark(""), 0);
        assert!(dark("Words that are read") > 500);
    }
}
