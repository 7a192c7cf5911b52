//! Gate that silences the output after lift-off, whatever still oscillates.
//!
//! A texture model may contain a resonance that decays for seconds, and so may a tap transient or the filter that
//! inverts an actuator. None of them may drive the actuator for long while nothing is touched.

/// Time after lift-off during which oscillations pass unchanged, in seconds: long enough for the tap transients of real
/// surfaces.
const HOLD_SECS: f32 = 0.15;
/// Duration of the fade after that, in seconds.
const FADE_SECS: f32 = 0.1;
/// Duration of the fade back to full gain, if a contact begins before the gate is closed, in seconds.
const OPEN_SECS: f32 = 0.002;

/// Longest time from lift-off to silence, in seconds, without the delay of the device.
pub const SILENT_AFTER_SECS: f32 = HOLD_SECS + FADE_SECS;

/// Contact as far as it is known, in frames since the start of the stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Touching {
    /// The tip has not touched yet.
    Never,
    /// The tip landed, and touched last, at these frames. They may lie ahead of the present frame.
    Span {
        /// Frame of the last contact onset.
        landed: u64,
        /// Last frame that is known to be in contact.
        touched: u64,
    },
    /// Something plays that needs no contact, such as a test signal.
    NotNeeded,
}

/// Gain of the output: 1 during contact, exactly 0 from [`SILENT_AFTER_SECS`] after lift-off. It does not depend on the
/// size of blocks.
#[derive(Clone, Debug)]
pub struct LiftGate {
    frame: u64,
    gain: f32,
    /// Last frame in contact before the last onset.
    touched_before: Option<u64>,
    hold_frames: u64,
    fade_step: f32,
    open_step: f32,
}

impl LiftGate {
    /// A closed gate, at the device's sample rate in Hz.
    pub fn new(rate_hz: f32) -> Self {
        Self {
            frame: 0,
            gain: 0.0,
            touched_before: None,
            hold_frames: (HOLD_SECS * rate_hz) as u64,
            fade_step: 1.0 / (FADE_SECS * rate_hz).max(1.0),
            open_step: 1.0 / (OPEN_SECS * rate_hz).max(1.0),
        }
    }

    /// Whether the output is silent.
    pub fn is_closed(&self) -> bool {
        self.gain == 0.0
    }

    /// Closes the gate and starts at frame 0 again.
    pub fn reset(&mut self) {
        (self.frame, self.gain, self.touched_before) = (0, 0.0, None);
    }

    /// Multiplies the next block by the gain.
    pub fn process(&mut self, block: &mut [f32], touching: Touching) {
        let end = self.frame + block.len() as u64;
        match touching {
            Touching::Never => {
                self.fade(block, None);
            }
            Touching::NotNeeded => self.gain = 1.0,
            Touching::Span { landed, touched } => {
                // An onset within the block must not act before its frame, or the block size would matter.
                let n_before = landed.saturating_sub(self.frame).min(block.len() as u64) as usize;
                let (before, after) = block.split_at_mut(n_before);
                self.fade(before, self.touched_before);
                if !after.is_empty() {
                    self.touched_before = Some(touched);
                }
                self.fade(after, self.touched_before);
            }
        }
        self.frame = end;
    }

    /// Multiplies samples by the gain, with the last frame in contact; advances the frame.
    fn fade(&mut self, samples: &mut [f32], touched: Option<u64>) {
        let open_until = touched.map(|touched| touched + self.hold_frames);
        let end = self.frame + samples.len() as u64;
        // Most blocks lie wholly within a contact or between two.
        if self.gain == 1.0 && open_until.is_some_and(|until| end <= until + 1) {
            self.frame = end;
            return;
        }
        if self.gain == 0.0 && open_until.is_none_or(|until| until < self.frame) {
            samples.fill(0.0);
            self.frame = end;
            return;
        }
        for sample in samples {
            self.gain = match open_until {
                // Before the onset there was silence, so it needs no fade.
                Some(until) if self.frame <= until && self.gain == 0.0 => 1.0,
                Some(until) if self.frame <= until => (self.gain + self.open_step).min(1.0),
                _ => (self.gain - self.fade_step).max(0.0),
            };
            *sample = if self.gain == 0.0 { 0.0 } else { *sample * self.gain };
            self.frame += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::{FADE_SECS, HOLD_SECS, LiftGate, SILENT_AFTER_SECS, Touching};
    use proptest::prelude::{prop, prop_assert, prop_assert_eq, proptest};
    use std::vec;
    use std::vec::Vec;

    const RATE_HZ: f32 = 48_000.0;
    /// Frames between two looks at the contact, and how far these look ahead.
    const TICK: usize = 240;

    /// Gain of each frame for strokes of contact and no contact, in ticks.
    fn gains(strokes: &[(usize, usize)], block: usize) -> Vec<f32> {
        let is_touching: Vec<bool> = strokes
            .iter()
            .flat_map(|(down, up)| std::iter::repeat_n(true, *down).chain(std::iter::repeat_n(false, *up)))
            .collect();
        let mut gate = LiftGate::new(RATE_HZ);
        let mut out = vec![1.0_f32; TICK * is_touching.len()];
        let mut touching = Touching::Never;
        let (mut frame, mut n_polled) = (0, 0);
        for part in out.chunks_mut(block) {
            frame += part.len();
            while n_polled < is_touching.len() && n_polled * TICK < frame {
                let end = (TICK * (n_polled + 1)) as u64;
                if is_touching[n_polled] {
                    let was = n_polled > 0 && is_touching[n_polled - 1];
                    let landed = match touching {
                        Touching::Span { landed, .. } if was => landed,
                        _ => end,
                    };
                    touching = Touching::Span { landed, touched: end };
                }
                n_polled += 1;
            }
            gate.process(part, touching);
        }
        out
    }

    #[test]
    fn passes_contact_and_the_hold_then_fades_in_a_straight_line_to_silence() {
        let out = gains(&[(4, 200)], 256);
        let (landed, lifted) = (TICK, 4 * TICK);
        assert!(out[..landed].iter().all(|gain| *gain == 0.0));
        let hold_end = lifted + (HOLD_SECS * RATE_HZ) as usize;
        assert!(out[landed..=hold_end].iter().all(|gain| *gain == 1.0));
        let half = hold_end + (0.5 * FADE_SECS * RATE_HZ) as usize;
        assert!((out[half] - 0.5).abs() < 1e-3, "{}", out[half]);
        let silent = lifted + (SILENT_AFTER_SECS * RATE_HZ).ceil() as usize + 2;
        assert!(out[silent..].iter().all(|gain| *gain == 0.0));
    }

    #[test]
    fn what_needs_no_contact_passes_and_nothing_that_is_not_finite_does() {
        let mut gate = LiftGate::new(RATE_HZ);
        let mut block = [f32::NAN; 8];
        gate.process(&mut block, Touching::Never);
        assert_eq!(block, [0.0; 8]);
        let mut block = [1.0; 8];
        gate.process(&mut block, Touching::NotNeeded);
        assert_eq!(block, [1.0; 8]);
        gate.reset();
        assert!(gate.is_closed());
    }

    proptest! {
        /// The gain does not depend on block sizes, and moves by at most one step of its fastest fade, except at an
        /// onset after silence.
        #[test]
        fn the_gain_never_jumps(strokes in prop::collection::vec((1_usize..9, 1_usize..80), 1..8), block in 1_usize..256) {
            let out = gains(&strokes, block);
            prop_assert_eq!(&out, &gains(&strokes, 240));
            for pair in out.windows(2) {
                prop_assert!((0.0..=1.0).contains(&pair[1]));
                prop_assert!(pair[0] == 0.0 || (pair[1] - pair[0]).abs() < 0.0105, "{pair:?}");
            }
        }
    }
}
