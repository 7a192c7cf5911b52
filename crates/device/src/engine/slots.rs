//! Table of the textures that the callback holds.

use shagreen_synth::renderer::{TextureId, Textures};
use shagreen_synth::texture::Texture;

use super::SLOTS;
use crate::texture::OwnedTexture;

/// A table of textures, with flags for those that are being retired.
#[derive(Debug)]
pub(super) struct Slots {
    textures: [Option<Box<OwnedTexture>>; SLOTS],
    retired: [bool; SLOTS],
}

impl Slots {
    pub(super) fn new() -> Self {
        Self { textures: [const { None }; SLOTS], retired: [false; SLOTS] }
    }

    /// Puts a texture into slot `id`. Returns the previous texture of the slot, or the texture itself if there is no
    /// such slot.
    pub(super) fn put(&mut self, id: TextureId, texture: Box<OwnedTexture>) -> Option<Box<OwnedTexture>> {
        let idx = usize::from(id);
        let (Some(slot), Some(retired)) = (self.textures.get_mut(idx), self.retired.get_mut(idx)) else {
            return Some(texture);
        };
        *retired = false;
        slot.replace(texture)
    }

    /// Marks texture `id` to be returned once no voice uses it.
    pub(super) fn retire(&mut self, id: TextureId) {
        if self.texture(id).is_some()
            && let Some(retired) = self.retired.get_mut(usize::from(id))
        {
            *retired = true;
        }
    }

    pub(super) fn is_retired(&self, id: TextureId) -> bool {
        self.retired.get(usize::from(id)).is_some_and(|&retired| retired)
    }

    /// Takes the texture out of slot `id`.
    pub(super) fn take(&mut self, id: TextureId) -> Option<Box<OwnedTexture>> {
        let idx = usize::from(id);
        if let Some(retired) = self.retired.get_mut(idx) {
            *retired = false;
        }
        self.textures.get_mut(idx)?.take()
    }
}

impl Textures for Slots {
    fn texture(&self, id: TextureId) -> Option<Texture<'_>> {
        Some(self.textures.get(usize::from(id))?.as_ref()?.view())
    }
}

#[cfg(test)]
mod tests {
    use super::{SLOTS, Slots, Textures as _};
    use crate::texture::tests::white;

    #[test]
    fn holds_and_gives_back() {
        let mut slots = Slots::new();
        assert!(slots.texture(3).is_none() && slots.take(3).is_none());
        assert!(slots.put(3, Box::new(white(1.0))).is_none());
        assert!(slots.texture(3).is_some());
        assert_eq!(slots.put(3, Box::new(white(2.0))), Some(Box::new(white(1.0))));
        slots.retire(3);
        slots.retire(4);
        assert!(slots.is_retired(3) && !slots.is_retired(4));
        assert_eq!(slots.take(3), Some(Box::new(white(2.0))));
        assert!(!slots.is_retired(3));
    }

    #[test]
    fn slots_that_do_not_exist_are_empty() {
        let mut slots = Slots::new();
        let id = SLOTS as u16;
        assert_eq!(slots.put(id, Box::new(white(1.0))), Some(Box::new(white(1.0))));
        slots.retire(id);
        assert!(slots.take(id).is_none() && slots.texture(id).is_none() && !slots.is_retired(id));
    }
}
