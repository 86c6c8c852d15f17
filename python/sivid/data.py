# SPDX-License-Identifier: MIT
"""Measurements: arrays and frames as data sets."""
from __future__ import annotations

import json
import re
from collections.abc import Mapping
from decimal import Decimal
from pathlib import Path

import numpy as np

from . import _core

__all__ = ["Data"]

_BOUND = re.compile(r"\s*(?:\+-|±|\+/-)?\s*([0-9.]+(?:[eE][-+]?[0-9]+)?)\s*$")


class Data:
    """One record, or several (``a + b``), with what they mean to a model.

    ``frame``
        a pandas frame, a dictionary of arrays, a structured array, or an Arrow table
    ``time``
        the column of times, in ``time_unit`` (the model's unit if not stated); datetimes count from the first; a
        number is the time from row to row
    ``outputs``, ``inputs``
        what the model's channels and inputs are: ``{"v": ("speed", "+-0.02")}``, a column and the bound of its error in
        the model's unit, which is a decimal, the name of a column with bounds, or ``"propose"``; of an input the column
        alone says that it is exact. A dictionary has whatever a mapping has: ``{"v": {"column": "speed", "unit":
        "km/h", "error": 0.1, "factor": 2}}``.
    ``initial``
        where states start: a number, a pair of bounds, ``"propose"``, or an entry of a mapping; states that it leaves
        out start in their own ranges
    ``outliers``
        the largest share of measurements that may violate their bounds
    ``parameters``, ``fixed``
        priors and values that replace the model's: ``{"r": (0.1, 3)}``, ``{"m": 1.2}``
    ``interpolation``
        of inputs between their samples: ``"linear"`` or ``"hold"``
    ``same_time``
        which of several readings at one time counts: ``"first"`` or ``"last"``
    ``further``
        other entries of a scenario of a mapping: ``duration``, ``windows``, ``thin``

    NaN means no reading. The record becomes a data set by the importer of sivid, with its checks and messages, once a
    model is there; what it says of lines are rows, from 1. Entries of mappings: docs/importing.md.
    """

    def __init__(
        self,
        frame,
        *,
        outputs: Mapping,
        time: str | float | dict = "t",
        inputs: Mapping | None = None,
        initial: Mapping | None = None,
        id: str = "data",
        name: str = "record",
        role: str = "fit",
        time_unit: str | None = None,
        interpolation: str = "linear",
        outliers: float | str = 0,
        parameters: Mapping | None = None,
        fixed: Mapping | None = None,
        effects: Mapping | None = None,
        same_time: str = "refuse",
        **further,
    ):
        unknown = sorted(set(further) - {"duration", "windows", "thin", "initial_after_break"})
        if unknown:
            raise TypeError(f"Data takes no argument {unknown[0]!r}; further entries are duration, windows and thin")
        columns = _columns(frame)
        if isinstance(time, dict):
            when = time
        elif not isinstance(time, str):
            when = {"sample_time": _number(time)}
        elif time in columns and columns[time].dtype.kind in "Mm":
            kind = columns[time].dtype.kind
            columns[time] = columns[time].astype(f"{kind}8[ns]").astype(np.int64)
            when = {"column": time, "unit": "ns", "offset": "first" if kind == "M" else 0}
        else:
            when = {"column": time, "offset": 0}
        self._id, self._time_unit = id, {name: time_unit}
        self._folder: Path | None = None
        self._frames = {name: columns}
        self._known = {
            "max_outlier_fraction": _number(outliers),
            "effects": effects,
            "parameters": {k: {"prior": _range(v)} for k, v in (parameters or {}).items()},
            "fixed": {k: v if isinstance(v, dict) else _number(v) for k, v in (fixed or {}).items()},
        }
        self._scenarios: list[dict] = [
            {
                "name": name,
                "role": role,
                "file": name,
                "source": {"kind": "matlab", "same_time": same_time},
                "time": when,
                "interpolation": interpolation,
                "inputs": {k: _entry(v, columns, True) for k, v in (inputs or {}).items()},
                "channels": {k: _entry(v, columns, False) for k, v in outputs.items()},
                "initial": {k: v if isinstance(v, (dict, str)) else _range(v) for k, v in (initial or {}).items()},
                **further,
            }
        ]
        self.protocol = ""
        self.bounds = []

    @classmethod
    def read(cls, folder) -> "Data":
        """A data set that is a folder (``sivid-dataset-1``), of ``sivid import`` or ``write``; it stays where it is."""
        data = cls.__new__(cls)
        data._folder = Path(folder)
        data.protocol, data.bounds = "", []
        return data

    def __add__(self, other: "Data") -> "Data":
        """Both records in one data set: several experiments with one machine."""
        if self._folder or other._folder:
            raise TypeError("data sets of folders are not joined: join records before they are written")
        if self._known != other._known:
            raise ValueError(
                "the records have different outliers, parameters, fixed values or effects: "
                "a data set has one of each"
            )
        data = Data.__new__(Data)
        data._id, data._folder, data._known = self._id, None, self._known
        data.protocol, data.bounds = "", []
        data._frames, data._time_unit, data._scenarios = (
            dict(self._frames),
            dict(self._time_unit),
            list(self._scenarios),
        )
        for scenario in other._scenarios:
            name = scenario["name"]
            while name in data._frames:
                name += "_2"
            data._frames[name] = other._frames[scenario["name"]]
            data._time_unit[name] = other._time_unit[scenario["name"]]
            data._scenarios.append({**scenario, "name": name, "file": name})
        return data

    def write(self, model, folder) -> Path:
        """Writes the data set for a model; the protocol says what was dropped, changed, assumed (``protocol``), and
        which error bounds the record suggests, with what they rest on (``bounds``, as in import.json).

        Errors: ``sivid.Error`` with column, row and remedy; nothing is written then.
        """
        mapping = json.dumps(self._mapping(model), cls=_Exact)
        self.protocol = _core.import_arrays(
            mapping.replace('"<exact>', "").replace('</exact>"', ""), self._frames, str(folder)
        )
        self.bounds = json.loads((Path(folder) / "import.json").read_text(encoding="utf-8"))["bounds"]
        return Path(folder)

    def _mapping(self, model) -> dict:
        priors = self._known["parameters"] or {
            k: {"prior": [_Number(a), _Number(b)]} for k, (a, b) in model.prior.items()
        }
        fixed = self._known["fixed"]
        mapping = {
            "format": "sivid-mapping-1",
            "id": self._id,
            "model": model.name,
            "parameters": {k: v for k, v in priors.items() if k not in fixed},
            "max_outlier_fraction": self._known["max_outlier_fraction"],
            "scenarios": [],
        }
        if fixed:
            mapping["fixed"] = fixed
        if self._known["effects"]:
            mapping["effects"] = self._known["effects"]
        for scenario in self._scenarios:
            time = {"unit": self._time_unit[scenario["name"]] or model.time_unit, **scenario["time"]}
            mapping["scenarios"].append({**scenario, "time": time})
        return mapping

    def __repr__(self) -> str:
        if self._folder:
            return f"<sivid.Data in {self._folder}>"
        rows = {name: len(next(iter(columns.values()), ())) for name, columns in self._frames.items()}
        return "<sivid.Data: " + ", ".join(f"{name}, {n} rows" for name, n in rows.items()) + ">"


class _Number(str):
    """A decimal that stands in JSON as it is written."""


class _Exact(json.JSONEncoder):
    """Writes decimals with all their digits."""

    def encode(self, value):
        return super().encode(self._marked(value))

    def _marked(self, value):
        if isinstance(value, _Number):
            return f"<exact>{value}</exact>"
        if isinstance(value, dict):
            return {k: self._marked(v) for k, v in value.items()}
        if isinstance(value, (list, tuple)):
            return [self._marked(v) for v in value]
        if isinstance(value, Decimal):
            return f"<exact>{value}</exact>"
        return value.item() if isinstance(value, np.generic) else value


def _number(value):
    """A decimal of a number or a text."""
    if isinstance(value, str):
        try:
            return _Number(format(Decimal(value), "f"))
        except ArithmeticError:
            raise ValueError(f"{value!r} is no number: write a decimal such as \"0.02\"") from None
    return value


def _range(value):
    """[lower, upper] of a number or a pair."""
    pair = value if isinstance(value, (list, tuple, np.ndarray)) else (value, value)
    return [_number(v) for v in pair]


def _entry(value, columns, is_input) -> dict:
    """What a channel or an input is, as a mapping has it."""
    if isinstance(value, dict):
        return {**value, **({"error": _bound(value["error"], columns)} if "error" in value else {})}
    if not isinstance(value, str):
        column, error = value
        return {"column": column, "error": _bound(error, columns)}
    if not is_input:
        raise TypeError(
            f"the column {value!r} needs the bound of its error: ({value!r}, \"+-0.02\"), a column of "
            "bounds, or \"propose\""
        )
    return {"column": value}


def _bound(error, columns):
    """The bound of an error: a number, a column, a proposal."""
    if not isinstance(error, str) or error == "propose":
        return error
    number = None if error in columns else _BOUND.match(error)
    return _Number(format(Decimal(number[1]), "f")) if number else {"column": error}


def _columns(frame) -> dict[str, np.ndarray]:
    """The columns of whatever has some."""
    if hasattr(frame, "column_names"):  # Arrow
        names = list(frame.column_names)
    elif hasattr(frame, "dtype") and getattr(frame.dtype, "names", None):
        names = list(frame.dtype.names)
    else:
        names = list(getattr(frame, "columns", frame))
    columns = {str(name): _array(frame[name]) for name in names}
    index = getattr(frame, "index", None)
    if index is not None and getattr(index, "name", None) and str(index.name) not in columns:
        columns[str(index.name)] = _array(index)  # pandas: an index with a name is a column, too
    return columns


def _array(values) -> np.ndarray:
    """A column as numbers; those of pandas may be missing, and times may have zones."""
    if getattr(getattr(values, "dtype", None), "tz", None) is not None:
        of = getattr(values, "dt", values)
        values = getattr(of.tz_convert("UTC"), "dt", of.tz_convert("UTC")).tz_localize(None)
    kind = getattr(getattr(values, "dtype", None), "kind", "O")
    if hasattr(values, "to_numpy") and not isinstance(values.dtype, np.dtype) and kind in "fiu":
        missing = values.isna()
        if kind in "iu" and not missing.any():
            return values.to_numpy(dtype=f"{kind}8")
        if kind in "iu" and (abs(values[~missing]) > 2**53).any():
            raise _core.Error("whole numbers beyond 2^53 with missing ones among them: leave out the rows without a number")
        return values.to_numpy(dtype="float64", na_value=np.nan)
    values = np.asarray(values.to_numpy() if hasattr(values, "to_numpy") else values)
    return values.astype(np.uint8) if values.dtype == bool else values
