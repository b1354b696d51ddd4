// SPDX-License-Identifier: BSD-3-Clause
#include "identify/results/result_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "common/in_quotes.hpp"
#include "common/input_error.hpp"
#include "common/is_within.hpp"
#include "common/nesting.hpp"
#include "common/whole_file.hpp"
#include "identify/results/result_fields.hpp"

namespace catena::results {
namespace {

using Json = nlohmann::ordered_json;

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
    json_["format"] = 2;
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
      if (!is_within(round.result_file) || !link_below(folder_, round.result_file).empty() ||
          !std::filesystem::is_regular_file(file))
        result.fail("it must be the result of the round, a file within the folder and no link");
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
          std::pair("angle", &channels.angle), std::pair("across", &channels.across)})
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
    const Json& format = at("format").json_;
    if (format != 1 && format != 2) at("format").fail("this program reads formats 1 and 2");
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
  /// What version 0.1.0 called it.
  static std::string_view key_of_format_1(std::string_view key) {
    if (key == "noise_level") return "floor";
    if (key == "autocorrelation") return "colour";
    if (key == "autocorrelated") return "coloured";
    return key;
  }

  [[noreturn]] void fail(const std::string& rule) const {
    throw InputError(fmt::format("{} is {}; {}", shortened(where_, kLongestPath),
                                 shortened(json_.dump()), rule));
  }

  Reader at(const char* key) const {
    static const Json kNull;
    auto found = json_.find(key);
    if (found == json_.end()) found = json_.find(key_of_format_1(key));
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
  std::string text;
  try {
    text = bytes_of_file(file);
  } catch (const std::filesystem::filesystem_error& failure) {
    throw InputError(
        fmt::format("{}: cannot be read ({}); give a result.json, diagnosis.json or "
                    "links_study.json, or its folder",
                    file.string(), failure.code().message()));
  }
  try {
    return Json::parse(text, [&](int around, Json::parse_event_t event, Json& /*value*/) {
      const bool begins =
          event == Json::parse_event_t::array_start || event == Json::parse_event_t::object_start;
      if (begins && around >= kDeepestNesting)
        throw InputError(
            fmt::format("{}: lists and tables nested more than {} deep; catena writes no such file",
                        file.string(), kDeepestNesting));
      return true;
    });
  } catch (const Json::parse_error& error) {
    throw InputError(fmt::format("{}: not JSON, at byte {}; was it written by catena and whole?",
                                 file.string(), error.byte));
  } catch (const Json::out_of_range& error) {
    const std::string_view what = error.what();
    throw InputError(fmt::format("{}: {}; numbers go to 1.8e308; was it written by catena?",
                                 file.string(), what.substr(what.find("] ") + 2)));
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
  std::error_code error;  // said where the file cannot be read
  if (std::filesystem::is_directory(path, error)) {
    file = path / "result.json";
    for (const char* name : {"links_study.json", "result.json", "diagnosis.json"}) {
      if (std::filesystem::exists(path / name, error)) file = path / name;
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
