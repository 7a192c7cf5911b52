//! A texture in the making: recordings, how to fit them, and what came of it.

use std::ops::RangeInclusive;
use std::sync::Arc;

use shagreen_core::fit::{FitOptions, Fitted, MODEL_RATES_HZ, highest_order};
use shagreen_core::units::Hertz;
use shagreen_formats::library::TextureEntry;

use crate::strings::import as strings;

/// Lowest order that can be chosen.
const LOWEST_ORDER: usize = 2;

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
            options: FitOptions::usual(),
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

    /// Asks for a rate in Hz, or leaves it to the recordings. An order that the rate does not take is left to the
    /// recordings.
    pub fn set_rate_hz(&mut self, rate_hz: Option<f64>) {
        self.options.rate = rate_hz.map(Hertz);
        if let Some(rate_hz) = rate_hz {
            self.options.order = self.options.order.filter(|order| *order <= highest_order(Hertz(rate_hz)));
        }
    }

    /// Orders that can be asked for at the rate that was asked for, or else that the recordings led to. As long as that
    /// is not known, those that every rate takes.
    pub(super) fn orders(&self) -> RangeInclusive<usize> {
        let rate_hz = self.rate_hz().or(self.fitted().map(|fitted| fitted.report.rate.0));
        LOWEST_ORDER..=highest_order(Hertz(rate_hz.unwrap_or(MODEL_RATES_HZ[0])))
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

#[cfg(test)]
mod tests {
    use super::Draft;
    use shagreen_core::texture::MAX_ORDER;

    #[test]
    fn orders_follow_the_rate() {
        let mut draft = Draft::new(1, "Cork".to_owned(), vec![]);
        assert_eq!(draft.orders(), 2..=20);
        draft.set_rate_hz(Some(4000.0));
        assert_eq!(draft.orders(), 2..=MAX_ORDER);
        draft.options.order = Some(MAX_ORDER);
        draft.set_rate_hz(Some(2000.0));
        assert_eq!(draft.options.order, Some(MAX_ORDER));
        draft.set_rate_hz(Some(1000.0));
        assert_eq!(draft.options.order, None);
    }
}
