//! Pen recordings: synthetic ones, and reading of recordings for comparison.

use std::fmt::Write as _;

/// One sample, in mm and s.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample {
    pub(crate) time_secs: f64,
    pub(crate) x_mm: f64,
    pub(crate) y_mm: f64,
    pub(crate) touching: bool,
}

/// Returns the samples of a .svc file, with this length in mm and time in s of one unit.
pub(crate) fn read(text: &str, mm_per_unit: f64, secs_per_unit: f64) -> Vec<Sample> {
    let rows: Vec<Vec<f64>> = text
        .lines()
        .skip(1)
        .map(|line| line.split_whitespace().map(|value| value.parse().unwrap()).collect())
        .collect();
    let start = rows[0][2];
    let sample = |row: &Vec<f64>| Sample {
        time_secs: (row[2] - start) * secs_per_unit,
        x_mm: row[0] * mm_per_unit,
        y_mm: row[1] * mm_per_unit,
        touching: row[3] != 0.0,
    };
    rows.iter().map(sample).collect()
}

/// Duration of [`synthetic`], in seconds.
pub(crate) const SYNTHETIC_SECS: f64 = 9.0;
/// Time during which the tip of [`synthetic`] is lifted, in seconds.
pub(crate) const SYNTHETIC_LIFT_SECS: std::ops::Range<f64> = 4.0..5.0;

/// Returns a recording in raw counts at about 130 Hz: circles at 20 to 220 mm/s and constant pressure, with the tip
/// lifted in the middle while the motion continues.
pub(crate) fn synthetic() -> String {
    let mut rows = Vec::new();
    let (mut time_ms, mut walked_mm) = (0_u32, 0.0);
    while f64::from(time_ms) * 1e-3 <= SYNTHETIC_SECS {
        let time_secs = f64::from(time_ms) * 1e-3;
        let touching = !SYNTHETIC_LIFT_SECS.contains(&time_secs);
        let angle = walked_mm / 40.0_f64;
        let count = |mm: f64| (mm / 0.005).round() as i64;
        let (x, y) = (count(100.0 + 40.0 * angle.cos()), count(80.0 + 40.0 * angle.sin()));
        let (tip, pressure) = if touching { (1, 12_000) } else { (0, 0) };
        rows.push(format!("{x} {y} {} {tip} 1190 650 {pressure}", 354_642_400 + time_ms));
        let step_ms = if rows.len() % 2 == 0 { 7 } else { 8 };
        let speed_mm_per_s = 120.0 - 100.0 * (std::f64::consts::TAU * time_secs / 3.0).cos();
        walked_mm += speed_mm_per_s * 1e-3 * f64::from(step_ms);
        time_ms += step_ms;
    }
    let mut text = format!("{}\n", rows.len());
    for row in rows {
        let _ = writeln!(text, "{row}");
    }
    text
}

/// Window of a stroke and of the signal rendered from it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Window {
    pub(crate) speed_mm_per_s: f64,
    pub(crate) rms: f64,
}

/// Returns the windows of `secs` during which, and for `secs` before which, the tip always touches (`touching`) or is
/// lifted: the tap transient of a landing and the fade after lift-off lie in none of them.
pub(crate) fn windows(
    samples: &[Sample],
    signal: &[f64],
    rate_hz: f64,
    secs: f64,
    touching: bool,
) -> Vec<Window> {
    let end = samples[samples.len() - 1].time_secs;
    let within = |from: f64, to: f64| {
        samples
            .iter()
            .filter(move |sample| sample.time_secs >= from && sample.time_secs <= to)
            .collect::<Vec<_>>()
    };
    let mut windows = Vec::new();
    let mut from = secs;
    while from + secs <= end {
        let to = from + secs;
        let inside = within(from, to);
        let all = within(from - secs, to);
        let steady = all.len() >= 4 && all.iter().all(|sample| sample.touching == touching);
        // A recording may have no samples of a lifted pen: a gap is a lift.
        let starts = all.first().is_some_and(|first| first.time_secs - (from - secs) < 0.04);
        let gapless = all.windows(2).all(|pair| pair[1].time_secs - pair[0].time_secs < 0.04);
        if steady && starts && gapless && inside.len() >= 4 {
            let length: f64 = inside
                .windows(2)
                .map(|pair| (pair[1].x_mm - pair[0].x_mm).hypot(pair[1].y_mm - pair[0].y_mm))
                .sum();
            let span = inside[inside.len() - 1].time_secs - inside[0].time_secs;
            let part = &signal[(from * rate_hz) as usize..((to * rate_hz) as usize).min(signal.len())];
            windows.push(Window { speed_mm_per_s: length / span, rms: super::rms(part) });
        }
        from += secs;
    }
    windows
}

/// Returns Spearman's rank correlation of speed and level.
pub(crate) fn rank_correlation(windows: &[Window]) -> f64 {
    let ranks = |value: fn(&Window) -> f64| {
        let mut order: Vec<usize> = (0..windows.len()).collect();
        order.sort_by(|a, b| value(&windows[*a]).total_cmp(&value(&windows[*b])));
        let mut ranks = vec![0.0; windows.len()];
        for (rank, index) in order.into_iter().enumerate() {
            ranks[index] = rank as f64;
        }
        ranks
    };
    let n = windows.len() as f64;
    let squares: f64 =
        ranks(|w| w.speed_mm_per_s).iter().zip(ranks(|w| w.rms)).map(|(a, b)| (a - b).powi(2)).sum();
    1.0 - 6.0 * squares / (n * (n * n - 1.0))
}
