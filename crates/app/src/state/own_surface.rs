//! Surface of the pad from the picture of an authored texture.

use std::sync::Arc;

use egui::{Context, TextureId};
use shagreen_core::surfaces::quilt::Pixels;
use shagreen_formats::picture::{Picture, Rgb, decode};

use crate::state::pad_surface::{LitSurface, PadSurface};

/// Picture of an authored texture, as the pad shows it.
#[derive(Clone, Debug)]
pub(crate) struct SurfacePicture {
    pub(crate) picture: Arc<Picture>,
    /// Whether the texture is felt where the picture shows it: the pad then repeats the picture as it is. Otherwise it shows
    /// a larger surface that looks like the picture.
    pub(crate) is_felt: bool,
}

/// Surface with the picture of an authored texture, on the graphics card.
#[derive(Default)]
pub(crate) struct OwnSurface {
    of: Option<SurfacePicture>,
    surface: LitSurface,
}

impl OwnSurface {
    /// Loads `own`, the picture of the audible texture. Returns its surface with width and height in mm when it is made.
    /// `light` is the direction of the light.
    pub(crate) fn follow(
        &mut self,
        own: Option<SurfacePicture>,
        ctx: &Context,
        light: u8,
    ) -> Option<(TextureId, [f64; 2])> {
        // Pictures that are one are equal without a look at their bytes.
        let is_same = match (&self.of, &own) {
            (Some(before), Some(now)) => {
                before.is_felt == now.is_felt
                    && (Arc::ptr_eq(&before.picture, &now.picture) || before.picture == now.picture)
            }
            (before, now) => before.is_none() && now.is_none(),
        };
        self.of = own;
        if !is_same {
            self.surface.clear();
            if let Some(SurfacePicture { picture, is_felt }) = self.of.clone() {
                let make = if is_felt { PadSurface::tile } else { PadSurface::new };
                // Errors were reported when the picture was read; the pad shows none.
                let surface = move || Some(make(&pixels_of(&decode(&picture).ok()?), picture.millimeters));
                self.surface.make(ctx, surface);
            }
        }
        self.of.as_ref()?;
        self.surface.show(ctx, light)
    }
}

/// Pixels of a decoded picture.
pub(crate) fn pixels_of(rgb: &Rgb) -> Pixels {
    let colors = rgb.pixels.as_chunks::<3>().0.iter().map(|color| color.map(f32::from));
    Pixels { width: rgb.width as usize, colors: colors.collect() }
}
