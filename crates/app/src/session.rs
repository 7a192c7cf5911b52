//! What is open and what sounds: the library, its space, the authored blend, and the output that plays it.
//!
//! Nothing here is undone; everything here follows from the project, the library and the hands of the user.

mod devices;
mod felt;
mod heard;
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
mod strokes;

use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;
use std::time::Instant;

use anyhow::Context as _;
use shagreen_core::authoring::{Authored, Authoring, Blending};
use shagreen_core::plane::Plane;
use shagreen_core::rate::{at_rate, highest_rate};
use shagreen_core::space::{LabelSource, Space, SpacePoint};
use shagreen_core::texture_path::Along;
use shagreen_core::units::{Contact, Hertz, MetersPerSecond, Newtons};
use shagreen_device::controls::Input;
use shagreen_formats::library::{Library, Place, TextureEntry};
use shagreen_formats::placed_space::PlacedSpace;
use shagreen_formats::project::{AuthoredTexture, BlendChoice, Project, ProjectLibrary};

use crate::recorded_stroke::RecordedStroke;
use crate::recorder::Recorder;
use crate::rig::Rig;
use crate::scope_buffer::ScopeBuffer;
use crate::strings;

pub use self::opening::OutputChoice;
pub use self::pen::PenFacts;

use self::felt::Felt;
use self::heard::Heard;
use self::models_ahead::ModelsAhead;
use self::path_walk::PathWalk;
use self::pen::Pen;
use self::places::{Opened, attribute_names, places, poles_of};
use self::planes_ahead::PlanesAhead;
use self::player::Player;

/// Range of frequencies over which spectra are drawn, in Hz.
pub const BAND_HZ: (f64, f64) = (10.0, 500.0);
/// Frequencies at which spectra are drawn.
const N_FREQUENCIES: usize = 160;
/// Parents that are shown one by one, in colors of their own.
pub const N_SHOWN_PARENTS: usize = 3;
/// How far back latencies are remembered, in seconds.
pub const LATENCY_HISTORY_SECS: f64 = 10.0;
/// How long the field may take before the window speaks of it, in seconds.
const PATIENCE_SECS: f64 = 0.3;

/// The spectra at the contact of the moment.
#[derive(Clone, Debug, Default)]
pub struct Spectra {
    /// The contact.
    pub contact: Contact,
    /// Where they are evaluated, evenly spaced on a logarithmic axis.
    pub frequencies: Vec<Hertz>,
    /// Density of each parent that is shown, in the order of the weights.
    pub parents: Vec<Vec<f64>>,
    /// Density of the blend.
    pub blend: Vec<f64>,
}

/// Everything that is not undone.
pub struct Session {
    library: Library,
    /// The library of the project that is open, and others than the program's that were open before.
    base: ProjectLibrary,
    others: Vec<ProjectLibrary>,
    /// What the library said of its textures when it was opened. Those after its own are the project's.
    opened: Opened,
    joined: Vec<Arc<TextureEntry>>,
    renamed: BTreeMap<String, String>,
    /// The space that gave the textures their places, and the attributes that are the axes.
    used: Option<Arc<PlacedSpace>>,
    axes: Option<[String; 2]>,
    /// Where each texture lies on the canvas.
    places: Vec<Option<Place>>,
    /// Words at the low and the high end of the axis across, then of the one up.
    poles: [[String; 2]; 2],
    /// The textures over speed and force, and the rate in Hz that each has there.
    planes: Vec<Arc<Plane>>,
    rates_hz: Vec<f64>,
    planes_ahead: PlanesAhead,
    authoring: Authoring,
    generation: u64,
    models: ModelsAhead,
    authored: Option<Authored>,
    /// Whether what is heard may not be shown.
    is_hidden: bool,
    heard: Heard,
    /// What is felt in the place of what is authored.
    felt: Option<Felt>,
    /// How many textures were made for points.
    n_made: u64,
    spectra: Spectra,
    /// The stroke on the project's path, while that is played.
    walk: Option<PathWalk>,
    /// The stroke on the path that is heard alone, and which of the list that is.
    walk_alone: Option<(usize, PathWalk)>,
    /// Where the stroke is on the path that is played.
    path_point: Option<SpacePoint>,
    player: Player,
    rig: Rig,
    pen: Pen,
    /// Strokes and taps of late: when they were measured, and how late both were, in seconds.
    latencies: VecDeque<(Instant, f32, f32)>,
    /// What strokes by itself, if anything does.
    hand: Option<Input>,
    /// The stroke that the hand can repeat, and how many there were.
    stroke: Option<Arc<RecordedStroke>>,
    n_strokes: u64,
    /// The recording under way, if one is.
    recorder: Option<Recorder>,
    scope: ScopeBuffer,
    /// The rate of what lies in the space, in Hz.
    space_rate_hz: f64,
    /// The rate of what is heard, in Hz.
    rate_hz: f64,
}

impl Session {
    /// A session with a library; no output is open yet, and no worker begins before [`Session::begin_work`].
    ///
    /// # Errors
    /// The positions cannot be triangulated, or a texture cannot be had at the highest rate of them.
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
            authoring: Authoring::new(Space::new(&positions(&places))?),
            generation: 0,
            models: ModelsAhead::default(),
            heard: Heard::default(),
            felt: None,
            n_made: 0,
            planes_ahead: PlanesAhead::new(&planes),
            walk: None,
            walk_alone: None,
            path_point: None,
            player: Player::new(library.textures.len()),
            rig: Rig::default(),
            pen: Pen::default(),
            latencies: VecDeque::new(),
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
            authored: None,
            is_hidden: false,
            spectra: Spectra { frequencies: drawn_frequencies(rate_hz), ..Spectra::default() },
            hand: None,
            stroke: None,
            n_strokes: 0,
            recorder: None,
            scope: ScopeBuffer::new(48_000.0, rate_hz),
            space_rate_hz: rate_hz,
            rate_hz,
        };
        session.ask_for_models();
        Ok(session)
    }

    /// The library with the textures that joined it: what a file of it holds.
    pub fn library(&self) -> &Library {
        &self.library
    }

    /// The textures of the library, then those that joined it.
    pub fn textures(&self) -> &[TextureEntry] {
        &self.library.textures
    }

    /// A number that changes whenever what is authored at any point may have changed.
    pub fn generation(&self) -> u64 {
        self.generation
    }

    /// The textures over speed and force.
    pub(crate) fn planes(&self) -> &[Arc<Plane>] {
        &self.planes
    }

    /// Where they lie.
    pub fn space(&self) -> &Space {
        self.authoring.space()
    }

    /// Where the place of a texture comes from.
    pub fn place_source(&self, texture: usize) -> Option<LabelSource> {
        self.places.get(texture)?.map(|place| place.source)
    }

    /// Whether any place comes from simulated raters.
    pub fn is_simulated(&self) -> bool {
        self.places.iter().flatten().any(|place| place.source == LabelSource::SimulatedRaters)
    }

    /// Where all positions come from; `None` where there are none, or they come from several sources.
    pub fn common_source(&self) -> Option<LabelSource> {
        let mut sources = self.places.iter().flatten().map(|place| place.source);
        let first = sources.next()?;
        sources.all(|source| source == first).then_some(first)
    }

    /// In words, where the positions come from.
    pub fn label_source(&self) -> &'static str {
        match self.common_source() {
            Some(source) => source.label(),
            None if self.places.iter().all(Option::is_none) => strings::NO_SOURCE,
            None => strings::MIXED_SOURCES,
        }
    }

    /// Words at the low and the high end of the axis across, then of the one up.
    pub fn poles(&self) -> &[[String; 2]; 2] {
        &self.poles
    }

    /// Names of the attributes that the textures are rated on, each once.
    pub fn attribute_names(&self) -> Vec<&str> {
        attribute_names(&self.library.textures)
    }

    /// The textures with the places that their files gave them, whatever space is in use.
    pub fn library_as_opened(&self) -> Library {
        let mut library = self.library.clone();
        self.opened.restore(&mut library);
        library.join(&self.joined);
        library
    }

    /// Where the texture of this identifier is in the list.
    pub fn index_of(&self, id: &str) -> Option<usize> {
        self.library.index_of(id)
    }

    /// The texture that the project wants to be heard alone, by its place in the list.
    pub fn solo(&self, project: &Project) -> Option<usize> {
        self.index_of(project.solo.as_ref()?)
    }

    /// How textures become one, as far as the mode can do it.
    pub fn blending(&self, choice: &BlendChoice) -> Blending {
        choice.blending(|id| self.index_of(id))
    }

    /// The blend at the point; none where it may not be shown.
    pub fn authored(&self) -> Option<&Authored> {
        self.authored.as_ref().filter(|_| !self.is_hidden)
    }

    /// Hides what tells what is heard, or shows it again.
    pub fn set_hidden(&mut self, is_hidden: bool) {
        if self.is_hidden && !is_hidden {
            // What was played meanwhile tells as much as what plays.
            self.scope.clear();
        }
        self.is_hidden = is_hidden;
    }

    /// Whether what is heard may not be shown.
    pub fn is_hidden(&self) -> bool {
        self.is_hidden
    }

    /// The parents that are shown one by one: library indices and weights, largest first.
    pub fn shown_parents(&self) -> &[(usize, f64)] {
        let parents = self.authored().map_or(&[][..], |authored| &authored.parents);
        &parents[..parents.len().min(N_SHOWN_PARENTS)]
    }

    /// The place of a texture among the parents that are shown, largest weight first.
    pub fn parent_rank(&self, texture: usize) -> Option<usize> {
        self.shown_parents().iter().position(|(t, _)| *t == texture)
    }

    /// The weight of a parent that is shown.
    pub fn parent_weight(&self, texture: usize) -> Option<f64> {
        self.shown_parents().iter().find(|(t, _)| *t == texture).map(|(_, w)| *w)
    }

    /// Whether what the modes that make a texture need is still being worked out.
    pub fn is_preparing(&self) -> bool {
        self.models.awaited_secs().is_some()
    }

    /// Whether that takes long enough to be worth a word.
    pub fn is_long_preparing(&self) -> bool {
        self.models.awaited_secs().is_some_and(|secs| secs > PATIENCE_SECS)
    }

    /// How many textures the output holds, those on their way out not counted.
    pub fn n_loaded(&self) -> usize {
        self.player.n_loaded()
    }

    /// The spectra as of the last frame.
    pub fn spectra(&self) -> &Spectra {
        &self.spectra
    }

    /// What was played of late.
    pub fn scope(&self) -> &ScopeBuffer {
        &self.scope
    }

    /// The rate in Hz of the textures in the space: one of another rate is heard alone.
    pub fn space_rate_hz(&self) -> f64 {
        self.space_rate_hz
    }

    /// Follows the project: takes in its library and textures, finds the parents of what is `heard` (the texture that is
    /// selected, where nothing else is), and tells the output.
    pub fn follow(&mut self, project: &Project, heard: Option<&AuthoredTexture>, ctx: &egui::Context) {
        if self.base != project.library {
            let is_same = self.open_library(project);
            self.take(project, &is_same);
        }
        let is_same = |(a, b): (&Arc<TextureEntry>, &Arc<TextureEntry>)| Arc::ptr_eq(a, b);
        let n_same = self.joined.iter().zip(&project.joined).take_while(|pair| is_same(*pair)).count();
        let has_same_textures = n_same == self.joined.len() && n_same == project.joined.len();
        let has_same_names = self.renamed == project.renamed;
        // A space never changes, and is long: two that are equal are the same one.
        let spaces = (self.used.as_ref(), project.space.as_ref());
        let has_same_space = match spaces {
            (Some(before), Some(now)) => Arc::ptr_eq(before, now),
            (before, now) => before.is_none() && now.is_none(),
        };
        if !has_same_textures || !has_same_names || !has_same_space || self.axes != project.axes {
            self.take(project, &vec![true; self.opened.n_textures() + n_same]);
        }
        match self.models.collect() {
            Some(Ok(models)) => {
                self.authoring = self.authoring.clone().with_models(models);
                self.generation += 1;
                self.player.wanted = None;
            }
            Some(Err(reason)) => {
                self.player.message = Some(reason);
                self.player.wanted = None;
            }
            None => {}
        }
        if !self.follow_felt(ctx) {
            self.follow_texture(project, heard, ctx);
        }
        self.player.send_mix(&self.heard, self.planes_ahead.prepared(), self.rate_hz);
    }

    /// What is authored is heard, where it is not the one that was.
    fn follow_texture(&mut self, project: &Project, heard: Option<&AuthoredTexture>, ctx: &egui::Context) {
        let texture = heard.unwrap_or(project.texture());
        self.path_point = self.follow_path(texture.path.as_ref());
        // What is played along a path is no texture alone.
        let solo = self.solo(project).filter(|_| self.path_point.is_none() && heard.is_none());
        let at = self.path_point.unwrap_or(texture.at);
        let key = self.follow_key(solo);
        let wanted = (at, self.blending(&texture.blend), solo, key);
        if self.player.wanted.as_ref() != Some(&wanted) {
            self.authored = match solo {
                Some(texture) => Some(self.alone(texture, key, at, wanted.1.mode)),
                None => self.authoring.author(at, &wanted.1),
            };
            self.hear();
            self.player.wanted = Some(wanted);
            // What is heard alone may have another rate than the space.
            let alone = solo.filter(|texture| self.places[*texture].is_none());
            self.set_rate(alone.map_or(self.space_rate_hz, |texture| self.rates_hz[texture]), ctx);
        }
    }

    /// Takes over textures, places and axes of the project; those that `is_same` are as they were heard last, by index.
    fn take(&mut self, project: &Project, is_same: &[bool]) {
        self.opened.restore(&mut self.library);
        self.library = project.textures_on(std::mem::take(&mut self.library));
        let axes = project.axes.as_ref();
        self.places = places(&self.library.textures, axes);
        let rate_before_hz = self.space_rate_hz;
        self.space_rate_hz = self.rate_of_places(project).0;
        let mut is_kept = vec![false; self.places.len()];
        let (mut planes, mut rates_hz) = (Vec::new(), Vec::new());
        for (i, entry) in self.library.textures.iter_mut().enumerate() {
            let mut rate = rate_in(entry, self.places[i].as_ref(), Hertz(self.space_rate_hz));
            if is_same.get(i).is_some_and(|is_same| *is_same) && self.rates_hz[i] == rate.0 {
                is_kept[i] = true;
                planes.push(Arc::clone(&self.planes[i]));
            } else {
                let plane = plane_of(entry, rate).unwrap_or_else(|error| {
                    // Not to be blended then, but still to be heard alone.
                    self.player.message = Some(format!("{error:#}"));
                    self.places[i] = None;
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
        (self.planes, self.rates_hz) = (planes, rates_hz);
        self.planes_ahead.follow(&self.planes, &is_kept);
        self.player.keep(&is_kept);
        if rate_before_hz != self.space_rate_hz || !self.heard.survives(&is_kept, Hertz(self.rate_hz)) {
            self.heard = Heard::default();
            self.player.mix_is_new = true;
        }
        match Space::new(&positions(&self.places)) {
            Ok(space) => {
                let is_kept = |(texture, _): &(usize, SpacePoint)| is_kept[*texture];
                // As long as neither place nor texture changes, a field that took seconds stays.
                if space != *self.authoring.space() || !space.sites().iter().all(is_kept) {
                    self.authoring = Authoring::new(space);
                    self.ask_for_models();
                }
            }
            Err(error) => self.player.message = Some(error.to_string()),
        }
        self.poles = poles_of(&self.library, axes);
        self.generation += 1;
        (self.joined, self.used, self.axes) =
            (project.joined.clone(), project.space.clone(), project.axes.clone());
        self.renamed.clone_from(&project.renamed);
        self.player.wanted = None;
        if let Some(felt) = &mut self.felt {
            felt.is_new = true;
        }
    }

    /// The rate of the space: as the library was opened, its textures bring it, and those that join fit in or stay out.
    fn rate_of_places(&self, project: &Project) -> Hertz {
        let is_as_opened = project.space.is_none() && project.axes.is_none();
        let n_opened = self.opened.n_textures();
        let n_deciding = if is_as_opened && self.places[..n_opened].iter().any(Option::is_some) {
            n_opened
        } else {
            self.places.len()
        };
        rate_of_space(&self.library.textures[..n_deciding], &self.places[..n_deciding])
    }

    /// What is heard has this rate: where that is another one, the output is opened again.
    fn set_rate(&mut self, rate_hz: f64, ctx: &egui::Context) {
        if rate_hz != self.rate_hz {
            self.rate_hz = rate_hz;
            self.spectra = Spectra { frequencies: drawn_frequencies(rate_hz), ..Spectra::default() };
            self.open_output_again(ctx);
        }
    }

    /// Once a frame: sets workers to what waits for one.
    pub fn begin_work(&mut self, ctx: &egui::Context) {
        self.models.begin(ctx);
        self.planes_ahead.begin();
    }

    /// Once a frame: takes in what the output says, and works out what is shown. `contact` is what the spectra are
    /// drawn for while nothing touches.
    pub fn update(&mut self, contact: Contact) {
        self.planes_ahead.collect(&self.planes);
        let n_touches = self.status().map_or(0, |status| status.latency.n_touches);
        if self.player.collect(&mut self.scope) {
            self.player.set_hand(self.hand, self.stroke.as_ref());
            self.pen.give(&mut self.player.pen_live);
        }
        self.pen.collect();
        self.follow_strokes();
        self.note_latency(n_touches);
        self.scope.update();
        let touching = self.touch().contact;
        let contact = if touching.force_n > 0.0 && touching.speed_mps > 1e-3 {
            Contact {
                speed: MetersPerSecond(f64::from(touching.speed_mps)),
                force: Newtons(f64::from(touching.force_n)),
            }
        } else {
            contact
        };
        self.spectra.contact = contact;
        let nothing = || vec![0.0; self.spectra.frequencies.len()];
        self.spectra.blend =
            if self.is_hidden { nothing() } else { self.heard.psd(contact, &self.spectra.frequencies) };
        let parent =
            |(texture, _): &(usize, f64)| self.planes[*texture].at(contact).psd(&self.spectra.frequencies);
        self.spectra.parents = self.shown_parents().iter().map(parent).collect();
    }

    /// Plays the path of the project from its beginning, or the point again.
    pub fn play_path(&mut self, is_played: bool) {
        self.walk = is_played.then(|| PathWalk::new(Along::default()));
    }

    /// Whether the texture follows the path.
    pub fn is_path_playing(&self) -> bool {
        self.walk.is_some()
    }

    /// Where the stroke is on the path, while one is played.
    pub fn path_point(&self) -> Option<SpacePoint> {
        self.path_point
    }

    /// What textures are authored in.
    pub fn authoring(&self) -> &Authoring {
        &self.authoring
    }

    /// What was said at the foot was read.
    pub fn forget_message(&mut self) {
        self.player.message = None;
    }

    /// Says at the foot what is wrong.
    pub fn say(&mut self, message: String) {
        self.player.message = Some(message);
    }
}

/// The rate of the textures in the space, which is the highest of them: voices of different rates cannot be mixed. Where
/// none has a place, that of the first.
fn rate_of_space(textures: &[TextureEntry], places: &[Option<Place>]) -> Hertz {
    let first = textures.first().map(|texture| texture.model.rate());
    let placed = textures.iter().zip(places).filter(|(_, place)| place.is_some()).map(|(t, _)| &t.model);
    highest_rate(placed).or(first).unwrap_or(Hertz(1000.0))
}

/// The rate at which a texture is heard: that of the space where it has a place there, else its own, since it is heard
/// alone.
fn rate_in(texture: &TextureEntry, place: Option<&Place>, rate_of_space: Hertz) -> Hertz {
    place.map_or(texture.model.rate(), |_| rate_of_space)
}

/// The plane of a texture at a rate.
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

/// Where spectra of a model are drawn: beyond half its rate it only repeats itself.
fn drawn_frequencies(rate_hz: f64) -> Vec<Hertz> {
    let (low, high) = (BAND_HZ.0, BAND_HZ.1.min(0.4995 * rate_hz));
    let frequency = |i: usize| low * (high / low).powf(i as f64 / (N_FREQUENCIES - 1) as f64);
    (0..N_FREQUENCIES).map(|i| Hertz(frequency(i))).collect()
}

#[cfg(test)]
mod tests;
