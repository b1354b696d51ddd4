// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/emitted_files.hpp"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/sha256.hpp"
#include "generator/emission/any_links_writer.hpp"
#include "generator/emission/c_writer.hpp"
#include "generator/emission/support_text.hpp"

namespace catena {

namespace {

// Measured on n = 2..60 (docs/scale.md): up to here both are of one size and speed, and straight
// lines are easier to read; beyond it loops are several times smaller for about a fifth of the
// residual's speed.
constexpr int kLongestStraight = 4;

std::string summary_text(const Description& description, const ModelSummary& s) {
  nlohmann::ordered_json json;
  json["format"] = 1;
  json["kind"] = "model_summary";
  json["model"] = s.name;
  json["description_hash"] = sha256_hex(canonical_text(description));
  json["links"] = s.links;
  json["coordinates"] = s.coordinates;
  json["states"] = s.states;
  json["signals"] = s.signals;
  json["parameters"] = s.parameters;
  json["layout"] = s.layout == Layout::kStraight ? "straight" : "loops";
  auto& structure = json["structure"];
  structure["mass_matrix"] = {
      {"semiseparable", s.mass_structured}, {"symmetric", s.mass_symmetric}, {"rank", s.mass_rank}};
  structure["newton_matrix"] = {{"tridiagonal_plus_semiseparable", s.structured},
                                {"rank_above", s.newton_upper_rank},
                                {"rank_below", s.newton_lower_rank}};
  if (s.block > 1) structure["rows_of_a_block"] = s.block;
  if (s.constraints > 0) structure["rows_of_constraints"] = s.constraints;
  if (s.border > s.constraints) structure["rows_of_the_load"] = s.border - s.constraints;
  structure["stiffness_matrix"] = {{"constant_symmetric_tridiagonal", s.stiffness_tridiagonal}};
  structure["damping_matrix"] = {{"constant_symmetric_tridiagonal", s.damping_tridiagonal}};
  structure["obstacle"] = s.why_not;
  auto& functions = json["functions"];
  functions = nlohmann::ordered_json::object();
  for (const FunctionSummary& function : s.functions) {
    const OperationCount& count = function.operations;
    functions[function.name] = {{"additions", count.additions.constant},
                                {"multiplications", count.multiplications.constant},
                                {"divisions", count.divisions.constant},
                                {"functions", count.functions.constant}};
  }
  return json.dump(2) + "\n";
}

std::string look_up_header() {
  return "// SPDX-License-Identifier: BSD-3-Clause\n"
         "// Written by catena-derive. Do not edit: change the model description and derive "
         "again.\n"
         "#pragma once\n\n#include \"catena_model.h\"\n\nnamespace catena {\n\n"
         "/// The models compiled into this library, by ascending number of links; *count of "
         "them.\n"
         "const catena_model* const* built_in_models(int* count);\n\n}  // namespace catena\n";
}

std::string look_up_source(const std::vector<std::string>& names) {
  std::ostringstream out;
  out << "// SPDX-License-Identifier: BSD-3-Clause\n"
         "// Written by catena-derive. Do not edit: change the model description and derive "
         "again.\n"
         "#include \"models.hpp\"\n\n";
  for (const std::string& name : names) out << "#include \"" << name << ".hpp\"\n";
  out << "\nnamespace catena {\n\nconst catena_model* const* built_in_models(int* count) {\n"
         "  static const catena_model* const models[] = {\n";
  for (const std::string& name : names) out << "      &" << name << "::table(),\n";
  out << "  };\n  *count = " << names.size()
      << ";\n  return models;\n}\n\n}  // namespace catena\n";
  return out.str();
}

std::string cmake_list(const std::vector<std::string>& names) {
  std::ostringstream out;
  out << "# SPDX-License-Identifier: BSD-3-Clause\n"
         "# Written by catena-derive. Do not edit: change the model description and derive again.\n"
         "add_library(catena_generated STATIC models.cpp";
  for (const std::string& name : names) out << " " << name << ".cpp";
  out << ")\n";
  return out.str();
}

EmittedFiles support_for(const Description& description) {
  EmittedFiles files = support_text();
  const bool moves_load = std::any_of(description.effects.begin(), description.effects.end(),
                                      [](const Effect& effect) { return effect.moves_load(); });
  if (description.space == Space::kPlane) {
    for (const char* name : {"angle_over_sine.hpp", "link_array.hpp", "tangent_semiseparable.hpp"})
      files.erase(name);
    if (!moves_load)
      for (const char* name : {"block_quasiseparable.hpp", "bordered.hpp"}) files.erase(name);
  }
  return files;
}

}  // namespace

std::string summary_name(const std::string& model, Language language) {
  return model + (language == Language::kC ? ".c99" : "") + ".json";
}

EmittedFiles emit_any_links_files(const Description& description) {
  EmittedFiles files = support_for(description);
  files.erase("any_nonzero.hpp");
  files.merge(emit_any_links(description));
  return files;
}

EmittedFiles emit_files(const Description& description, const std::vector<int>& links, bool library,
                        const std::function<void(const ModelSummary&, double seconds)>& progress,
                        std::optional<Layout> layout, Language language, FunctionSet set) {
  const bool c = language == Language::kC;
  EmittedFiles files = support_for(description);
  files.erase("any_links_table.hpp");
  if (set == FunctionSet::kAll) files.erase("any_nonzero.hpp");
  if (c) files = {{"catena_model.h", files.at("catena_model.h")}};
  std::vector<std::string> names;
  for (const int n : links) {
    const auto start = std::chrono::steady_clock::now();
    const Layout chosen =
        layout.value_or(n <= kLongestStraight ? Layout::kStraight : Layout::kLoops);
    EmittedModel model =
        c ? emit_c_model(description, n, chosen) : emit_model(description, n, chosen, set);
    const std::string name = model.summary.name;
    names.push_back(name);
    files.merge(model.files);
    files[summary_name(name, language)] = summary_text(description, model.summary);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    progress(model.summary, elapsed.count());
  }
  if (library) {
    files["models.hpp"] = look_up_header();
    files["models.cpp"] = look_up_source(names);
    if (description.effects.empty()) {
      files.merge(emit_any_links_files(description));
      names.push_back(any_links_name(description));
    }
    files["CMakeLists.txt"] = cmake_list(names);
  }
  return files;
}

}  // namespace catena
