//! Timing of benchmarks.

use std::time::Instant;

/// CPU seconds of the main thread, the only one that works here, from Linux schedstat; wall-clock seconds elsewhere.
fn cpu_secs(start: Instant) -> f64 {
    let stat = std::fs::read_to_string("/proc/self/schedstat").unwrap_or_default();
    let ns = stat.split_whitespace().next().and_then(|ns| ns.parse::<f64>().ok());
    ns.map_or_else(|| start.elapsed().as_secs_f64(), |ns| ns * 1e-9)
}

/// Shortest measurement in s: the scheduler updates the CPU time of a running thread only every few milliseconds.
const MIN_SECS: f64 = 0.3;

/// Runs `work` once to warm up, then `BENCH_REPS` times (default 5) for at least [`MIN_SECS`].
///
/// Prints a line per repetition, with the seconds of one call.
pub(crate) fn bench(case: &str, units: f64, unit: &str, mut work: impl FnMut()) {
    bench_noted(case, units, unit, || {
        work();
        String::new()
    });
}

/// As [`bench`], with the text that `work` returns as a note in each line.
pub(crate) fn bench_noted(case: &str, units: f64, unit: &str, work: impl FnMut() -> String) {
    bench_peer(case, "shagreen", units, unit, work);
}

/// As [`bench_noted`], for a peer crate.
pub(crate) fn bench_peer(case: &str, peer: &str, units: f64, unit: &str, mut work: impl FnMut() -> String) {
    let reps = std::env::var("BENCH_REPS").ok().and_then(|r| r.parse().ok()).unwrap_or(5);
    let warm = Instant::now();
    let note = work();
    let inner = (MIN_SECS / warm.elapsed().as_secs_f64()).ceil().max(1.0);
    for _ in 0..reps {
        let wall = Instant::now();
        let cpu = cpu_secs(wall);
        for _ in 0..inner as usize {
            work();
        }
        let (wall, cpu) = (wall.elapsed().as_secs_f64() / inner, (cpu_secs(wall) - cpu) / inner);
        let line = serde_json::json!({
            "case": case, "peer": peer, "wall_s": wall, "cpu_s": cpu,
            "units": units, "unit": unit, "threads": 1, "inner": inner, "per_s": units / cpu, "note": note,
        });
        println!("{line}");
    }
}
