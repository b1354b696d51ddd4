// SPDX-License-Identifier: BSD-3-Clause
#include "identify/recordings/signal_reader.hpp"

#include <algorithm>
#include <filesystem>
#include <map>

#include "common/in_quotes.hpp"
#include "common/input_error.hpp"
#include "identify/recordings/recording.hpp"
#include "identify/recordings/table.hpp"

namespace catena {

Signals read_signals(const std::vector<SignalSpec>& specs, const Model& model,
                     const std::string& where) {
  Signals signals;
  std::map<std::filesystem::path, Table> tables;  // a file often has the columns of several signals
  for (int i = 0; i < model.signals(); ++i) {
    const catena_quantity& wanted = model.table().signal[i];
    const auto spec = std::find_if(specs.begin(), specs.end(),
                                   [&](const SignalSpec& s) { return s.name == wanted.name; });
    if (spec == specs.end())
      throw InputError(where + ": the model needs the signal " + in_quotes(wanted.name) + " (" +
                       wanted.unit + "); add a [[signal]] with name, data, time and column");
    auto found = tables.find(spec->data);
    if (found == tables.end()) found = tables.emplace(spec->data, read_table(spec->data)).first;
    const Table& table = found->second;
    try {
      signals.add(wanted.name, table.column(spec->time_column), table.column(spec->column));
    } catch (const std::invalid_argument& error) {
      throw InputError(table.file + ": " + error.what());
    }
  }
  return signals;
}

}  // namespace catena
