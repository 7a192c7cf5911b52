//! Pictures of the projects of the gallery: the lit surface of each authored texture. A worker makes them once in a run
//! of the program.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use egui::{ColorImage, Context, Id, TextureHandle, TextureOptions};
use shagreen_core::space::{Space, SpacePoint};
use shagreen_core::surfaces::quilt::Pixels;
use shagreen_formats::gallery::GalleryProject;
use shagreen_formats::library::Library;
use shagreen_formats::picture::{Rgb, decode};
use shagreen_formats::project::{AuthoredTexture, Project, ProjectLibrary};

use crate::state::own_surface::pixels_of;
use crate::state::pad_surface::{PadSurface, USUAL_LIGHT};
use crate::state::pictures::mix;

/// Size of a picture in pixels, about.
const SIZE: [usize; 2] = [168, 168];

/// Pictures by the identifier of the project, in the order of its authored textures.
type Shown = BTreeMap<&'static str, Vec<TextureHandle>>;

/// Pictures of a project as a worker sends them.
type Made = (&'static str, Vec<ColorImage>);

/// The pictures that are made so far, and the worker that makes the others.
pub(crate) struct GalleryPictures {
    shown: Arc<Shown>,
    incoming: Option<Receiver<Made>>,
}

impl GalleryPictures {
    /// Pictures of `projects`. Those that were made earlier are there at once.
    pub(crate) fn new(ctx: &Context, projects: &[(GalleryProject, Project)]) -> Self {
        let shown: Arc<Shown> = ctx.data(|data| data.get_temp(key())).unwrap_or_default();
        let missing = projects.iter().filter(|(each, _)| !shown.contains_key(each.id));
        let missing: Vec<(&str, Project)> =
            missing.map(|(each, project)| (each.id, project.clone())).collect();
        let incoming = (!missing.is_empty()).then(|| begin(missing, ctx.clone()));
        Self { shown, incoming }
    }

    /// Takes in what the worker has made.
    pub(crate) fn collect(&mut self, ctx: &Context) {
        while let Some(incoming) = &self.incoming {
            match incoming.try_recv() {
                Ok((id, images)) => {
                    let options = TextureOptions::LINEAR_REPEAT;
                    let load = |image: ColorImage| ctx.load_texture(format!("gallery {id}"), image, options);
                    Arc::make_mut(&mut self.shown).insert(id, images.into_iter().map(load).collect());
                    ctx.data_mut(|data| data.insert_temp(key(), Arc::clone(&self.shown)));
                }
                Err(TryRecvError::Empty) => return,
                Err(TryRecvError::Disconnected) => self.incoming = None,
            }
        }
    }

    /// Whether the worker is still busy.
    pub(crate) fn is_busy(&self) -> bool {
        self.incoming.is_some()
    }

    /// Pictures of the project with this identifier, as far as they are made.
    pub(crate) fn of(&self, id: &str) -> &[TextureHandle] {
        self.shown.get(id).map_or(&[][..], Vec::as_slice)
    }
}

/// Key of the pictures in the memory of the window.
fn key() -> Id {
    Id::unique("pictures of the gallery")
}

fn begin(projects: Vec<(&'static str, Project)>, ctx: Context) -> Receiver<Made> {
    let (sender, incoming) = channel();
    std::thread::spawn(move || {
        let mut sources: Option<Sources> = None;
        for (id, project) in projects {
            sources = sources
                .filter(|sources| sources.library == project.library)
                .or_else(|| Sources::read(&project.library));
            let images = project.authored.iter().filter_map(|texture| sources.as_mut()?.surface(texture));
            // Without the sheet, the others are made when it opens again.
            if sender.send((id, images.collect())).is_err() {
                return;
            }
            ctx.request_repaint();
        }
        drop(sender);
        ctx.request_repaint();
    });
    incoming
}

/// Textures from which the pictures are blended.
struct Sources {
    library: ProjectLibrary,
    textures: Library,
    space: Space,
    /// Decoded pictures of the textures, as far as they were needed.
    decoded: Vec<Option<Arc<Rgb>>>,
}

impl Sources {
    /// Reads a library; `None` if it is damaged, which the sheet need not report.
    fn read(library: &ProjectLibrary) -> Option<Self> {
        let textures = library.read().ok()?;
        let space = Space::new(&textures.positions()).ok()?;
        let decoded = vec![None; textures.textures.len()];
        Some(Self { library: library.clone(), textures, space, decoded })
    }

    /// Lit surface of an authored texture: of its own picture, or of the textures around its point.
    fn surface(&mut self, texture: &AuthoredTexture) -> Option<ColorImage> {
        let (pixels, width_mm) = match &texture.picture {
            Some(own) => (pixels_of(&decode(own).ok()?), own.millimeters),
            None => self.blended(texture.at)?,
        };
        Some(PadSurface::of_size(&pixels, width_mm, SIZE).lit(USUAL_LIGHT))
    }

    /// Blended picture at a point, with its width in mm.
    fn blended(&mut self, at: SpacePoint) -> Option<(Pixels, f64)> {
        let (mut parents, mut width_mm) = (Vec::new(), 0.0);
        for (texture, weight) in self.space.locate(at)?.corners {
            let (pixels, millimeters) = self.pixels(texture)?;
            parents.push((pixels, weight));
            width_mm += weight * millimeters;
        }
        Some((mix(&parents), width_mm))
    }

    /// Decoded picture of a texture, with its width in mm.
    fn pixels(&mut self, texture: usize) -> Option<(Arc<Rgb>, f64)> {
        let picture = self.textures.textures[texture].picture.as_ref()?;
        let decoded = &mut self.decoded[texture];
        if decoded.is_none() {
            *decoded = Some(Arc::new(decode(picture).ok()?));
        }
        Some((Arc::clone(decoded.as_ref()?), picture.millimeters))
    }
}

#[cfg(test)]
mod tests {
    use super::Sources;
    use egui::ColorImage;
    use shagreen_formats::gallery::GALLERY;

    /// Mean of all colors.
    fn mean(image: &ColorImage) -> [f64; 3] {
        let sum = image.pixels.iter().fold([0.0; 3], |sum, pixel| {
            [sum[0] + f64::from(pixel.r()), sum[1] + f64::from(pixel.g()), sum[2] + f64::from(pixel.b())]
        });
        sum.map(|channel| channel / image.pixels.len() as f64)
    }

    /// Each authored texture has a picture of its own, the same every time.
    #[test]
    fn every_texture_of_a_project_has_a_picture() {
        let project = GALLERY[2].read().unwrap();
        let mut sources = Sources::read(&project.library).unwrap();
        let mut make = || -> Vec<ColorImage> {
            project.authored.iter().map(|texture| sources.surface(texture).unwrap()).collect()
        };
        let pictures = make();
        assert!(pictures.len() >= 3);
        for (i, picture) in pictures.iter().enumerate() {
            assert!(picture.size[0] >= 100 && picture.size[1] >= 100, "{:?}", picture.size);
            let is_flat = picture.pixels.iter().all(|pixel| *pixel == picture.pixels[0]);
            assert!(!is_flat);
            for other in &pictures[..i] {
                let apart: f64 = mean(picture).iter().zip(mean(other)).map(|(a, b)| (a - b).abs()).sum();
                assert!(apart > 1.0, "two pictures are equal");
            }
        }
        assert_eq!(make(), pictures);
    }
}
