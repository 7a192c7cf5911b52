//! The picture that an authored texture has of its own: read from a photo, and unpacked for the pad.

use std::sync::Arc;
use std::sync::mpsc::Receiver;

use egui::{ColorImage, Context, TextureHandle, TextureOptions};
use shagreen_formats::picture::{Picture, Rgb, decode, of_photo};

use crate::background::in_background;
use crate::import::source::Source;

/// How much of a surface a photo is taken to show across at first, in mm.
const USUAL_WIDTH_MM: f64 = 50.0;

/// A photo that is being read, for the authored texture of this key.
pub(crate) struct PhotoReader {
    reading: Option<(u32, Receiver<Result<Picture, String>>)>,
}

impl PhotoReader {
    /// Nothing is being read.
    pub(crate) fn new() -> Self {
        Self { reading: None }
    }

    /// Reads a photo in a thread of its own.
    pub(crate) fn read(&mut self, source: Source, key: u32, ctx: &Context) {
        let name = source.name();
        let work = move || {
            let bytes = source.bytes()?;
            of_photo(&bytes, USUAL_WIDTH_MM).map_err(|error| format!("{error}: {name}"))
        };
        self.reading = Some((key, in_background(ctx.clone(), work)));
    }

    /// What came of it: for which texture, and the picture or why there is none.
    pub(crate) fn collect(&mut self) -> Option<(u32, Result<Picture, String>)> {
        let (key, receiver) = self.reading.as_ref()?;
        let outcome = (*key, receiver.try_recv().ok()?);
        self.reading = None;
        Some(outcome)
    }
}

/// The picture of an authored texture on the graphics card.
#[derive(Default)]
pub(crate) struct OwnPicture {
    of: Option<Arc<Picture>>,
    decoding: Option<Receiver<Option<Rgb>>>,
    texture: Option<TextureHandle>,
}

impl OwnPicture {
    /// Follows the picture of the texture that is heard; returns it with the width and height that it shows in mm, once it is
    /// there.
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
                // One that cannot be unpacked stays away: whoever read it has said so.
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
