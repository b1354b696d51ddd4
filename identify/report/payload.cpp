// SPDX-License-Identifier: BSD-3-Clause
#include "identify/report/payload.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "common/number_text.hpp"

namespace catena::report {
namespace {

using nlohmann::ordered_json;

/// Lists of numbers as text, each kept once.
class Columns {
 public:
  /// Exact, or six significant digits.
  explicit Columns(bool exact) : exact_(exact) {}

  std::size_t add(const Row& row, std::size_t stride) {
    std::string text = "[";
    for (std::size_t k = 0; k < row.size(); k += stride) {
      if (k > 0) text += ',';
      append(row[k], text);
    }
    text += ']';
    const auto [place, is_new] = index_.try_emplace(std::move(text), index_.size());
    if (is_new) texts_.push_back(&place->first);
    return place->second;
  }

  std::string text() const {
    std::string all = "[";
    for (const std::string* text : texts_) {
      if (all.size() > 1) all += ",\n";
      all += *text;
    }
    return all + "]";
  }

 private:
  void append(double value, std::string& text) const {
    if (!std::isfinite(value)) {
      text += "null";
    } else if (exact_) {
      text += shortest_number(value);
    } else {
      fmt::format_to(std::back_inserter(text), "{:.6g}", value);
    }
  }

  bool exact_;

  std::map<std::string, std::size_t> index_;
  std::vector<const std::string*> texts_;
};

const char* word(Mark mark) {
  switch (mark) {
    case Mark::kLine:
      return "line";
    case Mark::kPoints:
      return "points";
    case Mark::kLineWithPoints:
      return "lineWithPoints";
    case Mark::kBars:
      return "bars";
  }
  return "line";
}

ordered_json axis_json(const Axis& axis) {
  ordered_json json = {
      {"label", axis.label}, {"unit", axis.unit}, {"logarithmic", axis.logarithmic}};
  if (!axis.categories.empty()) json["categories"] = axis.categories;
  // An array before it grows: JSON for Modern C++ 3.11 breaks a null that turns into one where memory is refused.
  if (!axis.ticks.empty()) json["ticks"] = ordered_json::array();
  for (const Tick& tick : axis.ticks)
    json["ticks"].push_back({{"at", tick.at}, {"label", tick.label}});
  return json;
}

class Writer {
 public:
  explicit Writer(std::size_t most_points)
      : most_points_(most_points), columns_(most_points == 0) {}

  ordered_json figure(const ReportFigure& entry) {
    const Figure& figure = entry.figure;
    ordered_json json = {{"id", figure.id},
                         {"title", figure.title},
                         {"caption", figure.caption},
                         {"section", entry.section},
                         {"family", entry.family},
                         {"experiment", entry.experiment},
                         {"variantKind", entry.variant_kind},
                         {"variant", entry.variant},
                         {"x", axis_json(figure.x)},
                         {"y", axis_json(figure.y)},
                         {"yDownwards", figure.y_downwards},
                         {"equalAspect", figure.equal_aspect},
                         {"wide", !figure.x.ticks.empty()}};
    json["series"] = ordered_json::array();
    for (const Series& series : figure.series) json["series"].push_back(of(series));
    json["rules"] = ordered_json::array();
    for (const Rule& rule : figure.rules) {
      json["rules"].push_back(
          {{"vertical", rule.vertical}, {"at", rule.at}, {"label", rule.label}});
    }
    if (figure.heat_map) json["map"] = of(*figure.heat_map);
    return json;
  }

  ordered_json motion(const Experiment& experiment, double load_mass) {
    const Channels& channels = experiment.drawn();
    ordered_json json = {{"experiment", experiment.name},
                         {"loadMass", std::isfinite(load_mass) ? load_mass : 0}};
    json.update(positions(channels, frames_stride(channels.time)));
    if (experiment.measured) {
      const Channels seen = measured_positions(experiment);
      if (!seen.side.empty()) {
        json["measured"] = positions(seen, 1);
        json["measured"]["connected"] = experiment.measured->values.side.empty();
      }
    }
    return json;
  }

  ordered_json before(const Experiment& experiment) {
    const Channels& channels = experiment.drawn();
    return positions(channels, frames_stride(channels.time));
  }

  std::string columns() const { return columns_.text(); }

 private:
  std::size_t stride(std::size_t size) const {
    return most_points_ == 0 ? 1
                             : std::max<std::size_t>(1, (size + most_points_ - 1) / most_points_);
  }

  /// About 60 frames a second are enough to see a motion.
  std::size_t frames_stride(const Row& time) const {
    if (time.size() < 2 || most_points_ == 0) return 1;
    const double rate = static_cast<double>(time.size() - 1) / (time.back() - time.front());
    const double by_rate = std::max(1.0, std::floor(rate / 60 + 0.01));
    const auto most = static_cast<double>(time.size());  // times of any file may lie close together
    return std::max(static_cast<std::size_t>(std::min(by_rate, most)), stride(time.size()));
  }

  ordered_json of(const Series& series) {
    const std::size_t step = stride(series.x.size());
    ordered_json json = {{"name", series.name},
                         {"mark", word(series.mark)},
                         {"colour", series.colour},
                         {"x", columns_.add(series.x, step)},
                         {"y", columns_.add(series.y, step)}};
    return json;
  }

  ordered_json of(const HeatMap& map) {
    const std::size_t step = stride(map.x.size());
    double maximum = 0;
    ordered_json values = ordered_json::array();
    for (const Row& row : map.value) {
      for (const double value : row) {
        if (std::isfinite(value)) maximum = std::max(maximum, std::abs(value));
      }
      values.push_back(columns_.add(row, step));
    }
    return {{"x", columns_.add(map.x, step)},
            {"rows", map.rows},
            {"value", values},
            {"scale", axis_json(map.scale)},
            {"signed", map.is_signed},
            {"maximum", map.maximum.value_or(maximum)}};
  }

  ordered_json positions(const Channels& channels, std::size_t step) {
    ordered_json json = {{"time", columns_.add(channels.time, step)}};
    for (const auto& [key, rows] :
         {std::pair("side", &channels.side), std::pair("down", &channels.down),
          std::pair("across", &channels.across)}) {
      if (rows == &channels.across && rows->empty()) continue;  // of the plane
      json[key] = ordered_json::array();
      for (const Row& row : *rows) json[key].push_back(columns_.add(row, step));
    }
    return json;
  }

  /// Markers as measured; measured angles of every link as the chain they make.
  static Channels measured_positions(const Experiment& experiment) {
    const Channels& values = experiment.measured->values;
    if (experiment.measured->in_pictures()) return {};
    if (!values.side.empty()) return values;
    const Channels& model = experiment.trajectory;
    if (model.side.size() < values.angle.size() + 1 || model.time.empty()) return {};
    if (values.angle.size() != model.angle.size()) return {};
    Channels chain;
    chain.time = values.time;
    chain.side.assign(values.angle.size() + 1, Row(values.time.size(), 0.0));
    chain.down = chain.side;
    for (std::size_t i = 0; i < values.angle.size(); ++i) {
      const double length = std::hypot(model.side[i + 1][0] - model.side[i][0],
                                       model.down[i + 1][0] - model.down[i][0]);
      for (std::size_t t = 0; t < values.time.size(); ++t) {
        chain.side[i + 1][t] = chain.side[i][t] + length * std::sin(values.angle[i][t]);
        chain.down[i + 1][t] = chain.down[i][t] + length * std::cos(values.angle[i][t]);
      }
    }
    return chain;
  }

  std::size_t most_points_;
  Columns columns_;
};

/// The same experiment before anything was added.
const Experiment* baseline_of(const Document& document, const std::string& name) {
  if (!document.diagnosis || document.diagnosis->rounds.size() < 2) return nullptr;
  const Round& first = document.diagnosis->rounds.front();
  if (!first.result) return nullptr;
  for (const Experiment& experiment : first.result->experiments) {
    if (experiment.name == name && !experiment.drawn().side.empty()) return &experiment;
  }
  return nullptr;
}

}  // namespace

std::string payload(const Document& document, const std::vector<ReportFigure>& figures,
                    std::size_t most_points) {
  Writer writer(most_points);
  ordered_json motions = ordered_json::array();
  for (const Experiment& experiment : document.result.experiments) {
    if (experiment.drawn().time.empty() || experiment.drawn().side.empty()) continue;
    motions.push_back(
        writer.motion(experiment, document.result.model ? document.result.model->load_mass : 0));
    if (const Experiment* before = baseline_of(document, experiment.name)) {
      motions.back()["before"] = writer.before(*before);
    }
  }
  ordered_json entries = ordered_json::array();
  for (const ReportFigure& figure : figures) {
    entries.push_back(writer.figure(figure));
  }
  ordered_json head = {{"format", 1},
                       {"kind", "report"},
                       {"title", document.result.title},
                       {"command", document.result.command},
                       {"motions", motions},
                       {"figures", entries}};
  std::string text = head.dump();
  text.pop_back();
  return fmt::format("{},\n\"columns\":{}}}\n", text, writer.columns());
}

}  // namespace catena::report
