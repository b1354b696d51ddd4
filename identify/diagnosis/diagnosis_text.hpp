// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "identify/diagnosis/diagnose.hpp"
#include "identify/diagnosis/residual_places.hpp"
#include "identify/diagnosis/telling_experiment.hpp"

namespace catena {

/// What is found out about a finished diagnosis for whoever reads it.
struct DiagnosisFindings {
  ResidualPlaces places;                   ///< of the baseline
  std::vector<TellingExperiment> telling;  ///< one per alternative
};
/// Simulates the experiments that tell alternatives apart.
DiagnosisFindings find_out(const Diagnosis& diagnosis);

/// The verdict first, then the table of gaps, the effects with formula and parameters, the
/// runners-up.
std::string diagnosis_table(const Diagnosis& diagnosis, const DiagnosisFindings& findings);

/// diagnosis.json and the files it names ("round_0/result.json", ...), see docs/diagnosis.md.
std::vector<std::pair<std::string, std::string>> diagnosis_files(const Diagnosis& diagnosis,
                                                                 const DiagnosisFindings& findings,
                                                                 const DiagnosisContext& context);

/// "refitting with load_drag, 3 of 8 done, about 12 s left of this; best so far: with ..."
std::string progress_line(const DiagnosisProgress& progress);

}  // namespace catena
