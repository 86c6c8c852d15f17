# SPDX-License-Identifier: MIT
"""The wheel that pip builds, of the module that is built already."""
import os
import subprocess
import sys
import zipfile

from support import ROOT, Case, sivid

sys.path.insert(0, str(ROOT / "python"))
import build_backend  # noqa: E402


class Wheel(Case):
    def test_a_wheel_is_whole(self):
        name = build_backend.build_wheel(self.folder, {"build-dir": os.environ["SIVID_BUILD_DIR"]})
        self.assertIn(sivid.__version__, name)
        with zipfile.ZipFile(self.folder / name) as wheel:
            wheel.extractall(self.folder / "site")
            record = wheel.read(next(n for n in wheel.namelist() if n.endswith("RECORD"))).decode()
            self.assertEqual(sorted(row.split(",")[0] for row in record.split()), sorted(wheel.namelist()))
            about = build_backend.prepare_metadata_for_build_wheel(self.folder)
            for file in (self.folder / about).iterdir():
                self.assertEqual(wheel.read(f"{about}/{file.name}"), file.read_bytes())
        for file in ("py.typed", "_core.pyi", "tracing.py"):
            self.assertTrue((self.folder / "site/sivid" / file).is_file())
        seen = subprocess.run(
            [sys.executable, "-c", "import sivid; print(sivid.__file__, sivid.__version__)"],
            env={**os.environ, "PYTHONPATH": str(self.folder / "site")},
            capture_output=True,
            text=True,
        )
        self.assertEqual(
            seen.stdout.split(), [str(self.folder / "site/sivid/__init__.py"), sivid.__version__], seen.stderr
        )
