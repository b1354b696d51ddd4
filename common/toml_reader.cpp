// SPDX-License-Identifier: BSD-3-Clause
#include "common/toml_reader.hpp"

// toml++ asserts what it checks a line later, such as that the header of a table begins with a key. A
// build with assertions would abort, and without them the compiler may rely on what a file says.
#undef NDEBUG
#define TOML_ASSERT(condition) static_cast<void>(0)
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "common/input_error.hpp"
#include "common/nearest_name.hpp"
#include "common/nesting.hpp"
#include "common/whole_file.hpp"

namespace catena {

struct TomlTable::Document {
  std::string file, source;
  toml::table root;
  std::map<const void*, std::set<std::string, std::less<>>> asked;  // keys, by table
};

namespace {

const toml::table& as_table(const void* table) { return *static_cast<const toml::table*>(table); }

int line_of(const toml::source_region& region) { return static_cast<int>(region.begin.line); }

const char* type_word(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::string:
      return "a text";
    case toml::node_type::integer:
      return "a whole number";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true or false";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::table:
      return "a table";
    default:
      return "a date or time";
  }
}

std::string value_text(const toml::node& node) {
  if (node.is_array() || node.is_table()) return type_word(node);
  std::ostringstream text;
  node.visit([&](const auto& value) { text << value; });
  const std::string shown = text.str();
  return node.is_string() ? "\"" + *node.value<std::string>() + "\"" : shown;
}

std::optional<double> number_of(const toml::node& node) {
  if (node.is_integer() || node.is_floating_point()) return node.value<double>();
  return std::nullopt;
}

// Keys in the order of the file; toml++ keeps them sorted by name.
std::vector<std::pair<std::string, const toml::node*>> in_file_order(const toml::table& table) {
  struct Entry {
    toml::source_position at;
    std::string key;
    const toml::node* node;
  };
  std::vector<Entry> entries;
  for (const auto& [key, node] : table) {
    entries.push_back({key.source().begin, std::string(key.str()), &node});
  }
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Entry& a, const Entry& b) { return a.at < b.at; });
  std::vector<std::pair<std::string, const toml::node*>> ordered;
  for (const Entry& entry : entries) ordered.emplace_back(entry.key, entry.node);
  return ordered;
}

/// Throws InputError for what toml++ must not see. It limits nested values, not dotted keys, and takes
/// the tables apart by recursion. Of some characters beyond ASCII, which are valid in strings and
/// comments only, it says that it cannot reach them.
void check_keys(std::string_view text, const std::string& file) {
  const auto refuse = [&](int line, const std::string& rule) {
    throw InputError(file + ":" + std::to_string(line) + ": " + rule);
  };
  int line = 1, dots = 0;
  for (std::size_t k = text.starts_with("\xEF\xBB\xBF") ? 3 : 0; k < text.size(); ++k) {
    const char c = text[k];
    if (c == '"' || c == '\'') {  // strings, and quoted parts of a key, are passed over
      const std::string_view three = text.substr(k, 3);
      const bool long_string = three == "\"\"\"" || three == "'''";
      const std::string_view quote = text.substr(k, long_string ? 3 : 1);
      std::size_t end = k + quote.size();
      while (end < text.size() && text.substr(end, quote.size()) != quote &&
             (long_string || text[end] != '\n'))
        end += c == '"' && text[end] == '\\' ? 2 : 1;
      end = std::min(end, text.size());
      line += static_cast<int>(std::count(text.begin() + static_cast<long>(k),
                                          text.begin() + static_cast<long>(end), '\n'));
      k = std::min(end + quote.size(), text.size()) - 1;
    } else if (c == '#') {
      k = std::min(text.find('\n', k), text.size()) - 1;
    } else if (c == '.') {
      if (++dots >= kDeepestNesting)
        refuse(line, "a key of more than " + std::to_string(kDeepestNesting) +
                         " parts; nothing that catena reads has one");
    } else if (static_cast<unsigned char>(c) >= 0x80) {
      refuse(line,
             "a letter beyond ASCII outside of quotes; put a key or a text that has one in quotes");
    } else if (c == '\n') {
      ++line;
      dots = 0;
    } else if (c == '=' || c == ',' || c == '{' || c == '[') {
      dots = 0;
    }
  }
}

/// What is most likely wrong in a line that is not TOML: "; ...", or nothing.
std::string toml_remedy(std::string_view text, int line) {
  for (int before = 1; before < line; ++before) {
    const auto end = text.find('\n');
    if (end == std::string_view::npos) return "";
    text.remove_prefix(end + 1);
  }
  text = text.substr(0, text.find('\n'));
  if (text.size() > 200) return "";  // std::regex takes the stack for every letter
  const std::string there(text);
  std::smatch found;
  // Values: a number with a decimal comma, a word without quotes. A [table] that is there twice.
  if (std::regex_match(there, found, std::regex(R"(\s*[\w.-]+\s*=\s*(-?\d+),(\d+)\s*(#.*)?)")))
    return "; a decimal point is wanted: " + found[1].str() + "." + found[2].str();
  if (std::regex_match(there, found,
                       std::regex(R"(\s*[\w.-]+\s*=\s*([A-Za-z_][\w./-]*)\s*(#.*)?)")))
    return "; a text is written in quotes: \"" + found[1].str() + "\"";
  if (std::regex_match(there, found, std::regex(R"(\s*\[([\w.]+)\]\s*(#.*)?)")))
    return "; where a table comes several times, each begins with [[" + found[1].str() + "]]";
  if (line == 1 && there.find_first_of("=[#") == std::string::npos)
    return "; if this is a recording, catena new makes a case from it";
  return "";
}

}  // namespace

TomlTable::TomlTable(std::shared_ptr<Document> document, const void* table, std::string path)
    : document_(std::move(document)), table_(table), path_(std::move(path)) {}

TomlTable TomlTable::read(const std::filesystem::path& path, std::string_view kind) {
  require_utf8(path.string(), "the name of the file " + path.string());
  std::string text;
  try {
    text = read_whole_file(path);
  } catch (const InputError& error) {
    throw InputError(std::string(error.what()) + "; a TOML file of kind \"" + std::string(kind) +
                     "\" is wanted");
  }
  return parse(text, path.string(), kind);
}

TomlTable TomlTable::parse(std::string_view text, std::string_view name, std::string_view kind) {
  auto document = std::make_shared<Document>();
  document->file = std::string(name);
  document->source = std::string(text);
  check_keys(text, document->file);
  try {
    document->root = toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    const int line = line_of(error.source());
    throw InputError(document->file + ":" + std::to_string(line) + ": not valid TOML: " +
                     std::string(error.description()) + toml_remedy(text, line));
  }
  TomlTable table(document, &document->root, "");
  if (!table.has("format")) table.fail("format = 1 is missing; write it as the first line");
  if (const long format = table.integer("format"); format != 1) {
    table.fail("format",
               std::to_string(format) + " is not known to this catena; it reads format 1");
  }
  if (!table.has("kind")) {
    table.fail("kind is missing; write kind = \"" + std::string(kind) + "\" below the format");
  }
  if (const std::string found = table.text("kind"); found != kind) {
    table.fail("kind", "\"" + found + "\" where a file of kind \"" + std::string(kind) +
                           "\" is wanted; give another file or correct the kind");
  }
  return table;
}

namespace {

const toml::node* find(const void* table, std::string_view key) { return as_table(table).get(key); }

}  // namespace

bool TomlTable::has(std::string_view key) const {
  document_->asked[table_].emplace(key);
  return find(table_, key) != nullptr;
}

std::vector<std::string> TomlTable::keys() const {
  std::vector<std::string> keys;
  for (const auto& [key, node] : in_file_order(as_table(table_))) keys.push_back(key);
  return keys;
}

bool TomlTable::is_text(std::string_view key) const {
  return has(key) && find(table_, key)->is_string();
}

bool TomlTable::is_table(std::string_view key) const {
  return has(key) && find(table_, key)->is_table();
}

std::optional<std::string> TomlTable::optional_text(std::string_view key) const {
  if (!has(key)) return std::nullopt;
  const toml::node* node = find(table_, key);
  if (!node->is_string()) fail_type(key, "a text in quotes");
  return node->value<std::string>();
}

std::string TomlTable::text(std::string_view key) const {
  auto value = optional_text(key);
  if (!value) fail_missing(key, "a text");
  return *value;
}

std::optional<double> TomlTable::optional_number(std::string_view key) const {
  if (!has(key)) return std::nullopt;
  const auto value = number_of(*find(table_, key));
  if (!value) fail_type(key, "a number");
  if (std::isnan(*value)) fail(key, "nan is not a number; give one");
  return value;
}

double TomlTable::number(std::string_view key) const {
  const auto value = optional_number(key);
  if (!value) fail_missing(key, "a number");
  return *value;
}

std::optional<long> TomlTable::optional_integer(std::string_view key) const {
  if (!has(key)) return std::nullopt;
  const toml::node* node = find(table_, key);
  if (!node->is_integer()) fail_type(key, "a whole number");
  return node->value<long>();
}

long TomlTable::integer(std::string_view key) const {
  const auto value = optional_integer(key);
  if (!value) fail_missing(key, "a whole number");
  return *value;
}

std::optional<bool> TomlTable::optional_flag(std::string_view key) const {
  if (!has(key)) return std::nullopt;
  const toml::node* node = find(table_, key);
  if (!node->is_boolean()) fail_type(key, "true or false");
  return node->value<bool>();
}

std::vector<double> TomlTable::numbers(std::string_view key) const {
  std::vector<double> values;
  if (!has(key)) return values;
  const toml::array* array = find(table_, key)->as_array();
  if (array == nullptr) fail_type(key, "a list of numbers");
  for (const toml::node& node : *array) {
    const auto value = number_of(node);
    if (!value || std::isnan(*value)) {
      fail(key, value_text(node) + " in the list is not a number; give a list of numbers");
    }
    values.push_back(*value);
  }
  return values;
}

std::vector<long> TomlTable::integers(std::string_view key) const {
  std::vector<long> values;
  if (!has(key)) return values;
  const toml::array* array = find(table_, key)->as_array();
  if (array == nullptr) fail_type(key, "a list of whole numbers");
  for (const toml::node& node : *array) {
    if (!node.is_integer()) {
      fail(key,
           value_text(node) + " in the list is not a whole number; give a list of whole numbers");
    }
    values.push_back(*node.value<long>());
  }
  return values;
}

std::vector<std::string> TomlTable::texts(std::string_view key) const {
  std::vector<std::string> values;
  if (!has(key)) return values;
  const toml::array* array = find(table_, key)->as_array();
  if (array == nullptr) fail_type(key, "a list of texts");
  for (const toml::node& node : *array) {
    if (!node.is_string()) {
      fail(key, value_text(node) + " in the list is not a text; give a list of texts in quotes");
    }
    values.push_back(*node.value<std::string>());
  }
  return values;
}

std::optional<TomlTable> TomlTable::optional_table(std::string_view key) const {
  if (!has(key)) return std::nullopt;
  const toml::node* node = find(table_, key);
  if (!node->is_table()) fail_type(key, "a table ([" + path(key) + "])");
  return TomlTable(document_, node->as_table(), path(key));
}

TomlTable TomlTable::table(std::string_view key) const {
  auto table = optional_table(key);
  if (!table) fail_missing(key, "a table ([" + path(key) + "])");
  return *table;
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) const {
  std::vector<TomlTable> result;
  if (!has(key)) return result;
  const toml::array* array = find(table_, key)->as_array();
  if (array == nullptr) fail_type(key, "a list of tables ([[" + path(key) + "]])");
  for (const toml::node& node : *array) {
    if (!node.is_table()) {
      fail(key, value_text(node) + " in the list is not a table; write [[" + path(key) + "]]");
    }
    result.push_back(TomlTable(document_, node.as_table(), path(key)));
  }
  return result;
}

std::vector<std::pair<std::string, TomlTable>> TomlTable::named_tables(std::string_view key) const {
  std::vector<std::pair<std::string, TomlTable>> result;
  const auto parent = optional_table(key);
  if (!parent) return result;
  for (const auto& [name, node] : in_file_order(as_table(parent->table_))) {
    parent->has(name);
    if (!node->is_table()) {
      parent->fail_type(name, "a table ([" + parent->path(name) + "])");
    }
    result.emplace_back(name, TomlTable(document_, node->as_table(), parent->path(name)));
  }
  return result;
}

std::size_t TomlTable::choice(std::string_view key, const std::vector<std::string>& words,
                              bool required) const {
  const auto word = required ? std::optional(text(key)) : optional_text(key);
  if (!word) return 0;
  const auto found = std::find(words.begin(), words.end(), *word);
  if (found == words.end()) {
    fail(key, "\"" + *word + "\" is not known here" + suggestion(*word, words));
  }
  return static_cast<std::size_t>(found - words.begin());
}

void TomlTable::fail(std::string_view key, const std::string& problem) const {
  throw InputError(file() + ":" + std::to_string(line(key)) + ": " + path(key) + ": " + problem);
}

void TomlTable::fail(const std::string& problem) const {
  throw InputError(file() + ":" + std::to_string(line()) + ": " +
                   (path_.empty() ? problem : path_ + ": " + problem));
}

void TomlTable::fail_missing(std::string_view key, std::string_view what) const {
  fail("\"" + std::string(key) + "\" is missing; give " + std::string(what) + key_like(key));
}

/// Of a key that was not asked for and may be misspelt: " (there is "densty" on line 7)", or nothing.
std::string TomlTable::key_like(std::string_view key) const {
  std::vector<std::string> others;
  for (const auto& [name, node] : as_table(table_)) {
    if (!document_->asked[table_].contains(name.str())) others.emplace_back(name.str());
  }
  const std::string near = nearest_name(key, others);
  if (near.empty()) return "";
  return " (there is \"" + near + "\" on line " + std::to_string(line(near)) + ")";
}

void TomlTable::fail_choice(const std::vector<std::string>& keys) const {
  std::string wanted, given;
  for (const std::string& key : keys) {
    wanted += (wanted.empty() ? "either " : " or ") + key;
    if (has(key)) given += (given.empty() ? "" : " and ") + key;
  }
  if (!given.empty()) fail("give " + wanted + ", not " + given);
  std::string like;
  for (const std::string& key : keys)
    if (like.empty()) like = key_like(key);
  fail("give " + wanted + like);
}

void TomlTable::fail_type(std::string_view key, std::string_view wanted) const {
  const toml::node& node = *find(table_, key);
  std::string shown = value_text(node);
  if (!node.is_array() && !node.is_table()) shown += std::string(" is ") + type_word(node);
  fail(key, shown + " where " + std::string(wanted) + " is wanted");
}

void TomlTable::finish() const {
  const auto& asked = document_->asked[table_];
  for (const auto& [name, node] : in_file_order(as_table(table_))) {
    const std::string& key = name;  // clang 14 lets no lambda take `name`
    if (!asked.contains(key)) {
      const std::vector<std::string> known(asked.begin(), asked.end());
      throw InputError(file() + ":" + std::to_string(line(key)) + ": unknown key \"" + path(key) +
                       "\"" + suggestion(key, known));
    }
    // A table that was never opened was asked for as a whole (has): its keys are not checked.
    const auto check = [&](const toml::node& below) {
      if (below.is_table() && document_->asked.contains(below.as_table())) {
        TomlTable(document_, below.as_table(), path(key)).finish();
      }
    };
    check(*node);
    if (const toml::array* array = node->as_array()) {
      for (const toml::node& element : *array) check(element);
    }
  }
}

const std::string& TomlTable::file() const { return document_->file; }

const std::string& TomlTable::source() const { return document_->source; }

int TomlTable::line() const { return std::max(1, line_of(as_table(table_).source())); }

int TomlTable::line(std::string_view key) const {
  const toml::node* node = find(table_, key);
  return node == nullptr ? line() : line_of(node->source());
}

std::string TomlTable::path(std::string_view key) const {
  if (key.empty()) return path_;
  return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
}

}  // namespace catena
