//! What is open and what sounds: the library, its space, the authored blend, and the output that plays it.
//!
//! Nothing here is undone; everything here follows from the project, the library and the hands of the user.

mod player;

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::Instant;

use anyhow::Context as _;
use shagreen_core::blend::{Authored, author, mixture_psd};
use shagreen_core::plane::{Plane, Prepared};
use shagreen_core::rate::{at_rate, highest_rate};
use shagreen_core::space::{Location, Space};
use shagreen_core::units::{Contact, Hertz, MetersPerSecond, Newtons};
use shagreen_device::hand::Hand;
use shagreen_device::output::OutputInfo;
use shagreen_device::status::Status;
use shagreen_device::touch::Touch;
use shagreen_formats::library::{Library, TextureEntry};

use crate::pad::MouseReport;
use crate::project::Project;
use crate::scope_buffer::ScopeBuffer;
use crate::strings;

pub use self::player::OutputChoice;

use self::player::Player;

/// Range of frequencies over which spectra are drawn, in Hz.
pub const BAND_HZ: (f64, f64) = (10.0, 500.0);
/// Frequencies at which spectra are drawn.
const N_FREQUENCIES: usize = 160;

/// The spectra at the contact of the moment.
#[derive(Clone, Debug, Default)]
pub struct Spectra {
    /// Where they are evaluated, evenly spaced on a logarithmic axis.
    pub frequencies: Vec<Hertz>,
    /// Density of each parent, in the order of the weights.
    pub parents: Vec<Vec<f64>>,
    /// Density of the blend.
    pub blend: Vec<f64>,
}

/// Everything that is not undone.
pub struct Session {
    library: Library,
    /// How many textures the library was opened with; those after them are the project's.
    n_opened: usize,
    added: Vec<Arc<TextureEntry>>,
    planes: Vec<Arc<Plane>>,
    /// What the output takes, worked out ahead by a worker: a drag into textures not yet heard must not wait for it.
    prepared: Vec<Option<Prepared>>,
    incoming: Receiver<Ahead>,
    sender: Sender<Ahead>,
    space: Space,
    authored: Option<Authored>,
    spectra: Spectra,
    player: Player,
    hand: Option<Hand>,
    scope: ScopeBuffer,
    /// The rate of what lies in the space, in Hz.
    space_rate_hz: f64,
    /// The rate of what is heard, in Hz.
    rate_hz: f64,
}

/// A texture that a worker has prepared: where it was in the list, and the plane that tells whether it still is.
type Ahead = (usize, Arc<Plane>, Prepared);

impl Session {
    /// A session with a library; no output is open yet.
    ///
    /// # Errors
    /// The positions cannot be triangulated, or a texture cannot be had at the highest rate of them.
    pub fn new(library: Library) -> anyhow::Result<Self> {
        let rate = rate_of_space(library.textures.iter());
        let rate_hz = rate.0;
        let planes = library.textures.iter().map(|t| Ok(Arc::new(plane_of(t, rate)?)));
        let planes = planes.collect::<anyhow::Result<Vec<Arc<Plane>>>>()?;
        let (sender, incoming) = channel();
        prepare_ahead(planes.iter().cloned().enumerate().collect(), sender.clone());
        Ok(Self {
            space: Space::new(&library.positions())?,
            prepared: vec![None; planes.len()],
            incoming,
            sender,
            player: Player::new(library.textures.len()),
            n_opened: library.textures.len(),
            added: Vec::new(),
            planes,
            library,
            authored: None,
            spectra: Spectra { frequencies: drawn_frequencies(rate_hz), ..Spectra::default() },
            hand: None,
            scope: ScopeBuffer::new(48_000.0, rate_hz),
            space_rate_hz: rate_hz,
            rate_hz,
        })
    }

    /// The library with the textures that joined it: what a file of it holds.
    pub fn library(&self) -> &Library {
        &self.library
    }

    /// The textures of the library, then those that joined it.
    pub fn textures(&self) -> &[TextureEntry] {
        &self.library.textures
    }

    /// Where they lie.
    pub fn space(&self) -> &Space {
        &self.space
    }

    /// In words, where the positions come from.
    pub fn label_source(&self) -> &'static str {
        match self.library.label_source() {
            Some(source) => source.label(),
            None if self.space.sites().is_empty() => strings::NO_SOURCE,
            None => strings::MIXED_SOURCES,
        }
    }

    /// The blend at the point.
    pub fn authored(&self) -> Option<&Authored> {
        self.authored.as_ref()
    }

    /// The place of a texture among the parents, largest weight first.
    pub fn parent_rank(&self, texture: usize) -> Option<usize> {
        self.authored.as_ref()?.parents.iter().position(|(t, _)| *t == texture)
    }

    /// The weight of a texture in the blend.
    pub fn parent_weight(&self, texture: usize) -> Option<f64> {
        self.authored.as_ref()?.parents.iter().find(|(t, _)| *t == texture).map(|(_, w)| *w)
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

    /// Follows the project: takes in its textures, finds the parents, and tells the output.
    pub fn follow(&mut self, project: &Project, ctx: &egui::Context) {
        let is_same = |(a, b): (&Arc<TextureEntry>, &Arc<TextureEntry>)| Arc::ptr_eq(a, b);
        let n_same = self.added.iter().zip(&project.added).take_while(|pair| is_same(*pair)).count();
        if n_same < self.added.len() || n_same < project.added.len() {
            self.take_added(&project.added, n_same);
        }
        let wanted = (project.point, project.mode, project.solo);
        if self.player.wanted != Some(wanted) {
            self.authored = match project.solo {
                Some(texture) => Some(Authored {
                    location: Location { at: project.point, clamped: false, corners: Vec::new() },
                    parents: vec![(texture, 1.0)],
                    mode: project.mode,
                }),
                None => author(&self.space, project.point, project.mode),
            };
            self.player.wanted = Some(wanted);
            self.player.mix_is_new = true;
            self.follow_rate(project.solo, ctx);
        }
        match &self.authored {
            Some(authored) => self.player.send_mix(authored, &self.prepared, self.rate_hz),
            None => self.player.send_silence(),
        }
    }

    /// Replaces the textures after the first `n_same` that joined by those of the project.
    fn take_added(&mut self, added: &[Arc<TextureEntry>], n_same: usize) {
        let kept = self.n_opened + n_same;
        self.library.textures.truncate(kept);
        self.planes.truncate(kept);
        self.prepared.truncate(kept);
        self.added = added.to_vec();
        if self.library.label_sources().is_empty() {
            // Those that bring the first places bring the rate of the space too.
            let all = self.library.textures.iter().chain(added[n_same..].iter().map(|entry| &**entry));
            self.space_rate_hz = rate_of_space(all).0;
        }
        for entry in &added[n_same..] {
            let mut entry = TextureEntry::clone(entry);
            let plane = plane_of(&entry, Hertz(self.space_rate_hz)).unwrap_or_else(|error| {
                // Not to be blended then, but still to be heard alone.
                self.player.message = Some(format!("{error:#}"));
                entry.place = None;
                Plane::new(&entry.model)
            });
            self.planes.push(Arc::new(plane));
            self.prepared.push(None);
            self.library.textures.push(entry);
        }
        let fresh = self.planes.iter().cloned().enumerate().skip(kept).collect();
        prepare_ahead(fresh, self.sender.clone());
        self.player.keep(kept, self.planes.len());
        match Space::new(&self.library.positions()) {
            Ok(space) => self.space = space,
            Err(error) => self.player.message = Some(error.to_string()),
        }
        self.player.wanted = None;
    }

    /// What is heard alone may have another rate than the space: then the output is opened again, at that rate.
    fn follow_rate(&mut self, solo: Option<usize>, ctx: &egui::Context) {
        let alone = solo.map(|texture| &self.library.textures[texture]).filter(|t| t.place.is_none());
        let rate_hz = alone.map_or(self.space_rate_hz, |texture| texture.model.rate().0);
        if rate_hz != self.rate_hz {
            self.rate_hz = rate_hz;
            self.spectra = Spectra { frequencies: drawn_frequencies(rate_hz), ..Spectra::default() };
            if let Some(id) = self.player.output_id.clone() {
                self.open_output(OutputChoice::Id(id), ctx);
            }
        }
    }

    /// Once a frame: takes in what the output says, and works out what is shown. `contact` is what the spectra are
    /// drawn for while nothing touches.
    pub fn update(&mut self, contact: Contact) {
        while let Ok((texture, plane, prepared)) = self.incoming.try_recv() {
            // Undo may have taken it away meanwhile.
            if self.planes.get(texture).is_some_and(|now| Arc::ptr_eq(now, &plane)) {
                self.prepared[texture] = Some(prepared);
            }
        }
        if self.player.collect(&mut self.scope) {
            self.player.set_hand(self.hand);
        }
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
        let Some(authored) = &self.authored else { return };
        let parents: Vec<(&Plane, f64)> =
            authored.parents.iter().map(|(t, w)| (&*self.planes[*t], *w)).collect();
        self.spectra.blend = mixture_psd(&parents, authored.mode, contact, &self.spectra.frequencies);
        self.spectra.parents =
            parents.iter().map(|(plane, _)| plane.at(contact).psd(&self.spectra.frequencies)).collect();
    }

    /// Whether the automatic hand strokes.
    pub fn hand_is_running(&self) -> bool {
        self.hand.is_some()
    }

    /// Starts, changes or stops the automatic hand.
    pub fn set_hand(&mut self, hand: Option<Hand>) {
        if self.hand != hand {
            self.hand = hand;
            self.player.set_hand(hand);
        }
    }

    /// The mouse strokes, or lets go: then the automatic hand goes on, if it was running.
    pub fn mouse(&mut self, report: MouseReport, force_n: f32) {
        self.player.mouse(report, force_n, self.hand);
    }

    /// Silences the output, or sounds again.
    pub fn toggle_mute(&mut self) {
        self.player.toggle_mute();
    }

    /// Whether the output is silenced.
    pub fn is_muted(&self) -> bool {
        self.player.muted
    }

    /// Opens an output in the background; the one that is open closes when the new one is there.
    pub fn open_output(&mut self, choice: OutputChoice, ctx: &egui::Context) {
        self.player.open(choice, self.rate_hz as f32, ctx.clone());
    }

    /// Ends the latched silence of the limiter.
    pub fn reset_limiter(&mut self) {
        self.player.reset_limiter();
    }

    /// The outputs that can be chosen, as far as they are known yet.
    pub fn outputs(&self) -> &[OutputInfo] {
        &self.player.outputs
    }

    /// Looks for outputs in the background.
    pub fn list_outputs(&mut self, ctx: &egui::Context) {
        self.player.list_outputs(ctx.clone());
    }

    /// Identity of the output that is open.
    pub fn output_id(&self) -> Option<&str> {
        self.player.output_id.as_deref()
    }

    /// Name of the output that is open.
    pub fn output_name(&self) -> Option<&str> {
        let id = self.output_id()?;
        Some(self.outputs().iter().find(|o| o.id == id).map_or(id, |o| o.name.as_str()))
    }

    /// Whether an output is being opened.
    pub fn is_opening(&self) -> bool {
        self.player.is_opening()
    }

    /// What is wrong with the output, if anything is.
    pub fn output_message(&self) -> Option<&str> {
        self.player.message.as_deref()
    }

    /// How the output is doing.
    pub fn status(&self) -> Option<&Status> {
        self.player.status.as_ref()
    }

    /// Where the tip is, as the output has it.
    pub fn touch(&self) -> Touch {
        self.player.status.map_or(Touch::default(), |s| s.touch)
    }

    /// From a movement to the output, in ms, as far as it is known.
    pub fn latency_ms(&self) -> Option<f64> {
        self.player.latency_ms()
    }

    /// Whether the limiter has bent samples within the last half second.
    pub fn is_limiting(&self) -> bool {
        self.player.limited_at.is_some_and(|t: Instant| t.elapsed().as_secs_f32() < 0.5)
    }
}

/// The rate of the textures in the space, which is the highest of them: voices of different rates cannot be mixed. Where
/// none has a place, that of the first.
fn rate_of_space<'a, I: Iterator<Item = &'a TextureEntry> + Clone>(textures: I) -> Hertz {
    let first = textures.clone().next().map(|t| t.model.rate());
    let placed = textures.filter(|t| t.place.is_some()).map(|t| &t.model);
    highest_rate(placed).or(first).unwrap_or(Hertz(1000.0))
}

/// The plane of a texture: at the rate of the space where it has a place there, else at its own, since it is heard alone.
fn plane_of(texture: &TextureEntry, rate_of_space: Hertz) -> anyhow::Result<Plane> {
    if texture.place.is_none() {
        return Ok(Plane::new(&texture.model));
    }
    let converted = at_rate(&texture.model, rate_of_space)
        .with_context(|| format!("\"{}\" cannot be mixed with textures of {rate_of_space}", texture.id))?;
    Ok(Plane::new(&converted.model))
}

/// Where spectra of a model are drawn: beyond half its rate it only repeats itself.
fn drawn_frequencies(rate_hz: f64) -> Vec<Hertz> {
    let (low, high) = (BAND_HZ.0, BAND_HZ.1.min(0.4995 * rate_hz));
    let frequency = |i: usize| low * (high / low).powf(i as f64 / (N_FREQUENCIES - 1) as f64);
    (0..N_FREQUENCIES).map(|i| Hertz(frequency(i))).collect()
}

/// Prepares textures in a thread of its own, which ends with them or with the session.
fn prepare_ahead(planes: Vec<(usize, Arc<Plane>)>, sender: Sender<Ahead>) {
    if planes.is_empty() {
        return;
    }
    std::thread::spawn(move || {
        for (texture, plane) in planes {
            let prepared = plane.prepare();
            if sender.send((texture, plane, prepared)).is_err() {
                return;
            }
        }
    });
}
