# SPDX-License-Identifier: MIT
"""docs/python.md: its blocks run one after the other; the readers of recipes are those that Debian has."""
import os
import re

import numpy as np

import sivid
from support import ROOT, Case, growth_frame

PAGE = (ROOT / "docs/python.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"<!-- (.*?) -->\n```python\n(.*?)```", PAGE, re.DOTALL)


class Page(Case):
    def test_all_that_users_call_says_what_it_does(self):
        for name in sivid.__all__:
            known = getattr(sivid, name)
            self.assertTrue(known.__doc__, name)
            for member, value in vars(known).items() if isinstance(known, type) else ():
                if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                    self.assertTrue(getattr(known, member).__doc__ or value.__doc__, f"{name}.{member}")

    def test_every_block_is_run_or_says_why_not(self):
        self.assertEqual(len(BLOCKS), PAGE.count("```python"))
        self.assertEqual(
            {marker for marker, _ in BLOCKS}, {"run by tests/python/test_pages.py", "not run: Debian has no reader"}
        )
        for marker, text in BLOCKS:
            compile(text, marker, "exec")

    def test_the_blocks_run(self):
        try:
            import h5py
            import scipy.io
        except ImportError as missing:
            self.skipTest(f"{missing} (Debian: python3-h5py python3-scipy)")
        frame = growth_frame()
        np.savetxt(
            self.folder / "culture.csv",
            np.stack([frame["t"], frame["mass"]], 1),
            delimiter=",",
            header="t,mass",
            comments="",
            fmt="%.17g",
        )
        scipy.io.savemat(self.folder / "culture.mat", frame)
        with h5py.File(self.folder / "culture.h5", "w") as file:
            for name, column in frame.items():
                file[f"log/{name}"] = column
        before = os.getcwd()
        os.chdir(self.folder)
        self.addCleanup(os.chdir, before)
        names, frames = {"print": lambda *words: None}, []
        for marker, text in BLOCKS:
            if marker.startswith("run"):
                exec(compile(text, marker, "exec"), names)
                frames.append(names.get("frame"))
        self.assertEqual(names["found"].verdict, "consistent")
        self.assertGreater((self.folder / "culture.png").stat().st_size, 10_000)
        self.assertTrue(names["tubes"].complete)
        for read in frames[-2:]:
            for name, column in frame.items():
                np.testing.assert_array_equal(read[name], column)
