"""Libraries, evaluation and all that has a command beside it give the numbers of the command line."""

import re
from pathlib import Path

import numpy as np

import shagreen
from support import Bench, read_wav


class Libraries(Bench):
    """What a library says about itself."""

    def test_a_library_is_a_table_of_textures(self):
        library = shagreen.load_library()
        listed = self.json("library", "list")
        self.assertEqual(library.ids, [texture["id"] for texture in listed["textures"]])
        self.assertEqual((len(library), list(library)), (25, library.ids))
        self.assertEqual(library.axes, ["rough-smooth", "hard-soft"])
        self.assertEqual(library.positions.shape, (25, 2))
        self.assertTrue(((library.positions >= 0) & (library.positions <= 100)).all())
        self.assertEqual(set(library.label_sources), {"physical"})
        self.assertEqual(set(library.provenance), {"free"})
        self.assertTrue(all(library.licenses) and library.license in library.licenses)
        self.assertIn("cork", library)
        self.assertNotIn("crok", library)
        self.assertNotIn(7, library)
        self.assertIn("centroid", library.known_axes())
        self.assertEqual(shagreen.load_library("starter").ids, library.ids)
        self.assertIn("25 textures", repr(library))

    def test_a_texture_describes_itself(self):
        library = shagreen.load_library()
        cork = library["cork"]
        self.assertEqual((cork.id, cork.parents, cork.at), ("cork", {"cork": 1.0}, None))
        self.assertEqual(cork.license, library.license)
        fields = ("speed_mps", "force_n", "level_mps2", "lsf_rad")
        self.assertEqual(cork.nodes.dtype.names, fields)
        self.assertTrue((np.diff(cork.nodes["lsf_rad"], axis=1) > 0).all())
        authored = library.author((30, 70), name="Between")
        self.assertEqual((authored.name, authored.id, authored.at), ("Between", "between", [30.0, 70.0]))
        self.assertAlmostEqual(sum(authored.parents.values()), 1.0)
        self.assertIn("Authored at", authored.origin)
        with self.assertWarnsRegex(shagreen.ShagreenWarning, "outside the convex hull"):
            outside = library.author((0, 100))
        self.assertTrue(outside.clamped)

    def test_a_file_is_loaded_by_its_path(self):
        self.run_program("space", "place", "--attributes", self.table(), "--out", "l.json", "--source", "estimated")
        library = shagreen.load_library(self.folder / "l.json")
        placed = ~np.isnan(library.positions[:, 0])
        self.assertEqual(int(placed.sum()), 3)
        self.assertEqual(library.label_sources.count("estimated"), 3)

    def table(self):
        path = self.folder / "a.csv"
        path.write_text("id,rs,hs\ncork,10,10\nfelt,90,20\nbrick,40,80\n")
        return path


class Numbers(Bench):
    """Results beside those of the command line."""

    @classmethod
    def setUpClass(cls):
        cls.library = shagreen.load_library()

    def test_spectra(self):
        for texture, arguments in [
            (self.library["cork"], ["--texture", "cork"]),
            (self.library.author((30, 70)), ["--at=30,70"]),
        ]:
            expected = self.json("texture", "psd", *arguments, "--speed", 100, "--force", 1)
            hz, psd = texture.psd(0.1, 1.0)
            np.testing.assert_allclose(hz, expected["hz"], rtol=1e-12)
            np.testing.assert_allclose(psd, expected["psd"], rtol=1e-9)
            self.assertAlmostEqual(texture.level(0.1, 1.0), expected["rms"], places=9)
            chosen, at_chosen = texture.psd(0.1, 1.0, frequencies_hz=hz[10:12].copy())
            np.testing.assert_array_equal(chosen, hz[10:12])
            np.testing.assert_allclose(at_chosen, psd[10:12], rtol=1e-12)

    def test_the_evaluation(self):
        expected = self.json("evaluate", "leave-one-out", "--blend", "all", "--signals", 0)
        found = self.library.evaluate("all")
        self.assertEqual(found["methods"][0], "nearest")
        self.assertEqual(found["best"], expected["best"])
        self.assertEqual(found["ids"], [texture["id"] for texture in expected["textures"]])
        self.assertEqual(found["on_hull"], expected["on_hull"])
        self.assertEqual(found["position_caveat"], expected["position_caveat"])
        for row, method in enumerate(found["methods"]):
            for name in ["error_db", "level_error_db", "shape_error_db", "rank", "nrs"]:
                column = [texture[name][method] for texture in expected["textures"]]
                np.testing.assert_allclose(found[name][row], column, rtol=1e-12)
            summary = expected["nearest"] if method == "nearest" else expected["modes"][method]
            self.assertAlmostEqual(found["summary"]["error_db_mean"][row], summary["error_db_mean"])
        self.assertTrue(np.isnan(found["signal_error_db"]).all())
        rendered = self.library.evaluate(["field"], signals=2, seconds=4, seed=5)
        self.assertEqual((rendered["methods"], rendered["error_db"].shape[0]), (["nearest", "field"], 2))
        self.assertGreaterEqual(int(np.isfinite(rendered["signal_error_db"][1]).sum()), 2)

    def test_quality(self):
        cork, felt = self.library["cork"], self.library["felt"]
        a, b = cork.render(0.1, 1, 1.7), felt.render(0.1, 1, 1.7)
        for name, texture in [("a.wav", "cork"), ("b.wav", "felt")]:
            motion = ["--speed", 100, "--force", 1, "--seconds", 1.7]
            self.run_program("render", "--texture", texture, *motion, "-o", name)
        expected = self.json("quality", "a.wav", "b.wav")
        found = shagreen.quality(a, b, cork.rate_hz)
        self.assertAlmostEqual(found["d_prime"], expected["dprime"], places=6)
        self.assertEqual(found["d_prime_applies"], expected["dprime_applies"])
        self.assertAlmostEqual(found["snr_db"], expected["snr_db"], places=6)
        self.assertAlmostEqual(found["distances"]["roughness"], expected["roughness"]["distance"], places=9)
        self.assertAlmostEqual(found["features"]["brightness_hz"][1], expected["brightness"]["test"], places=6)
        same = shagreen.quality(a, a, cork.rate_hz)
        self.assertEqual((same["d_prime"], same["snr_db"]), (0.0, float("inf")))
        with self.assertWarnsRegex(shagreen.ShagreenWarning, "the first"):
            shagreen.quality(a, a[:-1].copy(), cork.rate_hz)

    def test_differences(self):
        cork = self.library["cork"]
        self.assertAlmostEqual(shagreen.difference(cork, cork)["error_db"], 0)
        quiet = shagreen.difference(cork, cork.shaped(level=-6))
        self.assertAlmostEqual(quiet["level_error_db"], 6, places=3)
        # The measure of the evaluation: the copy of the nearest texture against the original.
        found = self.library.evaluate()
        for column, (texture, nearest) in enumerate(zip(found["ids"], found["nearest"])):
            error = shagreen.difference(self.library[nearest], self.library[texture])["error_db"]
            self.assertAlmostEqual(error, found["error_db"][0][column], places=9)

    def test_exports_are_those_of_the_command_line(self):
        formats = shagreen.export_formats()
        self.assertLessEqual({"hatt", "hjif", "maps"}, {format["id"] for format in formats})
        for format in formats:
            name = format["id"]
            # Files may refer to each other by name, so that both exports have the same names in two folders.
            here, there = (self.folder / side / name / f"cork.{format['ending']}" for side in ["here", "there"])
            here.parent.mkdir(parents=True)
            there.parent.mkdir(parents=True)
            done = shagreen.export(self.library["cork"], name, here)
            said = self.json("export", "--texture", "cork", "--format", name, "-o", there)
            self.assertEqual(done["files"][0], str(here))
            self.assertEqual(*([Path(file).name for file in of["files"]] for of in [done, said]), name)
            self.assertEqual((done["lost"], done["license"]), (said["lost"], said["licence"]))
            for file in map(Path, done["files"]):
                texts = file.read_bytes(), (there.parent / file.name).read_bytes()
                # Only the day of the export may differ.
                self.assertEqual(*(re.sub(rb'"\d{4}-\d\d-\d\d"', b"", text) for text in texts), file.name)
        authored = shagreen.export(self.library.author((30, 70)), "hatt", self.folder / "authored.xml")
        self.assertTrue(authored["license"])

    def test_a_fit_and_its_attributes(self):
        felt = self.library["felt"]
        rate_hz, n = 2000, 24000
        time = np.arange(n) / rate_hz
        speed = np.where(time < 6, 0.05, 0.12) + 0 * time
        force = np.where((time // 3) % 2 == 0, 0.5, 1.0) + 0 * time
        signal = felt.render(speed, force, rate_hz=rate_hz, seed=2, dtype=np.float64)
        fitted, report = shagreen.fit(signal, speed[1:], force[1:], rate_hz, name="Felt again", license="CC0-1.0")
        self.assertEqual((fitted.name, fitted.license), ("Felt again", "CC0-1.0"))
        self.assertGreater(report["segments"], 2)
        self.assertTrue(0 < report["gfc_median"] <= 1)
        axes = np.stack([signal, 0.5 * signal], axis=1)
        again, _ = shagreen.fit(axes, speed[1:], force[1:], rate_hz, order=10, model_rate_hz=1000)
        self.assertEqual(again.nodes["lsf_rad"].shape[1], 10)
        narrow, _ = shagreen.fit(axes.astype(np.float32), speed[1:], force[1:], rate_hz, order=10, model_rate_hz=1000)
        np.testing.assert_array_equal(narrow.nodes, again.nodes)
        predicted = shagreen.predict_attributes(fitted)
        self.assertIn("rough-smooth", predicted["attributes"])
        for of in predicted["attributes"].values():
            self.assertTrue(0 <= of["value"] <= 100 and of["sd"] > 0)
        own = shagreen.predict_attributes(fitted, self.library)
        self.assertEqual(own["label_sources"], ["physical"])

    def test_a_prompt(self):
        prompt = "smooth cold steel, not soft, blorp"
        found, expected = shagreen.predict_prompt(prompt), self.json("predict", "attributes", "--prompt", prompt)
        self.assertEqual(found["attributes"].keys(), expected["attributes"].keys())
        for name, of in found["attributes"].items():
            self.assertAlmostEqual(of["value"], expected["attributes"][name]["value"], places=9)
            self.assertAlmostEqual(of["sd"], expected["attributes"][name]["sd"], places=9)
        for name in ["words", "unknown", "disputed", "is_about_touch", "model"]:
            self.assertEqual(found[name], expected[name], name)
        nothing = shagreen.predict_prompt("")
        self.assertFalse(nothing["is_about_touch"] or nothing["words"])

    def test_a_photo_as_a_file_and_as_pixels(self):
        x, y = np.meshgrid(np.arange(96), np.arange(64))
        gray = ((31 * x * x + 57 * y * y) % 251).astype(np.uint8)
        photo = np.ascontiguousarray(np.repeat(gray[:, :, None], 3, axis=2))
        path = self.folder / "photo.bmp"
        path.write_bytes(bitmap(photo))
        of_file, of_pixels = shagreen.predict_photo(path), shagreen.predict_photo(photo)
        self.assertEqual(of_file["attributes"], of_pixels["attributes"])
        expected = self.json("predict", "attributes", "--photo", path)
        for name, of in of_file["attributes"].items():
            self.assertAlmostEqual(of["value"], expected["attributes"][name]["value"], places=9)
            self.assertAlmostEqual(of["sd"], expected["attributes"][name]["sd"], places=9)

    def test_the_rate_of_a_file_is_that_of_the_texture(self):
        _, rate_hz = self.rendered("--texture", "cork", "--speed", 100, "--force", 1, "--seconds", 0.1)
        self.assertEqual(self.library["cork"].rate_hz, rate_hz)
        samples, _ = read_wav(self.folder / "out.wav")
        self.assertEqual(len(self.library["cork"].render(0.1, 1, 0.1)), len(samples))


def bitmap(photo):
    """A picture as an uncompressed bitmap file, whose rows must have a multiple of four bytes."""
    height, width, _ = photo.shape
    rows = photo[::-1, :, ::-1].tobytes()
    header = b"BM" + (54 + len(rows)).to_bytes(4, "little") + bytes(4) + (54).to_bytes(4, "little")
    sizes = width.to_bytes(4, "little") + height.to_bytes(4, "little")
    about = (40).to_bytes(4, "little") + sizes + b"\x01\x00\x18\x00" + bytes(4)
    return header + about + len(rows).to_bytes(4, "little") + bytes(16) + rows
