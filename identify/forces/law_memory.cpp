// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/law_memory.hpp"

#include <cmath>

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Accelerations a of the linearised motion: v' - v = (a + a') / 2 of a step, but for so much that an error of the
/// first one fades.
constexpr double kKept = 0.8;

/// Of a step: memory' = kept memory + gain (x' - x).
struct MemoryStep {
  double kept = 0, gain = 0;
};

MemoryStep step_of(const LawMemory& memory, double duration) {
  if (timed_of(memory.variable)) return {};  // the time does not follow the motion
  if (has_accelerations(memory.variable)) return {-kKept, (1 + kKept) / duration};
  const double kept = std::exp(-duration / memory.lag);
  return {kept, memory.lag / duration * (1 - kept)};  // x goes straight
}

/// What the memory follows, x, and its derivative by the state: the position or angle of every piece, or the rates.
struct Followed {
  VectorXd value;
  MatrixXd by_state;
};

Followed followed_by(const LawMemory& memory, const LawChain& chain, const VectorXd& state) {
  const Index links = chain.lengths.size();
  Followed followed;
  if (has_accelerations(memory.variable)) {
    followed.value = state.segment(chain.coordinates, links);
    followed.by_state.setZero(links, state.size());
    followed.by_state.middleCols(chain.coordinates, links).setIdentity();
  } else if (timed_of(memory.variable)) {
    followed.value.setZero(1);
    followed.by_state.setZero(1, state.size());
  } else if (const auto relaxing = relaxing_of(memory.variable)) {
    const auto elements = law_elements(memory.site, *relaxing, {}, chain, state);
    const auto count = static_cast<Index>(elements.size());
    followed.value.resize(count);
    followed.by_state.setZero(count, state.size());
    for (Index i = 0; i < count; ++i) {
      const LawElement& element = elements[static_cast<std::size_t>(i)];
      followed.value[i] = element.value;
      followed.by_state.row(i).head(links) = element.gradient.transpose();
    }
  }
  return followed;
}

/// The accelerations of positions q with rates v at these times. At both sides of a node the cubic through q and v of
/// the neighbours has one; with the parabola through three rates they make a mean without an error of second order.
MatrixXd accelerations(const MatrixXd& q, const MatrixXd& v, const std::vector<double>& time) {
  const Index count = q.cols();
  MatrixXd out = MatrixXd::Zero(q.rows(), count);
  const auto step = [&](Index k) {
    const auto node = static_cast<std::size_t>(k);
    return time[node + 1] - time[node];
  };
  const auto before = [&](Index k) -> VectorXd {
    const double h = step(k - 1);
    return 6 / (h * h) * (q.col(k - 1) - q.col(k)) + (2 * v.col(k - 1) + 4 * v.col(k)) / h;
  };
  const auto after = [&](Index k) -> VectorXd {
    const double h = step(k);
    return 6 / (h * h) * (q.col(k + 1) - q.col(k)) - (4 * v.col(k) + 2 * v.col(k + 1)) / h;
  };
  if (count < 2) return out;
  out.col(0) = after(0);
  out.col(count - 1) = before(count - 1);
  for (Index k = 1; k + 1 < count; ++k) {
    const double ratio = step(k - 1) / step(k);
    const VectorXd parabola =
        (ratio * (v.col(k + 1) - v.col(k)) + (v.col(k) - v.col(k - 1)) / ratio) /
        (step(k - 1) + step(k));
    out.col(k) = (before(k) + after(k) + parabola) / 3;
  }
  return out;
}

}  // namespace

MatrixXd LawMemory::along(const LawMotion& motion, const LawChain& chain) const {
  const Index nodes = motion.state.cols(), states = motion.state.rows();
  MatrixXd followed;
  for (Index k = 0; k < nodes; ++k) {
    const VectorXd value = followed_by(*this, chain, motion.state.col(k)).value;
    if (k == 0) followed.resize(value.size(), nodes);
    followed.col(k) = value;
  }
  MatrixXd out(states + followed.rows(), nodes);
  out.topRows(states) = motion.state;
  if (has_accelerations(variable)) {
    out.bottomRows(followed.rows()) =
        accelerations(motion.state.topRows(followed.rows()), followed, motion.time);
    return out;
  }
  if (timed_of(variable)) {
    out.bottomRows(1) = Eigen::RowVectorXd::Map(motion.time.data(), nodes);
    return out;
  }
  VectorXd stretch = VectorXd::Zero(followed.rows());
  for (Index k = 0; k < nodes; ++k) {
    if (k > 0 && stretch.size() > 0) {
      const auto node = static_cast<std::size_t>(k);
      const MemoryStep step = step_of(*this, motion.time[node] - motion.time[node - 1]);
      stretch = step.kept * stretch + step.gain * (followed.col(k) - followed.col(k - 1));
    }
    out.col(k).tail(stretch.size()) = stretch;
  }
  return out;
}

LinearRecording LawMemory::added_to(const LinearRecording& recording, const LawMotion& motion,
                                    const LawChain& chain) const {
  Followed here = followed_by(*this, chain, motion.state.col(0));
  const Index states = motion.state.rows(), more = here.value.size();
  if (more == 0) return recording;
  LinearRecording out = recording;
  const auto below = [&](MatrixXd& top, const MatrixXd& bottom) {
    top.conservativeResize(states + more, Eigen::NoChange);
    top.bottomRows(more) = bottom;
  };
  out.start_offset.conservativeResizeLike(VectorXd::Zero(states + more));
  below(out.start_by_parameter, MatrixXd::Zero(more, recording.start_by_parameter.cols()));
  for (std::size_t k = 0; k < out.steps.size(); ++k) {
    const LinearRecording::Step& before = recording.steps[k];
    const Followed next = followed_by(*this, chain, motion.state.col(static_cast<Index>(k) + 1));
    const MemoryStep by = step_of(*this, before.duration);
    LinearRecording::Step& step = out.steps[k];
    step.by_state.setZero(states + more, states + more);
    step.by_state.topLeftCorner(states, states) = before.by_state;
    step.by_state.bottomLeftCorner(more, states) =
        by.gain * (next.by_state * before.by_state - here.by_state);
    step.by_state.bottomRightCorner(more, more).diagonal().setConstant(by.kept);
    below(step.by_force, by.gain * next.by_state * before.by_force);
    below(step.by_parameter, by.gain * next.by_state * before.by_parameter);
    step.offset.resize(states + more);
    step.offset << before.offset, by.gain * (next.by_state * before.offset);
    here = next;
  }
  for (LinearRecording::Seen& seen : out.seen) {
    seen.by_state.conservativeResize(Eigen::NoChange, states + more);
    seen.by_state.rightCols(more).setZero();
  }
  return out;
}

}  // namespace catena
