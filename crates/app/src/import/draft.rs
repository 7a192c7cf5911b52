//! A texture in the making: recordings, how to fit them, and what came of it.

use std::sync::Arc;

use shagreen_core::fit::{FitOptions, Fitted};
use shagreen_core::texture::{Interpolation, MAX_ORDER};
use shagreen_core::units::Hertz;
use shagreen_formats::library::TextureEntry;

use crate::strings::import as strings;

/// Rates that can be chosen, in Hz; without one the recordings decide.
pub(super) const RATES_HZ: [f64; 3] = [1000.0, 2000.0, 4000.0];

/// Orders that can be chosen.
pub(super) const ORDERS: std::ops::RangeInclusive<usize> = 2..=MAX_ORDER;

/// A texture in the making.
#[derive(Clone, Debug)]
pub struct Draft {
    /// Tells it from the others.
    pub(super) id: u64,
    /// Its name.
    pub name: String,
    /// Words to search by, parted by commas.
    pub tags: String,
    /// How to fit it.
    pub options: FitOptions,
    /// The recordings it is fitted to, as far as they can be read.
    pub(super) files: Vec<u64>,
    /// Goes up with every fit that is asked for: results of earlier ones are stale.
    pub(super) generation: u64,
    /// What came of the last fit.
    pub fit: FitState,
    /// The segment whose spectrum is shown.
    pub segment: usize,
}

/// How far a fit is.
#[derive(Clone, Debug)]
pub enum FitState {
    /// There is nothing to fit yet.
    Nothing,
    /// It is on its way.
    Working,
    /// It is done; the recordings are those of the segments, by their place.
    Done(Arc<Fitted>),
    /// It cannot be done, and why.
    Failed(String),
}

impl Draft {
    pub(super) fn new(id: u64, name: String, files: Vec<u64>) -> Self {
        Self {
            id,
            name,
            tags: String::new(),
            options: FitOptions { rate: None, order: None, interpolation: Interpolation::Barycentric },
            files,
            generation: 0,
            fit: FitState::Nothing,
            segment: 0,
        }
    }

    /// What came of the fit, where it is done.
    pub fn fitted(&self) -> Option<&Fitted> {
        match &self.fit {
            FitState::Done(fitted) => Some(fitted),
            _ => None,
        }
    }

    /// The rate that was asked for, in Hz.
    pub fn rate_hz(&self) -> Option<f64> {
        self.options.rate.map(|rate| rate.0)
    }

    /// Asks for a rate in Hz, or leaves it to the recordings.
    pub fn set_rate_hz(&mut self, rate_hz: Option<f64>) {
        self.options.rate = rate_hz.map(Hertz);
    }

    /// The texture as an entry of a library, which says what it was made of; `None` where it is not fitted.
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
