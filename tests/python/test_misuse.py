"""Wrong arguments are refused with one clear error. Nothing crashes, and no panic arrives."""

import math

import numpy as np

import shagreen
from support import Bench

REFUSED = (shagreen.ShagreenError, TypeError)


class Misuse(Bench):
    """Each line of a table must fail with these words."""

    @classmethod
    def setUpClass(cls):
        cls.library = shagreen.load_library()
        cls.cork = cls.library["cork"]

    def check(self, table):
        for work, error, words in table:
            with self.subTest(words=words), self.assertRaisesRegex(error, words):
                work()

    def test_renderings(self):
        render, ones = self.cork.render, np.ones
        error = shagreen.ShagreenError
        self.check(
            [
                (lambda: render(0.1, 1), error, "seconds is missing"),
                (lambda: render("fast", 1, 1), TypeError, "speed_mps must be a number, not str"),
                (lambda: render(0.1, None, 1), TypeError, "force_n must be a number"),
                (lambda: render(-0.1, 1, 1), error, "speed_mps is -0.1; it must be from 0"),
                (lambda: render(math.nan, 1, 1), error, "speed_mps is NaN"),
                (lambda: render(0.1, math.inf, 1), error, "force_n is inf"),
                (lambda: render(10**400, 1, 1), error, "speed_mps is inf"),
                (lambda: render(0.1, 1, -1), error, "seconds is -1"),
                (lambda: render(0.1, 1, 1e9), error, "seconds is 1000000000"),
                (lambda: render(0.1, 1, 0), error, "contain no sample"),
                (lambda: render(0.1, 1, 3600, rate_hz=768000), error, "too many"),
                (lambda: render(0.1, 1, 1, rate_hz=100), error, "sample rate must lie between"),
                (lambda: render(0.1, 1, 1, rate_hz=0), error, "rate_hz is 0"),
                (lambda: render(0.1, 1, 1, rate_hz=-5), error, "rate_hz is -5"),
                (lambda: render(0.1, 1, 1, rate_hz=1000.5), error, "must be a whole number"),
                (lambda: render(0.1, 1, 1, seed=-1), error, "seed must be a whole number from 0"),
                (lambda: render(0.1, 1, 1, seed=2**64), error, "seed must be a whole number"),
                (lambda: render(0.1, 1, 1, seed=1.5), TypeError, "seed must be a whole number, not float"),
                (lambda: render(0.1, 1, 1, dtype="int16"), TypeError, "float32 or float64, not int16"),
                (lambda: render(0.1, 1, 1, dtype="nothing"), TypeError, "nothing"),
                (lambda: render(0.1, 1, 1, volume=3), TypeError, "volume"),
                (lambda: render(ones(9), ones(8)), error, "has 9 rows and force_n has 8"),
                (lambda: render(ones(1), ones(1)), error, "at least 2 rows, got 1"),
                (lambda: render(ones(0), 1), error, "at least 2 rows, got 0"),
                (lambda: render(ones(9), 1, 1), error, "leave seconds out"),
                (lambda: render(ones(9, dtype=int), 1), TypeError, "not an array of int64 with 1 dimensions"),
                (lambda: render(ones((9, 2)), 1), TypeError, "float64 with 2 dimensions"),
                (lambda: render(ones(9).astype(">f8"), 1), TypeError, "speed_mps must be a one-dimensional"),
                (lambda: render(-ones(9), 1), error, r"speed_mps\[0\] is -1"),
                (lambda: render(1, np.array([1, 2, math.nan])), error, r"force_n\[2\] is NaN"),
                (lambda: render(ones(9), 1, stroke_rate_hz=0), error, "stroke_rate_hz is 0"),
                (lambda: render(ones(9), 1, stroke_rate_hz=0.001), error, "more than 3600 s"),
                (lambda: render([1.0, 2.0], 1), TypeError, "not list"),
            ]
        )

    def test_libraries_and_projects(self):
        error = shagreen.ShagreenError
        (self.folder / "notes.json").write_text("my notes")
        (self.folder / "empty").mkdir()
        load, author = shagreen.load_library, self.library.author
        self.check(
            [
                (lambda: load(self.folder / "none.json"), error, "there is no such file"),
                (lambda: load("a\0b"), REFUSED + (ValueError,), ""),
                (lambda: load(3), TypeError, ""),
                (lambda: load(self.folder / "notes.json"), error, "notes.json"),
                (lambda: load(self.folder / "empty"), error, "contains no texture library"),
                (lambda: shagreen.load_project(self.folder / "none"), error, "there is no such file"),
                (lambda: shagreen.load_project(self.folder), error, "folder"),
                (lambda: self.library["crok"], error, "did you mean cork"),
                (lambda: self.library[3], TypeError, ""),
                (lambda: self.library.placed_on([]), error, "1 to 6 axes, got 0"),
                (lambda: self.library.placed_on(["warmth"]), error, "no texture has the axis"),
                (lambda: author((30,)), error, "1 coordinate, but the space has 2 axes"),
                (lambda: author((30, 130)), error, "hard-soft is 130"),
                (lambda: author((30, math.nan)), error, "hard-soft is NaN"),
                (lambda: author({"warmth": 3}), error, 'no axis "warmth"'),
                (lambda: author({3: 3}), TypeError, ""),
                (lambda: author("30,70"), TypeError, "a point must be a sequence"),
                (lambda: author(30), TypeError, "a point must be a sequence"),
                (lambda: author((30, 70), mode="loud"), error, 'no mode "loud"; choose one of field'),
                (lambda: author((30, 70), mode="shared", pinned=["cork"]), error, "only in mode field"),
                (lambda: author((30, 70), pinned=["crok"]), error, "did you mean cork"),
                (lambda: author((30, 70), pinned="cork"), TypeError, ""),
                (lambda: author((30, 70), natural=True), error, "only in mode parametric"),
                (lambda: author((30, 70), shape={"level": 99}), error, "level of the shape is 99"),
                (lambda: author((30, 70), shape={"level": math.nan}), error, "level of the shape"),
                (lambda: author((30, 70), shape={"volume": 1}), error, 'no "volume"'),
                (lambda: self.cork.shaped(level="loud"), TypeError, "level must be a number"),
                (lambda: self.library.evaluate("loud"), error, 'no mode "loud"'),
                (lambda: self.library.evaluate(3), TypeError, "modes must be a mode"),
                (lambda: self.library.evaluate(signals=-1), error, "signals must be a whole number"),
                (lambda: self.library.evaluate(signals=1, seconds=1), error, "seconds is 1; it must be from 4"),
                (lambda: shagreen.Library(), TypeError, ""),
                (lambda: setattr(self.cork, "name", "x"), AttributeError, ""),
            ]
        )

    def test_signals_and_files(self):
        error = shagreen.ShagreenError
        noise = np.random.default_rng(1).normal(size=4000)
        broken = noise.copy()
        broken[5] = math.nan
        (self.folder / "notes.xml").write_text("my notes")
        export, quality, fit = shagreen.export, shagreen.quality, shagreen.fit
        self.check(
            [
                (lambda: quality(noise, noise, 0), error, "rate_hz is 0"),
                (lambda: quality(noise, noise[:99].copy(), 2000), error, "one segment needs 1600"),
                (lambda: quality(noise, broken, 2000), error, r"test\[5\] is not a finite number"),
                (lambda: quality(noise, noise.astype(complex), 2000), TypeError, "test must be"),
                (lambda: quality(noise, noise, 2000, threshold="ear"), error, 'no threshold "ear"'),
                (lambda: quality(noise, noise, 2000, model=self.folder / "notes.xml"), error, "not a quality model"),
                (lambda: quality(1e300 * noise, noise, 2000), error, "d' is not finite"),
                (lambda: shagreen.difference(self.cork, 3), TypeError, ""),
                (lambda: export(self.cork, "mp3", self.folder / "a"), error, 'no format "mp3"'),
                (lambda: export(self.cork, "hatt", self.folder / "notes.xml"), error, "would replace"),
                (lambda: export(self.cork, "hatt", self.folder / "none" / "a.xml"), error, ""),
                (lambda: fit(noise, 0.1, 1.0, 100), error, "rate_hz is 100; it must be from 500"),
                (lambda: fit(noise, 0.1, 1.0, math.nan), error, "rate_hz is NaN"),
                (lambda: fit(noise, np.ones(9), 1.0, 2000), error, "speed"),
                (lambda: fit(noise[:0], 0.1, 1.0, 2000), error, ""),
                (lambda: fit(noise, 0.1, 1.0, 2000, order=0), error, "order must be a whole number from 1"),
                (lambda: fit(noise, 0.1, 1.0, 2000, order=10**30), error, "order must be a whole number"),
                (lambda: fit(np.zeros((100, 9)), 0.1, 1.0, 2000), error, ""),
                (lambda: fit("noise", 0.1, 1.0, 2000), TypeError, "acceleration_mps2 must be"),
                (lambda: fit(np.zeros((9, 2), int), 0.1, 1.0, 2000), TypeError, "one or two dimensions, not"),
                (lambda: fit(np.zeros((9, 2, 2)), 0.1, 1.0, 2000), TypeError, "float64 with 3 dimensions"),
                (lambda: shagreen.predict_prompt(3), TypeError, ""),
                (lambda: shagreen.predict_photo(np.zeros((4, 4), np.uint8)), TypeError, "height, width, 3"),
                (lambda: shagreen.predict_photo(np.zeros((4, 4, 3))), TypeError, "array of uint8"),
                (lambda: shagreen.predict_photo(np.zeros((0, 4, 3), np.uint8)), error, "4 x 0 pixels"),
                (lambda: shagreen.predict_photo(self.folder / "notes.xml"), error, "notes.xml"),
                (lambda: shagreen.predict_photo(3), TypeError, "photo must be a path"),
            ]
        )

    def test_blends_and_nodes(self):
        error, cork, blend = shagreen.ShagreenError, self.cork, shagreen.blend
        mixed = self.library.author((30, 70), mode="shared")
        nodes = {name: cork.nodes[name] for name in cork.nodes.dtype.names}
        made = shagreen.Texture.from_nodes

        def changed(**fields):
            return lambda: made("New", 1000, {**nodes, **fields})

        self.check(
            [
                (lambda: blend([], []), error, "1 to 3 textures, got 0"),
                (lambda: blend([cork] * 4, [1] * 4), error, "got 4"),
                (lambda: blend([cork, cork], [1]), error, "2 textures and 1 weights"),
                (lambda: blend([cork, cork], [1, -1]), error, "a weight is -1"),
                (lambda: blend([cork, cork], [0, 0]), error, "the sum of the weights is 0"),
                (lambda: blend([cork, cork], [1e308, 1e308]), error, "finite"),
                (lambda: blend([cork, 3], [1, 1]), TypeError, ""),
                (lambda: blend([cork, cork], [1, 1], mode="field"), error, "takes no weights"),
                (lambda: blend([cork, mixed], [1, 1]), error, "no single texture model"),
                (lambda: mixed.nodes, error, "no single texture model"),
                (lambda: cork.psd(0.1, 1, frequencies_hz=np.array([-1.0])), error, "a frequency is -1"),
                (lambda: cork.psd(0.1, 1, bins=1), error, "bins must be a whole number from 2"),
                (lambda: cork.psd(0.1, np.ones(3)), TypeError, "force_n must be a number"),
                (lambda: cork.level(0.1, 1, direction_deg=1e9), error, "direction_deg is"),
                (lambda: made("New", 1000, {}), error, "no field speed_mps"),
                (lambda: made("New", 1000, 3), error, "no field speed_mps"),
                (lambda: made("New", 1000, cork.nodes[:0]), error, ""),
                (lambda: made("New", math.nan, nodes), error, "got NaN"),
                (lambda: made("New", 1000, nodes, friction=-1), error, "friction"),
                (lambda: made("New", 1000, nodes, tap={"frequency_hz": 100}), error, "no decay_per_s"),
                (
                    lambda: made(
                        "New", 1000, nodes, tap={"frequency_hz": -1, "decay_per_s": 9, "amplitude_mps2": 1}
                    ),
                    error,
                    "frequency is -1e0",
                ),
                (changed(speed_mps=-cork.nodes["speed_mps"]), error, "speed"),
                (changed(level_mps2=math.nan * cork.nodes["level_mps2"]), error, "level"),
                (changed(level_mps2=np.ones(3)), error, "level_mps2 has 3 rows"),
                (changed(lsf_rad=cork.nodes["lsf_rad"][:, ::-1]), error, ""),
                (changed(lsf_rad=np.ones((len(cork.nodes), 0))), error, ""),
                (changed(force_n=["a"] * len(cork.nodes)), error, "holds no numbers"),
            ]
        )

    def test_errors_are_value_errors_with_the_text_of_the_command_line(self):
        said = self.program("render", "--texture", "crok", "--speed", 1, "--force", 1, "--seconds", 1, "-o", "a.wav")
        with self.assertRaises(ValueError) as caught:
            self.library["crok"]
        self.assertEqual(said.stderr.strip(), f"error: {caught.exception}")
        self.assertTrue(issubclass(shagreen.ShagreenWarning, UserWarning))
