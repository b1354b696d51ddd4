// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/law_effect.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "common/number_text.hpp"
#include "common/toml_quoted.hpp"
#include "description/expression_syntax.hpp"
#include "identify/forces/place_kinematics.hpp"

namespace catena {

namespace {

/// m, of the step by which a link takes over the place from its neighbour. Both put it at the same
/// point but for so much.
constexpr double kStepWidth = 1e-5;

/// Where the energy of a law stands.
struct EffectPlace {
  const char* at;
  const char* gate;  ///< the length of the piece that a step up and one down let through; or none
  bool per_length = false;
  const char* factor = "";  ///< of the energy
};

EffectPlace place_of(const LawSite& site, double length) {
  switch (site.kind) {
    case SiteKind::kPlace:
      if (at_end(site.arc_length, length)) return {"load", nullptr};
      return {"link_centre", "length"};
    case SiteKind::kPair:
      return {"chord", nullptr};
    case SiteKind::kJoint:
      if (site.joint == 0) return {"pivot", nullptr};
      return {"joint", "spacing"};
    case SiteKind::kCable:
      return {"link_centre", nullptr, true};
    case SiteKind::kJoints:
      return {"joint", nullptr, false, "spacing*"};
  }
  return {};
}

}  // namespace

std::string effect_of(const ForceLaw& law, const std::string& id, double length) {
  const CandidateLaw::Formula& formula = law.formula;
  const EffectPlace where = place_of(law.site, length);
  const bool load = std::string(where.at) == "load";
  const bool point = law.site.kind == SiteKind::kPlace && !load;
  const std::string title = fmt::format("{} against {}{}", law.force, law.variable,
                                        load ? " at the load" : site_in_words(law.site));
  const std::string how =
      law.found
          ? fmt::format(
                "Chosen of {} pairs of a force and a variable in {}, it explained {:.0f} % of "
                "what a force can explain in the second; of random forces {:.2g} did as well.",
                law.candidates, law.chosen_in(), 100 * law.share_confirmed(), law.chance)
          : "Fitted in the place of the law that was chosen.";
  const std::string words =
      fmt::format("Found in recordings, declared by nobody: {}; {}. {}", title, formula.text, how);
  using Kind = CandidateLaw::Formula::Kind;
  std::string more;
  if (formula.curve)
    more += " No formula fits: the law is a curve of straight pieces between knots.";
  if (formula.kind == Kind::kRelaxing)
    more +=
        " What relaxes is a spring before a dashpot (Maxwell): its length z follows z' = rate - "
        "z/lag.";
  if (formula.kind == Kind::kTorque)
    more += " The tension is that of weight and of turning at constant rates.";
  std::string text =
      fmt::format("format = 1\nkind = \"effect\"\nid = \"{}\"\ntitle = {}\ndescription = {}\n", id,
                  toml_quoted("Discovered: " + title), toml_quoted(words + more));

  const auto parameter = [&](const CandidateLaw::Constant& of) {
    text += fmt::format("\n[parameters.{}]\nunit = \"{}\"\nlower = {}\nupper = {}\n{} = {}\n",
                        of.name, of.unit, shortest_number(of.lower), shortest_number(of.upper),
                        of.amplitude ? "neutral" : "default",
                        shortest_number(of.amplitude ? 0 : of.value));
    const std::string error =
        std::isfinite(of.deviation) ? fmt::format("+- {:.2g}", of.deviation) : "(not determined)";
    text += fmt::format("description = \"Found: {:.6g} {}\"\n", of.value, error);
  };
  for (const CandidateLaw::Constant& constant : formula.constants) parameter(constant);
  const LawSite& site = law.site;
  const bool pair = site.kind == SiteKind::kPair;
  const bool to_end = pair && at_end(site.other_arc_length, length);
  if (point || pair)
    parameter({kLawPlace, "m", site.arc_length, law.place_deviation, false, 0, length});
  if (pair && !to_end)
    parameter(
        {kLawOtherPlace, "m", site.other_arc_length, law.other_place_deviation, false, 0, length});

  std::vector<CandidateLaw::Constant> fixed = formula.fixed;
  if (where.gate) fixed.push_back({"width", "m", kStepWidth});
  if (where.gate && !point) fixed.push_back({kLawPlace, "m", site.arc_length});
  if (to_end) fixed.push_back({kLawOtherPlace, "m", length});
  std::string expressions = formula.energy;
  for (const auto& [name, value] : formula.definitions) expressions += value;
  for (const std::string& along : formula.along) expressions += along;
  if (load && expressions.find("offset") != std::string::npos) fixed.push_back({"offset", "m", 0});
  for (const CandidateLaw::Constant& constant : fixed)
    text += fmt::format("\n[constants.{}]\nvalue = {}\nunit = \"{}\"\n", constant.name,
                        shortest_number(constant.value), constant.unit);
  if (pair)
    text += fmt::format("\n[chord]\nfrom = \"{}\"\nto = \"{}\"\n", kLawPlace, kLawOtherPlace);
  const auto define = [&](const char* name, const std::string& value) {
    text += fmt::format("\n[[definition]]\nname = \"{}\"\nat = \"{}\"\nvalue = \"{}\"\n", name,
                        where.at, value);
  };
  if (where.gate) {
    define("offset", "place - arc");
    define("here", fmt::format("(tanh((offset + {0}/2)/width) - tanh((offset - {0}/2)/width))/2",
                               where.gate));
  }
  const char* const gate = where.gate ? "here*" : "";
  const auto declare = [&](const char* table, const std::string& value) {
    text += fmt::format("\n[[{}]]\nat = \"{}\"\n{}value = \"{}{}\"\n", table, where.at,
                        where.per_length ? "per = \"length\"\n" : "", gate, value);
  };
  std::string force = fmt::format("({})", formula.energy);
  if (formula.kind == Kind::kRelaxing) {
    const std::string stretch = id + "_stretch";
    text += fmt::format(
        "\n[[state]]\nname = \"{0}\"\nunit = \"{1}\"\nper = \"{2}\"\n"
        "rate = \"{3} - {0}/lag\"\n",
        stretch, formula.variable_unit, where.at, formula.along.front());
    force = fmt::format("(-{}spring*{})", where.factor, stretch);
    if (!formula.definitions.empty()) define("motion", stretch);
  }
  if (!formula.definitions.empty()) {
    for (const auto& [name, value] : formula.definitions) define(name.c_str(), value);
    define("resistance", fmt::format("{}({})", where.factor, formula.energy));
    force = "(-resistance)";
  }
  for (const std::string& along : formula.along)
    text += fmt::format("\n[[force]]\nat = \"{}\"\n{}along = \"{}\"\nvalue = \"{}{}{}\"\n",
                        where.at, where.per_length ? "per = \"length\"\n" : "", along, gate, force,
                        formula.along.size() > 1 ? fmt::format("*({})/motion", along) : "");
  if (!formula.along.empty()) return text;
  if (formula.kind == Kind::kTorque) {
    declare("torque", fmt::format("(-({}))", formula.energy));
    return text;
  }
  if (formula.kind == Kind::kMass)
    declare("kinetic", fmt::format("point_mass*(({})^2 + ({})^2)/2",
                                   symbols_of(LawVariable::kSideVelocity, false),
                                   symbols_of(LawVariable::kDownVelocity, false)));
  declare(formula.kind == Kind::kDissipation ? "dissipation" : "potential",
          fmt::format("{}({})", where.factor, formula.energy));
  return text;
}

}  // namespace catena
