//! Surface of the pad: a picture without visible tiles, lit from a side.

use std::sync::Arc;

use egui::{Color32, ColorImage, Context, TextureHandle, TextureId, TextureOptions};
use shagreen_core::surfaces::quilt::{Pixels, quilted};

use crate::state::background::LatestJob;

/// Size of the picture in pixels, about; the pad repeats it.
const SIZE: [usize; 2] = [768, 384];
/// Resolution in pixels per millimeter, and the longest side of the sample in pixels.
const PIXELS_PER_MM: f64 = 6.0;
const LONGEST_SAMPLE: usize = 224;
/// Longest side of a tile in pixels that is shown pixel by pixel.
const LONGEST_TILE: usize = 256;
/// Number of directions of the light.
pub(crate) const N_LIGHTS: u8 = 32;
/// Light from the upper left, as in the thumbnails.
pub(crate) const USUAL_LIGHT: u8 = 20;
/// How much the slope of the brightness tilts the surface, and the strongest change of brightness.
const TILT: f32 = 0.012;
const MAX_SHADE: f32 = 0.45;

/// A picture of a surface, which repeats without a seam.
#[derive(Clone, Debug)]
pub(crate) struct PadSurface {
    pixels: Pixels,
    /// Width and height in mm.
    pub(crate) size_mm: [f64; 2],
}

impl PadSurface {
    /// Makes a surface like a picture of `width_mm`, in the size of the pad.
    pub(crate) fn new(picture: &Pixels, width_mm: f64) -> Self {
        Self::of_size(picture, width_mm, SIZE)
    }

    /// Makes a surface of about `size` pixels (width, height) like a picture of `width_mm`.
    pub(crate) fn of_size(picture: &Pixels, width_mm: f64, size: [usize; 2]) -> Self {
        let longest = picture.width.max(picture.height());
        let wanted = (PIXELS_PER_MM * width_mm * longest as f64 / picture.width as f64) as usize;
        let sample = reduced(picture, longest.div_ceil(wanted.clamp(32, LONGEST_SAMPLE)).max(1));
        let mm_per_pixel = width_mm / sample.width as f64;
        // The seed is fixed: the same texture always looks the same.
        let pixels = quilted(&sample, size, 1).unwrap_or(sample);
        let size_mm = [pixels.width, pixels.height()].map(|side| side as f64 * mm_per_pixel);
        Self { pixels, size_mm }
    }

    /// The surface of a seamless picture of `width_mm`, pixel by pixel: what the picture shows lies where it is felt.
    pub(crate) fn tile(picture: &Pixels, width_mm: f64) -> Self {
        let is_large = picture.width.max(picture.height()) > LONGEST_TILE;
        // Only whole pixels keep the picture seamless.
        let can_be_halved = picture.width.is_multiple_of(2) && picture.height().is_multiple_of(2);
        let pixels = reduced(picture, if is_large && can_be_halved { 2 } else { 1 });
        let mm_per_pixel = width_mm / pixels.width as f64;
        let size_mm = [pixels.width, pixels.height()].map(|side| side as f64 * mm_per_pixel);
        Self { pixels, size_mm }
    }

    /// The surface under a light from one of [`N_LIGHTS`] directions, counterclockwise from the right. Bright places
    /// count as high.
    pub(crate) fn lit(&self, light: u8) -> ColorImage {
        let angle = f32::from(light) * std::f32::consts::TAU / f32::from(N_LIGHTS);
        let (toward_x, toward_y) = (angle.cos(), -angle.sin());
        let (width, height) = (self.pixels.width, self.pixels.height());
        let bright: Vec<f32> =
            self.pixels.colors.iter().map(|color| color.iter().sum::<f32>() / 3.0).collect();
        let mut colors = Vec::with_capacity(bright.len());
        for y in 0..height {
            let (above, below) = ((y + height - 1) % height * width, (y + 1) % height * width);
            for x in 0..width {
                let (left, right) = ((x + width - 1) % width, (x + 1) % width);
                let here = y * width;
                let slope_x = bright[here + right] - bright[here + left];
                let slope_y = bright[below + x] - bright[above + x];
                // A slope that rises away from the light faces it.
                let shade = (-TILT * (slope_x * toward_x + slope_y * toward_y)).clamp(-MAX_SHADE, MAX_SHADE);
                let [r, g, b] =
                    self.pixels.colors[here + x].map(|c| (c * (1.0 + shade)).clamp(0.0, 255.0) as u8);
                colors.push(Color32::from_rgb(r, g, b));
            }
        }
        ColorImage::new([width, height], colors)
    }
}

/// A surface on the graphics card, made and lit by a worker.
#[derive(Default)]
pub(crate) struct LitSurface {
    shown: Option<Shown>,
    job: LatestJob<Option<Made>>,
}

struct Shown {
    surface: Arc<PadSurface>,
    light: u8,
    texture: TextureHandle,
}

struct Made {
    surface: Arc<PadSurface>,
    light: u8,
    image: ColorImage,
}

impl LitSurface {
    /// Whether a worker is busy; another surface must wait.
    pub(crate) fn is_busy(&self) -> bool {
        self.job.is_busy()
    }

    /// Shows nothing anymore, until the next surface is made.
    pub(crate) fn clear(&mut self) {
        *self = Self::default();
    }

    /// Makes the surface that `surface` returns; without one, nothing new is shown. The previous surface stays meanwhile.
    pub(crate) fn make(
        &mut self,
        ctx: &Context,
        surface: impl FnOnce() -> Option<PadSurface> + Send + 'static,
    ) {
        let light = self.shown.as_ref().map_or(USUAL_LIGHT, |shown| shown.light);
        self.job.ask(ctx, move || {
            let surface = Arc::new(surface()?);
            Some(Made { image: surface.lit(light), surface, light })
        });
    }

    /// The surface as it is shown, with its width and height in mm.
    pub(crate) fn shown(&self) -> Option<(TextureId, [f64; 2])> {
        self.shown.as_ref().map(|shown| (shown.texture.id(), shown.surface.size_mm))
    }

    /// The surface with its width and height in mm, if there is one, under a light from this direction as soon as a
    /// worker has lit it.
    pub(crate) fn show(&mut self, ctx: &Context, light: u8) -> Option<(TextureId, [f64; 2])> {
        self.collect(ctx);
        let shown = self.shown.as_ref()?;
        if shown.light != light && !self.job.is_busy() {
            let surface = Arc::clone(&shown.surface);
            self.job.ask(ctx, move || Some(Made { image: surface.lit(light), surface, light }));
        }
        Some((shown.texture.id(), shown.surface.size_mm))
    }

    /// Takes in what the worker has made.
    pub(crate) fn collect(&mut self, ctx: &Context) {
        if let Some(Ok(Some(Made { surface, light, image }))) = self.job.collect(ctx) {
            let texture = match self.shown.take() {
                Some(Shown { mut texture, .. }) => {
                    texture.set(image, TextureOptions::LINEAR_REPEAT);
                    texture
                }
                None => ctx.load_texture("surface", image, TextureOptions::LINEAR_REPEAT),
            };
            self.shown = Some(Shown { surface, light, texture });
        }
    }
}

/// The picture with each side reduced by a whole factor, by means.
fn reduced(picture: &Pixels, factor: usize) -> Pixels {
    let (width, height) = ((picture.width / factor).max(1), (picture.height() / factor).max(1));
    let mean = |x: usize, y: usize| {
        let mut sum = [0.0_f32; 3];
        for dy in 0..factor {
            for dx in 0..factor {
                let color = picture.at(x * factor + dx, y * factor + dy);
                sum.iter_mut().zip(color).for_each(|(sum, c)| *sum += c);
            }
        }
        sum.map(|c| c / (factor * factor) as f32)
    };
    Pixels { width, colors: (0..width * height).map(|i| mean(i % width, i / width)).collect() }
}

#[cfg(test)]
mod tests {
    use super::{N_LIGHTS, PadSurface, Pixels, reduced};

    fn bumps(side: usize) -> Pixels {
        let color =
            |i: usize| [128.0 + 60.0 * (0.5 * (i % side) as f32).sin() * (0.5 * (i / side) as f32).sin(); 3];
        Pixels { width: side, colors: (0..side * side).map(color).collect() }
    }

    #[test]
    fn a_surface_keeps_its_scale_and_its_mean_brightness() {
        let surface = PadSurface::new(&bumps(192), 20.0);
        let [width, height] = surface.size_mm;
        assert!((100.0..200.0).contains(&width) && (50.0..100.0).contains(&height), "{width} x {height} mm");
        let mean = |light: u8| {
            let lit = surface.lit(light);
            lit.pixels.iter().map(|p| f64::from(p.r())).sum::<f64>() / lit.pixels.len() as f64
        };
        assert!((mean(0) - 128.0).abs() < 6.0 && (mean(N_LIGHTS / 2) - 128.0).abs() < 6.0);
    }

    #[test]
    fn a_tile_keeps_its_pixels_and_its_width() {
        let picture = bumps(192);
        let tile = PadSurface::tile(&picture, 20.0);
        assert_eq!((tile.pixels.colors, tile.size_mm), (picture.colors, [20.0; 2]));
        let large = PadSurface::tile(&bumps(512), 18.0);
        assert_eq!((large.pixels.width, large.size_mm), (256, [18.0; 2]));
    }

    #[test]
    fn the_side_that_faces_the_light_is_brighter() {
        // A ramp that rises to the right, then falls: its left flank faces a light from the left.
        let colors = (0..64 * 64).map(|i| {
            let x = (i % 64) as f32;
            [4.0 * if x < 32.0 { x } else { 64.0 - x } + 60.0; 3]
        });
        let surface =
            PadSurface { pixels: Pixels { width: 64, colors: colors.collect() }, size_mm: [1.0; 2] };
        let red = |light: u8, x: usize| i32::from(surface.lit(light).pixels[20 * 64 + x].r());
        let (from_right, from_left) = (0, N_LIGHTS / 2);
        assert!(red(from_left, 16) > red(from_right, 16) + 8);
        assert!(red(from_left, 48) < red(from_right, 48) - 8);
    }

    #[test]
    fn reduction_takes_means() {
        let picture = Pixels { width: 4, colors: (0..8).map(|i| [i as f32; 3]).collect() };
        assert_eq!(reduced(&picture, 2).colors, [[2.5; 3], [4.5; 3]]);
        assert_eq!(reduced(&picture, 1), picture);
    }
}
