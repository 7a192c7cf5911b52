//! Host side of an open serial connection, independent of port and clock: it takes bytes and times and returns frames.
//!
//! The receiver's clock is the master. Samples are rendered only when the last status has room for them. No stale
//! samples therefore wait on the host, and a receiver that was interrupted gets current ones.

use std::time::Duration;

use crate::serial::frame::{Decoder, MAX_WIRE};
use crate::serial::message::{
    Configure, Control, DeviceMessage, DeviceStatus, HostMessage, MAX_SAMPLES, Mode, RunState, from_device,
    write_samples, write_to_device,
};
use crate::serial::write_queue::WriteQueue;

/// Time after which an unacknowledged message is repeated.
const REPEAT: Duration = Duration::from_millis(20);
/// Interval of pings to a silent receiver.
const PING: Duration = Duration::from_millis(10);
/// Largest ratio of the receiver's clock rate to the agreed rate.
const FASTEST: f64 = 1.25;

/// Source of samples and controls.
pub(super) trait Source {
    /// Renders the next samples.
    fn render(&mut self, out: &mut [i16]);

    /// Returns contact and texture at the end of the rendered samples.
    fn control(&self) -> Control;
}

/// Negotiated playback parameters.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plan {
    /// Settings for the receiver; each configuration gets a new number.
    pub(super) configure: Configure,
    /// Samples per frame.
    pub(super) block: u16,
    /// Longest silence of the receiver before a ping is sent.
    pub(super) stall: Duration,
}

/// Error counters of both sides of the line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Counts {
    pub(super) underruns: u64,
    pub(super) bad_frames: u64,
}

/// State machine of the host side.
#[derive(Debug)]
pub(super) struct Sender {
    plan: Plan,
    decoder: Decoder,
    own_bad_frames: u16,
    counts: Counts,
    config: u8,
    /// Last status with the current configuration.
    status: Option<DeviceStatus>,
    /// Index of the next sample.
    seq: u16,
    /// Index of the first sample of the receiver's run.
    run_begin: u16,
    last_heard: Duration,
    last_samples: Duration,
    last_order: Option<Duration>,
    is_stalled: bool,
    /// Run that a stop message should end, with the time of that message.
    stopped_run: Option<(u8, Duration)>,
    pings: u16,
    /// Samples that may be rendered according to the host's own clock.
    allowance: f64,
    allowed_at: Duration,
    /// Ticks of the receiver's clock that are not yet rendered in control mode.
    due_for_control: u32,
    control_seq: u16,
    control_age: u32,
    is_control_due: bool,
}

impl Sender {
    /// A sender after the handshake, at a time of any clock.
    pub(super) fn new(plan: Plan, now: Duration) -> Self {
        Self {
            plan,
            decoder: Decoder::new(),
            own_bad_frames: 0,
            counts: Counts::default(),
            config: 1,
            status: None,
            seq: 0,
            run_begin: 0,
            last_heard: now,
            last_samples: now,
            last_order: None,
            is_stalled: false,
            stopped_run: None,
            pings: 0,
            allowance: f64::from(plan.configure.window),
            allowed_at: now,
            due_for_control: 0,
            control_seq: 0,
            control_age: 0,
            is_control_due: false,
        }
    }

    /// Error counters so far.
    pub(super) fn counts(&self) -> Counts {
        self.counts
    }

    /// Processes received bytes. `hear` gets the messages that do not concern the stream.
    pub(super) fn receive(&mut self, bytes: &[u8], now: Duration, hear: &mut dyn FnMut(DeviceMessage<'_>)) {
        let mut decoder = std::mem::take(&mut self.decoder);
        for &byte in bytes {
            let Some(frame) = decoder.push(byte) else { continue };
            match from_device(frame) {
                Ok(Some(DeviceMessage::Status(status))) => self.note_status(status, now),
                // An unrequested hello reply means that the receiver was reset.
                Ok(Some(DeviceMessage::HelloReply(reply))) if reply.nonce == 0 => self.configure_anew(),
                Ok(Some(message)) => hear(message),
                Ok(None) => {}
                Err(_) => decoder.note_bad(),
            }
        }
        let n_bad = decoder.bad_frames().wrapping_sub(self.own_bad_frames);
        self.counts.bad_frames += u64::from(n_bad);
        self.own_bad_frames = decoder.bad_frames();
        self.decoder = decoder;
    }

    /// Queues the messages that are due now. Renders at most as many samples as the receiver accepts.
    pub(super) fn poll(&mut self, now: Duration, source: &mut dyn Source, outbox: &mut WriteQueue) {
        self.allow(now);
        let Some(status) = self.status else {
            let configure = Configure { config: self.config, ..self.plan.configure };
            self.order(now, REPEAT, HostMessage::Configure(configure), outbox);
            return;
        };
        if now.saturating_sub(self.last_heard) > self.plan.stall {
            self.wait_for_life(now, status, outbox);
            return;
        }
        if self.is_stalled {
            self.is_stalled = false;
            self.stop(now, status, outbox);
        }
        // Samples sent before the new run starts could be taken for the run that the stop ends.
        if let Some((run, since)) = self.stopped_run
            && status.run == run
        {
            if now.saturating_sub(since) > REPEAT {
                self.stop(now, status, outbox);
            }
            return;
        }
        self.stopped_run = None;
        match self.plan.configure.mode {
            Mode::Stream | Mode::Friction => self.stream(now, status, source, outbox),
            Mode::Control => self.control(status, source, outbox),
        }
    }

    /// Queues a final stop message, so that the receiver is silent before the line closes.
    pub(super) fn say_goodbye(outbox: &mut WriteQueue) {
        let mut wire = [0; MAX_WIRE];
        let len = write_to_device(HostMessage::Stop, &mut wire);
        outbox.clear();
        outbox.push(&wire[..len]);
    }

    fn note_status(&mut self, status: DeviceStatus, now: Duration) {
        if status.config != self.config || status.state == RunState::Unconfigured {
            // The receiver was reset, unless this status was sent before the configuration arrived.
            if self.status.is_some() {
                self.configure_anew();
            }
            return;
        }
        if let Some(last) = self.status {
            let n_ticks = status.clock.wrapping_sub(last.clock);
            // Reordered frames may deliver an old status, which is ignored. After a stall, every status is accepted.
            if n_ticks.cast_signed() < 0 && !self.is_stalled {
                return;
            }
            self.counts.underruns += u64::from(status.underruns.wrapping_sub(last.underruns));
            self.counts.bad_frames += u64::from(status.bad_frames.wrapping_sub(last.bad_frames));
            let most = 2 * u32::from(self.plan.configure.window);
            self.due_for_control = (self.due_for_control + n_ticks.min(most)).min(most);
        }
        if self.status.is_none_or(|last| last.run != status.run) {
            self.run_begin = self.seq;
            self.is_control_due = true;
        }
        (self.status, self.last_heard) = (Some(status), now);
    }

    fn configure_anew(&mut self) {
        if self.status.take().is_some() {
            self.config = self.config.checked_add(1).unwrap_or(1);
            (self.last_order, self.is_stalled, self.stopped_run) = (None, false, None);
        }
    }

    /// Handles a silent receiver: stops what may still be in transit, and pings.
    fn wait_for_life(&mut self, now: Duration, status: DeviceStatus, outbox: &mut WriteQueue) {
        if !self.is_stalled {
            self.is_stalled = true;
            outbox.clear();
            self.stop(now, status, outbox);
        }
        let id = self.pings;
        if self.order(now, PING, HostMessage::Ping { id }, outbox) {
            self.pings = self.pings.wrapping_add(1);
        }
    }

    fn stop(&mut self, now: Duration, status: DeviceStatus, outbox: &mut WriteQueue) {
        // A run that has already ended needs no stop.
        if self.stopped_run.is_none_or(|(run, _)| run == status.run) {
            self.stopped_run = Some((status.run, now));
            self.order(now, Duration::ZERO, HostMessage::Stop, outbox);
        }
    }

    /// Sends a message unless one was sent within `pause`. Returns whether it was queued.
    fn order(
        &mut self,
        now: Duration,
        pause: Duration,
        message: HostMessage<'_>,
        outbox: &mut WriteQueue,
    ) -> bool {
        if self.last_order.is_some_and(|last| now.saturating_sub(last) < pause) {
            return false;
        }
        self.last_order = Some(now);
        let mut wire = [0; MAX_WIRE];
        let len = write_to_device(message, &mut wire);
        outbox.push(&wire[..len])
    }

    /// Updates the allowance: whatever room a receiver claims, it gets no more samples than its clock can play.
    fn allow(&mut self, now: Duration) {
        let elapsed_secs = now.saturating_sub(self.allowed_at).as_secs_f64();
        self.allowed_at = now;
        let most = 2.0 * f64::from(self.plan.configure.window);
        let more = FASTEST * f64::from(self.plan.configure.rate_hz) * elapsed_secs;
        self.allowance = (self.allowance + more).min(most);
    }

    fn stream(
        &mut self,
        now: Duration,
        status: DeviceStatus,
        source: &mut dyn Source,
        outbox: &mut WriteQueue,
    ) {
        let Configure { window, rate_hz, .. } = self.plan.configure;
        let block = self.plan.block;
        // Samples cannot be in transit for so long: they are lost or would be stale on arrival.
        let window_secs = f64::from(window) / f64::from(rate_hz);
        let longest = (self.plan.stall * 4 / 5).max(Duration::from_secs_f64(2.0 * window_secs));
        let is_overdue = now.saturating_sub(self.last_samples) > longest;
        loop {
            let begin = if status.state == RunState::Armed { self.run_begin } else { status.seq };
            let in_flight = self.seq.wrapping_sub(begin);
            // More than a window: the receiver expects samples that were never sent.
            if in_flight > window || in_flight > 0 && is_overdue {
                self.stop(now, status, outbox);
                return;
            }
            let room = status.free.min(window).saturating_sub(in_flight);
            if room < block || self.allowance < f64::from(block) || !outbox.has_room() {
                return;
            }
            let mut samples = [0; MAX_SAMPLES];
            let samples = &mut samples[..usize::from(block)];
            source.render(samples);
            let mut wire = [0; MAX_WIRE];
            let len = write_samples(self.seq, status.run, samples, &mut wire);
            outbox.push(&wire[..len]);
            self.seq = self.seq.wrapping_add(block);
            self.allowance -= f64::from(block);
            self.last_samples = now;
        }
    }

    fn control(&mut self, status: DeviceStatus, source: &mut dyn Source, outbox: &mut WriteQueue) {
        while self.due_for_control > 0 && self.allowance >= 1.0 {
            let n = self.due_for_control.min(self.allowance as u32).min(MAX_SAMPLES as u32);
            source.render(&mut [0; MAX_SAMPLES][..n as usize]);
            self.due_for_control -= n;
            self.allowance -= f64::from(n);
            self.control_age += n;
        }
        if !(self.is_control_due || self.control_age >= u32::from(self.plan.block)) || !outbox.has_room() {
            return;
        }
        let message =
            HostMessage::Control { seq: self.control_seq, run: status.run, control: source.control() };
        let mut wire = [0; MAX_WIRE];
        let len = write_to_device(message, &mut wire);
        outbox.push(&wire[..len]);
        self.control_seq = self.control_seq.wrapping_add(1);
        (self.control_age, self.is_control_due) = (0, false);
    }
}

#[cfg(test)]
mod tests;
