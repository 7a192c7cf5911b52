//! Textures that are loaded into the slots of the output, and the mix of them.

use shagreen_core::texture::plane::Prepared;
use shagreen_core::texture::render::synth_blend;
use shagreen_device::controls::Controls;
use shagreen_device::engine::{Handle, LoadError, LoadReason, SLOTS};
use shagreen_device::synth::renderer::{MAX_PARENTS, Mix, Parent, TextureId};
use shagreen_device::texture::OwnedTexture;

use crate::session::audible::{Audible, Made, Source};
use crate::session::player::Player;

/// Maximum number of loaded textures; the least recently played one is unloaded.
const KEPT: usize = SLOTS - 16;

/// Slots of textures that are not those of the library, each with the number of its texture.
#[derive(Debug, Default)]
pub(super) struct MadeSlots {
    /// Slots in the present mix.
    sounding: Vec<(u64, TextureId)>,
    /// Slots loaded for the next mix.
    next: Vec<(u64, TextureId)>,
}

impl Player {
    /// Loads the audible textures and fades to them. If the output is busy or a texture is not prepared yet, the next
    /// frame retries.
    pub(in crate::session) fn send_mix(&mut self, heard: &Audible, ahead: &[Option<Prepared>], rate_hz: f64) {
        let is_ready = |handle: &Handle| handle.config().model_rate_hz == rate_hz as f32;
        if !self.mix_is_new || !self.handle.as_ref().is_some_and(is_ready) {
            return;
        }
        self.n_mixes += 1;
        self.unload_replaced(&heard.made);
        let mut mix = Mix::silent(synth_blend(heard.mixing));
        for (voice, parent) in heard.voices.iter().zip(&mut mix.parents[..MAX_PARENTS]) {
            let id = match voice.source {
                Source::Library(texture) => self.slot_of(texture, ahead),
                Source::Made(number) => {
                    let made = heard.made.iter().find(|made| made.number == number);
                    made.and_then(|made| self.slot_of_made(made))
                }
            };
            let Some(id) = id else { return };
            *parent = Parent { id, weight: voice.share as f32 };
        }
        if let Some(handle) = &mut self.handle
            && handle.set_controls(Controls { mix, tap: self.tap, ..handle.controls() }).is_ok()
        {
            self.mix_is_new = false;
            let is_sounding =
                |(_, id): &(u64, TextureId)| mix.parents.iter().any(|p| p.id == *id && p.weight > 0.0);
            let MadeSlots { mut sounding, next } = std::mem::take(&mut self.made);
            sounding.extend(next);
            for slot in sounding {
                if is_sounding(&slot) {
                    self.made.sounding.push(slot);
                } else {
                    // It fades out before its slot is freed.
                    handle.unload(slot.1);
                }
            }
        }
    }

    /// Unloads textures that are not marked in `is_kept`, and resizes the slots to its length.
    pub(in crate::session) fn keep(&mut self, is_kept: &[bool]) {
        self.slots.resize(self.slots.len().max(is_kept.len()), None);
        for (texture, slot) in self.slots.iter_mut().enumerate() {
            let is_gone = !is_kept.get(texture).copied().unwrap_or(false);
            if let (Some((id, _)), Some(handle)) = (slot.take_if(|_| is_gone), &mut self.handle) {
                handle.unload(id);
            }
        }
        self.slots.truncate(is_kept.len());
    }

    fn slot_of(&mut self, texture: usize, ahead: &[Option<Prepared>]) -> Option<TextureId> {
        let handle = self.handle.as_mut()?;
        if let Some((id, used)) = &mut self.slots[texture] {
            *used = self.n_mixes;
            return Some(*id);
        }
        let prepared = ahead.get(texture)?.as_ref()?;
        if self.slots.iter().flatten().count() >= KEPT {
            let oldest = (0..self.slots.len())
                .filter(|i| self.slots[*i].is_some())
                .min_by_key(|i| self.slots[*i].map(|s| s.1));
            if let Some((id, _)) = oldest.and_then(|i| self.slots[i].take()) {
                handle.unload(id);
            }
        }
        let id = self.load(prepared)?;
        self.slots[texture] = Some((id, self.n_mixes));
        Some(id)
    }

    /// Unloads textures that were loaded for the next mix and are not in it any more, because the point or the shape
    /// changed before they played.
    fn unload_replaced(&mut self, made: &[Made]) {
        let Some(handle) = &mut self.handle else { return };
        self.made.next.retain(|(number, id)| {
            let is_wanted = made.iter().any(|made| made.number == *number);
            if !is_wanted {
                handle.unload(*id);
            }
            is_wanted
        });
    }

    /// Slot of a texture that is not one of the library, loaded if necessary.
    fn slot_of_made(&mut self, made: &Made) -> Option<TextureId> {
        let mut known = self.made.sounding.iter().chain(&self.made.next);
        if let Some((_, id)) = known.find(|(number, _)| *number == made.number) {
            return Some(*id);
        }
        let id = self.load(&made.prepared)?;
        self.made.next.push((made.number, id));
        Some(id)
    }

    /// Sends a texture to the output. If the output is busy, the next frame retries.
    fn load(&mut self, prepared: &Prepared) -> Option<TextureId> {
        let handle = self.handle.as_mut()?;
        let refusal = match OwnedTexture::new(prepared.parts()) {
            Ok(owned) => match handle.load(owned) {
                Ok(id) => return Some(id),
                Err(LoadError { reason: LoadReason::RingFull | LoadReason::NoSlot, .. }) => return None,
                Err(error) => error.to_string(),
            },
            Err(error) => error.to_string(),
        };
        self.message = Some(refusal);
        None
    }

    /// Number of loaded textures, except those that are fading out.
    pub(in crate::session) fn n_loaded(&self) -> usize {
        let is_loaded = |handle: &Handle| (0..SLOTS).filter(|id| handle.is_loaded(*id as TextureId)).count();
        self.handle.as_ref().map_or(0, is_loaded)
    }
}
