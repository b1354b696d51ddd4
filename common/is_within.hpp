// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <filesystem>

namespace catena {

/// Whether a path that a file names stays in the folder that it is relative to: it does not begin at
/// the root, and no part of it is "..".
inline bool is_within(const std::filesystem::path& path) {
  return path.is_relative() && std::find(path.begin(), path.end(), "..") == path.end();
}

/// The first part of `relative` below `folder` that is a link; empty: none is.
inline std::filesystem::path link_below(std::filesystem::path folder,
                                        const std::filesystem::path& relative) {
  for (const std::filesystem::path& name : relative)
    if (std::filesystem::is_symlink(folder /= name)) return folder;
  return {};
}

}  // namespace catena
