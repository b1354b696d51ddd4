// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/model_writer.hpp"

#include <sstream>

#include "generator/derivation/chain.hpp"
#include "generator/derivation/structure.hpp"
#include "generator/emission/model_functions.hpp"
#include "generator/emission/model_text.hpp"
#include "generator/emission/table_text.hpp"

namespace catena {

namespace {

std::string header_text(const Description& description, const ModelFunctions& functions) {
  const ModelSummary& s = functions.summary;
  std::ostringstream out;
  out << kBanner << "//\n";
  out << "// Equations of motion of a hanging chain of " << s.links << " rigid link"
      << (s.links == 1 ? "" : "s") << " with elastic, damped joints and a load";
  if (!description.effects.empty()) {
    out << ",\n// with";
    for (const Effect& effect : description.effects) out << " " << effect.id;
  }
  out << ".\n// Arguments, shapes, units and signs: catena_model.h. T is any scalar type, see "
         "scalar.hpp;\n// D, of differentials, is T or one that holds several directions, see "
         "directions.hpp.\n//\n// Structure found:\n"
      << structure_text(functions)
      << "#pragma once\n\n#include \"dense.hpp\"\n#include \"lanes.hpp\"\n#include "
         "\"quasiseparable.hpp\"\n"
         "#include \"scalar.hpp\"\n#include \"semiseparable.hpp\"\n\n";
  out << "extern \"C\" {\nstruct catena_model;\n}\n\n";
  out << "namespace catena::" << s.name << " {\n\n";
  out << "inline constexpr int kLinks = " << s.links << ";\n"
      << "inline constexpr int kCoordinates = " << s.coordinates << ";\n"
      << "inline constexpr int kStates = " << s.states << ";\n"
      << "inline constexpr int kSignals = " << s.signals << ";\n"
      << "inline constexpr int kParameters = " << s.parameters << ";\n\n"
      << "/// The same functions behind the table of catena_model.h, in double precision.\n"
      << "const ::catena_model& table();\n";
  if (!functions.mass_type.empty()) {
    out << "\n/// Mass matrix in the form in which it is factored.\ntemplate <class T>\nusing "
           "MassMatrix = "
        << functions.mass_type << ";\n";
  }
  if (!functions.newton_type.empty()) {
    out << "\n/// ca dr/da + cv dr/dv + cq dr/dq in the form in which it is factored.\n"
           "template <class T>\nusing NewtonMatrix = "
        << functions.newton_type << ";\n";
  }
  for (const EmittedFunction& function : functions.functions) {
    out << "\n/// " << function.comment;
    if (!function.body.statements.empty())
      out << "\n/// " << operations_text(operations_of(function.body.statements));
    out << (function.body.along ? "\ntemplate <class T, class D>\n" : "\ntemplate <class T>\n")
        << function.signature << " {\n"
        << function.before << statements_text(function.body.statements, Language::kCpp, 1)
        << function.after << "}\n";
  }
  out << "\n}  // namespace catena::" << s.name << "\n";
  return out.str();
}

std::string source_text(const Description& description, const ModelFunctions& functions) {
  const ModelSummary& s = functions.summary;
  std::ostringstream out;
  out << kBanner << "#include \"" << s.name
      << ".hpp\"\n\n#include \"catena_model.h\"\n#include \"directions.hpp\"\n\nnamespace catena::"
      << s.name << " {\n\nnamespace {\n\n";
  out << table_arrays(description, functions);
  out << processors_text();
  for (const EmittedFunction& function : functions.functions) {
    for (const TableFunction& entry : function.entries)
      out << table_function_text(entry, kNoContext);
  }
  if (s.structured) {
    out << newton_text(kNoContext, "NewtonMatrix<double>&",
                       "*reinterpret_cast<NewtonMatrix<double>*>(work)");
  }
  if (functions.has_batch()) out << batch_text(kNoContext, functions.accelerations);
  out << "}  // namespace\n\nconst ::catena_model& table() {\n"
         "  static const ::catena_model model = {\n";
  out << table_entries(description, functions, Language::kCpp);
  out << "  };\n  return model;\n}\n\n}  // namespace catena::" << s.name << "\n\n"
      << "#ifdef CATENA_SHARED_LIBRARY\n"
         "// The one entry of a shared library that holds this model alone.\n"
         "extern \"C\" const catena_model* catena_model_table() {\n  return &catena::"
      << s.name << "::table();\n}\n#endif\n";
  return out.str();
}

}  // namespace

std::string model_name(const Description& description, int links) {
  return description.id + "_" + std::to_string(links);
}

EmittedModel emit_model(const Description& description, int links, Layout layout) {
  const ModelFunctions functions = model_functions(description, links, layout, Language::kCpp);
  EmittedModel model;
  model.summary = functions.summary;
  const std::string name = functions.summary.name;
  model.files[name + ".hpp"] = header_text(description, functions);
  model.files[name + ".cpp"] = source_text(description, functions);
  return model;
}

}  // namespace catena
