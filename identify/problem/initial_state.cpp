// SPDX-License-Identifier: BSD-3-Clause
#include "identify/problem/initial_state.hpp"

#include <algorithm>
#include <cmath>

#include "common/impossible_value.hpp"
#include "common/in_quotes.hpp"
#include "common/input_error.hpp"
#include "common/nearest_name.hpp"
#include "identify/problem/parameter_map.hpp"
#include "linear_algebra/decompositions.hpp"
#include "runtime/held_end.hpp"
#include "runtime/link_frame.hpp"
#include "runtime/rest_states.hpp"

namespace catena {
namespace {

/// Legendre polynomials on [0, 1], degree 0 .. terms - 1, at x.
Eigen::RowVectorXd legendre(int terms, double x) {
  Eigen::RowVectorXd value(terms);
  const double u = 2 * x - 1;
  for (int k = 0; k < terms; ++k)
    value[k] = k == 0   ? 1
               : k == 1 ? u
                        : ((2 * k - 1) * u * value[k - 1] - (k - 1) * value[k - 2]) / k;
  return value;
}

Eigen::VectorXd as_vector(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Coordinates a + rates b t of the links, seen at the channels of the first frames. Coordinates are
/// the angles of all links, then in space those out of the planes of the azimuths.
struct FirstFrames {
  const Recording& recording;
  const Eigen::VectorXd& lengths;
  Eigen::VectorXd azimuths;  ///< rad, of each link; zero in the plane

  bool in_space() const { return recording.components() == 3; }

  /// How far along link i a point is: 1 beyond its far end, 0 before its start.
  double share(const PointSpec& point, Eigen::Index i) const {
    if (point.load) return 1;
    if (point.joint) return i < point.joint ? 1 : 0;
    return std::clamp((point.arc_length - lengths.head(i).sum()) / lengths[i], 0.0, 1.0);
  }

  LinkFrame link(const Eigen::VectorXd& x, Eigen::Index i) const {
    return {x[i], in_space() ? x[lengths.size() + i] : 0, azimuths[i]};
  }

  /// The simulated value of one channel and its derivative by the coordinates.
  double value(const Channel& channel, const Eigen::VectorXd& x, Eigen::VectorXd& by_x) const {
    const PointSpec& point = recording.points[static_cast<std::size_t>(channel.point)];
    by_x.setZero(x.size());
    if (channel.component == Component::kAngle) {
      by_x[point.link - 1] = 1;
      return x[point.link - 1];
    }
    const Eigen::Index axis = channel.component == Component::kSide   ? 0
                              : channel.component == Component::kDown ? 1
                                                                      : 2;
    double sum = 0;
    for (Eigen::Index i = 0; i < lengths.size(); ++i) {
      const double part = lengths[i] * share(point, i);
      const LinkFrame here = link(x, i);
      sum += part * here.direction()[axis];
      by_x[i] = part * here.by_angle()[axis];
      if (in_space()) by_x[lengths.size() + i] = part * here.by_out_of_plane()[axis];
    }
    return sum;
  }
};

/// Whether all components of a point are seen in the first frame.
bool seen_first(const Recording& recording, Eigen::Index point) {
  const Eigen::Index components = recording.components();
  return !recording.measured.block(components * point, 0, components, 1).hasNaN();
}

/// The vertical plane of the marker that is farthest from the plumb line in the first frame.
double common_azimuth(const Recording& recording) {
  double azimuth = 0, farthest = 0;
  for (Eigen::Index p = 0; p < static_cast<Eigen::Index>(recording.points.size()); ++p) {
    if (!seen_first(recording, p)) continue;
    const double side = recording.measured(3 * p, 0), across = recording.measured(3 * p + 2, 0);
    if (std::hypot(side, across) <= farthest) continue;
    farthest = std::hypot(side, across);
    azimuth = std::atan2(across, side);
  }
  return azimuth;
}

/// A straight start that points at the farthest marker seen, in the vertical plane of the azimuth, or
/// at the mean angle.
double common_angle(const Recording& recording, double azimuth) {
  for (auto p = static_cast<Eigen::Index>(recording.points.size()); p-- > 0;) {
    if (!seen_first(recording, p)) continue;
    const Eigen::Index components = recording.components(), row = components * p;
    if (components == 1) return recording.measured(row, 0);
    const double side = recording.measured(row, 0);
    return std::atan2(components == 2 ? side
                                      : std::cos(azimuth) * side +
                                            std::sin(azimuth) * recording.measured(row + 2, 0),
                      recording.measured(row + 1, 0));
  }
  return 0;
}

/// Links that point far out of their vertical plane, where its angle says little, get planes of their
/// own. `x`: coordinates, then their rates, if they move.
void give_own_planes(FirstFrames& first, Eigen::VectorXd& x) {
  constexpr double kFar = 0.8;  // rad, half of pi/2, where the angle says nothing
  const Eigen::Index n = first.lengths.size();
  for (Eigen::Index i = 0; i < n; ++i) {
    if (std::abs(x[n + i]) < kFar) continue;
    const LinkFrame old = first.link(x, i);
    const Eigen::Vector3d direction = old.direction();
    first.azimuths[i] = std::atan2(direction[2], direction[0]);
    x[i] = std::atan2(std::hypot(direction[0], direction[2]), direction[1]);
    x[n + i] = 0;
    if (x.size() == 2 * n) continue;
    const Eigen::Vector3d rate =
        x[2 * n + i] * old.by_angle() + x[3 * n + i] * old.by_out_of_plane();
    const LinkFrame own = first.link(x, i);
    x[2 * n + i] = rate.dot(own.by_angle());
    x[3 * n + i] = rate.dot(own.by_out_of_plane());
  }
}

/// The shape at rest of a start, without what it says of velocities and azimuths.
State shape_at_start(const Model& model, const Eigen::VectorXd& parameters,
                     const InitialSpec& initial, const Signals& signals, double time) {
  if (initial.shape == Shape::kCatenary)
    return catenary(model, parameters, {initial.held[0], initial.held[1]},
                    initial.ends_at_held ? CatenaryFit::kEndHeld : CatenaryFit::kChords);
  if (initial.shape == Shape::kHanging) {
    const Equilibrium equilibrium = hanging_equilibrium(model, parameters, time, signals);
    if (equilibrium.status != Status::kSuccess)
      throw ImpossibleValue("hanging equilibrium: " + equilibrium.message);
    return equilibrium.state;
  }
  return from_angles(model, initial_angles(initial, link_lengths(model, parameters)));
}

/// What a start in space says of the links. `shape`: in the plane of side and down, or an equilibrium, whose
/// links have azimuths of their own.
LinkDirections directions_at_start(const Model& model, const State& shape,
                                   const InitialSpec& initial, const Eigen::VectorXd& lengths) {
  const Eigen::Index n = model.links();
  const auto or_zero = [&](const std::vector<double>& values) -> Eigen::VectorXd {
    return values.empty() ? Eigen::VectorXd(Eigen::VectorXd::Zero(n)) : as_vector(values);
  };
  LinkDirections links;
  links.angle.resize(n);
  links.azimuth = or_zero(initial.azimuths);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double side = shape.q[i], down = shape.q[n + i], across = shape.q[2 * n + i];
    // In the plane of side and down, but for rounding, the angle has a sign, and its rate with it.
    const bool flat = std::abs(across) < 1e-9;
    links.angle[i] = std::atan2(flat ? side : std::hypot(side, across), down);
    if (!flat) links.azimuth[i] = std::atan2(across, side);
  }
  links.angle_rate = initial_rates(initial, lengths);
  links.azimuth_rate = or_zero(initial.azimuth_rates);
  if (!initial.out_of_plane.empty())
    links.out_of_plane = shape_basis(initial.shape, model.links(), initial.terms, lengths) *
                         as_vector(initial.out_of_plane);
  if (!initial.out_of_plane_rates.empty())
    links.out_of_plane_rate =
        shape_basis(initial.velocity_shape, model.links(), initial.velocity_terms, lengths) *
        as_vector(initial.out_of_plane_rates);
  return links;
}

/// Puts what the case says of the load's coordinates into the state.
void start_load(const Model& model, const InitialSpec& initial, State& state) {
  const catena_model& table = model.table();
  const Eigen::Index links = model.links(), first = (model.in_space() ? 3 : 1) * links,
                     end = model.coordinates() - model.constraints();
  for (const LoadStart& start : initial.load) {
    std::vector<std::string> names;
    bool found = false;
    for (Eigen::Index i = first; i < end; ++i) {
      names.emplace_back(table.coordinate[i].name);
      if (names.back() != start.coordinate) continue;
      state.q[i] = start.value;
      state.v[i] = start.rate;
      found = true;
    }
    if (!found)
      throw ImpossibleValue("load: the model has no coordinate " + in_quotes(start.coordinate) +
                            suggestion(start.coordinate, names));
  }
}

/// How many coefficients a shape of the angles has.
int coefficient_count(Shape shape, int links, int terms) {
  switch (shape) {
    case Shape::kStraight:
      return 1;
    case Shape::kAngles:
      return links;
    case Shape::kSmooth:
      return terms;
    case Shape::kCatenary:
    case Shape::kHanging:
      return 0;
  }
  return 0;
}

/// The motion closest to the first `used` frames, by Gauss-Newton on the positions; weak terms on bending decide what
/// the markers leave open. x: the coordinates of the links in the first frame and, unless at rest, their rates.
void fit_to_first_frames(const FirstFrames& first, Eigen::Index used, bool at_rest,
                         bool find_angles, Eigen::VectorXd& x) {
  const Recording& recording = first.recording;
  const Eigen::Index n = first.lengths.size(), unknowns = x.size(),
                     m = at_rest ? unknowns : unknowns / 2;
  constexpr double kWeak = 1e-3;  // relative to the mean length a marker sees
  const double weak = kWeak * (recording.channels.front().component == Component::kAngle
                                   ? 1e-3
                                   : first.lengths.sum() / static_cast<double>(n));
  for (int iteration = 0; iteration < 50; ++iteration) {
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns, unknowns);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns), by_x(m), row(unknowns);
    // Only `count` elements of the row from `begin` on are not zero.
    const auto add = [&](double residual, Eigen::Index begin, Eigen::Index count) {
      const auto part = row.segment(begin, count);
      normal.block(begin, begin, count, count).noalias() += part * part.transpose();
      right.segment(begin, count).noalias() -= part * residual;
    };
    for (Eigen::Index k = 0; k < used; ++k) {
      const double t = recording.time[static_cast<std::size_t>(k)] - recording.time.front();
      const Eigen::VectorXd now = at_rest ? x : Eigen::VectorXd(x.head(m) + t * x.tail(m));
      for (std::size_t c = 0; c < recording.channels.size(); ++c) {
        const double measured = recording.measured(static_cast<Eigen::Index>(c), k);
        if (std::isnan(measured)) continue;
        const double simulated = first.value(recording.channels[c], now, by_x);
        row.head(m) = by_x;
        if (!at_rest) row.tail(m) = t * by_x;
        add(simulated - measured, 0, unknowns);
      }
    }
    for (Eigen::Index block = 0; block < unknowns; block += n)
      for (Eigen::Index i = 1; i < n; ++i) {  // second differences: least change of bending
        row.setZero();
        row[block + i] = weak;
        row[block + i - 1] = i > 1 ? -2 * weak : -weak;
        if (i > 1) row[block + i - 2] = weak;
        const Eigen::Index begin = std::max<Eigen::Index>(i - 2, 0);
        add(row.dot(x), block + begin, i + 1 - begin);
      }
    if (!find_angles) {  // they are given: only the rates move
      normal.topRows(m).setZero();
      normal.leftCols(m).setZero();
      normal.topLeftCorner(m, m).setIdentity();
      right.head(m).setZero();
    }
    normal.diagonal().array() += 1e-12 * (1 + normal.diagonal().maxCoeff());
    Eigen::VectorXd step = solve_symmetric(normal, right);
    const double largest = step.head(m).cwiseAbs().maxCoeff();
    if (largest > 0.5) step *= 0.5 / largest;  // rad: stay where the linearisation means something
    x += step;
    if (step.norm() < 1e-12 * (1 + x.norm())) break;
  }
}

}  // namespace

Eigen::MatrixXd shape_basis(Shape shape, int links, int terms, const Eigen::VectorXd& lengths) {
  const int count = coefficient_count(shape, links, terms);
  if (shape == Shape::kAngles) return Eigen::MatrixXd::Identity(links, links);
  Eigen::MatrixXd basis = Eigen::MatrixXd::Ones(links, count);
  if (shape == Shape::kSmooth) {
    const double whole = lengths.sum();
    double before = 0;
    for (Eigen::Index i = 0; i < links; ++i) {
      basis.row(i) = legendre(terms, (before + 0.5 * lengths[i]) / whole);
      before += lengths[i];
    }
  }
  return basis;
}

Eigen::VectorXd initial_angles(const InitialSpec& initial, const Eigen::VectorXd& lengths) {
  const int links = static_cast<int>(lengths.size());
  return shape_basis(initial.shape, links, initial.terms, lengths) *
         as_vector(initial.coefficients);
}

Eigen::VectorXd initial_rates(const InitialSpec& initial, const Eigen::VectorXd& lengths) {
  const int links = static_cast<int>(lengths.size());
  if (initial.at_rest) return Eigen::VectorXd::Zero(links);
  return shape_basis(initial.velocity_shape, links, initial.velocity_terms, lengths) *
         as_vector(initial.velocity_coefficients);
}

State state_at_start(const Model& model, const Eigen::VectorXd& parameters,
                     const InitialSpec& initial, const Signals& signals, double time) {
  const Eigen::VectorXd lengths = link_lengths(model, parameters);
  State state = shape_at_start(model, parameters, initial, signals, time);
  if (model.in_space()) {
    const Eigen::Index of_load = model.coordinates() - 3 * model.links();
    const Eigen::VectorXd load = state.q.tail(of_load);
    state = from_directions(model, directions_at_start(model, state, initial, lengths));
    if (!model.held()) state.q.tail(of_load) = load;
  } else {
    state.v.head(model.links()) = initial_rates(initial, lengths);
  }
  // A step of a fit may take the coefficients of a start beyond the numbers of a computer.
  if (!state.q.allFinite() || !state.v.allFinite())
    throw ImpossibleValue("the start's directions or rates are not finite");
  if (model.held()) return closed_end(model, parameters, state, time, signals);
  start_load(model, initial, state);
  return state;
}

SensitivityDirection start_along(const Model& model, const Eigen::VectorXd& parameters,
                                 InitialSpec initial, const Signals& signals, double time,
                                 int coefficient) {
  const Eigen::VectorXd lengths = link_lengths(model, parameters);
  auto k = static_cast<std::size_t>(coefficient);
  std::size_t list = 0;
  while (k >= initial.coefficient_lists()[list]->size())
    k -= initial.coefficient_lists()[list++]->size();
  const bool rate = list >= 2;
  const Eigen::VectorXd column =
      shape_basis(rate ? initial.velocity_shape : initial.shape, model.links(),
                  rate ? initial.velocity_terms : initial.terms, lengths)
          .col(static_cast<Eigen::Index>(k));
  SensitivityDirection direction;
  if (model.in_space()) {
    LinkDirections along;
    Eigen::VectorXd* const moved[] = {&along.angle, &along.out_of_plane, &along.angle_rate,
                                      &along.out_of_plane_rate};
    *moved[list] = column;
    const State in_plane = shape_at_start(model, parameters, initial, signals, time);
    const LinkDirections links = directions_at_start(model, in_plane, initial, lengths);
    State state = from_directions_tangent(model, links, along);
    direction.q = std::move(state.q);
    direction.v = std::move(state.v);
    if (model.held()) {
      const State open = from_directions(model, links);
      close_direction(model, parameters, open, closed_end(model, parameters, open, time, signals),
                      direction);
    }
  } else {
    Eigen::VectorXd& moved = rate ? direction.v : direction.q;
    moved = Eigen::VectorXd::Zero(model.coordinates());
    moved.head(model.links()) = column;
  }
  return direction;
}

void check_start(const Model& model, const Eigen::VectorXd& parameters, const InitialSpec& initial,
                 const Signals& signals, double time, const std::string& where) {
  State state;
  try {
    state = state_at_start(model, parameters, initial, signals, time);
  } catch (const ImpossibleValue& error) {
    throw InputError(where + ": initial: " + error.what());
  }
  if (signals.count() < model.signals()) return;
  Eigen::VectorXd acceleration(model.coordinates()), signal_values(3 * model.signals());
  signals.evaluate(time, signal_values.data());
  const catena_point at{time,           state.q.data(),       state.v.data(),   acceleration.data(),
                        state.z.data(), signal_values.data(), parameters.data()};
  if (const int pivot = model.acceleration(at, acceleration.data()))
    throw InputError(where + ": cable: the mass matrix is not positive definite (at " +
                     model.table().coordinate[pivot - 1].name +
                     "); links without mass need a load or neighbours that have some");
}

void complete_from_data(InitialSpec& initial, const Recording& recording,
                        const Eigen::VectorXd& lengths) {
  const int links = static_cast<int>(lengths.size());
  const int angle_count = coefficient_count(initial.shape, links, initial.terms);
  const bool find_angles = angle_count > 0 && initial.coefficients.empty();
  const bool find_rates = !initial.at_rest && initial.velocity_coefficients.empty();
  const bool in_space = recording.components() == 3;
  if (in_space && !find_angles) initial.out_of_plane.resize(initial.coefficients.size());
  if (in_space && !find_rates)
    initial.out_of_plane_rates.resize(initial.velocity_coefficients.size());
  if (!find_angles && !find_rates) return;

  // Unknowns: coordinates of the links and, if they move, their rates; frames enough for a line.
  constexpr Eigen::Index kMovingFrames = 7;
  const Eigen::Index used =
      initial.at_rest ? 1 : std::min<Eigen::Index>(kMovingFrames, recording.measured.cols());
  const Eigen::Index n = links, m = in_space ? 2 * n : n, unknowns = initial.at_rest ? m : 2 * m;
  if (recording.measured.leftCols(used).array().isNaN().all())
    throw InputError(
        "the first frames hold no measurement: the initial state cannot be found from "
        "them; give its coefficients, or another `from`");
  FirstFrames first{recording, lengths, Eigen::VectorXd::Zero(n)};
  const bool find_azimuth = in_space && find_angles && initial.azimuths.empty();
  if (find_azimuth)
    first.azimuths.setConstant(common_azimuth(recording));
  else if (!initial.azimuths.empty())
    first.azimuths = as_vector(initial.azimuths);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(unknowns);
  x.head(n).setConstant(common_angle(recording, first.azimuths[0]));
  if (angle_count > 0 && !find_angles) {
    x.head(n) = initial_angles(initial, lengths);
    if (in_space)
      x.segment(n, n) = shape_basis(initial.shape, links, initial.terms, lengths) *
                        as_vector(initial.out_of_plane);
  }

  fit_to_first_frames(first, used, initial.at_rest, find_angles, x);
  const auto coefficients = [&](Shape shape, int terms, const Eigen::VectorXd& values) {
    const Eigen::VectorXd fitted = least_squares(shape_basis(shape, links, terms, lengths), values);
    return std::vector<double>(fitted.begin(), fitted.end());
  };
  if (find_azimuth) {
    const bool of_links = initial.shape == Shape::kAngles &&
                          (initial.at_rest || initial.velocity_shape == Shape::kAngles);
    if (of_links) give_own_planes(first, x);
    initial.azimuths.assign(first.azimuths.begin(), first.azimuths.end());
  }
  if (find_angles) {
    initial.coefficients = coefficients(initial.shape, initial.terms, x.head(n));
    if (in_space)
      initial.out_of_plane = coefficients(initial.shape, initial.terms, x.segment(n, n));
  }
  if (find_rates) {
    const auto rates = [&](Eigen::Index begin) {
      return coefficients(initial.velocity_shape, initial.velocity_terms, x.segment(begin, n));
    };
    initial.velocity_coefficients = rates(m);
    if (in_space) initial.out_of_plane_rates = rates(m + n);
  }
}

}  // namespace catena
