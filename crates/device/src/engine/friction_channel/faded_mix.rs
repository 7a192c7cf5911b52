//! Mix whose weights fade, as those of the renderer's voices do.

use shagreen_synth::renderer::{MAX_VOICES, Mix, TextureId};

/// Textures of the last mixes, with their weights at both ends of a tick.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct FadedMix([Faded; MAX_VOICES]);

/// A texture, or an entry that is free.
#[derive(Clone, Copy, Debug, Default)]
struct Faded {
    id: Option<TextureId>,
    before: f32,
    weight: f32,
}

impl FadedMix {
    /// Moves the weights by at most `step` towards those of a mix, in the next tick. If more textures fade at once than the
    /// renderer has voices, the faintest one ends early.
    pub(super) fn follow(&mut self, mix: &Mix, step: f32) {
        let weight_of = |id: Option<TextureId>| -> f32 {
            let of_id = mix.parents.iter().filter(|parent| id == Some(parent.id) && parent.weight > 0.0);
            of_id.map(|parent| parent.weight).sum()
        };
        for parent in mix.parents.iter().filter(|parent| parent.weight > 0.0) {
            if self.0.iter().any(|faded| faded.id == Some(parent.id)) {
                continue;
            }
            let others = self.0.iter_mut().filter(|faded| weight_of(faded.id) == 0.0);
            if let Some(faded) = others.min_by(|a, b| a.weight.total_cmp(&b.weight)) {
                *faded = Faded { id: Some(parent.id), ..Faded::default() };
            }
        }
        for faded in &mut self.0 {
            faded.before = faded.weight;
            faded.weight += (weight_of(faded.id) - faded.weight).clamp(-step, step);
            if faded.before == 0.0 && faded.weight == 0.0 {
                faded.id = None;
            }
        }
    }

    /// Textures with their weights after a share of the tick, 0..1; those with a weight of zero are left out.
    pub(super) fn weights_at(&self, done: f32) -> impl Iterator<Item = (TextureId, f32)> {
        let weights = self.0.into_iter().filter_map(move |faded| {
            let weight = faded.before + done * (faded.weight - faded.before);
            Some((faded.id?, weight))
        });
        weights.filter(|(_, weight)| *weight > 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::{FadedMix, Mix, TextureId};
    use shagreen_synth::renderer::{Blend, Parent};

    fn mix(parents: &[(TextureId, f32)]) -> Mix {
        let mut mix = Mix::silent(Blend::Shared);
        for (parent, (id, weight)) in mix.parents.iter_mut().zip(parents) {
            *parent = Parent { id: *id, weight: *weight };
        }
        mix
    }

    fn weights(faded: &FadedMix, done: f32) -> Vec<(TextureId, f32)> {
        let mut weights: Vec<(TextureId, f32)> = faded.weights_at(done).collect();
        weights.sort_by_key(|(id, _)| *id);
        weights
    }

    #[test]
    fn weights_fade_from_one_mix_to_the_next() {
        let mut faded = FadedMix::default();
        faded.follow(&mix(&[(0, 1.0)]), 0.25);
        assert_eq!((weights(&faded, 0.0), weights(&faded, 1.0)), (vec![], vec![(0, 0.25)]));
        for _ in 0..3 {
            faded.follow(&mix(&[(0, 1.0)]), 0.25);
        }
        assert_eq!(weights(&faded, 0.0), [(0, 0.75)]);
        faded.follow(&mix(&[(0, 0.25), (7, 0.75)]), 0.25);
        assert_eq!(weights(&faded, 0.0), [(0, 1.0)]);
        assert_eq!(weights(&faded, 0.5), [(0, 0.875), (7, 0.125)]);
        for _ in 0..3 {
            faded.follow(&mix(&[(0, 0.25), (7, 0.75)]), 0.25);
        }
        assert_eq!(weights(&faded, 1.0), [(0, 0.25), (7, 0.75)]);
    }

    #[test]
    fn a_texture_that_fades_out_comes_back_where_it_was() {
        let mut faded = FadedMix::default();
        faded.follow(&mix(&[(3, 1.0)]), 1.0);
        faded.follow(&mix(&[(4, 1.0)]), 0.25);
        faded.follow(&mix(&[(3, 1.0)]), 0.25);
        assert_eq!(weights(&faded, 0.0), [(3, 0.75), (4, 0.25)]);
        assert_eq!(weights(&faded, 1.0), [(3, 1.0)]);
    }

    #[test]
    fn there_is_room_for_every_new_mix() {
        let mut faded = FadedMix::default();
        for id in 0..100 {
            faded.follow(&mix(&[(3 * id, 0.5), (3 * id + 1, 0.3), (3 * id + 2, 0.2)]), 0.01);
            assert_eq!(weights(&faded, 1.0).iter().filter(|(of, _)| *of >= 3 * id).count(), 3, "{id}");
        }
    }
}
