// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/verdict.hpp"

#include <algorithm>
#include <cmath>

#include "common/nearest_name.hpp"
#include "identify/diagnosis/final_model.hpp"
#include "identify/diagnosis/thresholds.hpp"

namespace catena {
namespace {

/// Little enough where it was fitted and where it was not.
bool closed(const std::vector<Stage>& stages, bool with_effects, const GapTest& fit,
            const GapTest& held_out) {
  return fit.ratio() <= kThresholds.closed && (!with_effects || !only_imitated(stages, fit)) &&
         (held_out.count == 0 || held_out.ratio() <= kThresholds.closed_held_out);
}

/// " with 24 links (12 were too few)", or nothing.
std::string of_more_links(const Diagnosis& found) {
  const int before = found.stages.front().links, now = found.stages.back().links;
  if (now == before) return "";
  return " with " + std::to_string(now) + " links (" + std::to_string(before) + " were too few)";
}

std::string sentence_of_none(const Diagnosis& found) {
  return "No missing effect" + of_more_links(found) +
         (found.freer_start ? "; the start of the motion needed more freedom" : "") +
         (found.final_fit.present ? "; a remainder below the noise is left, too small to name"
                                  : "") +
         ".";
}

std::string sentence_of_unexplained(const Diagnosis& found, const DiagnosisOptions& options) {
  if (!found.effects.empty())
    return "There is a gap; " + listed(found.effects) +
           " would explain part of it, but what is left is above the noise.";
  return options.max_effects > 0
             ? "There is a gap, and nothing in the library explains it."
             : "There is a gap. No effect was looked for: at most 0 effects were allowed.";
}

std::string sentence_of_effects(const Diagnosis& found) {
  std::string sentence = "Missing: " + listed(found.effects) + of_more_links(found) + ".";
  for (const Alternative& form : found.forms)
    sentence += " Its other form " + form.explanation.id + " would do as well.";
  if (found.alternatives.empty()) return sentence;
  std::vector<std::string> others;
  for (const Alternative& alternative : found.alternatives)
    others.push_back(alternative.explanation.id + " instead of " + alternative.instead_of);
  return sentence + " These data do not decide against " + listed(others) + ".";
}

}  // namespace

bool gap_left(const GapTest& fit, const GapTest& held_out) {
  return fit.present || (held_out.count > 0 && held_out.ratio() > kThresholds.closed_held_out);
}

bool gap_left(const Stage& stage) { return gap_left(stage.fit, stage.held_out); }

bool trace_left(const Stage& stage) {
  return stage.fit.autocorrelation > kThresholds.trace_significance &&
         stage.fit.misfit > kThresholds.trace_misfit * stage.fit.noise;
}

bool explained(const std::vector<Stage>& stages) {
  const Stage& last = stages.back();
  return !gap_left(last) || closed(stages, true, last.fit, last.held_out);
}

bool one_may_imitate_two(const std::vector<Stage>& stages) {
  const Stage& last = stages.back();
  return last.effects.size() == 1 && last.fit.ratio() > kThresholds.visible && trace_left(last) &&
         std::pow(last.fit.misfit, 2) >
             kThresholds.wrong_law * std::pow(misfit_without_effects(stages), 2);
}

bool predicts_as_well(const GapTest& held_out, const GapTest& other) {
  // 0 and 0 where nothing is held out
  return held_out.rms <= kThresholds.as_good_held_out * other.rms;
}

double misfit_without_effects(const std::vector<Stage>& stages) {
  double misfit = 0;
  for (const Stage& stage : stages)
    if (stage.effects.empty()) misfit = stage.fit.misfit;
  return misfit;
}

bool only_imitated(const std::vector<Stage>& stages, const GapTest& last) {
  return last.ratio() > kThresholds.visible &&
         std::pow(last.misfit, 2) >
             kThresholds.imitated * std::pow(misfit_without_effects(stages), 2);
}

void conclude(Diagnosis& found, const Case& asked, const DiagnosisOptions& options,
              DiagnosisContext& context) {
  const Stage& last = found.stages.back();
  found.final = last.model;
  make_final_model(found, asked, context);
  found.final_fit = fit_gap(found.final, found.sigmas);
  found.final_held_out = held_out_gap(found.final, found.sigmas);
  found.parameters = final_parameters(found);

  const bool is_closed =
      closed(found.stages, !found.effects.empty(), found.final_fit, found.final_held_out);
  const bool too_small =
      is_closed && found.final_fit.misfit < kThresholds.too_small_to_name * found.final_fit.noise;
  if (found.effects.empty() && (!gap_left(last) || too_small)) {
    found.verdict = DiagnosisVerdict::kNone;
    found.sentence = sentence_of_none(found);
    return;
  }
  if (!is_closed || found.effects.empty()) {
    found.verdict = DiagnosisVerdict::kUnexplained;
    found.sentence = sentence_of_unexplained(found, options);
    return;
  }
  std::erase_if(found.alternatives, [](const Alternative& alternative) {
    return !alternative.explanation.is_effect() ||
           alternative.explanation.fit.ratio() > kThresholds.closed;
  });
  found.verdict =
      found.alternatives.empty() ? DiagnosisVerdict::kNamed : DiagnosisVerdict::kAmbiguous;
  found.sentence = sentence_of_effects(found);
}

const char* name_of(DiagnosisVerdict verdict) {
  switch (verdict) {
    case DiagnosisVerdict::kNone:
      return "none";
    case DiagnosisVerdict::kNamed:
      return "named";
    case DiagnosisVerdict::kAmbiguous:
      return "ambiguous";
    case DiagnosisVerdict::kUnexplained:
      return "unexplained";
  }
  return "";
}

}  // namespace catena
