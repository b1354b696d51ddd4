// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/errors_of_markers.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <map>

#include "identify/diagnosis/thresholds.hpp"

namespace catena {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Marks seen by one experiment: a block of `components` rows for each.
struct Seen {
  const MatrixXd& positions;  // m, channels x frames
  const std::vector<double>& time;
  Index components;

  Index marks() const { return positions.rows() / components; }
  auto mark(Index index, Index frame) const {
    return positions.col(frame).segment(components * index, components);
  }
  MatrixXd nothing() const { return MatrixXd::Zero(positions.rows(), positions.cols()); }
};

/// Where the cable points at a mark, from its neighbours, in the mark's rows.
MatrixXd direction_at(Index mark, const Seen& seen) {
  const Index above = std::max<Index>(mark - 1, 0), below = std::min(mark + 1, seen.marks() - 1);
  MatrixXd direction = seen.nothing();
  for (Index k = 0; k < direction.cols(); ++k) {
    VectorXd along = seen.mark(below, k);
    if (seen.marks() > 1) along -= seen.mark(above, k);
    direction.col(k).segment(seen.components * mark, seen.components) = along.normalized();
  }
  return direction;
}

/// m/s, from neighbouring frames.
MatrixXd rates(const Seen& seen) {
  MatrixXd rate = seen.nothing();
  for (Index k = 0; k < rate.cols(); ++k) {
    const Index before = std::max<Index>(k - 1, 0), after = std::min(k + 1, rate.cols() - 1);
    const double span =
        seen.time[static_cast<std::size_t>(after)] - seen.time[static_cast<std::size_t>(before)];
    if (span > 0) rate.col(k) = (seen.positions.col(after) - seen.positions.col(before)) / span;
  }
  return rate;
}

/// How far marks move until their line of the picture is read, for 1 s from the support to `length`.
MatrixXd moved_until_read(const Seen& seen, double length) {
  MatrixXd moved = rates(seen);
  for (Index k = 0; k < moved.cols(); ++k)
    for (Index mark = 0; mark < seen.marks(); ++mark)
      moved.col(k).segment(2 * mark, 2) *= seen.mark(mark, k)[1] / length;
  return moved;
}

/// Each mark's change as a function of its position.
MatrixXd changed(const Seen& seen, const std::function<Vector3d(const Vector3d&)>& change) {
  MatrixXd result = seen.nothing();
  for (Index k = 0; k < result.cols(); ++k)
    for (Index mark = 0; mark < seen.marks(); ++mark)
      result.col(k).segment(3 * mark, 3) = change(seen.mark(mark, k));
  return result;
}

/// A mark off along the cable and across it.
std::vector<MatrixXd> misplaced(Index mark, const Seen& seen) {
  std::vector<MatrixXd> errors = {direction_at(mark, seen)};
  if (seen.components == 2) {
    MatrixXd across = seen.nothing();
    across.row(2 * mark) = errors[0].row(2 * mark + 1);
    across.row(2 * mark + 1) = -errors[0].row(2 * mark);
    errors.push_back(std::move(across));
    return errors;
  }
  // The parts of the axes that are normal to the cable span what is across it.
  for (int axis = 0; axis < 3; ++axis) {
    MatrixXd across = seen.nothing();
    for (Index k = 0; k < across.cols(); ++k) {
      const Vector3d along = errors[0].col(k).segment(3 * mark, 3);
      across.col(k).segment(3 * mark, 3) = Vector3d::Unit(axis) - along[axis] * along;
    }
    errors.push_back(std::move(across));
  }
  return errors;
}

}  // namespace

std::vector<Frames> errors_of_markers(const FittedModel& model) {
  const std::vector<Experiment>& experiments = model.problem->experiments();
  const PlausibleErrors& plausibly = kThresholds.errors_of_knowns;
  const double length = model.problem->the_case().cable.whole_length();
  std::map<int, std::vector<std::size_t>> windows;  // of each recording
  for (std::size_t e = 0; e < experiments.size(); ++e)
    if (experiments[e].spec.kind == DataKind::kMarkers) windows[experiments[e].source].push_back(e);

  std::vector<Frames> errors;
  for (const auto& [source, members] : windows) {
    // The errors that `of` gives for each window, times their standard deviation.
    const auto add = [&](double deviation,
                         const std::function<std::vector<MatrixXd>(const Seen&)>& of) {
      std::vector<Frames> added;
      for (const std::size_t e : members) {
        const std::vector<MatrixXd> here = of({model.predicted[e], experiments[e].recording.time,
                                               experiments[e].recording.components()});
        added.resize(here.size(), Frames(experiments.size()));
        for (std::size_t i = 0; i < here.size(); ++i) added[i][e] = deviation * here[i];
      }
      errors.insert(errors.end(), added.begin(), added.end());
    };
    const Index components = experiments[members.front()].recording.components();
    const Index marks = model.predicted[members.front()].rows() / components;
    for (Index mark = 0; mark < marks; ++mark)
      add(plausibly.place, [&](const Seen& seen) { return misplaced(mark, seen); });
    if (components == 2) {
      add(plausibly.shutter,
          [&](const Seen& seen) { return std::vector<MatrixXd>{moved_until_read(seen, length)}; });
      continue;
    }
    for (int i = 0; i < 3; ++i) {
      const Vector3d axis = Vector3d::Unit(i);
      add(plausibly.place, [&](const Seen& seen) {
        return std::vector{changed(seen, [&](const Vector3d&) { return axis; })};
      });
      add(plausibly.angle, [&](const Seen& seen) {
        return std::vector{changed(seen, [&](const Vector3d& at) { return axis.cross(at); })};
      });
    }
    add(plausibly.ratio, [](const Seen& seen) { return std::vector<MatrixXd>{seen.positions}; });
    add(plausibly.time, [](const Seen& seen) { return std::vector{rates(seen)}; });
  }
  return errors;
}

}  // namespace catena
