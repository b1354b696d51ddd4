// SPDX-License-Identifier: BSD-3-Clause
//
// catena._core: recordings as numpy arrays and DataFrames.
#include "python/data_frames.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "common/in_quotes.hpp"
#include "identify/recordings/table.hpp"

namespace py = pybind11;

namespace catena::python {
namespace {

using Array = py::array_t<double, py::array::forcecast | py::array::c_style>;

[[noreturn]] void refuse(const std::string& name, const std::string& rule) {
  throw std::invalid_argument("recordings[" + in_quotes(name) + "]: " + rule);
}

/// The names of the columns; empty: an array without names.
std::vector<std::string> names_of(const py::object& recording) {
  py::object names = py::none();
  if (py::hasattr(recording, "columns"))
    names = recording.attr("columns");  // a DataFrame
  else if (py::hasattr(recording, "keys"))
    names = recording.attr("keys")();
  else if (py::hasattr(recording, "dtype"))
    names = recording.attr("dtype").attr("names");
  std::vector<std::string> list;
  if (!names.is_none())
    for (const py::handle& name : names) list.push_back(py::str(name));
  return list;
}

Array numbers_of(const py::object& values, const std::string& name, const std::string& what) {
  const Array array = Array::ensure(values);
  if (!array) refuse(name, what + " is not an array of numbers");
  return array;
}

using Columns = std::vector<std::vector<double>>;

Columns named_columns(const py::object& recording, const std::string& name,
                      const std::vector<std::string>& names) {
  Columns columns;
  for (const std::string& column : names) {
    const Array values =
        numbers_of(recording[py::str(column)], name, "column " + in_quotes(column));
    if (values.ndim() != 1)
      refuse(name, "column " + in_quotes(column) + " has " + std::to_string(values.ndim()) +
                       " dimensions; a column has one");
    if (!columns.empty() && columns[0].size() != static_cast<std::size_t>(values.size()))
      refuse(name, "column " + in_quotes(column) + " has " + std::to_string(values.size()) +
                       " values, " + in_quotes(names[0]) + " " + std::to_string(columns[0].size()) +
                       "; one per frame is wanted");
    columns.emplace_back(values.data(), values.data() + values.size());
  }
  return columns;
}

/// Of an array without names: they are time_s, side_1_m, down_1_m, side_2_m, ...
Columns columns_of(const py::object& recording, const std::string& name,
                   std::vector<std::string>& names) {
  const Array values = numbers_of(recording, name, "the recording");
  if (values.ndim() != 2 || values.shape(1) < 3 || values.shape(1) % 2 == 0)
    refuse(name,
           "an array without names has a row for each frame: the time, then side and down of every "
           "marker; give a dict of columns or a DataFrame for anything else");
  Columns columns(static_cast<std::size_t>(values.shape(1)));
  for (py::ssize_t column = 0; column < values.shape(1); ++column) {
    const std::string marker = std::to_string((column + 1) / 2);
    names.push_back(column == 0       ? "time_s"
                    : column % 2 == 1 ? "side_" + marker + "_m"
                                      : "down_" + marker + "_m");
    for (py::ssize_t row = 0; row < values.shape(0); ++row)
      columns[static_cast<std::size_t>(column)].push_back(*values.data(row, column));
  }
  return columns;
}

/// The recording of one experiment.
std::shared_ptr<const Table> table_of(const std::string& experiment, std::vector<std::string> names,
                                      std::vector<std::vector<double>> columns) {
  auto table = std::make_shared<Table>();
  table->file = "recordings[" + in_quotes(experiment) + "]";
  table->names = std::move(names);
  table->columns = std::move(columns);
  table->lines.resize(table->columns.empty() ? 0 : table->columns[0].size());
  std::iota(table->lines.begin(), table->lines.end(), 0);
  return table;
}

}  // namespace

HandedIn tables_of(const py::dict& recordings) {
  HandedIn tables;
  for (const auto& [key, value] : recordings) {
    const std::string name = py::str(key);
    const auto recording = py::reinterpret_borrow<py::object>(value);
    std::vector<std::string> names = names_of(recording);
    Columns columns =
        names.empty() ? columns_of(recording, name, names) : named_columns(recording, name, names);
    tables[name] = table_of(name, std::move(names), std::move(columns));
  }
  return tables;
}

py::dict tables_state(const HandedIn& recordings) {
  py::dict state;
  for (const auto& [name, table] : recordings)
    state[py::str(name)] = py::make_tuple(table->names, table->columns);
  return state;
}

HandedIn tables_from(const py::dict& state) {
  HandedIn recordings;
  for (const auto& [key, value] : state) {
    const auto name = key.cast<std::string>();
    const auto table = value.cast<py::tuple>();
    recordings[name] =
        table_of(name, table[0].cast<std::vector<std::string>>(), table[1].cast<Columns>());
  }
  return recordings;
}

}  // namespace catena::python
