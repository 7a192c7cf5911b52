"""Arrays are handed over without a copy, and other threads go on while Rust works."""

import signal
import threading
import unittest

import numpy as np

import shagreen


class Memory(unittest.TestCase):
    """Returned arrays use the memory of Rust, and outlive what they came from."""

    def is_of_rust(self, array):
        base = array
        while isinstance(base, np.ndarray):
            self.assertFalse(base.flags.owndata)
            base = base.base
        self.assertIsNotNone(base)

    def test_results_are_not_copied(self):
        library = shagreen.load_library()
        cork = library["cork"]
        self.is_of_rust(cork.render(0.1, 1, 0.2))
        self.is_of_rust(cork.render(0.1, 1, 0.2, dtype=np.float64))
        self.is_of_rust(library.positions)
        for array in cork.psd(0.1, 1):
            self.is_of_rust(array)
        evaluated = library.evaluate()
        self.is_of_rust(evaluated["error_db"])
        self.is_of_rust(evaluated["summary"]["error_db_mean"])

    def test_an_array_outlives_its_texture(self):
        samples = shagreen.load_library()["cork"].render(0.1, 1, 0.5)
        copy = samples.copy()
        samples[0] += 1
        self.assertEqual(samples[0], copy[0] + 1)
        np.testing.assert_array_equal(samples[1:], copy[1:])

    def test_inputs_stay_as_they_are(self):
        cork = shagreen.load_library()["cork"]
        speed, force = np.full(500, 0.1), np.full(500, 1.0)
        speed.flags.writeable = False
        cork.render(speed, force)
        self.assertTrue((speed == 0.1).all() and (force == 1.0).all())
        narrow = cork.render(speed.astype(np.float32), force.astype(np.float32))
        self.assertEqual(len(narrow), 499)

    def test_views_with_gaps_say_what_to_do(self):
        cork = shagreen.load_library()["cork"]
        speed = np.full(1000, 0.1)[::2]
        with self.assertRaisesRegex(shagreen.ShagreenError, r"ascontiguousarray\(speed_mps\)"):
            cork.render(speed, 1.0)
        self.assertEqual(len(cork.render(np.ascontiguousarray(speed), 1.0)), 499)


class Threads(unittest.TestCase):
    """Work of Rust does not hold the lock of the interpreter."""

    def test_python_goes_on_during_a_rendering(self):
        cork = shagreen.load_library()["cork"]
        count, done = 0, threading.Event()

        def work():
            cork.render(0.1, 1, 20, rate_hz=48000)
            done.set()

        thread = threading.Thread(target=work)
        thread.start()
        while not done.is_set():
            count += 1
        thread.join()
        self.assertGreater(count, 1000)

    def test_an_evaluation_can_be_interrupted(self):
        # A process in the background may ignore the signal of Ctrl-C.
        before = signal.signal(signal.SIGINT, signal.default_int_handler)
        self.addCleanup(signal.signal, signal.SIGINT, before)
        library = shagreen.load_library()
        timer = threading.Timer(0.1, signal.raise_signal, [signal.SIGINT])
        with self.assertRaises(KeyboardInterrupt):
            timer.start()
            # The signals of all textures take far longer.
            library.evaluate("all", signals=25, seconds=60)

    def test_several_threads_use_one_library(self):
        library = shagreen.load_library()
        results = {}

        def work(seed):
            results[seed] = library.author((30, 70)).render(0.1, 1, 1, seed=seed)

        threads = [threading.Thread(target=work, args=(seed,)) for seed in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for seed, samples in results.items():
            np.testing.assert_array_equal(samples, library.author((30, 70)).render(0.1, 1, 1, seed=seed))
