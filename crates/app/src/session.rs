//! What is open and what sounds: the library, its space, the authored blend, and the output that plays it.
//!
//! Nothing here is undone; everything here follows from the project, the library and the hands of the user.

mod player;

use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use std::time::Instant;

use anyhow::Context as _;
use shagreen_core::blend::{Authored, author, mixture_psd};
use shagreen_core::plane::{Plane, Prepared};
use shagreen_core::rate::{at_rate, highest_rate};
use shagreen_core::space::Space;
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
    planes: Arc<[Plane]>,
    /// What the output takes, worked out ahead by a worker: a drag into textures not yet heard must not wait for it.
    prepared: Vec<Option<Prepared>>,
    incoming: Receiver<(usize, Prepared)>,
    space: Space,
    authored: Option<Authored>,
    spectra: Spectra,
    player: Player,
    hand: Option<Hand>,
    scope: ScopeBuffer,
    rate_hz: f64,
}

impl Session {
    /// A session with a library; no output is open yet.
    ///
    /// # Errors
    /// The positions cannot be triangulated, or a texture cannot be had at the highest rate of them.
    pub fn new(library: Library) -> anyhow::Result<Self> {
        let rate = highest_rate(library.textures.iter().map(|t| &t.model)).unwrap_or(Hertz(1000.0));
        let rate_hz = rate.0;
        let planes =
            library.textures.iter().map(|t| plane_at(t, rate)).collect::<anyhow::Result<Arc<[Plane]>>>()?;
        // Beyond half the rate a model only repeats itself.
        let (low, high) = (BAND_HZ.0, BAND_HZ.1.min(0.4995 * rate_hz));
        let frequency = |i: usize| low * (high / low).powf(i as f64 / (N_FREQUENCIES - 1) as f64);
        let frequencies = (0..N_FREQUENCIES).map(|i| Hertz(frequency(i))).collect();
        Ok(Self {
            space: Space::new(&library.positions())?,
            prepared: vec![None; planes.len()],
            incoming: prepare_ahead(Arc::clone(&planes)),
            planes,
            player: Player::new(library.textures.len()),
            library,
            authored: None,
            spectra: Spectra { frequencies, ..Spectra::default() },
            hand: None,
            scope: ScopeBuffer::new(48_000.0, rate_hz),
            rate_hz,
        })
    }

    /// The textures of the library.
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

    /// Follows the project: finds the parents and tells the output.
    pub fn follow(&mut self, project: &Project) {
        let unchanged = |a: &Authored| a.mode == project.mode && self.player.point == Some(project.point);
        if self.authored.as_ref().is_none_or(|a| !unchanged(a)) {
            self.authored = author(&self.space, project.point, project.mode);
            self.player.point = Some(project.point);
            self.player.mix_is_new = true;
        }
        if let Some(authored) = &self.authored {
            self.player.send_mix(authored, &self.planes, &self.prepared);
        }
    }

    /// Once a frame: takes in what the output says, and works out what is shown. `contact` is what the spectra are
    /// drawn for while nothing touches.
    pub fn update(&mut self, contact: Contact) {
        while let Ok((texture, prepared)) = self.incoming.try_recv() {
            self.prepared[texture] = Some(prepared);
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
            authored.parents.iter().map(|(t, w)| (&self.planes[*t], *w)).collect();
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

/// The plane of a texture at the rate of the whole library: voices of different rates cannot be mixed.
fn plane_at(texture: &TextureEntry, rate: Hertz) -> anyhow::Result<Plane> {
    let converted = at_rate(&texture.model, rate)
        .with_context(|| format!("\"{}\" cannot be mixed with textures of {rate}", texture.id))?;
    Ok(Plane::new(&converted.model))
}

/// Prepares all textures in a thread of its own, which ends with them or with the session.
fn prepare_ahead(planes: Arc<[Plane]>) -> Receiver<(usize, Prepared)> {
    let (sender, receiver) = channel();
    std::thread::spawn(move || {
        for (texture, plane) in planes.iter().enumerate() {
            if sender.send((texture, plane.prepare())).is_err() {
                return;
            }
        }
    });
    receiver
}
