// SPDX-License-Identifier: BSD-3-Clause
#include "identify/report/html.hpp"

namespace catena::report {

Html::Html(const std::string& text) {
  for (const char c : text) {
    switch (c) {
      case '&':
        text_ += "&amp;";
        break;
      case '<':
        text_ += "&lt;";
        break;
      case '>':
        text_ += "&gt;";
        break;
      case '"':
        text_ += "&quot;";
        break;
      default:
        text_ += c;
    }
  }
}

Html Html::markup(std::string text) {
  Html html;
  html.text_ = std::move(text);
  return html;
}

Html& Html::operator+=(const Html& more) {
  text_ += more.text_;
  return *this;
}

Html span(const char* name, Attributes attributes, const Html& content) {
  std::string text = std::string("<") + name;
  for (const auto& [key, value] : attributes)
    text += std::string(" ") + key + "=\"" + Html(value).str() + '"';
  return Html::markup(text + ">" + content.str() + "</" + name + ">");
}

Html element(const char* name, Attributes attributes, const Html& content) {
  return span(name, attributes, content) + "\n";
}

Html table(const std::string& caption, const std::vector<std::vector<Html>>& rows) {
  Html head;
  Html body;
  for (const Html& cell : rows.front()) head += span("th", {{"scope", "col"}}, cell);
  for (std::size_t r = 1; r < rows.size(); ++r) {
    Html cells;
    for (std::size_t c = 0; c < rows[r].size(); ++c)
      cells += c == 0 ? span("th", {{"scope", "row"}}, rows[r][c]) : span("td", {}, rows[r][c]);
    body += element("tr", {}, cells);
  }
  return element(
      "div", {{"class", "table"}, {"tabindex", "0"}, {"role", "region"}, {"aria-label", caption}},
      element("table", {},
              element("caption", {}, caption) + element("thead", {}, span("tr", {}, head)) +
                  element("tbody", {}, body)));
}

Html definitions(const std::vector<std::pair<std::string, Html>>& entries) {
  if (entries.empty()) return {};
  Html list;
  for (const auto& [name, value] : entries)
    list += element("div", {}, span("dt", {}, name) + span("dd", {}, value));
  return element("dl", {}, list);
}

Html disclosed(const Html& heading, const Html& content, bool open) {
  const Html inner = element("summary", {}, heading) + content;
  return open ? element("details", {{"open", ""}}, inner) : element("details", {}, inner);
}

Html list(const std::string& heading, const std::vector<std::string>& items) {
  if (items.empty()) return {};
  Html entries;
  for (const std::string& item : items) entries += element("li", {}, item);
  return element("h3", {}, heading) + element("ul", {}, entries);
}

}  // namespace catena::report
