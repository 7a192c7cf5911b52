//! Textures that a batch adds to a library.

use std::sync::Arc;

use shagreen_core::space::LabelSource;
use shagreen_formats::library::{Library, TextureEntry, free_id, id_from_name};

use crate::sheets::import::batch::{Batch, Content};
use shagreen_studio::place_estimate::place_by_estimate;

impl Batch {
    /// Textures that would be added to `library` now.
    /// A texture keeps its position only if it is comparable: from the same source as the others. In a library with
    /// positions, its sample rate must also not exceed `space_rate_hz` (Hz). Recordings get estimated
    /// positions if `place_in` says so.
    pub fn entries(&self, library: &Library, space_rate_hz: f64) -> Vec<Arc<TextureEntry>> {
        let mut ids: Vec<String> = library.textures.iter().map(|texture| texture.id.clone()).collect();
        // Estimated positions follow from other positions, so they say nothing about the source.
        let mut sources = library.label_sources();
        sources.retain(|source| *source != LabelSource::Estimated);
        let mut source = if let [source] = sources[..] { Some(source) } else { None };
        let has_mixed_places = sources.len() > 1;
        let mut out = Vec::new();
        for file in &self.files {
            let Content::Textures { entries, .. } = &file.content else { continue };
            for entry in entries {
                let mut entry = entry.clone();
                entry.id = claim_id(&entry.id, &mut ids);
                let fits = |from: LabelSource| !has_mixed_places && source.is_none_or(|s| s == from);
                let is_comparable = entry.label_source().is_some_and(fits);
                if is_comparable && (sources.is_empty() || entry.model.rate().0 <= space_rate_hz) {
                    source = entry.label_source();
                } else {
                    entry.place = None;
                }
                out.push(Arc::new(entry));
            }
        }
        for draft in &self.drafts {
            let recordings: Vec<&str> = self.drawn_of(draft).map(|(file, _)| file.name.as_str()).collect();
            let id = claim_id(&id_from_name(&draft.name), &mut ids);
            let Some(mut entry) = draft.entry(id, &recordings) else { continue };
            if self.are_placed() && entry.model.rate().0 <= space_rate_hz {
                place_by_estimate(&mut entry, library);
            }
            out.push(Arc::new(entry));
        }
        out
    }
}

/// The identifier, with a number appended if it is taken. The result is added to `taken`.
fn claim_id(wanted: &str, taken: &mut Vec<String>) -> String {
    let id = free_id(wanted, |id| taken.iter().any(|other| other == id));
    taken.push(id.clone());
    id
}
