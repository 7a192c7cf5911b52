//! The audible texture as a signal or a library entry that can be saved.

use std::collections::BTreeMap;
use std::sync::Arc;

use shagreen_core::space::LabelSource;
use shagreen_core::space::texture_path::TexturePath;
use shagreen_core::units::Contact;
use shagreen_formats::library::{Provenance, TextureEntry};
use shagreen_formats::project::{AuthoredTexture, Project};
use shagreen_formats::wav::{ParentV1, SidecarV1, TraceV1};

use super::Session;
use crate::session::kept_path::drawn_path;
use crate::state::bench_signal::BenchSignal;
use crate::state::document::CREATED_BY;
use crate::state::signal_file::{SIGNAL_RATE_HZ, SIGNAL_SECS, SIGNAL_SEED, SignalFile, Sounding};
use crate::strings::signal as strings;

impl Session {
    /// Audible signal at one contact. The first that applies is its source: a felt signal of the Signals workspace, the
    /// played path, the soloed texture, or the point of `compared` or of the selected texture.
    ///
    /// # Errors
    /// States why there is no signal: nothing is audible, a blind comparison hides it, or it is still being computed.
    pub fn signal(
        &self,
        project: &Project,
        compared: Option<&AuthoredTexture>,
        contact: Contact,
    ) -> Result<SignalFile, String> {
        if let Some(signal) = self.felt_signal() {
            return Ok(of_bench(signal));
        }
        let authored = self.authored().ok_or(strings::NOTHING)?;
        let alone = self.solo(project).filter(|_| compared.is_none() && !self.is_path_playing());
        let mut sidecar = SidecarV1 {
            blend: authored.mode.id().to_owned(),
            library: self.textures.library.name.clone(),
            label_source: self.common_source().map(|source| LabelSource::id(source).to_owned()),
            trace: TraceV1 {
                time_s: vec![0.0, SIGNAL_SECS],
                speed_mm_per_s: vec![as_set(contact.speed.mm_per_s()); 2],
                force_n: vec![as_set(contact.force.0); 2],
            },
            ..SidecarV1::new(SIGNAL_RATE_HZ, SIGNAL_SECS, SIGNAL_SEED, CREATED_BY)
        };
        let of_list = alone.and_then(|texture| self.textures.library.textures[texture].path.clone());
        let is_drawn = of_list.is_none() && self.is_path_playing();
        let (sounding, parents) = if let Some(path) = of_list {
            (Sounding::Path(Box::new(path)), authored.parents.clone())
        } else if is_drawn {
            let texture = compared.unwrap_or(project.texture());
            let path =
                drawn_path(texture, self).ok_or(strings::NOTHING)?.map_err(|error| error.to_string())?;
            let parents = self.parents_along(texture, &path);
            (Sounding::Path(Box::new(path)), parents)
        } else {
            if self.is_preparing() || self.sound.heard.voices.is_empty() {
                return Err(strings::PREPARING.to_owned());
            }
            sidecar.at = alone.is_none().then_some({
                let at = authored.location.at;
                [at.rough_smooth, at.hard_soft]
            });
            (sidecar.clamped, sidecar.extrapolated) = (authored.location.clamped, authored.is_extrapolated);
            let voices = self.sound.heard.voices.iter().map(|voice| (Arc::clone(&voice.plane), voice.share));
            (Sounding::Mix(voices.collect(), self.sound.heard.mixing), authored.parents.clone())
        };
        sidecar.texture = alone.map(|texture| self.textures.library.textures[texture].id.clone());
        sidecar.parents = parents
            .iter()
            .map(|(texture, weight)| ParentV1::new(&self.textures.library, *texture, *weight))
            .collect();
        let entries = parents.iter().map(|(texture, _)| &self.textures.library.textures[*texture]);
        let restricted = entries.filter(|entry| entry.provenance == Provenance::Restricted);
        let restricted = restricted.map(|entry| entry.name.clone()).collect();
        Ok(SignalFile { sounding, contact, sidecar, restricted })
    }

    /// Audible texture as a library entry, for other programs: the soloed texture, or the texture interpolated at the
    /// point of `compared` or of the selected texture.
    ///
    /// # Errors
    /// States why there is no entry: a blind comparison hides it, it is still being computed, or the interpolation mode
    /// computes no texture.
    pub fn texture_entry(
        &self,
        project: &Project,
        compared: Option<&AuthoredTexture>,
    ) -> Result<TextureEntry, String> {
        let authored = self.authored().ok_or(strings::NOTHING)?;
        if let Some(alone) = self.solo(project).filter(|_| compared.is_none()) {
            return Ok(self.textures.library.textures[alone].clone());
        }
        if self.is_preparing() {
            return Err(strings::PREPARING.to_owned());
        }
        let model = authored.model.clone().ok_or(strings::NO_MODEL)?;
        let name = &compared.unwrap_or(project.texture()).name;
        let parents: Vec<usize> = authored.parents.iter().map(|(texture, _)| *texture).collect();
        Ok(self.textures.library.entry_of_point(name, authored.location.at, model, &parents))
    }

    /// Textures that contribute along a path, and their mean weights, largest first.
    fn parents_along(&self, texture: &AuthoredTexture, path: &TexturePath) -> Vec<(usize, f64)> {
        let blending = self.blending(&texture.blend);
        let n_keys = path.keys().len() as f64;
        let mut shares = BTreeMap::new();
        for key in path.keys() {
            let authored = self.authoring().author(key.stop.at, &blending);
            for (parent, weight) in authored.map_or(Vec::new(), |authored| authored.parents) {
                *shares.entry(parent).or_insert(0.0) += weight / n_keys;
            }
        }
        let mut parents: Vec<(usize, f64)> = shares.into_iter().collect();
        parents.sort_by(|a, b| b.1.total_cmp(&a.1));
        parents
    }
}

/// Signal of the Signals workspace at its own speed and force.
fn of_bench(signal: &Arc<BenchSignal>) -> SignalFile {
    let contact = Contact { speed: signal.speed, force: signal.force };
    let sidecar = SidecarV1 {
        trace: TraceV1 {
            time_s: vec![0.0, signal.seconds()],
            speed_mm_per_s: vec![as_set(contact.speed.mm_per_s()); 2],
            force_n: vec![as_set(contact.force.0); 2],
        },
        ..SidecarV1::new(SIGNAL_RATE_HZ, signal.seconds(), SIGNAL_SEED, CREATED_BY)
    };
    let restricted = signal.restricted.clone();
    SignalFile { sounding: Sounding::Bench(Arc::clone(signal)), contact, sidecar, restricted }
}

/// Rounds a speed or force to thousandths, because the user sets it as `f32`.
fn as_set(value: f64) -> f64 {
    let thousandths = f64::from(value as f32) * 1e3;
    thousandths.round() / 1e3
}
