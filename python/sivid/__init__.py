# SPDX-License-Identifier: MIT
"""Proofs about dynamic models and data: which parameters can explain a record, what is missing in a model, what holds
for all that is left.

    import pandas, sivid

    model = sivid.Model.read("growth.toml")
    data = sivid.Data(pandas.read_csv("culture.csv"), time="t", outputs={"x": ("mass", "+-0.02")})
    found = sivid.identify(model, data, budget=20)
    found.plot()

The module calls what the program ``sivid`` calls; results are the same files, which ``sivid check`` proves anew.
"""
from ._core import Error, InternalError, version as __version__
from . import commands
from .commands import *  # noqa: F403: what its __all__ lists
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
)
from .tracing import clamp, deadband, number, where

__all__ = [
    "Confidence",
    "Data",
    "Design",
    "Diagnosis",
    "Disturbance",
    "Error",
    "Identification",
    "InternalError",
    "Model",
    "Prediction",
    "Ranking",
    "Result",
    "Verification",
    *commands.__all__,
    "clamp",
    "deadband",
    "number",
    "where",
]
