//! Pictures of textures on the graphics card: decoded by a worker, blended for the pad.

use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};

use egui::{Color32, ColorImage, Context, TextureHandle, TextureOptions};
use shagreen_formats::library::TextureEntry;
use shagreen_formats::picture::{Picture, Rgb, decode};
use shagreen_formats::project::ProjectLibrary;

use crate::background::in_background;

/// Side of the blended picture in pixels.
const BLEND_SIDE: usize = 192;
/// Half the width of what counts as light rather than grain, in pixels: about 3 mm.
const BLUR: usize = 28;
/// Most that grain may differ from the mean, of 255.
const MAX_GRAIN: f32 = 70.0;

/// The pictures of a library, by index; those still being decoded, or absent, are plain.
pub struct Pictures {
    thumbnails: Vec<Option<TextureHandle>>,
    pixels: Vec<Option<Arc<Rgb>>>,
    millimeters: Vec<f64>,
    /// What tells one picture from another, and the generation that each is decoded in.
    fingerprints: Vec<(Option<u64>, u64)>,
    incoming: Receiver<Decoded>,
    sender: Sender<Decoded>,
    /// The library whose pictures these are, and the textures that joined it.
    library: ProjectLibrary,
    joined: Vec<Arc<TextureEntry>>,
    /// Pictures that no worker decodes yet: in which generation, for which texture.
    undecoded: Vec<(u64, usize, Picture)>,
    /// Goes up when textures join or go: pictures of those that are gone are late.
    generation: u64,
    blended: Option<(Shares, TextureHandle)>,
    /// A blend that a worker mixes.
    mixing: Option<(Shares, Receiver<ColorImage>)>,
}

/// What a blend is of: textures, and their shares in thousandths.
type Shares = Vec<(usize, u32)>;

/// A picture that a worker has decoded, for which texture, and in which generation.
type Decoded = (u64, usize, Rgb);

/// Side of what a texture without a picture would show, in mm.
const USUAL_SIDE_MM: f64 = 20.0;

impl Pictures {
    /// The pictures of `textures`, those of the library and those that joined it, still to be decoded.
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
            mixing: None,
        };
        pictures.extend(textures);
        pictures
    }

    /// Follows the library that is open and the textures that joined it; `textures` are both.
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

    /// Takes in the textures after those that are known.
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
        (self.blended, self.mixing) = (None, None);
    }

    /// Once a frame: decodes what waits for it in a thread of its own; `ctx` is asked to repaint as pictures come in.
    pub fn begin_work(&mut self, ctx: &Context) {
        if self.undecoded.is_empty() {
            return;
        }
        let sources = std::mem::take(&mut self.undecoded);
        let (sender, ctx) = (self.sender.clone(), ctx.clone());
        std::thread::spawn(move || {
            for (generation, index, source) in sources {
                // A picture that cannot be decoded stays plain: the library's reader has warned already.
                if let Ok(image) = decode(&source) {
                    if sender.send((generation, index, image)).is_err() {
                        return;
                    }
                    ctx.request_repaint();
                }
            }
        });
    }

    /// Takes in what the worker has finished.
    pub fn collect(&mut self, ctx: &Context) {
        while let Ok((generation, index, image)) = self.incoming.try_recv() {
            // Another texture may be in its place by now.
            if self.fingerprints.get(index).is_none_or(|(_, wanted)| *wanted != generation) {
                continue;
            }
            let color = ColorImage::from_rgb([image.width as usize, image.height as usize], &image.pixels);
            let options =
                TextureOptions { mipmap_mode: Some(egui::TextureFilter::Linear), ..TextureOptions::LINEAR };
            self.thumbnails[index] = Some(ctx.load_texture(format!("texture {index}"), color, options));
            self.pixels[index] = Some(image.into());
            (self.blended, self.mixing) = (None, None);
        }
    }

    /// The picture of a texture.
    pub fn thumbnail(&self, texture: usize) -> Option<&TextureHandle> {
        self.thumbnails.get(texture)?.as_ref()
    }

    /// The picture of a blend and the side that it shows in mm: the parents' pictures weighed like their vibrations. It is
    /// mixed by a worker; until that is done, the picture is the one before.
    pub fn blend(&mut self, ctx: &Context, parents: &[(usize, f64)]) -> Option<(&TextureHandle, f64)> {
        let wanted: Shares = parents.iter().map(|(i, w)| (*i, (w * 1000.0).round() as u32)).collect();
        let side_mm = parents.iter().map(|(i, w)| w * self.millimeters[*i]).sum();
        if let Some((shares, receiver)) = self.mixing.take() {
            match receiver.try_recv() {
                Ok(image) => self.show_blend(ctx, shares, image),
                Err(TryRecvError::Empty) => self.mixing = Some((shares, receiver)),
                Err(TryRecvError::Disconnected) => {}
            }
        }
        let is_shown = self.blended.as_ref().is_some_and(|(shares, _)| *shares == wanted);
        if !is_shown && self.mixing.is_none() {
            let sources = parents.iter().map(|(i, w)| Some((Arc::clone(self.pixels.get(*i)?.as_ref()?), *w)));
            if let Some(sources) = sources.collect::<Option<Vec<(Arc<Rgb>, f64)>>>() {
                self.mixing = Some((wanted, in_background(ctx.clone(), move || mix(&sources))));
            }
        }
        self.blended.as_ref().map(|(_, texture)| (texture, side_mm))
    }

    fn show_blend(&mut self, ctx: &Context, shares: Shares, image: ColorImage) {
        if let Some((shown, texture)) = &mut self.blended {
            *shown = shares;
            texture.set(image, TextureOptions::LINEAR_MIRRORED_REPEAT);
        } else {
            let texture = ctx.load_texture("blend", image, TextureOptions::LINEAR_MIRRORED_REPEAT);
            self.blended = Some((shares, texture));
        }
    }
}

/// The mean of pictures with their shares, as lively as they are.
fn mix(parents: &[(Arc<Rgb>, f64)]) -> ColorImage {
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
    // A mean of pictures is flatter than each of them: contrast is brought back by the loss of independent parts.
    // Light that falls on a whole picture would repeat with every tile, so what is broader than the grain goes.
    let kept = parents.iter().map(|(_, w)| w * w).sum::<f64>().sqrt() as f32;
    let n = sum.len() as f32;
    let mean: [f32; 3] = std::array::from_fn(|c| sum.iter().map(|p| p[c]).sum::<f32>() / n);
    let light = blurred(&sum);
    let channel = |c: usize, p: &[f32; 3], light: &[f32; 3]| {
        let grain = ((p[c] - light[c]) / kept).clamp(-MAX_GRAIN, MAX_GRAIN);
        (mean[c] + grain).clamp(0.0, 255.0) as u8
    };
    let pixels = sum
        .iter()
        .zip(&light)
        .map(|(p, l)| Color32::from_rgb(channel(0, p, l), channel(1, p, l), channel(2, p, l)))
        .collect();
    ColorImage::new([BLEND_SIDE, BLEND_SIDE], pixels)
}

/// What tells a picture from another.
fn fingerprint(picture: Option<&Picture>) -> Option<u64> {
    picture.map(|picture| {
        let mut hasher = DefaultHasher::new();
        picture.bytes.hash(&mut hasher);
        picture.millimeters.to_bits().hash(&mut hasher);
        hasher.finish()
    })
}

/// The mean over [`BLUR`] pixels to every side, around the edges as on a torus.
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
                // Running sums in f32 over 192 pixels of up to 255.
                assert!((m / n - f64::from(l)).abs() < 0.01, "at {x}, {y}: {l} for {}", m / n);
            }
        }
    }
}
