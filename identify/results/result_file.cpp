// SPDX-License-Identifier: BSD-3-Clause
#include "identify/results/result_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <fstream>
#include <nlohmann/json.hpp>

#include "common/input_error.hpp"
#include "common/nesting.hpp"

namespace catena::results {
namespace {

using Json = nlohmann::ordered_json;

/// A record, or a constant one.
template <class Record, class T>
concept Is = std::same_as<std::remove_const_t<Record>, T>;

// The keys of every record, in the order of the file, for reading and for writing. CATENA_FIELDS
// serves records whose keys are the names of their members. An archive does:
//   archive(key, value)               a number that is not there is written as null
//   archive.nullable(key, text)       so is an empty text
//   archive.where(given, key, value)  written only if given
//   archive.optional(key, value)      written only if there is something
//   archive.rows(key, rows, columns)  checks, when reading, that all rows have so many entries
//   archive.rule(holds, key, words)   checks, when reading

#define CATENA_FIELD(name) archive(#name, record.name);
#define CATENA_FIELDS(Record, ...)                                       \
  void fields(auto& archive, Is<Record> auto& record) {                  \
    NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(CATENA_FIELD, __VA_ARGS__)) \
  }

void fields(auto& archive, Is<Channels> auto& channels) {
  archive.optional("time", channels.time);
  archive.optional("side", channels.side);
  archive.optional("down", channels.down);
  archive.optional("angle", channels.angle);
  if (channels.time.empty()) return;
  for (const auto& [key, rows] :
       {std::pair("side", &channels.side), std::pair("down", &channels.down),
        std::pair("angle", &channels.angle)})
    archive.rows(key, *rows, channels.time.size());
  archive.rule(
      channels.side.size() == channels.down.size(), "down",
      fmt::format("it has {} rows where side has {}", channels.down.size(), channels.side.size()));
}

void fields(auto& archive, Is<Point> auto& point) {
  archive("name", point.name);
  archive.optional("arc", point.arc);
  archive.optional("link", point.link);
}

void fields(auto& archive, Is<Measured> auto& measured) {
  archive("kind", measured.kind);
  archive("time", measured.values.time);
  archive("points", measured.points);
  fields(archive, measured.values);
}

void fields(auto& archive, Is<Gap> auto& gap) {
  archive("fit", gap.fit);
  archive("validate", gap.validate);
  archive("unit", gap.unit);
  archive.optional("floor", gap.noise);
  archive.optional("misfit", gap.misfit);
  archive.optional("present", gap.present);
  archive.optional("colour", gap.autocorrelation);
  archive.optional("size", gap.size);
}

CATENA_FIELDS(EnergyItem, name, kind, value)
void fields(auto& archive, Is<Energy> auto& energy) {
  archive("time", energy.time);
  archive("items", energy.items);
  archive("imbalance", energy.imbalance);
  for (const EnergyItem& item : energy.items)
    archive.rule(item.value.size() == energy.time.size(), "items",
                 "each value must have one number per time of the energy");
}

void fields(auto& archive, Is<Experiment> auto& experiment) {
  archive("name", experiment.name);
  archive.optional("use", experiment.use);
  archive.optional("fit_until", experiment.fit_until);
  archive.optional("trajectory", experiment.trajectory);
  archive.optional("energy", experiment.energy);
  archive.optional("statistics", experiment.statistics);
  archive.optional("seen", experiment.seen);
  archive.optional("measured", experiment.measured);
  if (experiment.measured) {
    auto& measured = *experiment.measured;
    archive.optional("predicted", measured.predicted);
    archive.complete(measured.predicted, measured.values.time);
    const bool angles = measured.values.side.empty();
    const std::size_t due = measured.points.size();
    for (const auto& [key, channels] :
         {std::pair("measured", &measured.values), std::pair("predicted", &measured.predicted)}) {
      const std::size_t rows = (angles ? channels->angle : channels->side).size();
      archive.rule(rows == due || (rows == 0 && channels == &measured.predicted), key,
                   fmt::format("{} has {} rows for {} points", key, rows, due));
    }
  }
  archive.optional("gap", experiment.gap);
  archive.optional("gap_before", experiment.gap_before);
  archive.where(experiment.measured.has_value(), "warnings", experiment.warnings);
}

void fields(auto& archive, Is<Parameter> auto& parameter) {
  const bool free = archive.flag("free", parameter.free);
  archive("name", parameter.name);
  archive("sets", parameter.sets);
  archive("unit", parameter.unit);
  archive("free", parameter.free);
  archive.optional("group", parameter.group);
  archive.optional("scale", parameter.scale);
  archive("value", parameter.value);
  archive.where(free, "start", parameter.start);
  archive.where(free, "lower", parameter.lower);
  archive.where(free, "upper", parameter.upper);
  archive.where(parameter.interval.has_value(), "standard_error", parameter.standard_error);
  archive.optional("interval", parameter.interval);
  archive.optional("verdict", parameter.verdict);
  archive.optional("note", parameter.note);
  archive.optional("bootstrap_interval", parameter.bootstrap_interval);
}

CATENA_FIELDS(MeasurePart, name, value)
CATENA_FIELDS(Measure, name, unit, value, validation, parts)
void fields(auto& archive, Is<History> auto& history) {
  archive("step", history.step);
  archive("error", history.error);
  archive("parameters", history.parameters);
  archive.rule(history.step.size() == history.error.size(), "step",
               "it must have one number per error");
  archive.rows("parameters", history.parameters, history.step.size());
}

CATENA_FIELDS(FailedPoint, parameters, message)
CATENA_FIELDS(Optimiser, method, strategy, status, message, evaluations, simulations_worth,
              failures, failed, seed, start_error, error, error_noise, history)
CATENA_FIELDS(Start, error, status, start, start_error, evaluations, parameters)
CATENA_FIELDS(ChannelNoise, name, noise, interval)
CATENA_FIELDS(WeakDirection, deviation, direction)
void fields(auto& archive, Is<ResidualNoise> auto& noise) {
  archive("deviation", noise.deviation);
  archive("lag_one_correlation", noise.autocorrelation);
  archive("coloured", noise.autocorrelated);
  archive("singular_values", noise.singular_values);
  archive("channels", noise.channels);
  archive("weak_directions", noise.weak_directions);
}

void fields(auto& archive, Is<Profile> auto& profile) {
  archive("parameter", profile.parameter);
  archive("value", profile.value);
  archive("cost", profile.cost);
  archive("threshold", profile.threshold);
  archive("verdict", profile.verdict);
  archive.rule(profile.value.size() == profile.cost.size(), "cost",
               "it must have one number per value");
}

CATENA_FIELDS(LinksRow, links, status, error, validation_error, evaluations, parameters)
CATENA_FIELDS(Formula, what, latex, mathml)
CATENA_FIELDS(DerivedEquation, title, latex)
CATENA_FIELDS(Derived, links, equations)
void fields(auto& archive, Is<EffectEntry> auto& effect) {
  archive("id", effect.id);
  archive("title", effect.title);
  archive.optional("text", effect.text);
  archive("formulas", effect.formulas);
}

void fields(auto& archive, Is<ModelEntry> auto& model) {
  archive("id", model.id);
  archive("links", model.links);
  archive("description_hash", model.description_hash);
  archive("load_mass", model.load_mass);
  archive.optional("derived", model.derived);
  archive("effects", model.effects);
  archive.optional("description", model.description);
}

CATENA_FIELDS(CaseEntry, file, text, sha256)
void fields(auto& archive, Is<Result> auto& result) {
  const bool whole = result.links_study.empty();
  archive.head("result");
  archive("command", result.command);
  archive("title", result.title);
  archive.where(whole, "status", result.status);
  archive.where(whole, "message", result.message);
  archive.optional("versions", result.versions);
  archive.optional("case", result.the_case);
  archive.optional("model", result.model);
  archive.where(whole, "experiments", result.experiments);
  archive.optional("measure", result.measure);
  archive.where(whole, "parameters", result.parameters);
  archive.optional("optimiser", result.optimiser);
  archive.optional("starts", result.starts);
  archive.optional("correlation", result.correlation);
  archive.rows("correlation", result.correlation, result.correlation.size());
  archive.optional("residuals", result.residuals);
  archive.where(result.residuals.has_value(), "profiles", result.profiles);
  archive.optional("links_study", result.links_study);
}

void fields(auto& archive, Is<Refit> auto& refit) {
  archive("fit", refit.fit);
  archive("validate", refit.validate);
  archive("criterion", refit.criterion);
  archive("log10_p", refit.log10_p);
  archive("misfit_share", refit.misfit_share);
  archive("colour", refit.autocorrelation);
  archive("estimate", refit.estimate);
}

void fields(auto& archive, Is<Candidate> auto& candidate) {
  archive("id", candidate.id);
  archive("title", candidate.title);
  archive("kind", candidate.kind);
  archive("score", candidate.score);
  archive("survives", candidate.survives);
  archive("admissible", candidate.admissible);
  archive("significance", candidate.significance);
  archive("note", candidate.note);
  archive("estimate", candidate.estimate);
  archive.optional("units", candidate.units);
  archive.optional("refit", candidate.refit);
  archive.optional("formulas", candidate.formulas);
}

CATENA_FIELDS(FinerChain, links, predicted_change, refitted, taken, note)
void fields(auto& archive, Is<Round> auto& round) {
  archive("model", round.model);
  archive.nullable("added", round.added);
  archive.nullable("removed", round.removed);
  archive("links", round.links);
  archive("effects", round.effects);
  archive("gap", round.gap);
  archive.result(round);
  archive.optional("finer_chain", round.finer_chain);
  archive("candidates", round.candidates);
}

CATENA_FIELDS(TellingExperiment, words, difference)
void fields(auto& archive, Is<OtherEffect> auto& other) {
  archive("id", other.id);
  archive("instead_of", other.instead_of);
  archive("fit", other.fit);
  archive("validate", other.validate);
  archive("difference", other.difference);
  archive("behind", other.behind);
  archive.optional("experiment_that_tells", other.experiment_that_tells);
}

void fields(auto& archive, Is<Share> auto& share) {
  archive("name", share.name);
  archive("fit", share.fit);
  archive.optional("fit_interval", share.fit_interval);
  archive("validate", share.validate);
  archive.optional("validate_interval", share.validate_interval);
}

CATENA_FIELDS(Dependence, on, share)
void fields(auto& archive, Is<MissingForce> auto& force) {
  archive("experiment", force.experiment);
  archive("time", force.time);
  archive("unit", force.unit);
  archive("rows", force.rows);
  archive("value", force.value);
  archive("noise", force.noise);
  archive("resolution", force.resolution);
  archive("depends", force.depends);
  archive("words", force.words);
  archive.rows("value", force.value, force.time.size());
  archive.rule(force.value.size() == force.rows.size(), "value",
               "it must have one row of numbers per name in rows");
}

void fields(auto& archive, Is<ExperimentNoise> auto& noise) {
  archive("experiment", noise.experiment);
  archive("floor", noise.noise);
  archive("coloured", noise.autocorrelated);
}

CATENA_FIELDS(LinksUsed, given, used)
CATENA_FIELDS(PointErrors, name, rms)
void fields(auto& archive, Is<FinalEstimate> auto& estimate) {
  archive("name", estimate.name);
  archive("unit", estimate.unit);
  archive.nullable("effect", estimate.effect);
  archive("value", estimate.value);
  archive("standard_error", estimate.standard_error);
  archive("interval", estimate.interval);
}

void fields(auto& archive, Is<Diagnosis> auto& diagnosis) {
  archive.head("diagnosis");
  archive("title", diagnosis.title);
  archive("versions", diagnosis.versions);
  archive("case", diagnosis.the_case);
  archive("verdict", diagnosis.verdict);
  archive("sentence", diagnosis.sentence);
  archive("notes", diagnosis.notes);
  archive("floor", diagnosis.noise);
  archive("unit", diagnosis.unit);
  archive("noise", diagnosis.experiment_noise);
  archive("links", diagnosis.links);
  archive("where", diagnosis.where);
  archive("points", diagnosis.points);
  archive.optional("missing_force", diagnosis.missing_force);
  archive("rounds", diagnosis.rounds);
  archive("effects", diagnosis.effects);
  archive("parameters", diagnosis.parameters);
  archive.optional("shares", diagnosis.shares);
  archive.optional("certain", diagnosis.certain);
  archive("members", diagnosis.members);
  archive("undecided", diagnosis.undecided);
  archive("forms", diagnosis.forms);
  archive("runners_up", diagnosis.runners_up);
  archive.optional("experiment_that_tells", diagnosis.experiment_that_tells);
  archive("equality_at_neutral", diagnosis.equality_at_neutral);
  archive("candidates_tried", diagnosis.candidates_tried);
  archive("seconds", diagnosis.seconds);
}

template <class T>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<std::vector<T>> = true;
template <class T>
inline constexpr bool is_table = false;  // of names and values
template <class T>
inline constexpr bool is_table<std::vector<std::pair<std::string, T>>> = true;
template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;

class Writer {
 public:
  void head(const char* kind) {
    json_["format"] = 1;
    json_["kind"] = kind;
  }
  template <class T>
  void operator()(const char* key, const T& value) {
    json_[key] = written(value);
  }
  void nullable(const char* key, const std::string& text) {
    json_[key] = text.empty() ? Json(nullptr) : Json(text);
  }
  template <class T>
  void where(bool given, const char* key, const T& value) {
    if (given) (*this)(key, value);
  }
  template <class T>
  void optional(const char* key, const T& value) {
    Json json = written(value);
    bool absent = json.is_null() || json == "" || (json.is_structured() && json.empty());
    if constexpr (std::is_same_v<T, int>) absent = value == 0;
    if (!absent) json_[key] = std::move(json);
  }
  bool flag(const char* /*key*/, bool value) const { return value; }
  void result(const Round& round) { json_["result"] = round.result_file; }
  void complete(const Channels& /*channels*/, const Row& /*time*/) {}
  void rows(const char* /*key*/, const Rows& /*rows*/, std::size_t /*columns*/) {}
  void rule(bool /*holds*/, const char* /*key*/, const std::string& /*words*/) {}

  template <class T>
  static Json written(const T& value) {
    if constexpr (std::is_same_v<T, double>) {
      return std::isfinite(value) ? Json(value) : Json(nullptr);
    } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
      return value;
    } else if constexpr (std::is_same_v<T, Interval>) {
      return {written(value.low), written(value.high)};
    } else if constexpr (is_table<T>) {
      Json json = Json::object();
      for (const auto& [name, entry] : value) json[name] = written(entry);
      return json;
    } else if constexpr (is_list<T>) {
      Json json = Json::array();
      for (const auto& entry : value) json.push_back(written(entry));
      return json;
    } else if constexpr (is_optional<T>) {
      return value ? written(*value) : Json(nullptr);
    } else {
      Writer writer;
      fields(writer, value);
      return writer.json_;
    }
  }

 private:
  Json json_ = Json::object();
};

Json parsed(const std::filesystem::path& file);

/// A place in a file: its value and the way to it, for messages.
class Reader {
 public:
  /// `folder`: where the results of rounds are.
  Reader(const Json& json, std::string where, const std::filesystem::path& folder)
      : json_(json), where_(std::move(where)), folder_(folder) {}

  void head(const char* /*kind*/) {}
  template <class T>
  void operator()(const char* key, T& value) {
    at(key).read(value);
  }
  void nullable(const char* key, std::string& text) { (*this)(key, text); }
  template <class T>
  void where(bool /*given*/, const char* key, T& value) {
    (*this)(key, value);
  }
  template <class T>
  void optional(const char* key, T& value) {
    (*this)(key, value);
  }
  bool flag(const char* key, bool& value) {
    (*this)(key, value);
    return value;
  }
  void result(Round& round) {
    const Reader result = at("result");
    round.result = std::make_shared<Result>();
    if (result.json_.is_object()) {
      result.read(*round.result);
    } else if (result.json_.is_null()) {
      round.result = nullptr;
    } else {
      result.read(round.result_file);
      const std::filesystem::path file = folder_ / round.result_file;
      const Json json = parsed(file);
      const Reader root(json, file.string() + ": result", folder_);
      root.kind();
      root.read(*round.result);
    }
  }
  void complete(Channels& channels, const Row& time) {
    channels.time = time;
    for (const auto& [key, rows] :
         {std::pair("side", &channels.side), std::pair("down", &channels.down),
          std::pair("angle", &channels.angle)})
      at("predicted").rows(key, *rows, time.size());
  }
  void rows(const char* key, const Rows& rows, std::size_t columns) const {
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (rows[k].size() != columns)
        at(key).entry(k).fail(
            fmt::format("it has {} entries where {} are due", rows[k].size(), columns));
  }
  void rule(bool holds, const char* key, const std::string& words) const {
    if (!holds) at(key).fail(words);
  }

  /// "result" or "diagnosis".
  std::string kind() const {
    if (!json_.is_object()) fail("it must be a result or a diagnosis written by catena");
    const Json& kind = at("kind").json_;
    if (kind != "result" && kind != "diagnosis")
      at("kind").fail("it must be \"result\" or \"diagnosis\"");
    if (at("format").json_ != 1) at("format").fail("this program reads format 1");
    return kind;
  }

  template <class T>
  void read(T& value) const {
    if (json_.is_null()) return;
    if constexpr (std::is_same_v<T, double>) {
      if (!json_.is_number()) fail("it must be a number or null");
      value = json_.get<double>();
    } else if constexpr (std::is_same_v<T, bool>) {
      if (!json_.is_boolean()) fail("it must be true or false");
      value = json_.get<bool>();
    } else if constexpr (std::is_integral_v<T>) {
      if (!json_.is_number_integer()) fail("it must be a whole number");
      value = json_.get<T>();
    } else if constexpr (std::is_same_v<T, std::string>) {
      if (!json_.is_string()) fail("it must be text");
      value = json_.get<std::string>();
    } else if constexpr (std::is_same_v<T, Interval>) {
      Row ends;
      read(ends);
      if (ends.size() != 2) fail("it must have two ends");
      if (!std::isnan(ends[0])) value.low = ends[0];
      if (!std::isnan(ends[1])) value.high = ends[1];
    } else if constexpr (is_table<T>) {
      if (!json_.is_object()) fail("it must be a table of keys and values");
      value.clear();
      for (const auto& [name, entry] : json_.items()) {
        value.emplace_back(name, typename T::value_type::second_type{});
        Reader(entry, fmt::format("{}.{}", where_, name), folder_).read(value.back().second);
      }
    } else if constexpr (std::is_same_v<T, Row>) {
      if (!json_.is_array()) fail("it must be a list of numbers");
      value.clear();
      for (const Json& entry : json_) {
        if (!entry.is_number() && !entry.is_null()) fail("it must hold numbers or null only");
        value.push_back(entry.is_null() ? kAbsent : entry.get<double>());
      }
    } else if constexpr (std::is_same_v<T, std::vector<Formula>>) {
      if (json_.is_object()) return read_two_lists(value);
      read_list(value);
    } else if constexpr (is_list<T>) {
      read_list(value);
    } else if constexpr (is_optional<T>) {
      read(value.emplace());
    } else {
      if (!json_.is_object()) fail("it must be a table of keys and values");
      Reader reader(json_, where_, folder_);
      fields(reader, value);
    }
  }

 private:
  [[noreturn]] void fail(const std::string& rule) const {
    std::string text = json_.dump();
    if (text.size() > 60) text = text.substr(0, 57) + "...";
    throw InputError(fmt::format("{} is {}; {}", where_, text, rule));
  }

  Reader at(const char* key) const {
    static const Json kNull;
    const auto found = json_.find(key);
    return {found == json_.end() ? kNull : *found, fmt::format("{}.{}", where_, key), folder_};
  }

  Reader entry(std::size_t k) const {
    return {json_[k], fmt::format("{}[{}]", where_, k), folder_};
  }

  template <class T>
  void read_list(T& value) const {
    if (!json_.is_array()) fail("it must be a list");
    value.clear();
    for (std::size_t k = 0; k < json_.size(); ++k) entry(k).read(value.emplace_back());
  }

  /// LaTeX and MathML of the same formulas as two lists, as version 0.1.0 wrote for candidates.
  void read_two_lists(std::vector<Formula>& formulas) const {
    Words latex, mathml;
    at("latex").read(latex);
    at("mathml").read(mathml);
    formulas.resize(std::max(latex.size(), mathml.size()));
    for (std::size_t k = 0; k < latex.size(); ++k) formulas[k].latex = latex[k];
    for (std::size_t k = 0; k < mathml.size(); ++k) formulas[k].mathml = mathml[k];
  }

  const Json& json_;
  std::string where_;
  const std::filesystem::path& folder_;
};

Json parsed(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) {
    throw InputError(
        fmt::format("{}: cannot be opened; give a result.json, diagnosis.json or links_study.json, "
                    "or its folder",
                    file.string()));
  }
  try {
    return Json::parse(stream, [&](int depth, Json::parse_event_t /*event*/, Json& /*value*/) {
      if (depth > kDeepestNesting)
        throw InputError(
            fmt::format("{}: lists and tables nested more than {} deep; catena writes no such file",
                        file.string(), kDeepestNesting));
      return true;
    });
  } catch (const Json::parse_error& error) {
    throw InputError(fmt::format("{}: not JSON, at byte {}; was it written by catena and whole?",
                                 file.string(), error.byte));
  }
}

/// The diagnosis has the errors of the estimates, the last round's result the rest.
void use_estimates(const std::vector<FinalEstimate>& estimates,
                   std::vector<Parameter>& parameters) {
  for (const FinalEstimate& estimate : estimates) {
    auto same = std::find_if(parameters.begin(), parameters.end(),
                             [&](const Parameter& p) { return p.name == estimate.name; });
    if (same == parameters.end()) {
      same = parameters.emplace(parameters.end());
      same->name = estimate.name;
      same->unit = estimate.unit;
    }
    same->free = true;
    same->value = estimate.value;
    same->standard_error = estimate.standard_error;
    same->interval = estimate.interval;
  }
}

}  // namespace

std::string text_of(const Result& result) { return Writer::written(result).dump(1) + "\n"; }

std::string text_of(const Diagnosis& diagnosis) {
  return Writer::written(diagnosis).dump(1) + "\n";
}

Derived read_derived(const std::string& json) {
  Derived derived;
  Reader(Json::parse(json), "derived", {}).read(derived);
  return derived;
}

Document read_document(const std::filesystem::path& path) {
  std::filesystem::path file = path;
  if (std::filesystem::is_directory(path)) {
    file = path / "result.json";
    for (const char* name : {"links_study.json", "result.json", "diagnosis.json"}) {
      if (std::filesystem::exists(path / name)) file = path / name;
    }
  }
  const Json json = parsed(file);
  const std::filesystem::path folder = file.parent_path();
  const Reader root(json, fmt::format("{}: result", file.string()), folder);
  Document document;
  if (root.kind() == "result") {
    root.read(document.result);
    return document;
  }
  const Diagnosis& diagnosis = document.diagnosis.emplace();
  root.read(*document.diagnosis);
  for (const Round& round : diagnosis.rounds)
    if (round.result) document.result = *round.result;
  Result& result = document.result;
  result.command = "diagnose";
  if (!diagnosis.title.empty()) result.title = diagnosis.title;
  if (!diagnosis.versions.empty()) result.versions = diagnosis.versions;
  if (diagnosis.the_case) result.the_case = diagnosis.the_case;
  if (!result.model) result.model.emplace();
  if (result.model->effects.empty()) result.model->effects = diagnosis.effects;
  use_estimates(diagnosis.parameters, result.parameters);
  return document;
}

}  // namespace catena::results
