// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/where.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "identify/diagnosis/search.hpp"
#include "identify/problem/initial_state.hpp"
#include "runtime/positions.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

double mean_square(const MatrixXd& values) {
  double sum = 0, count = 0;
  for (const double value : values.reshaped())
    if (!std::isnan(value)) sum += value * value, count += 1;
  return count > 0 ? sum / count : 0;
}

std::string point_name(const Experiment& experiment, std::size_t point) {
  const PointSpec& spec = experiment.recording.points[point];
  const bool last = point + 1 == experiment.recording.points.size();
  if (spec.load) return spec.name + " (the load)";
  if (spec.link > 0) return spec.name;
  return spec.name + (last ? " (the lowest)" : "");
}

/// The moment at which the mean square changes most, and both sides of it.
struct Onset {
  double time = 0, before = 0, after = 0;
};
Onset onset_of(const MatrixXd& residual, const std::vector<double>& time) {
  Onset best;
  double contrast = 0;
  for (Index k = residual.cols() / 8; k < residual.cols() * 7 / 8; ++k) {
    const double before = mean_square(residual.leftCols(k));
    const double after = mean_square(residual.rightCols(residual.cols() - k));
    const double ratio = std::abs(std::log((after + 1e-30) / (before + 1e-30)));
    if (ratio <= contrast) continue;
    contrast = ratio;
    best = {time[static_cast<std::size_t>(k)], std::sqrt(before), std::sqrt(after)};
  }
  return best;
}

}  // namespace

ResidualPlaces residual_places(const FittedModel& model, const std::vector<double>& floors) {
  ResidualPlaces places;
  std::size_t e = 0;
  while (e + 1 < model.fit_residual.size() && model.fit_residual[e].cols() == 0) ++e;
  const Experiment& experiment = model.problem->experiments()[e];
  const MatrixXd& residual = model.fit_residual[e];
  const Index frames = residual.cols();
  if (frames < 8) return places;
  const auto& channels = experiment.recording.channels;

  // By point.
  const std::size_t points = experiment.recording.points.size();
  for (std::size_t p = 0; p < points; ++p) {
    double sum = 0, count = 0;
    for (std::size_t c = 0; c < channels.size(); ++c)
      if (static_cast<std::size_t>(channels[c].point) == p) {
        sum += mean_square(residual.row(static_cast<Index>(c)));
        count += 1;
      }
    places.points.push_back(point_name(experiment, p));
    places.point_rms.push_back(std::sqrt(sum / std::max(1.0, count)));
  }
  const auto largest =
      static_cast<std::size_t>(std::max_element(places.point_rms.begin(), places.point_rms.end()) -
                               places.point_rms.begin());
  places.largest_point = places.points[largest];
  if (points > 1)
    places.words.push_back(fmt::format(
        "{} at {}",
        places.point_rms[largest] > 1.3 * std::sqrt(mean_square(residual)) ? "largest"
                                                                           : "slightly largest",
        places.largest_point));

  // By speed, from the simulated motion.
  const MatrixXd& predicted = model.predicted[e];
  std::vector<std::pair<double, double>> by_speed;
  for (Index k = 1; k + 1 < frames; ++k) {
    const double step = experiment.recording.time[static_cast<std::size_t>(k + 1)] -
                        experiment.recording.time[static_cast<std::size_t>(k - 1)];
    const double speed = (predicted.col(k + 1) - predicted.col(k - 1)).norm() / step;
    by_speed.emplace_back(speed, mean_square(residual.col(k)));
  }
  std::sort(by_speed.begin(), by_speed.end());
  const std::size_t third = by_speed.size() / 3;
  for (std::size_t k = 0; k < third; ++k) {
    places.slow_rms += by_speed[k].second / static_cast<double>(third);
    places.fast_rms += by_speed[by_speed.size() - 1 - k].second / static_cast<double>(third);
  }
  places.slow_rms = std::sqrt(places.slow_rms);
  places.fast_rms = std::sqrt(places.fast_rms);
  if (places.fast_rms > 1.25 * places.slow_rms) places.words.push_back("at high speed");
  if (places.slow_rms > 1.25 * places.fast_rms) places.words.push_back("at low speed");

  // By time.
  const Onset onset = onset_of(residual, experiment.recording.time);
  if (onset.after > 1.5 * onset.before)
    places.words.push_back(fmt::format("after {:.2g} s", onset.time));
  else if (onset.before > 1.5 * onset.after)
    places.words.push_back(fmt::format("before {:.2g} s", onset.time));
  else
    places.words.push_back("all the time");

  // By frequency.
  const std::vector<double> lines = strongest_frequencies(model, floors, 1);
  if (!lines.empty()) {
    places.strongest_frequency = lines.front();
    places.words.push_back(fmt::format("strongest at {:.2g} Hz", lines.front()));
  }
  return places;
}

namespace {

/// Value and first two derivatives of the cubic B-splines on uniform knots at t: four of them, the
/// first with number `first`.
constexpr double kEndKnots = 2;  // distances of knots

struct Splines {
  Index first = 0;
  double value[4], rate[4], acceleration[4];
};
Splines splines_at(double t, double begin, double step, Index count) {
  Splines s;
  const double x = (t - begin) / step;
  s.first = std::clamp<Index>(static_cast<Index>(std::floor(x)), 0, count - 4);
  const double u = x - static_cast<double>(s.first), w = 1 - u;
  const double value[4] = {w * w * w / 6, (3 * u * u * u - 6 * u * u + 4) / 6,
                           (3 * w * w * w - 6 * w * w + 4) / 6, u * u * u / 6};
  const double rate[4] = {-w * w / 2, (3 * u * u - 4 * u) / 2, (4 * w - 3 * w * w) / 2, u * u / 2};
  const double acceleration[4] = {w, 3 * u - 2, 3 * w - 2, u};
  for (int j = 0; j < 4; ++j) {
    s.value[j] = value[j];
    s.rate[j] = rate[j] / step;
    s.acceleration[j] = acceleration[j] / (step * step);
  }
  return s;
}

/// Share of the mean square of y (zero where unknown) that columns explain by least squares.
double explained(const VectorXd& y, const MatrixXd& columns) {
  const MatrixXd normal =
      columns.transpose() * columns +
      1e-12 * columns.squaredNorm() * MatrixXd::Identity(columns.cols(), columns.cols());
  const VectorXd right = columns.transpose() * y;
  return y.squaredNorm() > 0 ? right.dot(normal.ldlt().solve(right)) / y.squaredNorm() : 0;
}

}  // namespace

MissingForce missing_force(const FittedModel& model, const std::vector<double>& floors) {
  MissingForce force;
  std::size_t e = 0;
  while (e + 1 < model.fit_residual.size() && model.fit_residual[e].cols() == 0) ++e;
  force.experiment = static_cast<int>(e);
  const Problem& problem = *model.problem;
  const Experiment& experiment = problem.experiments()[e];
  const MatrixXd residual = model.predicted[e] - experiment.recording.measured;
  const Model& equations = problem.model();
  const Index n = equations.links(), coordinates = equations.coordinates();
  std::vector<double> time = experiment.recording.time;
  Index frames = residual.cols();
  if (frames < 30) return force;
  const double begin = time.front();

  // Directions of the angles: polynomials along the cable, as many as the channels can tell apart.
  const VectorXd parameters = problem.model_parameters(model.x, static_cast<int>(e));
  const VectorXd lengths = parameters.segment(equations.parameter_index("length_1"), n);
  const auto seen = static_cast<Index>(experiment.recording.points.size());
  const Index terms = std::min({n, seen, Index{6}});
  const MatrixXd basis =
      shape_basis(Shape::kSmooth, static_cast<int>(n), static_cast<int>(terms), lengths);
  std::vector<SensitivityDirection> along;
  for (Index m = 0; m < terms; ++m) {
    // a direction whose only use here is its length; the derivative is taken at the frame below
    SensitivityDirection direction;
    direction.q = VectorXd::Zero(coordinates);
    direction.q.head(n) = basis.col(m);
    along.push_back(direction);
  }
  const Prediction prediction = problem.predict(model.x, static_cast<int>(e), true);
  if (!prediction.ok()) return force;
  const Trajectory& path = prediction.trajectory;
  std::vector<Index> column;
  for (const double t : time) {
    const auto found = std::lower_bound(path.time.begin(), path.time.end(), t - 1e-9);
    column.push_back(std::min<Index>(found - path.time.begin(), path.q.cols() - 1));
  }

  // Knots ten frames apart, not closer than a twentieth of a second.
  const double span = time.back() - time.front();
  const double frame = span / static_cast<double>(frames - 1);
  force.resolution = std::max(10 * frame, 0.05);
  const Index pieces = std::max<Index>(4, static_cast<Index>(std::floor(span / force.resolution)));
  force.resolution = span / static_cast<double>(pieces);
  const Index splines = pieces + 3, size = splines * terms;
  if (size > 1500) return force;

  // Positions move by positions_tangent along each direction; angles by the direction itself.
  const auto move = [&](Index k, Index m, VectorXd& channel_rates) {
    const VectorXd q = path.q.col(column[static_cast<std::size_t>(k)]);
    const Positions moved =
        positions_tangent(equations, parameters, time[static_cast<std::size_t>(k)], q,
                          VectorXd::Zero(parameters.size()), along[static_cast<std::size_t>(m)].q,
                          experiment.signals);
    for (Index c = 0; c < residual.rows(); ++c) {
      const Channel& channel = experiment.recording.channels[static_cast<std::size_t>(c)];
      const PointSpec& point = experiment.recording.points[static_cast<std::size_t>(channel.point)];
      if (channel.component == Component::kAngle) {
        channel_rates[c] = basis(point.link - 1, m);
        continue;
      }
      const VectorXd& component = channel.component == Component::kSide ? moved.side : moved.down;
      if (point.load)
        channel_rates[c] = component[n + 1];
      else if (point.joint > 0)
        channel_rates[c] = component[point.joint];
      else {
        const MaterialPoint place = point_at_arc_length(equations, parameters, point.arc_length);
        channel_rates[c] = (1 - place.fraction) * component[place.link] +
                           place.fraction * component[place.link + 1];
      }
    }
  };
  MatrixXd normal = 1e-9 * MatrixXd::Identity(size, size);
  VectorXd right = VectorXd::Zero(size), right_noise = VectorXd::Zero(size);
  std::mt19937_64 random(1);
  std::normal_distribution<double> gauss(0, floors[e]);
  VectorXd rates(residual.rows());
  MatrixXd by_direction(residual.rows(), terms);
  for (Index k = 0; k < frames; ++k) {
    for (Index m = 0; m < terms; ++m) {
      move(k, m, rates);
      by_direction.col(m) = rates;
    }
    const Splines s =
        splines_at(time[static_cast<std::size_t>(k)], begin, force.resolution, splines);
    MatrixXd gram = MatrixXd::Zero(terms, terms);
    VectorXd project = VectorXd::Zero(terms), project_noise = VectorXd::Zero(terms);
    for (Index c = 0; c < residual.rows(); ++c) {
      if (std::isnan(residual(c, k))) continue;
      const VectorXd row = by_direction.row(c);
      gram.noalias() += row * row.transpose();
      project += row * residual(c, k);
      project_noise += row * gauss(random);
    }
    for (int i = 0; i < 4; ++i) {
      const Index a = (s.first + i) * terms;
      right.segment(a, terms) += s.value[i] * project;
      right_noise.segment(a, terms) += s.value[i] * project_noise;
      for (int j = 0; j < 4; ++j)
        normal.block(a, (s.first + j) * terms, terms, terms) += s.value[i] * s.value[j] * gram;
    }
  }
  // A weak smoothness term decides where nothing was seen.
  const double weak = 1e-6 * normal.diagonal().mean();
  for (Index b = 0; b + 2 * terms < size; ++b) {
    const Index index[3] = {b, b + terms, b + 2 * terms};
    const double weight[3] = {1, -2, 1};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) normal(index[i], index[j]) += weak * weight[i] * weight[j];
  }
  const Eigen::LDLT<MatrixXd> factor(normal);
  const VectorXd coefficients = factor.solve(right), noise_coefficients = factor.solve(right_noise);

  // simulated - measured = d: the true motion is the simulated one minus d, so the sign turns.
  const auto moments_of = [&](const VectorXd& solution) {
    MatrixXd moment(n, frames);
    VectorXd a(coordinates), dr(coordinates), zero_p = VectorXd::Zero(parameters.size());
    VectorXd u = VectorXd::Zero(3 * equations.signals()), zero_u = u;
    VectorXd zero_z = VectorXd::Zero(equations.states());
    for (Index k = 0; k < frames; ++k) {
      const double t = time[static_cast<std::size_t>(k)];
      const Splines s = splines_at(t, begin, force.resolution, splines);
      VectorXd dq = VectorXd::Zero(coordinates), dv = dq, da = dq;
      for (int i = 0; i < 4; ++i) {
        const VectorXd shape = basis * solution.segment((s.first + i) * terms, terms);
        dq.head(n) -= s.value[i] * shape;
        dv.head(n) -= s.rate[i] * shape;
        da.head(n) -= s.acceleration[i] * shape;
      }
      const Index j = column[static_cast<std::size_t>(k)];
      const VectorXd q = path.q.col(j), v = path.v.col(j), z = path.z.col(j);
      if (u.size() > 0) experiment.signals.evaluate(t, u.data());
      catena_point at{t, q.data(), v.data(), a.data(), z.data(), u.data(), parameters.data()};
      if (equations.acceleration(at, a.data()) != 0) a.setZero();
      const catena_point differential{
          0, dq.data(), dv.data(), da.data(), zero_z.data(), zero_u.data(), zero_p.data()};
      equations.residual_tangent(at, differential, dr.data());
      double sum = 0;
      for (Index i = n - 1; i >= 0; --i) moment(i, k) = sum += dr[i];
    }
    return moment;
  };
  // Second derivatives of splines mean little near the ends, where only one side holds them.
  Index first = 0, last = frames;
  const double margin = kEndKnots * force.resolution;
  while (first + 1 < last && time[static_cast<std::size_t>(first)] < time.front() + margin) ++first;
  while (last > first + 1 && time[static_cast<std::size_t>(last - 1)] > time.back() - margin)
    --last;
  if (last - first < frames / 4) first = 0, last = frames;
  time = std::vector<double>(time.begin() + first, time.begin() + last);
  column = std::vector<Index>(column.begin() + first, column.begin() + last);
  frames = last - first;
  force.time = time;
  force.moment = moments_of(coefficients);
  force.noise = std::sqrt(mean_square(moments_of(noise_coefficients)));

  // On what does the moment of the worst joint depend?
  Index worst = 0;
  for (Index i = 1; i < n; ++i)
    if (force.moment.row(i).squaredNorm() > force.moment.row(worst).squaredNorm()) worst = i;
  const VectorXd y = force.moment.row(worst).transpose();
  VectorXd angle(frames), rate(frames);
  MatrixXd ends(frames, 4);
  for (Index k = 0; k < frames; ++k) {
    const Index j = column[static_cast<std::size_t>(k)];
    angle[k] = path.q(worst, j);
    rate[k] = path.v(worst, j);
    const VectorXd q = path.q.col(j), v = path.v.col(j);
    const Positions at =
        positions(equations, parameters, time[static_cast<std::size_t>(k)], q, experiment.signals);
    const Positions speed = velocities(equations, parameters, time[static_cast<std::size_t>(k)], q,
                                       v, experiment.signals);
    ends.row(k) << at.side[n + 1], at.down[n + 1], speed.side[n + 1], speed.down[n + 1];
  }
  const auto depends = [&](const std::string& on, const MatrixXd& columns) {
    force.dependence.push_back({on, explained(y, columns)});
  };
  MatrixXd pair(frames, 2), three(frames, 3);
  three << ends.col(0), ends.col(1), VectorXd::Ones(frames);
  depends("position of the load", three);
  pair << ends.col(2), ends.col(3);
  depends("velocity of the load", pair);
  const VectorXd speed = (ends.col(2).array().square() + ends.col(3).array().square()).sqrt();
  pair << ends.col(2).cwiseProduct(speed), ends.col(3).cwiseProduct(speed);
  depends("speed times velocity of the load", pair);
  depends("direction of the rate of the joint", rate.array().tanh().matrix());
  depends("a constant", VectorXd::Ones(frames));
  double harmonic = 0, at_frequency = 0;
  for (double f = 1 / span; f < 8; f += 0.25 / span) {
    for (Index k = 0; k < frames; ++k) {
      const double phase = 2 * std::numbers::pi * f * time[static_cast<std::size_t>(k)];
      pair.row(k) << std::sin(phase), std::cos(phase);
    }
    const double share = explained(y, pair);
    if (share > harmonic) harmonic = share, at_frequency = f;
  }
  force.dependence.push_back({fmt::format("time, harmonic at {:.3g} Hz", at_frequency), harmonic});
  // A short event: the tenth of the time that holds most of it.
  const Index window = std::max<Index>(3, frames / 10);
  double most = 0;
  Index when = 0;
  for (Index k = 0; k + window <= frames; ++k)
    if (y.segment(k, window).squaredNorm() > most)
      most = y.segment(k, window).squaredNorm(), when = k + window / 2;
  force.dependence.push_back(
      {fmt::format("time, an event about {:.3g} s", time[static_cast<std::size_t>(when)]),
       y.squaredNorm() > 0 ? most / y.squaredNorm() : 0});
  std::stable_sort(force.dependence.begin(), force.dependence.end(),
                   [](const auto& a, const auto& b) { return a.share > b.share; });
  force.words.push_back(fmt::format(
      "the missing moment is largest at joint {}: {:.3g} N m rms against {:.2g} N m "
      "from noise alone",
      worst + 1, std::sqrt(y.squaredNorm() / static_cast<double>(frames)), force.noise));
  for (std::size_t i = 0; i < 2 && i < force.dependence.size(); ++i)
    force.words.push_back(fmt::format("{:.0f} % of it goes with {}",
                                      100 * force.dependence[i].share, force.dependence[i].on));
  return force;
}

}  // namespace catena
