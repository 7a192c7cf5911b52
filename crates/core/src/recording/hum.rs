//! Mains hum: narrow spectral lines at 50 or 60 Hz and their harmonics, whose level does not depend on tip speed.
//!
//! The signal is cut into windows of a second, which are sorted by tip speed into groups. Each group has a mean
//! periodogram. A line of the mains stands above the spectrum around it in every group, is as narrow as the window allows,
//! and has the same power in all groups. A period of the surface makes a line at speed over period, which moves with the
//! speed; a resonance is wider.

use crate::dsp::spectrum::{median, welch};
use crate::recording::{Finding, Recording};
use crate::units::Hertz;

/// Frequencies of mains.
const MAINS: [Hertz; 2] = [Hertz(50.0), Hertz(60.0)];

/// Number of harmonics that are searched. A rectifier hums at the second.
const N_HARMONICS: u32 = 3;

/// Length of a window in seconds. Its spectrum has bins of a hertz, and a line is four bins wide between its zeros.
const WINDOW_SECS: f64 = 1.0;

/// Minimum number of windows; fewer do not separate a line from noise.
const MIN_WINDOWS: usize = 3;

/// Maximum number of groups of windows.
const MAX_GROUPS: usize = 3;

/// Minimum excess of a line over the median density around it, in dB. A single periodogram of noise exceeds its median by
/// this much once in a thousand bins; a line must do so in all groups.
const LEAST_DB: f64 = 10.0;

/// Bins on each side of a line that contain it, and bins beyond them that count as the spectrum around it.
const N_LINE: usize = 2;
const N_AROUND: usize = 16;

/// Largest ratio of a line's power between two groups: 3 dB.
const MOST_CHANGE: f64 = 2.0;

/// Ratio of the mean speeds of the fastest and the slowest group above which the recording has several tip speeds. A line
/// of the surface then moves by more than its width.
const SPEED_RATIO: f64 = 1.25;

/// Mean spectrum of windows with similar tip speeds.
struct Group {
    speed_mps: f64,
    /// Density at each hertz from zero.
    density: Vec<f64>,
}

/// Line of one group.
struct Line {
    /// Power in (m/s²)².
    power: f64,
    /// Peak over the median density around it, in dB.
    above_db: f64,
}

/// Returns the finding of mains hum in a recording, if there is any.
pub(super) fn mains_hum(recording: &Recording) -> Option<Finding> {
    let groups = groups(recording)?;
    let speeds = || groups.iter().map(|group| group.speed_mps);
    let slowest_mps = speeds().fold(f64::INFINITY, f64::min);
    let has_speeds = speeds().fold(0.0, f64::max) > SPEED_RATIO * slowest_mps;
    let found = |mains: Hertz| -> Vec<(Hertz, f64)> {
        let harmonics = (1..=N_HARMONICS).map(|times| Hertz(f64::from(times) * mains.0));
        harmonics.filter_map(|at| Some((at, excess_db(&groups, at)?))).collect()
    };
    // The mains of one country; of the other one, only the common harmonic at 300 Hz could appear, which is not searched.
    let lines = MAINS.map(found).into_iter().max_by_key(Vec::len)?;
    let above_db = lines.iter().map(|(_, above_db)| *above_db).reduce(f64::max)?;
    // A third harmonic alone is no hum.
    let is_hum = lines.first().is_some_and(|(first, _)| first.0 < 140.0);
    is_hum.then(|| Finding::MainsHum {
        lines: lines.iter().map(|(at, _)| *at).collect(),
        above_db,
        has_speeds,
    })
}

/// Smallest excess of a line over the groups in dB; `None` if a group has no line there, or if its power changes.
fn excess_db(groups: &[Group], at: Hertz) -> Option<f64> {
    let lines: Vec<Line> = groups.iter().map(|group| line(&group.density, at)).collect::<Option<_>>()?;
    let powers = || lines.iter().map(|line| line.power);
    let is_steady = powers().fold(0.0, f64::max) <= MOST_CHANGE * powers().fold(f64::INFINITY, f64::min);
    is_steady.then(|| lines.iter().map(|line| line.above_db).fold(f64::INFINITY, f64::min))
}

/// Line of a spectrum with bins of a hertz; `None` if there is no narrow peak at this frequency.
fn line(density: &[f64], at: Hertz) -> Option<Line> {
    let center = at.0.round() as usize;
    let around = density.get(center.checked_sub(N_LINE + N_AROUND)?..=center + N_LINE + N_AROUND)?;
    let (below, rest) = around.split_at_checked(N_AROUND)?;
    let (inside, above) = rest.split_at_checked(2 * N_LINE + 1)?;
    let floor = median(below.iter().chain(above).copied().collect());
    let peak = inside.iter().copied().fold(0.0, f64::max);
    // Mains deviate by less than half a hertz, so the peak lies within a bin.
    let is_centered = inside.get(N_LINE - 1..=N_LINE + 1)?.contains(&peak);
    // A resonance that is wider than the window's line also raises the next bins.
    let next = below.iter().rev().take(N_LINE).chain(above.iter().take(N_LINE)).copied().fold(0.0, f64::max);
    let above_db = 10.0 * (peak / floor).log10();
    let is_line = is_centered && above_db >= LEAST_DB && next < 0.1 * peak;
    let power = inside.iter().map(|density| density - floor).sum();
    is_line.then_some(Line { power, above_db })
}

/// Groups of windows by tip speed, of about equal size; `None` if there are too few windows.
fn groups(recording: &Recording) -> Option<Vec<Group>> {
    let n = (WINDOW_SECS * recording.rate.0).round() as usize;
    let mut windows: Vec<(f64, usize)> = Vec::new();
    for range in &recording.usable {
        for start in range.clone().step_by(n.max(1)).filter(|start| start + n <= range.end) {
            let speeds_mps = &recording.speed_mps[start..start + n];
            windows.push((speeds_mps.iter().sum::<f64>() / n as f64, start));
        }
    }
    if windows.len() < MIN_WINDOWS {
        return None;
    }
    windows.sort_by(|a, b| a.0.total_cmp(&b.0));
    let rate = Hertz(n as f64 / WINDOW_SECS);
    let group = |windows: &[(f64, usize)]| {
        let mut density = vec![0.0; n / 2 + 1];
        for (_, start) in windows {
            let spectrum = welch(&recording.acceleration_mps2[*start..start + n], rate, n);
            for (sum, (_, bin)) in density.iter_mut().zip(spectrum) {
                *sum += bin / windows.len() as f64;
            }
        }
        let speed_mps = windows.iter().map(|(speed_mps, _)| speed_mps).sum::<f64>() / windows.len() as f64;
        Group { speed_mps, density }
    };
    Some(windows.chunks(windows.len().div_ceil(MAX_GROUPS)).map(group).collect())
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::mains_hum;
    use crate::maths::rng::lcg_noise;
    use crate::recording::{Finding, Recording};
    use crate::units::Hertz;

    const RATE_HZ: f64 = 2000.0;
    const SECS: usize = 12;

    /// Noise with a level of 0.1 m/s² at a speed that rises from 40 to 160 mm/s, and a sine whose phase is given over
    /// time in s and way in m.
    fn recording(amplitude_mps2: f64, phase: impl Fn(f64, f64) -> f64, is_steady: bool) -> Recording {
        let n = SECS * RATE_HZ as usize;
        let noise = lcg_noise(n, 11);
        let scale = 0.1 / crate::dsp::spectrum::rms(&noise);
        let speed = |i: usize| if is_steady { 0.1 } else { 0.04 + 0.12 * i as f64 / n as f64 };
        let mut way_m = 0.0;
        let mut acceleration_mps2 = Vec::with_capacity(n);
        for (i, x) in noise.iter().enumerate() {
            way_m += speed(i) / RATE_HZ;
            let turn = phase(i as f64 / RATE_HZ, way_m);
            acceleration_mps2.push(9.81 + scale * x + amplitude_mps2 * turn.sin());
        }
        Recording {
            rate: Hertz(RATE_HZ),
            acceleration_mps2,
            speed_mps: (0..n).map(speed).collect(),
            force_n: vec![1.0; n],
            usable: std::iter::once(0..n).collect(),
        }
    }

    /// A sine of amplitude `a` in noise of density `N` has, in Hann windows of a second, a peak of `a² / 3` per Hz, since
    /// the equivalent noise bandwidth is 1.5 Hz.
    #[test]
    fn hum_is_found_with_its_level_at_every_speed() {
        for (hz, amplitude_mps2) in [(50.0, 0.1), (60.0, 0.05), (50.2, 0.1), (100.0, 0.1)] {
            let Some(Finding::MainsHum { lines, above_db, has_speeds }) =
                mains_hum(&recording(amplitude_mps2, |secs, _| TAU * hz * secs, false))
            else {
                panic!("no hum at {hz} Hz")
            };
            assert_eq!((lines, has_speeds), (vec![Hertz(hz.round())], true));
            let noise = 0.01 / (0.5 * RATE_HZ);
            let expected_db = 10.0 * (amplitude_mps2 * amplitude_mps2 / 3.0 / noise).log10();
            // The smallest of three groups, each of four windows, over a median of 32 bins: 2 dB.
            assert!((above_db - expected_db).abs() < 3.0, "{above_db} for {expected_db} dB at {hz} Hz");
        }
        let said = mains_hum(&recording(0.5, |secs, _| TAU * 50.0 * secs, false)).map(|hum| hum.to_string());
        assert!(said.is_some_and(|said| said.starts_with("mains hum: line at 50 Hz, ")
            && said.contains("at every tip speed: probably mains hum")));
    }

    /// Periods of 1 to 3.2 mm pass 50 Hz and 60 Hz at one of the speeds.
    #[test]
    fn a_line_that_moves_with_speed_is_no_hum() {
        for period_m in [0.001, 0.0015, 0.002, 0.0025, 0.0032] {
            let ridges = recording(0.5, |_, way_m| TAU * way_m / period_m, false);
            assert_eq!(mains_hum(&ridges), None, "{period_m} m");
        }
        assert_eq!(mains_hum(&recording(0.0, |_, _| 0.0, false)), None);
    }

    #[test]
    fn at_one_speed_a_period_of_the_surface_is_possible() {
        let hum = mains_hum(&recording(0.5, |_, way_m| TAU * way_m / 0.002, true));
        assert!(matches!(hum, Some(Finding::MainsHum { has_speeds: false, .. })), "{hum:?}");
        assert!(hum.is_some_and(|hum| hum.to_string().contains("or a period of the surface")));
    }

    #[test]
    fn lines_beside_the_mains_and_short_recordings_are_not_judged() {
        for hz in [45.0, 53.0, 55.0, 57.0, 90.0, 150.0] {
            assert_eq!(mains_hum(&recording(0.1, |secs, _| TAU * hz * secs, false)), None, "{hz} Hz");
        }
        let mut short = recording(0.5, |secs, _| TAU * 50.0 * secs, false);
        short.usable = std::iter::once(0..2 * RATE_HZ as usize).collect();
        assert_eq!(mains_hum(&short), None);
    }
}
