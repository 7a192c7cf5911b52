//! Waveforms of the stimuli of a plan, for models that compare signals.

use anyhow::{Context as _, bail};
use shagreen_core::people::study::plan::{Plan, Source};

use super::Maker;
use super::signals::SignalMaker;
use crate::report::Reporter;
use crate::study::plans::StudyPlan;
use crate::study::textures::StudyTextures;

/// Makes the waveforms of the stimuli of a plan that are textures: the signals that a part with processed versions presents.
pub struct Waveforms<'a> {
    plan: &'a Plan,
    maker: Maker<'a>,
}

impl<'a> Waveforms<'a> {
    /// Waveforms of the stimuli of a plan, made of these textures.
    ///
    /// # Errors
    /// The plan names textures that do not exist, or the codec cannot be read.
    pub fn new(
        study: &'a StudyPlan,
        textures: &'a StudyTextures,
        reporter: &'a dyn Reporter,
    ) -> anyhow::Result<Self> {
        study.check_textures(textures)?;
        let plan = &*study.plan;
        let maker = Maker { plan, textures, signals: SignalMaker::new(plan.seed)?, reporter };
        Ok(Self { plan, maker })
    }

    /// Waveform of a stimulus in m/s² at [`shagreen_core::signals::codec::CODEC_RATE`], over all its segments.
    ///
    /// # Errors
    /// The plan has no such stimulus, the stimulus is a profile, or it cannot be made.
    pub fn of(&self, id: &str) -> anyhow::Result<Vec<f64>> {
        let stimulus = self.plan.stimulus(id).with_context(|| {
            format!("the plan has no stimulus \"{id}\"; use the plan of the study, or correct the table")
        })?;
        let Source::Texture(name) = &stimulus.source else {
            bail!("stimulus \"{id}\" is a profile, not a texture; remove its pairs from the table");
        };
        let made = self.maker.waveform(name, stimulus);
        let mut samples = made.with_context(|| format!("stimulus \"{id}\" cannot be made"))?;
        let gain = 10.0_f64.powf(stimulus.level_db / 20.0);
        for sample in &mut samples {
            *sample *= gain;
        }
        Ok(samples)
    }
}
