//! Spectrograms as color-coded maps.

use shagreen_core::signals::profile_stimuli::STEP_M;
use shagreen_core::signals::spatial_spectrogram::{Framing, FramingError, Transform};
use shagreen_formats::figure::{Figure, Map};

/// Range of the colors in dB.
const RANGE_DB: f64 = 60.0;

/// What a map shows.
pub(super) struct Shown<'a> {
    pub(super) title: String,
    /// Highest spatial frequency.
    pub(super) highest_per_mm: f64,
    pub(super) source: &'a str,
}

/// Power of a profile by position and spatial frequency, relative to the highest one. Power below the range of the colors
/// counts as the lowest of the range.
///
/// # Errors
/// The profile does not fit the framing.
pub(super) fn spectrogram_map(
    profile: &[f64],
    framing: Framing,
    shown: Shown<'_>,
) -> Result<Figure, FramingError> {
    let power = Transform::new(framing).power(profile)?;
    let step_mm = 1e3 * STEP_M;
    let bin_per_mm = 1.0 / (framing.window() as f64 * step_mm);
    let n_bins = ((shown.highest_per_mm / bin_per_mm).ceil() as usize + 1).clamp(2, framing.n_bins());
    let highest = power.frames().flat_map(|frame| &frame[..n_bins]).fold(f64::MIN_POSITIVE, |a, b| a.max(*b));
    let level_db = |power: f64| (10.0 * (power / highest).log10()).max(-RANGE_DB);
    let row = |bin: usize| power.frames().map(|frame| level_db(frame[bin])).collect::<Vec<f64>>();
    let last = power.n_frames().saturating_sub(1);
    let half_hop = 0.5 * framing.hop() as f64;
    Ok(Figure::Map(Map {
        title: shown.title,
        x_label: "position in mm".to_owned(),
        y_label: "spatial frequency in 1/mm".to_owned(),
        value_label: "power re the highest".to_owned(),
        value_unit: "dB".to_owned(),
        // Each window and each frequency is the center of its cell.
        x: (step_mm * (framing.center(0) - half_hop), step_mm * (framing.center(last) + half_hop)),
        y: (-0.5 * bin_per_mm, (n_bins as f64 - 0.5) * bin_per_mm),
        range: (-RANGE_DB, 0.0),
        rows: (0..n_bins).map(row).collect(),
        source: shown.source.to_owned(),
    }))
}

#[cfg(test)]
mod tests {
    use super::{Shown, spectrogram_map};
    use shagreen_core::signals::spatial_spectrogram::{Edges, Framing};
    use shagreen_formats::figure::Figure;

    #[test]
    fn a_wave_is_bright_at_its_frequency_and_silence_is_dark() {
        // Half of 4 mm has a wave of 1/mm.
        let wave = |i: usize| (std::f64::consts::TAU * i as f64 / 100.0).sin();
        let profile: Vec<f64> = (0..400).map(|i| if i < 200 { wave(i) } else { 0.0 }).collect();
        let shown = Shown { title: String::new(), highest_per_mm: 3.0, source: "" };
        let framing = Framing::of_length(1e-3, 10e-6).with_edges(Edges::Cut);
        let Figure::Map(map) = spectrogram_map(&profile, framing, shown).unwrap() else { panic!("a map") };
        assert_eq!((map.rows.len(), map.rows[0].len()), (4, 7));
        assert!(map.rows[1][0] > -0.1 && map.rows[3][0] < -20.0, "{map:?}");
        assert!(map.rows.iter().all(|row| row[6] == -60.0));
        assert!((map.x.0 - 0.25).abs() < 1e-9 && (map.x.1 - 3.75).abs() < 1e-9, "{:?}", map.x);
    }
}
