// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/telling_experiment.hpp"

#include <fmt/format.h>

#include <cmath>

#include "identify/problem/prediction.hpp"
#include "runtime/positions.hpp"
#include "runtime/simulation.hpp"

namespace catena {

TellingExperiment telling_experiment(const FittedModel& a, const FittedModel& b,
                                     const std::vector<double>& sigmas) {
  TellingExperiment best;
  std::size_t e = 0;
  while (e + 1 < a.fit_residual.size() && a.fit_residual[e].cols() == 0) ++e;
  const int index = static_cast<int>(e);
  const Experiment& experiment = a.problem->experiments()[e];
  const double span = experiment.recording.time.back() - experiment.recording.time.front();
  struct Start {
    double factor;
    const char* words;
  };
  for (const Start start :
       {Start{1, "the same start"}, Start{0.5, "a start at half the angles"},
        Start{1.5, "a start at one and a half times the angles"}, Start{-1, "the mirrored start"}})
    for (const double length : {1.0, 2.0}) {
      std::vector<double> times;
      for (int k = 0; k <= 200; ++k)
        times.push_back(experiment.spec.start + length * span * k / 200);
      Simulation motions[2];
      bool ok = true;
      for (int m = 0; m < 2; ++m) {
        const FittedModel& model = m ? b : a;
        State state = model.problem->initial_state(model.x, index);
        state.q.head(model.problem->model().links()) *= start.factor;
        state.v *= start.factor;
        SimulationOptions options = simulation_options(model.problem->the_case().simulation);
        options.energy = false;
        motions[m] =
            simulate(model.problem->model(), model.problem->model_parameters(model.x, index), state,
                     times, options, experiment.signals);
        ok = ok && motions[m].status == Status::kSuccess;
      }
      if (!ok) continue;
      const int links = a.problem->model().links();
      Eigen::VectorXd sums = Eigen::VectorXd::Zero(links + 2);
      for (std::size_t k = 0; k < times.size(); ++k) {
        Positions at[2];
        for (int m = 0; m < 2; ++m) {
          const FittedModel& model = m ? b : a;
          at[m] = positions(model.problem->model(), model.problem->model_parameters(model.x, index),
                            times[k], motions[m].trajectory.q.col(static_cast<Eigen::Index>(k)),
                            experiment.signals);
        }
        sums += ((at[0].side - at[1].side).array().square() +
                 (at[0].down - at[1].down).array().square())
                    .matrix() /
                (2.0 * static_cast<double>(times.size()));
      }
      Eigen::Index point = 0;
      const double difference = std::sqrt(sums.maxCoeff(&point)) / sigmas[e];
      if (difference <= best.difference) continue;
      best.difference = difference;
      best.words = fmt::format(
          "{}, filmed for {:.3g} s, looking at {}", start.words, length * span,
          point > links ? std::string("the load") : fmt::format("the end of link {}", point));
    }
  return best;
}

}  // namespace catena
