//! Same-different answers: d′ of each pair.

use serde_json::{Map, Value, json};
use shagreen_core::maths::hypothesis_tests::intervals::{Confidence, mean_interval};
use shagreen_core::people::study::analysis::Cells;
use shagreen_core::people::study::analysis::discrimination::{
    Discrimination, discriminability, discriminations,
};
use shagreen_core::people::study::answer::Record;
use shagreen_core::people::study::plan::Part;
use shagreen_core::people::study::same_different::{Correction, Counts, d_prime};
use shagreen_formats::figure::{Figure, Table};

use super::scales::measured;
use super::values::interval;
use super::{Analyzed, Measure};

/// d′ of each pair of a part, of all answers together and of each participant.
pub(super) fn analyze(part: &Part, records: &[Record]) -> Analyzed {
    let pairs = discriminations(part, records);
    let measure = Measure::of("d' of the participants", "standard deviations", cells(&pairs, records));
    let by_name: Map<String, Value> = pairs.iter().map(|of| (of.pair.name(), json_of(of))).collect();
    let mut analyzed = measured(&[measure]);
    analyzed.findings.insert(0, finding(&pairs));
    analyzed.results.insert("pairs".to_owned(), Value::Object(by_name));
    analyzed.results.insert("correction".to_owned(), json!("log-linear"));
    analyzed.figures.insert(0, ("d' table".to_owned(), Figure::Table(table(&pairs))));
    analyzed
}

fn finding(pairs: &[Discrimination]) -> String {
    let of_pair = |of: &Discrimination| {
        let value = d_prime(of.pooled, Correction::LogLinear)?;
        Some(format!("{} {value:.2}", of.pair.name()))
    };
    let all: Vec<String> = pairs.iter().filter_map(of_pair).collect();
    if all.is_empty() {
        return "No pair has answers to both kinds of trials.".to_owned();
    }
    format!("d' of all answers together: {}.", all.join(", "))
}

fn json_of(of: &Discrimination) -> Value {
    let models = discriminability(of.pooled, Correction::LogLinear);
    let rates = of.pooled.rates(Correction::LogLinear);
    let each: Vec<f64> =
        of.by_participant.iter().filter_map(|(_, counts)| d_prime(*counts, Correction::LogLinear)).collect();
    let over_people = mean_interval(&each, Confidence::NINETY_FIVE);
    // Equal values do not tell their spread.
    let bounds = over_people.filter(|of| of.half_width > 0.0).map(|of| of.interval);
    let person = |(name, counts): &(String, Counts)| {
        let mut value = counts_json(*counts);
        value["dprime"] = json!(d_prime(*counts, Correction::LogLinear));
        (name.clone(), value)
    };
    let mut value = counts_json(of.pooled);
    value["hit_rate"] = json!(rates.map(|rates| rates.hit));
    value["false_alarm_rate"] = json!(rates.map(|rates| rates.false_alarm));
    value["dprime"] = json!(models.map(|models| models.yes_no));
    value["dprime_clipped"] = json!(d_prime(of.pooled, Correction::Clipped));
    value["dprime_differencing"] = json!(models.map(|models| models.differencing));
    value["dprime_independent_observation"] = json!(models.map(|models| models.independent_observation));
    value["mean_dprime"] = json!(over_people.map(|of| of.mean));
    value["mean_dprime_interval_95"] = json!(bounds.map(interval));
    value["participants"] = of.by_participant.iter().map(person).collect::<Map<String, Value>>().into();
    value
}

fn counts_json(counts: Counts) -> Value {
    let Counts { hits, n_different, false_alarms, n_same } = counts;
    json!({"hits": hits, "n_different": n_different, "false_alarms": false_alarms, "n_same": n_same})
}

/// d′ of each participant and pair.
fn cells(pairs: &[Discrimination], records: &[Record]) -> Cells {
    let participants: Vec<String> = records.iter().map(|record| record.participant.clone()).collect();
    let counts = |name: &String, of: &Discrimination| {
        of.by_participant.iter().find(|(participant, _)| participant == name).map(|(_, counts)| *counts)
    };
    let value = |name: &String, of: &Discrimination| d_prime(counts(name, of)?, Correction::LogLinear);
    let n = |name: &String, of: &Discrimination| {
        counts(name, of).map_or(0, |counts| (counts.n_different + counts.n_same) as usize)
    };
    Cells {
        values: participants.iter().map(|name| pairs.iter().map(|of| value(name, of)).collect()).collect(),
        n_answers: participants.iter().map(|name| pairs.iter().map(|of| n(name, of)).collect()).collect(),
        columns: pairs.iter().map(|of| of.pair.name()).collect(),
        participants,
    }
}

fn table(pairs: &[Discrimination]) -> Table {
    let row = |of: &Discrimination| {
        let rates = of.pooled.rates(Correction::LogLinear);
        let models = discriminability(of.pooled, Correction::LogLinear);
        let numbers = vec![
            rates.map(|rates| rates.hit),
            rates.map(|rates| rates.false_alarm),
            models.map(|models| models.yes_no),
            models.map(|models| models.differencing),
            models.map(|models| models.independent_observation),
        ];
        (of.pair.name(), numbers)
    };
    Table {
        title: "Rates, and d' by three models of the observer".to_owned(),
        columns: ["hits", "false alarms", "d'", "differencing", "independent"].map(str::to_owned).to_vec(),
        rows: pairs.iter().map(row).collect(),
        decimals: 2,
        n_counts: 0,
        source: String::new(),
    }
}
