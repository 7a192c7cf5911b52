//! What is watched of an output while it plays: that it is there, that it asks for samples, and what its limits do.

use std::time::{Duration, Instant};

use anyhow::bail;
use shagreen_device::engine::{Handle, STALL_SECS};
use shagreen_device::status::{LinkState, Status};

use crate::cli::output;
use crate::cli::receiver::Receiver;

/// How long an output that was called stalled may go on so: a receiver that was reset plays again much sooner.
const STALL_PATIENCE: Duration = Duration::from_secs(4);

/// An output that plays.
pub(crate) struct Watch {
    /// What to call it.
    what: String,
    receiver: Option<Receiver>,
    stalled_since: Option<Instant>,
    has_told_stall: bool,
    /// Lowest gain that kept the coil cool.
    heat_gain: f32,
}

impl Watch {
    /// Watches output `id`, and the receiver on it where there is one.
    pub(crate) fn new(id: &str, receiver: Option<Receiver>) -> Self {
        let what = receiver.as_ref().map_or_else(|| format!("the output `{id}`"), Receiver::in_words);
        Self { what, receiver, stalled_since: None, has_told_stall: false, heat_gain: 1.0 }
    }

    /// What to call the output.
    pub(crate) fn what(&self) -> &str {
        &self.what
    }

    /// Lowest gain by which the drive was turned down to keep the coil cool, 0..1.
    pub(crate) fn heat_gain(&self) -> f32 {
        self.heat_gain
    }

    /// How the output is doing; says what its receiver warns of, and once that it has stalled.
    ///
    /// # Errors
    /// It is lost, or has asked for nothing for too long.
    pub(crate) fn look(&mut self, handle: &mut Handle) -> anyhow::Result<Status> {
        let status = handle.status();
        if let Some(receiver) = &mut self.receiver {
            receiver.tell_warnings();
        }
        if status.state == LinkState::Lost {
            return Err(match handle.loss() {
                Some(loss) => anyhow::Error::new(loss.clone()).context(format!("{} was lost", self.what)),
                None => anyhow::anyhow!("{} was lost; look for it with `shagreen devices`", self.what),
            });
        }
        if let Some(warning) = self.note(&status, Instant::now())? {
            output::warn(&warning);
        }
        Ok(status)
    }

    /// What there is to say now.
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
                "look at its power, its cable and its firmware"
            } else {
                "look at it, or choose another with `shagreen devices`"
            };
            let secs = STALL_SECS + STALL_PATIENCE.as_secs_f64();
            bail!("{} has asked for no samples for {secs:.0} s; {advice}", self.what);
        }
        if std::mem::replace(&mut self.has_told_stall, true) {
            return Ok(None);
        }
        Ok(Some(format!("{} asks for no samples; it is waited for", self.what)))
    }
}

#[cfg(test)]
mod tests {
    use super::{Duration, Instant, LinkState, STALL_PATIENCE, Status, Watch};

    #[test]
    fn a_stall_is_told_once_and_a_long_one_ends_it() {
        let mut watch = Watch::new("x", None);
        let begun = Instant::now();
        let status = |state| Status { state, frames_played: 10, heat_gain: 0.5, ..Status::default() };
        let mut note = |state, secs| watch.note(&status(state), begun + Duration::from_secs_f64(secs));
        assert_eq!(note(LinkState::Running, 0.0).unwrap(), None);
        assert!(note(LinkState::Stalled, 1.0).unwrap().unwrap().contains("`x` asks for no samples"));
        assert_eq!(note(LinkState::Stalled, 2.0).unwrap(), None);
        // One that comes back has its time anew, and is not told again.
        assert_eq!(note(LinkState::Running, 3.0).unwrap(), None);
        let patience_secs = STALL_PATIENCE.as_secs_f64();
        assert_eq!(note(LinkState::Stalled, 4.0).unwrap(), None);
        assert_eq!(note(LinkState::Stalled, 3.9 + patience_secs).unwrap(), None);
        let error = note(LinkState::Stalled, 4.1 + patience_secs).unwrap_err().to_string();
        assert!(error.contains("`x` has asked for no samples for 5 s"), "{error}");
        assert_eq!(watch.heat_gain(), 0.5);
    }
}
