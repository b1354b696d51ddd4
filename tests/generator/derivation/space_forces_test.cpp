// SPDX-License-Identifier: GPL-3.0-or-later
//
// Effects in space, derived from their files, against forces written down as vectors.
#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "generator/certificate/exact_evaluation.hpp"
#include "generator/derivation/chain.hpp"
#include "tests/generator/derivation/space_point.hpp"
#include "tests/support/temporary_folder.hpp"

namespace catena::testing::space_point {

namespace {

Vector cross(const Vector& a, const Vector& b) {
  Vector product;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
    product[k] = ex(a[l] * b[m] - a[m] * b[l]).evalf();
  }
  return product;
}

// Links askew, of length one and turning without changing it; entry 0 is the clamp.
void set_links(Inputs& inputs, std::vector<Vector>& e, std::vector<Vector>& rate) {
  e.assign(kLinks + 1, Vector{0, 1, 0});
  rate.assign(kLinks + 1, Vector{0, 0, 0});
  for (int i = 1; i <= kLinks; ++i) {
    const auto at = static_cast<std::size_t>(i);
    for (std::size_t a = 0; a < 3; ++a) {
      e[at][a] = draw(name(kAxes[a], i), inputs.seed);
      rate[at][a] = draw(name(std::string(kAxes[a]) + "_dot", i), inputs.seed);
    }
    const ex scale = 1 / GiNaC::sqrt(dot(e[at], e[at]));
    for (ex& component : e[at]) component = ex(scale * component).evalf();
    const ex along = dot(rate[at], e[at]);
    for (std::size_t a = 0; a < 3; ++a) rate[at][a] -= along * e[at][a];
    set_vector(inputs, i, "", e[at]);
    set_vector(inputs, i, "_dot", rate[at]);
    set_vector(inputs, i, "_ddot", {0, 0, 0});
  }
}

Vector scaled(const ex& factor, const Vector& a) {
  return {ex(factor * a[0]).evalf(), ex(factor * a[1]).evalf(), ex(factor * a[2]).evalf()};
}

Vector plus(const Vector& a, const Vector& b) {
  return {ex(a[0] + b[0]).evalf(), ex(a[1] + b[1]).evalf(), ex(a[2] + b[2]).evalf()};
}

// Forces F_k on the middles of links, `force` from entry 1, and on the load do on link i, whose unit vector is
// e_i, the virtual work l_i (F_i / 2 + F_{i+1} + ... + F_n + F_load) . delta e_i.
void check_forces(Chain& chain, ExactEvaluation& evaluation, const Inputs& inputs,
                  const std::vector<Vector>& e, const std::vector<Vector>& force, Vector load) {
  for (int i = kLinks; i >= 1; --i) {
    CAPTURE(i);
    const auto k = static_cast<std::size_t>(i);
    const Vector on_link =
        scaled(inputs(name("length", i)), plus(load, scaled(numeric(1, 2), force[k])));
    const Vector normal = plus(on_link, scaled(-dot(on_link, e[k]), e[k]));
    for (std::size_t a = 0; a < 3; ++a)
      CHECK(difference(-normal[a], component(chain, evaluation, i, a)) < kTolerance);
    load = plus(load, force[k]);
  }
}

}  // namespace

TEST_CASE("drag in space is the vector that Morison's law says") {
  GiNaC::Digits = kDigits;
  const numeric floor(1, 1000000);
  const auto root = [&](const ex& square) { return GiNaC::sqrt(square + floor * floor).evalf(); };
  Inputs inputs{5};
  std::vector<Vector> e, rate;
  set_links(inputs, e, rate);
  const auto p = [&](const std::string& parameter) { return inputs("current_" + parameter); };
  const auto length = [&](int i) { return inputs(name("length", i)); };
  const auto relative = [&](const Vector& velocity, const ex& depth) {
    const ex height = 1 - depth / p("bed");
    const ex profile =
        GiNaC::exp(p("exponent") / 2 * GiNaC::log(height * height + numeric(1, 1000000)));
    return plus(velocity, scaled(-profile, {p("side_speed"), 0, p("across_speed")}));
  };
  Vector velocity{0, 0, 0};
  ex depth = 0;
  std::vector<Vector> force(kLinks + 1);
  for (int i = 1; i <= kLinks; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Vector u =
        relative(plus(velocity, scaled(length(i) / 2, rate[k])), depth + length(i) / 2 * e[k][1]);
    const Vector along = scaled(dot(u, e[k]), e[k]), normal = plus(u, scaled(-1, along));
    force[k] = plus(scaled(-length(i) * p("normal") * root(dot(normal, normal)), normal),
                    scaled(-length(i) * p("tangential") * root(dot(along, along)), along));
    velocity = plus(velocity, scaled(length(i), rate[k]));
    depth += length(i) * e[k][1];
  }
  const Vector u = relative(velocity, depth);
  Chain chain(with({"current"}, Space::kThreeDimensional), kLinks, "current");
  ExactEvaluation evaluation(chain.definitions(), inputs);
  check_forces(chain, evaluation, inputs, e, force, scaled(-p("load") * root(dot(u, u)), u));
}

// Each axis is turned from side and across about down x e by the angle from down to the link (Rodrigues).
TEST_CASE("drag of a box acts on each axis of its section by itself") {
  GiNaC::Digits = kDigits;
  const numeric floor(1, 1000000);
  Inputs inputs{8};
  std::vector<Vector> e, rate;
  set_links(inputs, e, rate);
  Vector velocity{0, 0, 0};
  std::vector<Vector> force(kLinks + 1, Vector{0, 0, 0});
  for (int i = 1; i <= kLinks; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const ex length = inputs(name("length", i));
    const Vector u = plus(velocity, scaled(length / 2, rate[k]));
    const Vector about = cross(Vector{0, 1, 0}, e[k]);  // of the size of the sine
    const auto turned = [&](const Vector& a) {
      return plus(plus(scaled(e[k][1], a), cross(about, a)),
                  scaled(dot(about, a) / (1 + e[k][1]), about));
    };
    for (const auto& [axis, coefficient] : {std::pair{turned({1, 0, 0}), "normal"},
                                            {turned({0, 0, 1}), "normal"},
                                            {e[k], "tangential"}}) {
      const ex speed = dot(u, axis);
      const ex drag = inputs(std::string("air_drag_box_") + coefficient) * speed *
                      GiNaC::sqrt(speed * speed + floor * floor);
      force[k] = plus(force[k], scaled(-length * drag, axis));
    }
    velocity = plus(velocity, scaled(length, rate[k]));
  }
  Chain chain(with({"air_drag_box"}, Space::kThreeDimensional), kLinks, "air_drag_box");
  ExactEvaluation evaluation(chain.definitions(), inputs);
  check_forces(chain, evaluation, inputs, e, force, {0, 0, 0});
}

// With the bend b_i, a vector of the size of the angle along e_{i-1} x e_i, V = sum k_i |b_i - r_i|^2 / 2. The axis of
// r_i is the one at the clamp, turned with each link by the shortest turn (Rodrigues' formula). The derivative of V along
// e_i, by differences in 50 digits.
TEST_CASE(
    "rest angles bend about an axis that is carried along the cable, and turning it does work") {
  GiNaC::Digits = kDigits;
  const TemporaryFolder folder;
  const auto path =
      folder.write("set.toml",
                   "format = 1\nkind = \"effect\"\nid = \"set\"\ntitle = \"Set\"\n"
                   "description = \"Bent, about an axis that turns\"\n"
                   "[parameters.bend]\nunit = \"rad\"\nneutral = 0.0\n"
                   "description = \"bend\"\n"
                   "[constants.turning]\nvalue = 0.7\nunit = \"rad/s\"\n"
                   "[support]\nbend_axis_side = \"cos(turning*time)\"\n"
                   "bend_axis_down = \"0.5\"\nbend_axis_across = \"sin(turning*time)\"\n"
                   "[kinematics]\nrest_angle = \"bend\"\n");
  Description description = with({}, Space::kThreeDimensional);
  description.effects.push_back(read_effect(path));
  Chain chain(description, kLinks);
  Inputs inputs{6};
  std::vector<Vector> e, rate;
  set_links(inputs, e, rate);
  ExactEvaluation evaluation(chain.definitions(), inputs);
  const ex turn = inputs("time") * numeric(7, 10);
  // At a right angle to the clamp, which points down.
  const Vector at_clamp{GiNaC::cos(turn).evalf(), 0, GiNaC::sin(turn).evalf()};
  const auto carried = [&](const std::vector<Vector>& links, std::size_t link) {
    Vector axis = at_clamp;
    for (std::size_t k = 1; k <= link; ++k) {
      Vector about = cross(links[k - 1], links[k]);
      const ex sine = GiNaC::sqrt(dot(about, about)), cosine = dot(links[k - 1], links[k]);
      for (ex& each : about) each = ex(each / sine).evalf();
      const Vector turned = cross(about, axis);
      const ex along = dot(about, axis);
      for (std::size_t a = 0; a < 3; ++a)
        axis[a] = ex(cosine * axis[a] + sine * turned[a] + (1 - cosine) * along * about[a]).evalf();
    }
    return axis;
  };
  const auto moment = [&](const std::vector<Vector>& links, int i) {
    const auto at = static_cast<std::size_t>(i);
    const Vector axis = scaled(inputs("set_bend"), carried(links, at - 1));
    Vector bend = cross(links[at - 1], links[at]);
    const ex cosine = dot(links[at - 1], links[at]);
    const ex ratio = ex(GiNaC::acos(cosine) / GiNaC::sqrt(1 - cosine * cosine)).evalf();
    for (std::size_t a = 0; a < 3; ++a)
      bend[a] = ex(inputs(name("stiffness", i)) * (ratio * bend[a] - axis[a])).evalf();
    return bend;
  };
  const auto energy = [&](const std::vector<Vector>& links) {
    ex sum = 0;
    for (int i = 1; i <= kLinks; ++i)
      sum += dot(moment(links, i), moment(links, i)) / (2 * inputs(name("stiffness", i)));
    return sum;
  };
  Chain elastic(description, kLinks, "elastic");
  ExactEvaluation of_elastic(elastic.definitions(), inputs);
  const ex step = GiNaC::pow(numeric(10), -16);
  for (int i = 1; i <= kLinks; ++i) {
    CAPTURE(i);
    const auto at = static_cast<std::size_t>(i);
    const Vector across = cross(e[at], Vector{1, 2, 3});
    std::vector<Vector> more = e, less = e;
    ex found = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      more[at][a] += step * across[a];
      less[at][a] -= step * across[a];
      found += across[a] * component(elastic, of_elastic, i, a);
    }
    for (auto* links : {&more, &less}) {
      const ex length = GiNaC::sqrt(dot((*links)[at], (*links)[at]));
      for (ex& each : (*links)[at]) each = ex(each / length).evalf();
    }
    CHECK(difference((energy(more) - energy(less)) / (2 * step), found) < 1e-25);
    const Vector expected = moment(e, i);
    CHECK(difference(GiNaC::sqrt(dot(expected, expected)),
                     of_elastic.of(elastic.moments()[at - 1])) < 1e-25);
  }
  CHECK(imbalance(chain, evaluation) < kTolerance);
  // The axis turns: without its work the energies would not balance.
  ex work = 0;
  for (const EnergyItem& item : chain.energies())
    if (item.name == "support")
      for (const ex& part : item.parts) work += evaluation.of(part);
  CHECK(size(work) > 1e-3);
}

// The moment -m s_i / reach acts on the difference of the angular velocities e x edot of its links.
TEST_CASE("hysteresis in space is a vector that gives way along the rate of the joint") {
  GiNaC::Digits = kDigits;
  Inputs inputs{7};
  std::vector<Vector> e, rate, slip(kLinks + 2, Vector{0, 0, 0});
  set_links(inputs, e, rate);
  for (int i = 1; i <= kLinks; ++i) {
    for (std::size_t a = 0; a < 3; ++a)
      slip[static_cast<std::size_t>(i)][a] = draw(name(kAxes[a] + std::string("_slip"), i), 7);
    set_slip(inputs, i, slip[static_cast<std::size_t>(i)]);
  }
  Chain chain(with({"joint_hysteresis"}, Space::kThreeDimensional), kLinks, "joint_hysteresis");
  ExactEvaluation evaluation(chain.definitions(), inputs);
  const ex reach = inputs("joint_hysteresis_reach"), moment = inputs("joint_hysteresis_moment");
  const numeric floor(1, 1000000);
  for (int i = 1; i <= kLinks; ++i) {
    CAPTURE(i);
    const auto at = static_cast<std::size_t>(i);
    const Vector below = cross(e[at], rate[at]), above = cross(e[at - 1], rate[at - 1]);
    Vector turning, torque;
    for (std::size_t a = 0; a < 3; ++a) {
      turning[a] = below[a] - above[a];
      torque[a] = moment / reach * (slip[at + 1][a] - slip[at][a]);
    }
    const ex speed = GiNaC::sqrt(dot(turning, turning) + floor * floor).evalf();
    const Vector force = cross(torque, e[at]);
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t row = a * kLinks + at - 1;
      CHECK(difference(turning[a] - slip[at][a] * speed / reach,
                       evaluation.of(chain.state_rates()[row])) < kTolerance);
      CHECK(difference(-force[a], component(chain, evaluation, i, a)) < kTolerance);
    }
  }
}

TEST_CASE("a force along a velocity is that force, in the plane and in space") {
  GiNaC::Digits = kDigits;
  const TemporaryFolder folder;
  const std::string head =
      "format = 1\nkind = \"effect\"\nid = \"own\"\ntitle = \"Own\"\ndescription = \"One\"\n"
      "[parameters.c]\nunit = \"N s/m\"\nneutral = 0.0\ndescription = \"c\"\n[[force]]\n";
  using Laws = std::vector<std::string>;
  const Laws towards_side = {"side = \"-c*velocity_down\"\n",
                             "along = \"velocity_side\"\nvalue = \"-c*velocity_down\"\n"};
  const Laws along_link = {
      "tangential = \"-c*velocity_tangential\"\n",
      "along = \"direction_side*velocity_side + direction_down*velocity_down + "
      "direction_across*velocity_across\"\nvalue = \"-c*velocity_tangential\"\n",
      "side = \"-c*velocity_tangential*direction_side\"\n"
      "down = \"-c*velocity_tangential*direction_down\"\n"
      "across = \"-c*velocity_tangential*direction_across\"\n"};
  for (const auto& row : std::vector<std::pair<std::string, Laws>>{{"load", towards_side},
                                                                   {"joint", towards_side},
                                                                   {"link_centre", towards_side},
                                                                   {"load", along_link},
                                                                   {"link_centre", along_link}}) {
    // clang 14 captures no structured binding.
    const std::string& place = row.first;
    const Laws& laws = row.second;
    for (const Space space : {Space::kPlane, Space::kThreeDimensional}) {
      CAPTURE(place);
      std::vector<std::vector<ex>> residuals;
      std::vector<ex> powers;
      for (const std::string& law : laws) {
        Description description = with({}, space);
        std::string text = head;
        text.append("at = \"").append(place).append("\"\n").append(law);
        description.effects.push_back(read_effect(folder.write("own.toml", text)));
        Chain chain(description, kLinks, "own");
        ExactEvaluation evaluation(chain.definitions(),
                                   [&](const std::string& name) { return draw(name, 1); });
        std::vector<ex> residual;
        for (const ex& r : chain.residual()) residual.push_back(evaluation.of(r));
        residuals.push_back(residual);
        ex power = 0;
        for (const EnergyItem& item : chain.energies())
          if (item.name == "own")
            for (const ex& part : item.parts) power += evaluation.of(part);
        powers.push_back(power);
      }
      CHECK(size(residuals[0][0]) > 1e-3);
      for (std::size_t k = 1; k < laws.size(); ++k) {
        CAPTURE(laws[k]);
        CHECK(difference(powers[0], powers[k]) < kTolerance);
        for (std::size_t i = 0; i < residuals[0].size(); ++i)
          CHECK(difference(residuals[0][i], residuals[k][i]) < kTolerance);
      }
    }
  }
}

}  // namespace catena::testing::space_point
