// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace catena::tests {

// The path of a published recording, such as "engine_air/markers.csv", under $CATENA_DATA or, where
// that is not set, ../shared/data beside the checkout. Nothing where the recording is absent: then
// a line on standard output says that the running test is skipped, and the test should return.
std::optional<std::filesystem::path> published_data(std::string_view name);

// The checkout, and the build folder: programs are in its bin/.
std::filesystem::path source_folder();
std::filesystem::path build_folder();

}  // namespace catena::tests
