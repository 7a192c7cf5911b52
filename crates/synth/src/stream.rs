//! Stream of device samples from model ticks, independent of block sizes.

use crate::contact::ContactSource;
use crate::renderer::{Mix, Renderer, TextureId, Textures};
use crate::resampler::Resampler;
use crate::voice::MAX_TICK;

/// Time after the begin of a tick at which the tick has certainly been requested, in seconds. The filters after it delay
/// its samples by more.
pub const REQUEST_SECS: f64 = 5e-5;

/// A renderer followed by the sample-rate converter, for use in an audio callback.
#[derive(Clone, Debug)]
pub struct Stream {
    renderer: Renderer,
    resampler: Resampler,
    model_rate_hz: f64,
    tick: [f32; MAX_TICK],
    next_in_tick: usize,
    ticks_done: u64,
    wanted: Option<Mix>,
}

impl Stream {
    /// A silent stream from textures at `model_rate_hz` to a device at `device_rate_hz`, with noise determined by
    /// `seed`.
    pub fn new(model_rate_hz: f32, device_rate_hz: f32, seed: u64) -> Self {
        let renderer = Renderer::new(model_rate_hz, seed);
        Self {
            next_in_tick: renderer.tick_len(),
            renderer,
            resampler: Resampler::new(model_rate_hz, device_rate_hz),
            model_rate_hz: f64::from(model_rate_hz),
            tick: [0.0; MAX_TICK],
            ticks_done: 0,
            wanted: None,
        }
    }

    /// Starts a fade to `mix` at the next tick. A newer mix replaces one that has not started.
    pub fn set_mix(&mut self, mix: Mix) {
        self.wanted = Some(mix);
    }

    /// Clears what still oscillates, without an effect on fades, noise or clock. Call it only while nothing is touched.
    pub fn silence(&mut self) {
        self.renderer.silence();
    }

    /// Whether texture `id` is active, fading or waiting to start.
    pub fn is_using(&self, id: TextureId) -> bool {
        self.renderer.is_sounding(id)
            || self.wanted.is_some_and(|mix| mix.parents.iter().any(|p| p.id == id && p.weight > 0.0))
    }

    /// Duration of a tick in seconds.
    pub fn tick_secs(&self) -> f64 {
        self.renderer.tick_len() as f64 / self.model_rate_hz
    }

    /// Delay in seconds from a change of contact to the middle of its ramp in the output: one tick plus the filters.
    pub fn latency_secs(&self) -> f32 {
        (self.renderer.tick_len() as f32 + Resampler::delay_model_samples()) / self.model_rate_hz as f32
    }

    /// Fills `out` with the next device samples in m/s².
    pub fn process(&mut self, textures: &dyn Textures, contacts: &mut dyn ContactSource, out: &mut [f32]) {
        let Self { renderer, resampler, model_rate_hz, tick, next_in_tick, ticks_done, wanted } = self;
        let tick_len = renderer.tick_len();
        for sample in out {
            *sample = resampler.next(|| {
                if *next_in_tick >= tick_len {
                    if let Some(mix) = *wanted
                        && renderer.set_mix(&mix)
                    {
                        *wanted = None;
                    }
                    *ticks_done += 1;
                    let time_secs = (*ticks_done * tick_len as u64) as f64 / *model_rate_hz;
                    let contact = contacts.contact_at(time_secs);
                    renderer.tick(textures, contact, contacts.place(), tick);
                    *next_in_tick = 0;
                }
                *next_in_tick += 1;
                tick[*next_in_tick - 1]
            });
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::Stream;
    use crate::contact::{Contact, ContactSource};
    use crate::renderer::tests::Table;
    use crate::renderer::{Blend, Mix, Parent};
    use std::vec;
    use std::vec::Vec;

    /// A stroke with varying speed and force and with lifts.
    struct Wave;

    impl ContactSource for Wave {
        fn contact_at(&mut self, time_secs: f64) -> Contact {
            let lifted = (time_secs * 10.0) as i64 % 7 == 3;
            let force_n = if lifted { 0.0 } else { 0.5 + 0.4 * (11.0 * time_secs).sin() as f32 };
            Contact { speed_mps: (7.0 * time_secs).sin().abs() as f32, force_n }
        }
    }

    fn stream(blend: Blend) -> Stream {
        let mut mix = Mix::silent(blend);
        for (id, weight) in [(0, 0.2), (1, 0.3), (2, 0.5)] {
            mix.parents[usize::from(id)] = Parent { id, weight };
        }
        let mut stream = Stream::new(1000.0, 48_000.0, 42);
        stream.set_mix(mix);
        stream
    }

    /// The first `n` samples, in blocks of `block`.
    fn render(block: usize, n: usize, mut stream: Stream) -> Vec<f32> {
        let table = Table::with_levels(&[0.5, 1.0, 2.0]);
        // NaN marks samples that are not overwritten.
        let mut out = vec![f32::NAN; n];
        for chunk in out.chunks_mut(block) {
            stream.process(&table, &mut Wave, chunk);
        }
        out
    }

    #[test]
    fn output_does_not_depend_on_the_size_of_blocks() {
        for blend in [Blend::Paper, Blend::Power, Blend::Shared] {
            let whole = render(12_288, 12_288, stream(blend));
            assert!(whole.iter().all(|x| x.is_finite()) && whole.iter().any(|x| x.abs() > 0.1));
            for block in
                [1, 2, 3, 5, 7, 16, 47, 48, 64, 127, 128, 240, 256, 441, 512, 1000, 1024, 2048, 4095, 4096]
            {
                assert!(render(block, 12_288, stream(blend)) == whole, "{blend:?} in blocks of {block}");
            }
        }
    }

    #[test]
    fn every_block_size_to_4096_gives_the_same_first_three_blocks() {
        let whole = render(12_288, 12_288, stream(Blend::Power));
        let fresh = stream(Blend::Power);
        for block in 1..=4096 {
            let n = 3 * block;
            assert!(render(block, n, fresh.clone()) == whole[..n], "blocks of {block}");
        }
    }
}
