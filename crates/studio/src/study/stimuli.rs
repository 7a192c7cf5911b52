//! What participants feel: each stimulus of a plan as textures to play, with a hash.
//!
//! - A texture plays live: its noise is new in every stroke.
//! - If a part compares textures with their decoded or reconstructed versions, all of its textures are *signals*: strokes at
//!   [`SIGNAL_CONTACT`] with fixed noise, played by the position of the tip. Original and version then differ in nothing but
//!   the processing.
//! - A profile is a relief with the root mean square acceleration [`PROFILE_LEVEL_MPS2`]; its reconstruction has the same
//!   factor from profile to acceleration.
//! - Gaps and differences in level of a staircase are made for each trial, from its level and its seed.
//! - Textures of a questionnaire are made from texts, not here.

mod made;
mod profiles;
mod signals;
mod waveforms;

use std::collections::BTreeMap;
use std::sync::Arc;

use anyhow::{Context as _, bail};
use shagreen_core::people::study::plan::{Design, Part, Plan, Source, Stimulus, Variant, Varied};
use shagreen_core::people::study::trial::{Side, Task, Trial};

use crate::report::Reporter;
use crate::study::plans::StudyPlan;
use crate::study::presented::{presents_signals, stimuli_of};
use crate::study::textures::StudyTextures;

pub use made::StimulusSound;
pub use profiles::PROFILE_LEVEL_MPS2;
pub use signals::{SIGNAL_CONTACT, SIGNAL_SECS};
pub use waveforms::Waveforms;

use self::signals::SignalMaker;

/// The stimuli of a plan, ready to be played.
#[derive(Clone, Debug)]
pub struct Stimuli {
    plan: Arc<Plan>,
    /// By part and stimulus; one sound for each segment.
    sounds: BTreeMap<(String, String), Vec<Arc<StimulusSound>>>,
}

/// Form in which a stimulus is presented.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Form {
    /// As a texture.
    Live,
    /// As a signal, in this number of segments.
    Signal(usize),
}

impl Stimuli {
    /// Makes all stimuli of a plan. `on_step` receives the number of stimuli that are made and the number of all, and returns
    /// whether to continue.
    ///
    /// # Errors
    /// A texture does not exist, a stimulus cannot be made from it, or `on_step` ended the work; the message names the
    /// stimulus.
    pub fn make(
        study: &StudyPlan,
        textures: &StudyTextures,
        reporter: &dyn Reporter,
        on_step: &mut dyn FnMut(usize, usize) -> bool,
    ) -> anyhow::Result<Self> {
        study.check_textures(textures)?;
        let plan = &study.plan;
        let wanted: Vec<(&Part, &str, Form)> = plan.parts.iter().flat_map(|part| forms(plan, part)).collect();
        let maker = Maker { plan, textures, signals: SignalMaker::new(plan.seed)?, reporter };
        let mut made: BTreeMap<(&str, Form), Vec<Arc<StimulusSound>>> = BTreeMap::new();
        let mut sounds = BTreeMap::new();
        let n_all = wanted.len();
        for (n_done, (part, id, form)) in wanted.into_iter().enumerate() {
            if !on_step(n_done, n_all) {
                bail!("the stimuli were not made: the work was ended");
            }
            let of_form = match made.get(&(id, form)) {
                Some(known) => known.clone(),
                None => maker.make(id, form).with_context(|| format!("stimulus \"{id}\" cannot be made"))?,
            };
            check_staircase(part, &of_form)?;
            made.insert((id, form), of_form.clone());
            sounds.insert((part.id.clone(), id.to_owned()), of_form);
        }
        on_step(n_all, n_all);
        Ok(Self { plan: Arc::clone(plan), sounds })
    }

    /// What a trial presents: in the order of [`Task::shown`], or both sides of a detection. Empty for a question.
    ///
    /// # Errors
    /// The trial is not one of the plan, or its signals cannot be made.
    pub fn of_trial(&self, trial: &Trial) -> anyhow::Result<Vec<Arc<StimulusSound>>> {
        match &trial.task {
            Task::Detect { level, target, .. } => self.detection(trial, *level, *target),
            Task::Discriminate { segment, .. } => self.shown(trial, *segment),
            task if task.shown().is_empty() => Ok(Vec::new()),
            _ => self.shown(trial, 0),
        }
    }

    /// Hashes of what a trial presents, for its log.
    pub fn hashes(sounds: &[Arc<StimulusSound>]) -> Vec<String> {
        sounds.iter().map(|sound| sound.sha256().to_owned()).collect()
    }

    fn shown(&self, trial: &Trial, segment: usize) -> anyhow::Result<Vec<Arc<StimulusSound>>> {
        trial
            .task
            .shown()
            .into_iter()
            .map(|shown| self.sound(&trial.part, &shown.stimulus, segment))
            .collect()
    }

    /// A stimulus in the form of a part.
    fn sound(&self, part: &str, stimulus: &str, segment: usize) -> anyhow::Result<Arc<StimulusSound>> {
        let of_form = self.sounds.get(&(part.to_owned(), stimulus.to_owned()));
        // A texture that plays live has no segments.
        let sound = of_form.and_then(|sounds| sounds.get(segment).or_else(|| sounds.first()));
        sound.cloned().with_context(|| {
            format!(
                "part \"{part}\" has no stimulus \"{stimulus}\"; use the plan with which the session began"
            )
        })
    }

    /// Both sides of a detection, the first one first.
    fn detection(&self, trial: &Trial, level: f64, target: Side) -> anyhow::Result<Vec<Arc<StimulusSound>>> {
        let part = self.plan.part(&trial.part).map(|part| &part.design);
        let [with, without] = match part {
            Some(Design::Staircase { varied: Varied::Gap, .. }) => {
                profiles::gap_sounds(level, trial.seed)?.map(Arc::new)
            }
            Some(Design::Staircase { varied: Varied::Level { stimulus }, .. }) => {
                let without = self.sound(&trial.part, stimulus, 0)?;
                [Arc::new(without.louder(level)?), without]
            }
            _ => bail!("part \"{}\" has no staircase; use the plan with which the session began", trial.part),
        };
        Ok(if target == Side::First { vec![with, without] } else { vec![without, with] })
    }
}

/// The stimuli of a part, each in its form.
fn forms<'a>(plan: &'a Plan, part: &'a Part) -> Vec<(&'a Part, &'a str, Form)> {
    let n_segments = match &part.design {
        Design::SameDifferent { n_segments, .. } => *n_segments,
        _ => 1,
    };
    let form = if presents_signals(plan, part) { Form::Signal(n_segments) } else { Form::Live };
    stimuli_of(part).into_iter().map(|id| (part, id, form)).collect()
}

/// Checks that the highest level of a staircase can be played.
fn check_staircase(part: &Part, sounds: &[Arc<StimulusSound>]) -> anyhow::Result<()> {
    if let (Design::Staircase { varied: Varied::Level { .. }, rule, .. }, Some(sound)) =
        (&part.design, sounds.first())
    {
        sound
            .louder(rule.highest)
            .with_context(|| format!("the highest level of part \"{}\" cannot be played", part.id))?;
    }
    Ok(())
}

/// What stimuli are made of.
struct Maker<'a> {
    plan: &'a Plan,
    textures: &'a StudyTextures,
    signals: SignalMaker,
    reporter: &'a dyn Reporter,
}

impl Maker<'_> {
    /// A stimulus in a form: one sound for each segment.
    fn make(&self, id: &str, form: Form) -> anyhow::Result<Vec<Arc<StimulusSound>>> {
        let stimulus =
            self.plan.stimulus(id).context("the plan has no such stimulus; add a [[stimulus]] for it")?;
        let made = match &stimulus.source {
            Source::Profile(name) => vec![profiles::profile_sound(name, stimulus.variant)?],
            Source::Texture(name) => match form {
                Form::Live => vec![self.live(name, stimulus.variant)?],
                Form::Signal(n_segments) => self.signal(name, stimulus, n_segments)?,
            },
        };
        made.into_iter().map(|sound| Ok(Arc::new(sound.with_level(stimulus.level_db)?))).collect()
    }

    /// A texture or its authored copy, live.
    fn live(&self, name: &str, variant: Variant) -> anyhow::Result<StimulusSound> {
        match variant {
            Variant::Authored => StimulusSound::authored_copy(self.textures, name, self.reporter),
            Variant::Original | Variant::Coded { .. } | Variant::Reconstructed { .. } => {
                StimulusSound::of_name(self.textures, name, self.reporter)
            }
        }
    }

    fn signal(
        &self,
        name: &str,
        stimulus: &Stimulus,
        n_segments: usize,
    ) -> anyhow::Result<Vec<StimulusSound>> {
        signals::segments(&self.waveform(name, stimulus)?, n_segments)
    }

    /// A texture as a signal in m/s² at the rate of the codec, without the level of the stimulus.
    fn waveform(&self, name: &str, stimulus: &Stimulus) -> anyhow::Result<Vec<f64>> {
        let signal = self.signals.of(&self.live(name, stimulus.variant)?, name)?;
        Ok(match stimulus.variant {
            Variant::Original | Variant::Authored => signal,
            Variant::Coded { kbps } => self.signals.coded(&signal, kbps)?,
            Variant::Reconstructed { window_mm } => signals::reconstructed(&signal, window_mm)?,
        })
    }
}

#[cfg(test)]
mod tests;
