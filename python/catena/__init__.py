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
    Experiment,
    Gap,
    Identification,
    InputError,
    Model,
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
from ._diagnosis import Diagnosis, DiagnosisGap, FoundParameter, OtherEffect


def show_progress(*now: object) -> None:
    """Shows how far identify or diagnose is, in one line, in a notebook or a terminal.

    Pass it as their argument `progress`.
    """
    if len(now) == 3:
        line = f"evaluation {now[0]} of at most {now[1]}, error {now[2]:.6g}"
    else:
        line = str(now[0])
    global _shown
    print("\r" + line.ljust(_shown), end="", flush=True)
    _shown = len(line)


_shown = 0  # letters of the line that is overwritten

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
    "show_progress",
    "simulate",
    "simulate_batch",
    "simulate_with_gradient",
    "simulate_with_sensitivities",
    "straight",
]
