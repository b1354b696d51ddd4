// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/certificate/certificate.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <utility>

#include "common/sha256.hpp"
#include "generator/certificate/accuracy.hpp"
#include "generator/certificate/compiled_model.hpp"
#include "generator/certificate/exact_evaluation.hpp"
#include "generator/certificate/operations.hpp"
#include "generator/certificate/rest_frequencies.hpp"
#include "generator/certificate/twin.hpp"
#include "generator/derivation/chain.hpp"
#include "generator/derivation/closed_form_proof.hpp"
#include "generator/derivation/neutral_proof.hpp"
#include "generator/derivation/space_proof.hpp"

namespace catena {
namespace {

using GiNaC::ex;
using Json = nlohmann::ordered_json;

constexpr int kPoints = 3;
constexpr unsigned kSeed = 1;
// Measured errors are up to 3 roundings, and little more with more links. Other compilers and
// mathematical libraries may round differently. A wrong digit anywhere gives thousands of
// roundings.
constexpr double kTolerance = 30;
// The eigenvalue solver loses accuracy with the condition of M, about n^4 for the highest
// frequencies.
constexpr double kFrequencyTolerance = 1e-9;
constexpr const char* kFrequencyKinds[] = {"natural_frequencies",
                                           "natural_frequencies_with_effects"};

// L = T - V as in the derivation: each part and every definition that it needs, in order.
std::string lagrangian_text(Chain& chain) {
  const Definitions& definitions = chain.definitions();
  std::vector<int> needed;
  std::vector<bool> seen(static_cast<std::size_t>(definitions.size()));
  std::string text;
  const std::function<void(const ex&)> need = [&](const ex& expression) {
    for (const int number : definitions.symbols_of(expression)) {
      if (seen[static_cast<std::size_t>(number)]) continue;
      seen[static_cast<std::size_t>(number)] = true;
      const Symbol symbol = definitions[number];
      if (symbol.is_input) continue;
      need(symbol.value);
      text += full_name(symbol) + " = " + definitions.canonical_key(symbol.value) + "\n";
    }
  };
  for (const EnergyItem& item : chain.energies()) {
    if (item.kind != EnergyItem::kStored) continue;
    for (const ex& part : item.parts) {
      need(part);
      text += item.name + ": " + definitions.canonical_key(part.expand()) + "\n";
    }
  }
  return text;
}

// What cannot be proved is added to `not_provable`.
Json proofs(const Description& description, int links, const Json& summary, Json& not_provable) {
  Json list = Json::array();
  const auto add = [&](const std::string& what, bool proved) {
    list.push_back({{"what", what}, {"proved", proved}});
  };
  const auto add_all = [&](const std::vector<Proof>& proofs, const std::string& with) {
    for (const Proof& proof : proofs)
      add(proof.what + with + ", " + std::to_string(proof.entries) + " entries", proof.equal);
  };
  if (description.space == Space::kThreeDimensional) {
    add_all(prove_space_closed_form(links), " = closed form in space");
    add_all(prove_plane_in_space(links), " in any vertical plane = closed form");
    const std::vector<const Effect*> holding = description.holding();
    for (std::size_t k = 0; k < holding.size(); ++k) {
      const int link = holding[k]->held_end.link;
      add_all({prove_constraint(description, links, k)},
              (link == 0 ? " of the held end" : " of the held link " + std::to_string(link)) +
                  " = closed form");
    }
  } else {
    const std::string whose = description.effects.empty() ? "" : " of the plain chain";
    add_all(prove_closed_form(links), whose + " = closed form");
  }
  const NeutralProofs neutral = prove_neutral(description, links);
  for (const Proof& proof : neutral.proofs) {
    add(proof.what + " at neutral values = the plain chain's, " + std::to_string(proof.entries) +
            " entries",
        proof.equal);
  }
  if (!neutral.why_not.empty()) {
    not_provable.push_back("the plain chain at neutral values: " + neutral.why_not);
  }
  // The emitted code uses only structure that is proved; other structure is not listed.
  const Json& structure = summary.at("structure");
  if (structure.at("mass_matrix").at("symmetric")) add("M symmetric", true);
  if (structure.at("mass_matrix").at("semiseparable")) add("M semiseparable", true);
  if (structure.at("newton_matrix").at("tridiagonal_plus_semiseparable")) {
    add("Newton matrix tridiagonal plus semiseparable", true);
  }
  for (const auto& [key, name] : {std::pair("stiffness_matrix", "K"), {"damping_matrix", "C"}}) {
    if (structure.at(key).at("constant_symmetric_tridiagonal")) {
      add(std::string(name) + " constant, symmetric, tridiagonal", true);
    }
  }
  return list;
}

// Three digits are enough for a comparison.
double rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return std::stod(text);
}

// Counts are whole numbers as long as a double holds them.
Json count(double operations) {
  if (operations < 0x1p53) return static_cast<std::int64_t>(operations);
  return rounded(operations);
}

Json operations(const Description& description, int links, const Json& summary) {
  Chain chain(description, links);
  Json result;
  result["residual_before_sharing"] =
      count(operations_written_out(chain.definitions(), chain.residual()));
  for (const auto& [function, counts] : summary.at("functions").items()) {
    std::int64_t sum = 0;
    for (const auto& [kind, operations] : counts.items()) sum += operations.get<std::int64_t>();
    result["after_sharing"][function] = sum;
  }
  return result;
}

Json hashes(const std::string& model, const EmittedFiles& files) {
  Json result;
  for (const auto& [name, text] : files) {
    const bool own = name.starts_with(model + ".");
    const bool support =
        name.ends_with(".h") || (name.ends_with(".hpp") && !name.starts_with("chain"));
    if (own || support) result[name] = sha256_hex(text);
  }
  return result;
}

// Errors of the 50-digit values themselves (near 1e-62) depend on the order of a sum, which differs
// from run to run.
constexpr double kExact = 1e-9;

Json worst(const std::vector<FunctionAccuracy>& accuracies) {
  Json result;
  for (const FunctionAccuracy& accuracy : accuracies) {
    // JSON has no NaN; such an error counts as infinite.
    result[accuracy.function] = !std::isfinite(accuracy.worst) ? 1e300
                                : accuracy.worst < kExact      ? 0.0
                                                               : rounded(accuracy.worst);
  }
  return result;
}

// With effects that are not at their neutral values. Without effects natural_frequencies is enough.
Json frequencies_with_effects(const Description& description, int links,
                              const catena_model& table) {
  const RestFrequencies frequencies = rest_frequencies(description, links, table, kSeed);
  if (!frequencies.why_not.empty()) return {{"not_compared", frequencies.why_not}};
  return {{"lowest_rad_per_s", frequencies.lowest},
          {"highest_rad_per_s", frequencies.highest},
          {"largest_relative_difference", rounded(frequencies.largest_difference)},
          {"tolerance", kFrequencyTolerance}};
}

Json numerical(const Description& description, int links, const catena_model& table) {
  Json result;
  result["points"] = kPoints;
  result["seed"] = kSeed;
  result["tolerance_roundings"] = kTolerance;
  result["worst_roundings_against_50_digits"] =
      worst(measure_accuracy(description, links, table, kPoints, kSeed));
  if (description.effects.empty()) {
    result["worst_roundings_against_closed_form"] = worst(compare_with_twin(table, kPoints, kSeed));
  }
  if (!description.effects.empty()) {
    result["natural_frequencies_with_effects"] =
        frequencies_with_effects(description, links, table);
  }
  const Frequencies frequencies = natural_frequencies(table);
  Json& at_rest = result["natural_frequencies"];
  if (!frequencies.applicable) {
    at_rest["not_compared"] = frequencies.why_not;
    return result;
  }
  at_rest["lowest_rad_per_s"] = frequencies.emitted.front();
  at_rest["highest_rad_per_s"] = frequencies.emitted.back();
  at_rest["largest_relative_difference"] = rounded(frequencies.largest_difference);
  at_rest["tolerance"] = kFrequencyTolerance;
  return result;
}

}  // namespace

std::string certificate_name(const std::string& model, Language language) {
  return model + (language == Language::kC ? ".c99" : "") + ".certificate.json";
}

Json make_certificate(const Description& description, int links, const EmittedFiles& files,
                      Language language) {
  const std::string model = model_name(description, links);
  const Json summary = Json::parse(files.at(summary_name(model, language)));
  Json certificate;
  certificate["format"] = 1;
  certificate["kind"] = "certificate";
  certificate["model"] = model;
  certificate["language"] = language == Language::kC ? "C99" : "C++20";
  Json& exact = certificate["exact"];
  exact["links"] = links;
  exact["description"] = sha256_hex(canonical_text(description));
  Chain chain(description, links);
  exact["lagrangian"] = sha256_hex(lagrangian_text(chain));
  exact["files"] = hashes(model, files);
  exact["operations"] = operations(description, links, summary);
  Json not_provable = Json::array();
  exact["proofs"] = proofs(description, links, summary, not_provable);
  if (!not_provable.empty()) exact["not_provable"] = not_provable;
  const CompiledModel compiled(files, model, language);
  certificate["numerical"] = numerical(description, links, compiled.table());
  return certificate;
}

std::vector<std::string> failures(const Json& certificate) {
  std::vector<std::string> result;
  for (const Json& proof : certificate.at("exact").at("proofs")) {
    if (!proof.at("proved").get<bool>()) {
      result.push_back("not proved: " + proof.at("what").get<std::string>());
    }
  }
  const Json& numerical = certificate.at("numerical");
  const double tolerance = numerical.at("tolerance_roundings");
  for (const char* list :
       {"worst_roundings_against_50_digits", "worst_roundings_against_closed_form"}) {
    if (!numerical.contains(list)) continue;
    for (const auto& [function, value] : numerical.at(list).items()) {
      if (value.get<double>() <= tolerance) continue;
      result.push_back(std::string(list) + ": " + function + " has " + value.dump() +
                       ", tolerated are " + numerical.at("tolerance_roundings").dump());
    }
  }
  for (const char* kind : kFrequencyKinds) {
    const Json frequencies = numerical.value(kind, Json::object());
    if (frequencies.contains("tolerance") &&
        !(frequencies.at("largest_relative_difference") <= frequencies.at("tolerance"))) {
      result.push_back(std::string(kind) + " differ by " +
                       frequencies.at("largest_relative_difference").dump() + ", tolerated are " +
                       frequencies.at("tolerance").dump());
    }
  }
  return result;
}

std::vector<std::string> differences(const Json& on_file, const Json& now) {
  std::vector<std::string> result;
  const auto compare = [&](const std::string& where, const Json& a, const Json& b) {
    if (a == b) return;
    const Json patch = Json::diff(a, b);
    for (const Json& change : patch) {
      const std::string path = change.at("path");
      const Json::json_pointer pointer(path);
      const auto shown = [&](const Json& json) {
        return json.contains(pointer) ? json.at(pointer).dump() : "nothing";
      };
      result.push_back(where + path + ": on file " + shown(a) + ", now " + shown(b));
    }
  };
  compare("language", on_file.value("language", Json()), now.at("language"));
  compare("", on_file.value("exact", Json()), now.at("exact"));
  const Json stated = on_file.value("numerical", Json::object());
  for (const char* key : {"points", "seed", "tolerance_roundings"}) {
    compare(std::string("numerical.") + key, stated.value(key, Json()),
            now.at("numerical").at(key));
  }
  for (const char* kind : kFrequencyKinds) {
    const Json frequencies = now.at("numerical").value(kind, Json::object());
    for (const char* key : {"lowest_rad_per_s", "highest_rad_per_s"}) {
      if (!frequencies.contains(key)) continue;
      const double before = stated.value(kind, Json::object()).value(key, 0.0);
      const double value = frequencies.at(key);
      if (std::abs(before / value - 1) <= frequencies.at("tolerance").get<double>()) continue;
      result.push_back(std::string("numerical.") + kind + "." + key + ": on file " +
                       Json(before).dump() + ", now " + Json(value).dump());
    }
  }
  return result;
}

}  // namespace catena
