// SPDX-License-Identifier: BSD-3-Clause
#include "identify/problem/camera.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <string>

#include "common/in_quotes.hpp"
#include "common/input_error.hpp"
#include "identify/problem/extended_model.hpp"

namespace catena {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kFar = 1e5;  // m
constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kMostDistortion = 0.5;  // wide-angle lenses have -0.4
constexpr Index kCount = 8;
constexpr catena_parameter kParameters[kCount] = {
    {"side", "m", "Where the camera stands", 0, -kFar, kFar, kNotGiven},
    {"down", "m", "Where the camera stands", 0, -kFar, kFar, kNotGiven},
    {"across", "m", "Where the camera stands", kNotGiven, -kFar, kFar, kNotGiven},
    {"pan", "rad", "Turns the camera's axis from across towards side", 0, -kTurn, kTurn, kNotGiven},
    {"tilt", "rad", "Turns the camera's axis downwards", 0, -kTurn, kTurn, kNotGiven},
    {"roll", "rad", "Turns the camera about its axis, from right to down", 0, -kTurn, kTurn,
     kNotGiven},
    {"focal_length", "1", "Focal length of the camera, px", kNotGiven, 1, 1e6, kNotGiven},
    {"lens", "1", "Radial distortion k1 of the camera's lens", 0, -kMostDistortion, kMostDistortion,
     kNotGiven},
};

/// The components of a vector along the camera's right, its down and its axis.
template <class T>
Eigen::Vector<T, 3> in_camera(const T& pan, const T& tilt, const T& roll,
                              const Eigen::Vector<T, 3>& v) {
  using std::cos, std::sin;
  const T right = cos(pan) * v[0] - sin(pan) * v[2], ahead = sin(pan) * v[0] + cos(pan) * v[2];
  const T below = cos(tilt) * v[1] - sin(tilt) * ahead;
  return {cos(roll) * right + sin(roll) * below, cos(roll) * below - sin(roll) * right,
          sin(tilt) * v[1] + cos(tilt) * ahead};
}

/// `p`: the parameters of one camera.
template <class T>
Eigen::Vector<T, 2> project(const Eigen::Vector<T, kCount>& p, const Eigen::Vector<T, 3>& point) {
  const Eigen::Vector<T, 3> from_camera = point - p.template head<3>();
  const Eigen::Vector<T, 3> seen = in_camera(p[3], p[4], p[5], from_camera);
  const Eigen::Vector<T, 2> straight = seen.template head<2>() / seen[2];
  return p[6] * (T(1) + p[7] * (straight[0] * straight[0] + straight[1] * straight[1])) * straight;
}

/// The square of the distance from the axis, over what is ahead, where a lens bends the picture back on itself.
double seen_twice_from(double lens) {
  return lens < 0 ? -1 / (3 * lens) : std::numeric_limits<double>::infinity();
}

/// r of r (1 + lens r^2) = distorted, the least one; where the picture bends back there is none beyond.
double straightened(double distorted, double lens) {
  const double most = std::sqrt(seen_twice_from(lens));
  double r = std::min(distorted, most);
  for (int step = 0; step < 50;
       ++step) {  // Newton: from below if the lens is a barrel, else from above
    const double slope = 1 + 3 * lens * r * r, excess = r * (1 + lens * r * r) - distorted;
    if (!(slope > 0) || std::abs(excess) < 1e-15 * (1 + distorted)) break;
    r = std::min(r - excess / slope, most);
  }
  return r;
}

bool same_place(const PointSpec& a, const PointSpec& b) {
  const bool by_arc_length = a.joint == 0 && !a.load && b.joint == 0 && !b.load;
  return a.joint == b.joint && a.load == b.load && (!by_arc_length || a.arc_length == b.arc_length);
}

}  // namespace

Model with_cameras(const Case& the_case, Model model) {
  if (the_case.cameras.empty()) return model;
  const auto refuse = [&](const CameraSpec& camera, const std::string& problem) {
    throw InputError(camera.where + ": camera " + in_quotes(camera.name) + ": " + problem);
  };
  if (!model.in_space())
    refuse(the_case.cameras.front(),
           "the model moves in the plane, whose pictures need no camera; leave it out, or give a "
           "model with space = \"3d\"");
  const catena_model& table = model.table();
  for (int i = 0; i < table.parameters; ++i)
    if (table.parameter[i].description == kParameters[0].description) return model;  // it has them
  std::vector<SensorParameter> parameters;
  for (const CameraSpec& camera : the_case.cameras) {
    const auto taken = [&](const auto& name) {
      return std::string(name).starts_with(camera.name + ".");
    };
    for (int i = 0; i < table.parameters; ++i)
      if (taken(table.parameter[i].name))
        refuse(camera, "an effect of the model has this name; give the camera another one");
    for (const catena_parameter& parameter : kParameters)
      parameters.push_back({camera.name + "." + parameter.name, parameter});
  }
  return extended_model(model, parameters);
}

Camera::Camera(const Model& model, const std::string& name)
    : first_(model.parameter_index(name + "." + kParameters[0].name)) {}

Vector2d Camera::picture(const VectorXd& parameters, const Vector3d& point) const {
  const Eigen::Vector<double, kCount> p = parameters.segment<kCount>(first_);
  const Vector3d seen = in_camera<double>(p[3], p[4], p[5], point - p.head<3>());
  if (!(seen[2] > 0) || !(seen.head<2>().squaredNorm() < seen_twice_from(p[7]) * seen[2] * seen[2]))
    return Vector2d::Constant(kNotGiven);
  return project<double>(p, point);
}

Vector2d Camera::picture_tangent(const VectorXd& parameters, const VectorXd& along,
                                 const Vector3d& point, const Vector3d& change) const {
  // A step into the imaginary gives the derivative without a difference.
  constexpr std::complex<double> kStep(0, 1e-100);
  using Complex = std::complex<double>;
  const Eigen::Vector<Complex, kCount> p = parameters.segment<kCount>(first_).cast<Complex>() +
                                           kStep * along.segment<kCount>(first_).cast<Complex>();
  const Eigen::Vector<Complex, 3> moved = point.cast<Complex>() + kStep * change.cast<Complex>();
  return project<Complex>(p, moved).imag() / kStep.imag();
}

Vector3d Camera::place(const VectorXd& parameters) const { return parameters.segment<3>(first_); }

Vector3d Camera::ray(const VectorXd& parameters, const Vector2d& picture) const {
  const auto p = parameters.segment<kCount>(first_);
  Matrix3d axes;  // rows: the camera's right, its down, its axis
  for (Index k = 0; k < 3; ++k)
    axes.col(k) = in_camera<double>(p[3], p[4], p[5], Vector3d::Unit(k));
  const double distorted = picture.norm() / p[6];
  const double scale = distorted > 0 ? straightened(distorted, p[7]) / distorted : 1;
  return (axes.transpose() * Vector3d(scale * picture[0], scale * picture[1], p[6])).normalized();
}

std::vector<int> markers_of(const std::vector<PointSpec>& points) {
  std::vector<int> markers;
  int count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::size_t first = 0;
    while (!same_place(points[first], points[i])) ++first;
    markers.push_back(first < i ? markers[first] : count++);
  }
  return markers;
}

Recording positions_from_pictures(const Recording& pictures, const Model& model,
                                  const VectorXd& parameters, double metres_per_pixel) {
  constexpr double kWeak = 1e-9;  // of a ray: decides only what one ray leaves open
  Recording found;
  found.time = pictures.time;
  found.fit_frames = pictures.fit_frames;
  std::vector<std::vector<Index>> of_marker;  // points of the pictures
  const std::vector<int> markers = markers_of(pictures.points);
  for (std::size_t i = 0; i < pictures.points.size(); ++i) {
    const PointSpec& point = pictures.points[i];
    const int index = markers[i];
    const auto marker = static_cast<std::size_t>(index);
    if (marker == found.points.size()) {
      found.points.push_back(point);
      for (const auto& [component, word] : {std::pair{Component::kSide, " side"},
                                            {Component::kDown, " down"},
                                            {Component::kAcross, " across"}})
        found.channels.push_back({index, component, point.name + word});
      of_marker.emplace_back();
    }
    of_marker[marker].push_back(static_cast<Index>(i));
  }
  std::vector<Camera> cameras;
  for (const PointSpec& point : pictures.points) cameras.emplace_back(model, point.camera);
  found.measured.setConstant(static_cast<Index>(found.channels.size()), pictures.measured.cols(),
                             kNotGiven);
  for (Index k = 0; k < pictures.measured.cols(); ++k)
    for (std::size_t marker = 0; marker < of_marker.size(); ++marker) {
      Matrix3d across_rays = kWeak * Vector3d::UnitZ() * Vector3d::UnitZ().transpose();
      Vector3d right = Vector3d::Zero();
      bool seen = false;
      for (const Index i : of_marker[marker]) {
        const Vector2d picture = pictures.measured.block<2, 1>(2 * i, k) / metres_per_pixel;
        if (picture.hasNaN()) continue;
        seen = true;
        const Camera& camera = cameras[static_cast<std::size_t>(i)];
        const Vector3d ray = camera.ray(parameters, picture);
        const Matrix3d across = Matrix3d::Identity() - ray * ray.transpose();
        across_rays += across;
        right += across * camera.place(parameters);
      }
      if (seen)
        found.measured.block<3, 1>(3 * static_cast<Index>(marker), k) =
            across_rays.partialPivLu().solve(right);
    }
  return found;
}

}  // namespace catena
