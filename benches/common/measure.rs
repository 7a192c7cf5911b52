//! Measuring a piece of work, for all benchmarks.

use std::time::Instant;

/// CPU seconds of the main thread, the only one that works here, where the system tells them to the nanosecond; seconds
/// on the clock elsewhere.
fn cpu_secs(start: Instant) -> f64 {
    let stat = std::fs::read_to_string("/proc/self/schedstat").unwrap_or_default();
    let ns = stat.split_whitespace().next().and_then(|ns| ns.parse::<f64>().ok());
    ns.map_or_else(|| start.elapsed().as_secs_f64(), |ns| ns * 1e-9)
}

/// Shortest measurement: what a running thread has used is booked at the scheduler's ticks, milliseconds apart.
const MIN_SECS: f64 = 0.3;

/// Runs `work` to warm up and then `BENCH_REPS` times (5 without it) for at least [`MIN_SECS`], and prints a line for
/// each: seconds are those of one call.
pub(crate) fn bench(case: &str, units: f64, unit: &str, mut work: impl FnMut()) {
    bench_noted(case, units, unit, || {
        work();
        String::new()
    });
}

/// As [`bench`], with what `work` says of its result beside the figures.
pub(crate) fn bench_noted(case: &str, units: f64, unit: &str, work: impl FnMut() -> String) {
    bench_peer(case, "shagreen", units, unit, work);
}

/// As [`bench_noted`], for a peer that is a crate.
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
