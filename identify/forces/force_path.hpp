// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "identify/forces/force_smoother.hpp"
#include "identify/problem/observer.hpp"
#include "identify/problem/problem.hpp"

namespace catena {

/// Unknowns of a problem as a filter wants them: each with a normal prior, numbers that must stay
/// positive by their logarithm. Latent forces can imitate any parameter, so that without a prior
/// stiffness and damping run to their bounds beside them.
class LatentUnknowns {
 public:
  /// Priors about x; those of the case where it has some. `problem` must outlive it.
  LatentUnknowns(const Problem& problem, const Eigen::VectorXd& x);

  /// Unknowns of all experiments, and those of one.
  const std::vector<Eigen::Index>& shared() const { return shared_; }
  std::vector<Eigen::Index> own(int experiment) const;
  /// Prior of these, relative to x.
  Eigen::VectorXd mean(const std::vector<Eigen::Index>& which, const Eigen::VectorXd& x) const;
  Eigen::VectorXd deviation(const std::vector<Eigen::Index>& which) const;
  /// Derivatives of x by the filter's number.
  double slope(Eigen::Index unknown, const Eigen::VectorXd& x) const {
    return logarithmic_[static_cast<std::size_t>(unknown)] ? x[unknown] : 1.0;
  }
  /// x[unknown] moved by so much of the filter's number, within the bounds.
  double moved(Eigen::Index unknown, double value, double by) const;

 private:
  const Problem& problem_;
  Eigen::VectorXd centre_;     // x, or what was measured before
  Eigen::VectorXd deviation_;  // in the filter's numbers
  std::vector<bool> logarithmic_;
  std::vector<Eigen::Index> shared_;
};

/// The motion of one recording as nodes that need not follow from each other, at the times of the
/// frames, and the forces between them.
struct ForcePath {
  int experiment = 0;
  Eigen::MatrixXd state;  ///< (q, v, z), one column per node
  Eigen::MatrixXd force;  ///< (w, dw/dt) of each pattern, one column per node
};

/// A motion of all recordings, forces and the values of the unknowns, iterated until it is the most
/// probable one.
class ForcePaths {
 public:
  /// Begins with the simulation at x. `problem`, `unknowns` and `keep_going` must outlive it.
  ForcePaths(const Problem& problem, const LatentUnknowns& unknowns,
             const std::vector<double>& sigmas, const Eigen::VectorXd& x,
             const std::function<bool()>& keep_going);

  /// The recording of a path, and its noise, m or rad.
  const Recording& recording(std::size_t path) const;
  double sigma(std::size_t path) const;
  /// A number that was measured, by its frame and channel.
  struct SeenValue {
    Eigen::Index frame = 0;
    std::size_t channel = 0;
  };
  /// Of each node, in the order of LinearRecording::Seen.
  std::vector<std::vector<SeenValue>> seen_values(std::size_t path) const;

  /// Whether there is a motion: the simulation at x succeeded.
  bool ok() const { return !paths_.empty(); }
  /// The unknowns of the problem; the motions; times of the nodes of one, s.
  const Eigen::VectorXd& x() const { return x_; }
  const std::vector<ForcePath>& paths() const { return paths_; }
  Eigen::Index coordinates() const { return problem_.model().coordinates(); }
  const std::vector<double>& times(std::size_t path) const { return clocks_[path].times; }

  /// Takes other patterns; forces begin at zero, the motion stays.
  void act(std::vector<ForcePattern> patterns);
  const std::vector<ForcePattern>& patterns() const { return patterns_; }

  /// With steps so many times finer than the estimate needs. Nothing where the equations cannot be
  /// followed or the work is to end.
  std::optional<LinearProblem> linearise(int finer = 1) const;

  /// Relinearises and smooths until nothing moves by more than a small part of the noise, and the
  /// variances (of the groups, updated) are those of the largest evidence below `largest`;
  /// `with_time_scale`: the prior's time scale, too. Nothing as linearise.
  std::optional<Smoothed> settle(std::vector<double>& variance, const std::vector<double>& largest,
                                 bool with_time_scale);

  /// Moves motion and unknowns to what was smoothed about them; `linear` may have more shared
  /// parameters behind those of the problem, and more states. The forces are those smoothed, none where none acted.
  /// Returns the root mean square change of what the sensors would see, in standard deviations.
  double move(const LinearProblem& linear, const Smoothed& smoothed);

  /// Takes forces that go straight from node to node: patterns x nodes, of each recording.
  void take_forces(const std::vector<Eigen::MatrixXd>& forces);

  /// Sum of the squared residuals, in units of the noise.
  double squares() const;

  ForcePrior prior;

 private:
  std::vector<LinearRecording::Seen> observe(std::size_t path,
                                             const std::vector<Eigen::Index>& unknowns) const;
  void rescale(const LinearProblem& linear, const std::vector<ActingForce>& acting,
               const std::vector<double>& largest, std::vector<double>& variance);

  const Problem& problem_;
  const LatentUnknowns& unknowns_;
  const std::vector<double>& sigmas_;
  const std::function<bool()>& keep_going_;
  Eigen::VectorXd x_;
  std::vector<ForcePattern> patterns_;
  std::vector<ForcePath> paths_;
  std::vector<FrameClock> clocks_;
};

}  // namespace catena
