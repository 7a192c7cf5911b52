//! Staircases: thresholds of the participants, from the last reversals.

use serde_json::{Value, json};
use shagreen_core::maths::hypothesis_tests::intervals::{Confidence, Interval, MeanInterval, mean_interval};
use shagreen_core::people::study::analysis::thresholds::{Track, threshold_cells, tracks};
use shagreen_core::people::study::answer::Record;
use shagreen_core::people::study::plan::{Design, Part};
use shagreen_core::words::counted;
use shagreen_formats::figure::{Chart, Figure, Mark, Point, Scale, Series, Table, Tone};

use super::Analyzed;
use super::values::interval;

/// Number of staircases that a chart shows, each in its own color.
const N_SHOWN: usize = 4;
const TONES: [Tone; N_SHOWN] = [Tone::Main, Tone::Second, Tone::Third, Tone::Fourth];

/// Thresholds of a part, and their mean over the participants.
pub(super) fn analyze(part: &Part, records: &[Record]) -> Analyzed {
    let Design::Staircase { varied, rule, .. } = &part.design else { return Analyzed::default() };
    let unit = varied.unit();
    let found = tracks(part, records);
    let values = threshold_cells(part, records).column(0);
    let logs: Vec<f64> = values.iter().map(|value| value.ln()).collect();
    let arithmetic = mean_interval(&values, Confidence::NINETY_FIVE);
    let geometric =
        mean_interval(&logs, Confidence::NINETY_FIVE).map(|MeanInterval { mean, interval, .. }| {
            (mean.exp(), Interval { low: interval.low.exp(), high: interval.high.exp() })
        });
    let mut analyzed = Analyzed::default();
    analyzed.findings.push(sentence(&values, arithmetic, rule.target(), unit));
    analyzed.warnings.extend(found.iter().filter_map(|track| incomplete(track, rule.n_reversals)));
    let results = [
        ("unit", json!(unit)),
        ("target", json!(rule.target())),
        ("n", json!(values.len())),
        ("mean", json!(arithmetic.map(|of| of.mean).or(values.first().copied()))),
        ("mean_interval_95", json!(arithmetic.map(|of| interval(of.interval)))),
        ("geometric_mean", json!(geometric.map(|(mean, _)| mean))),
        ("geometric_mean_interval_95", json!(geometric.map(|(_, bounds)| interval(bounds)))),
        ("staircases", found.iter().map(track_json).collect::<Vec<_>>().into()),
    ];
    analyzed.results.extend(results.map(|(name, value)| (name.to_owned(), value)));
    analyzed.figures.push(("thresholds".to_owned(), Figure::Table(table(&found, unit))));
    analyzed.figures.push(("staircases".to_owned(), Figure::Chart(chart(&found, unit))));
    analyzed
}

fn sentence(values: &[f64], of: Option<MeanInterval>, target: f64, unit: &str) -> String {
    let percent = 100.0 * target;
    match (of, values) {
        (Some(MeanInterval { mean, interval: Interval { low, high }, .. }), _) => format!(
            "Threshold for {percent:.1} % right answers: mean {mean:.2} {unit} over {}, 95 % interval {low:.2} to {high:.2} {unit}.",
            counted(values.len(), "participant")
        ),
        (None, [only]) => {
            format!("Threshold for {percent:.1} % right answers: {only:.2} {unit}, of one participant.")
        }
        (None, _) => "No staircase has enough reversals for a threshold.".to_owned(),
    }
}

fn incomplete(track: &Track, n_needed: usize) -> Option<String> {
    let is_complete = track.threshold.is_some_and(|threshold| threshold.is_complete);
    (!is_complete).then(|| {
        format!(
            "staircase {} of {} has {} of {n_needed} reversals",
            track.track + 1,
            track.participant,
            track.reversals.len()
        )
    })
}

fn track_json(track: &Track) -> Value {
    json!({
        "participant": track.participant,
        "staircase": track.track + 1,
        "threshold": track.threshold.map(|threshold| threshold.level),
        "deviation": track.threshold.map(|threshold| threshold.deviation),
        "complete": track.threshold.is_some_and(|threshold| threshold.is_complete),
        "reversals": track.reversals,
        "trials": track.answers.len(),
        "right": track.answers.iter().filter(|(_, is_right)| *is_right).count(),
    })
}

fn table(found: &[Track], unit: &str) -> Table {
    let row = |track: &Track| {
        let numbers = vec![
            track.threshold.map(|threshold| threshold.level),
            track.threshold.map(|threshold| threshold.deviation),
            Some(track.reversals.len() as f64),
            Some(track.answers.len() as f64),
        ];
        (format!("{}, {}", track.participant, track.track + 1), numbers)
    };
    Table {
        title: format!("Thresholds in {unit}, from the last reversals of each staircase"),
        columns: ["threshold", "deviation", "reversals", "trials"].map(str::to_owned).to_vec(),
        rows: found.iter().map(row).collect(),
        decimals: 2,
        n_counts: 2,
        source: String::new(),
    }
}

/// Levels of the first staircases over the trials.
fn chart(found: &[Track], unit: &str) -> Chart {
    let series = |(track, tone): (&Track, Tone)| Series {
        name: format!("{}, {}", track.participant, track.track + 1),
        mark: Mark::Line,
        tone,
        points: (1..).zip(&track.answers).map(|(n, (level, _))| Point::new(f64::from(n), *level)).collect(),
    };
    Chart {
        title: "Levels of the first staircases".to_owned(),
        x_label: "trial".to_owned(),
        y_label: format!("level ({unit})"),
        is_isotropic: false,
        x_scale: Scale::Linear,
        shown: None,
        series: found.iter().zip(TONES).map(series).collect(),
        source: String::new(),
    }
}
