//! The signals of a job: rendered once for all outputs of the same stroke and rate.

use anyhow::{Context as _, bail};
use shagreen_core::texture::plane::Prepared;
use shagreen_core::units::Hertz;
use shagreen_formats::batch_manifest::BatchOutput;
use shagreen_formats::library::Library;
use shagreen_formats::wav;

use super::{MadeSound, TargetWorker};
use crate::batch::LoadedStroke;
use crate::batch::rates::whole_rate_hz;
use crate::export::{
    FilePart, Rendered, SignalFormat, SignalSamples, StrokeSignal, lost_of_tap, shared_full_scale_mps2,
};
use crate::render::{SampleFormat, prepared_keys, render_along_prepared, render_prepared};
use crate::report::{Reporter as _, Warnings};
use crate::silence::silence_warning;
use crate::sound::Sound;
use crate::sound_render::add_separate_taps;
use crate::sound_sidecar::{SignalFacts, sidecar_of_sound};

/// Samples of the last job, which other outputs of the same stroke share.
pub(super) struct LastSamples {
    rate_hz: u32,
    stroke: usize,
    loops: bool,
    samples: Vec<f32>,
    /// The same without tap transients; `None` if there are none.
    without_taps: Option<Vec<f32>>,
}

/// A sound whose textures are prepared once for all its signals.
pub(super) enum PreparedSound {
    Path(Vec<Prepared>),
    Mixture(Vec<(Prepared, f64)>),
}

impl TargetWorker<'_> {
    /// Files of a signal, and what they lack.
    pub(super) fn signal_parts(
        &mut self,
        format: &dyn SignalFormat,
        output: usize,
        stroke: usize,
        reporter: &Warnings,
    ) -> anyhow::Result<(Vec<FilePart>, Vec<String>)> {
        let BatchOutput { rate_hz, encoding, loops, full_scale_mps2, .. } =
            self.plan.manifest.outputs[output];
        let rate_hz = if let Some(rate_hz) = rate_hz {
            rate_hz
        } else {
            let MadeSound { library, sound, .. } = self.made_sound()?;
            whole_rate_hz(sound.rate(library)?)?
        };
        self.render((rate_hz, loops), stroke, reporter)?;
        let last = self.last.as_ref().context("the signal was not rendered; run the batch again")?;
        let rate = Hertz(f64::from(rate_hz));
        let (all, without_taps) = (&*last.samples, last.without_taps.as_deref());
        let samples = SignalSamples { all, without_taps, rate, loops };
        let MadeSound { library, sound, .. } = self.made_sound()?;
        let loaded = &self.plan.sources.strokes[stroke];
        let facts = SignalFacts {
            rate_hz,
            seconds: loaded.seconds(),
            loops,
            seed: self.plan.manifest.seed,
            stroke: loaded.file_name(),
            trace: loaded.trace(),
            created_by: self.options.created_by,
        };
        let sidecar = sidecar_of_sound(library, sound, facts);
        if let Some(warning) = silence_warning(all, &sidecar.trace) {
            reporter.warn(&warning);
        }
        let own_scale = || shared_full_scale_mps2([format.full_scale_mps2(samples, encoding)]);
        let signal = StrokeSignal {
            samples,
            sidecar: &sidecar,
            encoding,
            full_scale_mps2: full_scale_mps2.unwrap_or_else(own_scale),
            acf: self.plan.outputs[output].acf.as_ref(),
        };
        let parts = format.files(&signal, self.options.created_by)?;
        if let Some(warning) = format.warning(&signal) {
            reporter.warn(&warning);
        }
        let follows_stroke = matches!(loaded, LoadedStroke::Recorded { .. });
        let rendered = Rendered::of_sound(library, sound, rate, follows_stroke);
        // All else is lost in every signal of one stroke.
        let lost = lost_of_tap(rendered).into_iter().collect();
        Ok((parts, lost))
    }

    /// Renders the samples of a stroke, unless the last job had the same.
    fn render(
        &mut self,
        (rate_hz, loops): (u32, bool),
        stroke: usize,
        reporter: &Warnings,
    ) -> anyhow::Result<()> {
        let is_same =
            |last: &LastSamples| (last.rate_hz, last.loops, last.stroke) == (rate_hz, loops, stroke);
        if self.last.as_ref().is_some_and(is_same) {
            return Ok(());
        }
        self.last = None;
        let loaded = &self.plan.sources.strokes[stroke];
        let seconds = loaded.seconds();
        wav::check_length((seconds * f64::from(rate_hz)).round() as u64)?;
        let format =
            SampleFormat { rate: Hertz(f64::from(rate_hz)), seconds, seed: self.plan.manifest.seed, loops };
        let Some(Ok(made)) = &mut self.made else { bail!("the texture was not made; run the batch again") };
        let MadeSound { library, sound, prepared, .. } = made;
        let prepared = match prepared {
            Some(prepared) => prepared,
            None => prepared.insert(prepared_sound(library, sound, reporter)?),
        };
        let rendered = loaded.with_hand(|hand| match (prepared, &sound.path) {
            (PreparedSound::Path(keys), Some(path)) => render_along_prepared(path, keys, format, hand),
            (PreparedSound::Path(_), None) => Ok(Vec::new()),
            (PreparedSound::Mixture(voices), _) => render_prepared(voices, sound.mixing, format, hand),
        });
        let mut samples = rendered.context("the texture cannot be rendered with these options")?;
        if samples.is_empty() {
            bail!("{seconds} s at {rate_hz} Hz contain no sample; choose a longer duration");
        }
        let mut without_taps = None;
        if let LoadedStroke::Recorded { contacts, .. } = loaded {
            let stroke = (contacts.clone(), rate_hz);
            (_, without_taps) = add_separate_taps(&mut samples, library, sound, stroke, reporter)?;
        }
        self.last = Some(LastSamples { rate_hz, stroke, loops, samples, without_taps });
        Ok(())
    }
}

fn prepared_sound(library: &Library, sound: &Sound, reporter: &Warnings) -> anyhow::Result<PreparedSound> {
    if let Some(path) = &sound.path {
        return Ok(PreparedSound::Path(prepared_keys(path)));
    }
    let planes = sound.planes(library, reporter)?;
    Ok(PreparedSound::Mixture(planes.iter().map(|(plane, weight)| (plane.prepare(), *weight)).collect()))
}
