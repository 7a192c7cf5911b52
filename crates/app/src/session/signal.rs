//! What is heard, as a signal that can be saved.

use std::collections::BTreeMap;
use std::sync::Arc;

use shagreen_core::space::LabelSource;
use shagreen_core::texture_path::TexturePath;
use shagreen_core::units::Contact;
use shagreen_formats::library::Provenance;
use shagreen_formats::project::{AuthoredTexture, Project};
use shagreen_formats::wav::{ParentV1, SidecarV1, TraceV1};

use super::Session;
use crate::document::CREATED_BY;
use crate::kept_path::drawn_path;
use crate::save::{SIGNAL_RATE_HZ, SIGNAL_SECS, SIGNAL_SEED, SignalFile, Sounding};
use crate::signals::bench_signal::BenchSignal;
use crate::strings::signal as strings;

impl Session {
    /// The signal of what is heard at one contact: that of the bench where one is felt; else of the texture that is heard alone, of the path that is played, else of the
    /// point of `compared` or of the selected texture.
    ///
    /// # Errors
    /// In words: nothing is heard, nothing may be shown of it, or it is still being prepared.
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
            library: self.library.name.clone(),
            label_source: self.common_source().map(|source| LabelSource::id(source).to_owned()),
            trace: TraceV1 {
                time_s: vec![0.0, SIGNAL_SECS],
                speed_mm_per_s: vec![as_set(contact.speed.mm_per_s()); 2],
                force_n: vec![as_set(contact.force.0); 2],
            },
            ..SidecarV1::new(SIGNAL_RATE_HZ, SIGNAL_SECS, SIGNAL_SEED, CREATED_BY)
        };
        let of_list = alone.and_then(|texture| self.library.textures[texture].path.clone());
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
            if self.is_preparing() || self.heard.voices.is_empty() {
                return Err(strings::PREPARING.to_owned());
            }
            sidecar.at = alone.is_none().then_some({
                let at = authored.location.at;
                [at.rough_smooth, at.hard_soft]
            });
            (sidecar.clamped, sidecar.extrapolated) = (authored.location.clamped, authored.is_extrapolated);
            let voices = self.heard.voices.iter().map(|voice| (Arc::clone(&voice.plane), voice.share));
            (Sounding::Mix(voices.collect(), self.heard.mixing), authored.parents.clone())
        };
        sidecar.texture = alone.map(|texture| self.library.textures[texture].id.clone());
        sidecar.parents =
            parents.iter().map(|(texture, weight)| ParentV1::new(&self.library, *texture, *weight)).collect();
        let entries = parents.iter().map(|(texture, _)| &self.library.textures[*texture]);
        let restricted = entries.filter(|entry| entry.provenance == Provenance::Restricted);
        let restricted = restricted.map(|entry| entry.name.clone()).collect();
        Ok(SignalFile { sounding, contact, sidecar, restricted })
    }

    /// The textures that say something along a path, with the mean of their shares.
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

/// A signal of the bench, as it was recorded.
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

/// A number of the hand as somebody set it: the hand has it in `f32`.
fn as_set(value: f64) -> f64 {
    let thousandths = f64::from(value as f32) * 1e3;
    thousandths.round() / 1e3
}
