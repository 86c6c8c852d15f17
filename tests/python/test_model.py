# SPDX-License-Identifier: MIT
"""Models: texts, and functions of Python that are recorded."""
import decimal
import json
import math

import numpy as np

import sivid
from support import GROWTH, H3, HOVERCRAFT, Case


def tables_of_hovercraft():
    """States, inputs, outputs and constants as hovercraft.toml has them; TOML's reader came after Python 3.10."""
    try:
        import tomllib
    except ImportError:
        import tomli as tomllib
    return tomllib.loads(HOVERCRAFT.read_text())


def hovercraft_rate(t, x, u, c):
    """examples/hovercraft/hovercraft.toml in Python."""
    thrust = c.Cdelta * c.rho * c.D**4 * u.W**2
    side_force = c.CL * thrust * u.delta / (4 * c.A)
    speed_squared = x.u**2 + x.v**2 + c.eps**2
    speed = np.sqrt(speed_squared)
    drag = c.rho * c.Cd / 2 * speed
    dry = c.Ff / speed
    surge = thrust - dry * x.u - c.Su * drag * x.u - c.D11 * x.u
    sway = c.Sv * side_force - dry * x.v - c.Sv * drag * x.v - c.D22 * x.v
    yaw = -(c.L * c.Sg * side_force) - c.D33 * x.r
    return {
        "u": x.v * x.r + surge / c.m,
        "v": sway / c.m - x.u * x.r,
        "r": yaw / c.Iz,
        "x": x.u * np.cos(x.psi) - x.v * np.sin(x.psi),
        "y": x.u * np.sin(x.psi) + x.v * np.cos(x.psi),
        "psi": x.r,
    }


def hovercraft(**changes):
    of = tables_of_hovercraft()
    arguments = {k: of[k] for k in ("about", "states", "inputs", "outputs", "constants")}
    return sivid.Model(of["name"], **{**arguments, "rate": hovercraft_rate, **changes})


def small(rate, **changes):
    arguments = {"states": {"x": 1, "y": 1}, "constants": {"a": "1 1/s", "b": 2}, "outputs": {"x": "x"}}
    return sivid.Model("small", rate=rate, **{**arguments, **changes})


class Models(Case):
    def test_a_text_says_what_it_is(self):
        model = sivid.Model.read(GROWTH)
        self.assertEqual((model.name, model.time_unit), ("logistic growth", "h"))
        self.assertEqual((model.states, model.constants), ({"x": "g/L"}, {"r": "1/h", "K": "g/L"}))
        self.assertEqual((model.inputs, model.outputs, model.effects), ({}, {"x": "g/L"}, []))
        self.assertEqual(list(model.prior), ["r", "K"])
        self.assertIn("x'", model.describe())
        self.refused("nowhere.toml", lambda: sivid.Model.read(self.folder / "nowhere.toml"), (OSError, sivid.Error))
        self.refused(
            ["bad.toml: line 4, column", "kf"],
            lambda: sivid.Model.parse(
                'format = "sivid-model-1"\nname = "m"\n[equations]\nw = "-kf*w"\n[states]\nw = 1\n[outputs]\nw = "w"\n',
                "bad.toml",
            ),
        )

    def test_the_hovercraft_as_a_function_is_the_graph_of_its_text(self):
        text, function = sivid.Model.read(HOVERCRAFT), hovercraft()
        self.assertEqual(text.describe().split("effect ")[0], function.describe())
        results = []
        for k, model in enumerate((text, function)):
            found = sivid.identify(model, H3, out=self.folder / str(k), boxes=200, budget=300)
            results.append(
                (found.to_json()["problem"], (found.folder / "boxes.csv").read_bytes(), found.hull.tobytes())
            )
        self.assertEqual(results[0], results[1])

    def test_disturbances_that_a_model_allows_for(self):
        arguments = {"states": {"v": "1 m/s"}, "outputs": {"v": "v"}, "constants": {"k": "[0, 1] 1/s"}}
        model = sivid.Model(
            "cart", rate=lambda t, x, u, c: {"v": -c.k * x.v}, disturbance={"v": "20 cm/s^2"}, error={"v": "1 mm/s"}, **arguments
        )
        self.assertEqual((model.disturbance, model.error), ({"v": "0.2"}, {"v": "0.001"}))
        self.assertIn("allowed for: v up to 0.2 m/s^2, readings of v up to 0.001 m/s", model.describe())
        self.assertEqual(hovercraft().disturbance, {})
        self.refused(["'w' is no state", "line"], lambda: sivid.Model.parse(model.text.replace("v = \"20", "w = \"20")))

    def test_another_equation_is_another_graph(self):
        def other(t, x, u, c):
            rates = hovercraft_rate(t, x, u, c)
            return {**rates, "r": rates["r"] - x.r * "0.1 1/s"}

        self.assertNotEqual(hovercraft(rate=other).describe(), hovercraft().describe())

    def test_functions_of_numpy(self):
        def rate(t, x, u, c):
            a, b = c
            y = np.tanh(x.x) + np.exp(-np.abs(x[1])) - np.square(x["x"]) + np.minimum(x.x, 1) + np.maximum(x.y, b)
            y = y + np.clip(x.x, -1, 1) + sivid.deadband(x.y, "0.1") + np.sign(x.x) + np.arctan(x.y) / np.pi
            return [
                a * np.where(x.x > x.y, y, 0.5),
                a * (2 - x.y + np.float64(3) ** 2 - (-x.x) ** 3 + x.y**-2 + (x.x**2 + 1) ** 0.5),
            ]

        model = small(rate, states={"x": 1, "y": [1, 2]})
        for word in (
            "tanh(",
            "exp(",
            "abs(",
            "sqr(",
            "min(",
            "max(",
            "clamp(",
            "deadband(",
            "sign(",
            "atan(",
            "if(",
            "^-2",
        ):
            self.assertIn(word, model.text)

    def test_numbers_are_what_they_are(self):
        def text(value):
            return small(lambda t, x, u, c: [c.a * x.x * value, c.a * x.y * c.b]).text

        self.assertIn("1.000000000000000055511151231257827021181583404541015625e-1", text(0.1))
        self.assertIn("*0.1\n", text("0.1"))
        self.assertIn("*0.1\n", text(decimal.Decimal("0.1")))
        self.assertIn("*0.5\n", text(0.5))
        self.assertIn("*3\n", text(3))
        self.assertIn("*(-2)\n", text(-2))
        self.assertIn(
            "*(9.81 [m/s^2])",
            small(lambda t, x, u, c: [x.x * sivid.number("9.81 m/s^2") / "1 m/s" * 1, x.y * c.a * c.b]).text,
        )
        self.refused("no finite number", lambda: text(math.inf), ValueError)
        self.refused("no number", lambda: text(True), TypeError)
        self.refused("no number", lambda: text("one"), ValueError)

    def test_what_cannot_be_recorded_is_refused_with_the_remedy(self):
        def refused(words, value, error=TypeError):
            self.refused(words, lambda: small(lambda t, x, u, c: [value(x, c), x.y * c.a]), error)

        refused("sivid.where", lambda x, c: x.x if x.x > 0 else x.y)
        refused("sivid.where", lambda x, c: x.x and x.y)
        refused("np.maximum", lambda x, c: max(x.x, x.y))
        refused("==", lambda x, c: x.x == 0)
        refused("np.sin instead of math.sin", lambda x, c: math.sin(x.x))
        refused("np.sinh", lambda x, c: np.sinh(x.x))
        refused("np.add.reduce", lambda x, c: np.add.reduce([x.x, x.y]) if False else np.add.reduce(x.x))
        refused("np.exp(y*np.log(x))", lambda x, c: x.x**x.y)
        refused("each element", lambda x, c: np.ones(3) * x.x)
        refused("no state 'z'", lambda x, c: x.z, AttributeError)
        refused("no constant 'm'", lambda x, c: c["m"], KeyError)

    def test_the_reader_of_texts_judges_what_is_recorded(self):
        self.refused(["small: line", "1/s"], lambda: small(lambda t, x, u, c: [x.x, x.y * c.a]))
        self.refused("nothing for the state 'y'", lambda: small(lambda t, x, u, c: {"x": x.x * c.a}))
        self.refused("'z', which is no state", lambda: small(lambda t, x, u, c: {"x": x.x, "y": x.y, "z": x.x}))
        self.refused("returns 1 values", lambda: small(lambda t, x, u, c: [x.x]))

    def test_shared_and_deep_values_become_parts(self):
        def rate(t, x, u, c):
            y = x.x
            for _ in range(100):
                y = y * c.b + x.y
            shared = np.sin(y)
            return [c.a * (shared + shared * x.x), c.a * shared]

        model = small(
            rate,
            constants={"a": "1 1/s", "b": "0.5", "part_1": 3},
            observe=lambda t, x, u, c: {"z": c.part_1 * x.x},
            outputs={"x": "x", "z": {"unit": "1"}},
        )
        self.assertIn("part_1_ = ", model.text)
        self.assertEqual(list(model.outputs), ["x", "z"])

    def test_effects_and_other_tables(self):
        model = small(
            lambda t, x, u, c: [u.f * c.a, -c.a * x.y * c.b],
            inputs={"f": "1"},
            effects={
                "late": {"kind": "input_delay", "of": "f", "prior": "[0, 1] s"},
                "drag": {"about": "a \"drag\"", "constants": {"k": "[0, 1] 1/s"}, "equations": "x' -= k*x\ny' -= k*y"},
            },
        )
        self.assertEqual(model.effects, ["late", "drag"])
