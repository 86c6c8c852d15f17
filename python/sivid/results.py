# SPDX-License-Identifier: MIT
"""Results: the files that a command has written, as arrays, pictures and pages."""
from __future__ import annotations

import csv
import html
import json
import shutil
import tempfile
import weakref
from pathlib import Path

import numpy as np

from . import _core

__all__ = ["Confidence", "Design", "Diagnosis", "Identification", "Prediction", "Ranking", "Result", "Verification"]


class Workplace:
    """The folder of a result: a stated one, or one that lasts as long as the result does."""

    def __init__(self, out=None):
        self.lasts = out is not None
        self.folder = Path(out if out is not None else tempfile.mkdtemp(prefix="sivid-"))
        if not self.lasts:
            weakref.finalize(self, shutil.rmtree, self.folder, ignore_errors=True)


class Result:
    """What a command found. ``text`` is what the program prints, ``code`` its exit code."""

    page = "report.html"
    file = "result.json"

    def __init__(self, model, place: Workplace, answer, source: "Result | None" = None):
        self.model = model
        self.folder = place.folder
        self.code, self.text = answer[0], answer[1]
        self._place, self._source = place, source  # the folders of both last as long as this
        self._json: dict = {}

    def to_json(self) -> dict:
        """The whole result, as the program writes it."""
        if not self._json:
            self._json = json.loads((self.folder / self.file).read_text(encoding="utf-8"))
        return self._json

    def save(self, folder) -> Path:
        """Copies all files, with the model and the data, so that ``sivid check FOLDER/model.toml FOLDER`` proves it
        anew. (Data that were a folder beside ``out`` stay there.)"""
        shutil.copytree(self.folder, folder, dirs_exist_ok=True)
        return Path(folder)

    def report(self, file) -> Path:
        """Copies the page of the result: one file of HTML with its pictures."""
        return Path(shutil.copyfile(self.folder / self.page, file))

    @property
    def assumptions(self) -> list[str]:
        """What the result rests on besides what is proved."""
        return self.to_json().get("assumptions", [])

    def _repr_html_(self) -> str:
        page = self.folder / self.page
        shown = f"<pre>{html.escape(self.text)}</pre>"
        if page.is_file():
            whole = html.escape(page.read_text(encoding="utf-8"), quote=True)
            shown += f'<iframe srcdoc="{whole}" style="width:100%;height:40em;border:1px solid #ccc"></iframe>'
        return shown

    def __repr__(self) -> str:
        return self.text.rstrip() or f"<{type(self).__name__} in {self.folder}>"


class Identification(Result):
    """Which parameters of the prior explain the data: proved inside, undecided, all else proved outside."""

    def __init__(self, model, place, answer, source=None):
        super().__init__(model, place, answer, source)
        self._stored = _core.read_identification(str(self.folder))

    def save(self, folder) -> Path:
        """As of any result; that of a diagnosis is saved with it, in the folder ``model``."""
        if isinstance(self._source, Diagnosis):
            return self._source.save(folder) / "model"
        return super().save(folder)

    @property
    def verdict(self) -> str:
        """``consistent``, ``inconsistent`` or ``undecided``; the first two are proved."""
        return self.to_json()["verdict"]

    @property
    def stop_reason(self) -> str:
        """Why the search ended."""
        return self.to_json()["stop_reason"]

    @property
    def parameters(self) -> list[str]:
        """Names, in the order of all arrays."""
        return self._stored["names"]

    @property
    def units(self) -> list[str]:
        """Of the parameters."""
        return self._stored["units"]

    @property
    def hull(self) -> np.ndarray:
        """Bounds of all that is not excluded, shape (d, 2); NaN where all is. Proved: nothing outside explains the
        data."""
        return self._stored["hull"]

    @property
    def products(self) -> list[str]:
        """The products of parameters in which the search ran, where parameters act through products alone, such as
        ``Sg*L``; else none."""
        return self._stored["products"]["names"] if "products" in self._stored else []

    def boxes(self, kind: str, products: bool = False) -> tuple[np.ndarray, np.ndarray]:
        """Lower and upper corners, each of shape (n, d), of parameters, or of what ``products`` names.

        ``kind``: ``inside`` (every point of it explains the data; the corners are within a rounding of the proved ones,
        which the tables have), ``undecided`` (tested, and small), ``pending`` (left when the search ended). Whatever no
        box covers is proved outside.
        """
        if kind not in ("inside", "undecided", "pending"):
            raise ValueError(f"there are no boxes {kind!r}: write inside, undecided or pending")
        if products and not self.products:
            raise ValueError("the search did not run in products: take the boxes of parameters")
        both = (self._stored["products"] if products else self._stored)[kind]
        return both[:, :, 0], both[:, :, 1]

    @property
    def witness(self) -> dict[str, float] | None:
        """A parameter that is verified to explain the data."""
        found = self.to_json().get("witness")
        return found and found["parameters"]

    @property
    def journal(self) -> list[dict]:
        """What was tried, and what came of it."""
        return self.to_json().get("journal", [])

    def frame(self):
        """The hull as a pandas frame: lower, upper and unit of each parameter."""
        import pandas

        return pandas.DataFrame(
            {"lower": self.hull[:, 0], "upper": self.hull[:, 1], "unit": self.units},
            index=pandas.Index(self.parameters, name="parameter"),
        )

    def outputs(self) -> np.ndarray:
        """Measurements and what the model shows for a parameter that explains them, a structured array with scenario,
        t, channel, measured_lower, measured_upper, model_lower, model_upper (NaN where no motion is known)."""
        return _table(self.folder / "outputs.csv", ("scenario", "channel", "unit", "state"))

    def plot(self, **options):
        """Draws the boxes over each pair of parameters, or of ``products`` where the search ran in these
        (``products=False``: of parameters all the same). Returns the figure of matplotlib."""
        from .plots import plot_boxes

        return plot_boxes(self, **options)

    def plot_outputs(self, **options):
        """Draws measurements with their bounds, and the motion that explains them. Returns the figure."""
        from .plots import plot_outputs

        return plot_outputs(self, **options)


class Diagnosis(Result):
    """Where model and data disagree, and what explains it."""

    file = "diagnosis.json"

    @property
    def answer(self) -> str:
        """``none`` (nothing is missing), ``effects``, or why there is none."""
        return self.to_json()["answer"]["kind"]

    @property
    def effects(self) -> list[str]:
        """What is missing in the model, if that is the answer."""
        return self.to_json()["answer"].get("effects", [])

    @property
    def gap(self) -> dict:
        """The verdict on the model as it is, and by how much bounds would have to grow."""
        return self.to_json()["gap"]

    @property
    def identification(self) -> Identification | None:
        """Of the model that explains the data."""
        place = Workplace(self.folder / "model")
        if not (place.folder / "result.json").is_file():
            return None
        return Identification(self.model, place, (0, ""), self)


class Prediction(Result):
    """Tubes of a scenario that hold for all parameters that an identification leaves."""

    page, file = "prediction.html", "prediction.json"

    @property
    def complete(self) -> bool:
        """Whether the tubes reach the end of the scenario."""
        return self.to_json()["complete"]

    def tubes(self) -> np.ndarray:
        """A structured array with from, to, and NAME_lower, NAME_upper of channels and states. A row with from = to is
        an instant, the rows between hold for the time between. Proved for every motion."""
        return _table(self.folder / "tubes.csv")

    def plot(self, names=None):
        """Draws the tubes. Returns the figure of matplotlib."""
        from .plots import plot_tubes

        return plot_tubes(self, names)


class Verification(Result):
    """Whether a requirement holds for all parameters that an identification leaves."""

    page, file = "verification.html", "verification.json"

    @property
    def answer(self) -> str:
        """``proved``, ``refuted`` or ``open``."""
        return self.to_json()["answer"]

    @property
    def robustness(self) -> tuple[float, float]:
        """How far the requirement is from failing, as bounds."""
        low, high = self.to_json()["robustness"]
        return (-np.inf if low is None else low), (np.inf if high is None else high)

    @property
    def witness(self) -> dict | None:
        """A motion that violates the requirement, of a parameter that explains the data."""
        return self.to_json().get("witness")


class Design(Result):
    """The experiment whose data narrow down a parameter most."""

    page, file = "design.html", "design.json"

    @property
    def answer(self) -> str:
        """Whether an experiment with what was asked is found."""
        return self.to_json()["answer"]

    @property
    def scenario(self) -> dict | None:
        """The experiment (sivid-scenario-1), which ``predict`` and ``verify`` take, too."""
        file = self.folder / "scenario.json"
        return json.loads(file.read_text(encoding="utf-8")) if file.is_file() else None


class Confidence(Result):
    """The region in which the truth is with a stated probability: proved inside, undecided, all else proved outside."""

    page, file = "confidence.html", "confidence.json"

    @property
    def probability(self) -> float:
        """Exactly 1 - ``above`` / ``sums`` of ``to_json()``, over errors and random signs."""
        return self.to_json()["probability"]

    @property
    def unknowns(self) -> list[str]:
        """Names, in the order of all arrays: parameters, then starts that have a width."""
        return list(self.to_json()["prior"])

    @property
    def hull(self) -> np.ndarray:
        """Bounds of the region, shape (d, 2); NaN where nothing of the prior is in it."""
        hull = self.to_json()["hull"]
        return np.array([hull[name] or (None, None) for name in self.unknowns], float)

    def boxes(self, kind: str) -> tuple[np.ndarray, np.ndarray]:
        """Lower and upper corners, each of shape (n, d), of boxes that are ``inside``, ``undecided`` or ``pending``."""
        if kind not in ("inside", "undecided", "pending"):
            raise ValueError(f"there are no boxes {kind!r}: write inside, undecided or pending")
        with open(self.folder / "confidence.csv", newline="", encoding="utf-8") as lines:
            rows = [[float(x) for x in row[1:]] for row in csv.reader(lines) if row[0] == kind]
        both = np.array(rows, float).reshape(len(rows), len(self.unknowns), 2)
        return both[:, :, 0], both[:, :, 1]


class Ranking(Result):
    """How far each parameter alone can move the measurements."""

    page, file = "ranking.html", "ranking.json"


class Disturbance(Result):
    """The least disturbance with which a model explains its data."""

    page, file = "disturbance.html", "disturbance.json"

    @property
    def size(self) -> tuple:
        """Proved bounds of the least size; the upper one is None where no witness was found."""
        return tuple(self.to_json()["size"])

    @property
    def pieces(self) -> np.ndarray:
        """What the witness is disturbed by: scenario, equation, from, to, value."""
        return _table(self.folder / "disturbance.csv", ("scenario", "equation"))


def _table(file, texts=()) -> np.ndarray:
    """A table of a result as a structured array; empty cells are NaN."""
    with open(file, newline="", encoding="utf-8") as lines:
        rows = list(csv.reader(lines))
    names, rows = rows[0], rows[1:]
    result = np.empty(len(rows), [(n, object if n in texts else float) for n in names])
    for k, name in enumerate(names):
        result[name] = [row[k] if name in texts else float(row[k] or "nan") for row in rows]
    return result
