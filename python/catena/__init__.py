# SPDX-License-Identifier: BSD-3-Clause
"""Models, simulation, identification and diagnosis of a hanging cable.

SI units, angles in rad from the downward vertical. Arrays over time have one row per time. Bad input
raises InputError (a ValueError) with the text that the program prints. A computation that fails raises
ComputationError (a RuntimeError). Ctrl-C raises KeyboardInterrupt.
"""

from ._core import (
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
    SensitivityDirection,
    SensitiveSimulation,
    Simulation,
    State,
    Statistics,
    Trajectory,
    catenary,
    diagnose,
    from_angles,
    positions,
    simulate,
    simulate_with_sensitivities,
    straight,
)

__all__ = [
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
    "SensitivityDirection",
    "SensitiveSimulation",
    "Simulation",
    "State",
    "Statistics",
    "Trajectory",
    "catenary",
    "diagnose",
    "from_angles",
    "positions",
    "simulate",
    "simulate_with_sensitivities",
    "straight",
]
