// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "common/nearest_name.hpp"
#include "identify/diagnosis/errors_of_knowns.hpp"
#include "identify/diagnosis/final_model.hpp"
#include "identify/diagnosis/remainder.hpp"
#include "identify/diagnosis/residual_places.hpp"
#include "identify/diagnosis/same_model.hpp"
#include "identify/diagnosis/sealed_part.hpp"
#include "identify/diagnosis/thresholds.hpp"
#include "identify/diagnosis/variant.hpp"
#include "identify/diagnosis/wrong_knowns.hpp"
#include "identify/fit/estimated_noise.hpp"

namespace catena {
namespace {

/// Whether what is left without effects is too little to be called missing.
bool too_small_to_name(const Diagnosis& found) {
  const double small = std::pow(kThresholds.too_small_to_name, 2);
  return leaves_no_more(found.final, found.noise, {small, small});
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

/// "84 % (81 to 87)"
std::string in_percent(const ShareInterval& share) {
  return fmt::format("{:.0f} % ({:.0f} to {:.0f})", 100 * share.share, 100 * share.lower,
                     100 * share.upper);
}

/// "air_drag_linear explains 84 % (81 to 87), ...": of the effects in `which`.
std::string shares_in_words(const Diagnosis& found, const std::vector<std::string>& which) {
  std::vector<std::string> parts;
  for (const EffectShare& share : found.shares.effects)
    if (std::find(which.begin(), which.end(), share.effect) != which.end())
      parts.push_back(share.effect + " explains " + in_percent(share.fitted));
  return listed(parts) + " of the squared misfit";
}

/// What the final model leaves: how much, how large, and where.
std::string remainder_in_words(const Diagnosis& found) {
  const bool angles = found.final.problem->experiments().front().spec.kind == DataKind::kAngles;
  const char* const unit = angles ? "mrad" : "mm";
  std::string words = fmt::format("{:.3g} {} are left, {:.3g} times the noise",
                                  1e3 * found.final_fit.rms, unit, found.final_fit.ratio());
  const double sealed = sealed_rms(found.final);
  if (!std::isnan(sealed))
    words += fmt::format(" ({:.3g} {} in the sealed part)", 1e3 * sealed, unit);
  else if (found.final_held_out.count > 0)
    words +=
        fmt::format(" ({:.3g} {} where it was not fitted)", 1e3 * found.final_held_out.rms, unit);
  for (const std::string& place : residual_places(found.final, levels(found.noise)).words)
    words += ", " + place;
  return words;
}

/// Whether what is no effect, a start that bends more or moves, does as well in the place of one.
bool needs_no_effect(const Diagnosis& found, const std::string& effect) {
  return std::any_of(found.alternatives.begin(), found.alternatives.end(),
                     [&](const Alternative& other) {
                       return other.instead_of == effect && !other.explanation.is_effect();
                     });
}

/// "joint_hysteresis (or joint_dry_friction)"
std::string with_rivals(const Diagnosis& found, const std::string& effect) {
  std::vector<std::string> rivals;
  for (const Alternative& other : found.alternatives)
    if (other.instead_of == effect) rivals.push_back(other.explanation.id);
  return rivals.empty() ? effect : fmt::format("{} (or {})", effect, listed(rivals));
}

/// `stand`: effects that stand, each by itself or as one of several that the data do not tell apart.
std::string sentence_of_partly(const Diagnosis& found, const std::vector<std::string>& stand) {
  std::vector<std::string> named, doubtful;
  for (const std::string& id : stand) named.push_back(with_rivals(found, id));
  std::string sentence =
      fmt::format("Missing, but not alone: {}. {}.", listed(named), shares_in_words(found, stand));
  for (const std::string& id : found.effects)
    if (std::find(stand.begin(), stand.end(), id) == stand.end()) doubtful.push_back(id);
  if (!doubtful.empty())
    sentence += fmt::format(" Not certain: {}.", shares_in_words(found, doubtful));
  return sentence + fmt::format(" {} stays: {}.", in_percent(found.shares.left_fitted),
                                remainder_in_words(found));
}

std::string sentence_of_unexplained(const Diagnosis& found, const DiagnosisOptions& options) {
  if (options.max_effects == 0)
    return "There is a gap. No effect was looked for: at most 0 effects were allowed.";
  const std::string left = remainder_in_words(found);
  if (found.effects.empty())
    return fmt::format("There is a gap, and nothing in the library explains it. {}.", left);
  return fmt::format("There is a gap; {} would explain part of it, but this is not certain. {}.",
                     listed(found.effects), left);
}

/// `doubtful`: effects that plausible errors of knowns and sensors could stand for.
std::string sentence_of_effects(const Diagnosis& found, const std::vector<std::string>& doubtful) {
  std::string sentence = "Missing: " + listed(found.effects) + of_more_links(found) + ".";
  for (const Alternative& form : found.forms)
    sentence += " Its other form " + form.explanation.id + " would do as well.";
  if (found.shares.effects.size() > 1)
    sentence += fmt::format(" {}.", shares_in_words(found, found.effects));
  std::vector<std::string> others;
  others.reserve(doubtful.size() + found.alternatives.size());
  for (const std::string& id : doubtful)
    others.push_back("errors of what the case states or of the sensors instead of " + id);
  for (const Alternative& alternative : found.alternatives)
    others.push_back(alternative.explanation.id + " instead of " + alternative.instead_of);
  if (others.empty()) return sentence;
  return sentence + " These data do not decide against " + listed(others) + ".";
}

/// "Missing, and in no library: side force = -linear x (side position - rest) at arc length 1.24 m
/// (discovered_law)."
std::string sentence_of_law(const Diagnosis& found, bool is_closed) {
  const MissingForce& force = *found.force;
  std::string sentence =
      fmt::format("Missing, and in no library: {}{} ({}){}.", force.law->formula.text,
                  site_in_words(force.law->site), found.law, of_more_links(found));
  if (!found.shares.empty()) sentence += fmt::format(" {}.", shares_in_words(found, found.effects));
  return is_closed ? sentence
                   : sentence + fmt::format(" {} stays: {}.", in_percent(found.shares.left_fitted),
                                            remainder_in_words(found));
}

/// Of the effects that are certain: " The load is 2.1 % (1.8 to 2.4) heavier than the case says."
std::string wrong_knowns_in_words(const DiagnosisState& state) {
  std::string words;
  for (const std::string& id : state.found.certain)
    for (std::string sentence :
         wrong_knowns(state.context.find(id)->effect, state.found.parameters,
                      state.found.final.problem->the_case().cable.load_mass)) {
      sentence.front() =
          static_cast<char>(std::toupper(static_cast<unsigned char>(sentence.front())));
      words += fmt::format(" {}.", sentence);
    }
  return words;
}

bool effects_close_gap(DiagnosisState& state, const FittedModel& model,
                       const std::vector<std::string>& effects) {
  return closes_gap(model, without_laws(state, model, effects), state.found.noise);
}

}  // namespace

FittedModel without_laws(DiagnosisState& state, const FittedModel& model,
                         const std::vector<std::string>& effects) {
  std::vector<std::string> exact;
  std::copy_if(effects.begin(), effects.end(), std::back_inserter(exact),
               [&](const std::string& id) { return is_error_of_known(*state.context.find(id)); });
  if (exact.size() == effects.size()) return model;
  if (exact.empty()) return last_without_effects(state.found.stages).model;
  Case the_case = model.problem->the_case();
  for (const std::string& id : effects)
    if (std::find(exact.begin(), exact.end(), id) == exact.end())
      the_case = without_effect(the_case, id);
  const auto problem =
      std::make_shared<const Problem>(the_case, state.context.model_with(exact, the_case.links));
  FittedModel fitted =
      fit_model(problem, transfer(*model.problem, model.x, *problem), state.found.noise,
                state.context.least_squares, state.context.stop);
  return fitted.ok ? fitted : model;
}

bool gap_left(const Stage& stage) { return stage.fit.present || stage.held_out.present; }

bool gap_left(const FittedModel& model, const std::vector<NoiseModel>& noise) {
  return fit_gap(model, noise).present || tested_held_out_gap(model, noise).present;
}

bool trace_left(const Stage& stage) {
  return stage.fit.autocorrelation > kThresholds.trace_significance &&
         stage.fit.misfit > kThresholds.trace_misfit * stage.fit.noise;
}

bool explained(DiagnosisState& state) {
  if (!gap_left(state.last())) return true;
  return !state.last().effects.empty() &&
         effects_close_gap(state, state.last().model, state.last().effects);
}

bool one_may_imitate_two(const Stage& last) { return last.effects.size() == 1 && trace_left(last); }

const Stage& last_without_effects(const std::vector<Stage>& stages) {
  const auto last = std::find_if(stages.rbegin(), stages.rend(),
                                 [](const Stage& stage) { return stage.effects.empty(); });
  return last == stages.rend() ? stages.front() : *last;
}

std::vector<std::string> standing_effects(const Diagnosis& found) {
  std::vector<std::string> stand;
  for (const EffectShare& share : found.shares.effects) {
    const bool predicts = !found.shares.has_held_out || share.held_out.least > 0;
    const double most = found.shares.has_held_out
                            ? std::max(share.fitted.least, share.held_out.least)
                            : share.fitted.least;
    if (predicts && share.fitted.least > 0 && most > kThresholds.worthwhile &&
        !needs_no_effect(found, share.effect))
      stand.push_back(share.effect);
  }
  return stand;
}

void conclude(DiagnosisState& state, const Case& asked) {
  Diagnosis& found = state.found;
  found.certain.clear();  // a discovery concludes twice
  state.context.begin("fitting the final model");
  const Stage& last = found.stages.back();
  found.final = last.model;
  make_final_model(found, asked, state.context);
  found.final_fit = fit_gap(found.final, found.noise);
  found.final_held_out = tested_held_out_gap(found.final, found.noise);
  found.parameters = final_parameters(found);
  found.shares = shares_of(state);
  const auto note = [&](const std::string& words) {  // a discovery concludes twice
    if (std::find(found.notes.begin(), found.notes.end(), words) == found.notes.end())
      found.notes.push_back(words);
  };
  const auto same = names_of_same_models(state.context.library(),
                                         state.context.model_with_all(found.stages.back().links));
  for (const auto& [other, name] : same)
    if (std::find(found.effects.begin(), found.effects.end(), name) != found.effects.end())
      note(fmt::format("{} is the same model as {} here", other, name));
  for (const std::string& words : noise_in_words(*found.final.problem, found.noise))
    note("noise of " + words);

  const bool is_closed =
      !found.effects.empty() && effects_close_gap(state, found.final, found.effects);
  // Beside a gap an effect has to be worth something of the whole misfit; where the gap is closed,
  // of its own part.
  const auto errors_could_explain = [&](const std::string& id) {
    if (is_error_of_known(*state.context.find(id))) return false;
    const BeyondErrorsOfKnowns beyond = beyond_errors_of_knowns(state, id);
    if ((is_closed ? beyond.of_effect : beyond.of_misfit) > kThresholds.worthwhile) return false;
    note(
        fmt::format("plausible errors of what the case states and of the sensors could explain "
                    "most of what {} does",
                    id));
    return true;
  };
  if (found.effects.empty() && (!gap_left(last) || too_small_to_name(found))) {
    found.verdict = DiagnosisVerdict::kNone;
    found.sentence = sentence_of_none(found);
    return;
  }
  if (!is_closed) {
    std::vector<std::string> stand = standing_effects(found);
    std::erase_if(stand, errors_could_explain);
    for (const std::string& id : stand)
      if (with_rivals(found, id) == id) found.certain.push_back(id);
    if (std::find(found.certain.begin(), found.certain.end(), found.law) != found.certain.end()) {
      found.verdict = DiagnosisVerdict::kDiscovered;
      found.sentence = sentence_of_law(found, false) + wrong_knowns_in_words(state);
      return;
    }
    found.verdict = stand.empty() ? DiagnosisVerdict::kUnexplained : DiagnosisVerdict::kPartly;
    found.sentence = stand.empty()
                         ? sentence_of_unexplained(found, state.options)
                         : sentence_of_partly(found, stand) + wrong_knowns_in_words(state);
    return;
  }
  std::erase_if(found.alternatives, [&](const Alternative& alternative) {
    if (!alternative.explanation.is_effect()) return true;
    std::vector<std::string> effects = found.effects;
    std::replace(effects.begin(), effects.end(), alternative.instead_of,
                 alternative.explanation.id);
    return !effects_close_gap(state, alternative.explanation.model, effects);
  });
  std::vector<std::string> doubtful;
  std::copy_if(found.effects.begin(), found.effects.end(), std::back_inserter(doubtful),
               errors_could_explain);
  const bool decided = found.alternatives.empty() && doubtful.empty();
  found.verdict = decided ? DiagnosisVerdict::kNamed : DiagnosisVerdict::kAmbiguous;
  if (decided) found.certain = found.effects;
  if (!found.law.empty()) found.verdict = DiagnosisVerdict::kDiscovered;
  found.sentence =
      (found.law.empty() ? sentence_of_effects(found, doubtful) : sentence_of_law(found, true)) +
      wrong_knowns_in_words(state);
}

void doubt_effects(DiagnosisState& state, const std::string& force) {
  Diagnosis& found = state.found;
  found.certain.clear();
  found.verdict = DiagnosisVerdict::kUnexplained;
  found.sentence = fmt::format("{} Without {}, a force of no known form does as well: {}.",
                               sentence_of_unexplained(found, state.options),
                               found.effects.size() > 1 ? "them" : "it", force);
}

void add_force_as_rival(DiagnosisState& state, const std::string& force) {
  Diagnosis& found = state.found;
  found.certain.clear();
  found.verdict = DiagnosisVerdict::kAmbiguous;
  found.sentence +=
      fmt::format(" These data do not decide against a force of no known form instead: {}.", force);
}

const char* name_of(DiagnosisVerdict verdict) {
  switch (verdict) {
    case DiagnosisVerdict::kNone:
      return "none";
    case DiagnosisVerdict::kNamed:
      return "named";
    case DiagnosisVerdict::kAmbiguous:
      return "ambiguous";
    case DiagnosisVerdict::kPartly:
      return "partly";
    case DiagnosisVerdict::kDiscovered:
      return "discovered";
    case DiagnosisVerdict::kUnexplained:
      return "unexplained";
  }
  return "";
}

}  // namespace catena
