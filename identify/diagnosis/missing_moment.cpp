// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/missing_moment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include "identify/diagnosis/residual_places.hpp"
#include "identify/problem/initial_state.hpp"
#include "linear_algebra/decompositions.hpp"
#include "runtime/positions.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr Index kFewestFramesOfMoment = 30;
constexpr Index kMostTerms = 6;            // polynomials along the cable
constexpr Index kMostCoefficients = 1500;  // their matrix is dense
constexpr double kFramesPerKnot = 10;
constexpr double kClosestKnots = 0.05;  // s
constexpr double kEndKnots =
    2;  // distances of knots: nearer to an end only one side holds a spline
constexpr double kSmoothing = 1e-6;     // of the mean diagonal: decides where nothing was seen
constexpr double kHighestHarmonic = 8;  // Hz, of a harmonic dependence
constexpr Index kEventShare = 10;       // an event takes a tenth of the time

/// The simulated motion at the frames of one experiment.
struct Path {
  const Model& model;
  const Experiment& experiment;
  VectorXd parameters;
  Trajectory trajectory;
  std::vector<double> time;   // of the frames
  std::vector<Index> column;  // of the trajectory, for every frame

  Index frames() const { return static_cast<Index>(time.size()); }
  double at(Index frame) const { return time[static_cast<std::size_t>(frame)]; }
  VectorXd q(Index frame) const { return trajectory.q.col(column_of(frame)); }
  VectorXd v(Index frame) const { return trajectory.v.col(column_of(frame)); }
  VectorXd z(Index frame) const { return trajectory.z.col(column_of(frame)); }
  Index column_of(Index frame) const { return column[static_cast<std::size_t>(frame)]; }
};

std::optional<Path> path_of(const FittedModel& fitted, int e) {
  const Problem& problem = *fitted.problem;
  const Experiment& experiment = problem.experiments()[static_cast<std::size_t>(e)];
  Prediction prediction = problem.predict(fitted.x, e, true);
  if (!prediction.ok()) return std::nullopt;
  Path path{problem.model(),
            experiment,
            problem.model_parameters(fitted.x, e),
            std::move(prediction.trajectory),
            experiment.recording.time,
            {}};
  const std::vector<double>& simulated = path.trajectory.time;
  for (const double t : path.time) {
    const auto found = std::lower_bound(simulated.begin(), simulated.end(), t - 1e-9);
    path.column.push_back(std::min<Index>(found - simulated.begin(), path.trajectory.q.cols() - 1));
  }
  return path;
}

/// Cubic B-splines on uniform knots.
struct Knots {
  double begin = 0, step = 0;  // s
  Index splines = 0;
};

Knots knots_of(const Path& path) {
  const double span = path.time.back() - path.time.front();
  const double frame = span / static_cast<double>(path.frames() - 1);
  const double wanted = std::max(kFramesPerKnot * frame, kClosestKnots);
  const Index pieces = std::max<Index>(4, static_cast<Index>(std::floor(span / wanted)));
  return {path.time.front(), span / static_cast<double>(pieces), pieces + 3};
}

/// Value and first two derivatives of the four splines that are not zero at a time, the first with
/// number `first`.
struct Splines {
  Index first = 0;
  double value[4], rate[4], acceleration[4];
};

Splines splines_at(double t, const Knots& knots) {
  Splines s;
  const double x = (t - knots.begin) / knots.step;
  s.first = std::clamp<Index>(static_cast<Index>(std::floor(x)), 0, knots.splines - 4);
  const double u = x - static_cast<double>(s.first), w = 1 - u;
  const double value[4] = {w * w * w / 6, (3 * u * u * u - 6 * u * u + 4) / 6,
                           (3 * w * w * w - 6 * w * w + 4) / 6, u * u * u / 6};
  const double rate[4] = {-w * w / 2, (3 * u * u - 4 * u) / 2, (4 * w - 3 * w * w) / 2, u * u / 2};
  const double acceleration[4] = {w, 3 * u - 2, 3 * w - 2, u};
  for (int j = 0; j < 4; ++j) {
    s.value[j] = value[j];
    s.rate[j] = rate[j] / knots.step;
    s.acceleration[j] = acceleration[j] / (knots.step * knots.step);
  }
  return s;
}

/// Polynomials of the angles along the cable, links x terms: as many as the points can tell apart.
MatrixXd angle_shapes(const Path& path) {
  const Index n = path.model.links();
  const VectorXd lengths = path.parameters.segment(path.model.parameter_index("length_1"), n);
  const auto seen = static_cast<Index>(path.experiment.recording.points.size());
  const Index terms = std::min({n, seen, kMostTerms});
  return shape_basis(Shape::kSmooth, static_cast<int>(n), static_cast<int>(terms), lengths);
}

/// How a channel changes where the positions change by `moved` and the angles by `angles`.
double channel_change(const Path& path, const Channel& channel, const Positions& moved,
                      const VectorXd& angles) {
  const PointSpec& point =
      path.experiment.recording.points[static_cast<std::size_t>(channel.point)];
  if (channel.component == Component::kAngle) return angles[point.link - 1];
  const VectorXd& component = channel.component == Component::kSide ? moved.side : moved.down;
  if (point.load) return component[path.model.links() + 1];
  if (point.joint > 0) return component[point.joint];
  const MaterialPoint place = point_at_arc_length(path.model, path.parameters, point.arc_length);
  return (1 - place.fraction) * component[place.link] + place.fraction * component[place.link + 1];
}

/// Derivatives of the channels at a frame by the coefficients of the shapes: channels x terms.
MatrixXd channel_changes(const Path& path, const MatrixXd& shapes, Index frame) {
  const auto& channels = path.experiment.recording.channels;
  MatrixXd changes(static_cast<Index>(channels.size()), shapes.cols());
  for (Index m = 0; m < shapes.cols(); ++m) {
    VectorXd direction = VectorXd::Zero(path.model.coordinates());
    direction.head(shapes.rows()) = shapes.col(m);
    const Positions moved = positions_tangent(path.model, path.parameters, path.at(frame),
                                              path.q(frame), VectorXd::Zero(path.parameters.size()),
                                              direction, path.experiment.signals);
    for (std::size_t c = 0; c < channels.size(); ++c)
      changes(static_cast<Index>(c), m) = channel_change(path, channels[c], moved, shapes.col(m));
  }
  return changes;
}

/// A weak smoothness term decides where nothing was seen.
void smooth(MatrixXd& normal, Index terms) {
  const double weak = kSmoothing * normal.diagonal().mean();
  for (Index b = 0; b + 2 * terms < normal.rows(); ++b) {
    const Index index[3] = {b, b + terms, b + 2 * terms};
    const double weight[3] = {1, -2, 1};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) normal(index[i], index[j]) += weak * weight[i] * weight[j];
  }
}

/// Coefficients of shapes times splines.
struct Difference {
  VectorXd of_residuals, of_noise;
};

/// Least squares through all residuals, and through as much white noise.
Difference fit_difference(const Path& path, const MatrixXd& shapes, const Knots& knots,
                          const MatrixXd& residual, double sigma) {
  const Index terms = shapes.cols(), size = knots.splines * terms;
  MatrixXd normal = 1e-9 * MatrixXd::Identity(size, size);
  VectorXd right = VectorXd::Zero(size), right_noise = VectorXd::Zero(size);
  std::mt19937_64 random(1);
  std::normal_distribution<double> gauss(0, sigma);
  for (Index k = 0; k < path.frames(); ++k) {
    const MatrixXd changes = channel_changes(path, shapes, k);
    const Splines s = splines_at(path.at(k), knots);
    MatrixXd gram = MatrixXd::Zero(terms, terms);
    VectorXd project = VectorXd::Zero(terms), project_noise = VectorXd::Zero(terms);
    for (Index c = 0; c < residual.rows(); ++c) {
      if (std::isnan(residual(c, k))) continue;
      const VectorXd row = changes.row(c);
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
  smooth(normal, terms);
  const SymmetricFactors factors(normal);
  return {factors.solve(right), factors.solve(right_noise)};
}

/// Without the frames near the ends, where second derivatives of splines mean little.
Path without_ends(Path path, const Knots& knots) {
  Index first = 0, last = path.frames();
  const double margin = kEndKnots * knots.step;
  while (first + 1 < last && path.at(first) < path.time.front() + margin) ++first;
  while (last > first + 1 && path.at(last - 1) > path.time.back() - margin) --last;
  if (last - first < path.frames() / 4) first = 0, last = path.frames();
  path.time = std::vector<double>(path.time.begin() + first, path.time.begin() + last);
  path.column = std::vector<Index>(path.column.begin() + first, path.column.begin() + last);
  return path;
}

/// The moments (joints x frames, N m) that make up a difference. Throws std::runtime_error where
/// the accelerations of the simulated motion cannot be solved for.
MatrixXd moments_of(const Path& path, const MatrixXd& shapes, const Knots& knots,
                    const VectorXd& difference) {
  const Model& model = path.model;
  const Index n = model.links(), terms = shapes.cols();
  MatrixXd moment(n, path.frames());
  VectorXd a(model.coordinates()), dr(model.coordinates());
  VectorXd u = VectorXd::Zero(3 * model.signals());
  const VectorXd zero_u = u, zero_z = VectorXd::Zero(model.states());
  const VectorXd zero_p = VectorXd::Zero(path.parameters.size());
  for (Index k = 0; k < path.frames(); ++k) {
    const double t = path.at(k);
    const Splines s = splines_at(t, knots);
    VectorXd dq = VectorXd::Zero(model.coordinates()), dv = dq, da = dq;
    // simulated - measured = d: the true motion is the simulated one minus d, so the sign turns.
    for (int i = 0; i < 4; ++i) {
      const VectorXd shape = shapes * difference.segment((s.first + i) * terms, terms);
      dq.head(n) -= s.value[i] * shape;
      dv.head(n) -= s.rate[i] * shape;
      da.head(n) -= s.acceleration[i] * shape;
    }
    const VectorXd q = path.q(k), v = path.v(k), z = path.z(k);
    if (u.size() > 0) path.experiment.signals.evaluate(t, u.data());
    const catena_point at{
        t, q.data(), v.data(), a.data(), z.data(), u.data(), path.parameters.data()};
    if (const int pivot = model.acceleration(at, a.data()))
      throw std::runtime_error(
          fmt::format("the mass matrix is not positive definite at {}, t = {:.4g} s",
                      model.table().coordinate[pivot - 1].name, t));
    const catena_point differential{
        0, dq.data(), dv.data(), da.data(), zero_z.data(), zero_u.data(), zero_p.data()};
    model.residual_tangent(at, differential, dr.data());
    double sum = 0;
    for (Index i = n - 1; i >= 0; --i) moment(i, k) = sum += dr[i];
  }
  return moment;
}

Index largest_row(const MatrixXd& moment) {
  Index worst = 0;
  for (Index i = 1; i < moment.rows(); ++i)
    if (moment.row(i).squaredNorm() > moment.row(worst).squaredNorm()) worst = i;
  return worst;
}

/// Share of the mean square of y (zero where unknown) that columns explain by least squares.
double explained(const VectorXd& y, const MatrixXd& columns) {
  const MatrixXd normal =
      columns.transpose() * columns +
      1e-12 * columns.squaredNorm() * MatrixXd::Identity(columns.cols(), columns.cols());
  const VectorXd right = columns.transpose() * y;
  return y.squaredNorm() > 0 ? right.dot(solve_symmetric(normal, right)) / y.squaredNorm() : 0;
}

using Dependence = MissingMoment::Dependence;

/// On where and how fast the load and the joint `worst` are.
void depend_on_motion(const Path& path, Index worst, const VectorXd& y,
                      std::vector<Dependence>& out) {
  const Index n = path.model.links(), frames = path.frames();
  VectorXd rate(frames);
  MatrixXd ends(frames, 4);
  for (Index k = 0; k < frames; ++k) {
    rate[k] = path.trajectory.v(worst, path.column_of(k));
    const VectorXd q = path.q(k), v = path.v(k);
    const Positions at =
        positions(path.model, path.parameters, path.at(k), q, path.experiment.signals);
    const Positions speed =
        velocities(path.model, path.parameters, path.at(k), q, v, path.experiment.signals);
    ends.row(k) << at.side[n + 1], at.down[n + 1], speed.side[n + 1], speed.down[n + 1];
  }
  MatrixXd pair(frames, 2), three(frames, 3);
  three << ends.col(0), ends.col(1), VectorXd::Ones(frames);
  out.push_back({"position of the load", explained(y, three)});
  pair << ends.col(2), ends.col(3);
  out.push_back({"velocity of the load", explained(y, pair)});
  const VectorXd speed = (ends.col(2).array().square() + ends.col(3).array().square()).sqrt();
  pair << ends.col(2).cwiseProduct(speed), ends.col(3).cwiseProduct(speed);
  out.push_back({"speed times velocity of the load", explained(y, pair)});
  out.push_back({"direction of the rate of the joint", explained(y, rate.array().tanh().matrix())});
  out.push_back({"a constant", explained(y, VectorXd::Ones(frames))});
}

/// The best harmonic; `span`: of the whole recording, s.
Dependence harmonic(const Path& path, double span, const VectorXd& y) {
  MatrixXd pair(path.frames(), 2);
  double best = 0, at_frequency = 0;
  const auto end = static_cast<int>(std::ceil(4 * span * kHighestHarmonic));
  for (int quarters = 4; quarters < end; ++quarters) {
    const double f = 0.25 * quarters / span;
    for (Index k = 0; k < path.frames(); ++k) {
      const double phase = 2 * std::numbers::pi * f * path.at(k);
      pair.row(k) << std::sin(phase), std::cos(phase);
    }
    const double share = explained(y, pair);
    if (share > best) best = share, at_frequency = f;
  }
  return {fmt::format("time, harmonic at {:.3g} Hz", at_frequency), best};
}

/// A short event: the part of the time that holds most of it.
Dependence event(const Path& path, const VectorXd& y) {
  const Index window = std::max<Index>(3, path.frames() / kEventShare);
  double most = 0;
  Index when = 0;
  for (Index k = 0; k + window <= path.frames(); ++k)
    if (y.segment(k, window).squaredNorm() > most)
      most = y.segment(k, window).squaredNorm(), when = k + window / 2;
  return {fmt::format("time, an event about {:.3g} s", path.at(when)),
          y.squaredNorm() > 0 ? most / y.squaredNorm() : 0};
}

void describe(const VectorXd& y, Index worst, MissingMoment& missing) {
  missing.words.push_back(fmt::format(
      "the missing moment is largest at joint {}: {:.3g} N m rms against {:.2g} N m "
      "from noise alone",
      worst + 1, std::sqrt(y.squaredNorm() / static_cast<double>(y.size())), missing.noise));
  for (std::size_t i = 0; i < 2 && i < missing.dependence.size(); ++i)
    missing.words.push_back(fmt::format("{:.0f} % of it goes with {}",
                                        100 * missing.dependence[i].share,
                                        missing.dependence[i].on));
}

}  // namespace

MissingMoment missing_moment(const FittedModel& model, const std::vector<double>& sigmas) {
  MissingMoment missing;
  std::size_t e = 0;
  while (e + 1 < model.fit_residual.size() && model.fit_residual[e].cols() == 0) ++e;
  missing.experiment = static_cast<int>(e);
  const Experiment& experiment = model.problem->experiments()[e];
  const MatrixXd residual = model.predicted[e] - experiment.recording.measured;
  if (residual.cols() < kFewestFramesOfMoment) return missing;
  const std::optional<Path> path = path_of(model, missing.experiment);
  if (!path) return missing;
  const MatrixXd shapes = angle_shapes(*path);
  const Knots knots = knots_of(*path);
  missing.resolution = knots.step;
  if (knots.splines * shapes.cols() > kMostCoefficients) return missing;
  const Difference difference = fit_difference(*path, shapes, knots, residual, sigmas[e]);

  const Path inner = without_ends(*path, knots);
  try {
    missing.moment = moments_of(inner, shapes, knots, difference.of_residuals);
    missing.noise = std::sqrt(mean_square(moments_of(inner, shapes, knots, difference.of_noise)));
  } catch (const std::runtime_error& error) {
    missing.moment.resize(0, 0);
    missing.words.push_back(std::string("the missing moment cannot be told: ") + error.what());
    return missing;
  }
  missing.time = inner.time;

  const Index worst = largest_row(missing.moment);
  const VectorXd y = missing.moment.row(worst).transpose();
  depend_on_motion(inner, worst, y, missing.dependence);
  missing.dependence.push_back(harmonic(inner, path->time.back() - path->time.front(), y));
  missing.dependence.push_back(event(inner, y));
  std::stable_sort(missing.dependence.begin(), missing.dependence.end(),
                   [](const Dependence& a, const Dependence& b) { return a.share > b.share; });
  describe(y, worst, missing);
  return missing;
}

}  // namespace catena
