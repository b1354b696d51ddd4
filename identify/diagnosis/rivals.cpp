// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/rivals.hpp"

#include <algorithm>
#include <cmath>

#include "identify/diagnosis/score.hpp"
#include "identify/diagnosis/variant.hpp"
#include "identify/problem/evaluation.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kWorthARefit = 0.15;  // predicted change over misfit
constexpr double kWorthTaking = 0.05;  // of the squared misfit
constexpr double kCertain = -3;        // log10 of the probability that it is chance

}  // namespace

MatrixXd fitted_jacobian(const FittedModel& model, const std::vector<double>& floors) {
  const Evaluation evaluation = evaluate(*model.problem, model.x, false, true);
  const std::size_t unknowns = model.problem->unknowns().size();
  MatrixXd jacobian;
  for (std::size_t j = 0; j < unknowns; ++j) {
    std::vector<MatrixXd> derivative(model.fit_residual.size());
    for (std::size_t e = 0; e < derivative.size(); ++e)
      if (model.fit_residual[e].cols() > 0 && evaluation.predictions[e].ok())
        derivative[e] = evaluation.predictions[e].sensitivity[j];
    const VectorXd column = stacked(derivative, model.fit_residual, floors);
    if (jacobian.size() == 0) jacobian.resize(column.size(), static_cast<Index>(unknowns));
    jacobian.col(static_cast<Index>(j)) = column;
  }
  return jacobian;
}

FinerChain try_finer_chain(const FittedModel& model, const std::vector<std::string>& effects,
                           const std::vector<double>& floors, int max_links, Workshop& workshop) {
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
      std::make_shared<const Problem>(*larger, workshop.model_with(effects, finer.links));
  const VectorXd start = transfer(*model.problem, model.x, *problem);

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
  const ScoreTest test(stacked(model.fit_residual, model.fit_residual, floors),
                       fitted_jacobian(model, floors));
  const VectorXd left = test.project(stacked(change, model.fit_residual, floors));
  const GapTest gap = fit_gap(model, floors);
  finer.predicted = gap.floor * left.norm() / std::sqrt(static_cast<double>(left.size()));
  if (finer.predicted < kWorthARefit * gap.misfit) {
    finer.note = "the finer chain would change the prediction by a small part of the misfit only";
    return finer;
  }
  workshop.say("refitting with " + std::to_string(finer.links) + " links");
  finer.model = fit_model(problem, start, workshop.least_squares, workshop.stop);
  if (!finer.model.ok) {
    finer.note = "the refit failed: " + finer.model.message;
    return finer;
  }
  finer.refitted = true;
  finer.comparison = compare(model, finer.model, floors);
  finer.taken = finer.comparison.misfit_share > kWorthTaking && finer.comparison.log10_p < kCertain;
  if (!finer.taken) finer.note = "refitted, and no better";
  return finer;
}

FittedModel refitted_with_links(const FittedModel& model, int links,
                                const std::vector<std::string>& effects, Workshop& workshop) {
  std::string why_not;
  const std::optional<Case> other = with_links(model.problem->the_case(), links, why_not);
  if (!other) return {};
  const auto problem = std::make_shared<const Problem>(*other, workshop.model_with(effects, links));
  workshop.say("refitting with " + std::to_string(links) + " links");
  return fit_model(problem, transfer(*model.problem, model.x, *problem), workshop.least_squares,
                   workshop.stop);
}

}  // namespace catena
