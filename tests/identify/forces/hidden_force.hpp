// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Cholesky>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "identify/cases/case_reader.hpp"
#include "identify/diagnosis/fitted_model.hpp"
#include "identify/forces/force_history.hpp"
#include "identify/forces/interval_map.hpp"
#include "identify/forces/missing_force.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "identify/problem/parameter_map.hpp"
#include "linear_algebra/decompositions.hpp"
#include "runtime/any_links.hpp"
#include "tests/identify/recordings.hpp"
#include "truth/files.hpp"
#include "truth/film_camera.hpp"

namespace catena::testing {

/// How a recording is made: released from rest, from the shape of a hanging cable or from `angles`.
struct Film {
  truth::Camera camera;
  int links = 24, case_links = 24;
  double held_side = 1.2,
         held_down = 2.0;      ///< m, of the end before its release: a tenth of the cable is slack
  std::vector<double> angles;  ///< rad, of the links

  truth::Cable cable() const {
    truth::Cable cable;
    cable.links = links;
    return cable;
  }
  std::vector<double> start() const {
    return angles.empty() ? truth::catenary_angles(cable(), held_side, held_down) : angles;
  }
};

/// Arc length at which the hidden spring to the wall acts, m.
inline double true_place(const Film& film) {
  const truth::Cable cable = film.cable();
  return (film.links / 2 - 0.5) * cable.length / film.links;
}

struct Filmed {
  Film film;
  Case the_case;
  Recording recording;
  /// Legendre modes 0 and 1 of the density normal to the cable that gusts push with, 2 x frames, N/m.
  Eigen::MatrixXd gust_modes;

  FittedModel baseline() const {
    const auto problem = std::make_shared<const Problem>(the_case, any_links_model(film.case_links),
                                                         std::vector<Recording>{recording});
    return fit_model(problem, problem->start(), {}, fit_least_squares, nullptr);
  }
};

/// All frames are fitted.
inline Filmed film(const Film& film, const truth::Hidden& hidden) {
  const truth::Cable cable = film.cable();
  const truth::Recording seen = truth::film(cable, hidden, film.start(), film.camera);
  // The recording is handed in: no file to read.
  std::string text = truth::case_text(cable, film.camera,
                                      {.links = film.case_links, .recordings = {"markers.csv"}});
  const std::size_t experiment = text.find("[[experiment]]");
  text.erase(experiment, text.find("[error]") - experiment);
  Filmed filmed{film, parse_case(text, "case.toml", ""), {}, {}};
  add_experiment(filmed.the_case, "run");
  Recording& recording = filmed.recording;
  recording.time = seen.time;
  recording.fit_frames = static_cast<Eigen::Index>(seen.time.size());
  recording.measured.resize(static_cast<Eigen::Index>(2 * seen.arc.size()), recording.fit_frames);
  for (std::size_t p = 0; p < seen.arc.size(); ++p) {
    PointSpec point;
    point.name = "marker " + std::to_string(p + 1);
    point.arc_length = seen.arc[p];
    recording.points.push_back(point);
    recording.channels.push_back({static_cast<int>(p), Component::kSide, point.name + " side"});
    recording.channels.push_back({static_cast<int>(p), Component::kDown, point.name + " down"});
    for (std::size_t k = 0; k < seen.time.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(2 * p), frame = static_cast<Eigen::Index>(k);
      recording.measured(row, frame) = seen.side[k][p];
      recording.measured(row + 1, frame) = seen.down[k][p];
    }
  }
  return filmed;
}

/// Force of the hidden spring on the cable, to the side, N.
inline Eigen::VectorXd true_force(const Filmed& filmed, const truth::Hidden& hidden,
                                  const std::vector<double>& time) {
  const truth::Motion motion = truth::move(filmed.film.cable(), hidden, filmed.film.start(),
                                           {true_place(filmed.film)}, time);
  Eigen::VectorXd force(static_cast<Eigen::Index>(time.size()));
  for (std::size_t k = 0; k < time.size(); ++k)
    force[static_cast<Eigen::Index>(k)] =
        -hidden.wall_spring * (motion.side[k][0] - hidden.wall_side);
  return force;
}

/// A force in time that follows no law: `size` times the sum of five oscillations of 0.3 to 2.3 Hz with phases of the
/// seed, or a draw of the prior that missing forces have.
struct Gusts {
  double size = 0;
  unsigned seed = 1;
  bool spread = false;  ///< along the whole cable instead of at its middle
  bool drawn = false;   ///< a draw of the prior, of deviation `size`, instead of the sum

  /// The force and its rate, N and N/s, one column per time.
  Eigen::MatrixXd at(const std::vector<double>& time) const {
    Eigen::MatrixXd forces(2, static_cast<Eigen::Index>(time.size()));
    std::seed_seq own{seed, 1U};  // not that of the noise
    std::mt19937_64 random(own);
    std::normal_distribution<double> normal;
    const ForcePrior prior;
    Eigen::Vector2d state = Eigen::Vector2d::Zero();
    for (std::size_t k = 0; k < time.size(); ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      if (!drawn) {
        forces.col(column) << sum(time[k], false), sum(time[k], true);
        continue;
      }
      Eigen::Matrix2d from_before = Eigen::Matrix2d::Zero();
      if (k > 0) from_before = prior.transition(time[k] - time[k - 1]);
      const Eigen::Matrix2d added =
          (Eigen::Matrix2d::Identity() - from_before * from_before.transpose()).llt().matrixL();
      const double first = normal(random), second = normal(random);
      state = (from_before * state + added * Eigen::Vector2d(first, second)).eval();
      forces.col(column) << size * state[0], size * prior.rate() * state[1];
    }
    return forces;
  }

 private:
  double sum(double t, bool differentiated) const {
    std::mt19937_64 random(seed);
    double sum = 0;
    for (int j = 0; j < 5; ++j) {
      const double turn = 2 * std::numbers::pi * static_cast<double>(random() >> 11) * 0x1p-53;
      const double frequency = 2 * std::numbers::pi * (0.3 + 0.5 * j);  // rad/s
      sum += differentiated ? frequency * std::cos(frequency * t + turn)
                            : std::sin(frequency * t + turn);
    }
    return size * sum;
  }
};

/// The same film where gusts push the cable to the side, made by the model of the case.
inline void push(Filmed& filmed, const Gusts& gusts) {
  const Problem problem(filmed.the_case, any_links_model(filmed.film.case_links),
                        std::vector<Recording>{filmed.recording});
  const Eigen::VectorXd parameters = problem.model_parameters(problem.start(), 0);
  const Eigen::VectorXd lengths = link_lengths(problem.model(), parameters);
  const double length = lengths.sum();
  const Eigen::VectorXd constant = Eigen::VectorXd::Constant(lengths.size(), 1 / length);
  const std::vector<ForcePattern> patterns = {
      gusts.spread ? density_pattern(ForceDirection::kSide, "constant", constant, {lengths})
                   : point_pattern(ForceDirection::kSide, 0.5 * length, {lengths})};
  IntervalIntegrator integrate(problem.model(), parameters, problem.experiments()[0].signals,
                               patterns, {}, 1.0 / 960);
  const std::vector<double> start = filmed.film.start();
  Eigen::VectorXd state = Eigen::VectorXd::Zero(2 * lengths.size());
  for (Eigen::Index k = 0; k < lengths.size(); ++k) state[k] = start[static_cast<std::size_t>(k)];
  Recording& recording = filmed.recording;
  const Eigen::MatrixXd forces = gusts.at(recording.time);
  filmed.gust_modes.resize(2, static_cast<Eigen::Index>(recording.time.size()));
  std::mt19937_64 random(filmed.film.camera.seed);
  std::normal_distribution<double> noise(0, filmed.film.camera.noise);
  for (std::size_t frame = 0; frame < recording.time.size(); ++frame) {
    for (std::size_t p = 0; p < recording.points.size(); ++p) {
      const Eigen::ArrayXd reach =
          point_pattern(ForceDirection::kSide, recording.points[p].arc_length, {lengths})
              .carried.col(0)
              .array() *
          lengths.array();
      const auto row = static_cast<Eigen::Index>(2 * p), column = static_cast<Eigen::Index>(frame);
      const Eigen::ArrayXd angles = state.head(lengths.size()).array();
      recording.measured(row, column) = (reach * angles.sin()).sum() + noise(random);
      recording.measured(row + 1, column) = (reach * angles.cos()).sum() + noise(random);
    }
    // Of the density to the side times the cosine of the angle.
    const Eigen::ArrayXd across = state.head(lengths.size()).array().cos();
    const Eigen::ArrayXd from_middle = 2 * link_middles(lengths).array() / length - 1;
    const auto column = static_cast<Eigen::Index>(frame);
    const double density = forces(0, column) / length;
    const Eigen::ArrayXd weights = lengths.array() / length;
    filmed.gust_modes(0, column) = density * (weights * across).sum();
    filmed.gust_modes(1, column) = 3 * density * (weights * across * from_middle).sum();
    if (frame + 1 == recording.time.size()) break;
    const auto next =
        integrate(recording.time[frame], recording.time[frame + 1], state, forces.col(column));
    if (!next) throw std::runtime_error("the gusts cannot be followed");
    state = next->end;
  }
}

struct Recovery {
  double error = 0;    ///< root mean square below 2 Hz, over that of the truth
  double covered = 0;  ///< share of the times at which the interval of 95 % holds the truth
};

/// The part below 2 Hz, of the columns.
inline Eigen::MatrixXd slow_part(const Eigen::MatrixXd& columns, const std::vector<double>& time) {
  constexpr double kHighest = 2;  // Hz
  const double span = time.back() - time.front();
  const auto count = static_cast<Eigen::Index>(2 * kHighest * span) + 1;
  Eigen::MatrixXd cosines(columns.rows(), count);
  for (Eigen::Index k = 0; k < columns.rows(); ++k)
    for (Eigen::Index j = 0; j < count; ++j)
      cosines(k, j) = std::cos(std::numbers::pi * static_cast<double>(j) *
                               (time[static_cast<std::size_t>(k)] - time.front()) / span);
  return cosines * least_squares(cosines, columns);
}

/// Of rows of a history against the truth, rows x times.
inline Recovery recovery(const Eigen::MatrixXd& size, const Eigen::MatrixXd& deviation,
                         const Eigen::MatrixXd& truth, const std::vector<double>& time) {
  const Eigen::MatrixXd slow = slow_part((size - truth).transpose(), time);
  const Eigen::MatrixXd whole = slow_part(truth.transpose(), time);
  Recovery recovery;
  recovery.error = slow.norm() / whole.norm();
  recovery.covered =
      ((size - truth).array().abs() < 1.96 * deviation.array()).cast<double>().mean();
  return recovery;
}

/// What forces along the whole chain are shown as: means with the weights of a raised cosine (force_history.hpp).
inline Eigen::MatrixXd means_over_time(const Eigen::MatrixXd& rows,
                                       const std::vector<double>& time) {
  const auto times = static_cast<Eigen::Index>(time.size());
  const Eigen::RowVectorXd at = Eigen::RowVectorXd::Map(time.data(), times);
  Eigen::MatrixXd means(rows.rows(), times);
  for (Eigen::Index k = 0; k < times; ++k) {
    const Eigen::ArrayXd away = ((at.array() - at[k]).abs() / kMeanReach).min(1.0).transpose();
    const Eigen::VectorXd weights = 1 + (std::numbers::pi * away).cos();
    means.col(k) = rows * weights / weights.sum();
  }
  return means;
}

/// Of the two lowest modes of the density normal to the cable: of gusts along all of it, or of the
/// hidden spring at a point.
inline Recovery recovery_of_modes(const Filmed& filmed, const truth::Hidden& hidden,
                                  const MissingForce& found) {
  const auto& history = found.everywhere.at(0);
  const MissingForce::OverTime& modes = history.normal_modes.at(0);
  if (filmed.gust_modes.size() > 0)
    return recovery(modes.value, modes.deviation, means_over_time(filmed.gust_modes, history.time),
                    history.time);
  const Eigen::VectorXd force = true_force(filmed, hidden, history.time);
  const double length = filmed.film.cable().length, place = true_place(filmed.film);
  const truth::Motion motion =
      truth::move(filmed.film.cable(), hidden, filmed.film.start(), {place}, history.time);
  Eigen::MatrixXd truth(2, force.size());
  for (Eigen::Index k = 0; k < force.size(); ++k) {
    truth(0, k) = force[k] * std::cos(motion.angle[static_cast<std::size_t>(k)][0]) / length;
    truth(1, k) = 3 * (2 * place / length - 1) * truth(0, k);
  }
  return recovery(modes.value, modes.deviation, means_over_time(truth, history.time), history.time);
}

/// Of the side force at the place that was found.
inline Recovery recovery_at_place(const Filmed& filmed, const truth::Hidden& hidden,
                                  const MissingForce& found) {
  const auto& history = found.at_best.at(0);
  const Eigen::MatrixXd truth = true_force(filmed, hidden, history.time).transpose();
  return recovery(history.size.topRows(1), history.deviation.topRows(1), truth, history.time);
}

/// 2 s of a cable of six links with six markers.
inline Film short_film() {
  Film film;
  film.links = film.case_links = 6;
  film.camera.duration = 2;
  film.camera.markers = 6;
  return film;
}

inline MissingForce force_in(const Filmed& filmed) {
  const FittedModel baseline = filmed.baseline();
  if (!baseline.ok) throw std::runtime_error("the fit without a force failed");
  return missing_force(*baseline.problem, baseline.x, {filmed.film.camera.noise});
}

}  // namespace catena::testing
