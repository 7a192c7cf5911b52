//! The open library, its space, the interpolated texture, and the output that plays it.
//!
//! Undo does not apply here: this state follows from the project, the library, and the input of the user.

mod audible;
mod audible_worker;
pub(crate) mod authored_sources;
mod authored_state;
mod axes;
mod devices;
mod follow;
mod hand_state;
mod interpolation;
pub(crate) mod kept_path;
mod loaded_textures;
mod masking_output;
mod messages;
mod models_worker;
mod open_library;
mod opening;
mod path_walk;
mod pen;
mod places;
mod planes_worker;
mod played_signal;
mod player;
mod presented_texture;
mod signal;
mod sound;
mod spaces;
mod strokes;
mod used_textures;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use anyhow::Context as _;
use shagreen_core::space::authoring::Authored;
use shagreen_core::space::texture_path::Along;
use shagreen_core::space::{LabelSource, Space, SpacePoint};
use shagreen_core::texture::plane::Plane;
use shagreen_core::units::{Contact, Hertz, Radians};
use shagreen_formats::axis_sources::is_predicted_from_ratings;
use shagreen_formats::library::{Library, TextureEntry};
use shagreen_formats::project::{AddedCoordinates, BlendChoice, OwnTextures, Project, ProjectLibrary};
use shagreen_studio::authoring::plane_at;
use shagreen_studio::axes::{AxisColumns, list_places};
use shagreen_studio::report::Warnings;

use crate::state::scope_buffer::ScopeBuffer;
use crate::strings;

pub use self::masking_output::MaskingOutput;
pub use self::opening::OutputChoice;
pub use self::pen::PenFacts;
pub use self::played_signal::Presented;
pub use self::presented_texture::PresentedTexture;

use self::authored_state::AuthoredState;
use self::hand_state::HandState;
use self::loaded_textures::{Textures, positions, rate_in, rate_of_space};
use self::messages::Said;
use self::path_walk::PathWalk;
use self::places::{Opened, names_of, poles_of};
use self::planes_worker::PlanesWorker;
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
    /// Message that is about neither the output nor the pen.
    said: Option<Said>,
}

impl Session {
    /// Creates a session for a library. No output is open yet, and workers start only with [`Session::begin_work`].
    ///
    /// # Errors
    /// The library cannot be read, its positions cannot be triangulated, or a texture cannot be converted to the
    /// highest sample rate.
    pub fn new(base: ProjectLibrary) -> anyhow::Result<Self> {
        let library = base.read().context(strings::DAMAGED_LIBRARY)?;
        let coordinates = AddedCoordinates::default();
        let places = list_places(&library, None, &mut AxisColumns::default(), &coordinates);
        let axis_names = names_of(&library, None);
        let rate = rate_of_space(&library.textures, &places);
        let rate_hz = rate.0;
        let mut planes = Vec::with_capacity(places.len());
        for (texture, place) in library.textures.iter().zip(&places) {
            planes.push(Arc::new(plane_at(
                texture,
                rate_in(texture, place.as_ref(), rate),
                &Warnings::default(),
            )?));
        }
        let rates = library.textures.iter().zip(&places).map(|(t, place)| rate_in(t, place.as_ref(), rate).0);
        let mut session = Self {
            authored: AuthoredState::new(Space::new(&positions(&places))?),
            sound: Sound::new(library.textures.len(), rate_hz),
            hand: HandState::default(),
            said: None,
            textures: Textures {
                planes_ahead: PlanesWorker::new(&planes),
                others: Vec::new(),
                base,
                opened: Opened::new(&library),
                joined: Vec::new(),
                own_ids: BTreeSet::new(),
                own: OwnTextures::default(),
                coordinates,
                renamed: BTreeMap::new(),
                used: None,
                axes: None,
                columns: AxisColumns::default(),
                poles: poles_of(&axis_names),
                axis_names,
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

    pub(crate) fn planes(&self) -> &[Arc<Plane>] {
        &self.textures.planes
    }

    /// Authoring space of the textures that the audible authored texture uses.
    pub fn space(&self) -> &Space {
        self.authored.spaces.current().space()
    }

    /// Position of a texture, whether the audible authored texture uses it or not; `None` if it has none.
    pub fn position(&self, texture: usize) -> Option<SpacePoint> {
        self.textures.places.get(texture)?.map(|place| place.at)
    }

    /// Indices and positions of all textures that have one.
    pub fn placed(&self) -> impl Iterator<Item = (usize, SpacePoint)> {
        let places = self.textures.places.iter().enumerate();
        places.filter_map(|(texture, place)| Some((texture, place.as_ref()?.at)))
    }

    /// Indices and positions of the textures that take part in an authored texture with these options.
    pub fn placed_for(&self, blend: &BlendChoice) -> Vec<(usize, SpacePoint)> {
        let left_out = self.left_out(blend);
        self.placed().filter(|(texture, _)| !left_out.contains(texture)).collect()
    }

    /// Whether a texture takes part only in the authored textures that pin it.
    pub fn is_own(&self, texture: usize) -> bool {
        self.textures.own.contains(texture)
    }

    /// Source of a texture's position, or `None` if the texture has no position.
    pub fn place_source(&self, texture: usize) -> Option<LabelSource> {
        self.textures.places.get(texture)?.map(|place| place.source)
    }

    /// Standard deviation of a texture's position on the axes of the canvas, 0 to 100; `None` unless it was estimated with one.
    pub fn place_deviation(&self, texture: usize) -> Option<[f64; 2]> {
        self.textures.places.get(texture)?.and_then(|place| place.deviation)
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
            Some(LabelSource::Estimated) if self.is_predicted_from_ratings() => {
                strings::PREDICTED_FROM_RATINGS
            }
            Some(source) => source.label(),
            None if self.textures.places.iter().all(Option::is_none) => strings::NO_SOURCE,
            None => strings::MIXED_SOURCES,
        }
    }

    /// Whether models trained on human ratings predicted positions of the space in use.
    fn is_predicted_from_ratings(&self) -> bool {
        self.textures.library.space_report.as_ref().is_some_and(is_predicted_from_ratings)
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

    /// Library indices and weights of all contributing textures, largest weight first; empty without
    /// [`Session::authored`].
    pub fn parents(&self) -> &[(usize, f64)] {
        self.authored().map_or(&[][..], |authored| &authored.parents)
    }

    /// Those of [`Session::parents`] that are shown separately.
    pub fn shown_parents(&self) -> &[(usize, f64)] {
        let parents = self.parents();
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
        self.authored.spaces.is_waiting()
    }

    /// Whether that computation takes so long that the window shows a notice.
    pub fn is_long_preparing(&self) -> bool {
        self.is_preparing() && self.authored.models.awaited_secs().is_some_and(|secs| secs > PATIENCE_SECS)
    }

    /// Number of textures loaded in the output, except those that are fading out.
    pub fn n_loaded(&self) -> usize {
        self.sound.player.n_loaded()
    }

    /// Spectra computed in the last frame.
    pub fn spectra(&self) -> &Spectra {
        &self.sound.spectra
    }

    /// Direction of the lay on the pad, if the audible texture has one at the contact of the spectra.
    pub fn lay(&self) -> Option<Radians> {
        if self.authored.is_hidden { None } else { self.sound.heard.lay(self.sound.spectra.contact) }
    }

    /// Angle of the x axis of the audible texture on the pad, counterclockwise; zero if a blind comparison hides it.
    pub fn turn(&self) -> Radians {
        if self.authored.is_hidden { Radians(0.0) } else { self.sound.heard.turn() }
    }

    /// Recently played samples.
    pub fn scope(&self) -> &ScopeBuffer {
        &self.sound.scope
    }

    /// Sample rate of the textures in the space, in Hz. A texture with another rate can only be soloed.
    pub fn space_rate_hz(&self) -> f64 {
        self.textures.space_rate_hz
    }

    /// Starts workers for waiting jobs, once a frame.
    pub fn begin_work(&mut self, ctx: &egui::Context) {
        self.hand.pen.set_focus(ctx.input(|i| i.focused));
        self.authored.models.begin(ctx);
        self.textures.planes_ahead.begin(ctx);
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
}

/// Frequencies of the drawn spectra. They end just below half the sample rate, above which the spectrum repeats.
fn drawn_frequencies(rate_hz: f64) -> Vec<Hertz> {
    let (low, high) = (BAND_HZ.0, BAND_HZ.1.min(0.4995 * rate_hz));
    let frequency = |i: usize| low * (high / low).powf(i as f64 / (N_FREQUENCIES - 1) as f64);
    (0..N_FREQUENCIES).map(|i| Hertz(frequency(i))).collect()
}

#[cfg(test)]
mod tests;
