// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace catena {

/// The most bytes of an input file: a recording of ten million frames of three markers. Without
/// a limit, an endless file (/dev/zero) would take all memory.
inline constexpr std::size_t kMostFileBytes = 500'000'000;

/// Hands the bytes of a file over as they are, in parts of 64 KB at most. Throws
/// std::filesystem::filesystem_error naming the path if they cannot be read, all of them.
void read_in_parts(const std::filesystem::path& path,
                   const std::function<void(std::string_view)>& take);

/// The bytes of a file as they are. Throws std::filesystem::filesystem_error naming the path if they
/// cannot be read, all of them, and InputError if they are more than `most`.
std::string bytes_of_file(const std::filesystem::path& path, std::size_t most = kMostFileBytes);

/// The text of a file (UTF-8; a byte order mark is left out). Throws InputError naming the path if
/// it is missing, a folder or cannot be read, and the line where a byte is not UTF-8.
std::string read_whole_file(const std::filesystem::path& path);

/// Whether read_whole_file has something to read.
bool is_file(const std::filesystem::path& path);

/// While one of these lives, every file is read once: read_whole_file returns what it returned
/// first, though the file be edited or deleted. What a run computes with, stores and hashes is then
/// the same text. Files that write_whole_file writes are read anew. Threads may share it.
class ReadOnce {
 public:
  /// The first that lives begins with no file read; what the others see is the same.
  ReadOnce();
  ~ReadOnce();
  ReadOnce(const ReadOnce&) = delete;
  ReadOnce& operator=(const ReadOnce&) = delete;
};

/// Whether `text` is UTF-8 (RFC 3629).
bool is_utf8(std::string_view text);

/// Throws InputError naming `what` and the line if `text` is not UTF-8. Results are written as
/// JSON, which holds nothing else.
void require_utf8(std::string_view text, const std::string& what);

/// Makes a folder and those above it, where they are not there. Throws InputError naming the path if it
/// cannot be made.
void make_folder(const std::filesystem::path& folder);

/// Writes a file whole or not at all: to a temporary name in the same folder, then renamed.
/// Throws InputError naming the path if it cannot be written.
void write_whole_file(const std::filesystem::path& path, std::string_view text);

}  // namespace catena
