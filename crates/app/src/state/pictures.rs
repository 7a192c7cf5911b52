//! Pictures of textures on the graphics card, decoded by a worker and blended for the pad.

use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

use egui::{ColorImage, Context, TextureHandle, TextureId, TextureOptions};
use shagreen_core::surfaces::quilt::Pixels;
use shagreen_formats::library::TextureEntry;
use shagreen_formats::picture::{Picture, Rgb, decode};
use shagreen_formats::project::ProjectLibrary;

use crate::state::pad_surface::{LitSurface, PadSurface};

/// Side of the blended picture, in pixels.
const BLEND_SIDE: usize = 192;
/// Half width of the mean filter that separates lighting from grain, in pixels: about 3 mm.
const BLUR: usize = 28;
/// Largest deviation of the grain from the mean, on a scale of 255.
const MAX_GRAIN: f32 = 70.0;

/// Pictures of the textures, by index. A missing picture, or one that is still being decoded, is plain.
pub struct Pictures {
    thumbnails: Vec<Option<TextureHandle>>,
    pixels: Vec<Option<Arc<Rgb>>>,
    millimeters: Vec<f64>,
    /// Hash of each picture, and the generation of its decoded pixels.
    fingerprints: Vec<(Option<u64>, u64)>,
    incoming: Receiver<Decoded>,
    sender: Sender<Decoded>,
    /// Library of the pictures, and the textures that the project added.
    library: ProjectLibrary,
    joined: Vec<Arc<TextureEntry>>,
    /// Pictures that no worker decodes yet: generation, index of the texture, and picture.
    undecoded: Vec<(u64, usize, Picture)>,
    /// Increases when the set of textures changes; results of earlier generations may be stale.
    generation: u64,
    /// Blended textures of the surface that is shown or being made.
    blended: Option<Shares>,
    surface: LitSurface,
}

/// Indices of the blended textures, and their weights in thousandths.
type Shares = Vec<(usize, u32)>;

/// Decoded picture: generation, index of the texture, and pixels.
type Decoded = (u64, usize, Rgb);

/// Width of the surface shown for a texture without a picture, in mm.
const USUAL_SIDE_MM: f64 = 20.0;

impl Pictures {
    /// Pictures of `textures`, which are those of the library and those that the project added. They are not decoded
    /// yet.
    pub fn new(library: ProjectLibrary, joined: &[Arc<TextureEntry>], textures: &[TextureEntry]) -> Self {
        let (sender, incoming) = channel();
        let mut pictures = Self {
            thumbnails: Vec::new(),
            pixels: Vec::new(),
            millimeters: Vec::new(),
            fingerprints: Vec::new(),
            incoming,
            sender,
            library,
            joined: joined.to_vec(),
            undecoded: Vec::new(),
            generation: 0,
            blended: None,
            surface: LitSurface::default(),
        };
        pictures.extend(textures);
        pictures
    }

    /// Follows the open library and the added textures; `textures` contains both.
    pub fn follow(
        &mut self,
        library: &ProjectLibrary,
        joined: &[Arc<TextureEntry>],
        textures: &[TextureEntry],
    ) {
        let is_same = |(a, b): (&Arc<TextureEntry>, &Arc<TextureEntry>)| Arc::ptr_eq(a, b);
        let has_same_joined =
            self.joined.len() == joined.len() && self.joined.iter().zip(joined).all(is_same);
        if has_same_joined && self.library == *library {
            return;
        }
        self.generation += 1;
        self.surface.clear();
        (self.library, self.joined) = (library.clone(), joined.to_vec());
        let before = self.fingerprints.iter().zip(textures);
        let n_kept = before.take_while(|((known, _), t)| *known == fingerprint(t.picture.as_ref())).count();
        self.thumbnails.truncate(n_kept);
        self.pixels.truncate(n_kept);
        self.millimeters.truncate(n_kept);
        self.fingerprints.truncate(n_kept);
        self.undecoded.retain(|(_, index, _)| *index < n_kept);
        self.extend(&textures[n_kept..]);
    }

    /// Appends textures to the known ones.
    fn extend(&mut self, textures: &[TextureEntry]) {
        for texture in textures {
            let picture = texture.picture.as_ref();
            if let Some(picture) = picture {
                self.undecoded.push((self.generation, self.millimeters.len(), picture.clone()));
            }
            self.millimeters.push(picture.map_or(USUAL_SIDE_MM, |picture| picture.millimeters));
            self.fingerprints.push((fingerprint(picture), self.generation));
        }
        self.thumbnails.resize(self.millimeters.len(), None);
        self.pixels.resize(self.millimeters.len(), None);
        self.blended = None;
    }

    /// Decodes waiting pictures in the background, once a frame. `ctx` is asked to repaint when a picture is ready.
    pub fn begin_work(&mut self, ctx: &Context) {
        if self.undecoded.is_empty() {
            return;
        }
        let sources = std::mem::take(&mut self.undecoded);
        let (sender, ctx) = (self.sender.clone(), ctx.clone());
        std::thread::spawn(move || {
            for (generation, index, source) in sources {
                // A picture that cannot be decoded stays plain; the reader of the library has already warned about it.
                if let Ok(image) = decode(&source) {
                    if sender.send((generation, index, image)).is_err() {
                        return;
                    }
                    ctx.request_repaint();
                }
            }
        });
    }

    /// Takes in decoded pictures.
    pub fn collect(&mut self, ctx: &Context) {
        while let Ok((generation, index, image)) = self.incoming.try_recv() {
            // Another texture may have this index by now.
            if self.fingerprints.get(index).is_none_or(|(_, wanted)| *wanted != generation) {
                continue;
            }
            let color = ColorImage::from_rgb([image.width as usize, image.height as usize], &image.pixels);
            let options =
                TextureOptions { mipmap_mode: Some(egui::TextureFilter::Linear), ..TextureOptions::LINEAR };
            self.thumbnails[index] = Some(ctx.load_texture(format!("texture {index}"), color, options));
            self.pixels[index] = Some(image.into());
            self.blended = None;
        }
    }

    /// Picture of a texture.
    pub fn thumbnail(&self, texture: usize) -> Option<&TextureHandle> {
        self.thumbnails.get(texture)?.as_ref()
    }

    /// Surface of the pad as it is shown, with its width and height in mm.
    pub(crate) fn surface(&self) -> Option<(TextureId, [f64; 2])> {
        self.surface.shown()
    }

    /// Whether a worker is making or lighting the surface of the pad.
    pub fn is_busy(&self) -> bool {
        self.surface.is_busy()
    }

    /// Surface with the blended picture, weighted like the vibrations, and its width and height in mm. A worker makes it;
    /// until then, the previous surface is returned. `light` is the direction of the light.
    pub(crate) fn blend(
        &mut self,
        ctx: &Context,
        parents: &[(usize, f64)],
        light: u8,
    ) -> Option<(TextureId, [f64; 2])> {
        let wanted: Shares = parents.iter().map(|(i, w)| (*i, (w * 1000.0).round() as u32)).collect();
        self.surface.collect(ctx);
        if self.blended.as_ref() != Some(&wanted) && !self.surface.is_busy() {
            let sources = parents.iter().map(|(i, w)| Some((Arc::clone(self.pixels.get(*i)?.as_ref()?), *w)));
            if let Some(sources) = sources.collect::<Option<Vec<(Arc<Rgb>, f64)>>>() {
                let width_mm = parents.iter().map(|(i, w)| w * self.millimeters[*i]).sum();
                self.surface.make(ctx, move || Some(PadSurface::new(&mix(&sources), width_mm)));
                self.blended = Some(wanted);
            }
        }
        self.surface.show(ctx, light)
    }
}

/// Weighted mean of pictures, with their contrast restored.
pub(crate) fn mix(parents: &[(Arc<Rgb>, f64)]) -> Pixels {
    let mut sum = vec![[0.0_f32; 3]; BLEND_SIDE * BLEND_SIDE];
    for (image, weight) in parents {
        let (width, height) = (image.width as usize, image.height as usize);
        for (i, pixel) in sum.iter_mut().enumerate() {
            let (x, y) = (i % BLEND_SIDE * width / BLEND_SIDE, i / BLEND_SIDE * height / BLEND_SIDE);
            let at = 3 * (y * width + x);
            for (channel, value) in pixel.iter_mut().zip(&image.pixels[at..at + 3]) {
                *channel += *weight as f32 * f32::from(*value);
            }
        }
    }
    // Averaging independent pictures reduces the contrast by the root of the sum of squared weights, so the grain is
    // divided by it. Lighting would repeat with every tile, so everything coarser than the grain is removed.
    let kept = parents.iter().map(|(_, w)| w * w).sum::<f64>().sqrt() as f32;
    let n = sum.len() as f32;
    let mean: [f32; 3] = std::array::from_fn(|c| sum.iter().map(|p| p[c]).sum::<f32>() / n);
    let light = blurred(&sum);
    let channel = |c: usize, p: &[f32; 3], light: &[f32; 3]| {
        let grain = ((p[c] - light[c]) / kept).clamp(-MAX_GRAIN, MAX_GRAIN);
        (mean[c] + grain).clamp(0.0, 255.0)
    };
    let colors = sum.iter().zip(&light).map(|(p, l)| [channel(0, p, l), channel(1, p, l), channel(2, p, l)]);
    Pixels { width: BLEND_SIDE, colors: colors.collect() }
}

/// Hash of a picture's bytes and size.
fn fingerprint(picture: Option<&Picture>) -> Option<u64> {
    picture.map(|picture| {
        let mut hasher = DefaultHasher::new();
        picture.bytes.hash(&mut hasher);
        picture.millimeters.to_bits().hash(&mut hasher);
        hasher.finish()
    })
}

/// Mean over [`BLUR`] pixels in each direction, with periodic edges.
fn blurred(pixels: &[[f32; 3]]) -> Vec<[f32; 3]> {
    let along = |source: &[[f32; 3]], at: &dyn Fn(usize, usize) -> usize| {
        let mut out = vec![[0.0; 3]; source.len()];
        for line in 0..BLEND_SIDE {
            let mut window = [0.0_f32; 3];
            let add = |window: &mut [f32; 3], i: usize, sign: f32| {
                let pixel = source[at(line, i % BLEND_SIDE)];
                window.iter_mut().zip(pixel).for_each(|(w, p)| *w += sign * p);
            };
            (0..2 * BLUR).for_each(|i| add(&mut window, BLEND_SIDE - BLUR + i, 1.0));
            for i in 0..BLEND_SIDE {
                add(&mut window, i + BLUR, 1.0);
                out[at(line, i)] = window.map(|w| w / (2 * BLUR + 1) as f32);
                add(&mut window, BLEND_SIDE + i - BLUR, -1.0);
            }
        }
        out
    };
    let rows = along(pixels, &|line, i| line * BLEND_SIDE + i);
    along(&rows, &|line, i| i * BLEND_SIDE + line)
}

#[cfg(test)]
mod tests {
    use super::{BLEND_SIDE, BLUR, blurred};

    #[test]
    fn the_light_is_the_mean_around_each_pixel() {
        let pixels: Vec<[f32; 3]> = (0..BLEND_SIDE * BLEND_SIDE)
            .map(|i| [(i * 7919 % 251) as f32, (i % BLEND_SIDE) as f32, 9.0])
            .collect();
        let light = blurred(&pixels);
        let at = |x: usize, y: usize| y % BLEND_SIDE * BLEND_SIDE + x % BLEND_SIDE;
        for (x, y) in [(0, 0), (5, 190), (100, 17), (191, 191)] {
            let mut mean = [0.0_f64; 3];
            for dy in 0..=2 * BLUR {
                for dx in 0..=2 * BLUR {
                    let pixel = pixels[at(x + BLEND_SIDE + dx - BLUR, y + BLEND_SIDE + dy - BLUR)];
                    mean.iter_mut().zip(pixel).for_each(|(m, p)| *m += f64::from(p));
                }
            }
            let n = ((2 * BLUR + 1) * (2 * BLUR + 1)) as f64;
            for (m, l) in mean.iter().zip(light[at(x, y)]) {
                // Tolerance of running sums in f32 over 192 pixels of up to 255.
                assert!((m / n - f64::from(l)).abs() < 0.01, "at {x}, {y}: {l} for {}", m / n);
            }
        }
    }
}
