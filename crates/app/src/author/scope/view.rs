//! Views of the scope, each as a figure. The window draws and saves the same figure.

use shagreen_core::dsp::threshold::Threshold;
use shagreen_formats::figure::{Chart, Figure, Map, Mark, Point, Scale, Series, Tone};
use shagreen_formats::thresholds::ThresholdKind;

use crate::choices::scope::View;
use crate::session::{BAND_HZ, Spectra};
use crate::state::scope_buffer::{MOMENTS_SECS, Moment, ScopeBuffer};
use crate::strings::scope as strings;

/// Length of the waveform, in s.
const WAVEFORM_SECS: f64 = 0.25;
/// Range of the power spectral density, in dB re 1 (m/s²)²/Hz.
pub(super) const DENSITY_DB: (f64, f64) = (-70.0, 5.0);
/// Color range of the spectrogram, in dB re 1 (m/s²)²/Hz.
const COLORS_DB: (f64, f64) = (-60.0, 0.0);
/// Range of the levels, in dB re 1 m/s² and in dB above the detection threshold.
pub(super) const LEVEL_DB: (f64, f64) = (-66.0, 60.0);
/// Minimum upper limit of the axis, as speed in mm/s and as force in cN.
const LEAST_CONTACT: f64 = 100.0;
/// Averaging time of the current level, in s.
const LEVEL_SECS: f64 = 0.5;
/// Level that stands for silence, in dB.
const SILENCE_DB: f64 = -90.0;

/// Data that the scope shows, live or frozen.
#[derive(Clone, Copy, Debug)]
pub struct Seen<'a> {
    /// Output signal of the last seconds.
    pub buffer: &'a ScopeBuffer,
    /// Power spectral densities of the texture models.
    pub spectra: &'a Spectra,
    /// Names of the contributing textures that are shown.
    pub parents: &'a [String],
    /// Name of the audible texture.
    pub texture: &'a str,
    /// Detection threshold.
    pub threshold: &'a Threshold,
    /// Which detection threshold it is.
    pub kind: ThresholdKind,
    /// Whether positions that determine the interpolation come from simulated raters.
    pub is_simulated: bool,
}

impl Seen<'_> {
    /// Source line of a figure: the detection threshold, and whether raters were simulated.
    fn source(&self, view: View) -> String {
        let threshold = matches!(view, View::Spectrum | View::Level).then(|| strings::against(self.kind));
        let simulated = self.is_simulated.then(|| strings::SIMULATED.to_owned());
        threshold.into_iter().chain(simulated).collect::<Vec<_>>().join("; ")
    }
}

impl View {
    /// All views, in the order of the menu.
    pub const ALL: [Self; 5] =
        [Self::Waveform, Self::Spectrum, Self::Spectrogram, Self::Level, Self::Contact];

    /// First part of the file names of its figures.
    pub fn stem(self) -> &'static str {
        match self {
            Self::Waveform => "acceleration",
            Self::Spectrum => "spectrum",
            Self::Spectrogram => "spectrogram",
            Self::Level => "level",
            Self::Contact => "speed-and-force",
        }
    }

    /// Returns the view as a figure.
    pub fn figure(self, seen: &Seen<'_>) -> Figure {
        let contact = seen.spectra.contact;
        let title = match self {
            Self::Spectrum => {
                strings::spectrum_title(seen.texture, contact.speed.mm_per_s(), contact.force.0)
            }
            _ => strings::title(self, seen.texture),
        };
        let source = seen.source(self);
        let chart = |x_label: &str, x_scale: Scale, shown: [(f64, f64); 2], series: Vec<Series>| {
            Figure::Chart(Chart {
                title: title.clone(),
                x_label: x_label.to_owned(),
                y_label: strings::unit(self).to_owned(),
                is_isotropic: false,
                x_scale,
                shown: Some(shown),
                series,
                source: source.clone(),
            })
        };
        let history = (-MOMENTS_SECS, 0.0);
        match self {
            Self::Waveform => {
                let range = seen.buffer.range();
                let shown = [(-1e3 * WAVEFORM_SECS, 0.0), (-range, range)];
                chart(strings::SHORT_TIME_AXIS, Scale::Linear, shown, vec![waveform(seen.buffer)])
            }
            Self::Spectrum => {
                let shown = [(0.93 * BAND_HZ.0, 1.12 * BAND_HZ.1), DENSITY_DB];
                chart(strings::FREQUENCY_AXIS, Scale::Logarithmic, shown, spectra(seen))
            }
            Self::Spectrogram => Figure::Map(Map { source, ..spectrogram(seen.buffer, title) }),
            Self::Level => chart(
                strings::TIME_AXIS,
                Scale::Linear,
                [history, LEVEL_DB],
                levels(seen.buffer, seen.threshold),
            ),
            Self::Contact => {
                let series = contacts(seen.buffer);
                let values = series.iter().flat_map(|series| &series.points).map(|point| point.y);
                let highest = values.fold(LEAST_CONTACT, f64::max);
                let shown = [history, (-0.05 * highest, 1.1 * highest)];
                chart(strings::TIME_AXIS, Scale::Linear, shown, series)
            }
        }
    }

    /// Returns the measurement between two values on the horizontal axis, as text.
    pub fn measured(self, seen: &Seen<'_>, from: f64, to: f64) -> String {
        match self {
            Self::Waveform => strings::between_times(1e-3 * from, 1e-3 * to),
            Self::Spectrum => {
                let (low, high) = (from.min(to), from.max(to));
                strings::between_frequencies(low, high, band_level_db(seen.spectra, low, high))
            }
            Self::Spectrogram | Self::Level | Self::Contact => strings::between_times(from, to),
        }
    }
}

/// Level in dB re 1 m/s², at least [`SILENCE_DB`].
pub(super) fn level_db(mps2: f64) -> f64 {
    if mps2 > 0.0 { (20.0 * mps2.log10()).max(SILENCE_DB) } else { SILENCE_DB }
}

fn line(name: &str, tone: Tone, points: impl Iterator<Item = (f64, f64)>) -> Series {
    let points = points.map(|(x, y)| Point::new(x, y)).collect();
    Series { name: name.to_owned(), mark: Mark::Line, tone, points }
}

fn waveform(buffer: &ScopeBuffer) -> Series {
    let (rate_hz, samples) = buffer.newest(WAVEFORM_SECS);
    let n = samples.len() as f64;
    let points = samples.iter().enumerate().map(|(i, y)| ((i as f64 - n) / rate_hz * 1e3, *y));
    line(strings::PLAYED, Tone::Main, points)
}

fn spectra(seen: &Seen<'_>) -> Vec<Series> {
    let to_db = |density: f64| (10.0 * density.max(1e-12).log10()).max(DENSITY_DB.0 - 10.0);
    let frequencies = &seen.spectra.frequencies;
    let modeled = |name: &str, tone: Tone, density: &[f64]| {
        line(name, tone, frequencies.iter().zip(density).map(|(f, d)| (f.0, to_db(*d))))
    };
    let is_drawn = |hz: f64| (BAND_HZ.0..=BAND_HZ.1).contains(&hz);
    let live = seen.buffer.density().iter().filter(|(f, _)| is_drawn(f.0)).map(|(f, d)| (f.0, to_db(*d)));
    let mut series = vec![line(strings::LIVE_LINE, Tone::Faint, live)];
    let tones = [Tone::Second, Tone::Third, Tone::Fourth];
    for ((density, tone), name) in seen.spectra.parents.iter().zip(tones).zip(seen.parents) {
        series.push(modeled(name, tone, density));
    }
    let felt = frequencies.iter().map(|f| (f.0, to_db(seen.threshold.density(*f))));
    series.push(line(strings::THRESHOLD_LINE, Tone::Limit, felt));
    series.push(modeled(strings::BLEND_LINE, Tone::Main, &seen.spectra.blend));
    series
}

fn spectrogram(buffer: &ScopeBuffer, title: String) -> Map {
    let step_hz = buffer.moment_step_hz();
    // Each bin is as wide as the frequency step and centered on its frequency. The bin at 0 Hz is left out.
    let n_rows = (BAND_HZ.1 / step_hz).floor() as usize;
    let n_columns = buffer.n_moments();
    let n_empty = n_columns - buffer.moments().len();
    let rows = (1..=n_rows).map(|row| {
        let played = buffer.moments().map(|moment| {
            let density = moment.density.get(row).copied().unwrap_or(0.0);
            (10.0 * f64::from(density).max(1e-12).log10()).max(SILENCE_DB)
        });
        std::iter::repeat_n(SILENCE_DB, n_empty).chain(played).collect()
    });
    Map {
        title,
        x_label: strings::TIME_AXIS.to_owned(),
        y_label: strings::FREQUENCY_AXIS.to_owned(),
        value_label: strings::DENSITY.to_owned(),
        value_unit: strings::DENSITY_UNIT.to_owned(),
        x: (-MOMENTS_SECS, 0.0),
        y: (0.5 * step_hz, (n_rows as f64 + 0.5) * step_hz),
        range: COLORS_DB,
        rows: rows.collect(),
        source: String::new(),
    }
}

/// Pairs of time in s (0 is now) and `value`, one for each moment.
fn over_moments(buffer: &ScopeBuffer, value: impl Fn(&Moment) -> f64) -> impl Iterator<Item = (f64, f64)> {
    let moments = buffer.moments();
    let (n, hop_secs) = (moments.len(), buffer.hop_secs());
    moments.enumerate().map(move |(i, moment)| ((i as f64 + 1.0 - n as f64) * hop_secs, value(moment)))
}

fn levels(buffer: &ScopeBuffer, threshold: &Threshold) -> Vec<Series> {
    let level = over_moments(buffer, |moment| level_db(moment.level_mps2));
    let weights = buffer.weights(threshold);
    let above = over_moments(buffer, |moment| level_db(moment.multiple(&weights)));
    let at_threshold = [(-MOMENTS_SECS, 0.0), (0.0, 0.0)].into_iter();
    vec![
        line(strings::THRESHOLD_LINE, Tone::Limit, at_threshold),
        line(strings::ABOVE_LINE, Tone::Second, above),
        line(strings::LEVEL_LINE, Tone::Main, level),
    ]
}

fn contacts(buffer: &ScopeBuffer) -> Vec<Series> {
    vec![
        line(strings::SPEED_LINE, Tone::Main, over_moments(buffer, |moment| 1e3 * moment.speed_mps)),
        line(strings::FORCE_LINE, Tone::Second, over_moments(buffer, |moment| 1e2 * moment.force_n)),
    ]
}

/// Level of the interpolated texture model between two frequencies, in dB re 1 m/s². The PSD is integrated by the
/// trapezoidal rule and interpolated linearly at both ends.
fn band_level_db(spectra: &Spectra, low_hz: f64, high_hz: f64) -> f64 {
    let points = spectra.frequencies.iter().map(|f| f.0).zip(spectra.blend.iter().copied());
    let points: Vec<(f64, f64)> = points.collect();
    let power: f64 = points
        .windows(2)
        .map(|pair| {
            let [(f, d), (g, e)] = [pair[0], pair[1]];
            let at = |hz: f64| d + (e - d) * (hz - f) / (g - f);
            let (from, to) = (f.max(low_hz), g.min(high_hz));
            if from < to { 0.5 * (at(from) + at(to)) * (to - from) } else { 0.0 }
        })
        .sum();
    level_db(power.sqrt())
}

/// Level in dB re 1 m/s², and its ratio to the detection threshold, both averaged over the last [`LEVEL_SECS`]. `None`
/// before anything was played.
pub(super) fn level_now(seen: &Seen<'_>) -> Option<(f64, f64)> {
    let n = (LEVEL_SECS / seen.buffer.hop_secs()).round() as usize;
    let weights = seen.buffer.weights(seen.threshold);
    let newest = seen.buffer.moments().rev().take(n);
    let powers = newest.map(|moment| (moment.level_mps2.powi(2), moment.multiple(&weights).powi(2)));
    let (mut level, mut multiple, mut n_seen) = (0.0, 0.0, 0.0);
    for (level_power, multiple_power) in powers {
        (level, multiple, n_seen) = (level + level_power, multiple + multiple_power, n_seen + 1.0);
    }
    (n_seen > 0.0).then(|| (level_db((level / n_seen).sqrt()), (multiple / n_seen).sqrt()))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::{Seen, View};
    use crate::session::Spectra;
    use crate::state::scope_buffer::{MOMENTS_SECS, ScopeBuffer};
    use crate::strings::scope as strings;
    use shagreen_core::units::{Contact, Hertz};
    use shagreen_device::synth::contact::Contact as Touched;
    use shagreen_formats::figure::{Chart, Figure};
    use shagreen_formats::thresholds::ThresholdKind;

    /// Two seconds of a 100 Hz tone with a peak of 1 m/s², stroked at 120 mm/s and 0.7 N.
    fn played() -> ScopeBuffer {
        let mut buffer = ScopeBuffer::new(48_000.0, 1000.0);
        let touched = Touched { speed_mps: 0.12, force_n: 0.7 };
        let tone: Vec<f32> = (0..96_000).map(|i| (TAU * 100.0 * f64::from(i) / 48e3).sin() as f32).collect();
        for block in tone.chunks(800) {
            buffer.push(block, touched);
        }
        buffer.update();
        buffer
    }

    fn spectra() -> Spectra {
        let frequencies: Vec<Hertz> = (0..491).map(|i| Hertz(10.0 + f64::from(i))).collect();
        Spectra {
            contact: Contact::from_mm_per_s_and_n(120.0, 0.7),
            blend: vec![1e-2; frequencies.len()],
            parents: vec![vec![1e-3; frequencies.len()]],
            frequencies,
        }
    }

    fn with_seen<R>(then: impl FnOnce(&Seen<'_>) -> R) -> R {
        let threshold = ThresholdKind::Pacinian.read().unwrap();
        let parents = ["Oak".to_owned()];
        let (buffer, spectra) = (played(), spectra());
        let seen = Seen {
            buffer: &buffer,
            spectra: &spectra,
            parents: &parents,
            texture: "Mine",
            threshold: &threshold,
            kind: ThresholdKind::Pacinian,
            is_simulated: true,
        };
        then(&seen)
    }

    fn chart(view: View, seen: &Seen<'_>) -> Chart {
        let Figure::Chart(chart) = view.figure(seen) else { panic!("a chart") };
        chart
    }

    #[test]
    fn the_spectrum_names_its_parents_and_the_threshold() {
        with_seen(|seen| {
            let chart = chart(View::Spectrum, seen);
            let names: Vec<&str> = chart.series.iter().map(|series| series.name.as_str()).collect();
            assert_eq!(names, ["live", "Oak", "threshold", "interpolated (model)"]);
            assert_eq!(chart.title, "Spectrum of Mine (120 mm/s, 0.70 N)");
            assert!(chart.source.contains("Pacinian") && chart.source.contains("simulated"));
            // A tone with the peak of the threshold (0.249 m/s²), spread over the third-octave band at 100 Hz (23.16 Hz
            // wide).
            let at_100 = chart.series[2].points.iter().find(|point| point.x == 100.0).unwrap();
            let expected = 10.0 * (0.5 * 0.249_f64.powi(2) / 23.16).log10();
            assert!((at_100.y - expected).abs() < 0.05, "{} for {expected}", at_100.y);
        });
    }

    /// A constant PSD of 0.01 (m/s²)²/Hz has a power of 1 (m/s²)² over 100 Hz.
    #[test]
    fn what_is_measured_is_right() {
        with_seen(|seen| {
            let band = |from, to| View::Spectrum.measured(seen, from, to);
            assert_eq!(band(300.0, 200.0), "model 200–300 Hz: 0.0 dB");
            // A hundredth of that power, between two frequencies of the grid.
            assert_eq!(band(100.25, 101.25), "model 100–101 Hz: -20.0 dB");
            assert_eq!(View::Waveform.measured(seen, -20.0, -10.0), "10.0 ms = 100.0 Hz");
            assert_eq!(View::Level.measured(seen, -2.0, -0.5), "1.50 s");
        });
    }

    /// A peak of 1 m/s² at 100 Hz is 4 times the threshold of 0.249 m/s². Its RMS level is 3 dB below 1 m/s².
    #[test]
    fn the_level_is_that_of_the_tone() {
        with_seen(|seen| {
            let chart = chart(View::Level, seen);
            let newest = |i: usize| chart.series[i].points.last().unwrap().y;
            // A moment does not contain a whole number of periods.
            assert!((newest(2) + 3.01).abs() < 0.4, "{}", newest(2));
            assert!((newest(1) - 20.0 * (1.0 / 0.249_f64).log10()).abs() < 0.3, "{}", newest(1));
            let (level_db, multiple) = super::level_now(seen).unwrap();
            assert!((level_db + 3.01).abs() < 0.1 && (multiple - 4.0).abs() < 0.2, "{multiple}");
            assert_eq!(strings::level_now(level_db, multiple), "-3 dB · 4.0×");
        });
    }

    #[test]
    fn the_spectrogram_has_the_tone_where_it_was_played() {
        with_seen(|seen| {
            let Figure::Map(map) = View::Spectrogram.figure(seen) else { panic!("a map") };
            assert_eq!((map.x, map.rows[0].len()), ((-MOMENTS_SECS, 0.0), seen.buffer.n_moments()));
            let newest = map.cells().filter(|(x, ..)| *x > -0.1).max_by(|a, b| a.2.total_cmp(&b.2)).unwrap();
            assert!((newest.1 - 100.0).abs() <= 0.5 * seen.buffer.moment_step_hz(), "{newest:?}");
            let before = map.cells().filter(|(x, ..)| *x < -2.5).all(|(.., value)| value <= -60.0);
            assert!(before, "nothing was played before");
        });
    }

    #[test]
    fn the_acceleration_axis_is_symmetric_about_zero() {
        with_seen(|seen| assert_eq!(chart(View::Waveform, seen).bounds()[1], (-1.0, 1.0)));
    }

    #[test]
    fn speed_and_force_are_those_of_the_touch() {
        with_seen(|seen| {
            let chart = chart(View::Contact, seen);
            let newest = |i: usize| chart.series[i].points.last().unwrap();
            assert!((newest(0).y - 120.0).abs() < 1e-3 && (newest(1).y - 70.0).abs() < 1e-3);
            assert_eq!(newest(0).x, 0.0);
        });
    }
}
