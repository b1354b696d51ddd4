// SPDX-License-Identifier: BSD-3-Clause
#include "identify/tracker_import.hpp"

namespace catena {

Table import_tracker_table(const ExperimentSpec& experiment) { return read_table(experiment.data); }

}  // namespace catena
