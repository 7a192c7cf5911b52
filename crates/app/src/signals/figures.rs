//! Figures of the Signals workspace. The window draws and saves the same figure.

use shagreen_core::signals::quality::Feature;
use shagreen_core::signals::spatial_spectrogram::{Frames, Framing, ProfileFidelity, Transform};
use shagreen_core::units::Hertz;
use shagreen_formats::figure::{Chart, Figure, Map, Mark, Point, Scale, Series, Table, Tone};

use super::analysis::{ByRate, Compared};
use crate::state::bench_signal::BenchSignal;
use crate::strings::differences;
use crate::strings::signals as strings;

/// Samples of a spectrogram window at [`TIME_RATE`]: 64 ms.
const TIME_WINDOW: usize = 128;
/// Sample rate of a spectrogram over time. Half of it is the highest frequency that can be felt.
const TIME_RATE: Hertz = Hertz(2000.0);
/// Highest frequency shown, in Hz.
const SHOWN_HZ: f64 = 1000.0;
/// Color range, in dB below the highest level of both signals.
const RANGE_DB: f64 = 60.0;
/// Maximum number of columns and rows of a map: more are indistinguishable on a screen.
const MAX_CELLS: (usize, usize) = (480, 192);
/// Lowest level, in dB re 1 m/s²: levels below it can never be felt.
const LEAST_DB: f64 = -80.0;

/// Amplitudes over two axes, in dB re 1 m/s². The color range is chosen later, because several maps share it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Levels {
    x: (f64, f64),
    y: (f64, f64),
    rows: Vec<Vec<f64>>,
}

impl Levels {
    /// Amplitudes of a signal over time in s and frequency in Hz; `None` if it is shorter than two samples.
    pub(super) fn over_time(signal: &BenchSignal) -> Option<Self> {
        let framing = Framing::new(TIME_WINDOW).ok()?.with_hop(TIME_WINDOW / 4).ok()?;
        let power = Transform::new(framing).power(&signal.at(TIME_RATE)).ok()?;
        let step_hz = TIME_RATE.0 / TIME_WINDOW as f64;
        let n_bins = n_bins_to(SHOWN_HZ, step_hz, &power);
        let (x, rows) = cells(&power, (0.0, power.n_samples() as f64), n_bins);
        let secs = |sample: f64| sample / TIME_RATE.0;
        Some(Self { x: (secs(x.0), secs(x.1)), y: edges(step_hz, n_bins), rows })
    }

    /// Amplitudes over the shown positions in mm and spatial frequencies in 1/mm, from the power in the windows of a
    /// signal. At the speed of the signal, frequencies extend to [`SHOWN_HZ`]; higher ones are too fast to be felt.
    pub(super) fn over_places(power: &Frames<f64>, signal: &BenchSignal, shown_mm: (f64, f64)) -> Self {
        let step_mm = 1e3 * signal.profile.step_m();
        let step_per_mm = 1.0 / (power.framing().window() as f64 * step_mm);
        let n_bins = n_bins_to(1e-3 * SHOWN_HZ / signal.speed.0, step_per_mm, power);
        let samples = (shown_mm.0 / step_mm, shown_mm.1 / step_mm);
        let (x, rows) = cells(power, samples, n_bins);
        Self { x: (step_mm * x.0, step_mm * x.1), y: edges(step_per_mm, n_bins), rows }
    }

    /// Highest level, in dB re 1 m/s².
    pub(super) fn highest_db(&self) -> f64 {
        self.rows.iter().flatten().copied().fold(LEAST_DB, f64::max)
    }

    /// Map with a color range that ends at `highest_db`.
    pub(super) fn figure(self, title: String, axes: [&str; 2], highest_db: f64) -> Figure {
        // Rounded up to whole tens, so that both maps keep their colors when one signal changes a little.
        let top = (highest_db / 10.0).ceil() * 10.0;
        Figure::Map(Map {
            title,
            x_label: axes[0].to_owned(),
            y_label: axes[1].to_owned(),
            value_label: strings::AMPLITUDE.to_owned(),
            value_unit: strings::DB_MPS2.to_owned(),
            x: self.x,
            y: self.y,
            range: (top - RANGE_DB, top),
            rows: self.rows,
            source: String::new(),
        })
    }
}

/// Number of frequencies with spacing `step` up to `highest`, at least two.
fn n_bins_to(highest: f64, step: f64, power: &Frames<f64>) -> usize {
    let n_bins = power.framing().n_bins();
    ((highest / step).ceil() as usize + 1).clamp(2, n_bins)
}

/// Lower and upper edge of the lowest frequencies with spacing `step`. Each frequency is the center of its cell.
fn edges(step: f64, n_bins: usize) -> (f64, f64) {
    (-0.5 * step, (n_bins as f64 - 0.5) * step)
}

/// Levels in dB of the windows centered between two samples, at the lowest frequencies, in at most [`MAX_CELLS`]. Also
/// returns the begin of the first cell and the end of the last one, in samples.
fn cells(power: &Frames<f64>, (first, last): (f64, f64), n_bins: usize) -> ((f64, f64), Vec<Vec<f64>>) {
    let framing = power.framing();
    let hop = framing.hop() as f64;
    // Window nearest to a position, among those whose center is inside the signal. Other windows would repeat its
    // content.
    let begin = ((0.0 - framing.center(0)) / hop).ceil().max(0.0);
    let end = (power.n_frames() - 1) as f64;
    let frame =
        |sample: f64| ((sample - framing.center(0)) / hop).round().clamp(begin.min(end), end) as usize;
    let (from, to) = (frame(first), frame(last));
    let (n_columns, n_rows) = ((to - from + 1).min(MAX_CELLS.0), n_bins.min(MAX_CELLS.1));
    // A wave of amplitude 1 has a bin of magnitude Σ w / 2 = N / 4.
    let unit = (4.0 / framing.window() as f64).powi(2);
    let mut rows = vec![vec![LEAST_DB; n_columns]; n_rows];
    for (i, frame) in power.frames().skip(from).take(to - from + 1).enumerate() {
        let column = i * n_columns / (to - from + 1);
        for (j, power) in frame[..n_bins].iter().enumerate() {
            let cell = &mut rows[j * n_rows / n_bins][column];
            // The highest level in a cell, so that narrow components remain visible.
            *cell = cell.max(10.0 * (unit * power).log10());
        }
    }
    // Each window is the center of its cell.
    ((framing.center(from) - 0.5 * hop, framing.center(to) + 0.5 * hop), rows)
}

fn line(name: &str, tone: Tone, mark: Mark, points: Vec<Point>) -> Series {
    Series { name: name.to_owned(), mark, tone, points }
}

/// Fidelity of the spatial spectrogram for each window length, with the current window length marked.
pub(super) fn fidelity_figure(of: &[(Tone, &str, &[ProfileFidelity])], window_m: f64) -> Figure {
    let points = |of: &[ProfileFidelity], value: fn(&ProfileFidelity) -> f64| {
        of.iter().map(|at| Point::new(1e3 * at.window_m, value(at).max(0.0))).collect()
    };
    let window_mm = 1e3 * window_m;
    let mark = vec![Point::new(window_mm, 0.0), Point::new(window_mm, 1.0)];
    let mut series = vec![line(strings::THIS_WINDOW, Tone::Limit, Mark::Line, mark)];
    for (_, _, of) in of {
        series.push(line(strings::WAVE, Tone::Faint, Mark::Line, points(of, |at| at.correlation)));
    }
    for (tone, name, of) in of {
        for mark in [Mark::Line, Mark::Dots] {
            series.push(line(name, *tone, mark, points(of, |at| at.envelope_correlation)));
        }
    }
    Figure::Chart(Chart {
        title: strings::FIDELITY.to_owned(),
        x_label: strings::WINDOW_MM.to_owned(),
        y_label: strings::CORRELATION.to_owned(),
        is_isotropic: false,
        x_scale: Scale::Logarithmic,
        shown: Some([(0.15, 27.0), (-0.03, 1.08)]),
        series,
        source: strings::MEASURED.to_owned(),
    })
}

/// Predicted d' between the signals and their coded versions, for each bit rate. `source` names the model.
pub(super) fn rates_figure(of: &[(Tone, &str, &ByRate)], source: &str) -> Figure {
    let told = vec![Point::new(1.6, 1.0), Point::new(3.3, 1.0)];
    let mut series = vec![line(strings::TOLD_APART, Tone::Limit, Mark::Line, told)];
    let mut highest = 2.0_f64;
    for (tone, name, of) in of {
        let Ok(rates) = of else { continue };
        let points = || rates.iter().map(|at| Point::new(at.kbps, at.d_prime)).collect();
        highest = rates.iter().map(|at| at.d_prime).fold(highest, f64::max);
        series.push(line(name, *tone, Mark::Line, points()));
        series.push(line(name, *tone, Mark::Dots, points()));
    }
    Figure::Chart(Chart {
        title: strings::BY_RATE.to_owned(),
        x_label: strings::KBPS.to_owned(),
        y_label: strings::D_PRIME.to_owned(),
        is_isotropic: false,
        x_scale: Scale::Linear,
        shown: Some([(1.6, 3.3), (0.0, 1.08 * highest)]),
        series,
        source: source.to_owned(),
    })
}

/// Table with all features of a pair of signals. `source` names the model of d'.
pub(super) fn features_figure(compared: &Compared, names: [&str; 2], source: &str) -> Figure {
    let own = |feature, i: usize| {
        let of = &compared.features[i];
        match feature {
            Feature::Roughness => Some(of.roughness),
            Feature::Brightness => Some(of.brightness_hz),
            Feature::Regularity => Some(of.regularity),
            Feature::Asymmetry => Some(of.asymmetry),
            Feature::SpectralPower | Feature::SpectralAmplitude | Feature::Envelope => None,
        }
    };
    let part = |feature| compared.parts.iter().find(|(of, _)| *of == feature).map(|(_, part)| *part);
    let row = |feature: Feature| {
        let numbers =
            vec![own(feature, 0), own(feature, 1), Some(compared.distances.by(feature)), part(feature)];
        (differences::feature(feature).to_owned(), numbers)
    };
    Figure::Table(Table {
        title: differences::features_title(compared.d_prime, compared.relation),
        columns: differences::FEATURE_COLUMNS.map(str::to_owned).to_vec(),
        rows: Feature::ALL.into_iter().map(row).collect(),
        decimals: 3,
        n_counts: 0,
        source: differences::features_source(names, source),
    })
}

#[cfg(test)]
mod tests {
    use super::{Levels, rates_figure};
    use crate::signals::analysis::AtRate;
    use crate::state::bench_signal::tests::tone;
    use shagreen_core::signals::spatial_spectrogram::{Framing, Transform};
    use shagreen_formats::figure::{Figure, Tone};

    /// Center of the cell with the highest value.
    fn loudest(figure: &Figure) -> (f64, f64) {
        let Figure::Map(map) = figure else { panic!("no map") };
        let (x, y, _) = map.cells().max_by(|a, b| a.2.total_cmp(&b.2)).unwrap();
        (x, y)
    }

    #[test]
    fn a_tone_of_one_is_zero_decibels_at_its_frequency() {
        // Frequency number 16, at a spacing of 15.6 Hz.
        let signal = tone(250.0, 4000.0, 2.0);
        let levels = Levels::over_time(&signal).unwrap();
        assert!(levels.highest_db().abs() < 0.1, "{}", levels.highest_db());
        let figure = levels.figure(String::new(), ["", ""], 0.0);
        assert!((loudest(&figure).1 - 250.0).abs() < 1e-9, "{:?}", loudest(&figure));
        // At 100 mm/s, 260 Hz are 2.6 waves per mm: frequency number 13 of windows of 5 mm.
        let signal = tone(260.0, 4000.0, 2.0);
        let transform = Transform::new(Framing::of_length(5e-3, signal.profile.step_m()));
        let power = transform.power(signal.profile.values()).unwrap();
        let levels = Levels::over_places(&power, &signal, (20.0, 60.0));
        let figure = levels.clone().figure(String::new(), ["", ""], levels.highest_db());
        let (x, y) = loudest(&figure);
        assert!((17.0..63.0).contains(&x) && (y - 2.6).abs() < 1e-9, "{x} {y}");
        let Figure::Map(map) = figure else { panic!("no map") };
        // Windows are 2.5 mm apart, and each is the center of its cell.
        assert!((map.x.0 - 18.75).abs() < 1e-9 && (map.x.1 - 61.25).abs() < 1e-9, "{:?}", map.x);
    }

    #[test]
    fn a_signal_without_rates_leaves_the_others_shown() {
        let at = AtRate { kbps: 1.75, snr_db: 6.0, d_prime: 5.0 };
        let (with, without) = (Ok(vec![at]), Err("short".to_owned()));
        let figure = rates_figure(&[(Tone::Main, "a", &with), (Tone::Second, "b", &without)], "model");
        let Figure::Chart(chart) = figure else { panic!("no chart") };
        assert_eq!(chart.series.len(), 3, "the limit, a line and its dots");
        assert!(chart.bounds()[1].1 > 5.0);
    }
}
