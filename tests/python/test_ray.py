"""The example of a cluster runs on two workers of Ray, where Ray is installed."""

import importlib.util
import os
import subprocess
import sys

from support import ROOT, Bench

EXAMPLE = ROOT / "examples" / "python" / "ray_leave_one_out.py"


class Cluster(Bench):
    """The results of the workers are those of this process, which the example checks itself."""

    def test_the_example_runs_on_two_workers(self):
        if importlib.util.find_spec("ray") is None:
            self.skipTest("Ray is not installed")
        command = [sys.executable, EXAMPLE, "--textures", "40", "--workers", "2"]
        # Ray keeps a key in the home folder.
        environment = {**os.environ, "HOME": str(self.folder)}
        done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False, timeout=900)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        lines = done.stdout.splitlines()
        for library in ["starter", "simulated"]:
            errors = [line.split() for line in lines if line.startswith(library)]
            self.assertEqual([words[1] for words in errors], ["field", "parametric", "shared", "power", "paper"])
            self.assertTrue(all(0 < float(words[2]) < 40 and 0 < float(words[3]) < 40 for words in errors), errors)
        self.assertTrue(any(line.startswith("40 textures rendered") for line in lines), done.stdout)
