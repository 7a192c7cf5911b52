//! An open output, which plays until it is dropped.

use std::fmt::Debug;
use std::sync::Arc;
use std::time::{Duration, Instant};

#[cfg(doc)]
use crate::engine::Handle;
use crate::error::{DeviceError, DeviceErrorKind};
use crate::haptic_pen::sender::{HapticMonitor, HapticReading};
use crate::link::Shared;
use crate::output_claim::{Claim, ClaimGuard};
use crate::status::Status;

/// Interval at which a drain checks whether the device is lost.
const DRAIN_POLL: Duration = Duration::from_millis(20);

/// An open output. It plays until it is dropped.
#[derive(Debug)]
pub struct Running {
    facts: RunningFacts,
    shared: Arc<Shared>,
    haptic: Option<Arc<HapticMonitor>>,
    #[expect(dead_code, reason = "held to be dropped")]
    device: Box<dyn Debug + Send>,
    /// Released last, when the device is closed.
    #[expect(dead_code, reason = "held to be dropped")]
    claim: Option<ClaimGuard>,
}

/// Properties of an open output.
#[derive(Clone, Debug)]
pub(crate) struct RunningFacts {
    /// Id of the output.
    pub(crate) id: String,
    /// Sample rate of the device, in Hz.
    pub(crate) rate_hz: u32,
    /// Number of channels of the device.
    pub(crate) channels: u16,
    /// Frames in a block, if the device states them.
    pub(crate) buffer_frames: Option<u32>,
    /// Delay of the renderer, in seconds.
    pub(crate) engine_latency_secs: f64,
    /// Delay of the device in seconds, used if its status does not state one.
    pub(crate) device_latency_secs: f64,
}

impl Running {
    /// An open output that holds `device` until it is dropped.
    pub(crate) fn new(facts: RunningFacts, shared: Arc<Shared>, device: impl Debug + Send + 'static) -> Self {
        Self { facts, shared, haptic: None, device: Box::new(device), claim: None }
    }

    /// Attaches the reading of a haptic pen.
    pub(crate) fn with_haptic(self, monitor: Arc<HapticMonitor>) -> Self {
        Self { haptic: Some(monitor), ..self }
    }

    /// Attaches a claim, which the output holds until it is closed.
    pub(crate) fn claimed_by(self, claim: Option<Claim>) -> Result<Self, DeviceError> {
        let guard = claim.map(|claim| claim.guard(Arc::clone(&self.shared))).transpose();
        let no_thread = |error| {
            DeviceError::new(
                DeviceErrorKind::Backend,
                format!("the output cannot be opened: the system cannot start a thread ({error})"),
            )
        };
        Ok(Self { claim: guard.map_err(no_thread)?, ..self })
    }

    /// State that the device and the engine share.
    #[cfg(test)]
    pub(crate) fn shared(&self) -> &Shared {
        &self.shared
    }

    /// Waits until all samples rendered so far have been played, at most for `patience`, so that closing the output
    /// does not cut them off. Returns whether they have been played. If the device states no latency, two blocks are
    /// assumed.
    ///
    /// Before this call, wait until [`Handle::status`] shows that all wanted samples are rendered.
    pub fn drain(&self, patience: Duration) -> bool {
        let begun = Instant::now();
        let least = Duration::from_secs_f64(self.facts.device_latency_secs);
        let heard_by = self.shared.heard_by().max(begun + least);
        loop {
            let now = Instant::now();
            if self.shared.is_lost() {
                return false;
            }
            let left = heard_by.saturating_duration_since(now);
            let left_of_patience = patience.saturating_sub(now.saturating_duration_since(begun));
            if left.is_zero() || left_of_patience.is_zero() {
                return left.is_zero();
            }
            std::thread::sleep(left.min(left_of_patience).min(DRAIN_POLL));
        }
    }

    /// What a haptic pen plays instead of the signal; `None` for an output that plays the signal itself.
    pub fn haptic_reading(&self) -> Option<HapticReading> {
        Some(self.haptic.as_ref()?.reading())
    }

    /// Id of the output.
    pub fn id(&self) -> &str {
        &self.facts.id
    }

    /// Sample rate of the device, in Hz.
    pub fn rate_hz(&self) -> u32 {
        self.facts.rate_hz
    }

    /// Number of channels of the device.
    pub fn channels(&self) -> u16 {
        self.facts.channels
    }

    /// Frames in a block, if the device states them.
    pub fn buffer_frames(&self) -> Option<u32> {
        self.facts.buffer_frames
    }

    /// Latency from a change of contact to the actuator's terminals, in seconds: the renderer's delay plus the device's
    /// stated latency, or an estimate from its block size if it states none.
    pub fn latency_secs(&self, status: &Status) -> f64 {
        let told_secs = f64::from(status.device_latency_secs);
        self.facts.engine_latency_secs
            + if told_secs > 0.0 { told_secs } else { self.facts.device_latency_secs }
    }
}
