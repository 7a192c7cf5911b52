//! What is open and what sounds: the library, its space, the authored blend, and the output that plays it.
//!
//! Nothing here is undone; everything here follows from the project, the library and the hands of the user.

mod player;

use std::time::Instant;

use shagreen_core::blend::{Authored, author, mixture_psd};
use shagreen_core::plane::Plane;
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

pub use self::player::OutputChoice;

use self::player::Player;

/// Frequencies at which spectra are drawn.
const N_FREQUENCIES: usize = 160;

/// The spectra at the contact of the moment.
#[derive(Clone, Debug, Default)]
pub struct Spectra {
    /// Where they are evaluated, evenly spaced on a logarithmic axis.
    pub frequencies: Vec<Hertz>,
    /// Name and density of each parent, in the order of the weights.
    pub parents: Vec<(String, Vec<f64>)>,
    /// Density of the blend.
    pub blend: Vec<f64>,
}

/// Everything that is not undone.
pub struct Session {
    library: Library,
    planes: Vec<Plane>,
    space: Space,
    authored: Option<Authored>,
    spectra: Spectra,
    player: Player,
    hand: Option<Hand>,
    scope: ScopeBuffer,
}

impl Session {
    /// A session with a library; no output is open yet.
    ///
    /// # Errors
    /// The positions cannot be triangulated.
    pub fn new(library: Library) -> anyhow::Result<Self> {
        let planes = library.textures.iter().map(|t| Plane::new(&t.model)).collect();
        let (low, high) = (10.0_f64, 500.0_f64);
        let frequency = |i: usize| low * (high / low).powf(i as f64 / (N_FREQUENCIES - 1) as f64);
        let frequencies = (0..N_FREQUENCIES).map(|i| Hertz(frequency(i).min(499.0))).collect();
        Ok(Self {
            space: Space::new(&library.positions())?,
            planes,
            player: Player::new(library.textures.len()),
            library,
            authored: None,
            spectra: Spectra { frequencies, ..Spectra::default() },
            hand: None,
            scope: ScopeBuffer::new(48_000.0),
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
        self.library.label_source().map_or("not stated", shagreen_core::space::LabelSource::label)
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
            self.player.send_mix(authored, &self.planes);
        }
    }

    /// Once a frame: takes in what the output says, and works out what is shown. `contact` is what the spectra are
    /// drawn for while nothing touches.
    pub fn update(&mut self, contact: Contact) {
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
        self.spectra.parents = authored
            .parents
            .iter()
            .map(|(t, _)| {
                let density = self.planes[*t].at(contact).psd(&self.spectra.frequencies);
                (self.library.textures[*t].name.clone(), density)
            })
            .collect();
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
        let rate_hz = self.library.textures.first().map_or(1000.0, |t| t.model.rate().0 as f32);
        self.player.open(choice, rate_hz, ctx.clone());
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
