// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/links.hpp"

#include <algorithm>
#include <cmath>

#include "identify/diagnosis/refit_limits.hpp"
#include "identify/diagnosis/score.hpp"
#include "identify/diagnosis/thresholds.hpp"
#include "identify/diagnosis/variant.hpp"
#include "identify/problem/evaluation.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

bool acts_on_joints(const Effect& effect) {
  return std::any_of(effect.scalars.begin(), effect.scalars.end(),
                     [](const ScalarTerm& term) { return term.at == Place::kJoint; });
}

}  // namespace

VectorXd start_with_links(const FittedModel& model, const Problem& problem,
                          const std::vector<std::string>& effects,
                          const std::vector<NoiseModel>& noise, const DiagnosisContext& context) {
  const double ratio =
      static_cast<double>(problem.the_case().links) / model.problem->the_case().links;
  VectorXd best = transfer(*model.problem, model.x, problem);
  for (const std::string& id : effects) {
    const Candidate& candidate = *context.find(id);
    if (!acts_on_joints(candidate.effect)) continue;
    const VectorXd as_it_is = best;
    double least = error_to_fit(problem, as_it_is, noise, {});
    for (int power = 1; power <= 3; ++power) {
      VectorXd x = as_it_is;
      for (const int p : candidate.with_role(ParameterRole::kAmplitude)) {
        const CandidateParameter& parameter = candidate.parameters[static_cast<std::size_t>(p)];
        const Index j = unknown_index(problem, parameter.name);
        if (j < 0) continue;
        const Unknown& unknown = problem.unknowns()[static_cast<std::size_t>(j)];
        x[j] = std::clamp(parameter.neutral + std::pow(ratio, power) * (x[j] - parameter.neutral),
                          unknown.least, unknown.most);
      }
      const double error = error_to_fit(problem, x, noise, {});
      if (error >= least) continue;
      least = error;
      best = x;
    }
  }
  return best;
}

FinerChain try_finer_chain(const FittedModel& model, const std::vector<std::string>& effects,
                           const std::vector<NoiseModel>& noise, int max_links,
                           DiagnosisContext& context) {
  FinerChain finer;
  const Case& the_case = model.problem->the_case();
  finer.links = std::min(2 * the_case.links, std::max(max_links, the_case.links));
  if (finer.links <= the_case.links) {
    finer.note = "no more than " + std::to_string(max_links) + " links are allowed";
    return finer;
  }
  const std::optional<Case> larger = with_links(the_case, finer.links, finer.note);
  if (!larger) return finer;
  const auto problem =
      std::make_shared<const Problem>(*larger, context.model_with(effects, finer.links));
  const VectorXd start = start_with_links(model, *problem, effects, noise, context);

  std::vector<MatrixXd> change(model.fit_residual.size());
  for (std::size_t e = 0; e < change.size(); ++e) {
    const Index fitted = model.fit_residual[e].cols();
    if (fitted == 0) continue;
    const Prediction prediction = problem->predict(start, static_cast<int>(e), false);
    if (!prediction.ok()) {
      finer.note = "the finer chain could not be simulated: " + prediction.message;
      return finer;
    }
    change[e] = prediction.simulated - model.predicted[e].leftCols(fitted);
  }
  const ScoreTest test(stacked(model.fit_residual, model.fit_residual, noise),
                       fitted_jacobian(model, noise));
  const VectorXd left = test.project(stacked(change, model.fit_residual, noise));
  const GapTest gap = fit_gap(model, noise);
  finer.predicted = gap.noise * left.norm() / std::sqrt(static_cast<double>(left.size()));
  if (finer.predicted < kThresholds.links_worth_a_fit * gap.misfit) {
    finer.note = "the finer chain would change the prediction by a small part of the misfit only";
    return finer;
  }
  context.begin_task("refitting with " + std::to_string(finer.links) + " links");
  finer.model = fit_model(problem, start, noise, context.least_squares, context.stop);
  if (!finer.model.ok) {
    finer.note = "the refit failed: " + finer.model.message;
    return finer;
  }
  finer.refitted = true;
  finer.comparison = compare(model, finer.model, noise);
  finer.taken = finer.comparison.misfit_share > kThresholds.links_worthwhile &&
                finer.comparison.log10_p < -std::log10(kThresholds.odds);
  if (!finer.taken) finer.note = "refitted, and no better";
  return finer;
}

namespace {

FittedModel fitted_with_links(const FittedModel& model, int links,
                              const std::vector<std::string>& effects,
                              const std::vector<NoiseModel>& noise, DiagnosisContext& context,
                              const LeastSquares& least_squares) {
  std::string why_not;
  const std::optional<Case> other = with_links(model.problem->the_case(), links, why_not);
  if (!other) return {};
  const auto problem = std::make_shared<const Problem>(*other, context.model_with(effects, links));
  context.begin_task("refitting with " + std::to_string(links) + " links");
  return fit_model(problem, start_with_links(model, *problem, effects, noise, context), noise,
                   least_squares, context.stop);
}

}  // namespace

FittedModel refitted_with_links(const FittedModel& model, int links,
                                const std::vector<std::string>& effects,
                                const std::vector<NoiseModel>& noise, DiagnosisContext& context) {
  return fitted_with_links(model, links, effects, noise, context, context.least_squares);
}

FittedModel tried_with_links(const FittedModel& model, int links,
                             const std::vector<std::string>& effects,
                             const std::vector<NoiseModel>& noise, DiagnosisContext& context) {
  return fitted_with_links(model, links, effects, noise, context,
                           RefitLimits(model, noise).within(context.least_squares));
}

}  // namespace catena
