//! Monitoring of an output during playback: lost connection, missing requests for samples, attenuation by the thermal
//! limiter.

use std::time::{Duration, Instant};

use anyhow::bail;
use shagreen_device::engine::{Handle, STALL_SECS};
use shagreen_device::status::{LinkState, Status};

use crate::cli::output;
use crate::cli::receiver::Receiver;

/// Longest tolerated time in the stalled state. A receiver that was reset resumes much sooner.
const STALL_PATIENCE: Duration = Duration::from_secs(4);

/// Monitor of an output during playback.
pub(crate) struct Watch {
    /// Name of the output for messages.
    what: String,
    receiver: Option<Receiver>,
    stalled_since: Option<Instant>,
    has_told_stall: bool,
    /// Lowest gain of the thermal limiter so far, 0..1.
    heat_gain: f32,
}

impl Watch {
    /// Monitors output `id`, and its receiver if there is one.
    pub(crate) fn new(id: &str, receiver: Option<Receiver>) -> Self {
        let what = receiver.as_ref().map_or_else(|| format!("the output `{id}`"), Receiver::in_words);
        Self { what, receiver, stalled_since: None, has_told_stall: false, heat_gain: 1.0 }
    }

    /// Returns the name of the output for messages.
    pub(crate) fn what(&self) -> &str {
        &self.what
    }

    /// Returns the lowest gain of the thermal limiter so far, 0..1.
    pub(crate) fn heat_gain(&self) -> f32 {
        self.heat_gain
    }

    /// Returns the status of the output. Prints new warnings of its receiver, and a warning at the first stall of the
    /// output.
    ///
    /// # Errors
    /// The output is lost, or has been stalled for longer than [`STALL_PATIENCE`].
    pub(crate) fn look(&mut self, handle: &mut Handle) -> anyhow::Result<Status> {
        let status = handle.status();
        if let Some(receiver) = &mut self.receiver {
            receiver.tell_warnings();
        }
        if status.state == LinkState::Lost {
            return Err(match handle.loss() {
                Some(loss) => anyhow::Error::new(loss.clone()).context(format!("{} was lost", self.what)),
                None => {
                    anyhow::anyhow!("{} was lost; `shagreen devices` lists the available outputs", self.what)
                }
            });
        }
        if let Some(warning) = self.note(&status, Instant::now())? {
            output::warn(&warning);
        }
        Ok(status)
    }

    /// Returns the warning to print now, if any.
    fn note(&mut self, status: &Status, now: Instant) -> anyhow::Result<Option<String>> {
        if status.frames_played > 0 {
            self.heat_gain = self.heat_gain.min(status.heat_gain);
        }
        if status.state != LinkState::Stalled {
            self.stalled_since = None;
            return Ok(None);
        }
        let since = *self.stalled_since.get_or_insert(now);
        if now.saturating_duration_since(since) > STALL_PATIENCE {
            let advice = if self.receiver.is_some() {
                "check its power, its cable and its firmware"
            } else {
                "check the device, or choose another --output: `shagreen devices` lists the outputs"
            };
            // An output counts as stalled later if it has never requested samples, so this is a lower bound.
            let secs = STALL_SECS + STALL_PATIENCE.as_secs_f64();
            bail!("{} has requested no samples for more than {secs:.0} s; {advice}", self.what);
        }
        if std::mem::replace(&mut self.has_told_stall, true) {
            return Ok(None);
        }
        Ok(Some(format!("{} requests no samples; waiting for it", self.what)))
    }
}

#[cfg(test)]
mod tests {
    use super::{Duration, Instant, LinkState, STALL_PATIENCE, Status, Watch};

    #[test]
    fn a_stall_warns_once_and_a_long_stall_is_an_error() {
        let mut watch = Watch::new("x", None);
        let begun = Instant::now();
        let status = |state| Status { state, frames_played: 10, heat_gain: 0.5, ..Status::default() };
        let mut note = |state, secs| watch.note(&status(state), begun + Duration::from_secs_f64(secs));
        assert_eq!(note(LinkState::Running, 0.0).unwrap(), None);
        assert!(note(LinkState::Stalled, 1.0).unwrap().unwrap().contains("`x` requests no samples"));
        assert_eq!(note(LinkState::Stalled, 2.0).unwrap(), None);
        // An output that recovers gets the full time again, without a second warning.
        assert_eq!(note(LinkState::Running, 3.0).unwrap(), None);
        let patience_secs = STALL_PATIENCE.as_secs_f64();
        assert_eq!(note(LinkState::Stalled, 4.0).unwrap(), None);
        assert_eq!(note(LinkState::Stalled, 3.9 + patience_secs).unwrap(), None);
        let error = note(LinkState::Stalled, 4.1 + patience_secs).unwrap_err().to_string();
        assert!(error.contains("`x` has requested no samples for more than 5 s"), "{error}");
        assert_eq!(watch.heat_gain(), 0.5);
    }
}
