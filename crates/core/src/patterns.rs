//! Patterns: the signals that textures are compared by, the same strokes of one speed and one force over each of them.

use std::fmt;

use crate::blend::Mode;
use crate::filter::resample;
use crate::plane::{Plane, Prepared};
use crate::rate::{AtRateError, at_rate};
use crate::render::{RenderError, RenderPlan, render};
use crate::rng::derive_seed;
use crate::starter;
use crate::texture::{RATES_HZ, TextureModel};
use crate::units::{Contact, Hertz, MetersPerSecond, Newtons};

/// Speeds of the authoring paper's patterns, in mm/s.
pub const PAPER_SPEEDS_MM_PER_S: [f64; 5] = [50.0, 100.0, 150.0, 200.0, 250.0];
/// Forces of the authoring paper's patterns, in N.
pub const PAPER_FORCES_N: [f64; 5] = [0.1, 0.2, 0.3, 0.4, 0.5];
/// Length of the authoring paper's patterns in seconds.
pub const PAPER_SECS: f64 = 1.0;
/// Rate of the authoring paper's patterns.
pub const PAPER_RATE: Hertz = Hertz(1000.0);

/// Samples at the ends of a pattern that a lower rate would spoil, at that rate: the kernel of
/// [`resample`] reaches 51 of them.
const N_SPOILT: usize = 64;

/// What to stroke.
#[derive(Clone, Copy, Debug)]
pub struct PatternPlan<'a> {
    /// Speed and force of each pattern.
    pub contacts: &'a [Contact],
    /// Length of each pattern in seconds.
    pub seconds: f64,
    /// Rate of the signals, within [`RATES_HZ`].
    pub rate: Hertz,
    /// Seed of all noise.
    pub seed: u64,
}

/// The patterns of one texture.
#[derive(Clone, Debug, PartialEq)]
pub struct Patterns {
    /// Acceleration in m/s² of each pattern, in the order of the plan; all are equally long.
    pub signals: Vec<Vec<f64>>,
    /// What is not quite as asked.
    pub warnings: Vec<PatternWarning>,
}

/// What is not quite as asked.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum PatternWarning {
    /// The texture is not known at some speeds or forces: those patterns are stroked at its highest.
    Clamped {
        /// How many.
        n: usize,
        /// Of how many.
        n_patterns: usize,
        /// The highest speed of the texture.
        speed_max: MetersPerSecond,
        /// The highest force of the texture.
        force_max: Newtons,
    },
    /// The model has a higher rate: what it has above half of the rate of the patterns cannot count.
    HigherRate {
        /// Rate of the model.
        own: Hertz,
        /// Rate of the patterns.
        rate: Hertz,
    },
    /// The model has a lower rate: above half of that it says nothing, and the patterns have next to nothing.
    LowerRate {
        /// Rate of the model.
        own: Hertz,
        /// Rate of the patterns.
        rate: Hertz,
    },
    /// The texture is silent at some speeds and forces: features of those say so and nothing else.
    Silent {
        /// How many.
        n: usize,
        /// Of how many.
        n_patterns: usize,
    },
}

impl fmt::Display for PatternWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Clamped { n, n_patterns, speed_max, force_max } => write!(
                f,
                "{n} of {n_patterns} patterns lie beyond the texture and are stroked at its highest, {:.0} mm/s and \
                 {:.2} N",
                speed_max.mm_per_s(),
                force_max.0
            ),
            Self::HigherRate { own, rate } => write!(
                f,
                "the model has a rate of {own}; what it has above {} does not count at {rate}",
                Hertz(0.5 * rate.0)
            ),
            Self::LowerRate { own, rate } => write!(
                f,
                "the model has a rate of {own} and says nothing above {}, where patterns at {rate} are compared too",
                Hertz(0.5 * own.0)
            ),
            Self::Silent { n, n_patterns } => write!(f, "{n} of {n_patterns} patterns are silent"),
        }
    }
}

/// Why a texture has no patterns.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PatternError {
    /// There are no speeds and forces.
    #[error("there are no patterns; name at least one speed and force")]
    None,
    /// A speed or force is negative or no number.
    #[error("pattern {index} is at {speed_mps} m/s and {force_n} N; neither may be negative")]
    Contact {
        /// Index of the pattern.
        index: usize,
        /// Its speed in m/s.
        speed_mps: f64,
        /// Its force in N.
        force_n: f64,
    },
    /// The rate is none that a model can have.
    #[error(
        "the rate of patterns must lie between {} and {} Hz, got {rate_hz}",
        RATES_HZ.start(),
        RATES_HZ.end()
    )]
    Rate {
        /// The rate asked for.
        rate_hz: f64,
    },
    /// A model of a lower rate cannot be had at that of the patterns.
    #[error("the texture cannot be had at the rate of the patterns: {0}")]
    AtRate(#[from] AtRateError),
    /// A pattern cannot be rendered.
    #[error("the pattern at {} cannot be rendered: {source}", pattern_name(*contact))]
    Render {
        /// Speed and force of the pattern.
        contact: Contact,
        /// Why.
        source: RenderError,
    },
}

/// Every speed (in mm/s) with every force (in N), all forces of the first speed first.
pub fn grid(speeds_mm_per_s: &[f64], forces_n: &[f64]) -> Vec<Contact> {
    let of_speed = |v: &f64| {
        let v = *v;
        forces_n.iter().map(move |f| Contact::from_mm_per_s_and_n(v, *f))
    };
    speeds_mm_per_s.iter().flat_map(of_speed).collect()
}

/// The 25 patterns of the authoring paper: [`PAPER_SPEEDS_MM_PER_S`] with [`PAPER_FORCES_N`].
pub fn paper_patterns() -> Vec<Contact> {
    grid(&PAPER_SPEEDS_MM_PER_S, &PAPER_FORCES_N)
}

/// The 25 patterns at which the textures of the starter library are known: [`starter::SPEEDS_MM_PER_S`] with
/// [`starter::FORCES_N`].
pub fn starter_patterns() -> Vec<Contact> {
    grid(&starter::SPEEDS_MM_PER_S, &starter::FORCES_N)
}

/// A pattern as people name it: `120 mm/s, 0.8 N`.
pub fn pattern_name(contact: Contact) -> String {
    // A thousandth of the unit is finer than any hand; more digits would be those of rounding.
    let rounded = |x: f64| (x * 1e3).round() / 1e3;
    format!("{} mm/s, {} N", rounded(contact.speed.mm_per_s()), rounded(contact.force.0))
}

/// The patterns of a texture, each with noise of its own that follows from the seed and the speed and force.
///
/// A model of a higher rate is rendered at its own and brought down; one of a lower rate is brought up by
/// [`at_rate`]. Speeds and forces beyond the texture count as its highest.
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

/// Whether a pattern lies within what is known of a texture.
pub(crate) fn is_within(model: &TextureModel, contact: Contact) -> bool {
    // A highest speed that was read from a file may differ from the one asked for by a rounding.
    contact.speed.0 <= model.speed_max().0 * (1.0 + 1e-9)
        && contact.force.0 <= model.force_max().0 * (1.0 + 1e-9)
}

/// What is to be said where patterns lie beyond a texture.
pub(crate) fn clamped(model: &TextureModel, contacts: &[Contact]) -> Option<PatternWarning> {
    let (speed_max, force_max, n_patterns) = (model.speed_max(), model.force_max(), contacts.len());
    let n = contacts.iter().filter(|contact| !is_within(model, **contact)).count();
    (n > 0).then_some(PatternWarning::Clamped { n, n_patterns, speed_max, force_max })
}

fn check(plan: &PatternPlan<'_>) -> Result<(), PatternError> {
    if plan.contacts.is_empty() {
        return Err(PatternError::None);
    }
    // A number that is none is not at least zero.
    let is_contact = |c: &Contact| c.speed.0 >= 0.0 && c.force.0 >= 0.0;
    if let Some(index) = plan.contacts.iter().position(|c| !is_contact(c)) {
        let contact = plan.contacts[index];
        return Err(PatternError::Contact { index, speed_mps: contact.speed.0, force_n: contact.force.0 });
    }
    if RATES_HZ.contains(&plan.rate.0) { Ok(()) } else { Err(PatternError::Rate { rate_hz: plan.rate.0 }) }
}

/// One pattern; the renderer holds what lies beyond the texture at its highest.
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
