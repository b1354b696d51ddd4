// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace catena {

/// One table of a TOML file, read key by key. Every failure throws InputError
/// "file:line: key: value; rule and what to do".
///
///     const TomlTable file = TomlTable::read("my.toml", "case");  // format = 1, kind = "case"
///     const std::string title = file.text("title");               // an error if it is missing
///     const double length = file.table("cable").number("length");
///     file.finish();                                              // unknown keys are errors
///
/// A key is known once it has been asked for, whether the file has it or not. Copies share one
/// document.
class TomlTable {
 public:
  /// Parses a file. Fails on a missing file, on bad TOML, on another `format` or `kind`.
  static TomlTable read(const std::filesystem::path& path, std::string_view kind);
  /// The same for a text; `name` stands for the file in messages.
  static TomlTable parse(std::string_view text, std::string_view name, std::string_view kind);

  /// Whether the file has the key.
  bool has(std::string_view key) const;
  /// The keys of this table, in the order of the file.
  std::vector<std::string> keys() const;

  /// The value of a key. A missing key is a failure of the first of each pair; the second returns
  /// nothing.
  std::string text(std::string_view key) const;
  std::optional<std::string> optional_text(std::string_view key) const;
  double number(std::string_view key) const;  ///< whole numbers too; inf allowed, nan never
  std::optional<double> optional_number(std::string_view key) const;
  long integer(std::string_view key) const;
  std::optional<long> optional_integer(std::string_view key) const;
  std::optional<bool> optional_flag(std::string_view key) const;
  bool is_text(std::string_view key) const;  ///< false also if the key is missing

  /// Lists; empty if the key is missing.
  std::vector<double> numbers(std::string_view key) const;
  std::vector<long> integers(std::string_view key) const;
  std::vector<std::string> texts(std::string_view key) const;

  /// [key]. A missing one is a failure of the first; the second returns nothing.
  TomlTable table(std::string_view key) const;
  std::optional<TomlTable> optional_table(std::string_view key) const;
  /// [[key]]: in the order of the file; empty if missing.
  std::vector<TomlTable> tables(std::string_view key) const;
  /// [key.NAME]: name and table, in the order of the file; empty if missing.
  std::vector<std::pair<std::string, TomlTable>> named_tables(std::string_view key) const;

  /// The index of the value in `words`. 0 if the key is missing and `required` is false.
  std::size_t choice(std::string_view key, const std::vector<std::string>& words,
                     bool required = true) const;

  /// Throws InputError "file:line: key: problem". `problem` names the value, the rule and what to
  /// do. An empty key stands for the table itself.
  [[noreturn]] void fail(std::string_view key, const std::string& problem) const;
  /// The same at the table itself.
  [[noreturn]] void fail(const std::string& problem) const;

  /// The same at the table itself, where a key is missing: "KEY" is missing; give WHAT (there is ...),
  /// with the unknown key that is spelt alike.
  [[noreturn]] void fail_missing(std::string_view key, std::string_view what) const;
  /// The same where exactly one of several keys is wanted, and none or several are there.
  [[noreturn]] void fail_choice(const std::vector<std::string>& keys) const;

  /// Fails on the first key, in this table or below, that was never asked for, and names the
  /// nearest known one. Call it on the outermost table when everything is read.
  void finish() const;

  /// Its name, as messages say it.
  const std::string& file() const;
  const std::string& source() const;             ///< the whole file as it was read
  int line() const;                              ///< of the table's header
  int line(std::string_view key) const;          ///< of the key's value; of the table if missing
  std::string path(std::string_view key) const;  ///< "cable.length", shortened

 private:
  struct Document;
  TomlTable(std::shared_ptr<Document> document, const void* table, std::string path);
  std::string full_path(std::string_view key) const;
  std::string key_like(std::string_view key) const;
  [[noreturn]] void fail_type(std::string_view key, std::string_view wanted) const;

  std::shared_ptr<Document> document_;
  const void* table_;  // const toml::table*, kept out of this header for the compile time
  std::string path_;
};

}  // namespace catena
