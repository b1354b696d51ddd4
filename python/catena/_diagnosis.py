# SPDX-License-Identifier: BSD-3-Clause
"""What a diagnosis found, read from its document (diagnosis.json)."""
import json
from dataclasses import dataclass
from math import inf, nan


@dataclass(frozen=True)
class DiagnosisGap:
    """How far a model is from the data, m or rad."""

    fit: float  # root mean square over what was fitted
    held_out: float  # over what was held out, by which effects were chosen; NaN if nothing was
    sealed: float  # over what no fit and no choice has seen; NaN if nothing is sealed
    noise_level: float  # what noise alone would leave


@dataclass(frozen=True)
class FoundParameter:
    """A parameter of the final model."""

    name: str
    unit: str
    effect: str  # empty for the case's own
    value: float
    standard_error: float  # allows for autocorrelated residuals; infinite where the data do not tell


@dataclass(frozen=True)
class OtherEffect:
    """An effect that was refitted and has no name."""

    id: str
    instead_of: str  # empty: as the last one added
    fit: float  # gap it leaves where it was fitted, m or rad
    difference: float  # how far its predictions are from those of the final model, in noises
    experiment_that_tells: str  # empty where none was sought


class Diagnosis:
    """What a model lacks; str() is the table that the program prints."""

    def __init__(self, record):
        self._record = record
        self._document = json.loads(record.document)

    @property
    def verdict(self):
        """none, named, ambiguous, partly, discovered or unexplained."""
        return self._document["verdict"]

    @property
    def sentence(self):
        """What the verdict says, in one or two sentences."""
        return self._document["sentence"]

    @property
    def notes(self):
        """Warnings."""
        return self._document["notes"]

    @property
    def effects(self):
        """Those of the final model."""
        return self._document["rounds"][-1]["effects"]

    @property
    def certain(self):
        """Those of them that stand whatever else is missing."""
        return self._document["certain"]

    @property
    def links(self):
        """Of the final model."""
        return self._document["links"]["used"]

    @property
    def parameters(self):
        """What was fitted in the final model."""
        return [
            FoundParameter(
                p["name"],
                p["unit"],
                p["effect"] or "",
                p["value"],
                _number(p.get("standard_error"), inf),
            )
            for p in self._document["parameters"]
        ]

    @property
    def gap_before(self):
        """Of the case's own model."""
        return _gap(self._document["rounds"][0]["gap"])

    @property
    def gap(self):
        """Of the final model."""
        return _gap(self._document["rounds"][-1]["gap"])

    @property
    def undecided(self):
        """Effects that explain the same data as well."""
        return _others(self._document["undecided"])

    @property
    def forms(self):
        """Other laws of the effect that is named, undecided too."""
        return _others(self._document["forms"])

    @property
    def runners_up(self):
        """Effects that the data decide against."""
        return _others(self._document["runners_up"])

    def document(self):
        """Everything, as diagnosis.json has it."""
        return json.loads(self._record.document)

    def write(self, folder):
        """Writes what catena diagnose writes: diagnosis.json, the results of the rounds, the case with
        what was found, and the new model."""
        self._record.write(folder)

    def report(self, file):
        """Writes the HTML report, as catena report does."""
        self._record.report(file)

    def __str__(self):
        return self._record.table


def _number(value, otherwise):
    return otherwise if value is None else value


def _gap(entry):
    held_out, sealed = (_number(entry.get(key), nan) for key in ("validate", "sealed"))
    return DiagnosisGap(entry["fit"], held_out, sealed, entry["noise_level"])


def _others(entries):
    return [
        OtherEffect(
            e["id"],
            e["instead_of"],
            e["fit"],
            e["difference"],
            (e.get("experiment_that_tells") or {}).get("words", ""),
        )
        for e in entries
    ]
