// SPDX-License-Identifier: BSD-3-Clause
#include "identify/problem/parameter_map.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <complex>

#include "common/in_quotes.hpp"
#include "common/input_error.hpp"
#include "common/nearest_name.hpp"
#include "common/number_text.hpp"
#include "common/special_values.hpp"
#include "common/toml_reader.hpp"
#include "description/unit.hpp"

namespace catena {
namespace {

[[noreturn]] void fail(const ParameterSpec& parameter, const std::string& problem) {
  throw InputError(parameter.where + ": parameter " + in_quotes(parameter.name) + ": " + problem);
}

int find(const Model& model, const std::string& name) {
  const catena_model& table = model.table();
  for (int i = 0; i < table.parameters; ++i)
    if (name == table.parameter[i].name) return i;
  return -1;
}

/// Names a case may use, families for their members, and the physical quantities.
std::vector<std::string> known_names(const Model& model) {
  std::vector<std::string> names = {"bending_stiffness", "damping_length", "cable.length",
                                    "cable.density"};
  for (int i = 0; i < model.table().parameters; ++i) {
    const std::string name = model.table().parameter[i].name;
    const auto digits = name.find_last_not_of("0123456789");
    const bool numbered = digits + 1 < name.size() && name[digits] == '_';
    if (!numbered) names.push_back(name);
    if (name.ends_with("_1")) names.push_back(name.substr(0, digits));
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

/// What a name that the model does not have may mean.
std::string remedy(const Model& model, const std::string& word) {
  const auto digits = word.find_last_not_of("0123456789") + 1;
  const std::string number = word.substr(digits);
  const std::string stem = word.substr(0, word.ends_with("_" + number) ? digits - 1 : digits);
  if (!number.empty() && find(model, stem + "_1") >= 0) {
    const std::string member = stem + "_" + number;
    if (find(model, member) >= 0) return "; did you mean " + in_quotes(member) + "?";
    return "; there are " + stem + "_1 to " + stem + "_" + std::to_string(model.links());
  }
  for (int i = 0; i < model.table().parameters; ++i)  // without the name of its effect
    if (const std::string name = model.table().parameter[i].name; name.ends_with("." + word))
      return "; did you mean " + in_quotes(name) + "?";
  std::vector<std::string> names = known_names(model);
  if (number.empty()) return suggestion(word, names);
  for (int i = 0; i < model.table().parameters; ++i)
    names.insert(names.begin() + i, model.table().parameter[i].name);  // before the families
  const std::string near = nearest_name(word, names);
  return near.empty() ? suggestion(word, known_names(model))
                      : "; did you mean " + in_quotes(near) + "?";
}

/// EI and damping per length act on joints: the family they set, and their own unit.
struct PerLength {
  const char* name;
  const char* family;
  const char* unit;
};
constexpr PerLength kPerLength[] = {{"bending_stiffness", "stiffness", "N m^2"},
                                    {"damping_length", "damping", "N m^2 s/rad"}};

/// What a parameter sets: links or joints first..last of a family, or one parameter (last = 0).
struct Target {
  std::string stem;
  int first = 1, last = 0;
  const PerLength* per_length = nullptr;
  std::vector<int> indices;
};

Target find_target(const ParameterSpec& parameter, const Model& model) {
  Target target;
  if (const int index = find(model, parameter.sets); index >= 0) {
    target.indices = {index};
    return target;
  }
  const int links = model.links();
  target.stem = parameter.sets;
  target.last = links;
  if (parse_range(parameter.sets, target.stem, target.first, target.last) &&
      (target.first < 1 || target.last > links || target.first > target.last))
    fail(parameter, "sets = " + in_quotes(parameter.sets) + ": a range must lie within 1.." +
                        std::to_string(links));
  for (const PerLength& entry : kPerLength)
    if (target.stem == entry.name) target.per_length = &entry;
  target.indices = family(model, target.per_length ? target.per_length->family : target.stem,
                          target.first, target.last);
  if (target.indices.empty())
    fail(parameter, "sets = " + in_quotes(parameter.sets) + ": the model has no such parameter" +
                        remedy(model, parameter.sets));
  return target;
}

void check_unit(const ParameterSpec& parameter, const std::string& wanted) {
  if (parameter.unit.empty()) return;
  Unit given;
  try {
    given = Unit::parse(parameter.unit);
  } catch (const std::invalid_argument& error) {
    fail(parameter, "unit = " + in_quotes(parameter.unit) + ": " + error.what());
  }
  if (!(given == Unit::parse(wanted)))
    fail(parameter,
         "unit = " + in_quotes(parameter.unit) + ": " + parameter.sets + " is in " + wanted);
}

}  // namespace

ParameterMap::ParameterMap(const Case& the_case, const Model& model) : links_(model.links()) {
  const CableGeometry& cable = the_case.cable;
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

  std::vector<const ParameterSpec*> set_by(static_cast<std::size_t>(model.parameters()), nullptr);
  bool length_set = false, density_set = false;
  for (std::size_t j = 0; j < the_case.parameters.size(); ++j) {
    const ParameterSpec& parameter = the_case.parameters[j];
    Assignment assignment;
    assignment.factor = parameter.factor;
    if (parameter.sets == "cable.length" || parameter.sets == "cable.density") {
      const bool is_length = parameter.sets == "cable.length";
      check_unit(parameter, is_length ? "m" : "kg/m");
      assignment.kind = is_length ? Kind::kLength : Kind::kDensity;
      if (!is_length && masses_given_)
        fail(parameter,
             "sets = \"cable.density\": [cable] gives link_masses; give density instead");
      if (std::exchange(is_length ? length_set : density_set, true))
        fail(parameter, "sets = " + in_quotes(parameter.sets) + ": set twice");
    } else {
      Target target = find_target(parameter, model);
      check_unit(parameter, target.per_length
                                ? target.per_length->unit
                                : model.table().parameter[target.indices.front()].unit);
      if (target.per_length) assignment.kind = Kind::kPerSpacing;
      assignment.first = target.first - 1;
      assignment.targets = std::move(target.indices);
      for (const int target : assignment.targets) {
        const ParameterSpec*& other = set_by[static_cast<std::size_t>(target)];
        if (other)
          fail(parameter, std::string("sets ") + model.table().parameter[target].name +
                              ", which parameter " + in_quotes(other->name) + " (" + other->where +
                              ") sets already");
        other = &parameter;
      }
    }
    assignment.admitted = admitted_by(model, assignment);
    assignments_.push_back(std::move(assignment));
  }
  const Eigen::VectorXd array = (*this)(case_values(the_case));
  for (Eigen::Index i = 0; i < array.size(); ++i)
    if (std::isnan(array[i])) {
      const catena_parameter& entry = model.table().parameter[i];
      throw InputError(the_case.file.string() + ": the model's " + entry.name + " (" + entry.unit +
                       ") has no value; add a [[parameter]] that sets it");
    }
}

ParameterMap::Range ParameterMap::admitted_by(const Model& model, const Assignment& assignment) {
  const double factor = assignment.factor;
  const bool geometry = assignment.targets.empty();  // which must be positive
  Range of_model{geometry ? 0 : -kInfinite, kInfinite};
  for (const int target : assignment.targets) {
    const catena_parameter& entry = model.table().parameter[target];
    of_model.lower = std::max(of_model.lower, entry.lower);
    of_model.upper = std::min(of_model.upper, entry.upper);
  }
  // Other bounds of what is divided by a spacing hang on the lengths, which may be unknown.
  if (assignment.kind == Kind::kPerSpacing) {
    if (of_model.lower != 0) of_model.lower = -kInfinite;
    if (of_model.upper != 0) of_model.upper = kInfinite;
  }
  // Rounded, the product with the factor must not lie beyond the bound.
  const auto value_at = [&](double bound, double inwards) {
    double value = bound / factor;
    while (inwards * (factor * value - bound) < 0)
      value = std::nextafter(value, inwards * factor > 0 ? kInfinite : -kInfinite);
    return value;
  };
  const double lower = value_at(of_model.lower, 1), upper = value_at(of_model.upper, -1);
  return factor > 0 ? Range{lower, upper} : Range{upper, lower};
}

void ParameterMap::check_values(const Case& the_case, const Model& model) const {
  for (std::size_t j = 0; j < assignments_.size(); ++j) {
    const ParameterSpec& parameter = the_case.parameters[j];
    const auto check = [&](double given) {
      const double value = parameter.factor * given;  // per spacing: its sign counts
      if (assignments_[j].targets.empty() && !(value > 0))
        fail(parameter, "value = " + shortest_number(given) + ": must be positive");
      for (const int target : assignments_[j].targets) {
        const catena_parameter& entry = model.table().parameter[target];
        if (value < entry.lower || value > entry.upper)
          fail(parameter, "sets " + std::string(entry.name) + " to " + shortest_number(value) +
                              "; it must lie within " + shortest_number(entry.lower) + " and " +
                              shortest_number(entry.upper));
      }
    };
    check(parameter.value);
    const Range& admitted = assignments_[j].admitted;
    if (parameter.free &&
        !(std::max(parameter.lower, admitted.lower) < std::min(parameter.upper, admitted.upper)))
      fail(parameter, "lower = " + shortest_number(parameter.lower) + ", upper = " +
                          shortest_number(parameter.upper) + ": a free parameter needs room, and " +
                          parameter.sets + " admits only " + shortest_number(parameter.value) +
                          " of that; change the bounds, or leave free out");
    for (const auto& [experiment, value] : parameter.values) check(value);
  }
}

Eigen::VectorXd case_values(const Case& the_case, const std::string& experiment) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(the_case.parameters.size()));
  for (std::size_t j = 0; j < the_case.parameters.size(); ++j)
    values[static_cast<Eigen::Index>(j)] = the_case.parameters[j].value_in(experiment);
  return values;
}

Eigen::VectorXd link_lengths(const Model& model, const Eigen::VectorXd& parameters) {
  return parameters.segment(model.parameter_index("length_1"), model.links());
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
  const Vector masses =
      masses_given_ ? Vector(masses_.template cast<T>()) : Vector(lengths * density);
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
        const Eigen::Index i = assignment.first + static_cast<Eigen::Index>(k);
        p[assignment.targets[k]] =
            value / ((i == 0 ? lengths[0] : lengths[i - 1] + lengths[i]) * T(0.5));
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
