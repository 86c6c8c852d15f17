# SPDX-License-Identifier: MIT
"""identify: the same as the program, as arrays."""
import json
import os
import subprocess
from pathlib import Path

import numpy as np

import sivid
from support import GROWTH, H3, HOVERCRAFT, Case, growth_data, growth_frame, program


def without_times(value):
    """A result without how long it took."""
    if isinstance(value, dict):
        return {k: without_times(v) for k, v in value.items() if "seconds" not in k}
    return [without_times(v) for v in value] if isinstance(value, list) else value


class Identify(Case):
    def test_boxes_hull_and_witness_of_a_frame(self):
        model = sivid.Model.read(GROWTH)
        found = sivid.identify(model, growth_data(), budget=60, accuracy=0.05)
        self.assertEqual(found.verdict, "consistent")
        self.assertEqual(found.parameters, ["r", "K"])
        self.assertEqual(found.units, ["1/h", "g/L"])
        self.assertEqual(found.hull.shape, (2, 2))
        self.assertTrue((found.hull[:, 0] < 1).all() and (found.hull[:, 1] > 1).all())
        low, high = found.boxes("inside")
        self.assertEqual(low.shape, high.shape)
        self.assertEqual(low.shape[1], 2)
        self.assertGreater(len(low), 0)
        for kind in ("inside", "undecided", "pending"):
            low, high = found.boxes(kind)
            self.assertTrue((low <= high).all())
            self.assertTrue((low >= found.hull[:, 0]).all() and (high <= found.hull[:, 1]).all())
        for k, name in enumerate(found.parameters):
            self.assertTrue(found.hull[k, 0] <= found.witness[name] <= found.hull[k, 1])
        frame = found.frame()
        self.assertEqual(list(frame.index), ["r", "K"])
        self.assertEqual(frame.loc["K", "unit"], "g/L")
        outputs = found.outputs()
        self.assertEqual(len(outputs), 17)
        self.assertTrue((outputs["measured_lower"] <= outputs["model_upper"]).all())
        self.assertIn("consistent", repr(found))
        self.assertRaises(ValueError, found.boxes, "outside")

    def test_a_record_that_no_parameter_explains_is_refuted(self):
        frame = growth_frame()
        frame["mass"][8] += 0.5
        found = sivid.identify(sivid.Model.read(GROWTH), growth_data(frame=frame), budget=60)
        self.assertEqual(found.verdict, "inconsistent")
        self.assertEqual(found.code, 4)
        self.assertTrue(np.isnan(found.hull).all())
        self.assertEqual(len(found.boxes("inside")[0]), 0)
        self.assertIsNone(found.witness)
        found = sivid.identify(sivid.Model.read(GROWTH), growth_data(frame=frame), budget=60, outliers=1, accuracy=0.1)
        self.assertEqual(found.verdict, "consistent")

    def same_as_program(self, file, data, *options):
        """The module and the program write the same results, but for the time they took."""
        here, there = self.folder / "module", self.folder / "program"
        keywords = {name[2:]: value for name, value in zip(options[::2], options[1::2])}
        sivid.identify(sivid.Model.read(file), data, out=here, **keywords)
        folder = here / "data" if (here / "data").exists() else data
        subprocess.run(
            [program(), "identify", file, folder, "--out", there, "--quiet", *options],
            check=False,
            stdout=subprocess.DEVNULL,
        )
        module, alone = (json.loads((f / "result.json").read_text()) for f in (here, there))
        if folder != data:  # one has its data set in its folder, the other beside it
            self.assertEqual(
                (module["source"].pop("folder"), alone["source"].pop("folder")), ("data", "../module/data")
            )
        self.assertEqual(without_times(module), without_times(alone))
        for table in ("boxes.csv", "outputs.csv"):
            self.assertEqual((here / table).read_bytes(), (there / table).read_bytes())

    def test_the_program_finds_the_same_bits_in_a_data_set(self):
        self.same_as_program(HOVERCRAFT, H3, "--boxes", "300", "--budget", "300")

    def test_the_program_finds_the_same_bits_in_what_a_frame_became(self):
        self.same_as_program(GROWTH, growth_data(), "--accuracy", "0.05", "--budget", "300")

    def test_a_saved_result_is_proved_anew_by_the_program(self):
        model = sivid.Model.read(GROWTH)
        found = sivid.identify(model, growth_data(), budget=60, accuracy=0.3)
        saved = found.save(self.folder / "saved")
        del found  # with its folder
        checked = subprocess.run([program(), "check", saved / "model.toml", saved], capture_output=True, text=True)
        self.assertEqual(checked.returncode, 3, checked.stderr)  # every claim but those of boxes beside the sample
        self.assertNotIn("REFUTED", checked.stdout)
        self.assertEqual(
            checked.stdout.count("verified"), sivid.check(saved, model=model, budget=30).text.count("verified")
        )
        (saved / "boxes.csv").write_text((saved / "boxes.csv").read_text().replace("undecided", "inside"))
        self.assertEqual(sivid.check(saved, model=model).code, 5)

    def test_a_certificate_is_checked_without_sivid(self):
        found = sivid.identify(sivid.Model.read(GROWTH), growth_data(), budget=60, accuracy=0.3)
        file = self.folder / "certificate.txt"
        made = sivid.certificate(found, file, budget=30)
        self.assertEqual(made.code, 0, made.text)
        self.assertIn("the witness explains the measurements", made.text)
        self.assertRaises(TypeError, sivid.certificate, made, file)
        checker = Path(os.environ["SIVID_BUILD_DIR"]) / "examples/certificate/check_certificate"
        if not checker.is_file():
            self.skipTest("the checker is not built")
        checked = subprocess.run([checker, file], capture_output=True, text=True)
        self.assertEqual(checked.returncode, 0, checked.stdout)
        file.write_text(file.read_text().replace("hull\tK", "hull\tr"))
        self.assertEqual(subprocess.run([checker, file], capture_output=True).returncode, 2)

    def test_an_answer_is_written_for_a_simulator(self):
        found = sivid.identify(sivid.Model.read(GROWTH), growth_data(), budget=10, accuracy=0.3)
        file = self.folder / "table.json"
        entry = {"joint": "tank", "attribute": "damping", "value": "r*2", "unit": "1/h"}
        made = sivid.export(found, file, map={"attributes": [entry]})
        self.assertEqual(made.code, 0, made.text)
        table = json.loads(file.read_text())
        self.assertEqual(table["constants"]["r"]["value"], found.witness["r"])
        self.assertEqual(table["attributes"][0]["value"][0], 2 * table["constants"]["r"]["value"])
        self.assertTrue((self.folder / "table.json.note.txt").is_file())
        self.refused("needs --into", lambda: sivid.export(found, file, "mjcf", map={"attributes": [entry]}))
        self.assertRaises(TypeError, sivid.export, made, file)

    def test_errors_have_the_words_of_the_program(self):
        model = sivid.Model.read(GROWTH)
        self.refused(
            ["--budget", "nan is not a number"], lambda: sivid.identify(model, growth_data(), budget=float("nan"))
        )
        self.refused("Did you mean --accuracy?", lambda: sivid.identify(model, growth_data(), acuracy=0.1))
        self.refused("allow fewer outliers", lambda: sivid.identify(model, growth_data(), outliers=99))
        self.refused("effect", lambda: sivid.identify(model, growth_data(), effects=["wind"]))
        self.refused("nowhere", lambda: sivid.identify(model, self.folder / "nowhere"))
        self.assertRaises(FileExistsError, sivid.identify, model, growth_data(), out=GROWTH)
        result = subprocess.run(
            [program(), "identify", GROWTH, H3, "--out", self.folder / "x"], capture_output=True, text=True
        )
        self.refused(
            result.stderr.strip().removeprefix("sivid: "), lambda: sivid.identify(model, H3, out=self.folder / "x")
        )
