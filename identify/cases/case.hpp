// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

namespace catena {

/// What a case file (TOML, kind = "case") says, checked as far as that goes without model and data.
/// SI units, angles in rad. Every key is described in docs/case-files.md. A case can be made by hand,
/// too:
///
///     Case the_case;
///     the_case.links = 4;
///     the_case.cable.length = 1.2;    // m
///     the_case.cable.density = 0.15;  // kg/m
///     the_case.parameters.push_back({.name = "k", .sets = "stiffness", .value = 0.1});

inline constexpr double kNotGiven = std::numeric_limits<double>::quiet_NaN();

/// The cable at rest in a table: lengths, masses, inertias of its links. What is empty or NaN
/// follows from the rest: equal links, mass = density * length, inertia = mass * length^2 / 12.
struct CableGeometry {
  double length = kNotGiven;          ///< m
  double density = kNotGiven;         ///< kg/m
  std::vector<double> link_lengths;   ///< m, one per link
  std::vector<double> link_masses;    ///< kg
  std::vector<double> link_inertias;  ///< kg m^2, each about the link's own centre
  double load_mass = 0;               ///< kg
  double gravity = 9.81;              ///< m/s^2

  /// m: of all links, however they are given.
  double whole_length() const {
    return link_lengths.empty() ? length
                                : std::accumulate(link_lengths.begin(), link_lengths.end(), 0.0);
  }
};

enum class Scale { kLinear, kLogarithmic };

/// One quantity that sets one or several parameters of the model:
/// model value = factor * value (* what the quantity itself says, see ParameterMap).
struct ParameterSpec {
  std::string name;  ///< label in results
  std::string sets;  ///< "stiffness_2..12", "stiffness", "air_drag_quadratic.normal",
                     ///< "bending_stiffness", ...
  std::string unit;  ///< of `value`
  double value = 0;  ///< starting value if free
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double factor = 1;
  bool free = false;
  bool per_experiment = false;           ///< an unknown of its own in every experiment (sensors)
  std::map<std::string, double> values;  ///< per_experiment: by name, where it is not `value`
  Scale scale = Scale::kLinear;
  double measured = kNotGiven;            ///< before the fit, in another way; with
  double standard_deviation = kNotGiven;  ///< a prior of the fit; NaN: none
  std::string at_most;  ///< name of a parameter that it does not exceed; empty: none
  std::string where;    ///< "case.toml:12", for messages

  /// Its value in the experiment (or window) of that name.
  double value_in(const std::string& experiment) const {
    const auto found = values.find(experiment);
    return found == values.end() ? value : found->second;
  }
};

/// How the angles (or the rates) of the links start. All but the catenary and the hanging shape
/// are linear in their coefficients, which are the unknowns where the shape is free. In space the
/// angle turns a link in the vertical plane of its azimuth, and another angle, of the same shape,
/// out of that plane.
enum class Shape {
  kStraight,  ///< one coefficient: the common angle, rad
  kAngles,    ///< one per link, rad
  kSmooth,    ///< angle of link i = sum of coefficient k times the shifted Legendre polynomial k at
              ///< the arc length of the middle of the link over the length of the cable
  kCatenary,  ///< (2.53) from the support to the held point
  kHanging,   ///< the equilibrium; straight down for the plain chain
};

/// The start of one coordinate of the load.
struct LoadStart {
  std::string coordinate;  ///< as the model's table names it: "swinging_load.swing"
  double value = 0, rate = 0;
};

struct InitialSpec {
  Shape shape = Shape::kHanging;
  int terms = 6;                        ///< kSmooth
  std::vector<double> coefficients;     ///< empty: found from the first frames of the data
  bool free = false;                    ///< the coefficients are unknowns
  std::array<double, 2> held = {0, 0};  ///< kCatenary: side, down of the held point, m
  bool ends_at_held = false;  ///< kCatenary: the end of the last link, not of the curve, is there

  bool at_rest = true;                    ///< no velocity at the start
  Shape velocity_shape = Shape::kSmooth;  ///< kStraight, kAngles or kSmooth
  int velocity_terms = 3;
  std::vector<double> velocity_coefficients;  ///< rad/s; empty: from the first frames of the data
  bool velocity_free = false;

  /// In space, one per link: the vertical plane of the angle, rad from side to across, and its rate,
  /// rad/s. Empty: found with the coefficients that are left open; else zero.
  std::vector<double> azimuths, azimuth_rates;
  /// In space, of the angles out of that plane, rad, towards growing azimuth, as many as
  /// coefficients; and of their rates, rad/s, as many as velocity_coefficients. Empty: as azimuths.
  std::vector<double> out_of_plane, out_of_plane_rates;

  /// Coordinates of the load that are not named are in equilibrium where the shape is, and zero elsewhere.
  std::vector<LoadStart> load;

  /// The lists of coefficients in the order in which unknowns count them.
  std::array<std::vector<double>*, 4> coefficient_lists() {
    return {&coefficients, &out_of_plane, &velocity_coefficients, &out_of_plane_rates};
  }
};

enum class DataKind { kMarkers, kAngles };
enum class Use { kFit, kValidate };
enum class DataSource { kCatena, kTracker, kKinovea, kDeepLabCut };

/// One measured point: a marker on the cable or the angle of a link. Exactly one of arc_length,
/// joint (its far end), link and load says where it is.
struct PointSpec {
  std::string name;
  std::string side_column, down_column;  ///< markers
  std::string across_column;             ///< markers in space
  std::string angle_column;              ///< angles
  double arc_length = kNotGiven;         ///< m from the support along the cable
  double share =
      kNotGiven;       ///< of the cable's length, of markers spread over it: beside arc_length
  int joint = 0;       ///< marker at the far end of link `joint`, 1-based
  int link = 0;        ///< angle of this link, 1-based
  bool load = false;   ///< marker at the load
  std::string camera;  ///< in space, a marker in its picture; else empty
  std::array<double, 2> centre = {0, 0};  ///< px, of that camera
};

/// A camera that looks at a cable in space. Where it stands, where it looks and its focal length are
/// parameters (identify/problem/camera.hpp), which [[parameter]] sets.
struct CameraSpec {
  std::string name;
  std::array<double, 2> centre = {0, 0};  ///< px: where its axis meets the picture
  std::string where;                      ///< file and line
};

struct Table;  // identify/recordings/table.hpp

/// A function of time the model asks for (a support's measured motion), from two columns of a file.
struct SignalSpec {
  std::string name;  ///< as the model names it
  std::filesystem::path data;
  std::string time_column, column;  ///< s, and the unit of the signal
};

struct ExperimentSpec {
  std::string name;
  std::filesystem::path data;          ///< absolute, or relative to the working directory
  std::shared_ptr<const Table> table;  ///< what would be in that file, where a caller hands it in
  DataKind kind = DataKind::kMarkers;
  Use use = Use::kFit;
  DataSource source = DataSource::kCatena;
  double from = -std::numeric_limits<double>::infinity();  ///< s, first and last frame used
  double to = std::numeric_limits<double>::infinity();
  double fit_until = std::numeric_limits<double>::infinity();  ///< later frames only validate
  /// s: what was measured later is sealed. A diagnosis says so; no key of a case does.
  double sealed_from = std::numeric_limits<double>::infinity();
  double start = kNotGiven;  ///< model time at which the initial state holds; NaN: the first frame
  double window =
      kNotGiven;             ///< s: cut into windows, each an experiment with its own initial state
  bool joined = false;       ///< multiple shooting: each window must end where the next one starts
  int every = 1;             ///< only every so many-th frame
  double noise = kNotGiven;  ///< expected standard deviation, m or rad
  bool keep_outliers = false;     ///< else points far from the motion are not seen (outliers.hpp)
  std::vector<PointSpec> points;  ///< empty: all columns side_i_m, down_i_m or theta_i_rad
  std::optional<InitialSpec> initial;
  std::vector<SignalSpec> signals;

  // how the file says it
  std::string time_column;        ///< empty: the first column
  std::string time_unit = "s";    ///< "s", "ms" or "frames"
  double frame_rate = kNotGiven;  ///< 1/s, for "frames"
  std::string length_unit = "m";  ///< "m", "cm", "mm" or "px"
  double metres_per_pixel = kNotGiven;
  std::string angle_unit = "rad";  ///< "rad" or "deg"
  bool wrapped = false;            ///< angles jump by a turn
  bool upward = false;             ///< the vertical axis of the file points up
  bool mirrored = false;  ///< the horizontal axis (or the angle) of the file points to -side
  /// Columns AXIS_i_m hold side, down and, in space, across of marker i; empty: these words.
  std::vector<std::string> axes;
  /// The fixed point in the file's own axes and unit, in the order side, down, across; empty: zeros.
  std::vector<double> origin;
  double origin_of(std::size_t axis) const { return origin.empty() ? 0 : origin[axis]; }
  double likelihood_floor = 0.6;  ///< DeepLabCut: points less likely are not seen
  std::string where;
};

enum class Measure {
  kLeastSquares,  ///< root mean square of the residuals, weighted by the noise where given
  kMeanDistance,  ///< mean over frames and markers of the distance, (6.5), (6.6)
  kMeanAbsolute,  ///< mean over channels of the mean absolute residual, (7.1)-(7.5)
  kLikelihood,    ///< geometric mean of the channels' root mean squares: the likelihood with the
                  ///< noise of every channel unknown
};

enum class Loss { kNone, kHuber, kSoftL1, kCauchy };

struct ErrorSpec {
  Measure measure = Measure::kLeastSquares;
  Loss loss = Loss::kNone;  ///< least squares only
  double loss_scale = 3;    ///< in units of the noise
  /// Least squares only: a first fit shows the noise, a second one makes the residuals white with it.
  /// Else the noise is what the experiments state.
  bool noise_estimated = false;
};

enum class FitMethod { kNelderMead, kLeastSquares, kLbfgs, kSlsqp, kMma };

struct OptimiserSpec {
  FitMethod method = FitMethod::kNelderMead;
  int max_evaluations = 2000;
  double tolerance = 1e-6;     ///< relative, of unknowns and error
  double initial_step = 0.25;  ///< of the simplex: relative (of a scale for logarithmic unknowns)
  int starts = 1;              ///< of a multi-start: the given one, then a Latin hypercube
  unsigned seed = 1;
  std::vector<double> growing_windows;  ///< s after the start: fit that long first, then longer
};

struct SimulationSpec {
  double duration = kNotGiven;  ///< s; NaN: as long as the data
  double step = 0.01;           ///< s between outputs
  double relative_tolerance = 1e-8;
  double absolute_tolerance_position = 1e-10;  ///< rad
  double absolute_tolerance_velocity = 1e-9;   ///< rad/s
  long max_steps = 1'000'000;
};

/// What a diagnosis may take for granted.
struct DiagnosisSpec {
  double good_enough = kNotGiven;     ///< m or rad, RMS: a gap below it counts as closed
  std::vector<std::string> possible;  ///< effects that are looked for only where a case names them
  std::vector<std::string> impossible;  ///< effects that cannot be there
  std::vector<std::string>
      doubtful;  ///< parameters of the model, at their defaults, that may be off
};

/// A whole case: read by case_reader.hpp, written by case_writer.hpp, or made in a program:
///
///     Case the_case;
///     the_case.links = 12;
///     the_case.cable.length = 2.585;     // m
///     the_case.cable.density = 0.1424;   // kg/m
///     the_case.cable.load_mass = 1.381;  // kg
///     ParameterSpec stiffness;
///     stiffness.name = "EI";
///     stiffness.sets = "bending_stiffness";
///     stiffness.value = 0.04;  // N m^2
///     stiffness.free = true;
///     the_case.parameters.push_back(stiffness);
struct Case {
  std::filesystem::path file;  ///< where it was read from
  std::string text;            ///< what was read; results keep it, whatever becomes of the file
  std::string title;
  std::filesystem::path description;  ///< empty: the plain chain
  int links = 0;
  CableGeometry cable;
  std::vector<ParameterSpec> parameters;
  std::vector<CameraSpec> cameras;
  InitialSpec initial;
  std::vector<SignalSpec>
      signals;  ///< of a simulation without data, and of experiments that give none
  std::vector<ExperimentSpec> experiments;
  ErrorSpec error;
  OptimiserSpec optimiser;
  SimulationSpec simulation;
  DiagnosisSpec diagnosis;
};

}  // namespace catena
