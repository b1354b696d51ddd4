// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// What result.json and diagnosis.json say (docs/file-formats.md): programs fill these records and
/// write them, and reports read them, by one list of keys (result_file.hpp). SI units, angles in
/// rad. A number that is not there is NaN, a text or a list that is not there is empty.
namespace catena::results {

inline constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();

using Row = std::vector<double>;
using Rows = std::vector<Row>;  ///< [point][time]
using Words = std::vector<std::string>;
using Named = std::vector<std::pair<std::string, std::string>>;
using Numbers = std::vector<std::pair<std::string, double>>;

/// Side and down (m) of points, or angles (rad) of links, over time (s).
struct Channels {
  Row time;
  Rows side, down, angle;
  Rows across = {};  ///< of motions and markers in space
};

struct Point {
  std::string name;
  double arc = kAbsent;  ///< m from the support along the cable
  int link = 0;          ///< of an angle, counted from 1
};

struct Measured {
  std::string
      kind;  ///< "markers", "pictures" (markers in pictures of cameras, in space) or "angles"
  std::vector<Point> points;
  Channels values;     ///< side and down, or angle alone
  Channels predicted;  ///< what the model says the sensor reports at the same times

  /// Side is then to the right in a picture and down downwards, px times the metres per pixel.
  bool in_pictures() const { return kind == "pictures"; }
};

/// Root mean square of the residuals, and what noise alone would leave.
struct Gap {
  double fit = kAbsent, validate = kAbsent;
  double sealed = kAbsent;  ///< of a diagnosis: where nothing was fitted and nothing chosen
  std::string unit;
  double noise = kAbsent;
  double misfit = kAbsent;      ///< in squared noise levels
  std::optional<bool> present;  ///< whether the test finds one
  double autocorrelation = kAbsent, size = kAbsent;
};

struct EnergyItem {
  std::string name, kind;  ///< kind: stored, dissipated or supplied
  Row value;               ///< J; dissipated and supplied: integrated since the start
};

struct Energy {
  Row time;  ///< s
  std::vector<EnergyItem> items;
  double imbalance = kAbsent;  ///< J
};

/// Inside the cable, at the times of the trajectory; signs as in runtime/internal_forces.hpp.
struct Forces {
  Rows tension;  ///< N, per link
  Rows moment;   ///< N m, per joint; joint 1 is the support
};

struct Experiment {
  std::string name, use;
  double fit_until = kAbsent;    ///< s; later samples were held out
  double sealed_from = kAbsent;  ///< s; of a diagnosis: later samples took part in no choice either
  Channels trajectory;           ///< points: support, far end of each link, load
  std::optional<Forces> forces;
  std::optional<Energy> energy;
  std::vector<std::pair<std::string, long>> statistics;  ///< of the integration
  /// Points of the chain where the sensors see them; empty where the model has no sensor effects
  /// and the trajectory says it.
  Channels seen;
  std::optional<Measured> measured;
  std::optional<Gap> gap, gap_before;  ///< gap_before: at the start of the fit
  Words warnings;

  /// What is laid over the measurement.
  const Channels& drawn() const { return seen.side.empty() ? trajectory : seen; }
};

/// The ends of a 95 % interval; infinite where there is none.
struct Interval {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

struct Parameter {
  std::string name, sets, unit;
  bool free = false;
  std::string group, scale;
  double value = kAbsent, start = kAbsent, lower = kAbsent, upper = kAbsent;
  double standard_error = kAbsent;
  std::optional<Interval> interval;
  std::string verdict, note;
  std::optional<Interval> bootstrap_interval;
};

struct MeasurePart {
  std::string name;
  double value = kAbsent;
};

/// The error that was made small.
struct Measure {
  std::string name, unit;
  double value = kAbsent, validation = kAbsent;
  std::vector<MeasurePart> parts;
};

struct History {
  Row step, error;
  Rows parameters;  ///< [unknown][step]
};

struct FailedPoint {
  Row parameters;
  std::string message;
};

struct Optimiser {
  std::string method, strategy, status, message;
  int evaluations = 0;
  double simulations_worth = kAbsent;
  int failures = 0;
  std::vector<FailedPoint> failed;
  long seed = 0;
  double start_error = kAbsent, error = kAbsent, error_noise = kAbsent;
  History history;
};

struct Start {
  double error = kAbsent;
  std::string status;
  Row start;
  double start_error = kAbsent;
  int evaluations = 0;
  Row parameters;
};

struct ChannelNoise {
  std::string name;
  double noise = kAbsent;
  std::optional<Interval> interval;
};

struct WeakDirection {
  double deviation = kAbsent;
  std::string direction;
};

/// The residuals of the fit as noise.
struct ResidualNoise {
  double deviation = kAbsent, autocorrelation = kAbsent;
  bool autocorrelated = false;
  Words words;  ///< what is unusual of the noise, where it was estimated
  Row singular_values;
  std::vector<ChannelNoise> channels;
  std::vector<WeakDirection> weak_directions;
};

struct Profile {
  std::string parameter;
  Row value, cost;
  double threshold = kAbsent;
  std::string verdict;
};

struct LinksRow {
  int links = 0;
  std::string status;
  double error = kAbsent, validation_error = kAbsent;
  int evaluations = 0;
  Numbers parameters;
};

struct Formula {
  std::string what, latex, mathml;  ///< latex: without delimiters
};

struct DerivedEquation {
  std::string title, latex;
};

struct Derived {
  int links = 0;  ///< of the chain whose equations are written out
  std::vector<DerivedEquation> equations;
};

struct EffectEntry {
  std::string id, title;
  std::string text;  ///< of its file, where a result gives it
  std::vector<Formula> formulas;
};

struct ModelEntry {
  std::string id;
  int links = 0;
  std::string description_hash;
  double load_mass = kAbsent;  ///< kg
  std::optional<Derived> derived;
  std::string not_derived;  ///< why `derived` is not there
  std::vector<EffectEntry> effects;
  std::string description;
};

struct CaseEntry {
  std::string file, text, sha256;
};

struct Result {
  std::string command, title, status, message;
  Named versions;
  std::optional<CaseEntry> the_case;
  std::optional<ModelEntry> model;
  std::vector<Experiment> experiments;
  std::optional<Measure> measure;
  std::vector<Parameter> parameters;
  std::optional<Optimiser> optimiser;
  std::vector<Start> starts;
  Rows correlation;
  std::optional<ResidualNoise> residuals;
  std::vector<Profile> profiles;
  std::vector<LinksRow> links_study;
};

struct Refit {
  double fit = kAbsent, validate = kAbsent, criterion = kAbsent;
  double log10_p = kAbsent;  ///< of the fall by chance, number of candidates allowed for
  double misfit_share = kAbsent, autocorrelation = kAbsent;
  Numbers estimate;
};

struct Candidate {
  std::string id, title, kind;
  double score = kAbsent;     ///< share of the squared residual predicted to vanish
  double survives = kAbsent;  ///< share of the sensitivity the free parameters cannot imitate
  bool admissible = true;
  double significance = kAbsent;  ///< p value, number of candidates allowed for
  std::string note;
  Numbers estimate;
  Named units;  ///< of the estimates
  std::optional<Refit> refit;
  std::vector<Formula> formulas;
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
  Words effects;
  Gap gap;
  std::string result_file;         ///< beside diagnosis.json
  std::shared_ptr<Result> result;  ///< what is in it; null where it was not read
  std::optional<FinerChain> finer_chain;
  std::vector<Candidate> candidates;
};

struct TellingExperiment {
  std::string words;
  double difference = kAbsent;  ///< in noise levels
};

/// An effect that was refitted and is not the one that is named.
struct OtherEffect {
  std::string id, instead_of;
  double fit = kAbsent, validate = kAbsent;
  double difference = kAbsent;  ///< of its predictions from the final model's, in noise levels
  double behind = kAbsent;      ///< of its criterion, behind the final model's
  std::optional<TellingExperiment> experiment_that_tells;
  std::string title;
};

/// A parameter of the final model.
struct FinalEstimate {
  std::string name, unit, effect;
  double value = kAbsent, standard_error = kAbsent;
  std::optional<Interval> interval;
};

/// Sizes of forces over time, with standard deviations.
struct ForceHistory {
  std::string experiment;
  std::string quantity;  ///< "side density"
  std::string unit;
  Row time;
  Words rows;             ///< places, or what acts at one place
  Rows value, deviation;  ///< [row][time]
};

struct ForcePattern {
  std::string name, unit;
  double prior_deviation = kAbsent;
  double resolved = kAbsent;  ///< 1 - variance afterwards / before
};

struct ForcePlace {
  std::string name;
  double arc_length = kAbsent;    ///< m
  double log_evidence = kAbsent;  ///< of a force there alone, against none
};

/// What a missing force at one place goes with.
struct ForceLaw {
  bool found = false;
  std::string force, variable;  ///< of the best candidate
  std::string formula;          ///< empty where no law is found
  std::vector<FinalEstimate> constants;
  int candidates = 0;
  double confirmed = kAbsent;  ///< explained in the second part, 1 is all
  double chance = kAbsent;     ///< that a random force seems to follow a law as well
  Words rivals;                ///< formulas that are not told from it
};

struct MissingForce {
  bool found = false;
  double log_evidence = kAbsent;
  double share = kAbsent;  ///< of the squared residuals
  Words words;             ///< where, when and how strong it is
  std::vector<ForcePlace> places;
  std::optional<ForcePlace> best;
  bool one_place = false;  ///< a force at the best place alone is as likely as forces everywhere
  std::optional<ForceLaw> law;  ///< of a force at one place
  std::vector<ForceHistory> densities, at_best, patterns_over_time;
  std::vector<ForcePattern> patterns;
  std::vector<FinalEstimate> parameters;  ///< estimated together with the forces
  double seconds = kAbsent;               ///< CPU time
};

struct ExperimentNoise {
  std::string experiment;
  double noise_level = kAbsent;
};

struct LinksUsed {
  int given = 0, used = 0;
};

struct PointErrors {
  Words name;
  Row rms;
};

/// Of the squared misfit of the model without effects; 1 is all of it.
struct Share {
  std::string name;  ///< an effect, or "left"
  double fit = kAbsent;
  std::optional<Interval> fit_interval;  ///< 95 %
  double validate = kAbsent;
  std::optional<Interval> validate_interval;
};

/// How far a prediction is off, root mean square, and the interval of what was expected, 95 %.
struct PredictionError {
  std::string part;  ///< "validate" or "sealed"
  double observed = kAbsent;
  Interval expected;
  double with_errors_of_laws = kAbsent;  ///< its upper end, if laws are a tenth off there
};

struct Diagnosis {
  std::string title;
  Named versions;
  std::optional<CaseEntry> the_case;
  std::string verdict, sentence;
  Words notes;
  double noise = kAbsent;
  std::string unit;
  std::vector<ExperimentNoise> experiment_noise;
  std::optional<LinksUsed> links;
  Words where;
  PointErrors points;
  std::optional<MissingForce> missing_force;
  std::vector<Round> rounds;
  std::vector<EffectEntry> effects;  ///< of the final model
  std::vector<FinalEstimate> parameters;
  std::vector<Share> shares;
  std::vector<PredictionError> predictions;
  Words of_predictions;  ///< what these say, where they say something
  Words certain;         ///< effects that stand whatever else is missing
  Words members;
  std::vector<OtherEffect> undecided, forms, runners_up;
  std::string experiment_that_tells;
  double equality_at_neutral = kAbsent;  ///< largest relative difference
  int candidates_tried = 0;
  double seconds = kAbsent;
};

}  // namespace catena::results
