// SPDX-License-Identifier: BSD-3-Clause
#include "identify/report/html.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "identify/report/assets.hpp"
#include "identify/report/html_parts.hpp"
#include "identify/report/payload.hpp"
#include "identify/report/svg_elements.hpp"
#include "identify/report/svg_plot.hpp"

namespace catena::report {
namespace {

using plot::escaped;

/// A chart on a screen needs no more points than this.
constexpr std::size_t kMostPoints = 2400;

struct Section {
  std::string id, heading, content;
};

/// Frames for the figures of one section, one per family, in order. The script fills them; drawings
/// (equal aspect) are there already.
std::string frames(const std::string& section, const std::vector<ReportFigure>& figures,
                   const std::string& first = {}) {
  std::vector<std::string> families;
  for (const ReportFigure& entry : figures) {
    if (entry.section != section) continue;
    if (std::find(families.begin(), families.end(), entry.family) == families.end()) {
      families.push_back(entry.family);
    }
  }
  std::string html;
  for (const std::string& family : families) {
    std::string drawings;
    bool wide = false;  // frames side by side
    for (const ReportFigure& entry : figures) {
      if (entry.section != section || entry.family != family || !entry.figure.equal_aspect)
        continue;
      plot::SvgOptions options;
      wide = wide || !entry.figure.x.ticks.empty();
      options.width = wide ? 1100 : 560;
      options.height = 480;
      drawings += fmt::format("<div class=\"drawing\" data-experiment=\"{}\">{}</div>\n",
                              escaped(entry.experiment), plot::to_svg(entry.figure, options));
    }
    html +=
        fmt::format("<figure class=\"card{}\" id=\"figure-{}\" data-family=\"{}\">\n{}</figure>\n",
                    wide ? " wide" : "", family, family, drawings);
  }
  html = first + html;
  return html.empty() ? "" : "<div class=\"cards\">\n" + html + "</div>\n";
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

}  // namespace

std::string to_html(const Document& document, const std::vector<ReportFigure>& figures) {
  const Result& result = document.result;
  const bool moves = std::any_of(
      result.experiments.begin(), result.experiments.end(), [](const Experiment& experiment) {
        return !experiment.trajectory.time.empty() && !experiment.trajectory.side.empty();
      });
  const std::string player = moves ? "<div class=\"player\" id=\"player\"></div>\n" : "";
  std::vector<Section> sections = {
      {"summary", "Summary", summary_html(document)},
      {"diagnosis", "Diagnosis",
       document.diagnosis ? diagnosis_html(*document.diagnosis) + frames("diagnosis", figures)
                          : ""},
      {"motion", "Motion", frames("motion", figures, player)},
      {"residuals", "Residuals", residuals_html(result) + frames("residuals", figures)},
      {"parameters", "Parameters", parameters_html(result)},
      {"fit", "Fit", fit_html(result) + frames("fit", figures)},
      {"energy", "Energy", frames("energy", figures)},
      {"equations", "Equations", equations_html(result)},
      {"provenance", "Case and versions", provenance_html(result)},
  };
  std::string links;
  std::string body;
  for (const Section& section : sections) {
    if (section.content.empty()) continue;
    links += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", section.id, section.heading);
    body += fmt::format(
        "<section id=\"{0}\" aria-labelledby=\"{0}-heading\">\n<h2 id=\"{0}-heading\">{1}"
        "</h2>\n{2}</section>\n",
        section.id, section.heading, section.content);
  }
  const std::string title = result.title.empty() ? "catena " + result.command : result.title;
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{0} – catena report</title>\n<style>\n{1}</style>\n</head>\n<body>\n"
      "<header>\n<div>\n<h1>{0}</h1>\n<p>catena {2}</p>\n</div>\n<div "
      "id=\"controls\"></div>\n</header>\n"
      "<nav aria-label=\"Sections\">\n<ul>\n{3}</ul>\n</nav>\n"
      "<noscript><p>Charts and player need JavaScript; everything else is below.</p></noscript>\n"
      "<main>\n{4}</main>\n"
      "<script type=\"application/json\" id=\"data\">\n{5}</script>\n<script>\n{6}</script>\n"
      "</body>\n</html>\n",
      escaped(title), asset_style(), escaped(result.command), links, body,
      safe_in_script(payload(document, figures, kMostPoints)), asset_script());
}

}  // namespace catena::report
