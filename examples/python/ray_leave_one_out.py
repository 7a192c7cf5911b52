"""Leave-one-out errors and thousands of rendered textures on a local Ray cluster of two workers.

    pip install ray
    python examples/python/ray_leave_one_out.py [--textures N] [--workers N]

Textures and libraries stay in the process that made them: a worker gets names and coordinates, loads the library itself once,
and returns arrays. The same seed gives the same samples in every worker, which the example checks.
"""

import argparse
import os

# Ray sends statistics about its use otherwise.
os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")

import numpy as np
import ray
from ray.util import ActorPool

import shagreen

MODES = ["field", "parametric", "shared", "power", "paper"]
LIBRARIES = ["starter", "simulated"]
SPEED_MPS, FORCE_N, SECONDS = 0.1, 1.0, 0.5


class Worker:
    """A process that loads each library once."""

    def __init__(self):
        self.libraries = {}

    def library(self, name):
        """The library with this name."""
        if name not in self.libraries:
            self.libraries[name] = shagreen.load_library(name)
        return self.libraries[name]

    def leave_one_out(self, name, mode):
        """Mean errors in dB of a mode and of a copy of the nearest texture."""
        found = self.library(name).evaluate(mode)
        nearest, authored = found["summary"]["error_db_mean"]
        return name, mode, authored, nearest

    def levels(self, points):
        """Root mean square acceleration in m/s² of a rendered stroke at each point, an array of the shape (n,)."""
        textures = (self.library("starter").author(point) for point in points)
        signals = (texture.render(SPEED_MPS, FORCE_N, SECONDS, seed=7) for texture in textures)
        return np.array([np.sqrt(np.mean(np.square(signal, dtype=np.float64))) for signal in signals])


def main():
    """Runs both jobs and prints their results."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--textures", type=int, default=2000, help="number of textures to render")
    parser.add_argument("--workers", type=int, default=2, help="number of workers")
    arguments = parser.parse_args()
    if arguments.textures < 1 or arguments.workers < 1:
        parser.error("--textures and --workers must be at least 1")
    ray.init(num_cpus=arguments.workers, include_dashboard=False, log_to_driver=False)
    workers = ActorPool([ray.remote(Worker).remote() for _ in range(arguments.workers)])

    jobs = [(name, mode) for name in LIBRARIES for mode in MODES]
    print("library    mode        error (dB)  copy of the nearest texture (dB)")
    for name, mode, authored, nearest in workers.map(lambda worker, job: worker.leave_one_out.remote(*job), jobs):
        print(f"{name:10} {mode:10} {authored:11.2f} {nearest:11.2f}")
    print("measured on signals; no person rated these textures")

    # Inside the convex hull of the starter library.
    points = np.random.default_rng(1).uniform([35, 10], [80, 55], size=(arguments.textures, 2))
    parts = np.array_split(points, min(len(points), 8 * arguments.workers))
    rendered = np.concatenate(list(workers.map(lambda worker, part: worker.levels.remote(part), parts)))
    np.testing.assert_array_equal(rendered[: len(parts[0])][:5], Worker().levels(parts[0][:5]))
    print(f"{len(rendered)} textures rendered: {rendered.min():.3f} to {rendered.max():.3f} m/s² rms")
    ray.shutdown()


if __name__ == "__main__":
    main()
