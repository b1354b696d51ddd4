// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/errors_of_knowns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "identify/diagnosis/diagnosis_state.hpp"
#include "identify/diagnosis/errors_of_markers.hpp"
#include "identify/diagnosis/shares.hpp"
#include "identify/diagnosis/thresholds.hpp"
#include "identify/diagnosis/variant.hpp"
#include "identify/problem/evaluation.hpp"
#include "linear_algebra/decompositions.hpp"

namespace catena {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Values where something was measured, in noise levels, one experiment after the other: those that
/// were fitted, then those that were held out.
struct Stacked {
  VectorXd fitted, held_out;
};

Stacked stacked_in_levels(const Frames& frames, const FittedModel& model,
                          const std::vector<NoiseModel>& noise) {
  std::vector<double> fitted, held_out;
  for (std::size_t e = 0; e < frames.size(); ++e) {
    const Recording& recording = model.problem->experiments()[e].recording;
    const Index first = model.problem->experiments()[e].fitted() ? recording.fit_frames : 0;
    for (Index k = 0; k < recording.measured.cols(); ++k)
      for (Index c = 0; c < recording.measured.rows(); ++c)
        if (!std::isnan(recording.measured(c, k)))
          (k < first ? fitted : held_out)
              .push_back(frames[e].size() ? frames[e](c, k) / noise[e].level : 0.0);
  }
  const auto vector = [](const std::vector<double>& values) {
    return VectorXd(Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size())));
  };
  return {vector(fitted), vector(held_out)};
}

/// Simulated minus measured; anything where nothing was measured.
Stacked residuals(const FittedModel& model, const std::vector<NoiseModel>& noise) {
  Frames frames(model.predicted.size());
  for (std::size_t e = 0; e < frames.size(); ++e)
    frames[e] = model.predicted[e] - model.problem->experiments()[e].recording.measured;
  return stacked_in_levels(frames, model, noise);
}

/// One number for each part.
struct Parts {
  double fitted = 0, held_out = 0;
};

/// The standard deviation of an error of this unit; none: it is no error of a known.
double plausible(const std::string& unit, const Case& the_case) {
  const PlausibleErrors& errors = kThresholds.errors_of_knowns;
  if (unit == "rad") return errors.angle;
  if (unit == "m") return errors.place;
  if (unit == "s") return errors.time;
  if (unit == "kg") return errors.mass * the_case.cable.load_mass;
  if (unit == "1/m") return errors.turn / the_case.cable.whole_length();
  return errors.ratio;
}

/// A free parameter that the model has anyway.
ParameterSpec freed(const std::string& sets, double value, const std::string& unit) {
  ParameterSpec spec;
  spec.name = spec.sets = sets;
  spec.value = value;
  spec.unit = unit;
  spec.lower = 0.5 * value;
  spec.upper = 2 * value;
  spec.free = true;
  spec.scale = Scale::kLinear;
  return spec;
}

/// Frees where cameras stand and look, and what their lenses are, as far as the case has them fixed.
void doubt_cameras(Case& the_case, const Model& model, std::map<std::string, double>& deviation) {
  for (const CameraSpec& camera : the_case.cameras)
    for (int k = 0; k < model.table().parameters; ++k) {
      const catena_parameter& parameter = model.table().parameter[k];
      const std::string sets = parameter.name;
      if (!sets.starts_with(camera.name + ".")) continue;
      auto spec = std::find_if(the_case.parameters.begin(), the_case.parameters.end(),
                               [&](const ParameterSpec& each) { return each.sets == sets; });
      if (spec != the_case.parameters.end() && (spec->free || spec->per_experiment)) continue;
      if (spec == the_case.parameters.end()) {
        the_case.parameters.emplace_back();
        spec = the_case.parameters.end() - 1;
        spec->name = spec->sets = sets;
        spec->unit = parameter.unit;
        spec->value = parameter.default_value;
      }
      spec->free = true;
      spec->scale = Scale::kLinear;
      spec->lower = parameter.lower / spec->factor;
      spec->upper = parameter.upper / spec->factor;
      const bool relative = sets.ends_with(".focal_length");
      deviation[spec->name] =
          plausible(parameter.unit, the_case) * (relative ? spec->value : 1 / spec->factor);
    }
}

/// The case with everything free that may be wrong and changes the motion or has an effect of its
/// own, and the standard deviations of these parameters by their names. `effects`: of the model.
Case with_doubts(const DiagnosisState& state, const FittedModel& model,
                 const std::vector<std::string>& effects,
                 std::map<std::string, double>& deviation) {
  const Case& the_case = model.problem->the_case();
  std::vector<Candidate> errors;
  for (const Candidate& candidate : state.context.library()) {
    const bool there = std::find(effects.begin(), effects.end(), candidate.id) != effects.end();
    // What markers get wrong, errors_of_markers() says.
    if (there || !candidate.unavailable.empty() || candidate.own_model || candidate.of_case ||
        !is_error_of_known(candidate))
      continue;
    errors.push_back(candidate);
    for (const int p : candidate.with_role(ParameterRole::kAmplitude)) {
      const CandidateParameter& parameter = candidate.parameters[static_cast<std::size_t>(p)];
      deviation[parameter.name] = plausible(parameter.unit, the_case);
    }
  }
  Case doubtful = with_effects(the_case, errors, false);
  const CableGeometry& cable = the_case.cable;
  const auto free = [&](const std::string& sets, double value, const std::string& unit,
                        double share) {
    for (const ParameterSpec& known : the_case.parameters)
      if (known.sets == sets) return;
    doubtful.parameters.push_back(freed(sets, value, unit));
    deviation[sets] = share * value;
  };
  const PlausibleErrors& plausibly = kThresholds.errors_of_knowns;
  if (cable.link_lengths.empty()) free("cable.length", cable.length, "m", plausibly.length);
  if (cable.link_masses.empty() && cable.density > 0)
    free("cable.density", cable.density, "kg/m", plausibly.mass);
  doubt_cameras(doubtful, model.problem->model(), deviation);
  return doubtful;
}

/// The least sum of squares, in noise levels, that the model leaves with plausible errors of what is
/// known: linearised, everything fitted again to the fitted part, priors counted there. Infinite
/// where it cannot be simulated.
Parts squares_with_errors(const DiagnosisState& state, const FittedModel& model,
                          const std::vector<std::string>& effects) {
  std::map<std::string, double> deviation;
  const Case doubtful = with_doubts(state, model, effects, deviation);
  std::vector<std::string> own_models;
  for (const std::string& id : effects)
    if (state.context.find(id)->own_model) own_models.push_back(id);
  const Problem problem(doubtful, state.context.model_with_all(doubtful.links, own_models),
                        model.problem->experiments());
  const Evaluation evaluation =
      evaluate(problem, transfer(*model.problem, model.x, problem), true, true);
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  if (!evaluation.ok) return {kInfinite, kInfinite};

  const std::vector<NoiseModel>& noise = state.found.noise;
  struct Column {
    Stacked values;
    bool prior;  // in units of its standard deviation
  };
  std::vector<Column> columns;
  for (std::size_t j = 0; j < problem.unknowns().size(); ++j) {
    Frames along(model.predicted.size());
    for (std::size_t e = 0; e < along.size(); ++e)
      along[e] = evaluation.predictions[e].sensitivity[j];
    Column column{stacked_in_levels(along, model, noise), false};
    const auto doubt = deviation.find(problem.unknowns()[j].name);
    column.prior = doubt != deviation.end();
    const double size = column.values.fitted.norm();
    const double unit = column.prior ? doubt->second : size > 0 ? 1 / size : 0.0;
    column.values.fitted *= unit;
    column.values.held_out *= unit;
    columns.push_back(std::move(column));
  }
  for (const Frames& frames : errors_of_markers(model))
    columns.push_back({stacked_in_levels(frames, model, noise), true});

  const Stacked r = residuals(model, noise);
  const auto count = static_cast<Index>(columns.size());
  MatrixXd matrix = MatrixXd::Zero(r.fitted.size() + count, count);
  MatrixXd later(r.held_out.size(), count);
  for (Index j = 0; j < count; ++j) {
    const Column& column = columns[static_cast<std::size_t>(j)];
    matrix.col(j).head(r.fitted.size()) = column.values.fitted;
    if (column.prior) matrix(r.fitted.size() + j, j) = 1;
    later.col(j) = column.values.held_out;
  }
  VectorXd right = VectorXd::Zero(matrix.rows());
  right.head(r.fitted.size()) = -r.fitted;
  const VectorXd change = least_squares(matrix, right);
  return {(matrix * change - right).squaredNorm(), (r.held_out + later * change).squaredNorm()};
}

}  // namespace

bool is_error_of_known(const Candidate& candidate) {
  return candidate.sensor ||
         std::any_of(candidate.effect.parameters.begin(), candidate.effect.parameters.end(),
                     [](const EffectParameter& parameter) { return !parameter.above.empty(); });
}

BeyondErrorsOfKnowns beyond_errors_of_knowns(DiagnosisState& state, const std::string& effect) {
  std::vector<std::string> others = state.found.effects;
  std::erase(others, effect);
  const FittedModel& whole = state.found.final;
  const FittedModel without = fit_with_effects(state, others), none = fit_with_effects(state, {});
  state.context.stop_if_asked();
  if (!without.ok || !none.ok) return {};
  const Stacked all = residuals(none, state.found.noise);
  const Stacked before = residuals(without, state.found.noise);
  const Stacked after = residuals(whole, state.found.noise);
  const Parts with = squares_with_errors(state, whole, state.found.effects);
  const Parts left = squares_with_errors(state, without, others);
  const auto share = [](double beyond, const VectorXd& residual) {
    const double misfit = residual.squaredNorm() - static_cast<double>(residual.size());
    return misfit > 0 && std::isfinite(beyond) ? beyond / misfit : 0.0;
  };
  const auto of_own = [](double beyond, const VectorXd& unexplained, const VectorXd& explained) {
    const double removed = unexplained.squaredNorm() - explained.squaredNorm();
    return removed > 0 && std::isfinite(beyond) ? beyond / removed : 0.0;
  };
  return {std::max({0.0, share(left.fitted - with.fitted, all.fitted),
                    share(left.held_out - with.held_out, all.held_out)}),
          std::max({0.0, of_own(left.fitted - with.fitted, before.fitted, after.fitted),
                    of_own(left.held_out - with.held_out, before.held_out, after.held_out)})};
}

double lead_beyond_errors_of_knowns(const DiagnosisState& state, const ModelWithEffects& better,
                                    const ModelWithEffects& worse) {
  const double left = squares_with_errors(state, better.model, better.effects).fitted;
  const double left_by_worse = squares_with_errors(state, worse.model, worse.effects).fitted;
  return std::isfinite(left_by_worse) ? left_by_worse - left : 0;
}

}  // namespace catena
