//! What hands and outputs do: the output and what hangs on it, the mouse and the pen, and how late they are.

use std::time::Instant;

use shagreen_core::units::Hertz;
use shagreen_device::audio_input::InputInfo;
use shagreen_device::output::OutputInfo;
use shagreen_device::status::Status;
use shagreen_device::stylus::StylusInfo;
use shagreen_device::touch::Touch;

use super::{LATENCY_HISTORY_SECS, OutputChoice, PenFacts, Session};
use crate::pad::MouseReport;
use crate::rig::Rig;

impl Session {
    /// The mouse strokes with a force in N, or lets go: then the automatic hand goes on, if it was running. Where the window
    /// system tells a pressure, that is the force.
    pub fn mouse(&mut self, report: MouseReport, force_n: f32) {
        let force_n = report.pressure.map_or(f64::from(force_n), |p| self.rig.pressure_map.force_n(p, true));
        self.record_mouse(report, force_n);
        self.player.mouse(report, force_n);
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
        self.player.choice = Some(choice);
        self.player.is_let_go = false;
        self.open_output_again(ctx);
    }

    /// How the output is opened, what hangs on it, and which pen is held.
    pub fn rig(&self) -> &Rig {
        &self.rig
    }

    /// Takes over another rig; the output is opened again where it depends on what changed.
    pub fn set_rig(&mut self, rig: Rig, ctx: &egui::Context) {
        let opens_again = self.rig.opens_unlike(&rig);
        self.rig = rig;
        self.pen.follow(&self.rig, &mut self.player.pen_live);
        if opens_again {
            self.open_output_again(ctx);
        }
    }

    /// Closes the output for somebody else; [`Session::take_output_back`] opens it again.
    pub fn let_go_of_output(&mut self) {
        self.player.is_let_go = true;
        self.player.silence();
    }

    /// Whether no output is open, nor being opened.
    pub fn is_output_released(&self) -> bool {
        self.player.is_released()
    }

    /// Opens the output again that was let go of.
    pub fn take_output_back(&mut self, ctx: &egui::Context) {
        if std::mem::take(&mut self.player.is_let_go) {
            self.open_output_again(ctx);
        }
    }

    /// Opens the output that was asked for last, as the rig and the rate of the textures are now, unless somebody else has it.
    pub(super) fn open_output_again(&mut self, ctx: &egui::Context) {
        let Some(choice) = self.player.choice.clone().filter(|_| !self.player.is_let_go) else { return };
        match self.rig.drive() {
            Ok(drive) => self.player.open(choice, &self.rig, drive, self.rate_hz as f32, ctx.clone()),
            Err(error) => {
                // What is open drives another actuator.
                self.player.silence();
                self.say(error.to_string());
            }
        }
    }

    /// The inputs that can be listened to, as far as they are known yet.
    pub fn inputs(&self) -> &[InputInfo] {
        &self.player.inputs
    }

    /// Looks for inputs in the background.
    pub fn list_inputs(&mut self, ctx: &egui::Context) {
        self.player.list_inputs(ctx.clone());
    }

    /// Rate in Hz, channels and frames in a block of the open output.
    pub fn stream(&self) -> Option<(u32, u16, Option<u32>)> {
        self.player.stream()
    }

    /// Plays a tone in the place of the texture.
    pub fn play_tone(&mut self, frequency_hz: f64, amplitude_mps2: f64) {
        self.player.play_tone(frequency_hz, amplitude_mps2);
    }

    /// Plays samples in m/s² at a rate in the place of the texture, once.
    pub fn play_samples(&mut self, samples_mps2: &[f64], rate: Hertz) {
        self.player.play_samples(samples_mps2, rate);
    }

    /// Ends the tone or the samples.
    pub fn stop_tone(&mut self) {
        self.player.stop_tone();
    }

    /// The latencies of late: seconds before now, of strokes and of taps in seconds; the oldest first.
    pub fn latencies(&self) -> Vec<(f64, f32, f32)> {
        let before = |time: &Instant| -time.elapsed().as_secs_f64();
        self.latencies.iter().map(|(time, stroke, tap)| (before(time), *stroke, *tap)).collect()
    }

    pub(super) fn note_latency(&mut self, n_touches_before: u64) {
        let is_old = |(time, ..): &(Instant, f32, f32)| time.elapsed().as_secs_f64() > LATENCY_HISTORY_SECS;
        while self.latencies.front().is_some_and(is_old) {
            self.latencies.pop_front();
        }
        if let Some(latency) = self.status().map(|status| status.latency)
            && latency.n_touches > n_touches_before
        {
            self.latencies.push_back((Instant::now(), latency.stroke_secs, latency.tap_secs));
        }
    }

    /// The pens that can be chosen, as far as they are known yet.
    pub fn pens(&self) -> &[StylusInfo] {
        &self.pen.pens
    }

    /// Looks for pens in the background.
    pub fn list_pens(&mut self, ctx: &egui::Context) {
        self.pen.list(ctx.clone());
    }

    /// What the pen has said of itself, while it is read.
    pub fn pen_facts(&self) -> Option<&PenFacts> {
        self.pen.facts.as_ref()
    }

    /// Why the pen is not read.
    pub fn pen_message(&self) -> Option<&str> {
        self.pen.message.as_deref()
    }

    /// Pressure of the pen at the moment, 0..1, while it touches.
    pub fn pen_pressure(&self) -> Option<f64> {
        self.pen.moments.back().filter(|m| m.report.touching())?.report.pressure
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
