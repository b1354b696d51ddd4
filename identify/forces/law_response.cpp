// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/law_response.hpp"

#include <utility>

#include "linear_algebra/decompositions.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// rad, rad/s: prior of the state at the beginning of the second part, relative to the motion found.
constexpr double kSplitDeviation = 0.2;

/// Rows of what is seen from node `first` on, before node `last`.
struct SeenOfLaw {
  MatrixXd by_parameter, by_start, by_force;
  VectorXd value;  ///< measured, less what the path gives without any force
};

/// A force that goes straight from w at the beginning of a step to w at its end.
struct StepForces {
  MatrixXd now, next;  // states x patterns: what the end of the step takes from w at both ends
  explicit StepForces(const LinearRecording::Step& step)
      : now(step.by_force.rows(), step.by_force.cols() / 2), next(now.rows(), now.cols()) {
    for (Index m = 0; m < now.cols(); ++m) {
      next.col(m) = step.by_force.col(2 * m + 1) / step.duration;
      now.col(m) = step.by_force.col(2 * m) - next.col(m);
    }
  }
  /// What makes y' of the y' without it, where the force at the end is d y': y' = moved + next d y',
  /// d patterns x states, so y' = (1 + next (1 - d next)^-1 d) moved.
  MatrixXd feedback(const MatrixXd& d) const {
    const MatrixXd small = MatrixXd::Identity(d.rows(), d.rows()) - d * next;
    return MatrixXd::Identity(next.rows(), next.rows()) + next * (inverse(small) * d);
  }
};

/// The response of the linearised chain to parameters, to the state at node `first` and to forces
/// there. At node 0 the state comes from the parameters.
SeenOfLaw law_response(const LinearRecording& recording, std::size_t first, std::size_t last,
                       const NodeForces& forces) {
  const Index states = recording.start_offset.size();
  const Index parameters = recording.start_by_parameter.cols(), free = first > 0 ? states : 0;
  const Index columns = forces.columns.front().cols(), all = parameters + free + columns + 1;
  Index rows = 0;
  for (std::size_t k = first; k < last; ++k) rows += recording.seen[k].value.size();
  SeenOfLaw out{MatrixXd(rows, parameters), MatrixXd(rows, free), MatrixXd(rows, columns),
                VectorXd(rows)};
  MatrixXd y = MatrixXd::Zero(states, all);
  if (first == 0) {
    y.leftCols(parameters) = recording.start_by_parameter;
    y.rightCols(1) = recording.start_offset;
  } else {
    y.middleCols(parameters, free).setIdentity();
  }
  const bool closed = !forces.by_state.empty();
  Index row = 0;
  for (std::size_t k = first; k < last; ++k) {
    const LinearRecording::Seen& seen = recording.seen[k];
    const Index count = seen.value.size();
    MatrixXd now(count, all);
    now.noalias() = seen.by_state * y;
    now.leftCols(parameters) += seen.by_parameter;
    out.by_parameter.middleRows(row, count) = now.leftCols(parameters);
    out.by_start.middleRows(row, count) = now.middleCols(parameters, free);
    out.by_force.middleRows(row, count) = now.middleCols(parameters + free, columns);
    out.value.segment(row, count) = seen.value - now.rightCols(1);
    row += count;
    if (k + 1 == last) break;
    const LinearRecording::Step& step = recording.steps[k];
    const StepForces by(step);
    MatrixXd moved(states, all);
    moved.noalias() = step.by_state * y;
    moved.leftCols(parameters) += step.by_parameter;
    moved.middleCols(parameters + free, columns) +=
        by.now * forces.columns[k] + by.next * forces.columns[k + 1];
    moved.rightCols(1) += step.offset;
    if (closed) {
      moved += by.now * (forces.by_state[k] * y);
      moved = by.feedback(forces.by_state[k + 1]) * moved;
    }
    y = std::move(moved);
  }
  return out;
}

}  // namespace

LawPart law_part(const LinearProblem& linear, const std::vector<NodeForces>& forces,
                 FrameHalf half) {
  std::vector<SeenOfLaw> responses;
  Index rows = 0, unknowns = linear.shared_mean.size();
  const Index shared = unknowns, columns = forces.front().columns.front().cols();
  for (std::size_t r = 0; r < linear.recordings.size(); ++r) {
    const LinearRecording& recording = linear.recordings[r];
    const std::size_t nodes = recording.seen.size(), middle = nodes / 2;
    responses.push_back(law_response(recording, half == FrameHalf::kSecond ? middle : 0,
                                     half == FrameHalf::kFirst ? middle : nodes, forces[r]));
    rows += responses.back().value.size();
    unknowns += recording.own_mean.size() + responses.back().by_start.cols();
  }
  LawPart part;
  part.seen = rows;
  part.nuisance.setZero(rows + unknowns, unknowns);
  part.forces.setZero(rows + unknowns, columns);
  part.value.setZero(rows + unknowns);
  const auto prior = [&](Index column, const VectorXd& mean, const VectorXd& deviation) {
    for (Index j = 0; j < mean.size(); ++j) {
      part.nuisance(rows + column + j, column + j) = 1 / deviation[j];
      part.value[rows + column + j] = mean[j] / deviation[j];
    }
  };
  prior(0, linear.shared_mean, linear.shared_deviation);
  Index row = 0, column = shared;
  for (std::size_t r = 0; r < responses.size(); ++r) {
    const SeenOfLaw& seen = responses[r];
    const Index count = seen.value.size(), free = seen.by_start.cols();
    const Index own = linear.recordings[r].own_mean.size();
    part.nuisance.block(row, 0, count, shared) = seen.by_parameter.leftCols(shared);
    part.nuisance.block(row, column, count, own) = seen.by_parameter.rightCols(own);
    part.nuisance.block(row, column + own, count, free) = seen.by_start;
    part.forces.middleRows(row, count) = seen.by_force;
    part.value.segment(row, count) = seen.value;
    prior(column, linear.recordings[r].own_mean, linear.recordings[r].own_deviation);
    prior(column + own, VectorXd::Zero(free), VectorXd::Constant(free, kSplitDeviation));
    row += count;
    column += own + free;
  }
  return part;
}

LinearProblem with_law(const LinearProblem& linear, const std::vector<NodeForces>& forces,
                       const VectorXd& deviation) {
  LinearProblem out = linear;
  const Index shared = linear.shared_mean.size(), terms = deviation.size();
  out.shared_mean.conservativeResizeLike(VectorXd::Zero(shared + terms));
  out.shared_deviation.conservativeResize(shared + terms);
  out.shared_deviation.tail(terms) = deviation;
  const auto with_columns = [&](const MatrixXd& by_parameter, const MatrixXd& columns) {
    MatrixXd wider(by_parameter.rows(), by_parameter.cols() + terms);
    wider << by_parameter.leftCols(shared), columns,
        by_parameter.rightCols(by_parameter.cols() - shared);
    return wider;
  };
  for (std::size_t r = 0; r < out.recordings.size(); ++r) {
    LinearRecording& recording = out.recordings[r];
    const NodeForces& of = forces[r];
    recording.start_by_parameter = with_columns(
        recording.start_by_parameter, MatrixXd::Zero(recording.start_by_parameter.rows(), terms));
    for (LinearRecording::Seen& seen : recording.seen)
      seen.by_parameter =
          with_columns(seen.by_parameter, MatrixXd::Zero(seen.by_parameter.rows(), terms));
    for (std::size_t k = 0; k < recording.steps.size(); ++k) {
      LinearRecording::Step& step = recording.steps[k];
      const StepForces by(step);
      const MatrixXd feedback = by.feedback(of.by_state[k + 1]);
      step.by_state = feedback * (step.by_state + by.now * of.by_state[k]);
      step.by_parameter =
          feedback *
          with_columns(step.by_parameter, by.now * of.columns[k] + by.next * of.columns[k + 1]);
      step.offset = feedback * step.offset;
    }
  }
  return out;
}

MatrixXd without_nuisance(const LawPart& part, const MatrixXd& columns) {
  const MatrixXd basis = orthonormal_basis(part.nuisance, 1e-12);
  return columns - basis * (basis.transpose() * columns);
}

}  // namespace catena
