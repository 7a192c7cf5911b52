//! Measurement of the actuator: a worker plays a sweep on the output, records the acceleration and fits the response.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError};

use anyhow::Context as _;
use shagreen_core::actuator::calibration::{Sweep, calibrate};
use shagreen_core::actuator::{Actuator, Drive, Limits, limited_drive};
use shagreen_core::units::{Hertz, Kilograms, Volts};
use shagreen_device::audio_input::InputInfo;
use shagreen_device::measure::{Listener, measure};
use shagreen_device::serial::ID_PREFIX;
use shagreen_formats::measured_profile::{CalibrationConditions, measured_profile};

use crate::state::background::in_background;
use crate::state::rig::Rig;
use crate::strings::devices as strings;

/// Settings of a measurement.
#[derive(Clone, Debug)]
pub(super) struct Question {
    /// Id of the input with the accelerometer.
    pub(super) input: Option<String>,
    /// Acceleration of a sample of 1.0, in m/s².
    pub(super) sensitivity_mps2: f64,
    /// Mass that the actuator moves, in g.
    pub(super) load_g: f64,
    /// Peak of the sweep, as a share of full scale.
    pub(super) amplitude: f64,
}

impl Default for Question {
    fn default() -> Self {
        Self { input: None, sensitivity_mps2: 98.1, load_g: 40.0, amplitude: 0.25 }
    }
}

/// Result of a measurement.
pub(super) struct Outcome {
    pub(super) actuator: Actuator,
    pub(super) fit_error_db: f64,
    pub(super) warnings: Vec<String>,
}

/// Running measurement.
pub(super) struct Job {
    outcome: Receiver<anyhow::Result<Outcome>>,
    /// Progress in thousandths.
    done: Arc<AtomicU32>,
    goes_on: Arc<AtomicBool>,
}

impl Job {
    /// Starts to measure the actuator on output `id`, which must not be open meanwhile.
    pub(super) fn start(id: String, question: Question, rig: Rig, ctx: egui::Context) -> Self {
        let (done, goes_on) = (Arc::new(AtomicU32::new(0)), Arc::new(AtomicBool::new(true)));
        let (told, still) = (Arc::clone(&done), Arc::clone(&goes_on));
        let outcome = in_background(ctx.clone(), move || {
            let mut go_on = |share: f64| {
                told.store((1000.0 * share) as u32, Ordering::Relaxed);
                ctx.request_repaint();
                still.load(Ordering::Relaxed)
            };
            measured(&id, &question, &rig, &mut go_on)
        });
        Self { outcome, done, goes_on }
    }

    /// Progress, 0 to 1.
    pub(super) fn share(&self) -> f32 {
        self.done.load(Ordering::Relaxed) as f32 / 1000.0
    }

    /// Stops the measurement; the sweep fades out.
    pub(super) fn cancel(&self) {
        self.goes_on.store(false, Ordering::Relaxed);
    }

    /// Result, once the measurement has ended.
    pub(super) fn outcome(&self) -> Option<anyhow::Result<Outcome>> {
        match self.outcome.try_recv() {
            Ok(outcome) => Some(outcome),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Err(anyhow::anyhow!(strings::CALIBRATION_BROKEN))),
        }
    }
}

impl Drop for Job {
    fn drop(&mut self) {
        self.cancel();
    }
}

fn measured(
    id: &str,
    question: &Question,
    rig: &Rig,
    go_on: &mut dyn FnMut(f64) -> bool,
) -> anyhow::Result<Outcome> {
    let input = question.input.clone().context(strings::NO_INPUT)?;
    let sweep = Sweep { amplitude: question.amplitude, ..Sweep::USUAL };
    let drive = Drive::new(Volts(rig.full_scale_volts))?;
    let limits = rig.actuator().map_or(Limits::default(), Actuator::limits_in_volts);
    let (channels, _) = rig.channels(id.starts_with(ID_PREFIX));
    let driven = (limited_drive(&limits, drive), channels);
    let sensitivity_mps2 = question.sensitivity_mps2;
    let listener = Listener::Input { id: input, channel_idx: 0, sensitivity_mps2 };
    let heard = measure(id, driven, &listener, &|rate_hz| sweep.drive_samples(rate_hz), go_on)?;
    let mut warnings = Vec::new();
    if heard.was_limited() {
        warnings.push(strings::CALIBRATION_LIMITED.to_owned());
    }
    if heard.status.underruns > 0 {
        warnings.push(strings::calibration_dropouts(heard.status.underruns));
    }
    let calibration = calibrate(&heard.mps2, Hertz(heard.rate_hz), &sweep, drive)?;
    warnings.extend(calibration.warnings.iter().map(ToString::to_string));
    let fit = calibration.fit?;
    let base = rig.mounted.as_ref().map(|mounted| mounted.profile().clone());
    let how = CalibrationConditions {
        name: strings::calibrated_name(base.as_ref().map(|actuator| actuator.name.as_str())),
        heard: strings::played_on(id),
        load: Some(Kilograms::from_g(question.load_g)),
        drive,
        is_drive_assumed: false,
    };
    let actuator = measured_profile(base, &fit, how);
    Ok(Outcome { actuator, fit_error_db: fit.error_db, warnings })
}

/// Name of an input, or its id if it is not listed.
pub(super) fn name_of(inputs: &[InputInfo], id: &str) -> String {
    inputs.iter().find(|input| input.id == id).map_or(id.to_owned(), |input| input.name.clone())
}
