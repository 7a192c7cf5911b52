"""Timing of peer benchmarks."""
import json, os, time


def bench(case, peer, units, unit, work, note=lambda result: ""):
    """Prints one JSON line per repetition; `note` describes the result of `work`."""
    said = note(work())
    start = time.perf_counter()
    work()
    inner = max(1, int(0.3 / (time.perf_counter() - start)))
    for _ in range(int(os.environ.get("BENCH_REPS", 5))):
        cpu, wall = time.process_time(), time.perf_counter()
        for _ in range(inner):
            work()
        cpu, wall = (time.process_time() - cpu) / inner, (time.perf_counter() - wall) / inner
        print(json.dumps(dict(case=case, peer=peer, cpu_s=cpu, wall_s=wall, units=units,
                              unit=unit, per_s=units / cpu, threads=1, note=said)), flush=True)
