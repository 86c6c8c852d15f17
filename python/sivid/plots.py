# SPDX-License-Identifier: MIT
"""Pictures by matplotlib."""
from __future__ import annotations

import numpy as np

_KINDS = (
    ("pending", "#c9ced6", "still open"),
    ("undecided", "#e9b44c", "undecided"),
    ("inside", "#2f7d4f", "explains the data (proved)"),
)


def plot_boxes(result, parameters=None, products=None, figure=None):
    """Draws the boxes of an identification over each pair of parameters: in white is what is proved to explain nothing.

    In a picture of two of several parameters a box shows what it is for some value of the others. Inside is drawn last.
    """
    from matplotlib.patches import Patch

    products = bool(result.products) and parameters is None if products is None else products
    known = result.products if products else result.parameters
    names = list(parameters or known)
    where = [known.index(name) for name in names]
    boxes = {kind: np.stack(result.boxes(kind, products), -1)[:, where] for kind, _, _ in _KINDS}
    pairs = [(0, None)] if len(names) == 1 else [(i, j) for j in range(1, len(names)) for i in range(j)]
    side = max(1, len(names) - 1)
    figure = figure or _figure(3.6 * side + 1, 3.2 * side + 0.8)
    axes = {}
    for i, j in pairs:
        row = 0 if j is None else j - 1
        ax = figure.add_subplot(side, side, row * side + i + 1, sharex=axes.get(("x", i)), sharey=axes.get(("y", row)))
        axes.setdefault(("x", i), ax)
        axes.setdefault(("y", row), ax)
        _draw_pair(ax, boxes, i, j)
        if result.witness and not products:
            ax.plot(
                result.witness[names[i]],
                0.5 if j is None else result.witness[names[j]],
                "o",
                color="black",
                markersize=4,
            )
        units = dict(zip(result.parameters, result.units))
        ax.set_xlabel(_label(names[i], units.get(names[i], "")))
        ax.set_yticks([]) if j is None else ax.set_ylabel(_label(names[j], units.get(names[j], "")))
    _legend(figure.axes[0], handles=[Patch(color=c, label=text) for k, c, text in reversed(_KINDS) if len(boxes[k])])
    figure.suptitle(f"{result.to_json()['dataset']}: {result.verdict}", x=0.02, ha="left")
    return figure


def _draw_pair(ax, boxes, i, j):
    """The boxes over two coordinates, or over one, and a margin around them."""
    from matplotlib.collections import PolyCollection

    for kind, colour, _ in _KINDS:
        (x0, x1) = boxes[kind][:, i].T
        (y0, y1) = (np.zeros_like(x0), np.ones_like(x0)) if j is None else boxes[kind][:, j].T
        corners = np.stack([np.stack(c, -1) for c in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))], 1)
        ax.add_collection(PolyCollection(corners, facecolors=colour, edgecolors="face", linewidths=0.3))
    everything = np.concatenate(list(boxes.values()))
    for axis, k in ((ax.set_xlim, i), (ax.set_ylim, j)):
        if len(everything) and k is not None:
            low, high = everything[:, k, 0].min(), everything[:, k, 1].max()
            margin = 0.08 * (high - low) or 0.01 * abs(low) or 1
            axis(low - margin, high + margin)
    ax.locator_params(nbins=5)


def plot_outputs(result, figure=None):
    """Draws measurements with their bounds and, as a band, what the model shows for a parameter that explains them."""
    table = result.outputs()
    series = list(dict.fromkeys(zip(table["scenario"], table["channel"])))
    figure = figure or _figure(7, 1.9 * len(series) + 0.6)
    first = None
    for k, (scenario, channel) in enumerate(series):
        ax = first = figure.add_subplot(len(series), 1, k + 1, sharex=first)
        rows = table[(table["scenario"] == scenario) & (table["channel"] == channel)]
        low, high = rows["measured_lower"], rows["measured_upper"]
        out = np.array([bool(s) for s in rows["state"]], bool)
        for mask, colour, label in ((~out, "#34506e", "measured, with its bound"), (out, "#b3261e", "outlier")):
            if mask.any():
                ax.errorbar(
                    rows["t"][mask],
                    (low + high)[mask] / 2,
                    (high - low)[mask] / 2,
                    fmt="none",
                    ecolor=colour,
                    elinewidth=1,
                    capsize=2,
                    label=label,
                )
        if np.isfinite(rows["model_lower"]).any():
            middle = (rows["model_lower"] + rows["model_upper"]) / 2
            ax.fill_between(
                rows["t"], rows["model_lower"], rows["model_upper"], color="#2f7d4f", alpha=0.35, linewidth=0
            )
            ax.plot(rows["t"], middle, color="#2f7d4f", linewidth=0.9, label="a motion that explains them (verified)")
        ax.set_ylabel(_label(channel, rows["unit"][0]))
        ax.set_title(scenario, loc="right", fontsize="small")
        if k == 0:
            _legend(ax)
    first.set_xlabel(_label("t", result.model.time_unit))
    return figure


def plot_tubes(result, names=None, figure=None):
    """Draws the tubes of a prediction: every motion of every parameter that is left runs within them."""
    table = result.tubes()
    model = result.model
    known = [n[:-6] for n in table.dtype.names if n.endswith("_lower")]
    names = list(names or [n for n in known if n in model.outputs])
    figure = figure or _figure(7, 1.9 * len(names) + 0.6)
    units, first = {**model.states, **model.outputs}, None
    t = np.stack([table["from"], table["to"]], 1).ravel()
    for k, name in enumerate(names):
        ax = first = figure.add_subplot(len(names), 1, k + 1, sharex=first)
        low, high = (np.repeat(table[name + end], 2) for end in ("_lower", "_upper"))
        ax.fill_between(t, low, high, color="#34506e", alpha=0.45, linewidth=0.6)
        ax.set_ylabel(_label(name, units.get(name, "1")))
    first.set_xlabel(_label("t", model.time_unit))
    figure.suptitle(
        f"{result.to_json()['scenario']}: all motions that {result.to_json()['dataset']} leaves", x=0.02, ha="left"
    )
    return figure


def _legend(ax, **of):
    """Above the axes, in a line where there is room for it."""
    columns = 1 if ax.get_position().width * ax.figure.get_figwidth() < 5 else 3
    ax.legend(loc="lower left", bbox_to_anchor=(-0.02, 1.0), ncol=columns, frameon=False, fontsize="small", **of)


def _label(name, unit) -> str:
    return name if unit in ("1", "") else f"{name} [{unit}]"


def _figure(width, height):
    import matplotlib.pyplot as plt

    return plt.figure(figsize=(width, height), layout="constrained")
