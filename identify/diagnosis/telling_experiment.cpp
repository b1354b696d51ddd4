// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/telling_experiment.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
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

/// How an experiment differs from the recorded one.
struct Change {
  double angles, load;  ///< factors of the angles of the start and of the mass of the load
  const char* words;
};
constexpr Change kChanges[] = {
    {1, 1, "the same start"},
    {0.5, 1, "a start at half the angles"},
    {1.5, 1, "a start at one and a half times the angles"},
    {-1, 1, "the mirrored start"},
    {1, 2, "the same start with twice the load"},
    {1, 0.5, "the same start with half the load"},
};

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
  constexpr int kFrames = 200;  // of the longest film; the other one is its first half
  // No one knows how signals go on after their end: then the film is as long as the recorded one.
  const Signals& signals = experiment.signals;
  const double end = experiment.spec.start + 2 * span;
  const bool ends = signals.count() > 0 && signals.last_time() < end;
  const int frames = ends ? kFrames / 2 : kFrames;
  std::vector<double> times;
  for (int k = 0; k <= frames; ++k) {
    const double time = experiment.spec.start + 2 * span * k / kFrames;
    times.push_back(ends ? std::min(time, signals.last_time()) : time);
  }
  const int links = a.problem->model().links();
  const double components = a.problem->model().in_space() ? 3 : 2;
  for (const Change& change : kChanges) {
    Simulation motions[2];
    Eigen::VectorXd parameters[2];
    bool ok = true;
    for (int m = 0; ok && m < 2; ++m) {
      const FittedModel& model = m ? b : a;
      const Model& chain = model.problem->model();
      parameters[m] = model.problem->model_parameters(model.x, index);
      double& load = parameters[m][chain.parameter_index("load_mass")];
      if (change.load != 1 && load == 0) ok = false;  // there is none
      load *= change.load;
      State state = scaled(chain, model.problem->initial_state(model.x, index), change.angles);
      try {
        if (chain.held())
          state = closed_end(chain, parameters[m], state, times.front(), experiment.signals);
      } catch (const ImpossibleValue&) {  // not a start between these ends
        ok = false;
      }
      if (!ok) break;
      SimulationOptions options = simulation_options(model.problem->the_case().simulation);
      options.energy = false;
      motions[m] = simulate(chain, parameters[m], state, times, options, experiment.signals);
      ok = motions[m].status == Status::kSuccess;
    }
    if (!ok) continue;
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(links + 2);
    for (int k = 0; k <= frames; ++k) {
      Positions at[2];
      for (int m = 0; m < 2; ++m)
        at[m] = positions((m ? b : a).problem->model(), parameters[m],
                          times[static_cast<std::size_t>(k)], motions[m].trajectory.q.col(k),
                          experiment.signals);
      sums += squared_distances(at[0], at[1]);
      if (k != kFrames / 2 && k != kFrames) continue;
      Eigen::Index point = 0;
      const double difference =
          std::sqrt(sums.maxCoeff(&point) / (components * (k + 1))) / sigmas[e];
      if (difference <= best.difference) continue;
      best.difference = difference;
      best.words = fmt::format(
          "{}, filmed for {:.3g} s, looking at {}", change.words, span * (k == kFrames ? 2 : 1),
          point > links ? std::string("the load") : fmt::format("the end of link {}", point));
    }
  }
  return best;
}

}  // namespace catena
