// SPDX-License-Identifier: BSD-3-Clause
#include "identify/problem/experiment.hpp"

#include <cmath>
#include <stdexcept>

#include "common/input_error.hpp"
#include "common/number_text.hpp"
#include "identify/problem/camera.hpp"
#include "identify/problem/initial_state.hpp"
#include "identify/problem/marker_places.hpp"
#include "identify/problem/plausibility.hpp"
#include "identify/recordings/signal_reader.hpp"
#include "runtime/positions.hpp"

namespace catena {
namespace {

using Eigen::Index;

constexpr Index kFewestFramesOfWindow = 8;  // of a window: fewer say nothing beyond their own start

/// A recording of a cable that hangs from the origin: markers less the support, where effects or
/// signals move it; from pictures, where they seem to be.
Recording seen_from_support(Recording recording, const ExperimentSpec& spec, const Model& model,
                            const Eigen::VectorXd& parameters, const Signals& signals) {
  if (model.in_space() && recording.components() == 2)
    recording = positions_from_pictures(recording, model, parameters, spec.metres_per_pixel);
  if (signals.count() < model.signals()) return recording;
  const Eigen::VectorXd any_shape = Eigen::VectorXd::Ones(model.coordinates());
  for (Index k = 0; k < recording.measured.cols(); ++k) {
    const Positions at = positions(model, parameters, recording.time[static_cast<std::size_t>(k)],
                                   any_shape, signals);
    for (std::size_t c = 0; c < recording.channels.size(); ++c) {
      const Component component = recording.channels[c].component;
      if (component != Component::kAngle)
        recording.measured(static_cast<Index>(c), k) -= component == Component::kSide ? at.side[0]
                                                        : component == Component::kDown
                                                            ? at.down[0]
                                                            : at.across[0];
    }
  }
  return recording;
}

/// The recording as its file gives it, checked.
Recording read_plausible(const Case& the_case, const ExperimentSpec& spec, const Model& model,
                         const Eigen::VectorXd& parameters, const Signals& signals) {
  Recording recording =
      read_recording(spec, the_case.links, the_case.cable.whole_length(), model.in_space());
  for (std::string& warning :
       check_plausible(seen_from_support(recording, spec, model, parameters, signals), spec,
                       spec.initial.value_or(the_case.initial), the_case.cable,
                       link_lengths(model, parameters), model))
    recording.warnings.push_back(std::move(warning));
  return recording;
}

/// Frames first .. last - 1 of a recording.
Recording part_of(const Recording& whole, Index first, Index last, bool fitted) {
  Recording part;
  part.time.assign(whole.time.begin() + first, whole.time.begin() + last);
  part.points = whole.points;
  part.channels = whole.channels;
  part.measured = whole.measured.middleCols(first, last - first);
  part.fit_frames = fitted ? last - first : 0;
  return part;
}

/// Refuses a window in which kFewestFramesOfWindow frames of the usual distance do not fit.
void check_window(const ExperimentSpec& spec, const Recording& whole) {
  const auto frames = static_cast<double>(whole.time.size());
  const double step = (whole.time.back() - whole.time.front()) / std::max(frames - 1, 1.0);
  if (spec.window > (kFewestFramesOfWindow - 1) * step) return;
  throw InputError(spec.where + ": window: " + shortest_number(spec.window) +
                   " s; a window needs at least " + std::to_string(kFewestFramesOfWindow) +
                   " frames, which take " + number_text(kFewestFramesOfWindow * step) +
                   " s here; give a longer one");
}

/// Cuts an experiment into windows, each an experiment with a start of its own. A window with
/// frames beyond fit_until validates.
std::vector<Experiment> windows_of(const ExperimentSpec& spec, const Recording& whole) {
  check_window(spec, whole);
  std::vector<Experiment> windows;
  const auto frames = static_cast<Index>(whole.time.size());
  const auto time = [&](Index frame) { return whole.time[static_cast<std::size_t>(frame)]; };
  Index last = 0;
  for (Index first = 0; first < frames; first = last) {
    const double number = std::floor((time(first) - time(0)) / spec.window + 1e-9);
    const double end = time(0) + (number + 1) * spec.window;
    last = first + 1;
    while (last < frames && time(last) < end - 1e-9) ++last;
    if (last - first < kFewestFramesOfWindow) continue;
    Experiment& window = windows.emplace_back();
    window.spec = spec;
    window.spec.window = kNotGiven;
    window.spec.from = time(first);
    window.spec.to = time(last - 1);
    window.spec.name = spec.name + " from " + shortest_number(window.spec.from) + " s";
    const bool fitted = last <= whole.fit_frames;
    if (!fitted) window.spec.use = Use::kValidate;
    window.recording = part_of(whole, first, last, fitted);
  }
  return windows;
}

/// Multiple shooting: each window is to end where the next one starts. `first`: the index that the
/// first window will have among all experiments.
void join(std::vector<Experiment>& windows, int first, const ExperimentSpec& spec,
          const Case& the_case) {
  const InitialSpec& initial = spec.initial.value_or(the_case.initial);
  const auto refuse = [&](const std::string& what) {
    throw InputError(spec.where + ": joined: " + what);
  };
  if (the_case.optimiser.method != FitMethod::kLeastSquares ||
      the_case.error.measure != Measure::kLeastSquares)
    refuse("multiple shooting needs method and measure least_squares");
  if (!the_case.optimiser.growing_windows.empty())
    refuse("and growing_windows; choose one of the two");
  if (!initial.free || initial.shape != Shape::kAngles || initial.at_rest ||
      !initial.velocity_free || initial.velocity_shape != Shape::kAngles)
    refuse(
        "every window needs a start of its own that can be any: initial with shape = \"angles\", "
        "free = true and velocity = { shape = \"angles\", free = true }");
  for (std::size_t e = 0; e + 1 < windows.size(); ++e)
    if (windows[e].fitted() && windows[e + 1].fitted()) {
      windows[e].meets = first + static_cast<int>(e) + 1;
      windows[e].ends = windows[e + 1].recording.time.front();
    }
}

}  // namespace

std::vector<Experiment> experiments_of(const Case& the_case, const Model& model,
                                       const ParameterMap& map, std::vector<Recording> recordings) {
  if (!recordings.empty() && recordings.size() != the_case.experiments.size())
    throw std::invalid_argument("recordings: one per experiment of the case is wanted");
  const bool from_files = recordings.empty();
  std::vector<Experiment> experiments;
  for (std::size_t e = 0; e < the_case.experiments.size(); ++e) {
    const ExperimentSpec& spec = the_case.experiments[e];
    const Eigen::VectorXd parameters = map(case_values(the_case, spec.name));
    const Signals signals =
        read_signals(spec.signals.empty() ? the_case.signals : spec.signals, model, spec.where);
    Recording recording = from_files ? read_plausible(the_case, spec, model, parameters, signals)
                                     : std::move(recordings[e]);
    std::vector<Experiment> parts(1);
    if (std::isnan(spec.window)) {
      parts[0].spec = spec;
      parts[0].recording = std::move(recording);
    } else {
      parts = windows_of(spec, recording);
      if (!parts.empty()) parts[0].recording.warnings = std::move(recording.warnings);
      if (spec.joined) join(parts, static_cast<int>(experiments.size()), spec, the_case);
    }
    for (Experiment& part : parts) {
      part.source = static_cast<int>(e);
      part.initial = part.spec.initial.value_or(the_case.initial);
      part.signals = signals;
      const Eigen::VectorXd own = map(case_values(the_case, part.spec.name));
      complete_from_data(part.initial,
                         seen_from_support(part.recording, part.spec, model, own, signals),
                         link_lengths(model, own));
      if (std::isnan(part.spec.start)) part.spec.start = part.recording.time.front();
      if (!(part.spec.start < part.recording.time.back()))
        throw InputError(part.spec.where + ": start: " + shortest_number(part.spec.start) +
                         " s is not before the last frame, at " +
                         number_text(part.recording.time.back()) +
                         " s: no motion is compared; give an earlier one");
      experiments.push_back(std::move(part));
    }
  }
  if (from_files) check_marker_places(the_case, experiments);
  return experiments;
}

}  // namespace catena
