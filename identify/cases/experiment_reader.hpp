// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "common/toml_reader.hpp"
#include "identify/cases/case.hpp"
#include "identify/cases/case_reader.hpp"

namespace catena {

// What a case says of its recordings. Paths are relative to `directory`. Each function throws InputError with file,
// line, key, value and rule.

/// The tables [[signal]] of a case or of an experiment.
std::vector<SignalSpec> read_signals(const TomlTable& table,
                                     const std::filesystem::path& directory);

/// A table [[camera]].
CameraSpec read_camera(const TomlTable& table);

/// A table [[experiment]], the one of `number` from 1. A recording that is handed in needs no file.
ExperimentSpec read_experiment(const TomlTable& table, int number, int links,
                               const std::vector<CameraSpec>& cameras,
                               const std::filesystem::path& directory, const HandedIn& recordings);

}  // namespace catena
