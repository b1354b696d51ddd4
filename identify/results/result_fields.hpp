// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <concepts>
#include <nlohmann/json.hpp>  // NLOHMANN_JSON_EXPAND and NLOHMANN_JSON_PASTE

#include "identify/results/result.hpp"

namespace catena::results {

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
  archive.optional("across", channels.across);
  archive.rule(
      channels.side.size() == channels.down.size(), "down",
      fmt::format("it has {} rows where side has {}", channels.down.size(), channels.side.size()));
  archive.rule(channels.across.empty() || channels.across.size() == channels.side.size(), "across",
               fmt::format("it has {} rows where side has {}", channels.across.size(),
                           channels.side.size()));
  if (channels.time.empty()) return;
  for (const auto& [key, rows] :
       {std::pair("side", &channels.side), std::pair("down", &channels.down),
        std::pair("angle", &channels.angle), std::pair("across", &channels.across)})
    archive.rows(key, *rows, channels.time.size());
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
  archive.optional("sealed", gap.sealed);
  archive("unit", gap.unit);
  archive.optional("noise_level", gap.noise);
  archive.optional("misfit", gap.misfit);
  archive.optional("present", gap.present);
  archive.optional("autocorrelation", gap.autocorrelation);
  archive.optional("size", gap.size);
}

CATENA_FIELDS(Forces, tension, moment)
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
  archive.optional("sealed_from", experiment.sealed_from);
  archive.optional("trajectory", experiment.trajectory);
  archive.optional("forces", experiment.forces);
  if (experiment.forces) {
    for (const auto& [key, rows] : {std::pair("tension", &experiment.forces->tension),
                                    std::pair("moment", &experiment.forces->moment)})
      archive.rule(
          std::all_of(
              rows->begin(), rows->end(),
              [&](const Row& row) { return row.size() == experiment.trajectory.time.size(); }),
          "forces",
          fmt::format("each row of {} must have one number per time of the trajectory", key));
  }
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
      archive.rule(angles || channels->angle.empty(), key,
                   fmt::format("{} has angles beside positions of markers", key));
      const std::size_t across = channels->across.size();
      archive.rule(across == (measured.values.across.empty() ? 0 : rows), key,
                   fmt::format("{} has {} rows of across where side has {}", key, across, rows));
    }
    archive.rule(angles || measured.in_pictures() || experiment.drawn().side.empty() ||
                     experiment.drawn().across.empty() == measured.values.across.empty(),
                 "measured",
                 "either the motion is in space and the markers are not, or the reverse");
  }
  archive.optional("gap", experiment.gap);
  archive.optional("gap_before", experiment.gap_before);
  archive.where(experiment.measured || !experiment.warnings.empty(), "warnings",
                experiment.warnings);
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
  archive("autocorrelated", noise.autocorrelated);
  archive("words", noise.words);
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
  archive.optional("not_derived", model.not_derived);
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
  archive("autocorrelation", refit.autocorrelation);
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
  archive.optional("title", other.title);
}

void fields(auto& archive, Is<Share> auto& share) {
  archive("name", share.name);
  archive("fit", share.fit);
  archive.optional("fit_interval", share.fit_interval);
  archive("validate", share.validate);
  archive.optional("validate_interval", share.validate_interval);
}

CATENA_FIELDS(PredictionError, part, observed, expected, with_errors_of_laws)

void fields(auto& archive, Is<FinalEstimate> auto& estimate) {
  archive("name", estimate.name);
  archive("unit", estimate.unit);
  archive.nullable("effect", estimate.effect);
  archive("value", estimate.value);
  archive("standard_error", estimate.standard_error);
  archive("interval", estimate.interval);
}

void fields(auto& archive, Is<ForceHistory> auto& history) {
  archive("experiment", history.experiment);
  archive("quantity", history.quantity);
  archive.optional("unit", history.unit);
  archive("time", history.time);
  archive("rows", history.rows);
  for (const auto& [key, rows] :
       {std::pair("value", &history.value), std::pair("deviation", &history.deviation)}) {
    archive(key, *rows);
    archive.rows(key, *rows, history.time.size());
    archive.rule(rows->size() == history.rows.size(), key,
                 "it must have one row of numbers per name in rows");
  }
}
CATENA_FIELDS(ForcePattern, name, unit, prior_deviation, resolved)
CATENA_FIELDS(ForcePlace, name, arc_length, log_evidence)
CATENA_FIELDS(ForceLaw, found, force, variable, formula, constants, candidates, confirmed, chance,
              rivals)
void fields(auto& archive, Is<MissingForce> auto& force) {
  archive("found", force.found);
  archive("log_evidence", force.log_evidence);
  archive("share", force.share);
  archive("words", force.words);
  archive.optional("places", force.places);
  archive.optional("best", force.best);
  archive("one_place", force.one_place);
  archive.optional("law", force.law);
  archive.optional("densities", force.densities);
  archive.optional("at_best", force.at_best);
  archive.optional("patterns_over_time", force.patterns_over_time);
  archive.optional("patterns", force.patterns);
  archive.optional("parameters", force.parameters);
  archive("seconds", force.seconds);
}

CATENA_FIELDS(ExperimentNoise, experiment, noise_level)
CATENA_FIELDS(LinksUsed, given, used)
CATENA_FIELDS(PointErrors, name, rms)

void fields(auto& archive, Is<Diagnosis> auto& diagnosis) {
  archive.head("diagnosis");
  archive("title", diagnosis.title);
  archive("versions", diagnosis.versions);
  archive("case", diagnosis.the_case);
  archive("verdict", diagnosis.verdict);
  archive("sentence", diagnosis.sentence);
  archive("notes", diagnosis.notes);
  archive("noise_level", diagnosis.noise);
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
  archive.optional("predictions", diagnosis.predictions);
  archive.optional("of_predictions", diagnosis.of_predictions);
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

}  // namespace catena::results
