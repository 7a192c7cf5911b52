//! Texture being fitted: its recordings, the options of the fit, and its result.

use std::ops::RangeInclusive;
use std::sync::Arc;

use shagreen_core::recording::fit::{FitOptions, Fitted};
use shagreen_core::texture::MAX_ORDER;
use shagreen_core::units::Hertz;
use shagreen_formats::library::TextureEntry;

use crate::strings::import as strings;

/// Model orders that can be chosen.
pub(super) const ORDERS: RangeInclusive<usize> = 2..=MAX_ORDER;

/// Texture that is being fitted to recordings.
#[derive(Clone, Debug)]
pub struct Draft {
    /// Unique id.
    pub(super) id: u64,
    /// Name of the texture.
    pub name: String,
    /// Tags, separated by commas.
    pub tags: String,
    /// Options of the fit.
    pub options: FitOptions,
    /// Ids of the recordings that the texture is fitted to, if they can be read.
    pub(super) files: Vec<u64>,
    /// Increases with every requested fit: results of earlier ones are stale.
    pub(super) generation: u64,
    /// State of the last fit.
    pub fit: FitState,
    /// Whether that fit has the rate of the space instead of a higher automatic one.
    pub(super) is_lowered: bool,
    /// Index of the segment whose spectrum is shown.
    pub segment: usize,
}

/// State of a fit.
#[derive(Clone, Debug)]
pub enum FitState {
    /// There is nothing to fit yet.
    Nothing,
    /// The fit is running.
    Working,
    /// The fit is done; its segments refer to recordings by index.
    Done(Arc<Fitted>),
    /// The fit failed, with the reason.
    Failed(String),
}

impl Draft {
    pub(super) fn new(id: u64, name: String, files: Vec<u64>) -> Self {
        Self {
            id,
            name,
            tags: String::new(),
            options: FitOptions::usual(),
            files,
            generation: 0,
            fit: FitState::Nothing,
            is_lowered: false,
            segment: 0,
        }
    }

    /// Whether an automatic rate is above this one, in Hz.
    pub(super) fn exceeds(&self, rate_hz: f64) -> bool {
        self.options.rate.is_none() && self.fitted().is_some_and(|fitted| fitted.report.rate.0 > rate_hz)
    }

    /// Result of the fit, once it is done.
    pub fn fitted(&self) -> Option<&Fitted> {
        match &self.fit {
            FitState::Done(fitted) => Some(fitted),
            _ => None,
        }
    }

    /// Requested sample rate, in Hz.
    pub fn rate_hz(&self) -> Option<f64> {
        self.options.rate.map(|rate| rate.0)
    }

    /// Requests a sample rate in Hz; `None` determines it from the recordings.
    pub fn set_rate_hz(&mut self, rate_hz: Option<f64>) {
        self.options.rate = rate_hz.map(Hertz);
    }

    /// Library entry of the texture, with its recordings as origin; `None` if it is not fitted.
    pub(super) fn entry(&self, id: String, recordings: &[&str]) -> Option<TextureEntry> {
        let fitted = self.fitted()?;
        let tags = self.tags.split(',').map(str::trim).filter(|tag| !tag.is_empty());
        Some(TextureEntry {
            tags: tags.map(str::to_owned).collect(),
            license: strings::TERMS_NOT_STATED.to_owned(),
            origin: strings::fitted_to(recordings),
            description: strings::fit_in_words(&fitted.report),
            ..TextureEntry::new(id, self.name.trim(), fitted.model.clone())
        })
    }
}
