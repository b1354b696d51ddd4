// SPDX-License-Identifier: BSD-3-Clause
#include "identify/problem/evaluation.hpp"

#include "common/impossible_value.hpp"

namespace catena {

Evaluation evaluate(const Problem& problem, const Eigen::VectorXd& x, bool all, bool jacobian,
                    const std::function<bool(double)>& keep_going) {
  Evaluation evaluation;
  evaluation.x = x;
  evaluation.with_jacobian = jacobian;
  evaluation.ok = true;
  evaluation.predictions.resize(problem.experiments().size());
  for (std::size_t e = 0; e < problem.experiments().size(); ++e) {
    const Experiment& experiment = problem.experiments()[e];
    if (!all && !experiment.fitted()) continue;
    const int index = static_cast<int>(e);
    Prediction& prediction = evaluation.predictions[e];
    try {
      const auto along =
          jacobian ? problem.directions(x, index) : std::vector<SensitivityDirection>{};
      prediction = problem.predict(x, index, all, along, keep_going);
    } catch (const ImpossibleValue& error) {
      prediction = failed_prediction(experiment, error.what());
    }
    if (prediction.ok()) continue;
    evaluation.ok = false;
    evaluation.message = experiment.spec.name + ": " + prediction.message;
    if (!all) break;
  }
  return evaluation;
}

}  // namespace catena
