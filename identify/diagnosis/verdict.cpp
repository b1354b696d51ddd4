// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/verdict.hpp"

#include <cmath>

#include "common/nearest_name.hpp"
#include "identify/diagnosis/final_model.hpp"

namespace catena {
namespace {

constexpr double kTrace = 0.15;           // of the noise
constexpr double kTraceSignificance = 4;  // deviations
constexpr double kTooSmallToName = 0.6;   // misfit over noise below which nothing is called missing
constexpr double kImitated = 0.02;        // of the squared misfit before the first effect
constexpr double kNotWorse = 1.05;        // held-out error over the other's

}  // namespace

bool gap_left(const Stage& stage) {
  return stage.fit.present || (stage.held_out.count > 0 && stage.held_out.ratio() > kClosedHeldOut);
}

bool trace_left(const Stage& stage) {
  return stage.fit.colour > kTraceSignificance && stage.fit.misfit > kTrace * stage.fit.floor;
}

bool predicts_as_well(const GapTest& held_out, const GapTest& other) {
  return held_out.rms <= kNotWorse * other.rms;  // 0 and 0 where nothing is held out
}

double misfit_without_effects(const std::vector<Stage>& stages) {
  double misfit = 0;
  for (const Stage& stage : stages)
    if (stage.effects.empty()) misfit = stage.fit.misfit;
  return misfit;
}

bool only_imitated(const std::vector<Stage>& stages, const GapTest& last) {
  return last.ratio() > kVisible &&
         std::pow(last.misfit, 2) > kImitated * std::pow(misfit_without_effects(stages), 2);
}

void conclude(Diagnosis& d, const Case& asked, Workshop& workshop) {
  const Stage& last = d.stages.back();
  d.final = last.model;
  make_final_model(d, asked, workshop);
  d.final_fit = fit_gap(d.final, d.floors);
  d.final_held_out = held_out_gap(d.final, d.floors);
  d.parameters = final_parameters(d);

  const bool closed = d.final_fit.ratio() <= kClosed &&
                      (d.effects.empty() || !only_imitated(d.stages, d.final_fit)) &&
                      (d.final_held_out.count == 0 || d.final_held_out.ratio() <= kClosedHeldOut);
  const std::string links = last.links != d.stages.front().links
                                ? " with " + std::to_string(last.links) + " links (" +
                                      std::to_string(d.stages.front().links) + " were too few)"
                                : "";
  if (d.effects.empty() &&
      (!gap_left(last) || (closed && d.final_fit.misfit < kTooSmallToName * d.final_fit.floor))) {
    d.verdict = DiagnosisVerdict::kNone;
    d.sentence =
        "No missing effect" + (links.empty() ? std::string() : links) +
        (d.freer_start ? "; the start of the motion needed more freedom" : "") +
        (d.final_fit.present ? "; a remainder below the noise is left, too small to name" : "") +
        ".";
    return;
  }
  if (!closed) {
    d.verdict = DiagnosisVerdict::kUnexplained;
    d.sentence = d.effects.empty()
                     ? "There is a gap, and nothing in the library explains it."
                     : "There is a gap; " + listed(d.effects) +
                           " would explain part of it, but what is left is above the noise.";
    return;
  }
  std::erase_if(d.alternatives, [&](const Alternative& alternative) {
    return alternative.explanation.candidate < 0 || alternative.explanation.fit.ratio() > kClosed;
  });
  d.verdict = d.alternatives.empty() ? DiagnosisVerdict::kNamed : DiagnosisVerdict::kAmbiguous;
  d.sentence = "Missing: " + listed(d.effects) + links + ".";
  for (const Alternative& form : d.forms)
    d.sentence += " Its other form " + form.explanation.id + " would do as well.";
  if (d.verdict == DiagnosisVerdict::kAmbiguous) {
    std::vector<std::string> others;
    for (const Alternative& alternative : d.alternatives)
      others.push_back(alternative.explanation.id + " instead of " + alternative.instead_of);
    d.sentence += " These data do not decide against " + listed(others) + ".";
  }
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
