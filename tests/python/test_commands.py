# SPDX-License-Identifier: MIT
"""What follows from an identification: diagnose, predict, verify, control, design, rank; pages and pictures."""
import json
import warnings

import matplotlib
import numpy as np

import sivid
from support import GROWTH, H3, HOVERCRAFT, ROOT, Case, growth_data, growth_frame

S3 = ROOT / "examples/hovercraft/scenarios/S3.json"


def fed_culture():
    """Growth with a feed, and what its model may leave out."""
    return sivid.Model(
        "fed culture",
        time="h",
        states={"x": "10 g/L"},
        inputs={"F": "g/L/h"},
        constants={
            "r": {"value": "1 1/h", "prior": "[0.5, 1.5] 1/h"},
            "K": {"value": "1 g/L", "prior": "[0.8, 1.2] g/L"},
        },
        rate=lambda t, x, u, c: {"x": c.r * x.x * (1 - x.x / c.K) + u.F},
        outputs={"x": "x"},
        effects={"decay": {"about": "cells that die", "constants": {"d": "[0, 0.5] 1/h"}, "equations": "x' -= d*x"}},
    )


def fed_data(decay=0.0, bound="0.02"):
    step, x, rows = 0.001, 0.1, []
    for k in range(6001):
        feed = 0.05 if k < 3000 else 0.0
        if k % 500 == 0:
            rows.append((k * step, x, feed))
        x += step * (x * (1 - x) + feed - decay * x)
    frame = np.array(rows, [("t", float), ("mass", float), ("feed", float)])
    return sivid.Data(
        frame,
        outputs={"x": ("mass", bound)},
        inputs={"F": "feed"},
        initial={"x": ("0.095", "0.105")},
        interpolation="hold",
        id="fed",
    )


class Regions(Case):
    def test_a_region_with_a_stated_probability(self):
        frame = growth_frame()
        frame["mass"] += np.where(np.arange(len(frame["mass"])) % 3 == 0, 0.004, -0.002)
        found = sivid.confidence(sivid.Model.read(GROWTH), growth_data(frame=frame), 0.9, seed=3, accuracy=0.1, budget=60)
        self.assertEqual(found.probability, 0.9)
        stored = found.to_json()
        self.assertEqual((stored["sums"], stored["above"], stored["seed"]), (100, 10, 3))
        self.assertEqual(found.unknowns, ["r", "K", "x at the start of record"])
        self.assertEqual(found.hull.shape, (3, 2))
        low, high = found.boxes("inside")
        self.assertTrue((low >= found.hull[:, 0]).all() and (high <= found.hull[:, 1]).all())
        self.assertTrue(found.report(self.folder / "region.html").is_file())
        self.assertTrue(any("symmetric" in words for words in found.assumptions))
        self.refused("round it", lambda: sivid.confidence(found.model, growth_data(), 0.123456))
        self.assertRaises(ValueError, found.boxes, "outside")
        self.same_by_definition(stored)
        self.assertEqual(sivid.check(found).code, 0)

    def same_by_definition(self, stored):
        """The signs of the seed, in another language: the least squares estimate is in the region."""
        state = stored["seed"]

        def draw():
            nonlocal state
            state = (state + 0x9E3779B97F4A7C15) % 2**64
            z = (state ^ state >> 30) * 0xBF58476D1CE4E5B9 % 2**64
            z = (z ^ z >> 27) * 0x94D049BB133111EB % 2**64
            return z ^ z >> 31

        weights, m = np.array(stored["weights"]), stored["sums"]
        [draw() for _ in range(m)]
        signs = np.array([[-1 if draw() >> 63 else 1 for _ in weights] for _ in range(m - 1)])
        error = np.array(stored["measured"]) - np.mean(stored["measured"])  # of no model: surely not in the region
        norms = np.linalg.norm((signs * error) @ weights, axis=1)
        self.assertLess((norms > np.linalg.norm(error @ weights)).sum(), stored["above"])


class AfterIdentification(Case):
    @classmethod
    def setUpClass(cls):
        cls.model = sivid.Model.read(HOVERCRAFT)
        cls.found = sivid.identify(cls.model, H3, budget=20, boxes=400)

    def test_predict(self):
        predicted = sivid.predict(self.found, S3, budget=10)
        self.assertTrue(predicted.complete)
        tubes = predicted.tubes()
        self.assertEqual((tubes["from"][0], tubes["to"][-1]), (0, 3))
        for name in self.model.outputs:
            self.assertTrue((tubes[name + "_lower"] <= tubes[name + "_upper"]).all())
        again = sivid.predict(self.found, "data:S3", budget=10)
        self.assertEqual(again.to_json()["scenario"], "S3")
        self.assertEqual(len(predicted.plot(["u", "psi"]).axes), 2)

    def test_verify(self):
        proved = sivid.verify(self.found, S3, "always(u < 10)", budget=10)
        self.assertEqual((proved.answer, proved.code), ("proved", 0))
        self.assertGreater(proved.robustness[0], 0)
        self.assertIsNone(proved.witness)
        refuted = sivid.verify(self.found, S3, "always(u > 1)", budget=10)
        self.assertEqual((refuted.answer, refuted.code), ("refuted", 5))
        self.assertEqual(set(refuted.witness["parameters"]), set(self.found.parameters))
        self.refused("requirement: character 11", lambda: sivid.verify(self.found, S3, "always(u <", budget=10))
        self.refused("result of identify", lambda: sivid.verify(self.model, S3, "u < 1"), TypeError)

    def test_a_constant_of_the_scenario_alone(self):
        wide = sivid.predict(self.found, json.loads(S3.read_text()), set={"Ff": ("0.3", "0.7")}, budget=10).tubes()
        narrow = sivid.predict(self.found, S3, budget=10).tubes()
        self.assertGreater(wide["u_upper"][-1] - wide["u_lower"][-1], narrow["u_upper"][-1] - narrow["u_lower"][-1])

    def test_rank(self):
        ranked = sivid.rank(self.model, H3, budget=5)
        self.assertIn("Sg", ranked.text)
        self.assertEqual(ranked.to_json()["format"], "sivid-ranking-1")
        ranked = sivid.rank(self.model, scenario=S3, unknown={"Sg": (0.03, 0.05)}, measure={"psi": 0.01}, budget=5)
        self.assertIn("Sg", ranked.text)
        self.assertIn("decay", sivid.rank(fed_culture(), fed_data(decay=0.3), effects="decay", budget=5).text)

    def test_disturbance(self):
        found = sivid.disturbance(fed_culture(), fed_data(decay=0.3), {"x": 0.1}, budget=10)
        lower, upper = found.size
        self.assertTrue(0 < lower <= upper < 2 * lower)
        self.assertLess(lower, 3)  # 0.3 x of at most 1
        self.assertEqual(set(found.pieces["equation"]), {"x"})
        self.assertLessEqual(abs(found.pieces["value"]).max(), 0.1 * upper * (1 + 1e-12))
        self.assertIn("least disturbance", found.text)
        self.refused("did you mean 'x'", lambda: sivid.disturbance(fed_culture(), fed_data(), {"xx": 1}))
        allowed = sivid.identify(fed_culture(), fed_data(decay=0.3), disturbance={"x": 0.3}, budget=10, accuracy=0.1)
        self.assertNotEqual(allowed.verdict, "inconsistent")
        self.assertEqual(allowed.to_json()["disturbances"]["equations"], {"x": 0.3})
        self.assertIn("x up to 0.3", allowed.text)
        self.assertNotEqual(sivid.check(allowed).code, 5)

    def test_pages_and_pictures(self):
        page = self.found.report(self.folder / "page.html").read_text()
        self.assertEqual(page, (self.found.folder / "report.html").read_text())
        shown = self.found._repr_html_()
        self.assertIn("<iframe srcdoc=", shown)
        self.assertIn("&lt;svg", shown)
        self.assertNotIn("<svg", shown)
        self.assertEqual(self.found.products, ["Sg*L", "Sv"])
        low, high = self.found.boxes("inside", products=True)
        self.assertTrue((low > 0).all() and (low <= high).all() and low.shape[1] == 2 and len(low) > 0)
        self.assertEqual(len(self.found.plot().axes), 1)
        figure = self.found.plot(products=False)
        self.assertEqual(len(figure.axes), 3)  # Sv, Sg; Sv, L; Sg, L
        figure.savefig(self.folder / "boxes.png")
        self.assertGreater((self.folder / "boxes.png").stat().st_size, 10_000)
        self.assertEqual(len(self.found.plot(parameters=["Sg"]).axes), 1)
        self.assertEqual(len(self.found.plot_outputs().axes), 6)
        matplotlib.pyplot.close("all")


class Others(Case):
    def test_diagnose_finds_what_is_missing(self):
        model = fed_culture()
        diagnosis = sivid.diagnose(model, fed_data(decay=0.3), budget=40)
        self.assertEqual(diagnosis.gap["verdict"], "certified")
        self.assertEqual((diagnosis.answer, diagnosis.effects), ("effects", ["decay"]))
        explained = diagnosis.identification
        self.assertIn("decay.d", explained.parameters)
        self.assertIn("decay", diagnosis._repr_html_())
        joined = sivid.identify(model, fed_data(decay=0.3), effects=["decay"], budget=20, accuracy=0.1)
        self.assertEqual(joined.verdict, "consistent")
        self.assertEqual(sivid.identify(model, fed_data(decay=0.3), budget=20).verdict, "inconsistent")

    def test_design_an_experiment_and_use_it(self):
        model = fed_culture()
        found = sivid.identify(model, fed_data(), budget=20, accuracy=0.05)
        scenario = {
            "name": "next",
            "duration": 6,
            "initial": {"x": 0.1},
            "inputs": {"F": {"shape": "constant", "value": 0}},
        }
        designed = sivid.design(found, scenario, vary={"F": (0, 0.2)}, halve="K", budget=10)
        self.assertIn(designed.code, (0, 3))
        self.assertTrue(sivid.predict(found, designed.scenario, budget=10).complete)
        gains = sivid.control(
            found, scenario, "x at end in [0.5, 1.5]", law="F = clamp(k*(1 - x), 0, 0.2)", gain={"k": (0, 1)}, budget=10
        )
        self.assertEqual(gains.to_json()["answer"], "proved")

    def test_generate_and_simulate(self):
        model = fed_culture()
        scenario = {
            "name": "next",
            "duration": 4,
            "initial": {"x": 0.1},
            "inputs": {"F": {"shape": "constant", "value": 0.05}},
        }
        data = sivid.generate(model, scenario, self.folder / "made", absolute=0.02, rate=5, set={"r": 1.1})
        self.assertEqual(sivid.identify(model, data, budget=20, accuracy=0.1).verdict, "consistent")
        self.assertIn("next", sivid.simulate(model, scenario).text)

    def test_notices_are_warnings(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            sivid.identify(sivid.Model.read(GROWTH), growth_data(), budget=5, boxes=50, resume=True)
        self.assertIn("no checkpoint", str(caught[0].message))
