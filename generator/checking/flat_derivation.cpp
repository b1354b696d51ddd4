// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/checking/flat_derivation.hpp"

#include <functional>
#include <stdexcept>
#include <utility>

#include "generator/checking/budget.hpp"

namespace catena::checking {
namespace {

using GiNaC::ex;

Contributions joined(Contributions first, const Contributions& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

/// Applies an operation to every part and drops parts that become zero. The part of the k-th link has terms of k links.
Contributions each(const Contributions& parts, const std::function<ex(const ex&)>& operation) {
  const auto count = static_cast<double>(parts.size());
  Budget::spend(count * (count + 1) / 2);
  Contributions result;
  for (const Contribution& part : parts) {
    ex value = operation(part.value);
    if (!value.is_zero()) result.push_back({part.origin, std::move(value)});
  }
  return result;
}

ex dot(const std::vector<ex>& a, const std::vector<ex>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

std::vector<ex> cross(const std::vector<ex>& a, const std::vector<ex>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

ex total(const Contributions& parts) {
  GiNaC::exvector values;
  for (const Contribution& part : parts) values.push_back(part.value);
  return GiNaC::add(values);
}

FlatDerivation::FlatDerivation(const ChainSymbols& symbols, EffectParts effects)
    : symbols_(symbols), effects_(std::move(effects)) {
  effects_.equation.resize(symbols.angle.size());
  const ex half = GiNaC::numeric(1, 2);
  const bool in_plane = symbols.space == Space::kPlane;
  std::vector<ex> joint(3);  // where the joint above the link is
  ex joint_height = 0;
  const auto velocity = [&](const std::vector<ex>& position) {
    std::vector<ex> result;
    result.reserve(position.size());
    for (const ex& component : position) result.push_back(symbols.time_derivative(component));
    return result;
  };
  const auto moved = [](std::vector<ex> from, const ex& distance, const std::vector<ex>& along) {
    for (std::size_t axis = 0; axis < 3; ++axis) from[axis] += distance * along[axis];
    return from;
  };
  const auto kinetic_energy = [&](const ex& mass, const std::vector<ex>& position) {
    const std::vector<ex> v = velocity(position);
    return half * mass * dot(v, v);
  };
  for (std::size_t k = 1; k < symbols.length.size(); ++k) {
    const std::string index = std::to_string(k);
    const std::vector<ex>& q = symbols.direction[k];
    const std::vector<ex>& above = symbols.direction[k - 1];
    const ex& l = symbols.length[k];
    const ex& m = symbols.mass[k];
    const ex height = joint_height + l / 2 * (1 - q[1]);  // (2.7)
    kinetic_.push_back(                                   // (2.24)
        {"kinetic energy of link " + index, kinetic_energy(m, moved(joint, l / 2, q))});
    const std::vector<ex> rate = velocity(q), rate_above = velocity(above);
    kinetic_.push_back({"rotational energy of link " + index,
                        half * symbols.inertia[k] *
                            (in_plane ? GiNaC::pow(symbols.rate[k], 2) : dot(rate, rate))});
    gravity_potential_.push_back({"gravity of link " + index, m * symbols.gravity * height});
    const ex bend =
        in_plane ? ex(symbols.angle[k] - symbols.angle[k - 1]) : ex(GiNaC::acos(dot(above, q)));
    elastic_potential_.push_back(
        {"spring of joint " + index, half * symbols.stiffness[k] * GiNaC::pow(bend, 2)});
    elastic_at_plumb_.push_back(
        {"spring of joint " + index, symbols.stiffness[k] * (1 - dot(above, q))});
    std::vector<ex> turning{symbols.rate[k] - symbols.rate[k - 1], 0, 0};
    if (!in_plane) turning = moved(cross(q, rate), -1, cross(above, rate_above));
    dissipation_.push_back(
        {"damper of joint " + index, half * symbols.damping[k] * dot(turning, turning)});
    joint = moved(joint, l, q);
    joint_height += l * (1 - q[1]);
  }
  kinetic_.push_back(  // (2.25): the load sits at the end of the last link
      {"kinetic energy of the load", kinetic_energy(symbols.load_mass, joint)});
  gravity_potential_.push_back(
      {"gravity of the load", symbols.load_mass * symbols.gravity * joint_height});
}

Contributions FlatDerivation::kinetic() const { return joined(kinetic_, effects_.kinetic); }

Contributions FlatDerivation::potential() const {
  return joined(joined(elastic_potential_, gravity_potential_), effects_.potential);
}

Contributions FlatDerivation::dissipation() const {
  return joined(dissipation_, effects_.dissipation);
}

Contributions FlatDerivation::lagrangian() const {
  return joined(kinetic(), each(potential(), [](const ex& part) { return -part; }));
}

Contributions FlatDerivation::inertial(int i) const {
  const auto index = static_cast<std::size_t>(i);
  return each(kinetic_, [&](const ex& part) {
    return symbols_.time_derivative(derivative(part, symbols_.rate[index])) -
           derivative(part, symbols_.angle[index]);
  });
}

Contributions FlatDerivation::mass(int i, int j) const {
  // d/dthetaddot_j of d/dt dT/dthetadot_i, by the chain rule of d/dt.
  const auto column = static_cast<std::size_t>(j);
  return joined(
      each(momentum(i), [&](const ex& part) { return derivative(part, symbols_.rate[column]); }),
      each(effects_.equation[static_cast<std::size_t>(i)],
           [&](const ex& part) { return derivative(part, symbols_.acceleration[column]); }));
}

const Contributions& FlatDerivation::momentum(int i) const {
  const auto known = momenta_.find(i);
  if (known != momenta_.end()) return known->second;
  return momenta_[i] = each(kinetic_, [&](const ex& part) {
           return derivative(part, symbols_.rate[static_cast<std::size_t>(i)]);
         });
}

Contributions FlatDerivation::damping(int i, int j) const {
  return at_plumb(each(dissipation_, [&](const ex& part) {
    return derivative(derivative(part, symbols_.rate[static_cast<std::size_t>(i)]),
                      symbols_.rate[static_cast<std::size_t>(j)]);
  }));
}

Contributions FlatDerivation::stiffness(int i, int j) const {
  const bool in_plane = symbols_.space == Space::kPlane;
  return at_plumb(each(in_plane ? elastic_potential_ : elastic_at_plumb_, [&](const ex& part) {
    return derivative(derivative(part, symbols_.angle[static_cast<std::size_t>(i)]),
                      symbols_.angle[static_cast<std::size_t>(j)]);
  }));
}

Contributions FlatDerivation::at_plumb(const Contributions& parts) const {
  if (symbols_.space == Space::kPlane) return parts;  // C and K of the plane hold no angles
  GiNaC::exmap plumb;
  for (std::size_t i = 1; i < symbols_.angle.size(); ++i) plumb[symbols_.angle[i]] = 0;
  const auto there = [&](const ex& value) {
    return value.subs(plumb, GiNaC::subs_options::no_pattern);
  };
  for (const std::vector<ex>& q : symbols_.direction)
    if (there(q[0]) != 0 || there(q[1]) != 1 || there(q[2]) != 0)
      throw std::domain_error(
          "C and K are those of small motions about the plumb cable, but where all angles are zero "
          "the "
          "links do not point down");
  return each(parts, there);
}

Contributions FlatDerivation::coriolis(int i) const {
  GiNaC::exmap at_rest;
  for (std::size_t j = 1; j < symbols_.acceleration.size(); ++j)
    at_rest[symbols_.acceleration[j]] = 0;
  return each(inertial(i),
              [&](const ex& part) { return part.subs(at_rest, GiNaC::subs_options::no_pattern); });
}

Contributions FlatDerivation::gravity(int i) const {
  return each(gravity_potential_, [&](const ex& part) {
    return derivative(part, symbols_.angle[static_cast<std::size_t>(i)]);
  });
}

Contributions FlatDerivation::equation(int i) const {
  const auto index = static_cast<std::size_t>(i);
  Contributions result = inertial(i);
  for (const Contributions* potentials : {&elastic_potential_, &gravity_potential_})
    result = joined(std::move(result), each(*potentials, [&](const ex& part) {
                      return derivative(part, symbols_.angle[index]);
                    }));
  result = joined(std::move(result), each(dissipation_, [&](const ex& part) {
                    return derivative(part, symbols_.rate[index]);
                  }));
  result = joined(std::move(result), effects_.equation[index]);
  result.push_back({"torque T_" + std::to_string(i), -symbols_.torque[index]});
  return result;
}

}  // namespace catena::checking
