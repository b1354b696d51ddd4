// SPDX-License-Identifier: BSD-3-Clause
#include "identify/problem/observer.hpp"

#include <algorithm>
#include <cmath>

#include "identify/problem/marker_places.hpp"

namespace catena {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

Positions sized(const Model& model) {
  const VectorXd zero = VectorXd::Zero(model.links() + 2);
  return {zero, zero, model.in_space() ? zero : VectorXd()};
}

CablePoint load_of(const Positions& at) {
  const Index load = at.side.size() - 1;
  return {at.side[load], at.down[load], at.across.size() ? at.across[load] : 0};
}

}  // namespace

FrameClock frame_clock(const Model& model, const Experiment& experiment, const VectorXd& parameters,
                       Index frames) {
  const double start = experiment.spec.start;
  std::vector<double> tau(static_cast<std::size_t>(frames));
  for (std::size_t k = 0; k < tau.size(); ++k) {
    const double t = experiment.recording.time[k];
    tau[k] = model.table().observes ? model.clock(t, parameters.data()) : t;
  }
  FrameClock clock;
  clock.times = {start};
  for (const double t : tau)
    if (t > start) clock.times.push_back(t);
  if (experiment.meets >= 0) clock.times.push_back(experiment.ends);
  std::sort(clock.times.begin(), clock.times.end());
  clock.times.erase(std::unique(clock.times.begin(), clock.times.end()), clock.times.end());
  for (const double t : tau) {
    clock.held.push_back(t < start);
    const auto found = std::lower_bound(clock.times.begin(), clock.times.end(), std::max(t, start));
    clock.column.push_back(found - clock.times.begin());
  }
  return clock;
}

Observer::Place Observer::place_of(const Model& model, const VectorXd& parameters,
                                   const PointSpec& point) {
  Place place;
  if (!point.camera.empty()) place.camera.emplace(model, point.camera);
  place.load = point.load;
  place.at_arc_length = !point.load && !point.joint && !point.link;
  if (!place.at_arc_length) {
    place.point = point.load    ? MaterialPoint{model.links() - 1, 1.0}
                  : point.joint ? MaterialPoint{point.joint - 1, 1.0}
                                : MaterialPoint{point.link - 1, 0.0};
    return place;
  }
  place.off = index_of_place(model, point.name);
  double arc_length = point.arc_length;
  if (!std::isnan(point.share)) {
    place.share = point.share;
    const double length = link_lengths(model, parameters).sum();
    // Roundings are no other length: they would move a mark at a joint to the next link.
    constexpr double kRounding = 1e-9;
    if (std::abs(place.share * length - arc_length) > kRounding * length)
      arc_length = place.share * length;
  }
  place.point = moved_point(model, parameters, arc_length, place.off ? parameters[*place.off] : 0);
  return place;
}

Observer::Report Observer::truth(const CablePoint& point, double angle) const {
  return {point.side, point.down, model_.in_space() ? point.across : angle};
}

Observer::Sight Observer::sight(const Report& reported) const {
  if (!model_.in_space()) return {reported[0], reported[1], reported[2], 0};
  return {reported[0], reported[1], 0, reported[2]};
}

Observer::Sight Observer::in_picture(const Eigen::Vector2d& picture) const {
  const double scale = experiment_.spec.metres_per_pixel;
  return {scale * picture[0], scale * picture[1], 0, 0};
}

Observer::Observer(const Model& model, const Experiment& experiment, const VectorXd& parameters,
                   const std::vector<SensitivityDirection>& along)
    : model_(model),
      experiment_(experiment),
      parameters_(parameters),
      directions_(along),
      accelerations_(VectorXd::Zero(model.coordinates())),
      signals_(VectorXd::Zero(Index{3} * model.signals())),
      no_signals_(signals_),
      here_(sized(model)),
      rates_(here_),
      change_(here_) {
  for (const PointSpec& point : experiment.recording.points)
    places_.push_back(place_of(model, parameters, point));
  for (const SensitivityDirection& direction : directions_) {
    std::vector<double>& moved = moved_.emplace_back();
    const VectorXd changes = direction.parameters.head(model.links());  // of the lengths
    for (const Place& place : places_) {
      double& fraction = moved.emplace_back(0);
      if (!place.at_arc_length) continue;
      double farther = place.share * changes.sum();
      if (place.off) farther += direction.parameters[*place.off];
      fraction = fraction_tangent(model, parameters, direction.parameters, place.point) +
                 farther / link_lengths(model, parameters)[place.point.link];
    }
  }
  true_.resize(places_.size());
  reported_.resize(places_.size());
  seen_.resize(places_.size());
}

void Observer::move_to(const Trajectory& path, Index column, double t) {
  path_ = &path;
  column_ = column;
  t_ = t;
  experiment_.signals.evaluate(path.time[static_cast<std::size_t>(column)], signals_.data());
  const catena_point at = point(path, signals_, parameters_);
  model_.positions(at, here_.side.data(), here_.down.data());
  if (model_.in_space()) model_.positions_across(at, here_.across.data());
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Place& place = places_[i];
    const CablePoint there = place.load ? load_of(here_) : position_of(here_, place.point);
    true_[i] = reported_[i] = truth(there, path.q(place.point.link, column));
    if (model_.table().observes)
      model_.observe(t_, parameters_.data(), true_[i].data(), reported_[i].data());
    seen_[i] = place.camera ? in_picture(place.camera->picture(parameters_, reported_[i]))
                            : sight(reported_[i]);
  }
}

void Observer::look_along(const Trajectory& sensitivity, std::size_t direction, bool held) {
  const VectorXd& by_parameter = directions_[direction].parameters;
  const catena_point at = point(*path_, signals_, parameters_);
  catena_point along = point(sensitivity, no_signals_, by_parameter);
  along.t = 0;  // the moment is the same along every direction
  model_.positions_tangent(at, along, change_.side.data(), change_.down.data());
  if (model_.in_space()) model_.positions_across_tangent(at, along, change_.across.data());
  double clock_shift = 0;
  if (model_.table().observes && !held) {
    clock_shift = model_.clock_tangent(t_, parameters_.data(), by_parameter.data());
    model_.velocities(at, rates_.side.data(), rates_.down.data());
    change_.side += clock_shift * rates_.side;
    change_.down += clock_shift * rates_.down;
    if (model_.in_space()) {
      model_.velocities_across(at, rates_.across.data());
      change_.across += clock_shift * rates_.across;
    }
  }
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Place& place = places_[i];
    const CablePoint change =
        place.load ? load_of(change_)
                   : position_tangent_of(here_, change_, place.point, moved_[direction][i]);
    const Index link = place.point.link;
    const Report din =
        truth(change, sensitivity.q(link, column_) + clock_shift * path_->v(link, column_));
    Report dreported = din;
    if (model_.table().observes)
      model_.observe_tangent(t_, parameters_.data(), by_parameter.data(), true_[i].data(),
                             din.data(), dreported.data());
    seen_[i] = place.camera ? in_picture(place.camera->picture_tangent(parameters_, by_parameter,
                                                                       reported_[i], dreported))
                            : sight(dreported);
  }
}

catena_point Observer::point(const Trajectory& path, const VectorXd& signals,
                             const VectorXd& p) const {
  return {path_->time[static_cast<std::size_t>(column_)],
          path.q.col(column_).data(),
          path.v.col(column_).data(),
          accelerations_.data(),
          path.z.col(column_).data(),
          signals.data(),
          p.data()};
}

}  // namespace catena
