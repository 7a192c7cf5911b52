//! Library textures in a shape: kept while only their weights change, because making one takes some time.

use std::sync::Arc;

use shagreen_core::space::authoring::Voice;
use shagreen_core::texture::plane::Plane;
use shagreen_core::texture::shape::Shape;

use super::super::loaded_textures::Textures;
use super::{Made, numbered, plane_of};

/// Maximum number of textures that are kept: those of some neighboring triangles.
const MOST: usize = 12;

/// Library textures in the last shape.
#[derive(Default)]
pub(in crate::session) struct ShapedTextures {
    shape: Shape,
    /// Oldest first.
    textures: Vec<ShapedTexture>,
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
        if self.shape != *shape {
            self.shape = *shape;
            self.textures.clear();
        }
        let unshaped = &textures.planes[texture];
        let is_it = |kept: &&ShapedTexture| kept.texture == texture && Arc::ptr_eq(&kept.unshaped, unshaped);
        if let Some(kept) = self.textures.iter().find(is_it) {
            return Ok((Arc::clone(&kept.plane), kept.made.clone()));
        }
        let plane = plane_of(Voice::Texture(texture), shape, &textures.library, &textures.planes)?;
        let (plane, made) = numbered(plane, n_made);
        if self.textures.len() >= MOST {
            self.textures.remove(0);
        }
        self.textures.push(ShapedTexture {
            texture,
            unshaped: Arc::clone(unshaped),
            plane: Arc::clone(&plane),
            made: made.clone(),
        });
        Ok((plane, made))
    }
}
