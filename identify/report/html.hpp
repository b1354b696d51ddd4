// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace catena::report {

/// A piece of a page. Text becomes one by being escaped, so that nothing read from a file can be
/// markup; markup is written by element() and, of what this program itself holds, by markup().
class Html {
 public:
  Html() = default;
  Html(const std::string& text);                       // NOLINT: text is a piece of a page, escaped
  Html(const char* text) : Html(std::string(text)) {}  // NOLINT

  /// Trusted markup as it is.
  static Html markup(std::string text);

  Html& operator+=(const Html& more);
  friend Html operator+(Html first, const Html& second) { return first += second; }

  bool empty() const { return text_.empty(); }
  /// The markup.
  const std::string& str() const { return text_; }

 private:
  std::string text_;
};

using Attributes = std::initializer_list<std::pair<const char*, std::string>>;

/// <name attributes>content</name> and the end of a line; values of attributes are escaped.
Html element(const char* name, Attributes attributes, const Html& content);
/// The same without the end of a line, for words within a line.
Html span(const char* name, Attributes attributes, const Html& content);

/// A table; the first row is the heading, the first column names its row.
Html table(const std::string& caption, const std::vector<std::vector<Html>>& rows);

/// Names and what belongs to them; nothing where there are none.
Html definitions(const std::vector<std::pair<std::string, Html>>& entries);

/// Content that a reader may open under its heading.
Html disclosed(const Html& heading, const Html& content, bool open);

/// A list of texts under a heading; nothing where there are none.
Html list(const std::string& heading, const std::vector<std::string>& items);

}  // namespace catena::report
