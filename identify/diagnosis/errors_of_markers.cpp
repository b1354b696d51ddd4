// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/errors_of_markers.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <map>

#include "identify/diagnosis/thresholds.hpp"
#include "identify/problem/camera.hpp"

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

/// The marks of one experiment, and what is reported where they are off. Those of pictures are put where
/// the predicted pictures show them.
class Marks {
 public:
  Marks(const FittedModel& model, std::size_t e)
      : experiment_(model.problem->experiments()[e]), positions_(model.predicted[e]) {
    const Recording& recording = experiment_.recording;
    components_ = recording.components();
    if (recording.points.front().camera.empty()) return;
    components_ = 3;
    parameters_ = model.problem->model_parameters(model.x, static_cast<int>(e));
    Recording pictures = recording;
    pictures.measured = model.predicted[e];
    positions_ = positions_from_pictures(pictures, model.problem->model(), parameters_,
                                         experiment_.spec.metres_per_pixel)
                     .measured;
    for (const PointSpec& point : recording.points)
      cameras_.emplace_back(model.problem->model(), point.camera);
  }

  Seen seen() const { return {positions_, experiment_.recording.time, components_}; }

  /// What is reported, less what would be without the error of the positions.
  MatrixXd reported(const MatrixXd& error) const {
    if (cameras_.empty()) return error;
    const std::vector<int> markers = markers_of(experiment_.recording.points);
    const VectorXd no_change = VectorXd::Zero(parameters_.size());
    MatrixXd pictures(2 * static_cast<Index>(cameras_.size()), error.cols());
    for (std::size_t i = 0; i < cameras_.size(); ++i)
      for (Index k = 0; k < error.cols(); ++k)
        pictures.col(k).segment<2>(2 * static_cast<Index>(i)) =
            experiment_.spec.metres_per_pixel *
            cameras_[i].picture_tangent(parameters_, no_change, seen().mark(markers[i], k),
                                        error.col(k).segment<3>(3 * markers[i]));
    return pictures;
  }

 private:
  const Experiment& experiment_;
  MatrixXd positions_;  // m, channels x frames
  Index components_;
  VectorXd parameters_;          // of the model
  std::vector<Camera> cameras_;  // of each point; none: not in pictures
};

}  // namespace

std::vector<Frames> errors_of_markers(const FittedModel& model) {
  const std::vector<Experiment>& experiments = model.problem->experiments();
  const PlausibleErrors& plausibly = kThresholds.errors_of_knowns;
  const double length = model.problem->the_case().cable.whole_length();
  std::map<int, std::vector<std::size_t>> windows;  // of each recording
  for (std::size_t e = 0; e < experiments.size(); ++e)
    if (experiments[e].spec.kind == DataKind::kMarkers) windows[experiments[e].source].push_back(e);

  std::vector<Frames> errors;
  for (const auto& recording : windows) {  // named members: clang 14 takes no binding into `add`
    const std::vector<std::size_t>& members = recording.second;
    std::vector<Marks> marks;  // of each window
    for (const std::size_t e : members) marks.emplace_back(model, e);
    // The errors that `of` gives for each window, times their standard deviation.
    const auto add = [&](double deviation,
                         const std::function<std::vector<MatrixXd>(const Seen&)>& of) {
      std::vector<Frames> added;
      for (std::size_t w = 0; w < members.size(); ++w) {
        const std::vector<MatrixXd> here = of(marks[w].seen());
        added.resize(here.size(), Frames(experiments.size()));
        for (std::size_t i = 0; i < here.size(); ++i)
          added[i][members[w]] = deviation * marks[w].reported(here[i]);
      }
      errors.insert(errors.end(), added.begin(), added.end());
    };
    for (Index mark = 0; mark < marks.front().seen().marks(); ++mark)
      add(plausibly.place, [&](const Seen& seen) { return misplaced(mark, seen); });
    if (marks.front().seen().components == 2)
      add(plausibly.shutter,
          [&](const Seen& seen) { return std::vector<MatrixXd>{moved_until_read(seen, length)}; });
  }
  return errors;
}

}  // namespace catena
