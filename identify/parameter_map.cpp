// SPDX-License-Identifier: BSD-3-Clause
#include "identify/parameter_map.hpp"

#include <charconv>
#include <cmath>
#include <complex>

#include "generator/description/input_error.hpp"
#include "generator/description/nearest_name.hpp"
#include "generator/description/toml_reader.hpp"
#include "generator/description/unit.hpp"

namespace catena {
namespace {

[[noreturn]] void fail(const ParameterSpec& parameter, const std::string& problem) {
  throw InputError(parameter.where + ": parameter \"" + parameter.name + "\": " + problem);
}

int find(const Model& model, const std::string& name) {
  const catena_model& table = model.table();
  for (int i = 0; i < table.parameters; ++i)
    if (name == table.parameter[i].name) return i;
  return -1;
}

/// Names a case may use: families as well as single parameters, and the physical quantities.
std::vector<std::string> known_names(const Model& model) {
  std::vector<std::string> names = {"bending_stiffness", "damping_length", "cable.length",
                                    "cable.density"};
  for (int i = 0; i < model.table().parameters; ++i) {
    const std::string name = model.table().parameter[i].name;
    names.push_back(name);
    if (name.ends_with("_1")) names.push_back(name.substr(0, name.size() - 2));
  }
  return names;
}

std::vector<int> family(const Model& model, const std::string& stem, int first, int last) {
  std::vector<int> indices;
  for (int i = first; i <= last; ++i) {
    const int index = find(model, stem + "_" + std::to_string(i));
    if (index < 0) return {};
    indices.push_back(index);
  }
  return indices;
}

/// "stiffness_2..12" -> stiffness, 2, 12
bool parse_range(const std::string& text, std::string& stem, int& first, int& last) {
  const auto dots = text.find("..");
  const auto line = text.rfind('_', dots);
  if (dots == std::string::npos || line == std::string::npos) return false;
  const auto number = [&](std::size_t begin, std::size_t end, int& value) {
    const auto [stop, error] = std::from_chars(text.data() + begin, text.data() + end, value);
    return error == std::errc() && stop == text.data() + end;
  };
  stem = text.substr(0, line);
  return number(line + 1, dots, first) && number(dots + 2, text.size(), last);
}

std::vector<int> find_targets(const ParameterSpec& parameter, const Model& model) {
  const int links = model.links();
  if (const int index = find(model, parameter.sets); index >= 0) return {index};
  std::string stem;
  int first = 1, last = links;
  std::vector<int> targets;
  if (parse_range(parameter.sets, stem, first, last)) {
    if (first < 1 || last > links || first > last)
      fail(parameter, "sets = \"" + parameter.sets + "\": a range must lie within 1.." +
                          std::to_string(links));
    targets = family(model, stem, first, last);
  } else {
    targets = family(model, parameter.sets, 1, links);
  }
  if (targets.empty())
    fail(parameter, "sets = \"" + parameter.sets + "\": the model has no such parameter" +
                        suggestion(parameter.sets, known_names(model)));
  return targets;
}

void check_unit(const ParameterSpec& parameter, const std::string& wanted) {
  if (parameter.unit.empty()) return;
  Unit given;
  try {
    given = Unit::parse(parameter.unit);
  } catch (const std::invalid_argument& error) {
    fail(parameter, "unit = \"" + parameter.unit + "\": " + error.what());
  }
  if (!(given == Unit::parse(wanted)))
    fail(parameter, "unit = \"" + parameter.unit + "\": " + parameter.sets + " is in " + wanted);
}

}  // namespace

ParameterMap::ParameterMap(const Case& study, const Model& model) : links_(model.links()) {
  const CableGeometry& cable = study.cable;
  const Eigen::Index n = links_;
  relative_lengths_ = Eigen::VectorXd::Constant(n, 1.0 / links_);
  length_ = cable.length;
  if (!cable.link_lengths.empty()) {
    const Eigen::Map<const Eigen::VectorXd> lengths(cable.link_lengths.data(), n);
    length_ = lengths.sum();
    relative_lengths_ = lengths / length_;
  }
  masses_given_ = !cable.link_masses.empty();
  inertias_given_ = !cable.link_inertias.empty();
  density_ = cable.density;
  if (masses_given_) masses_ = Eigen::Map<const Eigen::VectorXd>(cable.link_masses.data(), n);
  if (inertias_given_) inertias_ = Eigen::Map<const Eigen::VectorXd>(cable.link_inertias.data(), n);
  length_index_ = model.parameter_index("length_1");
  mass_index_ = model.parameter_index("mass_1");
  inertia_index_ = model.parameter_index("inertia_1");
  base_ = model.default_parameters();
  base_[model.parameter_index("load_mass")] = cable.load_mass;
  base_[model.parameter_index("gravity")] = cable.gravity;

  values_.resize(static_cast<Eigen::Index>(study.parameters.size()));
  std::vector<const ParameterSpec*> set_by(static_cast<std::size_t>(model.parameters()), nullptr);
  bool length_set = false, density_set = false;
  for (std::size_t j = 0; j < study.parameters.size(); ++j) {
    const ParameterSpec& parameter = study.parameters[j];
    values_[static_cast<Eigen::Index>(j)] = parameter.value;
    Assignment assignment;
    assignment.factor = parameter.factor;
    if (parameter.sets == "cable.length" || parameter.sets == "cable.density") {
      const bool is_length = parameter.sets == "cable.length";
      check_unit(parameter, is_length ? "m" : "kg/m");
      assignment.kind = is_length ? Kind::kLength : Kind::kDensity;
      if (!is_length && masses_given_)
        fail(parameter, "sets = \"cable.density\": [cable] gives link_masses; give density instead");
      if (std::exchange(is_length ? length_set : density_set, true))
        fail(parameter, "sets = \"" + parameter.sets + "\": set twice");
      if (!(parameter.factor * parameter.value > 0))
        fail(parameter, "value = " + shortest_number(parameter.value) + ": must be positive");
    } else {
      const bool stiffness = parameter.sets == "bending_stiffness";
      if (stiffness || parameter.sets == "damping_length") {
        check_unit(parameter, stiffness ? "N m^2" : "N m^2 s/rad");
        assignment.kind = Kind::kPerSpacing;
        assignment.targets = family(model, stiffness ? "stiffness" : "damping", 1, links_);
        for (int i = 0; i < links_; ++i) assignment.joints.push_back(i);
      } else {
        assignment.targets = find_targets(parameter, model);
        check_unit(parameter, model.table().parameter[assignment.targets.front()].unit);
      }
      for (const int target : assignment.targets) {
        const catena_parameter& entry = model.table().parameter[target];
        const double value = parameter.factor * parameter.value;
        if (value < entry.lower || value > entry.upper)
          fail(parameter, "sets " + std::string(entry.name) + " to " + shortest_number(value) +
                              "; it must lie within " + shortest_number(entry.lower) + " and " +
                              shortest_number(entry.upper));
        const ParameterSpec*& other = set_by[static_cast<std::size_t>(target)];
        if (other)
          fail(parameter, std::string("sets ") + entry.name + ", which parameter \"" + other->name +
                              "\" (" + other->where + ") sets already");
        other = &parameter;
      }
    }
    assignments_.push_back(std::move(assignment));
  }
  const Eigen::VectorXd array = (*this)(values_);
  for (Eigen::Index i = 0; i < array.size(); ++i)
    if (std::isnan(array[i])) {
      const catena_parameter& entry = model.table().parameter[i];
      throw InputError(study.file.string() + ": the model's " + entry.name + " (" + entry.unit +
                       ") has no value; add a [[parameter]] that sets it");
    }
}

template <class T>
Eigen::Vector<T, Eigen::Dynamic> ParameterMap::map(
    const Eigen::Vector<T, Eigen::Dynamic>& values) const {
  using Vector = Eigen::Vector<T, Eigen::Dynamic>;
  T length = length_, density = density_;
  for (std::size_t j = 0; j < assignments_.size(); ++j) {
    const T value = assignments_[j].factor * values[static_cast<Eigen::Index>(j)];
    if (assignments_[j].kind == Kind::kLength) length = value;
    if (assignments_[j].kind == Kind::kDensity) density = value;
  }
  Vector p = base_.template cast<T>();
  const Vector lengths = relative_lengths_.template cast<T>() * length;
  const Vector masses = masses_given_ ? Vector(masses_.template cast<T>()) : Vector(lengths * density);
  p.segment(length_index_, links_) = lengths;
  p.segment(mass_index_, links_) = masses;
  if (inertias_given_)
    p.segment(inertia_index_, links_) = inertias_.template cast<T>();
  else  // a uniform rod about its middle
    p.segment(inertia_index_, links_) = masses.array() * lengths.array().square() / T(12);
  for (std::size_t j = 0; j < assignments_.size(); ++j) {
    const Assignment& assignment = assignments_[j];
    const T value = assignment.factor * values[static_cast<Eigen::Index>(j)];
    for (std::size_t k = 0; k < assignment.targets.size(); ++k) {
      if (assignment.kind == Kind::kModel) {
        p[assignment.targets[k]] = value;
      } else {
        const Eigen::Index i = assignment.joints[k];
        p[assignment.targets[k]] =
            value / (i == 0 ? lengths[0] : (lengths[i - 1] + lengths[i]) * T(0.5));
      }
    }
  }
  return p;
}

Eigen::VectorXd ParameterMap::operator()(const Eigen::VectorXd& values) const {
  return map<double>(values);
}

Eigen::MatrixXd ParameterMap::jacobian(const Eigen::VectorXd& values) const {
  // Complex step: the map is rational, so Im p(x + i h e_j) / h is the derivative to rounding.
  constexpr double h = 1e-100;
  Eigen::MatrixXd jacobian(base_.size(), values.size());
  for (Eigen::Index j = 0; j < values.size(); ++j) {
    Eigen::VectorXcd moved = values.cast<std::complex<double>>();
    moved[j] += std::complex<double>(0, h);
    jacobian.col(j) = map<std::complex<double>>(moved).imag() / h;
  }
  return jacobian;
}

}  // namespace catena
