//! Plays a sweep on an output and records it with a sensor.

use anyhow::Context as _;
use shagreen_core::actuator::calibration::Sweep;
use shagreen_core::actuator::{Actuator, Drive, Limits, limited_drive};
use shagreen_core::units::Hertz;
use shagreen_device::engine::ChannelMask;
use shagreen_device::measure::{Listener, SILENCE_SECS, measure};

use crate::cli::calibrate_recording::Recorded;
use crate::cli::calibrate_sweep::by_option;
use crate::cli::output;
use crate::cli::progress::{Progress, in_ms};

/// Plays the sweep on these channels of output `id` and returns the acceleration that the sensor measures. The limits
/// of a known actuator apply.
pub(crate) fn record_live(
    (id, channels): (&str, ChannelMask),
    listener: &Listener,
    sweep: &Sweep,
    actuator: Option<&Actuator>,
    drive: Drive,
) -> anyhow::Result<Recorded> {
    let limits = actuator.map_or(Limits::default(), Actuator::limits_in_volts);
    let driven = (limited_drive(&limits, drive), channels);
    let secs = sweep.seconds + 2.0 * sweep.silence_secs + 2.0 * SILENCE_SECS;
    let progress = Progress::new("measuring the response", in_ms(secs));
    let drive_at = |rate_hz: f64| sweep.drive_samples(rate_hz).map_err(|error| by_option(&error));
    let heard = measure(id, driven, listener, &drive_at, &mut |share| {
        progress.set_secs(share * secs);
        true
    });
    progress.finish();
    let heard = heard.context("cannot calibrate")?;
    if heard.was_limited() {
        output::warn("the actuator's limits attenuated the sweep: measure with a lower --amplitude");
    }
    if heard.status.underruns > 0 {
        output::warn(&format!(
            "the output had {} dropouts (underruns) during the measurement: close other programs and measure again",
            heard.status.underruns
        ));
    }
    let channel = match listener {
        Listener::Input { channel_idx, .. } => channel_idx + 1,
        Listener::Serial { .. } => 1,
    };
    Ok(Recorded { acceleration_mps2: heard.mps2, rate: Hertz(heard.rate_hz), channel })
}
