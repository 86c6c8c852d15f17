# SPDX-License-Identifier: MIT
"""Models: texts in the format sivid-model-1, or functions of Python that are recorded."""
from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from pathlib import Path

from . import _core
from .tracing import Expression, Names, Writer, _operand

__all__ = ["Model"]


class Model:
    """A model of a machine: states, inputs, constants, outputs with their units, and its equations.

    From a function::

        Model("logistic growth", time="h",
              states={"x": "10 g/L"},
              constants={"r": {"value": "1 1/h", "prior": "[0.1, 3] 1/h"}, "K": "[0.5, 2] g/L"},
              rate=lambda t, x, u, c: {"x": c.r*x.x*(1 - x.x/c.K)},
              outputs={"x": "x"})

    ``rate(t, x, u, c)`` gets the time, states, inputs and constants as traced values (``x.x``, ``x["x"]``) and returns
    the rate of each state, by name or in their order; it is called once. ``observe(t, x, u, c)`` returns what outputs
    show, by name; outputs that it leaves out, or all without it, show what ``outputs`` says: a formula, or a table with
    ``equation``, ``unit`` and ``delay``. All tables are those of the text (docs/formats.md): what a state, a constant,
    an effect may say there, it may say here.

    From texts: ``Model.read(file)``, ``Model.parse(text)``.

    Errors: ``sivid.Error`` with line, column and remedy, of the text that is recorded (``model.text``).
    """

    def __init__(
        self,
        name: str,
        *,
        states: Mapping,
        rate: Callable,
        outputs: Mapping | None = None,
        constants: Mapping | None = None,
        inputs: Mapping | None = None,
        observe: Callable | None = None,
        effects: Mapping | None = None,
        disturbance: Mapping | None = None,
        error: Mapping | None = None,
        time: str = "s",
        about: str = "",
    ):
        stated = dict(outputs or {})
        x, u, c = (
            Names(kind, table or {}) for kind, table in (("state", states), ("input", inputs), ("constant", constants))
        )
        t = Expression("t")
        rates = _by_name(rate(t, x, u, c), list(states), "rate")
        missing = [s for s in states if s not in rates]
        if missing:
            raise _core.Error(f"rate returns nothing for the state '{missing[0]}': give the rate of each state")
        shown = _by_name(observe(t, x, u, c), list(stated), "observe") if observe else {}
        roots = [rates[s] for s in states] + list(shown.values())
        formulas = Writer({*states, *(inputs or {}), *(constants or {}), *stated}, roots)
        lines = [f"{part} = {text}" for part, text in formulas.parts]
        lines += [f"{s}' = {formulas.formula(rates[s])}" for s in states]
        for y, formula in shown.items():
            of = stated.get(y, {})
            stated[y] = {**(of if isinstance(of, dict) else {}), "equation": formulas.formula(formula)}
        text = ["format = \"sivid-model-1\"", f"name = {_toml(name)}", f"time = {_toml(time)}"]
        text += [f"about = {_toml(about)}"] if about else []
        text += ["equations = \"\"\"", *lines, "\"\"\""]
        tables = {
            "states": states,
            "inputs": inputs,
            "constants": constants,
            "outputs": stated,
            "disturbance": disturbance,
            "error": error,
            **{f"effect.{_key(effect)}": table for effect, table in (effects or {}).items()},
        }
        for title, table in tables.items():
            entries = [f"{_key(k)} = {_toml(v)}" for k, v in (table or {}).items()]
            text += ["", f"[{title}]", *entries] if entries else []
        self._set("\n".join(text) + "\n", name)

    @classmethod
    def parse(cls, text: str, name: str = "model") -> "Model":
        """The model of a text; ``name`` stands for the file in messages."""
        model = cls.__new__(cls)
        model._set(text, name)
        return model

    @classmethod
    def read(cls, file) -> "Model":
        """The model of a file."""
        return cls.parse(Path(file).read_bytes().decode("utf-8", "surrogateescape"), os.fspath(file))

    def _set(self, text, name):
        self._core = _core.Model(text, name)
        self.text = text

    @property
    def name(self) -> str:
        """As the model calls itself."""
        return self._core.name

    @property
    def time_unit(self) -> str:
        """Of the model's time."""
        return self._core.time_unit

    @property
    def states(self) -> dict[str, str]:
        """Names and units."""
        return dict(self._core.states)

    @property
    def inputs(self) -> dict[str, str]:
        """Names and units."""
        return dict(self._core.inputs)

    @property
    def constants(self) -> dict[str, str]:
        """Names and units."""
        return dict(self._core.constants)

    @property
    def outputs(self) -> dict[str, str]:
        """Names and units of the channels."""
        return dict(self._core.outputs)

    @property
    def prior(self) -> dict[str, tuple[str, str]]:
        """The unknown constants with their bounds, as decimals, in the units of the constants."""
        return self._core.prior

    @property
    def effects(self) -> list[str]:
        """What ``diagnose`` may find missing and ``identify`` may join, by name."""
        return self._core.effects

    @property
    def disturbance(self) -> dict[str, str]:
        """Unknown functions of time beside equations that answers allow for: the largest sizes, as decimals, in the
        states' units per time."""
        return self._core.disturbance

    @property
    def error(self) -> dict[str, str]:
        """How much further off readings may be than their bounds, in the outputs' units."""
        return self._core.error

    def describe(self) -> str:
        """Names, units, and the recorded equations line by line."""
        return _core.run(self._core, ["describe"])[1]

    def __repr__(self) -> str:
        unknown = ", ".join(self.prior) or "nothing"
        return f"<sivid.Model '{self.name}': {len(self.states)} states, unknown: {unknown}>"


def _by_name(values, names, function) -> dict[str, Expression]:
    if isinstance(values, Expression) and len(names) == 1:
        values = [values]
    if not isinstance(values, dict):
        values = list(values)
        if len(values) != len(names):
            raise _core.Error(
                f"{function} returns {len(values)} values, and there are {len(names)}: "
                f"{', '.join(names)}; return a dictionary by their names"
            )
        values = dict(zip(names, values))
    unknown = [k for k in values if k not in names]
    if unknown and function == "rate":
        raise _core.Error(f"rate returns '{unknown[0]}', which is no state; there are: {', '.join(names)}")
    return {k: _operand(v) for k, v in values.items()}


def _key(name) -> str:
    plain = str(name).replace("_", "").isalnum() and str(name).isascii()
    return str(name) if plain else _toml(str(name))


def _toml(value) -> str:
    """A value of TOML: texts, numbers, lists and tables in one line."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{_key(k)} = {_toml(v)}" for k, v in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_toml(v) for v in value) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(float(value)) if isinstance(value, float) else str(value)
    text = str(value).replace("\\", "\\\\").replace("\"", "\\\"")
    if "\n" in text:
        return "\"\"\"\n" + text + "\"\"\""
    return f"\"{text}\""
