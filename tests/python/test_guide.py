"""The code of the guide's page runs in its order."""

import contextlib
import io
import os
import re

from support import ROOT, Bench

PAGE = ROOT / "docs" / "guide" / "python.md"


class Guide(Bench):
    """All blocks of one page share their names, in a temporary folder."""

    def test_the_code_of_the_page_runs(self):
        blocks = re.findall(r"^```python\n(.*?)^```", PAGE.read_text(), re.DOTALL | re.MULTILINE)
        self.assertGreater(len(blocks), 4)
        before = os.getcwd()
        os.chdir(self.folder)
        self.addCleanup(os.chdir, before)
        # Matplotlib keeps a list of fonts, by default in the home folder.
        os.environ.setdefault("MPLCONFIGDIR", str(self.folder))
        names = {}
        for number, block in enumerate(blocks, 1):
            with self.subTest(block=number), contextlib.redirect_stdout(io.StringIO()):
                exec(compile(block, f"{PAGE.name}, block {number}", "exec"), names)
