//! Picture of an authored texture: read from a photo, and decoded for the pad.

use std::sync::Arc;
use std::sync::mpsc::Receiver;

use egui::{ColorImage, Context, TextureHandle, TextureOptions};
use shagreen_formats::picture::{Picture, Rgb, decode, of_photo};

use crate::state::background::in_background;
use crate::state::source::Source;

/// Default width of the surface that a photo shows, in mm.
const USUAL_WIDTH_MM: f64 = 50.0;

/// Photo that is being read, with the key of its authored texture.
#[derive(Default)]
pub(crate) struct PhotoReader {
    reading: Option<(u32, Receiver<Result<Picture, String>>)>,
}

impl PhotoReader {
    /// Reads a photo in the background, for the authored texture with this key.
    pub(crate) fn read(&mut self, source: Source, key: u32, ctx: &Context) {
        let name = source.name();
        let work = move || {
            let bytes = source.bytes()?;
            of_photo(&bytes, USUAL_WIDTH_MM).map_err(|error| format!("{error}: {name}"))
        };
        self.reading = Some((key, in_background(ctx.clone(), work)));
    }

    /// Key of the texture, and the picture or the error, when reading is complete.
    pub(crate) fn collect(&mut self) -> Option<(u32, Result<Picture, String>)> {
        let (key, receiver) = self.reading.as_ref()?;
        let outcome = (*key, receiver.try_recv().ok()?);
        self.reading = None;
        Some(outcome)
    }
}

/// Picture of an authored texture on the graphics card.
#[derive(Default)]
pub(crate) struct OwnPicture {
    of: Option<Arc<Picture>>,
    decoding: Option<Receiver<Option<Rgb>>>,
    texture: Option<TextureHandle>,
}

impl OwnPicture {
    /// Loads `picture`, that of the audible texture. Returns it with the width and height of the shown surface in mm
    /// when it is loaded.
    pub(crate) fn follow(
        &mut self,
        picture: Option<&Arc<Picture>>,
        ctx: &Context,
    ) -> Option<(&TextureHandle, [f64; 2])> {
        let has_same_pixels = match (&self.of, picture) {
            (Some(before), Some(now)) => Arc::ptr_eq(before, now) || before.bytes == now.bytes,
            (before, now) => before.is_none() && now.is_none(),
        };
        self.of = picture.map(Arc::clone);
        if !has_same_pixels {
            self.texture = None;
            self.decoding = self.of.clone().map(|picture| {
                // Errors were reported when the picture was read; the pad shows none.
                in_background(ctx.clone(), move || decode(&picture).ok())
            });
        }
        if let Some(decoded) = self.decoding.as_ref().and_then(|decoding| decoding.try_recv().ok()) {
            self.decoding = None;
            self.texture = decoded.map(|rgb| {
                let image = ColorImage::from_rgb([rgb.width as usize, rgb.height as usize], &rgb.pixels);
                ctx.load_texture("own picture", image, TextureOptions::LINEAR_MIRRORED_REPEAT)
            });
        }
        let picture = self.of.as_ref()?;
        let height_mm = picture.millimeters * f64::from(picture.height) / f64::from(picture.width);
        Some((self.texture.as_ref()?, [picture.millimeters, height_mm]))
    }
}
