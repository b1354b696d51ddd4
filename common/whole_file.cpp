// SPDX-License-Identifier: BSD-3-Clause
#include "common/whole_file.hpp"

#include <unistd.h>

#include <fstream>
#include <string>

#include "common/input_error.hpp"

namespace catena {

void write_whole_file(const std::filesystem::path& path, std::string_view text) {
  std::filesystem::path temporary = path;
  temporary += ".part" + std::to_string(getpid());
  std::ofstream stream(temporary, std::ios::binary);
  stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  stream.close();
  std::error_code error;
  if (stream) std::filesystem::rename(temporary, path, error);
  if (!stream || error) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw InputError(path.string() + ": cannot be written" +
                     (error ? " (" + error.message() + ")" : "") +
                     "; check that the folder exists, is writable and has room");
  }
}

}  // namespace catena
