# SPDX-License-Identifier: BSD-3-Clause
"""Models, simulation, identification and diagnosis of a hanging cable.

SI units, angles in rad from the downward vertical. Arrays over time have one row per time. A bad
input raises InputError (a ValueError) with the text that the program prints, a computation that
fails ComputationError (a RuntimeError), Ctrl-C KeyboardInterrupt.
"""

from ._core import (
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
    Seed,
    SensitiveSimulation,
    Simulation,
    State,
    Statistics,
    Study,
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
    "Seed",
    "SensitiveSimulation",
    "Simulation",
    "State",
    "Statistics",
    "Study",
    "Trajectory",
    "catenary",
    "diagnose",
    "from_angles",
    "positions",
    "simulate",
    "simulate_with_sensitivities",
    "straight",
]
