//! The output and its actuator, the mouse and the pen, and their latencies.

use std::time::Instant;

use shagreen_core::units::Hertz;
use shagreen_device::audio_input::InputInfo;
use shagreen_device::haptic_pen;
use shagreen_device::haptic_pen::sender::HapticReading;
use shagreen_device::output::{NULL_ID, OutputInfo};
use shagreen_device::serial::ID_PREFIX;
use shagreen_device::status::Status;
use shagreen_device::stylus::StylusInfo;
use shagreen_device::touch::Touch;

use super::{LATENCY_HISTORY_SECS, OutputChoice, PenFacts, Session};
use crate::state::mouse_report::MouseReport;
use crate::state::rig::Rig;

impl Session {
    /// Passes a mouse report to the recorder and the output, with a force in N. A pressure reported by the window
    /// system overrides the force. When the mouse is released, a running automatic stroke continues.
    pub fn mouse(&mut self, report: MouseReport, force_n: f32) {
        let force_n =
            report.pressure.map_or(f64::from(force_n), |p| self.sound.rig.pressure_map.force_n(p, true));
        self.record_mouse(report, force_n);
        self.sound.player.mouse(report, force_n);
    }

    /// Mutes or unmutes the output.
    pub fn toggle_mute(&mut self) {
        self.sound.player.toggle_mute();
    }

    /// Whether the output is muted.
    pub fn is_muted(&self) -> bool {
        self.sound.player.muted
    }

    /// Opens an output in the background. The present output closes when the new one is open.
    pub fn open_output(&mut self, choice: OutputChoice, ctx: &egui::Context) {
        self.sound.player.choice = Some(choice);
        self.sound.player.is_let_go = false;
        self.open_output_again(ctx);
    }

    /// Output that was asked for, if another Shagreen plays on it.
    pub fn claimed_output(&self) -> Option<&str> {
        self.sound.player.claimed.as_deref()
    }

    /// Takes over the output on which another Shagreen plays.
    pub fn take_over_output(&mut self, ctx: &egui::Context) {
        if let Some(id) = self.sound.player.claimed.take() {
            self.sound.player.choice = Some(OutputChoice::Id(id));
            self.sound.player.is_let_go = false;
            self.begin_to_open(true, ctx);
        }
    }

    /// Device setup: output, actuator and pen.
    pub fn rig(&self) -> &Rig {
        &self.sound.rig
    }

    /// Changes the device setup, and reopens the output if the change affects it.
    pub fn set_rig(&mut self, rig: Rig, ctx: &egui::Context) {
        let opens_again = self.sound.rig.opens_unlike(&rig);
        self.sound.rig = rig;
        self.hand.pen.follow(&self.sound.rig, &mut self.sound.player.pen_live, ctx);
        if opens_again {
            self.open_output_again(ctx);
        }
    }

    /// Closes the output and frees its device. [`Session::take_output_back`] opens it again.
    pub fn let_go_of_output(&mut self) {
        self.sound.player.is_let_go = true;
        self.sound.player.silence();
    }

    /// Whether no output is open or being opened.
    pub fn is_output_released(&self) -> bool {
        self.sound.player.is_released()
    }

    /// Reopens the output that [`Session::let_go_of_output`] closed.
    pub fn take_output_back(&mut self, ctx: &egui::Context) {
        if std::mem::take(&mut self.sound.player.is_let_go) {
            self.open_output_again(ctx);
        }
    }

    /// Opens the last requested output with the present device setup and sample rate, unless it has been let go of.
    pub(super) fn open_output_again(&mut self, ctx: &egui::Context) {
        self.begin_to_open(false, ctx);
    }

    fn begin_to_open(&mut self, take_over: bool, ctx: &egui::Context) {
        let Some(choice) = self.sound.player.choice.clone().filter(|_| !self.sound.player.is_let_go) else {
            return;
        };
        match self.sound.rig.drive() {
            Ok(drive) => {
                self.sound.player.open(
                    choice,
                    &self.sound.rig,
                    (drive, take_over),
                    self.sound.rate_hz as f32,
                    ctx.clone(),
                );
            }
            Err(error) => {
                // The open output drives another actuator.
                self.sound.player.silence();
                self.say_of_output(error.to_string());
            }
        }
    }

    /// Known audio inputs; empty until they are listed.
    pub fn inputs(&self) -> &[InputInfo] {
        &self.sound.player.inputs
    }

    /// Lists audio inputs in the background.
    pub fn list_inputs(&mut self, ctx: &egui::Context) {
        self.sound.player.list_inputs(ctx.clone());
    }

    /// Whether the open output renders friction: the profile of the actuator has a friction display, and the output is an
    /// audio output with the channel of the display.
    pub fn renders_friction(&self) -> bool {
        let is_other =
            |id: &str| [ID_PREFIX, haptic_pen::ID_PREFIX].iter().any(|prefix| id.starts_with(prefix));
        let is_audio = self.output_id().is_some_and(|id| id != NULL_ID && !is_other(id));
        let Some((_, n_channels, _)) = self.stream().filter(|_| is_audio) else { return false };
        self.rig().channels(false).1.is_some_and(|friction| friction.channel_idx < usize::from(n_channels))
    }

    /// What a haptic pen plays instead of the signal; `None` for an output that plays the signal itself.
    pub fn haptic_reading(&self) -> Option<HapticReading> {
        self.sound.player.haptic_reading()
    }

    /// Sample rate in Hz, number of channels, and block size in frames of the open output.
    pub fn stream(&self) -> Option<(u32, u16, Option<u32>)> {
        self.sound.player.stream()
    }

    /// Plays a test tone instead of the texture, at a frequency in Hz and an amplitude in m/s².
    pub fn play_tone(&mut self, frequency_hz: f64, amplitude_mps2: f64) {
        self.sound.player.play_tone(frequency_hz, amplitude_mps2);
    }

    /// Plays samples in m/s² at a sample rate once, instead of the texture.
    pub fn play_samples(&mut self, samples_mps2: &[f64], rate: Hertz) {
        self.sound.player.play_samples(samples_mps2, rate);
    }

    /// Stops the tone or the samples.
    pub fn stop_tone(&mut self) {
        self.sound.player.stop_tone();
    }

    /// Recent latencies, oldest first: time relative to now (negative), latency of strokes and latency of taps, all in
    /// seconds.
    pub fn latencies(&self) -> Vec<(f64, f32, f32)> {
        let before = |time: &Instant| -time.elapsed().as_secs_f64();
        self.sound.latencies.iter().map(|(time, stroke, tap)| (before(time), *stroke, *tap)).collect()
    }

    pub(super) fn note_latency(&mut self, n_touches_before: u64) {
        let is_old = |(time, ..): &(Instant, f32, f32)| time.elapsed().as_secs_f64() > LATENCY_HISTORY_SECS;
        while self.sound.latencies.front().is_some_and(is_old) {
            self.sound.latencies.pop_front();
        }
        if let Some(latency) = self.status().map(|status| status.latency)
            && latency.n_touches > n_touches_before
        {
            self.sound.latencies.push_back((Instant::now(), latency.stroke_secs, latency.tap_secs));
        }
    }

    /// Known pens; empty until they are listed.
    pub fn pens(&self) -> &[StylusInfo] {
        &self.hand.pen.pens
    }

    /// Lists pens in the background.
    pub fn list_pens(&mut self, ctx: &egui::Context) {
        self.hand.pen.list(ctx.clone());
    }

    /// Properties that the pen reports, while it is read.
    pub fn pen_facts(&self) -> Option<&PenFacts> {
        self.hand.pen.facts.as_ref()
    }

    /// Reason why the pen is not read.
    pub fn pen_message(&self) -> Option<&str> {
        self.hand.pen.message.as_deref()
    }

    /// Present pressure of the pen, 0..1, while it touches.
    pub fn pen_pressure(&self) -> Option<f64> {
        self.hand.pen.moments.back().filter(|m| m.report.touching())?.report.pressure
    }

    /// Resets the limiter, which silences the output after a fault.
    pub fn reset_limiter(&mut self) {
        self.sound.player.reset_limiter();
    }

    /// Known outputs; empty until they are listed.
    pub fn outputs(&self) -> &[OutputInfo] {
        &self.sound.player.outputs
    }

    /// Lists outputs in the background.
    pub fn list_outputs(&mut self, ctx: &egui::Context) {
        self.sound.player.list_outputs(ctx.clone());
    }

    /// Id of the open output.
    pub fn output_id(&self) -> Option<&str> {
        self.sound.player.output_id.as_deref()
    }

    /// Name of the open output, or its id if it is not listed.
    pub fn output_name(&self) -> Option<&str> {
        let id = self.output_id()?;
        Some(self.outputs().iter().find(|o| o.id == id).map_or(id, |o| o.name.as_str()))
    }

    /// Whether an output is being opened.
    pub fn is_opening(&self) -> bool {
        self.sound.player.is_opening()
    }

    /// Message about the output: an error, or a warning that another one plays.
    pub fn output_message(&self) -> Option<&str> {
        self.sound.player.message.as_deref()
    }

    /// Status of the open output.
    pub fn status(&self) -> Option<&Status> {
        self.sound.player.status.as_ref()
    }

    /// Tip position, tip speed and normal force as the output renders them.
    pub fn touch(&self) -> Touch {
        self.sound.player.status.map_or(Touch::default(), |s| s.touch)
    }

    /// Latency from a movement to the output signal in ms, if known.
    pub fn latency_ms(&self) -> Option<f64> {
        self.sound.player.latency_ms()
    }

    /// Whether the limiter has changed samples within the last half second.
    pub fn is_limiting(&self) -> bool {
        self.sound.player.limited_at.is_some_and(|t: Instant| t.elapsed().as_secs_f32() < 0.5)
    }
}
