//! Thread that sends waveforms to a haptic pen, because a pen may take long to accept a report.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering};
use std::sync::mpsc::Receiver;
use std::thread::JoinHandle;

use crate::error::{DeviceError, DeviceErrorKind};
use crate::haptic_pen::pen::HapticPen;
use crate::haptic_pen::waveform::{Play, Waveform};
use crate::link::Reporter;

/// Change of the intensity, in percent of the highest, below which no report is sent.
pub const LEAST_CHANGE_PERCENT: u8 = 3;

/// What a haptic pen plays, and what it has played.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct HapticReading {
    /// The waveform that it plays now.
    pub now: Play,
    /// The strongest waveform that it has played. A click is stated only if there was no other waveform.
    pub strongest: Option<Play>,
    /// Number of reports that were sent.
    pub n_reports: u64,
}

/// Reading of a haptic pen that all threads share.
#[derive(Debug, Default)]
pub(crate) struct HapticMonitor {
    now: AtomicU32,
    strongest: AtomicU32,
    n_reports: AtomicU64,
}

impl HapticMonitor {
    /// The present reading.
    pub(crate) fn reading(&self) -> HapticReading {
        let strongest = unpacked(self.strongest.load(Ordering::Relaxed));
        HapticReading {
            now: unpacked(self.now.load(Ordering::Relaxed)),
            strongest: strongest.waveform.is_some().then_some(strongest),
            n_reports: self.n_reports.load(Ordering::Relaxed),
        }
    }

    fn note(&self, play: Play, n_reports: u64) {
        self.now.store(packed(play), Ordering::Relaxed);
        // One thread alone notes.
        if rank(play) > rank(unpacked(self.strongest.load(Ordering::Relaxed))) {
            self.strongest.store(packed(play), Ordering::Relaxed);
        }
        self.n_reports.store(n_reports, Ordering::Relaxed);
    }
}

/// Order of waveforms by strength: silence, clicks, and those that last.
fn rank(play: Play) -> (u8, u8) {
    let kind = match play.waveform {
        None => 0,
        Some(Waveform::CLICK) => 1,
        Some(_) => 2,
    };
    (kind, play.intensity_percent)
}

fn packed(play: Play) -> u32 {
    play.waveform.map_or(0, |waveform| u32::from(waveform.0) << 8 | u32::from(play.intensity_percent))
}

fn unpacked(bits: u32) -> Play {
    match (bits >> 8) as u16 {
        0 => Play::SILENCE,
        id => Play { waveform: Some(Waveform(id)), intensity_percent: bits as u8 },
    }
}

/// The thread. It ends, and silences the pen, when the sender of its waveforms is dropped; drop that one first.
#[derive(Debug)]
pub(crate) struct HapticSender {
    thread: Option<JoinHandle<()>>,
}

impl HapticSender {
    /// Starts to send to `pen` what comes from `plays`. If the pen is lost, this is reported.
    ///
    /// # Errors
    /// [`DeviceErrorKind::Backend`] if the system cannot start a thread.
    pub(crate) fn start(
        pen: HapticPen,
        plays: Receiver<Play>,
        mut reporter: Reporter,
        monitor: Arc<HapticMonitor>,
    ) -> Result<Self, DeviceError> {
        let send = move || {
            if let Err(error) = send(pen, &plays, &monitor) {
                reporter.lose(error);
            }
        };
        let thread = std::thread::Builder::new().name("haptic pen".to_owned()).spawn(send);
        let thread = thread.map_err(|error| {
            let message = format!("the haptic pen cannot start: the system cannot start a thread ({error})");
            DeviceError::new(DeviceErrorKind::Backend, message)
        })?;
        Ok(Self { thread: Some(thread) })
    }
}

impl Drop for HapticSender {
    fn drop(&mut self) {
        if let Some(thread) = self.thread.take() {
            thread.join().ok(); // A panic has been printed already.
        }
    }
}

/// Sends the newest of the waiting waveforms, until there will be none any more. A waiting click is sent before it.
fn send(mut pen: HapticPen, plays: &Receiver<Play>, monitor: &HapticMonitor) -> Result<(), DeviceError> {
    while let Ok(first) = plays.recv() {
        let mut newest = first;
        let mut click = None;
        loop {
            if newest.waveform == Some(Waveform::CLICK) {
                click = Some(newest);
            }
            let Ok(next) = plays.try_recv() else { break };
            newest = next;
        }
        let newest = (newest.waveform != Some(Waveform::CLICK)).then_some(newest);
        for play in click.into_iter().chain(newest) {
            if is_new(pen.played(), play) {
                pen.play(play)?;
                monitor.note(pen.played(), pen.n_reports());
            }
        }
    }
    drop(pen);
    Ok(())
}

/// Whether a waveform is worth a report after another.
fn is_new(before: Play, next: Play) -> bool {
    let change = before.intensity_percent.abs_diff(next.intensity_percent);
    // A click is not repeated by the pen.
    before.waveform != next.waveform
        || next.waveform == Some(Waveform::CLICK)
        || next.waveform.is_some() && change >= LEAST_CHANGE_PERCENT
}

#[cfg(test)]
mod tests;
