// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include "identify/cases/case_reader.hpp"

namespace catena::python {

/// Recordings of a dict, by the name of their experiment. Each is a DataFrame, a dict of columns or a
/// structured array, with the columns that the file would have; or an array of numbers whose rows are
/// frames: the time, then side and down of every marker. Throws std::invalid_argument for anything else.
HandedIn tables_of(const pybind11::dict& recordings);

/// What a pickle keeps of recordings, and recordings from it.
pybind11::dict tables_state(const HandedIn& recordings);
HandedIn tables_from(const pybind11::dict& state);

}  // namespace catena::python
