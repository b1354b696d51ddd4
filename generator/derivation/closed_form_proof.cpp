// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/derivation/closed_form_proof.hpp"

#include "generator/derivation/chain.hpp"
#include "generator/derivation/entry_comparison.hpp"
#include "generator/derivation/structure.hpp"
#include "generator/derivation/written_out.hpp"
#include "reference/coriolis.hpp"
#include "reference/gravity.hpp"
#include "reference/joint_matrix.hpp"
#include "reference/mass_matrix.hpp"

namespace catena {

using GiNaC::ex;

namespace {

ex difference(const ex& model, const ex& closed_form) {
  WriteOutDifferences write_out;
  return model - write_out(closed_form);
}

std::vector<ex> family(Chain& chain, const char* name) {
  std::vector<ex> symbols;
  for (int i = 1; i <= chain.links(); ++i) symbols.push_back(chain.definitions().input(name, i));
  return symbols;
}

}  // namespace

ChainSymbols::ChainSymbols(int links) {
  const auto family = [&](const char* name) {
    std::vector<ex> symbols;
    for (int i = 1; i <= links; ++i) {
      symbols.push_back(GiNaC::realsymbol(name + std::string("_") + std::to_string(i)));
    }
    return symbols;
  };
  theta = family("theta");
  rate = family("theta_dot");
  acceleration = family("theta_ddot");
  length = family("length");
  mass = family("mass");
  inertia = family("inertia");
  stiffness = family("stiffness");
  damping = family("damping");
  torque = family("torque");
  load_mass = GiNaC::realsymbol("load_mass");
  gravity = GiNaC::realsymbol("gravity");
}

std::vector<Proof> compare_with_closed_form(const ChainSymbols& s, const ChainInSymbols& model) {
  const reference::Chain<ex> chain{s.length,  s.mass,      s.inertia, s.stiffness,
                                   s.damping, s.load_mass, s.gravity};
  const size_t n = s.theta.size();
  const auto index = [](size_t i) { return "(" + std::to_string(i + 1) + ")"; };

  EntryComparison mass("M");
  const auto M = reference::mass_matrix(chain, s.theta);
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = 0; j < n; ++j) {
      mass.entry("(" + std::to_string(i + 1) + ", " + std::to_string(j + 1) + ")",
                 difference(model.mass_matrix[i * n + j], M[i][j]));
    }
  }
  const auto compare = [&](const char* what, const std::vector<ex>& a, const std::vector<ex>& b) {
    EntryComparison comparison(what);
    for (size_t i = 0; i < n; ++i) comparison.entry(index(i), difference(a[i], b[i]));
    return comparison.proof();
  };
  const auto product = [&](const std::vector<ex>& joint, const std::vector<ex>& x) {
    const auto matrix = reference::joint_matrix(joint);
    std::vector<ex> y(n);
    for (size_t i = 0; i < n; ++i) {
      for (size_t j = 0; j < n; ++j) y[i] += matrix[i][j] * x[j];
    }
    return y;
  };
  std::vector<ex> torque;
  for (const ex& t : s.torque) torque.push_back(-t);
  return {mass.proof(),
          compare("F", model.coriolis, reference::coriolis(chain, s.theta, s.rate)),
          compare("G", model.gravity, reference::gravity(chain, s.theta)),
          compare("K theta", model.elastic, product(s.stiffness, s.theta)),
          compare("C thetadot", model.friction, product(s.damping, s.rate)),
          compare("-T", model.torque, torque)};
}

std::vector<Proof> prove_closed_form(int links) {
  const Description description = plain_chain();
  const ChainSymbols symbols(links);
  ChainInSymbols model;
  const auto residual_of = [&](const std::string& term, std::vector<ex>& out, bool moving) {
    Chain chain(description, links, term);
    Substitution bias(chain.definitions(), "_bias");
    if (moving) {
      for (const ex& a : chain.accelerations()) bias.set(a, 0);
    }
    WrittenOut written_out(chain.definitions());
    GiNaC::exmap common;
    const auto identify = [&](const char* name, const std::vector<ex>& ours) {
      const std::vector<ex> theirs = family(chain, name);
      for (size_t i = 0; i < theirs.size(); ++i) common[theirs[i]] = ours[i];
    };
    identify("theta", symbols.theta);
    identify("theta_dot", symbols.rate);
    identify("theta_ddot", symbols.acceleration);
    identify("length", symbols.length);
    identify("mass", symbols.mass);
    identify("inertia", symbols.inertia);
    identify("stiffness", symbols.stiffness);
    identify("damping", symbols.damping);
    identify("torque", symbols.torque);
    common[chain.definitions().input("load_mass")] = symbols.load_mass;
    common[chain.definitions().input("gravity")] = symbols.gravity;
    const auto translated = [&](const ex& e) {
      return written_out.of(e).subs(common, GiNaC::subs_options::no_pattern);
    };
    if (moving) {
      // M from the rows and columns that the emitted solver factors
      const Quasiseparable mass = find_structure(chain, {1, 0, 0}, "mass_");
      const size_t n = static_cast<size_t>(links);
      model.mass_matrix.assign(n * n, 0);
      for (size_t i = 1; i <= n && mass.found; ++i) {
        for (size_t j = 1; j <= n; ++j) {
          const bool upper = j > i;
          const auto& row = upper ? mass.upper_row[i][0] : mass.lower_row[i][0];
          const auto& column = upper ? mass.upper_column[j][0] : mass.lower_column[j][0];
          ex entry = i == j ? mass.diagonal[i][0][0] : ex(0);
          for (size_t r = 0; i != j && r < row.size(); ++r) entry += row[r] * column[r];
          if (j == i + 1) entry += mass.above[i][0][0];
          if (i == j + 1) entry += mass.below[i][0][0];
          model.mass_matrix[(i - 1) * n + j - 1] = translated(entry);
        }
      }
    }
    for (const ex& r : chain.residual()) out.push_back(translated(moving ? bias.of(r) : r));
  };
  residual_of("kinetic", model.coriolis, true);
  residual_of("gravity", model.gravity, false);
  residual_of("elastic", model.elastic, false);
  residual_of("friction", model.friction, false);
  residual_of("torque", model.torque, false);
  return compare_with_closed_form(symbols, model);
}

}  // namespace catena
