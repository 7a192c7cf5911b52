//! What is heard, as a signal that can be saved.

use std::sync::Arc;

use shagreen_core::space::LabelSource;
use shagreen_core::units::Contact;
use shagreen_formats::library::Provenance;
use shagreen_formats::project::Project;
use shagreen_formats::wav::{self, ParentV1, SidecarV1, TraceV1};

use super::Session;
use crate::document::CREATED_BY;
use crate::kept_path::kept_path;
use crate::save::{SIGNAL_RATE_HZ, SIGNAL_SECS, SIGNAL_SEED, SignalFile, Sounding};

impl Session {
    /// The signal of what is heard at one contact; `None` where nothing is, or nothing may be shown of it.
    pub fn signal(&self, project: &Project, contact: Contact) -> Option<SignalFile> {
        let authored = self.authored()?;
        let is_alone = self.solo(project).is_some();
        let path = if is_alone { None } else { kept_path(project, self) };
        let sounding = if let Some(path) = path.and_then(|path| path.ok()?.path) {
            Sounding::Path(Box::new(path))
        } else {
            let voices = self.heard.voices.iter().map(|voice| (Arc::clone(&voice.plane), voice.share));
            Sounding::Mix(voices.collect(), self.heard.mixing)
        };
        let parents =
            authored.parents.iter().map(|(texture, weight)| (&self.library.textures[*texture], *weight));
        let restricted = parents.clone().filter(|(entry, _)| entry.provenance == Provenance::Restricted);
        let restricted = restricted.map(|(entry, _)| entry.name.clone()).collect();
        let sidecar = SidecarV1 {
            format: wav::FORMAT.to_owned(),
            version: wav::VERSION.to_owned(),
            units: wav::UNITS.to_owned(),
            full_scale: 1.0,
            channels: vec![wav::ONE_CHANNEL.to_owned()],
            rate_hz: SIGNAL_RATE_HZ,
            seconds: SIGNAL_SECS,
            texture: if is_alone { project.solo.clone() } else { None },
            at: (!is_alone).then_some([authored.location.at.rough_smooth, authored.location.at.hard_soft]),
            clamped: authored.location.clamped,
            extrapolated: authored.is_extrapolated,
            blend: authored.mode.id().to_owned(),
            parents: parents
                .map(|(entry, weight)| ParentV1 {
                    id: entry.id.clone(),
                    weight,
                    licence: self.library.license_of(entry).to_owned(),
                })
                .collect(),
            library: self.library.name.clone(),
            label_source: self.common_source().map(|source| LabelSource::id(source).to_owned()),
            seed: SIGNAL_SEED,
            stroke: None,
            trace: TraceV1 {
                time_s: vec![0.0, SIGNAL_SECS],
                speed_mm_per_s: vec![contact.speed.mm_per_s(); 2],
                force_n: vec![contact.force.0; 2],
            },
            created_by: CREATED_BY.to_owned(),
        };
        Some(SignalFile { sounding, contact, sidecar, restricted })
    }
}
