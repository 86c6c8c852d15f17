# SPDX-License-Identifier: MIT
"""The commands of the program sivid as functions. Their options are those of the program (``sivid COMMAND --help``),
with _ for -; what is left out is as the program has it."""
from __future__ import annotations

import json
import os
import shutil
import sys
import warnings
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Union

from . import _core
from .data import Data
from .model import Model
from .results import (
    Confidence,
    Design,
    Diagnosis,
    Disturbance,
    Identification,
    Prediction,
    Ranking,
    Result,
    Verification,
    Workplace,
)

__all__ = [
    "certificate",
    "check",
    "confidence",
    "control",
    "design",
    "diagnose",
    "disturbance",
    "export",
    "generate",
    "identify",
    "predict",
    "rank",
    "simulate",
    "verify",
]

File = Union[str, os.PathLike]
Record = Union[Data, File]
Scenario = Union[dict, File]
Progress = Union[Callable[[str], object], bool, None]


def identify(
    model: Model,
    data: Record,
    *,
    out: File | None = None,
    effects: Sequence[str] = (),
    budget: float | None = None,
    progress: Progress = None,
    **options,
) -> Identification:
    """Which parameters of the prior explain the data, with proof.

    ``effects``: of the model's catalogue, joined to it (``--with``). ``disturbance``: ``{"v": 0.8}``, unknown functions
    of time beside equations, at most so large, and ``error``: ``{"y": 0.1}``, beyond bounds of channels; what is proved
    is so for all of them, and ``predict``, ``verify``, ``control`` and ``check`` take them from the result. ``budget``:
    seconds. Further options: ``accuracy``, ``boxes``, ``outliers``, ``threshold``, ``threads``, ``memory``, ``checkpoint``, ``resume``,
    ``verdict_only``, ``by_bounds``, ``identifiability``, ``method``, ``set``, ``algorithm``, ``batches``.

    ``out``: a folder for the files of the result, as the program writes them; without it they last as long as the
    result. ``progress``: a function of one line of text, False for none; without it a line on a terminal or in a
    notebook.

    Ctrl-C ends the search and raises ``KeyboardInterrupt``, whose ``result`` is what is proved by then.
    """
    place = _placed(out)
    effects = [effects] if isinstance(effects, str) else list(effects)
    words = ["identify", _data(model, data, place), *_words({"with": effects, "budget": budget, **options})]
    return _run(Identification, model, place, words, progress)


def confidence(
    model: Model,
    data: Record,
    probability: float = 0.95,
    *,
    out: File | None = None,
    effects: Sequence[str] = (),
    budget: float | None = None,
    progress: Progress = None,
    **options,
) -> Confidence:
    """The region in which the truth is with exactly this probability, if errors are independent and symmetric about
    zero: their bounds are not used. As ``identify``; further options: ``seed`` of the random signs, ``sums``,
    ``accuracy``.
    """
    place = _placed(out)
    effects = [effects] if isinstance(effects, str) else list(effects)
    options = {"probability": probability, "with": effects, "budget": budget, **options}
    return _run(Confidence, model, place, ["confidence", _data(model, data, place), *_words(options)], progress)


def diagnose(
    model: Model,
    data: Record,
    *,
    out: File | None = None,
    budget: float | None = None,
    progress: Progress = None,
    **options,
) -> Diagnosis:
    """Where model and data disagree, which effect of the model's catalogue explains it, and by how much. As
    ``identify``."""
    place = _placed(out)
    words = ["diagnose", _data(model, data, place), *_words({"budget": budget, **options})]
    return _run(Diagnosis, model, place, words, progress)


def predict(
    result: Identification,
    scenario: Scenario,
    *,
    out: File | None = None,
    budget: float | None = None,
    progress: Progress = None,
    **options,
) -> Prediction:
    """Tubes of a scenario over all parameters that ``result`` leaves, with proof.

    ``scenario``: a dictionary or a file (sivid-scenario-1), or ``"data:NAME"`` for one of the data. ``set``: constants
    in the scenario alone, ``{"Ff": (0.3, 0.7)}``. A control law: ``law``, ``gain``, ``sensor``, ``sampled``, ``delay``,
    ``slew``.
    """
    return _decide(Prediction, "predict", result, scenario, out, progress, {"budget": budget, **options})


def verify(
    result: Identification,
    scenario: Scenario,
    require: str,
    *,
    out: File | None = None,
    budget: float | None = None,
    progress: Progress = None,
    **options,
) -> Verification:
    """Whether a requirement, such as ``"always(abs(v) < 2)"``, holds for all parameters that ``result`` leaves. Further
    options as of ``predict``."""
    options = {"require": require, "budget": budget, **options}
    return _decide(Verification, "verify", result, scenario, out, progress, options)


def control(
    result: Identification,
    scenario: Scenario,
    require: str,
    *,
    law: str,
    gain: Mapping,
    out: File | None = None,
    progress: Progress = None,
    **options,
) -> Result:
    """The gains of a control law that meet a requirement for all parameters that ``result`` leaves: ``gain={"K": (0,
    50)}``."""
    options = {"require": require, "law": law, "gain": gain, **options}
    return _decide(_Control, "control", result, scenario, out, progress, options)


def design(
    result: Identification,
    scenario: Scenario,
    *,
    vary: Mapping,
    halve: str | Sequence[str] = (),
    against: Identification | None = None,
    out: File | None = None,
    progress: Progress = None,
    **options,
) -> Design:
    """The experiment whose data narrow down ``halve`` (parameters or expressions of them, or ``"volume"``) most, or
    tell the model of ``result`` from that of ``against``.

    ``vary``: inputs that may be chosen, ``{"W": (0, 100)}``. Further options: ``share``, ``within``, ``measure``,
    ``duration``, ``period``, ``name``, ``budget``.
    """
    halve = [halve] if isinstance(halve, str) else list(halve)
    options = {"vary": vary, "halve": halve, "against": against and str(against.folder), **options}
    return _decide(Design, "design", result, scenario, out, progress, options)


def rank(
    model: Model,
    data: Record | None = None,
    *,
    scenario: Scenario | None = None,
    effects: Sequence[str] = (),
    out: File | None = None,
    progress: Progress = None,
    **options,
) -> Ranking:
    """How far each parameter alone can move the measurements of data, or of a scenario with ``unknown`` constants and
    ``measure``, the bounds of what is measured: ``{"psi": 0.01}``. ``effects``: of the model's catalogue, joined to it
    (``--with``)."""
    place = _placed(out)
    words = ["rank"] if data is None else ["rank", _data(model, data, place)]
    if "unknown" in options:
        options["unknown"] = _assigned(options["unknown"])
    effects = [effects] if isinstance(effects, str) else list(effects)
    words += _words({"scenario": scenario and _scenario(scenario, place), "with": effects, **options})
    return _run(Ranking, model, place, words, progress)


def disturbance(
    model: Model,
    data: Record,
    on: dict | None = None,
    *,
    error: dict | None = None,
    effects: Sequence[str] = (),
    out: File | None = None,
    progress: Progress = None,
    **options,
) -> Disturbance:
    """The least unknown disturbance with which the model explains the data, proved from both sides.

    ``on``: equations that are disturbed, with what a size of 1 means there, in the state's unit per time:
    ``{"v": 0.01}``. ``error``: channels that may be further off than their bounds, likewise. Options: ``budget``,
    ``curve`` (points of the trade-off between equations and channels)."""
    place = _placed(out)
    words = ["disturbance", _data(model, data, place)]
    effects = [effects] if isinstance(effects, str) else list(effects)
    words += _words({"on": on, "error": error, "with": effects, **options})
    return _run(Disturbance, model, place, words, progress)


def generate(model: Model, scenario: Scenario, out: File, *, progress: Progress = None, **options) -> Data:
    """A data set in the folder ``out``, of the validated motion of known parameters. Options: ``rate``, ``absolute``,
    ``relative``, ``noise``, ``seed``, ``set`` (true values), ``unknown``."""
    place = Workplace()
    if "unknown" in options:
        options["unknown"] = _assigned(options["unknown"])
    words = ["generate", "--scenario", _scenario(scenario, place), *_words(options), "--out", str(out)]
    _answer(model, words, progress, lambda answer: None)
    return Data.read(out)


def simulate(
    model: Model, scenario: Scenario, *, out: File | None = None, progress: Progress = None, **options
) -> Result:
    """Trajectories of a scenario, simulated; with ``validated`` the proven tubes beside them. Files in ``folder``."""
    place = _placed(out)
    words = ["simulate", "--scenario", _scenario(scenario, place), *_words(options)]
    return _run(_Simulation, model, place, words, progress)


def check(result: Result | File, *, model: Model | None = None, progress: Progress = None, **options) -> Result:
    """Proves a result anew, independently: ``code`` is 0 when every claim was, 5 when one is false, else 3. ``result``
    may be a folder, then with its ``model``. Options: ``all``, ``sample``, ``seed``, ``budget``, ``dataset``,
    ``multiprecision``.
    """
    if isinstance(result, Result):
        folder, of = result.folder, model or result.model
    elif model is None:
        raise TypeError("check of a folder needs its model: give model=")
    else:
        folder, of = Path(result), model
    return _answer(
        of, ["check", str(folder), *_words(options)], progress, lambda answer: Result(of, Workplace(folder), answer)
    )


def certificate(result: Identification, file: File, *, progress: Progress = None, **options) -> Result:
    """Writes the result with its data, model, assumptions and proofs into one file, which ``check_certificate``, a
    program in C without sivid, proves anew. ``code`` is 0 when verdict and hull are certified, 3 when a part is.
    Options: ``budget``, ``dataset``.
    """
    if not isinstance(result, Identification):
        raise TypeError("a certificate is of the result of identify, or of the identification of a diagnosis")
    words = ["certificate", str(result.folder), "--out", os.fspath(file), *_words(options)]
    return _answer(
        result.model, words, progress, lambda answer: Result(result.model, Workplace(result.folder), answer, result)
    )


def export(
    result: Identification | Diagnosis,
    file: File,
    to: str = "json",
    *,
    map: dict | File | None = None,
    into: File | None = None,
    progress: Progress = None,
    **options,
) -> Result:
    """Writes a parameter that is proved to explain the data, with the proved ranges: ``to="json"`` a table, ``"mjcf"``
    or ``"urdf"`` the user's file ``into`` with changed attributes, ``"isaaclab"`` arguments of actuators. ``map``: which
    constant is which attribute, a dictionary or a file (sivid-export-1). Notes and ranges stand beside ``file``.
    ``code`` is 0, or 3, 4, 5 where nothing was written, with a warning that says why. Option: ``dataset``.
    """
    if not isinstance(result, (Identification, Diagnosis)):
        raise TypeError("export takes the result of identify or of diagnose")
    place = Workplace()
    if isinstance(map, dict):
        own = place.folder / "map.json"
        own.write_text(json.dumps({"format": "sivid-export-1", **map}), encoding="utf-8")
        map = own
    words = ["export", str(result.folder), "--out", os.fspath(file)]
    words += _words({"to": to, "map": map and os.fspath(map), "into": into and os.fspath(into), **options})
    return _answer(
        result.model, words, progress, lambda answer: Result(result.model, Workplace(result.folder), answer, result)
    )


class _Control(Result):
    page, file = "control.html", "control.json"


class _Simulation(Result):
    page, file = "simulation.html", "simulation.json"


def _placed(out) -> Workplace:
    """The folder of a result."""
    place = Workplace(out)
    place.folder.mkdir(parents=True, exist_ok=True)
    return place


def _data(model, data, place) -> str:
    """The folder of the data set: in a result that is to last it stays where it is, else the result has a copy."""
    if not isinstance(data, Data):
        data = Data.read(data)
    inside = place.folder / "data"
    if data._folder is None:
        data.write(model, inside)
    elif place.lasts:
        return str(data._folder)
    else:
        if not data._folder.is_dir():
            raise _core.Error(f"{data._folder}: there is no such folder; give one with a data set")
        shutil.copytree(data._folder, inside)
    return str(inside)


def _scenario(scenario, place) -> str:
    """As the program takes it: a name or a file."""
    if not isinstance(scenario, dict):
        return os.fspath(scenario)
    file = place.folder / "scenario.in.json"
    file.write_text(json.dumps({"format": "sivid-scenario-1", **scenario}), encoding="utf-8")
    return str(file)


def _assigned(value) -> list[str]:
    """``["Sv", "m=1.2:1.4"]`` of a list of names, or of a dictionary of bounds."""
    return [f"{k}={_text(v)}" for k, v in value.items()] if isinstance(value, dict) else list(value)


def _text(value) -> str:
    if isinstance(value, (tuple, list)):
        return ":".join(_text(v) for v in value)
    return repr(float(value)) if isinstance(value, float) else str(value)


def _words(options: dict) -> list[str]:
    """Options as words of a command line: True is a flag, None is left out, dictionaries are name=value."""
    words = []
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        if value is None or value is False:
            continue
        if value is True:
            words.append(option)
        elif isinstance(value, dict):
            for k, v in value.items():
                words += [option, f"{k}={_text(v)}"]
        elif isinstance(value, (list, tuple)):
            for v in value:
                words += [option, _text(v)]
        else:
            words += [option, _text(value)]
    return words


def _decide(kind, command, result, scenario, out, progress, options):
    """A decision about the parameters that an identification leaves."""
    if not isinstance(result, Identification):
        raise TypeError(f"{command} takes the result of identify, or the identification of a diagnosis")
    place = _placed(out)
    words = [command, str(result.folder), "--scenario", _scenario(scenario, place), *_words(options)]
    return _run(kind, result.model, place, words, progress, result)


def _run(kind, model, place, words, progress, source=None):
    """Runs a command; its result is of the files that it wrote, and the model beside them."""

    def result_of(answer):
        (place.folder / "model.toml").write_bytes(model.text.encode("utf-8", "surrogateescape"))
        return kind(model, place, answer, source)

    return _answer(model, [*words, "--out", str(place.folder)], progress, result_of)


def _answer(model, words, progress, result_of):
    show, end = _progress(progress)
    try:
        code, text, notices, stopped = _core.run(model._core, words, show)
    finally:
        end()
    for notice in notices.splitlines():
        warnings.warn(notice, stacklevel=4)
    if stopped is None:
        return result_of((code, text))
    try:
        found = result_of((code, text))
    except (_core.Error, OSError):
        found = None  # it was stopped before there was any
    setattr(stopped, "result", found)
    raise stopped


def _progress(progress):
    """What shows a line, and what ends it."""
    if progress is None:
        shell = sys.modules.get("IPython")
        progress = sys.stderr.isatty() or bool(shell and shell.get_ipython())
    if progress is False:
        return None, lambda: None
    if callable(progress):
        return progress, lambda: None
    longest = 0

    def show(line):
        nonlocal longest
        longest = max(longest, len(line))
        print("\r" + line.ljust(longest), end="", file=sys.stderr, flush=True)

    return show, lambda: longest and print(file=sys.stderr)
