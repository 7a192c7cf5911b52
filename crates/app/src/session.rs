//! The open library, its space, the interpolated texture, and the output that plays it.
//!
//! Undo does not apply here: this state follows from the project, the library, and the input of the user.

mod authored_state;
mod devices;
mod felt;
mod hand_state;
mod heard;
pub(crate) mod kept_path;
mod loaded_textures;
mod making;
mod models_ahead;
mod open_library;
mod opening;
mod path_walk;
mod pen;
mod places;
mod planes_ahead;
mod player;
mod signal;
mod sound;
mod strokes;

use std::collections::BTreeMap;
use std::sync::Arc;

use anyhow::Context as _;
use shagreen_core::space::authoring::{Authored, Authoring, Blending};
use shagreen_core::space::texture_path::Along;
use shagreen_core::space::{LabelSource, Space, SpacePoint};
use shagreen_core::texture::plane::Plane;
use shagreen_core::texture::rate::{at_rate, highest_rate};
use shagreen_core::units::{Contact, Hertz};
use shagreen_formats::library::{Library, Place, TextureEntry};
use shagreen_formats::project::{AuthoredTexture, BlendChoice, Project, ProjectLibrary};

use crate::state::scope_buffer::ScopeBuffer;
use crate::strings;

pub use self::opening::OutputChoice;
pub use self::pen::PenFacts;

use self::authored_state::AuthoredState;
use self::hand_state::HandState;
use self::heard::Heard;
use self::loaded_textures::Textures;
use self::path_walk::PathWalk;
use self::places::{Opened, attribute_names, places, poles_of};
use self::planes_ahead::PlanesAhead;
use self::sound::Sound;

/// Frequency range of the drawn spectra, in Hz.
pub const BAND_HZ: (f64, f64) = (10.0, 500.0);
/// Number of frequencies of the drawn spectra.
const N_FREQUENCIES: usize = 160;
/// Maximum number of contributing textures that are shown separately, each in its own color.
pub const N_SHOWN_PARENTS: usize = 3;
/// Time span of the latency history, in seconds.
pub const LATENCY_HISTORY_SECS: f64 = 10.0;
/// Computation time of the field after which the window shows a notice, in seconds.
const PATIENCE_SECS: f64 = 0.3;

/// Power spectral densities at the present contact, in (m/s²)²/Hz.
#[derive(Clone, Debug, Default)]
pub struct Spectra {
    /// Speed and force for which the spectra are computed.
    pub contact: Contact,
    /// Frequencies of the spectra, at equal steps on a logarithmic axis.
    pub frequencies: Vec<Hertz>,
    /// Density of each shown contributing texture, largest weight first.
    pub parents: Vec<Vec<f64>>,
    /// Density of the audible mixture.
    pub blend: Vec<f64>,
}

/// State that undo does not apply to.
pub struct Session {
    textures: Textures,
    authored: AuthoredState,
    sound: Sound,
    hand: HandState,
}

impl Session {
    /// Creates a session for a library. No output is open yet, and workers start only with [`Session::begin_work`].
    ///
    /// # Errors
    /// The library cannot be read, its positions cannot be triangulated, or a texture cannot be converted to the
    /// highest sample rate.
    pub fn new(base: ProjectLibrary) -> anyhow::Result<Self> {
        let library = base.read().context(strings::DAMAGED_LIBRARY)?;
        let places = places(&library.textures, None);
        let rate = rate_of_space(&library.textures, &places);
        let rate_hz = rate.0;
        let mut planes = Vec::with_capacity(places.len());
        for (texture, place) in library.textures.iter().zip(&places) {
            planes.push(Arc::new(plane_of(texture, rate_in(texture, place.as_ref(), rate))?));
        }
        let rates = library.textures.iter().zip(&places).map(|(t, place)| rate_in(t, place.as_ref(), rate).0);
        let mut session = Self {
            authored: AuthoredState::new(Authoring::new(Space::new(&positions(&places))?)),
            sound: Sound::new(library.textures.len(), rate_hz),
            hand: HandState::default(),
            textures: Textures {
                planes_ahead: PlanesAhead::new(&planes),
                others: Vec::new(),
                base,
                opened: Opened::new(&library),
                joined: Vec::new(),
                renamed: BTreeMap::new(),
                used: None,
                axes: None,
                poles: poles_of(&library, None),
                rates_hz: rates.collect(),
                places,
                planes,
                library,
                space_rate_hz: rate_hz,
            },
        };
        session.ask_for_models();
        Ok(session)
    }

    /// Library with the textures that the project added, as it would be saved.
    pub fn library(&self) -> &Library {
        &self.textures.library
    }

    /// Textures of the library, followed by those that the project added.
    pub fn textures(&self) -> &[TextureEntry] {
        &self.textures.library.textures
    }

    /// Number that changes whenever an interpolated texture at any point may have changed.
    pub fn generation(&self) -> u64 {
        self.authored.generation
    }

    pub(crate) fn planes(&self) -> &[Arc<Plane>] {
        &self.textures.planes
    }

    /// Authoring space of the textures.
    pub fn space(&self) -> &Space {
        self.authored.authoring.space()
    }

    /// Source of a texture's position, or `None` if the texture has no position.
    pub fn place_source(&self, texture: usize) -> Option<LabelSource> {
        self.textures.places.get(texture)?.map(|place| place.source)
    }

    /// Whether any position comes from simulated raters.
    pub fn is_simulated(&self) -> bool {
        self.textures.places.iter().flatten().any(|place| place.source == LabelSource::SimulatedRaters)
    }

    /// Common source of all positions, or `None` if there are no positions or several sources.
    pub fn common_source(&self) -> Option<LabelSource> {
        let mut sources = self.textures.places.iter().flatten().map(|place| place.source);
        let first = sources.next()?;
        sources.all(|source| source == first).then_some(first)
    }

    /// Source of the positions, as shown to the user.
    pub fn label_source(&self) -> &'static str {
        match self.common_source() {
            Some(source) => source.label(),
            None if self.textures.places.iter().all(Option::is_none) => strings::NO_SOURCE,
            None => strings::MIXED_SOURCES,
        }
    }

    /// Words at the low and the high end of the x axis, then of the y axis.
    pub fn poles(&self) -> &[[String; 2]; 2] {
        &self.textures.poles
    }

    /// Names of the attributes on which the textures are rated, without duplicates.
    pub fn attribute_names(&self) -> Vec<&str> {
        attribute_names(&self.textures.library.textures)
    }

    /// Library with the positions stated in its file, regardless of the space in use.
    pub fn library_as_opened(&self) -> Library {
        let mut library = self.textures.library.clone();
        self.textures.opened.restore(&mut library);
        library.join(&self.textures.joined);
        library
    }

    /// Index of the texture with this id.
    pub fn index_of(&self, id: &str) -> Option<usize> {
        self.textures.library.index_of(id)
    }

    /// Index of the soloed texture of the project.
    pub fn solo(&self, project: &Project) -> Option<usize> {
        self.index_of(project.solo.as_ref()?)
    }

    /// Interpolation options, with the pinned textures as library indices.
    pub fn blending(&self, choice: &BlendChoice) -> Blending {
        choice.blending(|id| self.index_of(id))
    }

    /// Interpolated texture at the point, or `None` if there is none or a blind comparison hides it.
    pub fn authored(&self) -> Option<&Authored> {
        self.authored.current.as_ref().filter(|_| !self.authored.is_hidden)
    }

    /// Hides or shows everything that identifies the audible texture in a blind comparison.
    pub fn set_hidden(&mut self, is_hidden: bool) {
        if self.authored.is_hidden && !is_hidden {
            // The signal that was recorded during the blind comparison would reveal the texture.
            self.sound.scope.clear();
        }
        self.authored.is_hidden = is_hidden;
    }

    /// Whether a blind comparison hides the audible texture.
    pub fn is_hidden(&self) -> bool {
        self.authored.is_hidden
    }

    /// Library indices and weights of the contributing textures that are shown separately, largest weight first.
    pub fn shown_parents(&self) -> &[(usize, f64)] {
        let parents = self.authored().map_or(&[][..], |authored| &authored.parents);
        &parents[..parents.len().min(N_SHOWN_PARENTS)]
    }

    /// Rank of a texture among the shown contributing textures, largest weight first.
    pub fn parent_rank(&self, texture: usize) -> Option<usize> {
        self.shown_parents().iter().position(|(t, _)| *t == texture)
    }

    /// Weight of a shown contributing texture.
    pub fn parent_weight(&self, texture: usize) -> Option<f64> {
        self.shown_parents().iter().find(|(t, _)| *t == texture).map(|(_, w)| *w)
    }

    /// Whether a worker is computing the field and parametric models.
    pub fn is_preparing(&self) -> bool {
        self.authored.models.awaited_secs().is_some()
    }

    /// Whether that computation takes so long that the window shows a notice.
    pub fn is_long_preparing(&self) -> bool {
        self.authored.models.awaited_secs().is_some_and(|secs| secs > PATIENCE_SECS)
    }

    /// Number of textures loaded in the output, except those that are fading out.
    pub fn n_loaded(&self) -> usize {
        self.sound.player.n_loaded()
    }

    /// Spectra computed in the last frame.
    pub fn spectra(&self) -> &Spectra {
        &self.sound.spectra
    }

    /// Recently played samples.
    pub fn scope(&self) -> &ScopeBuffer {
        &self.sound.scope
    }

    /// Sample rate of the textures in the space, in Hz. A texture with another rate can only be soloed.
    pub fn space_rate_hz(&self) -> f64 {
        self.textures.space_rate_hz
    }

    /// Follows the project once a frame: updates the library and its textures, interpolates the audible texture, and
    /// sends it to the output. Without `heard`, the audible texture is the selected one.
    pub fn follow(&mut self, project: &Project, heard: Option<&AuthoredTexture>, ctx: &egui::Context) {
        if self.textures.base != project.library {
            let is_same = self.open_library(project);
            self.take(project, &is_same);
        }
        let is_same = |(a, b): (&Arc<TextureEntry>, &Arc<TextureEntry>)| Arc::ptr_eq(a, b);
        let n_same =
            self.textures.joined.iter().zip(&project.joined).take_while(|pair| is_same(*pair)).count();
        let has_same_textures = n_same == self.textures.joined.len() && n_same == project.joined.len();
        let has_same_names = self.textures.renamed == project.renamed;
        // A space is large and never modified, so that comparing pointers is sufficient.
        let spaces = (self.textures.used.as_ref(), project.space.as_ref());
        let has_same_space = match spaces {
            (Some(before), Some(now)) => Arc::ptr_eq(before, now),
            (before, now) => before.is_none() && now.is_none(),
        };
        if !has_same_textures || !has_same_names || !has_same_space || self.textures.axes != project.axes {
            self.take(project, &vec![true; self.textures.opened.n_textures() + n_same]);
        }
        match self.authored.models.collect() {
            Some(Ok(models)) => {
                self.authored.authoring = self.authored.authoring.clone().with_models(models);
                self.authored.generation += 1;
                self.sound.player.wanted = None;
            }
            Some(Err(reason)) => {
                self.sound.player.message = Some(reason);
                self.sound.player.wanted = None;
            }
            None => {}
        }
        if !self.follow_felt(ctx) {
            self.follow_texture(project, heard, ctx);
        }
        self.sound.player.send_mix(
            &self.sound.heard,
            self.textures.planes_ahead.prepared(),
            self.sound.rate_hz,
        );
    }

    /// Interpolates the audible texture if it has changed.
    fn follow_texture(&mut self, project: &Project, heard: Option<&AuthoredTexture>, ctx: &egui::Context) {
        let texture = heard.unwrap_or(project.texture());
        self.authored.path_point = self.follow_path(texture.path.as_ref());
        // A path overrides solo.
        let solo = self.solo(project).filter(|_| self.authored.path_point.is_none() && heard.is_none());
        let at = self.authored.path_point.unwrap_or(texture.at);
        let key = self.follow_key(solo);
        let wanted = (at, self.blending(&texture.blend), solo, key);
        if self.sound.player.wanted.as_ref() != Some(&wanted) {
            self.authored.current = match solo {
                Some(texture) => Some(self.alone(texture, key, at, wanted.1.mode)),
                None => self.authored.authoring.author(at, &wanted.1),
            };
            self.hear();
            self.sound.player.wanted = Some(wanted);
            // A soloed texture without a position may have another sample rate than the space.
            let alone = solo.filter(|texture| self.textures.places[*texture].is_none());
            self.set_rate(
                alone.map_or(self.textures.space_rate_hz, |texture| self.textures.rates_hz[texture]),
                ctx,
            );
        }
    }

    /// Takes over textures, positions and axes from the project. `is_same` states, by index, which models are unchanged
    /// since the last call.
    fn take(&mut self, project: &Project, is_same: &[bool]) {
        self.textures.opened.restore(&mut self.textures.library);
        self.textures.library = project.textures_on(std::mem::take(&mut self.textures.library));
        let axes = project.axes.as_ref();
        self.textures.places = places(&self.textures.library.textures, axes);
        let rate_before_hz = self.textures.space_rate_hz;
        self.textures.space_rate_hz = self.rate_of_places(project).0;
        let mut is_kept = vec![false; self.textures.places.len()];
        let (mut planes, mut rates_hz) = (Vec::new(), Vec::new());
        for (i, entry) in self.textures.library.textures.iter_mut().enumerate() {
            let mut rate =
                rate_in(entry, self.textures.places[i].as_ref(), Hertz(self.textures.space_rate_hz));
            if is_same.get(i).is_some_and(|is_same| *is_same) && self.textures.rates_hz[i] == rate.0 {
                is_kept[i] = true;
                planes.push(Arc::clone(&self.textures.planes[i]));
            } else {
                let plane = plane_of(entry, rate).unwrap_or_else(|error| {
                    // The texture cannot be interpolated, but it can still be soloed.
                    self.sound.player.message = Some(format!("{error:#}"));
                    self.textures.places[i] = None;
                    if axes.is_none() {
                        entry.place = None;
                    }
                    rate = entry.model.rate();
                    Plane::new(&entry.model)
                });
                planes.push(Arc::new(plane));
            }
            rates_hz.push(rate.0);
        }
        (self.textures.planes, self.textures.rates_hz) = (planes, rates_hz);
        self.textures.planes_ahead.follow(&self.textures.planes, &is_kept);
        self.sound.player.keep(&is_kept);
        if rate_before_hz != self.textures.space_rate_hz
            || !self.sound.heard.survives(&is_kept, Hertz(self.sound.rate_hz))
        {
            self.sound.heard = Heard::default();
            self.sound.player.mix_is_new = true;
        }
        match Space::new(&positions(&self.textures.places)) {
            Ok(space) => {
                let is_kept = |(texture, _): &(usize, SpacePoint)| is_kept[*texture];
                // Computing a field takes seconds, so it is kept while neither positions nor textures change.
                if space != *self.authored.authoring.space() || !space.sites().iter().all(is_kept) {
                    self.authored.authoring = Authoring::new(space);
                    self.ask_for_models();
                }
            }
            Err(error) => self.sound.player.message = Some(error.to_string()),
        }
        self.textures.poles = poles_of(&self.textures.library, axes);
        self.authored.generation += 1;
        (self.textures.joined, self.textures.used, self.textures.axes) =
            (project.joined.clone(), project.space.clone(), project.axes.clone());
        self.textures.renamed.clone_from(&project.renamed);
        self.sound.player.wanted = None;
        if let Some(felt) = &mut self.sound.felt {
            felt.is_new = true;
        }
    }

    /// Sample rate of the space. With the library's own positions, only textures of the library determine it, and added
    /// textures are converted to it or left out.
    fn rate_of_places(&self, project: &Project) -> Hertz {
        let is_as_opened = project.space.is_none() && project.axes.is_none();
        let n_opened = self.textures.opened.n_textures();
        let n_deciding = if is_as_opened && self.textures.places[..n_opened].iter().any(Option::is_some) {
            n_opened
        } else {
            self.textures.places.len()
        };
        rate_of_space(&self.textures.library.textures[..n_deciding], &self.textures.places[..n_deciding])
    }

    /// Sets the sample rate of the audible textures in Hz, and reopens the output if it changes.
    fn set_rate(&mut self, rate_hz: f64, ctx: &egui::Context) {
        if rate_hz != self.sound.rate_hz {
            self.sound.rate_hz = rate_hz;
            self.sound.spectra = Spectra { frequencies: drawn_frequencies(rate_hz), ..Spectra::default() };
            self.open_output_again(ctx);
        }
    }

    /// Starts workers for waiting jobs, once a frame.
    pub fn begin_work(&mut self, ctx: &egui::Context) {
        self.authored.models.begin(ctx);
        self.textures.planes_ahead.begin();
    }

    /// Reads the state of the output and updates the displayed data, once a frame. The spectra are computed for
    /// `contact` while nothing touches.
    pub fn update(&mut self, contact: Contact) {
        self.textures.planes_ahead.collect(&self.textures.planes);
        let n_touches = self.status().map_or(0, |status| status.latency.n_touches);
        if self.sound.player.collect(&mut self.sound.scope) {
            self.sound.player.set_hand(self.hand.automatic, self.hand.stroke.as_ref());
            self.hand.pen.give(&mut self.sound.player.pen_live);
        }
        self.hand.pen.collect();
        self.follow_strokes();
        self.note_latency(n_touches);
        self.sound.scope.update();
        let touching = self.touch().contact;
        let contact =
            if touching.force_n > 0.0 && touching.speed_mps > 1e-3 { touching.into() } else { contact };
        self.sound.spectra.contact = contact;
        let nothing = || vec![0.0; self.sound.spectra.frequencies.len()];
        self.sound.spectra.blend = if self.authored.is_hidden {
            nothing()
        } else {
            self.sound.heard.psd(contact, &self.sound.spectra.frequencies)
        };
        let parent = |(texture, _): &(usize, f64)| {
            self.textures.planes[*texture].at(contact).psd(&self.sound.spectra.frequencies)
        };
        self.sound.spectra.parents = self.shown_parents().iter().map(parent).collect();
    }

    /// Plays the path of the project from its start, or returns to the point.
    pub fn play_path(&mut self, is_played: bool) {
        self.authored.walk = is_played.then(|| PathWalk::new(Along::default()));
    }

    /// Whether the texture follows the path.
    pub fn is_path_playing(&self) -> bool {
        self.authored.walk.is_some()
    }

    /// Position of the stroke on the path that is played.
    pub fn path_point(&self) -> Option<SpacePoint> {
        self.authored.path_point
    }

    /// Interpolation in the space.
    pub fn authoring(&self) -> &Authoring {
        &self.authored.authoring
    }

    /// Removes the message from the status bar.
    pub fn forget_message(&mut self) {
        self.sound.player.message = None;
    }

    /// Shows a message in the status bar.
    pub fn say(&mut self, message: String) {
        self.sound.player.message = Some(message);
    }
}

/// Sample rate of the space: the highest rate of its textures, because signals of different rates cannot be mixed.
/// Without positions it is the rate of the first texture.
fn rate_of_space(textures: &[TextureEntry], places: &[Option<Place>]) -> Hertz {
    let first = textures.first().map(|texture| texture.model.rate());
    let placed = textures.iter().zip(places).filter(|(_, place)| place.is_some()).map(|(t, _)| &t.model);
    highest_rate(placed).or(first).unwrap_or(Hertz(1000.0))
}

/// Sample rate at which a texture plays: that of the space, or its own if it has no position and can only be soloed.
fn rate_in(texture: &TextureEntry, place: Option<&Place>, rate_of_space: Hertz) -> Hertz {
    place.map_or(texture.model.rate(), |_| rate_of_space)
}

fn plane_of(texture: &TextureEntry, rate: Hertz) -> anyhow::Result<Plane> {
    if texture.model.rate() == rate {
        return Ok(Plane::new(&texture.model));
    }
    let converted = at_rate(&texture.model, rate)
        .with_context(|| format!("\"{}\" cannot be mixed with textures of {rate}", texture.id))?;
    Ok(Plane::new(&converted.model))
}

fn positions(places: &[Option<Place>]) -> Vec<Option<SpacePoint>> {
    places.iter().map(|place| place.map(|place| place.at)).collect()
}

/// Frequencies of the drawn spectra. They end just below half the sample rate, above which the spectrum repeats.
fn drawn_frequencies(rate_hz: f64) -> Vec<Hertz> {
    let (low, high) = (BAND_HZ.0, BAND_HZ.1.min(0.4995 * rate_hz));
    let frequency = |i: usize| low * (high / low).powf(i as f64 / (N_FREQUENCIES - 1) as f64);
    (0..N_FREQUENCIES).map(|i| Hertz(frequency(i))).collect()
}

#[cfg(test)]
mod tests;
