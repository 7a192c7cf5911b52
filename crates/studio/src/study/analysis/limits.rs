//! What limits the answers, in words, as JSON, and as a table for the page of figures.

use serde_json::{Map, Value, json};
use shagreen_core::people::study::analysis::limits::{Limit, Limited};
use shagreen_core::words::counted;
use shagreen_formats::figure::{Figure, Table};

/// Sentence about answers under a limit: what it means, and how many there are.
pub(super) fn warning(limited: &Limited) -> String {
    let meaning = match limited.limit {
        Limit::Simulated => "the participants are SIMULATED: the answers say nothing about people",
        Limit::UnknownDevices => {
            "the log does not state output, actuator, masking noise and scale of the screen: check them in your notes"
        }
        Limit::Silent => "the output was silent: nothing was felt",
        Limit::NoActuator => {
            "no actuator profile was selected: the level and the spectrum of the stimuli are not known"
        }
        Limit::NoMasking => {
            "the plan asks for masking noise, but no output played it: the actuator may have been heard"
        }
        Limit::AssumedScale => "the screen was not calibrated: the length of the sliders is not known",
        Limit::NoTouch => "the trial was answered without a touch (distance 0)",
        Limit::ShortTouch => "the tip moved less over a stimulus than the plan requires (`touch_mm`)",
    };
    format!("{meaning} ({})", count(limited))
}

fn count(limited: &Limited) -> String {
    format!(
        "{} of {}",
        counted(limited.n_answers, "answer"),
        counted(limited.participants.len(), "participant")
    )
}

/// Counts of the answers under each limit, by its identifier.
pub(super) fn json(limited: &[Limited]) -> Value {
    let of_limit = |of: &Limited| {
        (of.limit.id().to_owned(), json!({"answers": of.n_answers, "participants": of.participants}))
    };
    limited.iter().map(of_limit).collect::<Map<String, Value>>().into()
}

/// Table of the limits; `None` without any.
pub(super) fn figure(limited: &[Limited]) -> Option<Figure> {
    if limited.is_empty() {
        return None;
    }
    let row = |of: &Limited| {
        let numbers = vec![Some(of.participants.len() as f64), Some(of.n_answers as f64)];
        (name(of.limit).to_owned(), numbers)
    };
    Some(Figure::Table(Table {
        title: "Answers that say less than they seem to".to_owned(),
        columns: ["participants", "answers"].map(str::to_owned).to_vec(),
        rows: limited.iter().map(row).collect(),
        decimals: 0,
        n_counts: 2,
        source: String::new(),
    }))
}

/// Short name of a limit, for a row of a table.
fn name(limit: Limit) -> &'static str {
    match limit {
        Limit::Simulated => "SIMULATED participants",
        Limit::UnknownDevices => "devices not stated",
        Limit::Silent => "silent output",
        Limit::NoActuator => "no actuator profile",
        Limit::NoMasking => "no masking noise",
        Limit::AssumedScale => "screen not calibrated",
        Limit::NoTouch => "answered without touch",
        Limit::ShortTouch => "touched too little",
    }
}
