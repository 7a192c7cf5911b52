//! Surface of the pad from the picture of an authored texture.

use std::sync::Arc;

use egui::{Context, TextureId};
use shagreen_core::surfaces::quilt::Pixels;
use shagreen_formats::picture::{Picture, Rgb, decode};

use crate::state::pad_surface::LitSurface;

/// Surface with the picture of an authored texture, on the graphics card.
#[derive(Default)]
pub(crate) struct OwnSurface {
    of: Option<Arc<Picture>>,
    surface: LitSurface,
}

impl OwnSurface {
    /// Loads `picture`, that of the audible texture. Returns its surface with width and height in mm when it is made.
    /// `light` is the direction of the light.
    pub(crate) fn follow(
        &mut self,
        picture: Option<&Arc<Picture>>,
        ctx: &Context,
        light: u8,
    ) -> Option<(TextureId, [f64; 2])> {
        let is_same = match (&self.of, picture) {
            (Some(before), Some(now)) => Arc::ptr_eq(before, now) || before == now,
            (before, now) => before.is_none() && now.is_none(),
        };
        self.of = picture.map(Arc::clone);
        if !is_same {
            self.surface.clear();
            if let Some(picture) = self.of.clone() {
                // Errors were reported when the picture was read; the pad shows none.
                let pixels = move || Some((pixels_of(&decode(&picture).ok()?), picture.millimeters));
                self.surface.make(ctx, pixels);
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
