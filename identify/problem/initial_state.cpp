// SPDX-License-Identifier: BSD-3-Clause
#include "identify/problem/initial_state.hpp"

#include <algorithm>
#include <cmath>

#include "common/impossible_value.hpp"
#include "common/input_error.hpp"
#include "identify/problem/parameter_map.hpp"
#include "linear_algebra/decompositions.hpp"
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

/// Angles a + rates b t, seen at the channels of the first frames.
struct FirstFrames {
  const Recording& recording;
  const Eigen::VectorXd& lengths;
  Eigen::Index frames;

  /// How far along link i a point is: 1 beyond its far end, 0 before its start.
  double share(const PointSpec& point, Eigen::Index i) const {
    if (point.load) return 1;
    if (point.joint) return i < point.joint ? 1 : 0;
    return std::clamp((point.arc_length - lengths.head(i).sum()) / lengths[i], 0.0, 1.0);
  }

  /// The simulated value of one channel and its derivative by the angles of the links.
  double value(const Channel& channel, const Eigen::VectorXd& theta,
               Eigen::VectorXd& by_angle) const {
    const PointSpec& point = recording.points[static_cast<std::size_t>(channel.point)];
    by_angle.setZero(theta.size());
    if (channel.component == Component::kAngle) {
      by_angle[point.link - 1] = 1;
      return theta[point.link - 1];
    }
    double sum = 0;
    for (Eigen::Index i = 0; i < theta.size(); ++i) {
      const double part = lengths[i] * share(point, i);
      const bool side = channel.component == Component::kSide;
      sum += part * (side ? std::sin(theta[i]) : std::cos(theta[i]));
      by_angle[i] = part * (side ? std::cos(theta[i]) : -std::sin(theta[i]));
    }
    return sum;
  }
};

/// A straight start that points at the farthest marker seen, or at the mean angle.
double common_angle(const Recording& recording) {
  for (auto p = static_cast<Eigen::Index>(recording.points.size()); p-- > 0;) {
    if (recording.channels.front().component == Component::kAngle) {
      if (!std::isnan(recording.measured(p, 0))) return recording.measured(p, 0);
    } else if (!std::isnan(recording.measured(2 * p, 0)) &&
               !std::isnan(recording.measured(2 * p + 1, 0))) {
      return std::atan2(recording.measured(2 * p, 0), recording.measured(2 * p + 1, 0));
    }
  }
  return 0;
}

/// The state whose links lie in the plane of side and down, turned to the azimuths.
State in_azimuths(const Model& model, const State& in_plane, const Eigen::VectorXd& rates,
                  const InitialSpec& initial) {
  const Eigen::Index n = model.links();
  const auto of_links = [&](const std::vector<double>& values) -> Eigen::VectorXd {
    return values.empty() ? Eigen::VectorXd(Eigen::VectorXd::Zero(n)) : as_vector(values);
  };
  Eigen::VectorXd angles(n);
  for (Eigen::Index i = 0; i < n; ++i) angles[i] = std::atan2(in_plane.q[i], in_plane.q[n + i]);
  return from_directions(
      model, {angles, of_links(initial.azimuths), rates, of_links(initial.azimuth_rates)});
}

}  // namespace

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
  State state = State::zero(model);
  if (initial.shape == Shape::kCatenary) {
    state = catenary(model, parameters, {initial.held[0], initial.held[1]},
                     initial.ends_at_held ? CatenaryFit::kEndHeld : CatenaryFit::kChords);
  } else if (initial.shape == Shape::kHanging) {
    const Equilibrium equilibrium = hanging_equilibrium(model, parameters, time, signals);
    if (equilibrium.status != Status::kSuccess)
      throw ImpossibleValue("hanging equilibrium: " + equilibrium.message);
    state = equilibrium.state;
  } else {
    state = from_angles(model, initial_angles(initial, lengths));
  }
  const Eigen::VectorXd rates = initial_rates(initial, lengths);
  if (model.in_space()) return in_azimuths(model, state, rates, initial);
  state.v.head(model.links()) = rates;
  return state;
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
  if (!find_angles && !find_rates) return;

  // Unknowns: angles of the links and, if they move, their rates; frames enough for a line.
  constexpr Eigen::Index kMovingFrames = 7;
  const Eigen::Index used =
      initial.at_rest ? 1 : std::min<Eigen::Index>(kMovingFrames, recording.measured.cols());
  const Eigen::Index n = links, unknowns = initial.at_rest ? n : 2 * n;
  const FirstFrames first{recording, lengths, used};
  if (recording.measured.leftCols(used).array().isNaN().all())
    throw InputError(
        "the first frames hold no measurement: the initial state cannot be found from "
        "them; give its coefficients, or another `from`");
  Eigen::VectorXd x = Eigen::VectorXd::Zero(unknowns);
  x.head(n).setConstant(common_angle(recording));
  if (angle_count > 0 && !find_angles) x.head(n) = initial_angles(initial, lengths);

  // Gauss-Newton on the positions; weak terms on bending decide what the markers leave open.
  constexpr double kWeak = 1e-3;  // relative to the mean length a marker sees
  const double weak = kWeak * (recording.channels.front().component == Component::kAngle
                                   ? 1e-3
                                   : lengths.sum() / static_cast<double>(n));
  for (int iteration = 0; iteration < 50; ++iteration) {
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns, unknowns);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns), by_angle(n), row(unknowns);
    // Only `count` elements of the row from `begin` on are not zero.
    const auto add = [&](double residual, Eigen::Index begin, Eigen::Index count) {
      const auto part = row.segment(begin, count);
      normal.block(begin, begin, count, count).noalias() += part * part.transpose();
      right.segment(begin, count).noalias() -= part * residual;
    };
    for (Eigen::Index k = 0; k < used; ++k) {
      const double t = recording.time[static_cast<std::size_t>(k)] - recording.time.front();
      const Eigen::VectorXd theta =
          initial.at_rest ? x : Eigen::VectorXd(x.head(n) + t * x.tail(n));
      for (std::size_t c = 0; c < recording.channels.size(); ++c) {
        const double measured = recording.measured(static_cast<Eigen::Index>(c), k);
        if (std::isnan(measured)) continue;
        const double simulated = first.value(recording.channels[c], theta, by_angle);
        row.head(n) = by_angle;
        if (!initial.at_rest) row.tail(n) = t * by_angle;
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
      normal.topRows(n).setZero();
      normal.leftCols(n).setZero();
      normal.topLeftCorner(n, n).setIdentity();
      right.head(n).setZero();
    }
    normal.diagonal().array() += 1e-12 * (1 + normal.diagonal().maxCoeff());
    Eigen::VectorXd step = solve_symmetric(normal, right);
    const double largest = step.head(n).cwiseAbs().maxCoeff();
    if (largest > 0.5) step *= 0.5 / largest;  // rad: stay where the linearisation means something
    x += step;
    if (step.norm() < 1e-12 * (1 + x.norm())) break;
  }
  const auto coefficients = [&](Shape shape, int terms, const Eigen::VectorXd& values) {
    const Eigen::VectorXd fitted = least_squares(shape_basis(shape, links, terms, lengths), values);
    return std::vector<double>(fitted.begin(), fitted.end());
  };
  if (find_angles) initial.coefficients = coefficients(initial.shape, initial.terms, x.head(n));
  if (find_rates)
    initial.velocity_coefficients =
        coefficients(initial.velocity_shape, initial.velocity_terms, x.tail(n));
}

}  // namespace catena
