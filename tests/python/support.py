"""The command line beside the module: runs it in a temporary folder and reads what it writes."""

import json
import os
import struct
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]


class Bench(unittest.TestCase):
    """A test with a temporary folder, in which the program runs."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_program(self, *arguments):
        """Runs the program, which must succeed, and returns its standard output."""
        done = self.program(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def program(self, *arguments):
        """Runs the program."""
        environment = {**os.environ, "XDG_DATA_HOME": str(self.folder / "data")}
        command = [os.environ["SHAGREEN"], *map(str, arguments)]
        return subprocess.run(
            command, cwd=self.folder, env=environment, capture_output=True, text=True, check=False
        )

    def json(self, *arguments):
        """Runs the program and returns its result."""
        return json.loads(self.run_program(*arguments, "--json"))

    def rendered(self, *arguments):
        """Samples and rate that `shagreen render` writes."""
        self.run_program("render", *arguments, "-o", "out.wav")
        return read_wav(self.folder / "out.wav")


def read_wav(path):
    """Samples and rate of a WAV file with one channel of 32-bit floats."""
    data = Path(path).read_bytes()
    assert data[:4] == b"RIFF" and data[8:12] == b"WAVE"
    at, rate_hz, samples = 12, None, None
    while at + 8 <= len(data):
        kind, size = data[at : at + 4], struct.unpack("<I", data[at + 4 : at + 8])[0]
        if kind == b"fmt ":
            n_channels, rate_hz = struct.unpack("<HI", data[at + 10 : at + 16])
            assert n_channels == 1
        if kind == b"data":
            samples = np.frombuffer(data[at + 8 : at + 8 + size], dtype="<f4")
        at += 8 + size + size % 2
    return samples, rate_hz
