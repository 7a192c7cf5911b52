//! The audible texture as a signal or a library entry that can be saved.

use std::collections::BTreeMap;
use std::sync::Arc;

use shagreen_core::space::LabelSource;
use shagreen_core::space::authoring::Authored;
use shagreen_core::space::texture_path::TexturePath;
use shagreen_core::texture::plane::Plane;
use shagreen_core::texture::shape::Shape;
use shagreen_core::units::{Contact, Hertz};
use shagreen_device::track::Track;
use shagreen_formats::library::{Library, Provenance, TextureEntry};
use shagreen_formats::named_point::named_coordinates;
use shagreen_formats::project::{AuthoredTexture, Project};
use shagreen_formats::wav::{ParentV1, SidecarV1};

use super::Session;
use super::audible::planes_of;
use crate::session::kept_path::drawn_path;
use crate::state::bench_signal::BenchSignal;
use crate::state::document::CREATED_BY;
use crate::state::recorded_stroke::RecordedStroke;
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
        let of_list = alone.and_then(|texture| self.textures.library.textures[texture].path.clone());
        let is_drawn = of_list.is_none() && self.is_path_playing();
        let mut place = None;
        let (sounding, parents) = if let Some(path) = of_list {
            (Sounding::Path(Box::new(path)), authored.parents.clone())
        } else if is_drawn {
            let texture = compared.unwrap_or(project.texture());
            let path =
                drawn_path(texture, self).ok_or(strings::NOTHING)?.map_err(|error| error.to_string())?;
            let parents = self.parents_along(texture, &path);
            (Sounding::Path(Box::new(path)), parents)
        } else {
            let voices = if self.is_preparing() { Vec::new() } else { self.planes_heard(authored)? };
            if voices.is_empty() {
                return Err(strings::PREPARING.to_owned());
            }
            place = alone.is_none().then_some(authored);
            (Sounding::Mix(voices, authored.mixing()), authored.parents.clone())
        };
        let texture = alone.map(|texture| self.textures.library.textures[texture].id.clone());
        let file = self.signal_context(contact).signal(authored, sounding, &parents);
        let sidecar = SidecarV1 { texture, ..file.sidecar };
        Ok(SignalFile { sidecar: placed(sidecar, place, self.axes()), ..file })
    }

    /// Speeds and forces of the voices of the interpolated texture, and their weights: those that play, unless a worker
    /// still makes this texture, so that a previous one plays.
    fn planes_heard(&self, authored: &Authored) -> Result<Vec<(Arc<Plane>, f64)>, String> {
        if self.authored.audible.is_behind() {
            return planes_of(authored, &self.textures.library, &self.textures.planes);
        }
        let voices = self.sound.heard.voices.iter();
        Ok(voices.map(|voice| (Arc::clone(&voice.plane), voice.share)).collect())
    }

    /// What all signals at one contact have in common.
    pub(super) fn signal_context(&self, contact: Contact) -> SignalContext<'_> {
        SignalContext {
            library: &self.textures.library,
            source: self.source_in(self.space()),
            stroke: self.stroke().map(RecordedStroke::shared_track),
            model_rate: Hertz(self.sound.rate_hz),
            contact,
        }
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
        let name = &compared.unwrap_or(project.texture()).name;
        entry_of(&self.textures.library, name, authored)
    }

    /// An authored texture as a library entry with this name, in this shape, whether it is audible or not.
    ///
    /// # Errors
    /// States why there is no entry: the models are still being computed, or the interpolation mode computes no texture.
    pub(crate) fn entry_of_authored(
        &self,
        texture: &AuthoredTexture,
        name: &str,
        shape: &Shape,
    ) -> Result<TextureEntry, String> {
        let found = self.found(texture);
        if !found.is_done {
            return Err(strings::PREPARING.to_owned());
        }
        let blending = self.blending(&texture.blend);
        let authored = found.authoring.author(texture.at, &blending);
        let mut authored = authored.ok_or_else(|| strings::NO_TEXTURE.to_owned())?;
        // With the pinned texture.
        authored.model = found.authoring.model(texture.at, &blending);
        let authored = authored.shaped(shape).map_err(|error| error.to_string())?;
        entry_of(&self.textures.library, name, &authored)
    }

    /// Textures that contribute along a path, and their mean weights, largest first.
    fn parents_along(&self, texture: &AuthoredTexture, path: &TexturePath) -> Vec<(usize, f64)> {
        let (authoring, blending) = (self.authoring_of(texture), self.blending(&texture.blend));
        let n_keys = path.keys().len() as f64;
        let mut shares = BTreeMap::new();
        for key in path.keys() {
            let authored = authoring.author(key.stop.at, &blending);
            for (parent, weight) in authored.map_or(Vec::new(), |authored| authored.parents) {
                *shares.entry(parent).or_insert(0.0) += weight / n_keys;
            }
        }
        let mut parents: Vec<(usize, f64)> = shares.into_iter().collect();
        parents.sort_by(|a, b| b.1.total_cmp(&a.1));
        parents
    }
}

/// What all signals of a session at one contact have in common.
pub(super) struct SignalContext<'a> {
    pub(super) library: &'a Library,
    /// Common source of the positions in the space.
    pub(super) source: Option<LabelSource>,
    pub(super) stroke: Option<Arc<Track>>,
    pub(super) model_rate: Hertz,
    pub(super) contact: Contact,
}

impl SignalContext<'_> {
    /// A signal of an authored texture, whose contributing textures are named in its sidecar.
    pub(super) fn signal(
        &self,
        authored: &Authored,
        sounding: Sounding,
        parents: &[(usize, f64)],
    ) -> SignalFile {
        let library = self.library;
        let named = |(texture, weight): &(usize, f64)| ParentV1::new(library, *texture, *weight);
        let sidecar = SidecarV1 {
            blend: authored.mode.id().to_owned(),
            shape: authored.shape.text(),
            library: library.name.clone(),
            label_source: self.source.map(|source| LabelSource::id(source).to_owned()),
            parents: parents.iter().map(named).collect(),
            ..SidecarV1::new(SIGNAL_RATE_HZ, SIGNAL_SECS, SIGNAL_SEED, CREATED_BY)
        };
        let entries = parents.iter().map(|(texture, _)| &library.textures[*texture]);
        let restricted = entries.filter(|entry| entry.provenance == Provenance::Restricted);
        SignalFile {
            sounding,
            contact: self.contact,
            stroke: self.stroke.clone(),
            tap: authored.tap(|texture| library.textures[texture].model.tap()),
            model_rate: self.model_rate,
            sidecar,
            restricted: restricted.map(|entry| entry.name.clone()).collect(),
        }
    }
}

/// An authored texture as a library entry.
///
/// # Errors
/// The interpolation mode computes no texture, or no file can hold it.
pub(super) fn entry_of(library: &Library, name: &str, authored: &Authored) -> Result<TextureEntry, String> {
    let model = authored.model.clone().ok_or(strings::NO_MODEL)?;
    // Far beyond the textures, a blend may be what no file may hold.
    model.check_stable().map_err(|error| error.to_string())?;
    let parents: Vec<usize> = authored.parents.iter().map(|(texture, _)| *texture).collect();
    let mut entry = library.entry_of_point(name, authored.location.at, model, &parents);
    if !authored.shape.is_neutral() {
        entry.origin = strings::shaped(&entry.origin, &authored.shape.to_string());
    }
    Ok(entry)
}

/// Signal of the Signals workspace at its own speed and force.
fn of_bench(signal: &Arc<BenchSignal>) -> SignalFile {
    let contact = Contact { speed: signal.speed, force: signal.force };
    let sidecar = SidecarV1::new(SIGNAL_RATE_HZ, signal.seconds(), SIGNAL_SEED, CREATED_BY);
    let restricted = signal.restricted.clone();
    let (stroke, tap, model_rate) = (None, None, Hertz(f64::from(SIGNAL_RATE_HZ)));
    let sounding = Sounding::Bench(Arc::clone(signal));
    SignalFile { sounding, contact, stroke, tap, model_rate, sidecar, restricted }
}

/// The sidecar with the point of an authored texture on the axes with these names.
pub(super) fn placed(sidecar: SidecarV1, authored: Option<&Authored>, axes: &[String]) -> SidecarV1 {
    let Some(authored) = authored else { return sidecar };
    let at = authored.location.at;
    SidecarV1 {
        at: Some(at.coordinates().to_vec()),
        at_named: Some(named_coordinates(axes.iter().map(String::as_str), at)),
        clamped: authored.location.clamped,
        extrapolated: authored.is_extrapolated,
        ..sidecar
    }
}
