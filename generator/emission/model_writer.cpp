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
      << structure_text(functions) << "#pragma once\n\n"
      << space_include(functions)
      << (functions.set == FunctionSet::kFits ? "#include \"any_nonzero.hpp\"\n" : "")
      << "#include \"batch.hpp\"\n#include \"dense.hpp\"\n#include "
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
  out << matrix_types_text(functions, NumberOfLinks::kOne)
      << functions_text(functions, NumberOfLinks::kOne);
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
  out << table_functions_text(functions, NumberOfLinks::kOne);
  out << "}  // namespace\n\nconst ::catena_model& table() {\n"
         "  static const ::catena_model model = {\n";
  TableText table;
  table.batch = functions.has_batch() ? "batch_size()" : "1";
  table.function = [&](const std::string& name) {
    return name == "accelerations" && !functions.has_batch() ? "c_acceleration" : "c_" + name;
  };
  out << table_members(description, functions, table);
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

EmittedModel emit_model(const Description& description, int links, Layout layout, FunctionSet set) {
  const ModelFunctions functions = model_functions(description, links, layout, set);
  EmittedModel model;
  model.summary = functions.summary;
  const std::string name = functions.summary.name;
  model.files[name + ".hpp"] = header_text(description, functions);
  model.files[name + ".cpp"] = source_text(description, functions);
  return model;
}

}  // namespace catena
