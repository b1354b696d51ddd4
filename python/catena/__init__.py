# SPDX-License-Identifier: BSD-3-Clause
"""Models, simulation, identification and diagnosis of a hanging cable.

SI units, angles in rad from the downward vertical. Arrays over time have one row per time. Bad input
raises InputError (a ValueError) with the text that the program prints. A computation that fails raises
ComputationError (a RuntimeError). Ctrl-C raises KeyboardInterrupt.
"""

from ._core import (
    AdjointSimulation,
    Case,
    ComputationError,
    Diagnosis,
    DiagnosisGap,
    Experiment,
    FoundParameter,
    Gap,
    Identification,
    InputError,
    Model,
    OtherEffect,
    SensitiveSimulation,
    SensitivityDirection,
    Simulation,
    State,
    Statistics,
    Trajectory,
    accelerations,
    catenary,
    diagnose,
    from_angles,
    internal_forces,
    positions,
    simulate,
    simulate_batch,
    simulate_with_gradient,
    simulate_with_sensitivities,
    straight,
)
from ._core import __version__ as __version__

__all__ = [
    "AdjointSimulation",
    "Case",
    "ComputationError",
    "Diagnosis",
    "DiagnosisGap",
    "Experiment",
    "FoundParameter",
    "Gap",
    "Identification",
    "InputError",
    "Model",
    "OtherEffect",
    "SensitiveSimulation",
    "SensitivityDirection",
    "Simulation",
    "State",
    "Statistics",
    "Trajectory",
    "accelerations",
    "catenary",
    "diagnose",
    "from_angles",
    "internal_forces",
    "positions",
    "simulate",
    "simulate_batch",
    "simulate_with_gradient",
    "simulate_with_sensitivities",
    "straight",
]
