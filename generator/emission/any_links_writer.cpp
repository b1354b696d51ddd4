// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/any_links_writer.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <tuple>

#include "common/input_error.hpp"
#include "generator/emission/model_functions.hpp"
#include "generator/emission/model_text.hpp"
#include "generator/emission/parameter_table.hpp"
#include "generator/emission/program_pattern.hpp"
#include "generator/emission/statement_text.hpp"
#include "generator/emission/table_text.hpp"

namespace catena {

namespace {

constexpr int kFewest = 5;         // where loops begin
constexpr int kGivesProgram = 12;  // with one link more
constexpr int kCompared[] = {kFewest, 24, 60, 240};

// What is the same for every number of links, the statements apart.
void require_alike(const ModelFunctions& a, const ModelFunctions& b) {
  const auto head = [](const ModelFunctions& model) {
    std::vector<std::string> words{model.accelerations, model.summary.why_not};
    words.insert(words.end(), model.terms.begin(), model.terms.end());
    for (const EnergyItem& item : model.energies) words.push_back(item.name);
    for (const Function& function : model.functions) words.push_back(function.name);
    return words;
  };
  const auto structure = [](const ModelSummary& s) {
    return std::tuple(s.structured, s.mass_structured, s.mass_symmetric, s.mass_rank,
                      s.newton_upper_rank, s.newton_lower_rank, s.block, s.border,
                      s.stiffness_tridiagonal, s.damping_tridiagonal);
  };
  if (head(a) != head(b) || structure(a.summary) != structure(b.summary) || a.mass != b.mass ||
      a.newton != b.newton || a.observes != b.observes)
    throw std::logic_error("the functions or the matrices differ between numbers of links");
}

ModelFunctions derive(const Description& description, int links) {
  return model_functions(description, links, Layout::kLoops);
}

// The functions for any number of links; throws std::logic_error where there are none.
ModelFunctions functions_for_any_links(const Description& description) {
  ModelFunctions any = derive(description, kGivesProgram);
  if (any.summary.border > 0)
    throw std::logic_error(
        "the rows of coordinates of the load stand behind a fixed number of links");
  if (any.mass.block > 1)
    throw std::logic_error("a matrix in blocks has arrays of a fixed number of links");
  const ModelFunctions more = derive(description, kGivesProgram + 1);
  require_alike(any, more);
  for (std::size_t k = 0; k < any.functions.size(); ++k) {
    Statements& statements = any.functions[k].statements;
    statements = for_any_links(statements, more.functions[k].statements, kGivesProgram);
  }
  for (const int links : kCompared) {
    const ModelFunctions there = derive(description, links);
    require_alike(any, there);
    for (std::size_t k = 0; k < any.functions.size(); ++k) {
      if (written_out(at_links(any.functions[k].statements, links)) !=
          written_out(there.functions[k].statements))
        throw std::logic_error(any.functions[k].name + " at " + std::to_string(links) +
                               " links is not that at " + std::to_string(kGivesProgram));
    }
  }
  return any;
}

// Why there is no model for any number of links; empty if there is one.
std::string obstacle(const Description& description) {
  try {
    functions_for_any_links(description);
    return "";
  } catch (const std::logic_error& error) {
    return error.what();
  }
}

[[noreturn]] void refuse(const Description& description, const std::string& why) {
  std::string effects = description.space == Space::kPlane ? "" : "space = \"3d\"";
  for (const Effect& effect : description.effects) {
    Description alone = description;
    alone.effects = {effect};
    if (!obstacle(alone).empty()) effects += (effects.empty() ? "" : ", ") + effect.id;
  }
  if (effects.empty()) {  // none alone
    for (const Effect& effect : description.effects)
      effects += (effects.empty() ? "" : " with ") + effect.id;
  }
  throw InputError(description.id +
                   " for any number of links: its equations change with the number"
                   " in more than bounds of loops (" +
                   why + ") because of " + effects +
                   "; leave that out, or derive it for numbers of links (--links)");
}

// Numbers for each link that a function keeps of the mass matrix and to solve with it.
long numbers_of_matrix(const MatrixForm& form) {
  const long upper = form.upper_rank, lower = form.lower_rank;
  return form.kind == MatrixForm::kSymmetricSemiseparable ? 3 * lower + 2
         : form.kind == MatrixForm::kQuasiseparable       ? 2 * upper + 2 * lower + 3
                                                          : 0;
}

// Bytes of arrays for each link, in double precision, of the function that has most.
long bytes_per_link(const ModelFunctions& model) {
  long most = 0;
  for (const Function& function : model.functions) {
    const bool of_matrix =
        function.frame == Frame::kMassMatrix || function.frame == Frame::kAcceleration;
    long numbers = of_matrix ? numbers_of_matrix(model.mass) : 0;
    for (const Statement& statement : function.statements) {
      const auto* variable = std::get_if<Variable>(&statement);
      const auto* input = std::get_if<Input>(&statement);
      if (variable != nullptr && variable->entries) numbers += variable->entries->slope;
      if (input != nullptr && input->kind == InputKind::kSinesAndCosines) numbers += 2;
    }
    most = std::max(most, numbers);
  }
  return most * static_cast<long>(sizeof(double));
}

template <class Row>
Affine count(const std::vector<TableFamily<Row>>& families) {
  Affine sum;
  for (const auto& family : families) sum += family.of_each_link ? Affine(0, 1) : Affine(1);
  return sum;
}

template <class Row, class Text>
std::string families_text(const std::string& type, const std::string& name,
                          const std::vector<TableFamily<Row>>& families, const Text& text) {
  std::ostringstream out;
  out << "  static constexpr std::array<" << type << ", " << families.size() << "> " << name
      << (families.empty() ? "{};\n" : " = {{\n");
  for (const auto& family : families) out << "      {" << text(family) << "},\n";
  out << (families.empty() ? "" : "  }};\n");
  return out.str();
}

std::string any_links_header_text(const Description& description, const ModelFunctions& model) {
  const std::string name = any_links_name(description);
  const TableFamilies table = table_families(description);
  const auto truth = [](bool value) { return value ? "true" : "false"; };
  const auto quantity = [&](const auto& family) {
    return "{" + quantity_text(family.row) + "}, " + truth(family.of_each_link);
  };
  const auto parameter = [&](const auto& family) {
    return "{" + parameter_text(family.row) + "}, " + truth(family.of_each_link) + ", " +
           truth(family.description_numbered);
  };
  const auto size = [](const std::string& what, const Affine& affine) {
    const std::string number = affine.slope == 0 ? "" : "    const int links = number;\n";
    return "  int " + what + "() const {\n" + number + "    return " + affine_text(affine) +
           ";\n  }\n";
  };
  std::ostringstream out;
  out << kBanner
      << "//\n// Equations of motion of a hanging chain of any number of rigid links, from "
      << kFewest << ", with elastic, damped\n// joints and a load";
  if (!description.effects.empty()) {
    out << ",\n// with";
    for (const Effect& effect : description.effects) out << " " << effect.id;
  }
  out << ". Expressions in `links` come from what is derived for " << kGivesProgram << " and "
      << kGivesProgram + 1 << " links;\n// every statement was compared with what is derived for";
  for (const int links : kCompared) out << (links == kFewest ? " " : ", ") << links;
  out << ".\n// The arrays of a call are on the stack (arrays whose length is a variable, as GNU "
         "C++ "
         "has them),\n// in double precision at most "
      << bytes_per_link(model) << " bytes a link"
      << (model.mass.kind == MatrixForm::kDense ? ", and a mass matrix besides" : "")
      << ".\n// Arguments, shapes, units and signs: catena_model.h. T is any scalar type, see "
         "scalar.hpp;\n// D, of differentials, is T or one that holds several directions, see "
         "directions.hpp.\n//\n// Structure found:\n"
      << structure_text(model) << "#pragma once\n\n#include <array>\n\n"
      << space_include(model)
      << "#include \"any_links_table.hpp\"\n#include "
         "\"batch.hpp\"\n"
         "#include \"dense.hpp\"\n#include \"quasiseparable.hpp\"\n#include \"scalar.hpp\"\n"
         "#include \"semiseparable.hpp\"\n\nnamespace catena::"
      << name << " {\n\n/// The fewest links.\ninline constexpr int kFewestLinks = " << kFewest
      << ";\n"
      << matrix_types_text(model, NumberOfLinks::kAny)
      << "\n#pragma GCC diagnostic push\n#pragma GCC diagnostic ignored \"-Wvla\"\n\n"
         "struct Chain {\n  int number;  ///< of links, at least kFewestLinks\n\n"
         "  /// What the table lists.\n  static constexpr const char* kId = \""
      << description.id << "\";\n"
      << families_text("ParameterFamily", "kParameters", table.parameters, parameter)
      << families_text("QuantityFamily", "kCoordinates", table.coordinates, quantity)
      << families_text("QuantityFamily", "kStates", table.states, quantity)
      << families_text("QuantityFamily", "kSignals", table.signals, quantity)
      << families_text("QuantityFamily", "kEvents", table.events, quantity)
      << "\n  /// The number of links, as one the compiler may count on.\n"
         "  int links() const {\n    if (number < kFewestLinks) __builtin_unreachable();\n"
         "    return number;\n  }\n"
      << size("coordinates", count(table.coordinates)) << size("states", count(table.states))
      << size("signals", count(table.signals)) << size("events", count(table.events))
      << size("parameters", count(table.parameters)) << functions_text(model, NumberOfLinks::kAny)
      << "};\n\n#pragma GCC diagnostic pop\n\n"
         "/// The table of a chain, in double precision. Its id and what it lists are to be filled "
         "in:\n/// names take memory (AnyLinksModel of any_links_table.hpp does it). Its context "
         "is "
         "`chain`, which is\n/// to live as long as the table.\ncatena_model table(const Chain& "
         "chain);\n\n}  // namespace catena::"
      << name << "\n";
  return out.str();
}

std::string any_links_source_text(const Description& description, const ModelFunctions& model) {
  const std::string name = any_links_name(description);
  TableText table;
  table.size = "sizeof(catena_model)";
  table.id = "nullptr";
  table.context = "&chain";
  table.links = "links";
  table.coordinates = "chain.coordinates()";
  table.states = "chain.states()";
  table.signals = "chain.signals()";
  table.parameters = "chain.parameters()";
  table.newton_work = "NewtonMatrix<double>::numbers(links)";
  table.batch = "has_batch ? batch_size() : 1";
  table.arrays.assign(4, "nullptr");
  table.events = "chain.events()";
  table.event_array = "nullptr";
  table.function = [](const std::string& member) {
    return member == "accelerations" ? "has_batch ? c_accelerations : c_acceleration"
                                     : "c_" + member;
  };
  std::ostringstream out;
  out << kBanner << "#include \"" << name
      << ".hpp\"\n\n#include \"directions.hpp\"\n\nnamespace catena::" << name
      << " {\n\nnamespace {\n\n"
      << term_array(model) << energy_array(model)
      << table_functions_text(model, NumberOfLinks::kAny)
      << "\n}  // namespace\n\ncatena_model table(const Chain& chain) {\n"
         "  const int links = chain.links();\n  const bool has_batch = links <= "
      << model.most_links_of_batch() << ";  // their arrays are on the stack\n  return {\n"
      << table_members(description, model, table) << "  };\n}\n\n}  // namespace catena::" << name
      << "\n";
  return out.str();
}

}  // namespace

std::string any_links_name(const Description& description) { return description.id + "_any"; }

std::map<std::string, std::string> emit_any_links(const Description& description) {
  const std::string name = any_links_name(description);
  try {
    const ModelFunctions model = functions_for_any_links(description);
    return {{name + ".hpp", any_links_header_text(description, model)},
            {name + ".cpp", any_links_source_text(description, model)}};
  } catch (const std::logic_error& error) {
    if (is_plain_chain(description)) throw;
    refuse(description, error.what());
  }
}

}  // namespace catena
