//! Library textures in a shape: kept while only their weights change, because making one takes some time.

use std::sync::Arc;

use shagreen_core::space::authoring::{Authored, Voice};
use shagreen_core::texture::TextureModel;
use shagreen_core::texture::plane::Plane;
use shagreen_core::texture::shape::Shape;
use shagreen_formats::library::TextureEntry;
use shagreen_studio::authoring::shaped_plane_at;
use shagreen_studio::report::Warnings;

use super::super::loaded_textures::Textures;
use super::{Made, ReadyPlane, plane_of};

/// Maximum number of textures that are kept: those of some neighboring triangles.
const MOST: usize = 12;

/// Library textures in the last shape.
#[derive(Default)]
pub(in crate::session) struct ShapedTextures {
    shape: Shape,
    /// Oldest first.
    textures: Vec<ShapedTexture>,
}

/// Library texture that is not there in a shape yet, for a worker that makes it.
pub(in crate::session) struct Unshaped {
    texture: usize,
    entry: TextureEntry,
    /// Plane without the shape.
    plane: Arc<Plane>,
    shape: Shape,
}

/// Library texture in a shape, prepared for the renderer.
pub(in crate::session) struct Shaped {
    texture: usize,
    unshaped: Arc<Plane>,
    shape: Shape,
    ready: ReadyPlane,
}

/// Whether the height map of a texture must be prepared in a shape, which takes so long that a worker does it. A prepared map
/// stays so unless it is stretched.
pub(in crate::session) fn needs_preparation(model: &TextureModel, shape: &Shape) -> bool {
    model.height_map().is_some_and(|map| shape.grain != 1.0 || !map.is_prepared())
}

impl Unshaped {
    /// The texture in its shape; `None` if it cannot have it.
    pub(in crate::session) fn shaped(self) -> Option<Shaped> {
        let Self { texture, entry, plane: unshaped, shape } = self;
        let plane = shaped_plane_at(&entry, &shape, unshaped.rate(), &Warnings::default()).ok()?;
        Some(Shaped { texture, unshaped, shape, ready: ReadyPlane::new(Arc::new(plane)) })
    }
}

struct ShapedTexture {
    /// Library index.
    texture: usize,
    /// Plane without the shape, which shows whether the index still refers to the texture.
    unshaped: Arc<Plane>,
    plane: Arc<Plane>,
    made: Made,
}

impl ShapedTextures {
    /// The texture with this index in a shape. If it is not there yet, it is made under the next number after `n_made`.
    ///
    /// # Errors
    /// States why the texture cannot have this shape.
    pub(super) fn of(
        &mut self,
        texture: usize,
        shape: &Shape,
        textures: &Textures,
        n_made: &mut u64,
    ) -> Result<(Arc<Plane>, Made), String> {
        self.follow(shape);
        let unshaped = &textures.planes[texture];
        if let Some(kept) = self.find(texture, unshaped) {
            return Ok((Arc::clone(&kept.plane), kept.made.clone()));
        }
        let plane = plane_of(Voice::Texture(texture), shape, &textures.library, &textures.planes)?;
        let (plane, made) = ReadyPlane::new(plane).numbered(n_made);
        self.keep(ShapedTexture {
            texture,
            unshaped: Arc::clone(unshaped),
            plane: Arc::clone(&plane),
            made: made.clone(),
        });
        Ok((plane, made))
    }

    /// Textures of the library among the voices of `authored` that are not there in its shape, of those for which `is_asked`
    /// holds with their models and the shape.
    pub(in crate::session) fn missing(
        &self,
        authored: &Authored,
        textures: &Textures,
        is_asked: impl Fn(&TextureModel, &Shape) -> bool,
    ) -> Vec<Unshaped> {
        let shape = authored.shape;
        if shape.is_neutral() {
            return Vec::new();
        }
        let missing = |(voice, _): (Voice<'_>, f64)| {
            let Voice::Texture(texture) = voice else { return None };
            let (entry, unshaped) = (&textures.library.textures[texture], &textures.planes[texture]);
            let is_there = self.shape == shape && self.find(texture, unshaped).is_some();
            (!is_there && is_asked(&entry.model, &shape)).then(|| Unshaped {
                texture,
                entry: entry.clone(),
                plane: Arc::clone(unshaped),
                shape,
            })
        };
        authored.voices().into_iter().filter_map(missing).collect()
    }

    /// Keeps a texture that a worker has made, under the next number after `n_made`.
    pub(in crate::session) fn take(&mut self, shaped: Shaped, n_made: &mut u64) {
        let Shaped { texture, unshaped, shape, ready } = shaped;
        self.follow(&shape);
        if self.find(texture, &unshaped).is_none() {
            let (plane, made) = ready.numbered(n_made);
            self.keep(ShapedTexture { texture, unshaped, plane, made });
        }
    }

    fn follow(&mut self, shape: &Shape) {
        if self.shape != *shape {
            self.shape = *shape;
            self.textures.clear();
        }
    }

    fn find(&self, texture: usize, unshaped: &Arc<Plane>) -> Option<&ShapedTexture> {
        let is_it = |kept: &&ShapedTexture| kept.texture == texture && Arc::ptr_eq(&kept.unshaped, unshaped);
        self.textures.iter().find(is_it)
    }

    fn keep(&mut self, texture: ShapedTexture) {
        if self.textures.len() >= MOST {
            self.textures.remove(0);
        }
        self.textures.push(texture);
    }
}
