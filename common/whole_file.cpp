// SPDX-License-Identifier: BSD-3-Clause
#include "common/whole_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "common/input_error.hpp"

namespace catena {
namespace {

/// Bytes of the character that begins at text[at]; 0 if they are not UTF-8.
std::size_t character_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[at + k]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xC2 && first <= 0xDF   ? 2
                             : first >= 0xE0 && first <= 0xEF ? 3
                             : first >= 0xF0 && first <= 0xF4 ? 4
                                                              : 0;
  if (length == 0 || at + length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byte(k) & 0xC0) != 0x80) return 0;
  // Longer than need be, surrogates, beyond U+10FFFF (RFC 3629, section 4).
  const unsigned char second = byte(1);
  if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
      (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F))
    return 0;
  return length;
}

/// Bytes before the first that is not UTF-8.
std::size_t valid_length(std::string_view text) {
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t length = character_length(text, at);
    if (length == 0) break;
    at += length;
  }
  return at;
}

/// What was read, by path, while a ReadOnce lives.
struct Texts {
  std::mutex mutex;
  int users = 0;
  std::map<std::string, std::string> by_path;
};

Texts& texts() {
  static Texts texts;
  return texts;
}

std::string key_of(const std::filesystem::path& path) {
  return std::filesystem::absolute(path).lexically_normal().string();
}

/// What was read of a file; nothing if it was not read.
std::optional<std::string> remembered(const std::filesystem::path& path) {
  const std::scoped_lock lock(texts().mutex);
  const auto known = texts().by_path.find(key_of(path));
  return known == texts().by_path.end() ? std::nullopt : std::optional(known->second);
}

}  // namespace

ReadOnce::ReadOnce() {
  const std::scoped_lock lock(texts().mutex);
  ++texts().users;
}

ReadOnce::~ReadOnce() {
  const std::scoped_lock lock(texts().mutex);
  if (--texts().users == 0) texts().by_path.clear();
}

bool is_file(const std::filesystem::path& path) {
  std::error_code error;
  return remembered(path) || std::filesystem::is_regular_file(path, error);
}

bool is_utf8(std::string_view text) { return valid_length(text) == text.size(); }

void require_utf8(std::string_view text, const std::string& what) {
  const std::size_t valid = valid_length(text);
  if (valid == text.size()) return;
  const bool utf16 = text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");  // its mark
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(valid), '\n');
  throw InputError(what + ":" + std::to_string(line) +
                   ": a character is not UTF-8; save the text as UTF-8 (iconv -f " +
                   (utf16 ? "utf16" : "latin1") + " -t utf8 converts it)");
}

void read_in_parts(const std::filesystem::path& path,
                   const std::function<void(std::string_view)>& take) {
  // A stream does not tell a failure to read from the end of the file.
  const auto fail = [&] {
    const std::error_code error(errno, std::generic_category());
    throw std::filesystem::filesystem_error("cannot be read", path, error);
  };
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) fail();
  const std::unique_ptr<const int, void (*)(const int*)> closed(&file,
                                                                [](const int* f) { close(*f); });
  std::array<char, 1 << 16> buffer;
  for (ssize_t got; (got = read(file, buffer.data(), buffer.size())) != 0;) {
    if (got > 0)
      take({buffer.data(), static_cast<std::size_t>(got)});
    else if (errno != EINTR)
      fail();
  }
}

std::string bytes_of_file(const std::filesystem::path& path, std::size_t most) {
  std::string bytes;
  read_in_parts(path, [&](std::string_view part) {
    bytes += part;
    if (bytes.size() > most)
      throw InputError(path.string() + ": is larger than " + std::to_string(most / 1'000'000) +
                       " MB, the most that is read of a file; give a part of it");
  });
  return bytes;
}

std::string read_whole_file(const std::filesystem::path& path) {
  if (auto known = remembered(path)) return *std::move(known);
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    throw InputError(path.string() + ": there is no such file");
  if (std::filesystem::is_directory(path, error))
    throw InputError(path.string() + ": is a folder; give the path of a file");
  std::string text;
  try {
    text = bytes_of_file(path);
  } catch (const std::filesystem::filesystem_error& failure) {
    throw InputError(path.string() + ": cannot be read (" + failure.code().message() +
                     "); check its permissions");
  }
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  require_utf8(text, path.string());
  const std::scoped_lock lock(texts().mutex);
  if (texts().users > 0) return texts().by_path.try_emplace(key_of(path), text).first->second;
  return text;
}

namespace {

/// A new file that goes again, unless it was renamed. It needs no memory for that.
class TemporaryFile {
 public:
  /// Of a name that nothing has: whoever made a link of that name would choose what is written over.
  explicit TemporaryFile(const std::filesystem::path& beside) {
    for (int number = 0; file_ < 0; ++number) {
      path_ = beside;
      path_ += ".part" + std::to_string(getpid()) + (number ? "_" + std::to_string(number) : "");
      file_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (file_ < 0 && errno != EEXIST) return;
    }
    there_ = true;
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (there_) unlink(path_.c_str());
    if (file_ >= 0) close(file_);
  }

  /// False where that fails, with errno.
  bool write(std::string_view text) {
    while (file_ >= 0 && !text.empty()) {
      const ssize_t written = ::write(file_, text.data(), text.size());
      if (written < 0 && errno != EINTR) return false;
      if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
    }
    return file_ >= 0 && close(std::exchange(file_, -1)) == 0;
  }
  bool rename_to(const std::filesystem::path& path) {
    there_ = std::rename(path_.c_str(), path.c_str()) != 0;
    return !there_;
  }

 private:
  std::filesystem::path path_;
  int file_ = -1;
  bool there_ = false;
};

}  // namespace

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw InputError(folder.string() + ": cannot be made as a folder: " + error.message());
}

void write_whole_file(const std::filesystem::path& path, std::string_view text) {
  TemporaryFile temporary(path);
  if (!temporary.write(text) || !temporary.rename_to(path)) {
    const std::error_code error(errno, std::generic_category());
    throw InputError(path.string() + ": cannot be written (" + error.message() +
                     "); check that the folder exists, is writable and has room");
  }
  const std::scoped_lock lock(texts().mutex);
  texts().by_path.erase(key_of(path));
}

}  // namespace catena
