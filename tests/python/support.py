# SPDX-License-Identifier: MIT
"""What tests of the module share."""
import os
import tempfile
import unittest
from pathlib import Path

import numpy as np

import sivid

ROOT = Path(os.environ["SIVID_SOURCE_DIR"])
GROWTH = ROOT / "examples/first_steps/logistic_growth.toml"
HOVERCRAFT = ROOT / "examples/hovercraft/hovercraft.toml"
H3 = ROOT / "examples/hovercraft/data/h3"


def program():
    """The program sivid, for comparison."""
    found = os.environ.get("SIVID_PROGRAM")
    if not found or not Path(found).is_file():
        raise unittest.SkipTest("the program sivid is not built")
    return found


def growth_frame(r=1.0, K=1.0, x0=0.11, noise=0.0):
    """Readings of a culture in g/L over hours."""
    t = np.arange(0, 8.5, 0.5)
    x = K * x0 * np.exp(r * t) / (K + x0 * (np.exp(r * t) - 1))
    return {"t": t, "mass": x + noise * np.cos(7 * t)}


def growth_data(**options):
    arguments = {"time": "t", "outputs": {"x": ("mass", "+-0.02")}, "initial": {"x": ("0.10", "0.12")}, "id": "culture"}
    return sivid.Data(options.pop("frame", growth_frame()), **{**arguments, **options})


class Case(unittest.TestCase):
    """With a folder that is gone when the test ends."""

    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = Path(kept.name)

    def refused(self, words, function, error=sivid.Error):
        """The call raises, with these words in the message."""
        with self.assertRaises(error) as caught:
            function()
        for word in [words] if isinstance(words, str) else words:
            self.assertIn(word, str(caught.exception))
