// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/checking/flat_derivation.hpp"

#include <functional>
#include <utility>

namespace catena::checking {
namespace {

using GiNaC::ex;

Contributions joined(Contributions first, const Contributions& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

/// Applies an operation to every part and drops parts that become zero.
Contributions each(const Contributions& parts, const std::function<ex(const ex&)>& operation) {
  Contributions result;
  for (const Contribution& part : parts) {
    ex value = operation(part.value);
    if (!value.is_zero()) result.push_back({part.origin, std::move(value)});
  }
  return result;
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
  ex joint_down = 0, joint_side = 0, joint_height = 0;  // the joint above the link
  const auto kinetic_energy = [&](const ex& mass, const ex& down, const ex& side) {
    return half * mass *
           (GiNaC::pow(symbols.time_derivative(down), 2) +
            GiNaC::pow(symbols.time_derivative(side), 2));
  };
  for (std::size_t k = 1; k < symbols.angle.size(); ++k) {
    const std::string index = std::to_string(k);
    const ex& theta = symbols.angle[k];
    const ex& l = symbols.length[k];
    const ex& m = symbols.mass[k];
    const ex down = joint_down + l / 2 * GiNaC::cos(theta);            // (2.24)
    const ex side = joint_side + l / 2 * GiNaC::sin(theta);            // (2.24)
    const ex height = joint_height + l / 2 * (1 - GiNaC::cos(theta));  // (2.7)
    kinetic_.push_back({"kinetic energy of link " + index, kinetic_energy(m, down, side)});
    kinetic_.push_back({"rotational energy of link " + index,
                        half * symbols.inertia[k] * GiNaC::pow(symbols.rate[k], 2)});
    gravity_potential_.push_back({"gravity of link " + index, m * symbols.gravity * height});
    elastic_potential_.push_back(
        {"spring of joint " + index,
         half * symbols.stiffness[k] * GiNaC::pow(theta - symbols.angle[k - 1], 2)});
    dissipation_.push_back(
        {"damper of joint " + index,
         half * symbols.damping[k] * GiNaC::pow(symbols.rate[k] - symbols.rate[k - 1], 2)});
    joint_down += l * GiNaC::cos(theta);
    joint_side += l * GiNaC::sin(theta);
    joint_height += l * (1 - GiNaC::cos(theta));
  }
  kinetic_.push_back(  // (2.25): the load sits at the end of the last link
      {"kinetic energy of the load", kinetic_energy(symbols.load_mass, joint_down, joint_side)});
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
  return each(dissipation_, [&](const ex& part) {
    return derivative(derivative(part, symbols_.rate[static_cast<std::size_t>(i)]),
                      symbols_.rate[static_cast<std::size_t>(j)]);
  });
}

Contributions FlatDerivation::stiffness(int i, int j) const {
  return each(elastic_potential_, [&](const ex& part) {
    return derivative(derivative(part, symbols_.angle[static_cast<std::size_t>(i)]),
                      symbols_.angle[static_cast<std::size_t>(j)]);
  });
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
