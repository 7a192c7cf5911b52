//! Plans of studies: what is presented, what is asked, in which order.
//!
//! A [`Plan`] is data that a person writes. [`problems()`] lists everything that is wrong with it at once. Stimuli are named by
//! identifiers, which participants never see. What a texture of this name is, the caller knows.

mod design;
mod problems;

pub use design::{Comparison, Condition, Design, MushraPage, Prompts, ShownControls, Statement, Varied};
pub use problems::{MAX_PARTS, MAX_STIMULI, PlanError, Problem, check_plan, missing_sources, problems};

use crate::people::study::order::Order;

/// A study.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Name for display.
    pub name: String,
    /// Purpose, sources, notes for the experimenter.
    pub description: String,
    /// Text to which a participant agrees before the first trial; empty if the study asks for no consent.
    pub consent: String,
    /// Seed of all orders and of the noise in stimuli, up to 2⁶³ - 1.
    pub seed: u64,
    /// Order of the parts.
    pub part_order: Order,
    /// Noise that masks the sound of the actuator, on a second output.
    pub masking_noise: Option<MaskingNoise>,
    /// Everything that is presented.
    pub stimuli: Vec<Stimulus>,
    /// The parts, each with one design.
    pub parts: Vec<Part>,
}

/// Noise in the headphones of a participant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MaskingNoise {
    /// Spectrum of the noise.
    pub color: NoiseColor,
    /// Level relative to the full scale of the output, in dB, 0 or less.
    pub level_db: f64,
}

/// Spectrum of a noise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoiseColor {
    /// Equal power in each hertz.
    White,
    /// Equal power in each octave.
    Pink,
}

/// Something that participants feel.
#[derive(Clone, Debug, PartialEq)]
pub struct Stimulus {
    /// Identifier in the plan and in all tables.
    pub id: String,
    /// Where it comes from.
    pub source: Source,
    /// What was done with it.
    pub variant: Variant,
    /// Change of its level, in dB.
    pub level_db: f64,
}

/// Origin of a stimulus.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// Texture with this identifier in the library or the project.
    Texture(String),
    /// Profile over the position with this name, such as a texture of the study on spatial spectrograms.
    Profile(String),
}

/// Version of a texture or profile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Variant {
    /// As it is.
    Original,
    /// Authored at the position of the texture from the other textures of the library.
    Authored,
    /// Decoded from the texture codec at this bit rate.
    Coded {
        /// Bit rate in kbit/s.
        kbps: f64,
    },
    /// Reconstructed from a spatial spectrogram with this window.
    Reconstructed {
        /// Width of the window in mm.
        window_mm: f64,
    },
}

/// A part of a study: one design with its order, repeats, practice and breaks.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Identifier in tables.
    pub id: String,
    /// Heading that participants see; empty for the identifier.
    pub title: String,
    /// Text that participants read before the part.
    pub instructions: String,
    /// What is asked.
    pub design: Design,
    /// Order of the trials.
    pub order: Order,
    /// How often each comparison is presented; for a staircase, the number of staircases one after the other.
    pub n_repeats: usize,
    /// Number of trials at the beginning whose answers are not analyzed.
    pub n_practice: usize,
    /// Number of trials after which a break is offered, without practice.
    pub break_every: Option<usize>,
    /// How often each stimulus of a trial can be started; `None` for any number of times.
    pub max_plays: Option<u32>,
    /// Distance in mm that the tip must move over each stimulus before the trial can be answered
    /// ([`crate::people::study::touch`]); `None` if no touch is required.
    pub touch_mm: Option<f64>,
    /// Times of presentation.
    pub timing: Timing,
}

/// Distance of [`Part::touch_mm`] unless a plan states another one, in mm. It is ours: a short stroke.
pub const USUAL_TOUCH_MM: f64 = 20.0;

/// Times of presentation of the stimuli of a trial, in s.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Timing {
    /// Time between the start of a trial and the first stimulus.
    pub lead_secs: f64,
    /// Time after which a stimulus stops; `None` if participants explore as long as they want.
    pub stimulus_secs: Option<f64>,
    /// Time between two stimuli that follow each other.
    pub gap_secs: f64,
    /// Shortest time between an answer and the next trial.
    pub pause_secs: f64,
}

impl Plan {
    /// Stimulus with this identifier.
    pub fn stimulus(&self, id: &str) -> Option<&Stimulus> {
        self.stimuli.iter().find(|stimulus| stimulus.id == id)
    }

    /// Part with this identifier.
    pub fn part(&self, id: &str) -> Option<&Part> {
        self.parts.iter().find(|part| part.id == id)
    }

    /// Name of a stimulus in tables from which a space is built: the texture's, if the stimulus is this texture unchanged, else
    /// its own identifier.
    pub fn texture_name<'a>(&'a self, id: &'a str) -> &'a str {
        match self.stimulus(id) {
            Some(Stimulus {
                source: Source::Texture(name),
                variant: Variant::Original,
                level_db: 0.0,
                ..
            }) => name.as_str(),
            _ => id,
        }
    }
}

#[cfg(test)]
mod tests;
