// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/force_smoother.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace catena {

using Eigen::Index;
using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Sizes of the parts of a state: y, w, p.
struct Sizes {
  Index y, w, shared, own;
  Index p() const { return shared + own; }
  Index all() const { return y + w + p(); }
};

/// What the filter leaves at a node for the way back.
struct Node {
  VectorXd mean;               // before the measurement
  MatrixXd covariance;         // before the measurement
  MatrixXd observed, gain;     // H, K
  VectorXd weighted;           // S^-1 innovation
  MatrixXd weighted_observed;  // S^-1 H
};

class ChainFilter {
 public:
  ChainFilter(const LinearProblem& problem, const std::vector<ActingForce>& forces,
              const std::vector<double>& variance, const ForcePrior& prior, Index later)
      : problem_(problem), forces_(forces), variance_(variance), prior_(prior), later_(later) {}

  Smoothed run(bool smooth) {
    Smoothed out;
    out.growth.assign(variance_.size(), 1.0);
    VectorXd shared = problem_.shared_mean;
    MatrixXd shared_covariance =
        problem_.shared_deviation.array().square().matrix().asDiagonal().toDenseMatrix();
    for (const LinearRecording& recording : problem_.recordings) {
      nodes_.emplace_back();
      out.log_evidence += forward(recording, shared, shared_covariance, smooth);
    }
    out.shared = shared;
    out.shared_variance = shared_covariance.diagonal();
    if (smooth) backward(out);
    return out;
  }

 private:
  Sizes sizes(const LinearRecording& recording) const {
    return {recording.start_offset.size(), static_cast<Index>(2 * forces_.size()),
            problem_.shared_mean.size(), recording.own_mean.size()};
  }

  double variance(std::size_t force) const {
    return variance_[static_cast<std::size_t>(forces_[force].group)];
  }

  /// The columns of the acting patterns, by (w, w' / rate).
  MatrixXd by_force(const LinearRecording::Step& step) const {
    MatrixXd columns(step.by_force.rows(), static_cast<Index>(2 * forces_.size()));
    for (std::size_t f = 0; f < forces_.size(); ++f) {
      const auto column = static_cast<Index>(2 * f);
      columns.col(column) = step.by_force.col(2 * forces_[f].pattern);
      columns.col(column + 1) = prior_.rate() * step.by_force.col(2 * forces_[f].pattern + 1);
    }
    return columns;
  }

  /// The rows of y in the transition: what y at the next node takes from each part of the state.
  MatrixXd rows_of_y(const LinearRecording::Step& step, const Sizes& size) const {
    MatrixXd rows(size.y, size.all());
    rows << step.by_state, by_force(step), step.by_parameter;
    return rows;
  }

  double forward(const LinearRecording& recording, VectorXd& shared, MatrixXd& shared_covariance,
                 bool keep) {
    const Sizes size = sizes(recording);
    VectorXd p(size.p());
    p << shared, recording.own_mean;
    MatrixXd pp = MatrixXd::Zero(size.p(), size.p());
    pp.topLeftCorner(size.shared, size.shared) = shared_covariance;
    pp.diagonal().tail(size.own) = recording.own_deviation.array().square();
    VectorXd mean = VectorXd::Zero(size.all());
    mean.head(size.y) = recording.start_offset + recording.start_by_parameter * p;
    mean.tail(size.p()) = p;
    MatrixXd covariance = MatrixXd::Zero(size.all(), size.all());
    const MatrixXd yp = recording.start_by_parameter * pp;
    covariance.topLeftCorner(size.y, size.y) = yp * recording.start_by_parameter.transpose();
    covariance.topRightCorner(size.y, size.p()) = yp;
    covariance.bottomLeftCorner(size.p(), size.y) = yp.transpose();
    covariance.bottomRightCorner(size.p(), size.p()) = pp;
    for (std::size_t f = 0; f < forces_.size(); ++f)
      covariance.diagonal().segment(size.y + static_cast<Index>(2 * f), 2).setConstant(variance(f));

    double evidence = measure(recording.seen[0], size, mean, covariance, keep);
    for (std::size_t k = 0; k < recording.steps.size(); ++k) {
      predict(recording.steps[k], size, mean, covariance);
      evidence += measure(recording.seen[k + 1], size, mean, covariance, keep);
    }
    shared = mean.segment(size.y + size.w, size.shared);
    shared_covariance =
        covariance.block(size.y + size.w, size.y + size.w, size.shared, size.shared);
    return evidence;
  }

  void predict(const LinearRecording::Step& step, const Sizes& size, VectorXd& mean,
               MatrixXd& covariance) const {
    const MatrixXd rows = rows_of_y(step, size);
    const VectorXd y = rows * mean + step.offset;
    MatrixXd moved(size.y, size.all());
    moved.noalias() = rows * covariance;
    MatrixXd yy(size.y, size.y);
    yy.noalias() = moved * rows.transpose();
    const Matrix2d a = prior_.transition(step.duration);
    const Matrix2d added = Matrix2d::Identity() - a * a.transpose();
    // w: A on both sides of its blocks, on one side of those with y and p.
    for (std::size_t f = 0; f < forces_.size(); ++f) {
      const Index i = size.y + static_cast<Index>(2 * f);
      mean.segment(i, 2) = (a * mean.segment(i, 2)).eval();
      covariance.middleRows(i, 2) = (a * covariance.middleRows(i, 2)).eval();
      moved.middleCols(i, 2) = (moved.middleCols(i, 2) * a.transpose()).eval();
    }
    for (std::size_t f = 0; f < forces_.size(); ++f) {
      const Index i = size.y + static_cast<Index>(2 * f);
      covariance.middleCols(i, 2) = (covariance.middleCols(i, 2) * a.transpose()).eval();
      covariance.block(i, i, 2, 2) += variance(f) * added;
    }
    mean.head(size.y) = y;
    const Index rest = size.w + size.p();
    covariance.topLeftCorner(size.y, size.y) = 0.5 * (yy + yy.transpose());
    covariance.topRightCorner(size.y, rest) = moved.rightCols(rest);
    covariance.bottomLeftCorner(rest, size.y) = moved.rightCols(rest).transpose();
  }

  double measure(const LinearRecording::Seen& seen, const Sizes& size, VectorXd& mean,
                 MatrixXd& covariance, bool keep) {
    Node node;
    if (keep) {
      node.mean = mean;
      node.covariance = covariance;
    }
    double evidence = 0;
    if (seen.value.size() > 0) {
      MatrixXd h = MatrixXd::Zero(seen.value.size(), size.all());
      h.leftCols(size.y) = seen.by_state;
      h.rightCols(size.p()) = seen.by_parameter;
      MatrixXd hp(h.rows(), size.all());
      hp.noalias() = seen.by_state * covariance.topRows(size.y) +
                     seen.by_parameter * covariance.bottomRows(size.p());
      MatrixXd s = hp * h.transpose();
      s.diagonal().array() += 1;
      const Eigen::LLT<MatrixXd> factors(s);
      const VectorXd innovation = seen.value - h * mean;
      const VectorXd weighted = factors.solve(innovation);
      const MatrixXd solved = factors.solve(hp);  // K'
      evidence = -0.5 * innovation.dot(weighted) -
                 MatrixXd(factors.matrixL()).diagonal().array().log().sum();
      mean.noalias() += solved.transpose() * innovation;
      covariance.noalias() -= solved.transpose() * hp;
      covariance = (0.5 * (covariance + covariance.transpose())).eval();
      if (keep) {
        node.gain = solved.transpose();
        node.weighted = weighted;
        node.weighted_observed = factors.solve(h);
        node.observed = std::move(h);
      }
    }
    if (keep) nodes_.back().push_back(std::move(node));
    return evidence;
  }

  void backward(Smoothed& out) {
    std::vector<double> found(variance_.size(), 0), expected(variance_.size(), 1e-300);
    const Index shared = problem_.shared_mean.size();
    VectorXd lambda_shared = VectorXd::Zero(shared);
    MatrixXd information_shared = MatrixXd::Zero(shared, shared);
    out.recordings.resize(problem_.recordings.size());
    for (std::size_t r = problem_.recordings.size(); r-- > 0;) {
      const LinearRecording& recording = problem_.recordings[r];
      const Sizes size = sizes(recording);
      Smoothed::Recording& result = out.recordings[r];
      const std::size_t count = nodes_[r].size();
      result.state.resize(size.y, static_cast<Index>(count));
      result.force.resize(size.w, static_cast<Index>(count));
      result.covariance.resize(count);
      // By w at the nodes after this one: their covariances with the state here are `covariance` times these.
      MatrixXd by_later(size.all(), 0);
      VectorXd lambda = VectorXd::Zero(size.all());
      MatrixXd information = MatrixXd::Zero(size.all(), size.all());
      lambda.segment(size.y + size.w, shared) = lambda_shared;
      information.block(size.y + size.w, size.y + size.w, shared, shared) = information_shared;
      for (std::size_t k = count; k-- > 0;) {
        const Node& node = nodes_[r][k];
        if (node.weighted.size() > 0) {
          // C = 1 - K H
          lambda -= node.observed.transpose() * (node.gain.transpose() * lambda + node.weighted);
          by_later -= (node.observed.transpose() * (node.gain.transpose() * by_later)).eval();
          MatrixXd gained(size.all(), node.gain.cols());
          gained.noalias() = information * node.gain;
          const MatrixXd middle = node.gain.transpose() * gained;
          const MatrixXd cross = gained * node.observed;
          information.noalias() -= cross;
          information.noalias() -= cross.transpose();
          information.noalias() += node.observed.transpose() * (middle * node.observed);
          information.noalias() += node.observed.transpose() * node.weighted_observed;
          information = (0.5 * (information + information.transpose())).eval();
        }
        read_off(node, size, lambda, information, k, by_later, result);
        const bool first = k == 0;
        Matrix2d added = Matrix2d::Identity();
        if (!first) {
          const Matrix2d a = prior_.transition(recording.steps[k - 1].duration);
          added -= a * a.transpose();
        }
        for (std::size_t f = 0; f < forces_.size(); ++f) {
          const Index i = size.y + static_cast<Index>(2 * f);
          const auto group = static_cast<std::size_t>(forces_[f].group);
          found[group] += lambda.segment(i, 2).dot(added * lambda.segment(i, 2));
          expected[group] += (added * information.block(i, i, 2, 2)).trace();
        }
        if (!first) go_back(recording.steps[k - 1], size, lambda, information, by_later);
      }
      // At the start: the state comes from the parameters.
      const VectorXd p_s = nodes_[r][0].mean - nodes_[r][0].covariance * lambda;
      result.own = p_s.tail(size.own);
      const MatrixXd& d = recording.start_by_parameter;
      const VectorXd lambda_p = lambda.tail(size.p()) + d.transpose() * lambda.head(size.y);
      const MatrixXd yp = information.topRightCorner(size.y, size.p());
      MatrixXd information_p = information.bottomRightCorner(size.p(), size.p());
      information_p += d.transpose() * information.topLeftCorner(size.y, size.y) * d;
      const MatrixXd cross = d.transpose() * yp;
      information_p += cross + cross.transpose();
      lambda_shared = lambda_p.head(shared);
      information_shared = information_p.topLeftCorner(shared, shared);
      nodes_[r].clear();
    }
    for (std::size_t g = 0; g < found.size(); ++g) out.growth[g] = found[g] / expected[g];
  }

  void read_off(const Node& node, const Sizes& size, const VectorXd& lambda,
                const MatrixXd& information, std::size_t k, MatrixXd& by_later,
                Smoothed::Recording& result) const {
    const auto column = static_cast<Index>(k);
    const VectorXd mean = node.mean - node.covariance * lambda;
    result.state.col(column) = mean.head(size.y);
    result.force.col(column) = mean.segment(size.y, size.w);
    const auto count = static_cast<Index>(forces_.size());
    for (Index f = 0; f < count; ++f) result.force(2 * f + 1, column) *= prior_.rate();
    MatrixXd of_force(count, size.all()), prior(count, count);
    for (Index f = 0; f < count; ++f) of_force.row(f) = node.covariance.row(size.y + 2 * f);
    for (Index f = 0; f < count; ++f) prior.col(f) = of_force.col(size.y + 2 * f);
    MatrixXd weighted(count, size.all());
    weighted.noalias() = of_force * information;
    result.covariance[k] = {prior - weighted * of_force.transpose()};
    for (Index i = 0; i < by_later.cols(); i += count)
      result.covariance[k].emplace_back(of_force * by_later.middleCols(i, count));
    if (later_ == 0) return;
    MatrixXd from_here = MatrixXd::Zero(size.all(), count);
    for (Index f = 0; f < count; ++f) from_here(size.y + 2 * f, f) = 1;
    from_here -= weighted.transpose();
    const Index kept = std::min(by_later.cols(), (later_ - 1) * count);
    MatrixXd all(size.all(), count + kept);
    all << from_here, by_later.leftCols(kept);
    by_later = std::move(all);
  }

  /// lambda, information and by_later before a step from those after it.
  void go_back(const LinearRecording::Step& step, const Sizes& size, VectorXd& lambda,
               MatrixXd& information, MatrixXd& by_later) const {
    const MatrixXd rows = rows_of_y(step, size);
    const Matrix2d a = prior_.transition(step.duration);
    // Transition T: the rows of y, then A of w and 1 of p. T' = rows' [y] + rest.
    const auto transposed = [&](const auto& values) {
      MatrixXd out = rows.transpose() * values.topRows(size.y);
      for (std::size_t f = 0; f < forces_.size(); ++f) {
        const Index i = size.y + static_cast<Index>(2 * f);
        out.middleRows(i, 2) += a.transpose() * values.middleRows(i, 2);
      }
      out.bottomRows(size.p()) += values.bottomRows(size.p());
      return out;
    };
    lambda = transposed(lambda).eval();
    by_later = transposed(by_later).eval();
    const MatrixXd half = transposed(information).transpose();
    information = transposed(half);
  }

  const LinearProblem& problem_;
  const std::vector<ActingForce>& forces_;
  const std::vector<double>& variance_;
  const ForcePrior& prior_;
  Index later_;
  std::vector<std::vector<Node>> nodes_;
};

}  // namespace

Matrix2d ForcePrior::transition(double step) const {
  const double x = rate() * step;
  Matrix2d a;
  a << 1 + x, x, -x, 1 - x;
  return std::exp(-x) * a;
}

Smoothed smooth_forces(const LinearProblem& problem, const std::vector<ActingForce>& forces,
                       const std::vector<double>& variance, const ForcePrior& prior, bool smooth,
                       Index later) {
  return ChainFilter(problem, forces, variance, prior, later).run(smooth);
}

}  // namespace catena
