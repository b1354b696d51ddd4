// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/table_text.hpp"

#include <cmath>
#include <sstream>

#include "common/sha256.hpp"
#include "generator/emission/parameter_table.hpp"

namespace catena {

namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out + "\"";
}

std::string number(double value) {
  if (std::isnan(value)) return "NAN";
  if (std::isinf(value)) return value > 0 ? "INFINITY" : "-INFINITY";
  std::ostringstream out;
  out.precision(17);
  out << value;
  const std::string text = out.str();
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string kind_text(EnergyItem::Kind kind) {
  switch (kind) {
    case EnergyItem::kStored:
      return "CATENA_STORED";
    case EnergyItem::kDissipated:
      return "CATENA_DISSIPATED";
    case EnergyItem::kSupplied:
      return "CATENA_SUPPLIED";
  }
  return "";
}

template <class Rows, class Print>
void table_rows(std::ostringstream& out, const std::string& type, const std::string& name,
                const Rows& rows, const Print& print) {
  out << "static const " << type << " " << name << "[] = {\n";
  for (const auto& row : rows) {
    out << "    {";
    print(row);
    out << "},\n";
  }
  if (rows.empty()) out << "    {0, 0},\n";
  out << "};\n\n";
}

}  // namespace

std::string quantity_text(const QuantityRow& row) {
  return quoted(row.name) + ", " + quoted(row.unit);
}

std::string parameter_text(const ParameterRow& row) {
  return quoted(row.name) + ", " + quoted(row.unit) + ", " + quoted(row.description) + ", " +
         number(row.default_value) + ", " + number(row.lower) + ", " + number(row.upper) + ", " +
         number(row.neutral);
}

std::string term_array(const ModelFunctions& functions) {
  std::ostringstream out;
  table_rows(out, "catena_quantity", "kTermTable", functions.terms, [&](const std::string& name) {
    out << quantity_text({name, "N m"});
  });
  return out.str();
}

std::string energy_array(const ModelFunctions& functions) {
  std::ostringstream out;
  table_rows(out, "catena_energy", "kEnergyTable", functions.energies, [&](const EnergyItem& item) {
    out << quoted(item.name) << ", " << kind_text(item.kind);
  });
  return out.str();
}

std::string table_arrays(const Description& description, const ModelFunctions& functions) {
  const ModelTable table = model_table(description, functions.summary.links);
  std::ostringstream out;
  const auto quantity = [&](const QuantityRow& row) { out << quantity_text(row); };
  table_rows(out, "catena_quantity", "kCoordinateTable", table.coordinates, quantity);
  table_rows(out, "catena_quantity", "kStateTable", table.states, quantity);
  table_rows(out, "catena_quantity", "kSignalTable", table.signals, quantity);
  out << term_array(functions);
  table_rows(out, "catena_parameter", "kParameterTable", table.parameters,
             [&](const ParameterRow& row) { out << parameter_text(row); });
  out << energy_array(functions);
  if (functions.summary.events > 0)
    table_rows(out, "catena_quantity", "kEventTable", table.events, quantity);
  return out.str();
}

std::string table_members(const Description& description, const ModelFunctions& functions,
                          const TableText& text) {
  const ModelSummary& s = functions.summary;
  std::ostringstream out;
  const auto member = [&](const std::string& value, const std::string& comment = "") {
    out << "      " << value << "," << (comment.empty() ? "" : "  // " + comment) << "\n";
  };
  const auto number = [&](auto value, const std::string& comment) {
    member(std::to_string(value), comment);
  };
  member("CATENA_MODEL_ABI");
  member(text.size);
  member(text.id.empty() ? quoted(s.name) : text.id, text.id.empty() ? "" : "id");
  member(quoted(sha256_hex(canonical_text(description))));
  member(text.context, "context");
  member(text.links);
  member(text.coordinates);
  member(text.states);
  member(text.signals);
  member(text.parameters);
  number(functions.terms.size(), "terms");
  number(functions.energies.size(), "energies");
  number(functions.observes ? 1 : 0, "observes");
  number(s.structured ? 1 : 0, "structured");
  member(s.structured ? text.newton_work : "0");
  member(text.batch, "batch");
  for (const std::string& array : text.arrays) member(array);
  member("kTermTable");
  member("kEnergyTable");
  for (const TableEntry& entry : functions.table_entries())
    member(entry.given ? text.function(entry.name) : text.null);
  member(text.events.empty() ? std::to_string(s.events) : text.events, "events");
  member(s.events > 0 ? text.event_array : text.null);
  return out.str();
}

}  // namespace catena
