// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/law_response.hpp"

#include <utility>
#include <vector>

#include "linear_algebra/decompositions.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// rad, rad/s: prior of the state at the beginning of the second part, relative to the motion found.
constexpr double kSplitDeviation = 0.2;

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
  /// Adds to `moved`, the y' of some columns without it, a force that follows the state y: `here` y at the beginning and
  /// `there` y' at the end, patterns x states. y' = moved + now here y + next there y'. Only the turns on which the
  /// force acts count: a law in one joint acts on two.
  void follow(const MatrixXd& here, const MatrixXd& there, const MatrixXd& y,
              MatrixXd& moved) const {
    const std::vector<Index> first = turns_that_act(here), last = turns_that_act(there);
    if (!first.empty()) moved += now(Eigen::all, first) * (here(first, Eigen::all) * y).eval();
    if (last.empty()) return;
    const MatrixXd by_state = there(last, Eigen::all), by_force = next(Eigen::all, last);
    const auto count = static_cast<Index>(last.size());
    const MatrixXd small = MatrixXd::Identity(count, count) - by_state * by_force;
    const MatrixXd force = inverse(small) * (by_state * moved);
    moved += by_force * force;
  }

 private:
  static std::vector<Index> turns_that_act(const MatrixXd& by_state) {
    std::vector<Index> turns;
    for (Index i = 0; i < by_state.rows(); ++i)
      if ((by_state.row(i).array() != 0).any()) turns.push_back(i);
    return turns;
  }
};

/// Where the response of one recording goes in the whole problem: its first row and the first column of its own unknowns.
struct Block {
  Index row, column;
};

/// The nodes of a recording that a part has.
struct Nodes {
  std::size_t first, last;  ///< `last` is the first one beyond it
  Nodes(const LinearRecording& recording, FrameHalf half)
      : first(half == FrameHalf::kSecond ? recording.seen.size() / 2 : 0),
        last(half == FrameHalf::kFirst ? recording.seen.size() / 2 : recording.seen.size()) {}
  /// Coordinates of the state at the first of them, where it is an unknown. At node 0 it comes from the parameters.
  Index free(const LinearRecording& recording) const {
    return first > 0 ? recording.start_offset.size() : 0;
  }
};

/// Writes the response of the linearised chain to parameters, to the state at the first node and to forces into rows of
/// what is seen. `shared`: so many of the parameters are those of all recordings.
void add_response(const LinearRecording& recording, const Nodes& nodes, const NodeForces& forces,
                  Index shared, const Block& block, LawPart& part) {
  const Index states = recording.start_offset.size();
  const Index parameters = recording.start_by_parameter.cols(), free = nodes.free(recording);
  const Index unknowns = parameters + free, columns = part.forces.cols();
  MatrixXd y = MatrixXd::Zero(states, unknowns + columns + 1);
  if (free == 0) {
    y.leftCols(parameters) = recording.start_by_parameter;
    y.rightCols(1) = recording.start_offset;
  } else {
    y.middleCols(parameters, free).setIdentity();
  }
  const bool closed = !forces.by_state.empty();
  Index row = block.row;
  for (std::size_t k = nodes.first; k < nodes.last; ++k) {
    const LinearRecording::Seen& seen = recording.seen[k];
    const Index count = seen.value.size();
    MatrixXd now(count, y.cols());
    now.noalias() = seen.by_state * y;
    now.leftCols(parameters) += seen.by_parameter;
    part.nuisance.block(row, 0, count, shared) = now.leftCols(shared);
    part.nuisance.block(row, block.column, count, unknowns - shared) =
        now.middleCols(shared, unknowns - shared);
    part.forces.middleRows(row, count) = now.middleCols(unknowns, columns);
    part.value.segment(row, count) = seen.value - now.rightCols(1);
    row += count;
    if (k + 1 == nodes.last) break;
    const LinearRecording::Step& step = recording.steps[k];
    const StepForces by(step);
    MatrixXd moved(states, y.cols());
    moved.noalias() = step.by_state * y;
    moved.leftCols(parameters) += step.by_parameter;
    moved.middleCols(unknowns, columns) +=
        by.now * forces.columns[k] + by.next * forces.columns[k + 1];
    moved.rightCols(1) += step.offset;
    if (closed) by.follow(forces.by_state[k], forces.by_state[k + 1], y, moved);
    y = std::move(moved);
  }
}

}  // namespace

LawPart law_part(const LinearProblem& linear, const std::vector<NodeForces>& forces,
                 FrameHalf half) {
  const Index shared = linear.shared_mean.size();
  Index rows = 0, unknowns = shared;
  for (const LinearRecording& recording : linear.recordings) {
    const Nodes nodes(recording, half);
    for (std::size_t k = nodes.first; k < nodes.last; ++k) rows += recording.seen[k].value.size();
    unknowns += recording.own_mean.size() + nodes.free(recording);
  }
  LawPart part;
  part.seen = rows;
  part.nuisance.setZero(rows + unknowns, unknowns);
  part.forces.resize(rows + unknowns, forces.front().columns.front().cols());
  part.forces.bottomRows(unknowns).setZero();
  part.value.setZero(rows + unknowns);
  const auto prior = [&](Index column, const VectorXd& mean, const VectorXd& deviation) {
    for (Index j = 0; j < mean.size(); ++j) {
      part.nuisance(rows + column + j, column + j) = 1 / deviation[j];
      part.value[rows + column + j] = mean[j] / deviation[j];
    }
  };
  prior(0, linear.shared_mean, linear.shared_deviation);
  Block block{0, shared};
  for (std::size_t r = 0; r < linear.recordings.size(); ++r) {
    const LinearRecording& recording = linear.recordings[r];
    const Nodes nodes(recording, half);
    add_response(recording, nodes, forces[r], shared, block, part);
    for (std::size_t k = nodes.first; k < nodes.last; ++k)
      block.row += recording.seen[k].value.size();
    const Index free = nodes.free(recording);
    prior(block.column, recording.own_mean, recording.own_deviation);
    block.column += recording.own_mean.size();
    prior(block.column, VectorXd::Zero(free), VectorXd::Constant(free, kSplitDeviation));
    block.column += free;
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
      const MatrixXd by_parameter =
          with_columns(step.by_parameter, by.now * of.columns[k] + by.next * of.columns[k + 1]);
      // All that moves the end, in columns: the state at the beginning, the parameters, nothing.
      const Index states = step.by_state.rows();
      MatrixXd moved(states, states + by_parameter.cols() + 1);
      moved << step.by_state, by_parameter, step.offset;
      MatrixXd y = MatrixXd::Zero(states, moved.cols());
      y.leftCols(states).setIdentity();
      by.follow(of.by_state[k], of.by_state[k + 1], y, moved);
      step.by_state = moved.leftCols(states);
      step.by_parameter = moved.middleCols(states, by_parameter.cols());
      step.offset = moved.rightCols(1);
    }
  }
  return out;
}

MatrixXd without_nuisance(const LawPart& part, MatrixXd columns) {
  const MatrixXd basis = orthonormal_basis(part.nuisance, 1e-12);
  const MatrixXd along = basis.transpose() * columns;
  columns.noalias() -= basis * along;
  return columns;
}

}  // namespace catena
