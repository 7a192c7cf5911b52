//! Figure 1: noise with gaps beside its distractor, and whether spectrograms of two window widths tell them apart.

use shagreen_core::maths::statistics::{mean, standard_deviation};
use shagreen_core::signals::profile_stimuli::{STEP_M, gap_pair};
use shagreen_core::signals::spatial_spectrogram::{Edges, Framing, FramingError, Transform};
use shagreen_formats::figure::{Scale, Tone};

use crate::reproduce::charts::{chart, line};
use crate::reproduce::s4::points;
use crate::reproduce::s4::spectrogram_map::{Shown, spectrogram_map};
use crate::reproduce::work::Work;

/// Widths of the gaps, and of the windows.
const GAPS_M: [f64; 2] = [5e-3, 1e-3];
const WINDOWS_M: [f64; 2] = [2e-3, 0.2e-3];
/// Length of either half: 20 mm.
const N_SAMPLES: usize = 2000;
/// Value around which the noise varies.
const MIDDLE: f64 = 0.5;
/// Highest spatial frequency of the noise, in 1/mm.
const HIGHEST_PER_MM: f64 = 40.0;

/// Computes the item.
pub(super) fn item(work: &mut Work<'_>) -> anyhow::Result<()> {
    let source = "simulated noise, gaps on the left and their distractor on the right";
    let mut item = work.item("figure-1", source);
    item.commands.push("shagreen spatial make gaps --gap 5 --out gaps.csv".to_owned());
    for gap_m in GAPS_M {
        let pair = gap_pair(gap_m, N_SAMPLES, STEP_M, work.options.seed);
        let gap_mm = 1e3 * gap_m;
        let composite: Vec<f64> = pair.gapped.iter().chain(&pair.distractor).copied().collect();
        item.figures.push((
            format!("{gap_mm}-mm-gaps"),
            chart(
                format!("Gaps of {gap_mm} mm beside their distractor"),
                ["position in mm", "level"],
                Scale::Linear,
                vec![line("texture", Tone::Main, points(&composite, 0.0))],
                source,
            ),
        ));
        let varying = varying(&composite);
        for (window_m, width) in WINDOWS_M.into_iter().zip(["wide", "narrow"]) {
            let window_mm = 1e3 * window_m;
            let shown = Shown {
                title: format!(
                    "Spectrogram of gaps of {gap_mm} mm and their distractor, window of {window_mm} mm"
                ),
                highest_per_mm: HIGHEST_PER_MM,
                source,
            };
            item.figures.push((
                format!("{gap_mm}-mm-gaps-{width}-window"),
                spectrogram_map(&varying, framing(window_m), shown)?,
            ));
            let (gapped, distractor) =
                (variation(&pair.gapped, window_m)?, variation(&pair.distractor, window_m)?);
            item.add(
                format!("variation of the power along gaps of {gap_mm} mm relative to that along their distractor, window of {window_mm} mm"),
                "",
                Some(gapped / distractor),
            );
        }
    }
    work.done(item);
    Ok(())
}

/// A framing of the paper, whose windows all lie inside the texture. Nothing is reconstructed here, so that no end is weighed.
fn framing(window_m: f64) -> Framing {
    Framing::of_length(window_m, STEP_M).with_edges(Edges::Cut)
}

/// A texture without its constant part.
fn varying(texture: &[f64]) -> Vec<f64> {
    texture.iter().map(|value| value - MIDDLE).collect()
}

/// Standard deviation of the power of all windows relative to its mean: how much a spectrogram varies along a texture.
fn variation(texture: &[f64], window_m: f64) -> Result<f64, FramingError> {
    let power = Transform::new(framing(window_m)).power(&varying(texture))?;
    let of_windows: Vec<f64> = power.frames().map(|frame| frame.iter().sum::<f64>()).collect();
    Ok(standard_deviation(&of_windows) / mean(&of_windows))
}

#[cfg(test)]
mod tests {
    use super::{N_SAMPLES, WINDOWS_M, variation};
    use shagreen_core::signals::profile_stimuli::{STEP_M, gap_pair};

    /// The paper's conclusion: the narrow window shows gaps of both widths, the wide one only the wide gaps.
    #[test]
    fn a_narrow_window_shows_narrow_gaps_and_a_wide_one_does_not() {
        let ratio = |gap_m: f64, window_m: f64, seed: u64| {
            let pair = gap_pair(gap_m, N_SAMPLES, STEP_M, seed);
            variation(&pair.gapped, window_m).unwrap() / variation(&pair.distractor, window_m).unwrap()
        };
        let mean =
            |gap_m: f64, window_m: f64| (1..=8).map(|seed| ratio(gap_m, window_m, seed)).sum::<f64>() / 8.0;
        let [wide_m, narrow_m] = WINDOWS_M;
        assert!(mean(5e-3, wide_m) > 2.4 && mean(5e-3, narrow_m) > 1.5);
        assert!(mean(1e-3, narrow_m) > 1.5 && mean(1e-3, wide_m) < 1.7);
    }
}
