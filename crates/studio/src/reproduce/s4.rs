//! The paper on spatial spectrograms: gaps and their distractors, thresholds, test textures and their reconstructions.

mod composites;
mod spectrogram_map;

use shagreen_core::maths::statistics::mean;
use shagreen_core::people::study::analysis::thresholds::{threshold_cells, tracks};
use shagreen_core::signals::profile_stimuli::{PaperTexture, STEP_M};
use shagreen_core::signals::spatial_spectrogram::{
    Framing, PAPER_WINDOWS_M, ProfileFidelity, SpatialSpectrogram, Transform, fidelity, fidelity_by_window,
    profile_of,
};
use shagreen_formats::figure::{Mark, Point, Scale, Tone};

use crate::reproduce::charts::{chart, compared, line, series};
use crate::reproduce::s4::spectrogram_map::{Shown, spectrogram_map};
use crate::reproduce::simulated::{simulated_answers, simulated_participants};
use crate::reproduce::work::Work;
use crate::study::plans::template;

/// Number of participants whose thresholds the paper shows.
const N_PARTICIPANTS: usize = 7;
/// Length of the test textures: 80 mm.
const N_SAMPLES: usize = 8000;
/// Windows of Figure 4.
const SHOWN_WINDOWS_M: [f64; 2] = [20e-3, 2e-3];
/// Highest spatial frequency of Figure 4, in 1/mm.
const HIGHEST_PER_MM: f64 = 5.0;
/// Correlation of the envelopes from which a reconstruction counts as faithful; ours, because the paper asked people.
const FAITHFUL: f64 = 0.9;
/// How reconstructions treat the ends of a texture.
const MIRRORED: &str = "mirrored at the ends; in the paper, no window reaches beyond the ends";

pub(super) fn run(work: &mut Work<'_>) -> anyhow::Result<()> {
    work.step("decomposing gaps and their distractors")?;
    composites::item(work)?;
    work.step("asking simulated participants for gaps")?;
    figure_2(work)?;
    let profiles = PaperTexture::ALL.map(|texture| (texture, texture.profile(N_SAMPLES)));
    figure_3(work, &profiles);
    work.step("reconstructing textures from their spectrograms")?;
    figure_4(work)?;
    figure_5(work, &profiles)
}

/// Framing of a reconstruction, with mirrored ends as in `shagreen spatial analyse` and the built-in study.
///
/// The windows of the paper all lie inside the texture. Near its ends, their squares sum to almost nothing, and the division by
/// this sum turns errors of the phases into values thousands of times as high as the texture.
fn framing(window_m: f64) -> Framing {
    Framing::of_length(window_m, STEP_M)
}

/// Points of a profile: position in mm, and value plus an offset.
fn points(profile: &[f64], offset: f64) -> impl Iterator<Item = (f64, f64)> {
    profile.iter().enumerate().map(move |(i, value)| (1e3 * STEP_M * i as f64, value + offset))
}

/// Figure 2: staircases of simulated participants.
fn figure_2(work: &mut Work<'_>) -> anyhow::Result<()> {
    let (plan, records) = simulated_answers("gap-detection", N_PARTICIPANTS, None, work.options.seed)?;
    let who = simulated_participants(N_PARTICIPANTS);
    let mut item = work.item("figure-2", &who);
    item.commands.push("shagreen study new gap-detection --out gap-detection.toml".to_owned());
    for part in &plan.parts {
        let found = threshold_cells(part, &records).column(0);
        if !found.is_empty() {
            item.set("mean", Some(mean(&found)), "");
            item.set("lowest", found.iter().copied().reduce(f64::min), "");
            item.set("highest", found.iter().copied().reduce(f64::max), "");
        }
        let staircases = tracks(part, &records).into_iter().enumerate().map(|(index, track)| {
            let levels = (1_u32..).map(f64::from).zip(track.answers.iter().map(|(level_mm, _)| *level_mm));
            compared(track.participant.clone(), index, levels)
        });
        item.figures.push((
            part.id.clone(),
            chart(
                "Width of the gaps by trial",
                ["trial", "width in mm"],
                Scale::Linear,
                staircases.collect(),
                &who,
            ),
        ));
    }
    item.explain_all(
        "thresholds of simulated participants are assumed, not found; only people can tell, by the built-in plan gap-detection",
    );
    work.done(item);
    Ok(())
}

/// Figure 3: the four test textures, above each other.
fn figure_3(work: &mut Work<'_>, profiles: &[(PaperTexture, Vec<f64>)]) {
    let source = "profiles from 0 to 1 after the description of the paper, which prints no numbers of the bumps and the noise";
    let mut item = work.item("figure-3", source);
    item.commands.push("shagreen spatial make A --out A.csv".to_owned());
    let last = profiles.len() - 1;
    let lines = profiles.iter().enumerate().map(|(index, (texture, profile))| {
        let offset = 1.2 * (last - index) as f64;
        compared(texture.name(), index, points(profile, offset))
    });
    item.figures.push((
        "textures".to_owned(),
        chart(
            "Test textures, each 1.2 above the next",
            ["position in mm", "level"],
            Scale::Linear,
            lines.collect(),
            source,
        ),
    ));
    work.done(item);
}

/// Figure 4: the square wave, its spectrograms and its reconstructions.
fn figure_4(work: &mut Work<'_>) -> anyhow::Result<()> {
    let source = &format!("texture B, {MIRRORED}");
    let mut item = work.item("figure-4", source);
    item.commands.push("shagreen spatial analyse B.csv --window 20 --window 2".to_owned());
    let profile = PaperTexture::B.profile(N_SAMPLES);
    let mut lines = vec![line("texture B", Tone::Main, points(&profile, 0.0))];
    for (window_m, tone) in SHOWN_WINDOWS_M.into_iter().zip([Tone::Second, Tone::Third]) {
        let transform = Transform::new(framing(window_m));
        let spectrogram = SpatialSpectrogram::of(&profile, &transform)?;
        let made = profile_of(&spectrogram, &transform);
        let found = fidelity(&profile, &made, STEP_M, &spectrogram, &transform)?;
        let window_mm = 1e3 * window_m;
        item.add(
            format!("correlation of texture B and its reconstruction, window of {window_mm} mm"),
            "",
            Some(found.correlation),
        );
        lines.push(line(format!("reconstruction, {window_mm} mm"), tone, points(&made, 0.0)));
        let shown = Shown {
            title: format!("Spectrogram of texture B, window of {window_mm} mm"),
            highest_per_mm: HIGHEST_PER_MM,
            source,
        };
        item.figures.push((format!("{window_mm}-mm"), spectrogram_map(&profile, framing(window_m), shown)?));
    }
    item.figures.push((
        "reconstructions".to_owned(),
        chart("Texture B and its reconstructions", ["position in mm", "level"], Scale::Linear, lines, source),
    ));
    work.done(item);
    Ok(())
}

/// Figure 5: fidelity by window, in the place of ratings.
fn figure_5(work: &mut Work<'_>, profiles: &[(PaperTexture, Vec<f64>)]) -> anyhow::Result<()> {
    let source = &format!(
        "correlation of the envelopes of textures and reconstructions, {MIRRORED}, measured, not rated by people"
    );
    let mut item = work.item("figure-5", source);
    item.commands.push("shagreen spatial analyse A.csv".to_owned());
    item.commands.push("shagreen study new reconstruction-similarity --out similarity.toml".to_owned());
    let framings = PAPER_WINDOWS_M.map(framing);
    let mut found: Vec<Vec<ProfileFidelity>> = Vec::with_capacity(profiles.len());
    for (_, profile) in profiles {
        found.push(fidelity_by_window(profile, STEP_M, &framings)?);
    }
    let of_window = |index: usize| found.iter().map(move |of| of[index].envelope_correlation);
    let is_faithful = |index: &usize| of_window(*index).all(|r| r >= FAITHFUL);
    // Windows stand in descending order.
    let widest = (0..PAPER_WINDOWS_M.len()).find(is_faithful).map(|index| 1e3 * PAPER_WINDOWS_M[index]);
    let how = format!(
        "widest window with a correlation of at least {FAITHFUL} for all textures, not rated by people"
    );
    item.set("faithful", widest, &how);
    let plan = template("reconstruction-similarity")?.study.plan;
    if let Some(part) = plan.parts.first() {
        let n_pairs = part.design.comparisons().len();
        let of_plan = "of the built-in plan reconstruction-similarity";
        for (id, n) in
            [("pairs", n_pairs), ("trials", part.n_repeats * n_pairs), ("practice", part.n_practice)]
        {
            item.set(id, Some(n as f64), of_plan);
        }
    }
    item.explain("only people can tell; the built-in plan reconstruction-similarity asks them");
    let mut all = Vec::with_capacity(profiles.len() + 1);
    for (index, ((texture, _), of)) in profiles.iter().zip(&found).enumerate() {
        let points = of.iter().map(|of| (1e3 * of.window_m, of.envelope_correlation));
        all.push(compared(texture.name(), index, points));
    }
    let means = (0..PAPER_WINDOWS_M.len()).map(|index| {
        let of_textures: Vec<f64> = of_window(index).collect();
        let r = mean(&of_textures);
        item.add(format!("mean correlation, window of {} mm", 1e3 * PAPER_WINDOWS_M[index]), "", Some(r));
        Point::new(1e3 * PAPER_WINDOWS_M[index], r)
    });
    all.push(series("mean", Mark::Dots, Tone::Faint, means.collect()));
    item.figures.push((
        "envelopes".to_owned(),
        chart(
            "Fidelity of reconstructions by the window width",
            ["window in mm", "correlation of the envelopes"],
            Scale::Logarithmic,
            all,
            source,
        ),
    ));
    work.done(item);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{FAITHFUL, N_SAMPLES, SHOWN_WINDOWS_M, framing};
    use shagreen_core::signals::profile_stimuli::{PaperTexture, STEP_M};
    use shagreen_core::signals::spatial_spectrogram::{
        PAPER_WINDOWS_M, SpatialSpectrogram, Transform, fidelity_by_window, profile_of,
    };

    #[test]
    fn all_windows_of_the_paper_fit_the_textures() {
        assert!(PAPER_WINDOWS_M.iter().all(|window_m| framing(*window_m).n_frames(N_SAMPLES).is_ok()));
    }

    /// With windows inside the texture only, the ends of texture B would rise above 1000, and its correlation at 2 mm be 0.71.
    #[test]
    fn reconstructions_stay_in_the_range_of_the_texture_also_at_its_ends() {
        let profile = PaperTexture::B.profile(N_SAMPLES);
        for window_m in SHOWN_WINDOWS_M {
            let transform = Transform::new(framing(window_m));
            let spectrogram = SpatialSpectrogram::of(&profile, &transform).unwrap();
            let made = profile_of(&spectrogram, &transform);
            assert!(made.iter().all(|value| (-0.5..=1.5).contains(value)), "window of {window_m} m");
        }
    }

    /// A window of 2 mm keeps the textures in position, one of 5 mm does not.
    #[test]
    fn the_envelopes_stay_up_to_a_window_of_2_mm() {
        let framings = [5e-3, 2e-3].map(framing);
        let of = |texture: PaperTexture| {
            let found = fidelity_by_window(&texture.profile(N_SAMPLES), STEP_M, &framings).unwrap();
            found.iter().map(|of| of.envelope_correlation).collect::<Vec<f64>>()
        };
        let found = PaperTexture::ALL.map(of);
        assert!(found.iter().all(|of| of[1] >= FAITHFUL), "{found:?}");
        assert!(found.iter().all(|of| of[0] < FAITHFUL), "{found:?}");
    }
}
