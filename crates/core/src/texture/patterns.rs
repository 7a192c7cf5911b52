//! Patterns: strokes at constant speed and force, rendered at the same set of speeds and forces for every texture, so
//! that textures can be compared.
//!
//! The authoring paper is cited in [`crate::space::space_build`].

use std::fmt;

use crate::dsp::filter::resample;
use crate::maths::rng::derive_seed;
use crate::texture::blend::Mode;
use crate::texture::plane::{Plane, Prepared};
use crate::texture::rate::{AtRateError, at_rate};
use crate::texture::render::{RenderError, RenderPlan, render};
use crate::texture::{RATES_HZ, TextureModel};
use crate::units::{Contact, Hertz, MetersPerSecond, Newtons};

/// Tip speeds of the authoring paper's patterns, in mm/s.
pub const PAPER_SPEEDS_MM_PER_S: [f64; 5] = [50.0, 100.0, 150.0, 200.0, 250.0];
/// Normal forces of the authoring paper's patterns, in N.
pub const PAPER_FORCES_N: [f64; 5] = [0.1, 0.2, 0.3, 0.4, 0.5];

/// Tip speeds in the stroke recordings of the starter library, in mm/s.
pub const STARTER_SPEEDS_MM_PER_S: [f64; 5] = [30.0, 70.0, 120.0, 180.0, 250.0];
/// Normal forces in the stroke recordings of the starter library, in N.
pub const STARTER_FORCES_N: [f64; 5] = [0.15, 0.4, 0.8, 1.5, 3.0];
/// Duration of the authoring paper's patterns, in seconds.
pub const PAPER_SECS: f64 = 1.0;
/// Sample rate of the authoring paper's patterns.
pub const PAPER_RATE: Hertz = Hertz(1000.0);

/// Number of samples at each end of a downsampled pattern that are discarded, at the lower rate. Downsampling corrupts
/// 51 of them, the half-width of the kernel of [`resample`].
const N_SPOILT: usize = 64;

/// Settings for rendering patterns.
#[derive(Clone, Copy, Debug)]
pub struct PatternPlan<'a> {
    /// Speed and force of each pattern.
    pub contacts: &'a [Contact],
    /// Duration of each pattern in seconds.
    pub seconds: f64,
    /// Sample rate of the signals, within [`RATES_HZ`].
    pub rate: Hertz,
    /// Seed of all noise.
    pub seed: u64,
}

/// Patterns of one texture.
#[derive(Clone, Debug, PartialEq)]
pub struct Patterns {
    /// Acceleration in m/s² of each pattern, in the order of the plan; all have the same length.
    pub signals: Vec<Vec<f64>>,
    /// Warnings about deviations from the plan.
    pub warnings: Vec<PatternWarning>,
}

/// Deviation of the rendered patterns from the plan.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum PatternWarning {
    /// Some speeds or forces exceed the texture's range; they are clamped to its maximum.
    Clamped {
        /// Number of clamped patterns.
        n: usize,
        /// Number of all patterns.
        n_patterns: usize,
        /// Highest speed of the texture.
        speed_max: MetersPerSecond,
        /// Highest force of the texture.
        force_max: Newtons,
    },
    /// The model rate is higher than the rate of the patterns; content above the Nyquist frequency of the patterns is
    /// lost.
    HigherRate {
        /// Model rate.
        own: Hertz,
        /// Sample rate of the patterns.
        rate: Hertz,
    },
    /// The model rate is lower than the rate of the patterns; above the model's Nyquist frequency, the patterns have
    /// almost no content.
    LowerRate {
        /// Model rate.
        own: Hertz,
        /// Sample rate of the patterns.
        rate: Hertz,
    },
    /// Some patterns are silent; their features contain no other information.
    Silent {
        /// Number of silent patterns.
        n: usize,
        /// Number of all patterns.
        n_patterns: usize,
    },
}

impl fmt::Display for PatternWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Clamped { n, n_patterns, speed_max, force_max } => write!(
                f,
                "{n} of {n_patterns} patterns exceed the texture's range and are clamped to its maximum, {:.0} mm/s and \
                 {:.2} N",
                speed_max.mm_per_s(),
                force_max.0
            ),
            Self::HigherRate { own, rate } => write!(
                f,
                "the model rate is {own}; content above {} is lost in patterns at {rate}",
                Hertz(0.5 * rate.0)
            ),
            Self::LowerRate { own, rate } => write!(
                f,
                "the model rate is {own}; the texture has no content above {}, but patterns at {rate} extend beyond it",
                Hertz(0.5 * own.0)
            ),
            Self::Silent { n, n_patterns } => write!(f, "{n} of {n_patterns} patterns are silent"),
        }
    }
}

/// Error of rendering patterns.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PatternError {
    /// The plan has no speeds and forces.
    #[error("there are no patterns; give at least one speed and force")]
    None,
    /// A speed or force is negative or NaN.
    #[error("pattern {index} is at {speed_mps} m/s and {force_n} N; both must be zero or positive")]
    Contact {
        /// Index of the pattern.
        index: usize,
        /// Speed in m/s.
        speed_mps: f64,
        /// Force in N.
        force_n: f64,
    },
    /// The sample rate is not a valid model rate.
    #[error(
        "the sample rate of the patterns must lie between {} and {} Hz, got {rate_hz}",
        RATES_HZ.start(),
        RATES_HZ.end()
    )]
    Rate {
        /// Requested rate, in Hz.
        rate_hz: f64,
    },
    /// A model with a lower rate cannot be converted to the rate of the patterns.
    #[error("the texture cannot be converted to the rate of the patterns: {0}")]
    AtRate(#[from] AtRateError),
    /// A pattern cannot be rendered.
    #[error("the pattern at {} cannot be rendered: {source}", pattern_name(*contact))]
    Render {
        /// Speed and force of the pattern.
        contact: Contact,
        /// Underlying error.
        source: RenderError,
    },
}

/// All combinations of speeds (in mm/s) and forces (in N); the first speed with all forces comes first.
pub fn grid(speeds_mm_per_s: &[f64], forces_n: &[f64]) -> Vec<Contact> {
    let of_speed = |v: &f64| {
        let v = *v;
        forces_n.iter().map(move |f| Contact::from_mm_per_s_and_n(v, *f))
    };
    speeds_mm_per_s.iter().flat_map(of_speed).collect()
}

/// The 25 patterns of the authoring paper: [`PAPER_SPEEDS_MM_PER_S`] × [`PAPER_FORCES_N`].
pub fn paper_patterns() -> Vec<Contact> {
    grid(&PAPER_SPEEDS_MM_PER_S, &PAPER_FORCES_N)
}

/// The 25 patterns of the starter library's measurements: [`STARTER_SPEEDS_MM_PER_S`] × [`STARTER_FORCES_N`].
pub fn starter_patterns() -> Vec<Contact> {
    grid(&STARTER_SPEEDS_MM_PER_S, &STARTER_FORCES_N)
}

/// Name of a pattern for messages and tables: `120 mm/s, 0.8 N`.
pub fn pattern_name(contact: Contact) -> String {
    // Rounding to a thousandth of the unit avoids digits of rounding errors.
    let rounded = |x: f64| (x * 1e3).round() / 1e3;
    format!("{} mm/s, {} N", rounded(contact.speed.mm_per_s()), rounded(contact.force.0))
}

/// Renders the patterns of a texture. The noise of a pattern depends only on the seed of the plan and on the speed and
/// force of the pattern.
///
/// A model with a higher rate than the patterns is rendered at its own rate and downsampled. A model with a lower rate
/// is converted by [`at_rate`]. Speeds and forces beyond the texture's range are clamped.
///
/// # Errors
/// See [`PatternError`].
pub fn render_patterns(model: &TextureModel, plan: &PatternPlan<'_>) -> Result<Patterns, PatternError> {
    check(plan)?;
    let (own, rate) = (model.rate(), plan.rate);
    let mut warnings = Vec::new();
    if own.0 > rate.0 {
        warnings.push(PatternWarning::HigherRate { own, rate });
    }
    let prepared = if own.0 < rate.0 {
        warnings.push(PatternWarning::LowerRate { own, rate });
        Plane::new(&at_rate(model, rate)?.model).prepare()
    } else {
        Plane::new(model).prepare()
    };
    let n_patterns = plan.contacts.len();
    warnings.extend(clamped(model, plan.contacts));
    let signals = plan
        .contacts
        .iter()
        .map(|contact| {
            one(&prepared, *contact, plan)
                .map_err(|source| PatternError::Render { contact: *contact, source })
        })
        .collect::<Result<Vec<_>, PatternError>>()?;
    let n_silent = signals.iter().filter(|signal| signal.iter().all(|x| *x == 0.0)).count();
    if n_silent > 0 {
        warnings.push(PatternWarning::Silent { n: n_silent, n_patterns });
    }
    Ok(Patterns { signals, warnings })
}

/// Whether a pattern lies within the texture's speed and force range.
pub(crate) fn is_within(model: &TextureModel, contact: Contact) -> bool {
    // A maximum read from a file can differ from the requested speed by a rounding error.
    contact.speed.0 <= model.speed_max().0 * (1.0 + 1e-9)
        && contact.force.0 <= model.force_max().0 * (1.0 + 1e-9)
}

/// Warning about patterns beyond the texture's range, if any.
pub(crate) fn clamped(model: &TextureModel, contacts: &[Contact]) -> Option<PatternWarning> {
    let (speed_max, force_max, n_patterns) = (model.speed_max(), model.force_max(), contacts.len());
    let n = contacts.iter().filter(|contact| !is_within(model, **contact)).count();
    (n > 0).then_some(PatternWarning::Clamped { n, n_patterns, speed_max, force_max })
}

fn check(plan: &PatternPlan<'_>) -> Result<(), PatternError> {
    if plan.contacts.is_empty() {
        return Err(PatternError::None);
    }
    // NaN fails this comparison.
    let is_contact = |c: &Contact| c.speed.0 >= 0.0 && c.force.0 >= 0.0;
    if let Some(index) = plan.contacts.iter().position(|c| !is_contact(c)) {
        let contact = plan.contacts[index];
        return Err(PatternError::Contact { index, speed_mps: contact.speed.0, force_n: contact.force.0 });
    }
    if RATES_HZ.contains(&plan.rate.0) { Ok(()) } else { Err(PatternError::Rate { rate_hz: plan.rate.0 }) }
}

/// Renders one pattern; the renderer clamps contacts beyond the texture's range.
fn one(prepared: &Prepared, contact: Contact, plan: &PatternPlan<'_>) -> Result<Vec<f64>, RenderError> {
    let own = Hertz(f64::from(prepared.rate_hz()));
    let n_samples = (plan.seconds * plan.rate.0).round() as usize;
    let seed = derive_seed(plan.seed, &pattern_name(contact));
    let rendered = |seconds: f64| {
        let parents = [(prepared, 1.0)];
        let render_plan = RenderPlan { parents: &parents, mode: Mode::Paper, rate: own, seconds, seed };
        let samples = render(&render_plan, &mut |_: f64| contact)?;
        Ok(samples.into_iter().map(f64::from).collect::<Vec<f64>>())
    };
    if own.0 <= plan.rate.0 {
        return rendered(plan.seconds);
    }
    let longer = rendered(plan.seconds + (2 * N_SPOILT) as f64 / plan.rate.0)?;
    let lower = resample(&longer, own, plan.rate);
    Ok(lower.into_iter().skip(N_SPOILT).take(n_samples).collect())
}

#[cfg(test)]
mod tests;
