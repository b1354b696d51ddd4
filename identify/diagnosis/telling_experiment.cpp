// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/telling_experiment.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "common/impossible_value.hpp"
#include "identify/problem/prediction.hpp"
#include "runtime/held_end.hpp"
#include "runtime/positions.hpp"
#include "runtime/simulation.hpp"

namespace catena {
namespace {

using Eigen::Vector3d;

/// Every link at `factor` times its angle from the downward vertical, and `factor` times its rate.
State scaled(const Model& model, State state, double factor) {
  const Eigen::Index links = model.links();
  state.v *= factor;
  if (!model.in_space()) {
    state.q.head(links) *= factor;
    return state;
  }
  for (Eigen::Index i = 0; i < links; ++i) {
    const auto components = Eigen::seqN(i, Eigen::fix<3>, links);
    const Vector3d direction = state.q(components).normalized(), rate = state.v(components);
    const Vector3d axis = Vector3d::UnitY().cross(direction);  // from down to the link
    if (axis.isZero()) continue;
    const double angle = std::atan2(axis.norm(), direction.y());
    const Eigen::AngleAxisd turn((factor - 1) * angle, axis.normalized());
    state.q(components) = turn * direction;
    state.v(components) = turn * rate;
  }
  return state;
}

/// Per point, the sum of the squares of all components.
Eigen::VectorXd squared_distances(const Positions& a, const Positions& b) {
  Eigen::VectorXd squares = (a.side - b.side).array().square() + (a.down - b.down).array().square();
  if (a.across.size() > 0) squares += (a.across - b.across).cwiseAbs2();
  return squares;
}

}  // namespace

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
        const Model& chain = model.problem->model();
        const Eigen::VectorXd parameters = model.problem->model_parameters(model.x, index);
        State state = scaled(chain, model.problem->initial_state(model.x, index), start.factor);
        try {
          if (chain.held())
            state = closed_end(chain, parameters, state, times.front(), experiment.signals);
        } catch (const ImpossibleValue&) {  // not a start between these ends
          ok = false;
          break;
        }
        SimulationOptions options = simulation_options(model.problem->the_case().simulation);
        options.energy = false;
        motions[m] = simulate(chain, parameters, state, times, options, experiment.signals);
        ok = ok && motions[m].status == Status::kSuccess;
      }
      if (!ok) continue;
      const int links = a.problem->model().links();
      const double components = a.problem->model().in_space() ? 3 : 2;
      Eigen::VectorXd sums = Eigen::VectorXd::Zero(links + 2);
      for (std::size_t k = 0; k < times.size(); ++k) {
        Positions at[2];
        for (int m = 0; m < 2; ++m) {
          const FittedModel& model = m ? b : a;
          at[m] = positions(model.problem->model(), model.problem->model_parameters(model.x, index),
                            times[k], motions[m].trajectory.q.col(static_cast<Eigen::Index>(k)),
                            experiment.signals);
        }
        sums += squared_distances(at[0], at[1]) / (components * static_cast<double>(times.size()));
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
