// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// What `catena report` reads: result.json of simulate and identify, diagnosis.json of diagnose
/// (docs/file-formats.md). SI units, angles in rad. Numbers that are absent or null are NaN, lists
/// that are absent are empty: the report leaves out what is not there.
namespace catena::report {

inline constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();

using Row = std::vector<double>;
using Rows = std::vector<Row>;  ///< [point][time]
using Named = std::vector<std::pair<std::string, std::string>>;

/// Side and down (m) of points, or angles (rad) of links, over time.
struct Channels {
  Row time;
  Rows side, down, angle;
};

struct Point {
  std::string name;
  double arc = kAbsent;  ///< m from the support along the cable
};

struct Measured {
  std::vector<Point> points;
  Channels values;     ///< side and down, or angle alone
  Channels predicted;  ///< what the model says the sensor reports at the same times
};

/// Root mean square of the residuals, and what noise alone would leave.
struct Gap {
  double fit = kAbsent, validate = kAbsent, floor = kAbsent;
  std::string unit;
};

struct EnergyItem {
  std::string name, kind;  ///< kind: stored, dissipated or supplied
  Row value;               ///< J; dissipated and supplied: integrated since the start
};

struct Experiment {
  std::string name, use;
  double fit_until = kAbsent;  ///< s; later samples were held out
  Channels trajectory;         ///< points: support, far end of each link, load
  /// The same points where the sensors see them, at their clock's times; empty where the model has
  /// no sensor effects and the trajectory says it.
  Channels seen;
  std::optional<Measured> measured;
  double error = kAbsent;
  Gap gap, gap_before;  ///< gap_before: at the start of the fit
  std::vector<std::string> warnings;
  Row energy_time;
  std::vector<EnergyItem> energy;
  double energy_imbalance = kAbsent;  ///< J
  Named statistics;

  /// What is laid over the measurement.
  const Channels& drawn() const { return seen.side.empty() ? trajectory : seen; }
};

struct Parameter {
  std::string name, sets, unit, verdict, note;
  bool free = false;
  double value = kAbsent, start = kAbsent, lower = kAbsent, upper = kAbsent;
  double standard_error = kAbsent;
  bool has_interval = false;
  double low = kAbsent,
         high = kAbsent;  ///< ends of the 95 % interval; infinite where there is none
};

struct Start {
  double error = kAbsent;
  std::string status;
};

struct Profile {
  std::string parameter, verdict;
  Row value, cost;
  double threshold = kAbsent;
};

struct LinksRow {
  int links = 0;
  double error = kAbsent, gap = kAbsent, seconds = kAbsent;
};

struct Equation {
  std::string title;
  std::string mathml;  ///< a whole <math> element
  std::string latex;   ///< without delimiters
};

struct EffectEntry {
  std::string id, title;
  std::string text;                ///< of its file; empty for built-in ones
  std::vector<Equation> formulas;  ///< where the result gives them
};

struct Result {
  std::string command, title, status, message;
  Named versions;
  std::string case_file, case_text;
  std::string model_id, description_hash, description;
  int links = 0;
  double load_mass = kAbsent;     ///< kg
  int derived_links = 0;          ///< of the chain whose derived equations are written out
  std::vector<Equation> derived;  ///< in LaTeX alone
  std::vector<EffectEntry> effects;
  std::vector<Experiment> experiments;
  std::string measure, measure_unit;
  double measure_value = kAbsent, measure_validation = kAbsent;
  std::vector<std::pair<std::string, double>> measure_parts;
  std::vector<Parameter> parameters;
  Rows correlation;
  Named optimiser;  ///< everything said about it in words and numbers
  Row history_step, history_error;
  Rows history_parameters;
  std::vector<Start> starts;
  std::vector<Profile> profiles;
  std::vector<LinksRow> links_study;
};

struct Candidate {
  std::string id, title, note;
  bool admissible = true;
  double score = kAbsent;         ///< share of the squared residual predicted to vanish
  double significance = kAbsent;  ///< p value, number of candidates allowed for
  double survives = kAbsent;      ///< share of the sensitivity the free parameters cannot imitate
  std::vector<std::pair<std::string, double>> estimate;
  double refit_fit = kAbsent, refit_validate = kAbsent, criterion = kAbsent;
  double log10_p = kAbsent;  ///< of the refit's fall by chance, number of candidates allowed for
  std::vector<Equation> formulas;
};

/// What twice the links would change, asked before an effect is blamed.
struct FinerChain {
  int links = 0;
  double predicted_change = kAbsent;  ///< rms, m or rad, that the fit cannot absorb
  bool refitted = false, taken = false;
  std::string note;
};

/// What a round has "added" where it has more links, or "removed" where it went back to fewer.
inline constexpr const char* kTooFewLinks = "too_few_links";

struct Round {
  std::string model, added, removed;
  int links = 0;
  Gap gap;
  std::optional<FinerChain> finer_chain;
  std::vector<Candidate> candidates;
  std::shared_ptr<Result> result;  ///< null where the file does not say
};

/// An effect that was refitted and is not the one that is named.
struct OtherEffect {
  std::string id, instead_of;
  double fit = kAbsent, validate = kAbsent;
  double difference = kAbsent;  ///< of its predictions from the final model's, in noises
  std::string experiment_that_tells;
  double difference_there = kAbsent;  ///< in noises
};

struct MissingForce {
  std::string unit;
  std::vector<std::string> words;  ///< where it is and what it goes with
  Row time;
  std::vector<std::string> rows;
  Rows value;
};

struct Diagnosis {
  std::string verdict, sentence, experiment_that_tells;
  double floor = kAbsent;
  std::string unit;
  std::vector<std::string> where, notes, members;
  int links_given = 0, links_used = 0;
  double equality_at_neutral = kAbsent;  ///< largest relative difference
  std::vector<EffectEntry> effects;      ///< of the final model
  std::vector<OtherEffect> undecided, forms, runners_up;
  std::optional<MissingForce> missing_force;
  std::vector<Round> rounds;
};

/// One report's subject: a result, and with a diagnosis the last of its rounds' results.
struct Document {
  Result result;
  std::optional<Diagnosis> diagnosis;
};

/// Reads a file, or diagnosis.json or else result.json of a folder. Throws InputError that names
/// the file, the key, the value and the rule it broke.
Document read_document(const std::filesystem::path& path);

}  // namespace catena::report
