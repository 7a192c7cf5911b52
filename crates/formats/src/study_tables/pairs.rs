//! Discriminated pairs as a table: what the fit of a model of quality reads.

use shagreen_core::people::study::analysis::discrimination::{
    Discriminability, Discrimination, discriminability, discriminations,
};
use shagreen_core::people::study::answer::Record;
use shagreen_core::people::study::plan::{Design, Part, Plan, Source, Variant};
use shagreen_core::people::study::same_different::{Correction, Counts};

use super::{flag, number};
use crate::named_table::write_table;

/// Columns of the table.
const COLUMNS: [&str; 20] = [
    "part",
    "reference",
    "processed",
    "reference_source",
    "processed_source",
    "variant",
    "kbps",
    "window_mm",
    "simulated",
    "participants",
    "n_different",
    "hits",
    "n_same",
    "false_alarms",
    "hit_rate",
    "false_alarm_rate",
    "dprime",
    "dprime_differencing",
    "dprime_independent_observation",
    "correction",
];

/// Writes the answers to all same-different pairs of a study, all participants together: one row for each pair. `None` if no part
/// asks for same or different. The columns are:
///
/// | column | content |
/// |---|---|
/// | `part` | part of the study |
/// | `reference`, `processed` | identifiers of the two stimuli |
/// | `reference_source`, `processed_source` | texture or profile of which each is made |
/// | `variant`, `kbps`, `window_mm` | what was done to the processed one: original, authored, coded (bit rate in kbit/s) or reconstructed (window in mm) |
/// | `simulated` | 1 if the participants are simulated |
/// | `participants` | number of participants with answers to this pair |
/// | `n_different`, `hits` | number of trials with both stimuli, and of answers "different" to them |
/// | `n_same`, `false_alarms` | number of trials with the reference twice, and of answers "different" to them |
/// | `hit_rate`, `false_alarm_rate` | rates after the correction |
/// | `dprime` | z(hit rate) - z(false-alarm rate), as published |
/// | `dprime_differencing`, `dprime_independent_observation` | by the other two models of the observer |
/// | `correction` | correction of the rates: `log-linear` adds half an answer of each kind |
///
/// A field is empty if it does not exist: a bit rate of an original, or a rate without trials.
pub fn pairs_csv(plan: &Plan, records: &[Record]) -> Option<Vec<u8>> {
    let is_asked = |part: &&Part| matches!(part.design, Design::SameDifferent { .. });
    let parts: Vec<&Part> = plan.parts.iter().filter(is_asked).collect();
    if parts.is_empty() {
        return None;
    }
    let first = COLUMNS.map(str::to_owned).to_vec();
    let is_simulated = records.iter().any(|record| record.is_simulated);
    let of_part = |part: &Part| -> Vec<Vec<String>> {
        discriminations(part, records).iter().map(|of| row(plan, part, of, is_simulated)).collect()
    };
    Some(write_table(std::iter::once(first).chain(parts.into_iter().flat_map(of_part))))
}

fn row(plan: &Plan, part: &Part, of: &Discrimination, is_simulated: bool) -> Vec<String> {
    let source = |id: &str| match plan.stimulus(id).map(|stimulus| &stimulus.source) {
        Some(Source::Texture(name) | Source::Profile(name)) => name.clone(),
        None => String::new(),
    };
    let (variant, kbps, window_mm) = match plan.stimulus(&of.pair.second).map(|stimulus| stimulus.variant) {
        Some(Variant::Original) => ("original", None, None),
        Some(Variant::Authored) => ("authored", None, None),
        Some(Variant::Coded { kbps }) => ("coded", Some(kbps), None),
        Some(Variant::Reconstructed { window_mm }) => ("reconstructed", None, Some(window_mm)),
        None => ("", None, None),
    };
    let Counts { hits, n_different, false_alarms, n_same } = of.pooled;
    let rates = of.pooled.rates(Correction::LogLinear);
    let models = discriminability(of.pooled, Correction::LogLinear);
    let model = |value: fn(Discriminability) -> f64| number(models.map(value));
    vec![
        part.id.clone(),
        of.pair.first.clone(),
        of.pair.second.clone(),
        source(&of.pair.first),
        source(&of.pair.second),
        variant.to_owned(),
        number(kbps),
        number(window_mm),
        flag(is_simulated),
        of.by_participant.len().to_string(),
        n_different.to_string(),
        hits.to_string(),
        n_same.to_string(),
        false_alarms.to_string(),
        number(rates.map(|rates| rates.hit)),
        number(rates.map(|rates| rates.false_alarm)),
        model(|models| models.yes_no),
        model(|models| models.differencing),
        model(|models| models.independent_observation),
        rates.map_or("", |_| "log-linear").to_owned(),
    ]
}
