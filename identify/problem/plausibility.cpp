// SPDX-License-Identifier: BSD-3-Clause
#include "identify/problem/plausibility.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "common/input_error.hpp"
#include "common/number_text.hpp"
#include "identify/recordings/release.hpp"
#include "linear_algebra/decompositions.hpp"

namespace catena {
namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Position = Eigen::VectorXd;  // side, down and, in space, across

constexpr const char* kCameras =
    "are the places, the directions and the focal lengths of the cameras right?";
constexpr double kMostFrames = 0.9;  // of the frames: the few that are worst are outliers

/// The value that a share of the numbers does not exceed; NaN of none.
double quantile(std::vector<double> values, double share) {
  if (values.empty()) return kNotGiven;
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// Three significant digits, for messages.
std::string rounded(double value) {
  if (value == 0 || !std::isfinite(value)) return number_text(value);
  const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) - 2);
  return number_text(unit < 1 ? std::round(value / unit) / std::round(1 / unit)
                              : std::round(value / unit) * unit);
}

double metres(const std::string& unit) { return unit == "mm" ? 1e-3 : unit == "cm" ? 1e-2 : 1; }

/// One recording held against one cable.
class Check {
 public:
  Check(const Recording& recording, const ExperimentSpec& spec, const InitialSpec& initial,
        const CableGeometry& cable, const Eigen::VectorXd& lengths, const Model& model,
        const PlausibilityLimits& limits)
      : recording_(recording),
        spec_(spec),
        initial_(initial),
        cable_(cable),
        limits_(limits),
        lengths_(lengths),
        length_(lengths.sum()),
        period_(2 * std::numbers::pi * std::sqrt(length_ / cable.gravity)),
        held_(model.held()) {
    const catena_model& table = model.table();
    for (int i = 0; i < table.energies; ++i)
      movable_ = movable_ || std::string_view(table.energy_item[i].name) == "support";
    for (const char* effect : {"support_", "origin_offset", "scale", "marker_", "frame_"})
      for (int i = 0; i < model.parameters(); ++i)
        movable_ = movable_ || std::string(model.table().parameter[i].name).starts_with(effect);
    for (const PointSpec& point : recording.points) {
      in_pictures_ = in_pictures_ || !point.camera.empty();
      arcs_.push_back(point.load    ? length_
                      : point.joint ? lengths.head(point.joint).sum()
                                    : point.arc_length);
    }
    movable_ = movable_ || in_pictures_;  // the poses may be what is to be found
  }

  std::vector<std::string> warnings() {
    check_case();
    if (spec_.kind == DataKind::kMarkers) {
      if (!check_end()) return std::move(warnings_);  // what follows rests on the length
      if (!check_tracked()) return std::move(warnings_);
      if (check_scale() && (listed_upwards() || check_neighbours())) check_support();
      check_direction();
    } else {
      check_angles();
    }
    check_time();
    if (initial_.at_rest && std::isnan(spec_.start)) {
      if (std::isnan(spec_.window))
        check_start();
      else
        check_starts_of_windows();
    }
    return std::move(warnings_);
  }

 private:
  void warn(const std::string& key, const std::string& text) {
    warnings_.push_back(key + ": " + text);
  }
  /// What no cable can do ends the program, unless an effect of the model explains it.
  void report(bool impossible, const std::string& key, const std::string& text) {
    if (impossible && !movable_) throw InputError(spec_.where + ": " + key + ": " + text);
    warn(key, text);
  }

  Index points() const { return static_cast<Index>(recording_.points.size()); }
  Index frames() const { return recording_.measured.cols(); }
  double arc(Index p) const { return arcs_[static_cast<std::size_t>(p)]; }
  double time(Index k) const { return recording_.time[static_cast<std::size_t>(k)]; }
  std::string name(Index p) const { return recording_.points[static_cast<std::size_t>(p)].name; }
  Position at(Index p, Index k) const {
    const Index components = recording_.components();
    return recording_.measured.block(components * p, k, components, 1);
  }
  /// How far to the side, in any direction, and down.
  static Vector2d side_and_down(const Position& place) {
    return {place.size() == 3 ? std::hypot(place[0], place[2]) : place[0], place[1]};
  }

  /// A function of the frame over all frames in which it is a number.
  template <class Value>
  std::vector<double> over_frames(Value value) const {
    std::vector<double> values;
    for (Index k = 0; k < frames(); ++k)
      if (const double v = value(k); !std::isnan(v)) values.push_back(v);
    return values;
  }

  void check_case() {
    const bool angles = spec_.kind == DataKind::kAngles;
    const double most = limits_.most_noise * (angles ? 1 : length_);
    if (spec_.noise > most)
      warn("noise", rounded(spec_.noise) + (angles ? " rad" : " m") +
                        " hides the motion of this cable; give it in " + (angles ? "rad" : "m"));
    if (std::isfinite(spec_.fit_until) && spec_.fit_until > time(frames() - 1))
      warn("fit_until", rounded(spec_.fit_until) + " s is after the last frame (" +
                            rounded(time(frames() - 1)) + " s): nothing is held out");
    for (std::string& warning : check_numbers(cable_, initial_, length_, limits_))
      warnings_.push_back(std::move(warning));
  }

  /// Whether enough of the cable is marked.
  bool check_end() {
    const double last = *std::max_element(arcs_.begin(), arcs_.end());
    if (last >= limits_.least_marked * length_) return true;
    warn("length", "the last marker is at " + rounded(last) +
                       " m along the cable, and the cable is " + rounded(length_) +
                       " m long; are both in m, and is the length right?");
    return false;
  }

  /// Whether every marker moves where its neighbours do. A tracker that lost a marker repeats its last place.
  bool check_tracked() {
    bool tracked = true;
    for (Index p = 0; p < points() && !held_; ++p) {
      Index first = 0;  // of the frames that repeat one place
      for (Index k = 1; k < frames(); ++k) {
        if (at(p, k) != at(p, first)) first = k;
        const auto moves = [&](Index q) {
          return arc(q) >= arc(p) / 2 && arc(q) <= 2 * arc(p) &&
                 (at(q, k) - at(q, first)).norm() > limits_.moves_others * length_;
        };
        Index other = 0;
        while (other < points() && !moves(other)) ++other;
        if (other == points()) continue;
        while (k + 1 < frames() && at(p, k + 1) == at(p, first)) ++k;
        warn("markers", name(p) + " stays where it is from " + rounded(time(first)) + " to " +
                            rounded(time(k)) + " s, while " + name(other) +
                            " moves; if the tracker lost it, leave these fields of the file empty");
        tracked = false;
        break;
      }
    }
    return tracked;
  }

  double chord(Index p) const {
    return quantile(over_frames([&](Index k) { return (at(p, k) - at(p - 1, k)).norm(); }),
                    kMostFrames);
  }

  /// Chord over arc from marker to marker, or from the support to the only one.
  double chord_over_arc() const {
    std::vector<double> ratios;
    for (Index p = 1; p < points(); ++p) {
      const double between = std::abs(arc(p) - arc(p - 1));
      if (between == 0) continue;
      if (const double apart = chord(p); !std::isnan(apart)) ratios.push_back(apart / between);
    }
    if (ratios.empty()) {
      const Index last = points() - 1;
      if (arc(last) > 0)
        ratios.push_back(
            quantile(over_frames([&](Index k) { return at(last, k).norm(); }), kMostFrames) /
            arc(last));
    }
    return quantile(ratios, 0.5);
  }

  /// What makes lengths as long as the cable is.
  std::string scale_remedy(double ratio) const {
    const auto fits = [&](double factor) {
      return factor * ratio > limits_.hardly_shorter && factor * ratio < limits_.hardly_longer;
    };
    if (in_pictures_) return kCameras;
    if (spec_.length_unit == "px")
      return "metres_per_pixel = " + rounded(spec_.metres_per_pixel / ratio) + " would fit";
    const double now = metres(spec_.length_unit);
    for (const char* unit : {"m", "cm", "mm"})
      if (fits(metres(unit) / now)) return std::string("length_unit = \"") + unit + "\" would fit";
    return "if the file is in pixels: length_unit = \"px\" and metres_per_pixel = " +
           rounded(now / ratio);
  }

  bool check_scale() {
    const double ratio = chord_over_arc();
    if (std::isnan(ratio)) return true;
    const double shorter = held_ ? limits_.not_shorter : limits_.hardly_shorter;  // it sags
    if (ratio < limits_.hardly_longer && ratio > shorter) return true;
    const std::string what = points() > 1
                                 ? "neighbouring markers are " + rounded(ratio) +
                                       " times as far apart as the cable between them is long"
                                 : name(0) + " is " + rounded(ratio) +
                                       " times as far from the support as the cable to it is long";
    report(ratio > limits_.not_longer || ratio < limits_.not_shorter,
           in_pictures_                ? "camera"
           : spec_.length_unit == "px" ? "metres_per_pixel"
                                       : "length_unit",
           what + "; " + scale_remedy(ratio) +
               "; or change `length` of the cable or the places of "
               "the markers");
    return false;
  }

  /// Whether neighbours are as near as the cable between them is long: the scale is right, so their
  /// places along the cable are not.
  bool check_neighbours() {
    Index worst = 0;
    double most = limits_.hardly_beyond * length_;
    for (Index p = 1; p < points(); ++p) {
      const double excess = chord(p) - limits_.hardly_longer * std::abs(arc(p) - arc(p - 1));
      if (excess > most) most = excess, worst = p;
    }
    if (worst == 0) return true;
    report(most > limits_.not_beyond * length_, "markers",
           name(worst - 1) + " and " + name(worst) + " are " + rounded(chord(worst)) +
               " m apart, but only " + rounded(std::abs(arc(worst) - arc(worst - 1))) +
               " m of cable are between them; are the markers in the order of the file, and where "
               "on the cable are they?");
    return false;
  }

  /// How far a marker is from the support in most frames, beyond its arc length.
  double beyond(Index p, double arc_length) const {
    return quantile(over_frames([&](Index k) { return at(p, k).norm(); }), kMostFrames) -
           arc_length;
  }

  /// Where the support would be if the cable went on straight above its first two markers; in the
  /// file's axes and unit.
  std::string origin_remedy() const {
    if (in_pictures_) return kCameras;
    if (points() < 2 || arc(1) <= arc(0)) return "give `origin` where the support is";
    const double share = arc(0) / (arc(1) - arc(0));
    const double unit =
        spec_.length_unit == "px" ? spec_.metres_per_pixel : metres(spec_.length_unit);
    std::string text;
    for (Index axis = 0; axis < recording_.components(); ++axis) {
      const double there = quantile(over_frames([&](Index k) {
                                      return at(0, k)[axis] + share * (at(0, k) - at(1, k))[axis];
                                    }),
                                    0.5);
      const bool turned = axis == 0 ? spec_.mirrored : axis == 1 && spec_.upward;
      text += (axis ? ", " : "") + rounded(spec_.origin_of(static_cast<std::size_t>(axis)) +
                                           (turned ? -there : there) / unit);
    }
    return "`origin` would be about [" + text + "]";
  }

  const char* origin_key() const { return in_pictures_ ? "camera" : "origin"; }

  bool listed_upwards() const {
    for (Index p = 0; p < points(); ++p)
      if (beyond(p, limits_.hardly_longer * arc(points() - 1 - p)) >=
          limits_.hardly_beyond * length_)
        return false;
    return points() > 1;
  }

  void check_support() {
    if (points() == 1) return;  // said by the scale
    Index worst = -1;
    double most = limits_.hardly_beyond;
    for (Index p = 0; p < points(); ++p) {
      const double excess = beyond(p, limits_.hardly_longer * arc(p)) / length_;
      if (excess > most) most = excess, worst = p;
    }
    if (worst < 0) return check_first();
    const bool upwards = listed_upwards();
    report(most > limits_.not_beyond, upwards ? "markers" : origin_key(),
           name(worst) + " is " + rounded(beyond(worst, 0)) + " m from the support, but only " +
               rounded(arc(worst)) + " m along the cable; " +
               (upwards ? "the markers seem to be listed from the load upwards" : origin_remedy()));
  }

  /// The cable is hardly bent above its first marker: an origin below the support is too near to it.
  void check_first() {
    const double distance = quantile(over_frames([&](Index k) { return at(0, k).norm(); }), 0.5);
    if (limits_.hardly_shorter * arc(0) - distance > limits_.hardly_beyond * length_)
      warn(origin_key(), name(0) + " is only " + rounded(distance) + " m from the support, and " +
                             rounded(arc(0)) + " m along the cable; " + origin_remedy());
  }

  void check_direction() {
    if (held_ || time(frames() - 1) - time(0) < 0.5 * period_) return;  // one side of a swing
    const Index last = points() - 1;
    Position sum = Position::Zero(recording_.components());
    for (Index k = 0; k < frames(); ++k) {
      const Position step = last > 0 ? Position(at(last, k) - at(0, k)) : at(0, k);
      if (!step.hasNaN()) sum += step;
    }
    const Vector2d mean = side_and_down(sum);
    const double angle = std::abs(std::atan2(mean[0], mean[1]));
    if (!(angle > limits_.hardly_sideways)) return;
    if (angle > limits_.hardly_upwards)
      warn("vertical", "on average the cable points upwards; vertical = \"" +
                           std::string(spec_.upward ? "down" : "up") + "\" would turn it over");
    else
      warn("markers",
           "on average the cable points sideways; are the columns of side and down "
           "exchanged, or the picture turned?");
  }

  void check_angles() {
    const double fall = std::sqrt(cable_.gravity / lengths_.minCoeff());
    double rate = 0;
    for (Index p = 0; p < points(); ++p)
      rate = std::max(rate, quantile(over_frames([&](Index k) {
                                       if (k == 0) return kNotGiven;
                                       const auto& angle = recording_.measured;
                                       return std::abs(angle(p, k) - angle(p, k - 1)) /
                                              (time(k) - time(k - 1));
                                     }),
                                     kMostFrames));
    if (rate > limits_.hardly_turning * fall)
      warn(spec_.angle_unit == "rad" ? "angle_unit" : "wrapped",
           "links turn at " + rounded(rate) + " rad/s, " + rounded(rate / fall) +
               " times as fast as they fall; " +
               (spec_.angle_unit == "rad" ? "angle_unit = \"deg\" if the file is in degrees, "
                                          : "") +
               "wrapped = true if the angles jump by a turn");
  }

  /// Where the last marker of a recording in space moves most: a unit vector of side and across.
  Vector2d swing_direction() const {
    std::vector<Vector2d> places;
    Vector2d middle = Vector2d::Zero();
    for (Index k = 0; k < frames(); ++k) {
      const Position place = at(points() - 1, k);
      if (place.hasNaN()) continue;
      places.emplace_back(place[0], place[2]);
      middle += places.back();
    }
    middle /= static_cast<double>(places.size());
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    for (const Vector2d& place : places) spread += (place - middle) * (place - middle).transpose();
    const double azimuth = 0.5 * std::atan2(2 * spread(0, 1), spread(0, 0) - spread(1, 1));
    return {std::cos(azimuth), std::sin(azimuth)};
  }

  /// The swing over the frames: the last marker's side (m), or where it moves most in space, or the
  /// last angle (rad).
  Eigen::VectorXd swing() const {
    const auto& measured = recording_.measured;
    const Index components = recording_.components();
    if (components < 3) return measured.row(measured.rows() - components);
    const Vector2d direction = swing_direction();
    return direction[0] * measured.row(measured.rows() - 3) +
           direction[1] * measured.row(measured.rows() - 1);
  }

  /// Twice the median time between passages through the middle; NaN: too few of them. A passage
  /// leads from well on one side of the mean to well on the other.
  double swing_period() const {
    const Eigen::VectorXd swings = swing();
    const std::vector<double> values = over_frames([&](Index k) { return swings[k]; });
    if (values.empty()) return kNotGiven;
    double mean = 0, square = 0;
    for (const double value : values) mean += value / static_cast<double>(values.size());
    for (const double value : values)
      square += (value - mean) * (value - mean) / static_cast<double>(values.size());
    const double well = 0.5 * std::sqrt(square);
    std::vector<double> between;
    int side = 0;
    double last = kNotGiven;
    for (Index k = 0; k < frames(); ++k) {
      const double value = swings[k] - mean;
      const int now = value > well ? 1 : value < -well ? -1 : 0;
      if (now == 0 || now == side) continue;
      if (side != 0) {
        if (!std::isnan(last)) between.push_back(time(k) - last);
        last = time(k);
      }
      side = now;
    }
    return between.size() < 2 ? kNotGiven : 2 * quantile(between, 0.5);
  }

  void check_time() {
    if (!(cable_.gravity > 0)) return;
    const std::string key = spec_.time_unit == "frames" ? "frame_rate" : "time_unit";
    const std::string remedy = spec_.time_unit == "frames"
                                   ? "is the frame rate that of the camera?"
                                   : "is the first column in s (time_unit \"s\"), ms, or a count "
                                     "of frames (\"frames\" and "
                                     "frame_rate), and is the length in m?";
    const std::string pendulum = "a pendulum as long as the cable takes " + rounded(period_) + " s";
    const double duration = time(frames() - 1) - time(0);
    const double per_period =
        static_cast<double>(frames() - 1) * period_ / duration * static_cast<double>(spec_.every);
    const double period = swing_period();
    if (period > limits_.hardly_slower * period_ || period < limits_.hardly_faster * period_)
      warn(key,
           "the cable swings once in " + rounded(period) + " s, and " + pendulum + "; " + remedy);
    else if (per_period / spec_.every < limits_.fewest_frames || per_period > limits_.most_frames)
      warn(key, "there are " + rounded(static_cast<double>(frames() - 1) / duration) +
                    " frames per second, and " + pendulum + "; " + remedy);
    else if (duration < limits_.shortest * period_)
      warn(key, "the recording lasts " + rounded(duration) + " s, and " + pendulum + "; " + remedy);
  }

  /// The place of a point, or the angle as an arc of the cable's length.
  Position place(Index p, Index k) const {
    if (spec_.kind == DataKind::kMarkers) return at(p, k);
    return Vector2d(length_ * recording_.measured(p, k), 0);
  }

  /// The speed of a point in the first `count` frames from `first` on, from a parabola through them, with twice
  /// its standard error; m/s. NaN where the point is not seen in all of them.
  std::pair<double, double> speed_at_start(Index p, Index first, Index count) const {
    Eigen::MatrixXd powers(count, 3), places(count, place(p, 0).size());
    for (Index k = 0; k < count; ++k) {
      const double t = time(first + k) - time(first);
      powers.row(k) << 1, t, t * t;
      places.row(k) = place(p, first + k).transpose();
    }
    if (places.hasNaN()) return {kNotGiven, kNotGiven};
    const Eigen::MatrixXd fitted = least_squares(powers, places);
    const double variance =
        (places - powers * fitted).squaredNorm() / static_cast<double>(places.cols() * (count - 3));
    const double slope = inverse(powers.transpose() * powers)(1, 1);
    return {fitted.row(1).norm(), 2 * std::sqrt(variance * slope)};
  }

  /// The speed of a point from frame `first` to the next one, with twice its standard error; m/s.
  /// Third differences show the noise: the motion hardly has any.
  std::pair<double, double> step_at_start(Index p, Index first) const {
    const double noise =
        quantile(
            over_frames([&](Index k) {
              if (k < 3) return kNotGiven;
              return (place(p, k) - 3 * place(p, k - 1) + 3 * place(p, k - 2) - place(p, k - 3))
                  .norm();
            }),
            0.5) /
        (0.6745 * std::sqrt(20.0));  // the median of a normal number; the sum of squares of 1 3 3 1
    const double step = time(first + 1) - time(first);
    return {(place(p, first + 1) - place(p, first)).norm() / step,
            2 * std::sqrt(2.0) * noise / step};
  }

  /// The speed that the fastest point has in frame `first` at least, m/s. A stiff cable that is let
  /// go out of balance moves at many m/s within milliseconds: only the first few frames tell it from
  /// one that moved before. Noise hides the speed in few frames, and more of them show it. So of all
  /// numbers of frames that `resolved` is seen in, m/s, the one counts that admits the least.
  double speed_at_start(double resolved, Index first = 0) const {
    double fastest = 0;
    for (Index p = 0; p < points(); ++p) {
      double slowest = kNotGiven;
      const auto take = [&](std::pair<double, double> speed) {
        const auto [value, error] = speed;
        if (error <= resolved) slowest = std::fmin(slowest, value - error);
      };
      take(step_at_start(p, first));
      for (Index count = 5; first + count <= frames(); count *= 2) {
        take(speed_at_start(p, first, count));
        if (time(first + count - 1) - time(first) >= 0.05 * period_) break;
      }
      fastest = std::fmax(fastest, slowest);
    }
    return fastest;
  }

  /// A speed that a cable at rest does not seem to have, m/s.
  double hardly_at_rest() const {
    return limits_.hardly_at_rest * std::sqrt(cable_.gravity * length_);
  }

  void check_starts_of_windows() {
    if (!(cable_.gravity > 0)) return;
    double end = time(0);
    for (Index k = 0; k + 1 < frames(); ++k) {
      if (time(k) < end - 1e-9) continue;
      end += spec_.window;
      const double fastest = speed_at_start(hardly_at_rest(), k);
      if (!(fastest > hardly_at_rest())) continue;
      warn("window",
           "the cable moves at " + rounded(fastest) + " m/s or more at " + rounded(time(k)) +
               " s, but the case lets every window start at rest; let it have a velocity in "
               "[initial]: velocity = { shape = \"smooth\", terms = 4, free = true }");
      return;
    }
  }

  void check_start() {
    if (!(cable_.gravity > 0)) return;
    const double fastest = speed_at_start(hardly_at_rest());
    if (fastest > hardly_at_rest()) {
      warn("from",
           "the cable moves at " + rounded(fastest) +
               " m/s or more in the first frames, but the case lets it start at rest; begin `from` "
               "the frame of the release, or let it have a velocity in [initial]");
      return;
    }
    if (initial_.shape == Shape::kHanging) return;  // it need not move before something does
    const double release = release_time(recording_);
    if (release - time(0) > limits_.held_time * period_)
      warn("from", "the cable is held until " + rounded(release) +
                       " s, but the case lets it go in the first frame, at " + rounded(time(0)) +
                       " s; from = " + rounded(release) + " would begin with the release");
  }

  const Recording& recording_;
  const ExperimentSpec& spec_;
  const InitialSpec& initial_;
  const CableGeometry& cable_;
  const PlausibilityLimits& limits_;
  const Eigen::VectorXd& lengths_;
  double length_, period_;  // m, s
  std::vector<double> arcs_;
  bool held_;                 // at its end or on its way, so that it need not hang down
  bool in_pictures_ = false;  // positions follow from the pictures of cameras
  bool movable_ = false;      // an effect moves the support, or what the camera shows
  std::vector<std::string> warnings_;
};

}  // namespace

std::vector<std::string> check_numbers(const CableGeometry& cable, const InitialSpec& initial,
                                       double length, const PlausibilityLimits& limits) {
  std::vector<std::string> warnings;
  if (cable.density > limits.heaviest)
    warnings.push_back("density: " + rounded(cable.density) + " kg/m; is that in g/m?");
  if (cable.load_mass > limits.heaviest_load * cable.density * length)
    warnings.push_back("load_mass: " + rounded(cable.load_mass) + " kg is " +
                       rounded(cable.load_mass / (cable.density * length)) +
                       " times the mass of the cable; is it in g, or density not in kg/m?");
  double largest = 0;
  for (const double angle : initial.coefficients) largest = std::max(largest, std::abs(angle));
  if (largest > limits.most_angle)
    warnings.push_back("initial: an angle of " + rounded(largest) + " rad is " +
                       rounded(largest / (2 * std::numbers::pi)) +
                       " turns; angles are in rad, and " + rounded(largest) + " degrees are " +
                       rounded(largest * std::numbers::pi / 180));
  return warnings;
}

std::vector<std::string> check_plausible(const Recording& recording, const ExperimentSpec& spec,
                                         const InitialSpec& initial, const CableGeometry& cable,
                                         const Eigen::VectorXd& lengths, const Model& model,
                                         const PlausibilityLimits& limits) {
  return Check(recording, spec, initial, cable, lengths, model, limits).warnings();
}

}  // namespace catena
