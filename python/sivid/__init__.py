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
from .commands import (
    certificate,
    check,
    confidence,
    control,
    design,
    diagnose,
    disturbance,
    generate,
    identify,
    predict,
    rank,
    simulate,
    verify,
)
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
    "certificate",
    "check",
    "clamp",
    "confidence",
    "control",
    "deadband",
    "design",
    "diagnose",
    "disturbance",
    "generate",
    "identify",
    "number",
    "predict",
    "rank",
    "simulate",
    "verify",
    "where",
]
