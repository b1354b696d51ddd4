// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/derivation/space_proof.hpp"

#include <set>
#include <string>

#include "generator/derivation/chain.hpp"
#include "generator/derivation/entry_comparison.hpp"
#include "generator/derivation/written_out.hpp"
#include "reference/coriolis.hpp"
#include "reference/gravity.hpp"
#include "reference/joint_matrix.hpp"
#include "reference/mass_matrix.hpp"
#include "reference/space.hpp"

namespace catena {

using GiNaC::ex;

namespace {

using reference::space::Vector3;
using Vectors = std::vector<Vector3<ex>>;

constexpr const char* kAxes[] = {"side", "down", "across"};

Description chain_in_space() {
  Description description = plain_chain();
  description.space = Space::kThreeDimensional;
  return description;
}

// What is symbols here: the unit vectors of the links, their rates and accelerations.
std::set<std::string> kept_families(const std::set<std::string>& suffixes) {
  std::set<std::string> families;
  for (const char* axis : kAxes)
    for (const std::string& suffix : suffixes)
      families.insert("unit_" + std::string(axis) + suffix);
  return families;
}

// The derivation of one term, without definitions: the generalised forces of the unit vectors.
class Term {
 public:
  Term(int links, const std::string& name)
      : chain_(chain_in_space(), links, name),
        written_out_(chain_.definitions(), kept_families({"", "_velocity", "_acceleration"})) {}

  ex force(int link, int axis) {
    return written_out_.of(chain_.direction_forces()[static_cast<std::size_t>(axis)]
                                                    [static_cast<std::size_t>(link) + 1]);
  }

  std::vector<ex> family(const char* name) {
    std::vector<ex> symbols;
    for (int i = 1; i <= chain_.links(); ++i)
      symbols.push_back(chain_.definitions().input(name, i));
    return symbols;
  }

  Vectors vectors(const std::string& suffix) {
    Vectors result(static_cast<std::size_t>(chain_.links()));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string name = "unit_" + std::string(kAxes[axis]) + suffix;
      const auto symbols = family(name.c_str());
      for (std::size_t i = 0; i < symbols.size(); ++i) result[i][axis] = symbols[i];
    }
    return result;
  }

  reference::Chain<ex> chain() {
    return {family("length"),
            family("mass"),
            family("inertia"),
            family("stiffness"),
            family("damping"),
            chain_.definitions().input("load_mass"),
            chain_.definitions().input("gravity")};
  }

  int links() const { return chain_.links(); }

 private:
  Chain chain_;
  WrittenOut written_out_;
};

std::string place(int link) { return "(" + std::to_string(link + 1) + ")"; }

Proof compare(const char* what, Term& term, const Vectors& closed_form) {
  EntryComparison comparison(what);
  for (int i = 0; i < term.links(); ++i) {
    for (int axis = 0; axis < 3; ++axis)
      comparison.entry(
          place(i) + " " + kAxes[axis],
          term.force(i, axis) -
              closed_form[static_cast<std::size_t>(i)][static_cast<std::size_t>(axis)]);
  }
  return comparison.proof();
}

// sin(a - b), written out.
ex sine_of_difference(const ex& a, const ex& b) {
  return GiNaC::sin(a) * GiNaC::cos(b) - GiNaC::cos(a) * GiNaC::sin(b);
}

// The angle over the sine of each joint gets a symbol; only its product with the sine is used.
class RatiosOfJoints : public GiNaC::map_function {
 public:
  RatiosOfJoints(const Vectors& direction, const std::vector<ex>& ratio) {
    Vector3<ex> above{0, 1, 0};
    for (std::size_t i = 0; i < direction.size(); ++i) {
      ratio_[reference::space::dot(above, direction[i]).expand()] = ratio[i];
      above = direction[i];
    }
  }
  ex operator()(const ex& e) override {
    if (!GiNaC::is_the_function<angle_over_sine_SERIAL>(e)) return e.map(*this);
    return ratio_.at(e.op(0).expand());
  }

 private:
  GiNaC::exmap ratio_;
};

// From the generalised forces f of the unit vectors to the equations of q, s = 1 / |q|:
//     r = s f - s^3 (f . q) q + 16 (I + m l^2 / 4) (q . qddot + |qdot|^2) q
Proof projection(int links) {
  Chain chain(chain_in_space(), links);
  std::set<std::string> kept = kept_families({"_force"});
  kept.insert("direction_scale");
  WrittenOut written_out(chain.definitions(), kept);
  const auto component = [&](const char* suffix, int link) {
    return [&chain, suffix, link](std::size_t axis) {
      return chain.definitions().input("direction_" + std::string(kAxes[axis]) + suffix, link);
    };
  };
  EntryComparison comparison("projection");
  for (int i = 1; i <= links; ++i) {
    const auto q = component("", i), qdot = component("_dot", i), qddot = component("_ddot", i);
    const auto f = [&](std::size_t axis) {
      return written_out.of(chain.direction_forces()[axis][static_cast<std::size_t>(i)]);
    };
    const ex scale = chain.definitions().input("direction_scale", i);
    const auto own = [&](const char* name) { return chain.definitions().input(name, i); };
    ex along = 0, radial = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      along += f(axis) * q(axis);
      radial += q(axis) * qddot(axis) + qdot(axis) * qdot(axis);
    }
    radial *= 16 * own("inertia") + 4 * own("mass") * GiNaC::pow(own("length"), 2);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto row = axis * static_cast<std::size_t>(links) + static_cast<std::size_t>(i) - 1;
      comparison.entry(place(i - 1) + " " + kAxes[axis],
                       written_out.of(chain.residual()[row]) - scale * f(axis) +
                           (GiNaC::pow(scale, 3) * along - radial) * q(axis));
    }
  }
  return comparison.proof();
}

// 1/s: the rate at which a gap closes, as docs/model.md states it.
const ex kStatedClosingRate = 100;

}  // namespace

Proof prove_constraint(const Description& description, int links, std::size_t place_held) {
  const Effect& effect = *description.holding()[place_held];
  const int last = effect.held_end.link == 0 ? links : effect.held_end.link;
  Chain chain(description, links, effect.id);
  std::set<std::string> kept = kept_families({"", "_velocity", "_acceleration"});
  const std::string held = effect.held_end.named("end") + "_";
  for (const char* axis : kAxes) kept.insert(held + axis);
  WrittenOut written_out(chain.definitions(), kept);
  EntryComparison comparison("constraint");
  for (const Axis axis : chain.axes()) {
    const std::string name = kAxes[axis];
    const auto symbol = [&](const std::string& family, int i) {
      return chain.definitions().input(family, i);
    };
    const ex support = chain.position(axis)[0], end = chain.definitions().input(held + name);
    const std::size_t of_constraint =
        3 * (static_cast<std::size_t>(links) + place_held) + static_cast<std::size_t>(axis);
    ex gap = support - end, rate = chain.rate(gap), acceleration = chain.rate(rate);
    for (int i = 1; i <= links; ++i) {
      const ex length = i > last ? ex(0) : symbol("length", i);
      gap += length * symbol("unit_" + name, i);
      rate += length * symbol("unit_" + name + "_velocity", i);
      acceleration += length * symbol("unit_" + name + "_acceleration", i);
      comparison.entry(place(i - 1) + " " + name,
                       written_out.of(chain.direction_forces()[axis][static_cast<std::size_t>(i)]) -
                           length * chain.accelerations()[of_constraint]);
    }
    comparison.entry(name, written_out.of(chain.residual()[of_constraint] - acceleration -
                                          2 * kStatedClosingRate * rate -
                                          GiNaC::pow(kStatedClosingRate, 2) * gap));
  }
  return comparison.proof();
}

std::vector<Proof> prove_space_closed_form(int links) {
  namespace space = reference::space;
  Term kinetic(links, "kinetic"), gravity(links, "gravity"), elastic(links, "elastic"),
      friction(links, "friction");
  return {compare("inertia", kinetic,
                  space::inertia(kinetic.chain(), kinetic.vectors("_acceleration"))),
          compare("gravity", gravity, space::gravity(gravity.chain())),
          compare("elastic", elastic,
                  space::elastic(elastic.chain(), elastic.vectors(""),
                                 [](const ex& cosine) -> ex { return angle_over_sine(cosine); })),
          compare("friction", friction,
                  space::friction(friction.chain(), friction.vectors(""),
                                  friction.vectors("_velocity"))),
          projection(links)};
}

std::vector<Proof> prove_plane_in_space(int links) {
  const ChainSymbols s(links);
  const auto n = static_cast<std::size_t>(links);
  const GiNaC::realsymbol azimuth("azimuth");
  const ex sine = GiNaC::sin(azimuth), cosine = GiNaC::cos(azimuth);
  Vectors direction, tangent, rate(n), acceleration(n);
  for (std::size_t i = 0; i < n; ++i) {
    const ex& theta = s.theta[i];
    direction.push_back({GiNaC::sin(theta) * cosine, GiNaC::cos(theta), GiNaC::sin(theta) * sine});
    tangent.push_back({GiNaC::cos(theta) * cosine, -GiNaC::sin(theta), GiNaC::cos(theta) * sine});
    for (std::size_t axis = 0; axis < 3; ++axis) {
      rate[i][axis] = s.rate[i] * tangent[i][axis];
      acceleration[i][axis] =
          s.acceleration[i] * tangent[i][axis] - s.rate[i] * s.rate[i] * direction[i][axis];
    }
  }
  std::vector<ex> ratio, bent;  // angles as products: b = (b / sin b) sin b
  ex above = 0, sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    ratio.push_back(GiNaC::realsymbol("angle_over_sine_" + std::to_string(i + 1)));
    sum += ratio[i] * sine_of_difference(s.theta[i], above);
    bent.push_back(sum);
    above = s.theta[i];
  }
  const reference::Chain<ex> chain{s.length,  s.mass,      s.inertia, s.stiffness,
                                   s.damping, s.load_mass, s.gravity};
  const auto product = [&](const reference::Matrix<ex>& matrix, const std::vector<ex>& x) {
    std::vector<ex> y(n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) y[i] += matrix[i][j] * x[j];
    return y;
  };
  const auto plus = [&](std::vector<ex> a, const std::vector<ex>& b) {
    for (std::size_t i = 0; i < n; ++i) a[i] += b[i];
    return a;
  };

  std::vector<Proof> proofs;
  const auto add = [&](const char* what, const char* name, const std::vector<ex>& chapter_4) {
    Term term(links, name);
    GiNaC::exmap motion;
    const auto put = [&](const std::vector<ex>& from, const std::vector<ex>& to) {
      for (std::size_t i = 0; i < n; ++i) motion[from[i]] = to[i];
    };
    for (const auto& [suffix, vectors] : {std::pair<const char*, const Vectors*>{"", &direction},
                                          {"_velocity", &rate},
                                          {"_acceleration", &acceleration}}) {
      const Vectors from = term.vectors(suffix);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) motion[from[i][axis]] = (*vectors)[i][axis];
    }
    const reference::Chain<ex> own = term.chain();
    put(own.length, s.length);
    put(own.mass, s.mass);
    put(own.inertia, s.inertia);
    put(own.stiffness, s.stiffness);
    put(own.damping, s.damping);
    motion[own.load_mass] = s.load_mass;
    motion[own.gravity] = s.gravity;
    RatiosOfJoints ratios(direction, ratio);
    WriteOutDifferences write_out;
    EntryComparison comparison(what);
    for (int i = 0; i < links; ++i) {
      const auto k = static_cast<std::size_t>(i);
      Vector3<ex> r;
      for (int axis = 0; axis < 3; ++axis)
        r[static_cast<std::size_t>(axis)] =
            ratios(term.force(i, axis).subs(motion, GiNaC::subs_options::no_pattern));
      comparison.entry(place(i) + " in the plane",
                       reference::space::dot(r, tangent[k]) - write_out(chapter_4[k]));
      comparison.entry(place(i) + " across it", r[2] * cosine - r[0] * sine);
    }
    proofs.push_back(comparison.proof());
  };
  add("inertia", "kinetic",
      plus(product(reference::mass_matrix(chain, s.theta), s.acceleration),
           reference::coriolis(chain, s.theta, s.rate)));
  add("gravity", "gravity", reference::gravity(chain, s.theta));
  add("elastic", "elastic", product(reference::joint_matrix(s.stiffness), bent));
  add("friction", "friction", product(reference::joint_matrix(s.damping), s.rate));
  return proofs;
}

}  // namespace catena
