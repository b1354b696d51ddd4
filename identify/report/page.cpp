// SPDX-License-Identifier: BSD-3-Clause
#include "identify/report/page.hpp"

#include <algorithm>
#include <map>
#include <string_view>

#include "common/sha256.hpp"
#include "identify/report/assets.hpp"
#include "identify/report/html.hpp"
#include "identify/report/payload.hpp"
#include "identify/report/sections.hpp"

namespace catena::report {
namespace {

/// A chart on a screen needs no more points than this.
constexpr std::size_t kMostPoints = 2400;

/// Frames for the figures of one section, one per family, in order. The script fills them.
Html frames(const std::string& section, const std::vector<ReportFigure>& figures,
            const Html& first = {}) {
  Html html = first;
  std::vector<std::string> families;
  for (const ReportFigure& entry : figures) {
    const std::string& family = entry.family;
    if (entry.section != section ||
        std::find(families.begin(), families.end(), family) != families.end())
      continue;
    families.push_back(family);
    html += element("figure",
                    {{"class", entry.figure.x.ticks.empty() ? "card" : "card wide"},
                     {"id", "figure-" + family},
                     {"data-family", family}},
                    {});
  }
  return html.empty() ? html : element("div", {{"class", "cards"}}, html);
}

/// "</script>" and "<!--" cannot occur in it.
std::string safe_in_script(const std::string& json) {
  std::string safe;
  for (const char c : json) {
    if (c == '<') {
      safe += "\\u003c";
    } else {
      safe += c;
    }
  }
  return safe;
}

/// Base 64 (RFC 4648) of bytes written as hexadecimal digits.
std::string base64_of_hex(const std::string& hex) {
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t k = 0; k < hex.size(); k += 3) {  // three digits are 12 bits, two letters
    std::string group = hex.substr(k, 3);
    const std::size_t given = group.size();
    group.resize(3, '0');
    const unsigned long bits = std::stoul(group, nullptr, 16);
    text += kDigits[bits >> 6];
    if (given > 1) text += kDigits[bits & 63];
  }
  while (text.size() % 4 != 0) text += '=';
  return text;
}

/// The template with every {{name}} replaced.
std::string filled(std::string_view page,
                   const std::map<std::string_view, std::string_view>& values) {
  std::string text;
  std::size_t from = 0;
  for (auto at = page.find("{{"); at != std::string_view::npos; at = page.find("{{", from)) {
    const auto end = page.find("}}", at);
    text += page.substr(from, at - from);
    text += values.at(page.substr(at + 2, end - at - 2));
    from = end + 2;
  }
  text += page.substr(from);
  return text;
}

}  // namespace

std::string to_html(const Document& document, const std::vector<ReportFigure>& figures) {
  const Result& result = document.result;
  const bool moves = std::any_of(
      result.experiments.begin(), result.experiments.end(), [](const Experiment& experiment) {
        return !experiment.drawn().time.empty() && !experiment.drawn().side.empty();
      });
  const Html player = moves ? element("div", {{"class", "player"}, {"id", "player"}}, {}) : Html();
  struct Section {
    std::string id, heading;
    Html content;
  };
  Html links;
  Html body;
  for (const Section& section : std::initializer_list<Section>{
           {"summary", "Summary", summary_section(document)},
           {"diagnosis", "Diagnosis",
            document.diagnosis
                ? diagnosis_section(*document.diagnosis) + frames("diagnosis", figures)
                : Html()},
           {"parameters", "Parameters", parameters_section(result)},
           {"motion", "Motion", frames("motion", figures, player)},
           {"forces", "Forces inside the cable", frames("forces", figures)},
           {"residuals", "Residuals", residuals_section(result) + frames("residuals", figures)},
           {"fit", "Fit", fit_section(result) + frames("fit", figures)},
           {"energy", "Energy", frames("energy", figures)},
           {"equations", "Equations", equations_section(result)},
           {"provenance", "Case and versions", provenance_section(result)}}) {
    if (section.content.empty()) continue;
    links += element("li", {}, span("a", {{"href", "#" + section.id}}, section.heading));
    const std::string heading = section.id + "-heading";
    body += element("section", {{"id", section.id}, {"aria-labelledby", heading}},
                    element("h2", {{"id", heading}}, section.heading) + section.content);
  }
  static const std::string script_hash = base64_of_hex(sha256_hex(asset_script()));
  const Html title(result.title.empty() ? "catena " + result.command : result.title);
  const Html command(result.command);
  const std::string data = safe_in_script(payload(document, figures, kMostPoints));
  return filled(asset_page(), {{"title", title.str()},
                               {"command", command.str()},
                               {"style", asset_style()},
                               {"links", links.str()},
                               {"sections", body.str()},
                               {"data", data},
                               {"script", asset_script()},
                               {"script_hash", script_hash}});
}

}  // namespace catena::report
