// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/any_links_writer.hpp"

#include <sstream>
#include <stdexcept>

#include "common/sha256.hpp"
#include "generator/emission/model_functions.hpp"
#include "generator/emission/model_text.hpp"
#include "generator/emission/parameter_table.hpp"
#include "generator/emission/program_pattern.hpp"
#include "generator/emission/table_text.hpp"

namespace catena {

namespace {

constexpr int kFewest = 5;         // where loops begin
constexpr int kGivesPattern = 12;  // with one link more
constexpr int kCompared[] = {kFewest, 24, 60, 240};

// A row of the table of parameters or coordinates, or those of all links.
template <class Row>
struct Family {
  Row row;  // without the number
  bool of_each_link = false;
};

QuantityRow numbered(const QuantityRow& row, const std::string& number) {
  return {row.name + "_" + number, row.unit};
}

ParameterRow numbered(ParameterRow row, const std::string& number) {
  row.name += "_" + number;
  row.description += " " + number;
  return row;
}

void without_number(QuantityRow& row) { row.name.resize(row.name.size() - 2); }

void without_number(ParameterRow& row) {
  row.name.resize(row.name.size() - 2);
  row.description.resize(row.description.size() - 2);
}

template <class Row>
std::vector<Family<Row>> families_of(const std::vector<Row>& rows, int links) {
  std::vector<Family<Row>> families;
  for (size_t k = 0; k < rows.size();) {
    Family<Row> family{rows[k], rows[k].name.ends_with("_1")};
    if (family.of_each_link) without_number(family.row);
    k += family.of_each_link ? static_cast<size_t>(links) : 1;
    families.push_back(std::move(family));
  }
  return families;
}

template <class Row, class Text>
bool describe(const std::vector<Family<Row>>& families, const std::vector<Row>& rows, int links,
              const Text& text) {
  size_t k = 0;
  const auto same = [&](const Row& row) { return k < rows.size() && text(row) == text(rows[k++]); };
  for (const Family<Row>& family : families) {
    for (int i = 1; i <= (family.of_each_link ? links : 1); ++i) {
      if (!same(family.of_each_link ? numbered(family.row, std::to_string(i)) : family.row))
        return false;
    }
  }
  return k == rows.size();
}

class Writer {
 public:
  explicit Writer(const Description& description)
      : description_(description),
        name_(any_links_name(description)),
        model_(derive(kGivesPattern)),
        table_(model_table(description, kGivesPattern)),
        coordinates_(families_of(table_.coordinates, kGivesPattern)),
        parameters_(families_of(table_.parameters, kGivesPattern)) {
    const ModelFunctions more = derive(kGivesPattern + 1);
    require_alike(more);
    for (size_t k = 0; k < model_.functions.size(); ++k) {
      Statements& statements = model_.functions[k].body.statements;
      statements = for_any_links(statements, more.functions[k].body.statements, kGivesPattern);
    }
    parameter_count_ =
        affine_through(model_.summary.parameters, more.summary.parameters, kGivesPattern);
    for (const int links : kCompared) compare(links);
  }

  std::string header() const {
    std::ostringstream out;
    out << kBanner
        << "//\n// Equations of motion of a hanging chain of any number of rigid links, from "
        << kFewest << ", with elastic, damped\n"
        << "// joints and a load. Expressions in `links` come from what is derived for "
        << kGivesPattern << " and " << kGivesPattern + 1
        << " links;\n// every statement was compared with what is derived for";
    for (const int links : kCompared) out << (links == kFewest ? " " : ", ") << links;
    out << ".\n// The arrays of a call are on the stack, in double precision less than 400 bytes a "
           "link (arrays whose\n// length is a variable, as GNU C++ has them).\n"
           "// Arguments, shapes, units and signs: catena_model.h. T is any scalar type, see "
           "scalar.hpp;\n// D, of differentials, is T or one that holds several directions, see "
           "directions.hpp.\n//\n// Structure found:\n"
        << structure_text(model_)
        << "#pragma once\n\n#include \"any_links.hpp\"\n#include \"lanes.hpp\"\n#include "
           "\"quasiseparable.hpp\"\n#include \"scalar.hpp\"\n#include \"semiseparable.hpp\"\n\n"
           "namespace catena::"
        << name_ << " {\n\n/// The fewest links.\ninline constexpr int kFewestLinks = " << kFewest
        << ";\n\ninline constexpr ParameterFamily kParameters[] = {\n";
    for (const auto& family : parameters_) {
      out << "    {{" << parameter_text(family.row) << "}, "
          << (family.of_each_link ? "true" : "false") << "},\n";
    }
    out << "};\n/// theta_1 ... theta_n\ninline constexpr catena_quantity kCoordinate = {"
        << quantity_text(coordinates_.front().row)
        << "};\n"
           "\n/// Mass matrix in the form in which it is factored.\ntemplate <class T>\nusing "
           "MassMatrix = "
        << at_run_time(model_.mass_type)
        << ";\n\n/// ca dr/da + cv dr/dv + cq dr/dq in the form in which it is factored.\n"
           "template <class T>\nusing NewtonMatrix = "
        << at_run_time(model_.newton_type)
        << ";\n\n#pragma GCC diagnostic push\n#pragma GCC diagnostic ignored \"-Wvla\"\n\n"
           "struct Chain {\n  int number;  ///< of links, at least kFewestLinks\n\n"
           "  /// The same, as one the compiler may count on.\n"
           "  int links() const {\n    if (number < kFewestLinks) __builtin_unreachable();\n"
           "    return number;\n  }\n  int coordinates() const { return number; }\n"
           "  int parameters() const {\n    const int links = number;\n    return "
        << affine_text(parameter_count_) << ";\n  }\n";
    for (const EmittedFunction& function : model_.functions) {
      const Statements& statements = function.body.statements;
      std::string head = "\n/// " + function.comment;
      if (!statements.empty()) head += "\n/// " + operations_text(operations_of(statements));
      head += function.body.along ? "\ntemplate <class T, class D>\n" : "\ntemplate <class T>\n";
      out << indented(head + function.signature + " const {\n" +
                      (!statements.empty() ? kLinks : "") + before(function))
          << statements_text(statements, Language::kCpp, 2) << indented(function.after + "}\n");
    }
    out << "};\n\n#pragma GCC diagnostic pop\n\n"
           "/// The table of a chain, in double precision. Its id, coordinates and parameters are "
           "to "
           "be filled in:\n/// names take memory. Its context is `chain`, which is to live as long "
           "as the table.\ncatena_model table(const Chain& chain);\n\n}  // namespace catena::"
        << name_ << "\n";
    return out.str();
  }

  std::string source() const {
    std::ostringstream out;
    out << kBanner << "#include \"" << name_
        << ".hpp\"\n\n#include \"directions.hpp\"\n\nnamespace catena::" << name_
        << " {\n\nnamespace {\n\n"
        << term_array(model_) << energy_array(model_) << processors_text()
        << "const Chain& chain(const void* context) {\n"
           "  return *static_cast<const Chain*>(context);\n}\n\n";
    for (const EmittedFunction& function : model_.functions) {
      for (const TableFunction& entry : function.entries)
        out << table_function_text(entry, kChainContext);
    }
    out << newton_text(kChainContext, "NewtonMatrix<double>", "{chain(context).links(), work}")
        << batch_text(kChainContext, model_.accelerations)
        << "\n}  // namespace\n\ncatena_model table(const Chain& chain) {\n"
           "  const int links = chain.links();\n  const bool has_batch = links <= "
        << model_.most_links_of_batch()
        << ";  // their arrays are on the stack\n  return {\n"
           "      CATENA_MODEL_ABI,\n      sizeof(catena_model),\n      nullptr,  // id\n"
           "      \""
        << sha256_hex(canonical_text(description_))
        << "\",\n      &chain,\n      links,\n      chain.coordinates(),\n"
           "      0,  // states\n      0,  // signals\n      chain.parameters(),\n      "
        << model_.terms.size() << ",  // terms\n      " << model_.energies.size()
        << ",  // energies\n      0,  // uses_time\n      0,  // observes\n"
           "      1,  // structured\n      NewtonMatrix<double>::numbers(links),\n"
           "      has_batch ? batch_size() : 1,\n"
           "      nullptr,  // coordinates\n      nullptr,\n      nullptr,\n"
           "      nullptr,  // parameters\n      kTermTable,\n      kEnergyTable,\n";
    for (const std::string& entry : model_.table_entries(Language::kCpp)) {
      out << "      "
          << (entry == "c_accelerations" ? "has_batch ? c_accelerations : c_acceleration" : entry)
          << ",\n";
    }
    out << "  };\n}\n\n}  // namespace catena::" << name_ << "\n";
    return out.str();
  }

 private:
  ModelFunctions derive(int links) const {
    return model_functions(description_, links, Layout::kLoops, Language::kCpp);
  }

  [[noreturn]] static void fail(const std::string& what) {
    throw std::logic_error("no model for any number of links: " + what);
  }

  // All but what the patterns are for.
  void require_alike(const ModelFunctions& other) const {
    const auto key = [](const ModelFunctions& model) {
      std::string text = structure_text(model) + model.mass_type + model.newton_type;
      for (const std::string& entry : model.table_entries(Language::kCpp)) text += entry;
      for (const std::string& term : model.terms) text += term;
      for (const EnergyItem& item : model.energies) text += item.name;
      for (const EmittedFunction& f : model.functions)
        text += f.comment + f.signature + f.before + f.after;
      return text;
    };
    if (key(model_) != key(other)) fail("functions differ between numbers of links");
    const ModelSummary& s = other.summary;
    if (!s.structured || !model_.mass_type.starts_with("SymmetricSemiseparable") ||
        s.states + s.signals > 0 || s.coordinates != s.links || model_.uses_time || model_.observes)
      fail("more than the structure of the plain chain");
  }

  void compare(int links) const {
    const ModelFunctions there = derive(links);
    require_alike(there);
    const std::string at = " differs at " + std::to_string(links) + " links";
    for (size_t k = 0; k < model_.functions.size(); ++k) {
      const EmittedFunction& function = there.functions[k];
      if (written_out(at_links(model_.functions[k].body.statements, links)) !=
          written_out(function.body.statements))
        fail(function.name + at);
    }
    const ModelTable table = model_table(description_, links);
    if (!describe(coordinates_, table.coordinates, links, quantity_text) ||
        !describe(parameters_, table.parameters, links, parameter_text) ||
        parameter_count_.at(links) != there.summary.parameters)
      fail("the table" + at);
  }

  // "SymmetricSemiseparable<T, kLinks, 2>"
  static std::string at_run_time(std::string type) {
    const std::string links = "kLinks";
    return type.replace(type.find(links), links.size(), "kAtRunTime");
  }

  // A matrix that a function has for itself needs arrays.
  std::string before(const EmittedFunction& function) const {
    if (function.before != "  MassMatrix<T> matrix;\n") return function.before;
    const int rank = model_.summary.mass_rank;
    const std::string of_rank = "[" + std::to_string(rank) + "][links]";
    const auto arrays = [&](const std::string& name) {
      std::string list;
      for (int r = 0; r < rank; ++r)
        list += (r == 0 ? "" : ", ") + name + "[" + std::to_string(r) + "]";
      return "{" + list + "}";
    };
    return "  T row" + of_rank + ", column" + of_rank +
           ", diagonal[links];\n"
           "  const MassMatrix<T> matrix{links, " +
           arrays("row") + ", " + arrays("column") + ", diagonal};\n";
  }

  // Lines of the preprocessor stay at the margin.
  static std::string indented(const std::string& text) {
    std::string out;
    for (size_t begin = 0; begin < text.size();) {
      const size_t end = text.find('\n', begin);
      const std::string line = text.substr(begin, end - begin);
      out += (line.empty() || line.front() == '#' ? "" : "  ") + line + "\n";
      begin = end + 1;
    }
    return out;
  }

  inline static const std::string kLinks = "  const int links = this->links();\n";

  const Description& description_;
  std::string name_;
  ModelFunctions model_;
  ModelTable table_;
  std::vector<Family<QuantityRow>> coordinates_;
  std::vector<Family<ParameterRow>> parameters_;
  Affine parameter_count_;
};

}  // namespace

std::string any_links_name(const Description& description) { return description.id + "_any"; }

std::map<std::string, std::string> emit_any_links(const Description& description) {
  const Writer writer(description);
  const std::string name = any_links_name(description);
  return {{name + ".hpp", writer.header()}, {name + ".cpp", writer.source()}};
}

}  // namespace catena
