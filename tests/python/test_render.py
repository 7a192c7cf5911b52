"""Rendered samples are those of `shagreen render`, to the bit."""

import numpy as np

import shagreen
from support import Bench


class Samples(Bench):
    """The same texture, motion, rate and seed give the same samples."""

    @classmethod
    def setUpClass(cls):
        cls.library = shagreen.load_library()

    def check(self, samples, *arguments):
        expected, _ = self.rendered(*arguments)
        self.assertEqual(samples.dtype, np.float32)
        np.testing.assert_array_equal(samples, expected)
        self.assertGreater(np.abs(samples).max(), 0)

    def steady(self, texture, *arguments, rate_hz=None, seed=1):
        """Checks a steady motion of a texture, which the arguments name for the command line."""
        options = [] if rate_hz is None else ["--rate", rate_hz]
        samples = texture.render(0.1, 1.0, 0.5, rate_hz=rate_hz, seed=seed)
        motion = ["--speed", 100, "--force", 1, "--seconds", 0.5, "--seed", seed]
        self.check(samples, *arguments, *motion, *options)

    def test_a_texture_of_the_library(self):
        for texture in ["cork", self.library.ids[-1]]:
            self.steady(self.library[texture], "--texture", texture)
        self.steady(self.library["cork"], "--texture", "cork", seed=2**64 - 1)

    def test_another_rate(self):
        self.steady(self.library["cork"], "--texture", "cork", rate_hz=44100)

    def test_authored_textures(self):
        at = "--at=30,70"
        self.steady(self.library.author((30, 70)), at)
        self.steady(self.library.author(np.array([30.0, 70.0])), at)
        named = self.library.author({"rough-smooth": 30})
        self.steady(named, "--at", "rough-smooth=30")
        self.steady(self.library.author((30, 70), mode="parametric", natural=True), at, "--blend=parametric", "--natural")
        for mode in ["shared", "power", "paper"]:
            self.steady(self.library.author((30, 70), mode=mode), at, "--blend", mode)
        pinned = self.library.author((30, 70), pinned=["cork"], extrapolate=True)
        self.steady(pinned, at, "--lock", "cork", "--extrapolate")
        shaped = self.library.author((30, 70), shape={"level": -6, "grain": 1.5})
        self.steady(shaped, at, "--shape", "level=-6,grain=1.5")

    def test_shapes_and_other_axes(self):
        shaped = self.library["cork"].shaped(level=-6, grain=1.5)
        self.steady(shaped, "--texture", "cork", "--shape", "level=-6,grain=1.5")
        axes = ["rough-smooth", "hard-soft", "centroid"]
        deep = self.library.placed_on(axes).author((30, 70, 40))
        self.steady(deep, "--at=30,70,40", "--axes", ",".join(axes))

    def test_the_simulated_library(self):
        simulated = shagreen.load_library("simulated")
        self.steady(simulated.author((30, 70)), "--at=30,70", "--library", "simulated")

    def test_authored_textures_of_a_project(self):
        self.run_program("project", "new", "--from", "kitchen", "-o", "mine.shagreen")
        project = shagreen.load_project(self.folder / "mine.shagreen")
        self.assertEqual(len(project), len(list(project)))
        name = project.names[0]
        self.steady(project[name], "--project", "mine.shagreen", "--authored", name)
        first = project.library.ids[0]
        self.steady(project.library[first], "--project", "mine.shagreen", "--texture", first)

    def test_a_stroke_with_landings(self):
        rate_hz = 1000
        time = np.arange(1500) / rate_hz
        speed = 0.1 + 0.05 * np.sin(7 * time)
        force = np.clip(np.sin(4 * np.pi * time), 0, None)
        rows = zip(time.tolist(), speed.tolist(), force.tolist())
        table = "t_s,speed_m/s,force_N\n" + "".join(f"{t!r},{v!r},{f!r}\n" for t, v, f in rows)
        (self.folder / "stroke.csv").write_text(table)
        for texture in ["cork", "bumpy-rubber"]:
            samples = self.library[texture].render(speed, force, rate_hz=rate_hz, seed=3)
            self.assertEqual(len(samples), 1499)
            self.check(samples, "--texture", texture, "--stroke", "stroke.csv", "--rate", rate_hz, "--seed", 3)
        slow = self.library["cork"].render(speed, force, rate_hz=48000, stroke_rate_hz=rate_hz)
        self.check(slow, "--texture", "cork", "--stroke", "stroke.csv", "--rate", 48000)
        # A number holds for all rows.
        constant = self.library["cork"].render(0.1, force, rate_hz=rate_hz)
        same = self.library["cork"].render(np.full(1500, 0.1), force, rate_hz=rate_hz)
        np.testing.assert_array_equal(constant, same)

    def test_float64_has_the_same_values(self):
        cork = self.library["cork"]
        wide = cork.render(0.1, 1.0, 0.5, dtype=np.float64)
        self.assertEqual(wide.dtype, np.float64)
        np.testing.assert_array_equal(wide, cork.render(0.1, 1.0, 0.5, dtype="float32"))


class Mixtures(Bench):
    """Weighted blends, and textures from nodes."""

    @classmethod
    def setUpClass(cls):
        cls.library = shagreen.load_library()

    def test_the_ends_of_a_blend_are_its_textures(self):
        cork, felt = self.library["cork"], self.library["felt"]
        blended = shagreen.blend([cork, felt], [1, 0], mode="shared")
        np.testing.assert_array_equal(blended.render(0.1, 1, 0.2), cork.render(0.1, 1, 0.2))
        power = shagreen.blend([cork, felt], [0, 1], mode="power")
        self.assertAlmostEqual(power.level(0.1, 1), felt.level(0.1, 1), places=9)
        half = shagreen.blend([cork, felt], [2, 2])
        self.assertAlmostEqual(half.parents["cork"], 0.5)
        self.assertIsNone(half.at)
        low, high = sorted([cork.level(0.1, 1), felt.level(0.1, 1)])
        self.assertTrue(low < half.level(0.1, 1) < high)

    def test_a_texture_from_its_nodes_sounds_the_same(self):
        cork = self.library["cork"]
        again = shagreen.Texture.from_nodes("Again", cork.rate_hz, cork.nodes, friction=cork.friction, tap=cork.tap)
        self.assertEqual((again.name, again.id, again.tap), ("Again", "again", cork.tap))
        nodes = {name: cork.nodes[name] for name in cork.nodes.dtype.names}
        bare = shagreen.Texture.from_nodes("Bare", cork.rate_hz, nodes)
        self.assertEqual((bare.friction, bare.tap), (None, None))
        for made in [again, bare]:
            self.assertEqual(made.nodes.dtype, cork.nodes.dtype)
            for name, values in nodes.items():
                np.testing.assert_array_equal(made.nodes[name], values)
        # Relief, lay and stick-slip are not nodes.
        self.assertAlmostEqual(again.level(0.1, 1), cork.level(0.1, 1), delta=1e-9)
