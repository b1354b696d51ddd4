// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "identify/cases/case.hpp"
#include "identify/diagnosis/context.hpp"
#include "identify/diagnosis/diagnosis.hpp"

namespace catena {

/// The whole diagnosis of a case; docs/diagnosis.md describes its stages. Throws InputError where
/// the case cannot be diagnosed (no data to fit), ModelError where a model cannot be made,
/// Interrupted, std::runtime_error where the baseline cannot be fitted.
Diagnosis diagnose(Case the_case, DiagnosisContext& context, const DiagnosisOptions& options);

}  // namespace catena
