// SPDX-License-Identifier: BSD-3-Clause
//
// How well hidden forces are recovered: recordings of an independent simulator with a spring from
// the middle of the cable to a wall, or with nothing hidden. Printed beside what is asked
// (docs/diagnosis.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <exception>

#include "tests/identify/forces/hidden_force.hpp"

using namespace catena;

namespace {

int run(int argc, char** argv) {
  testing::Film film;
  truth::Hidden hidden;
  std::vector<std::string> effects;
  CLI::App app("Recovers a hidden force from made recordings.");
  app.add_option("--effect", effects, "NAME=VALUE as of make_recording; repeatable");
  app.add_option("--links", film.links, "of the truth");
  app.add_option("--case-links", film.case_links, "of the case's model");
  app.add_option("--markers", film.camera.markers, "marks on the cable");
  app.add_option("--duration", film.camera.duration, "s");
  app.add_option("--noise", film.camera.noise, "m");
  app.add_option("--seed", film.camera.seed, "of the noise");
  app.add_option("--lens", film.camera.lens, "as of make_recording");
  app.add_option("--shutter", film.camera.shutter, "s");
  app.add_option("--drift", film.camera.drift, "m");
  app.add_option("--slip", film.camera.slip, "m");
  testing::Gusts gusts;
  app.add_option("--gusts", gusts.size,
                 "N, of a force at mid-cable that follows no law; no effects");
  app.add_flag("--spread", gusts.spread,
               "the gusts push the whole cable, 1/length of it each metre");
  app.add_flag(
      "--drawn", gusts.drawn,
      "the gusts follow no sum of oscillations but are drawn from the prior, of this deviation");
  CLI11_PARSE(app, argc, argv);
  for (const std::string& effect : effects) {
    const std::size_t equals = effect.find('=');
    truth::set_hidden(hidden, effect.substr(0, equals), std::stod(effect.substr(equals + 1)));
  }
  testing::Filmed filmed = testing::film(film, hidden);
  gusts.seed = static_cast<unsigned>(film.camera.seed);
  if (gusts.size != 0) testing::push(filmed, gusts);
  const FittedModel baseline = filmed.baseline();
  if (!baseline.ok) return fmt::print("the baseline cannot be fitted\n"), 1;
  const double sigma = film.camera.noise;
  const double rms = std::sqrt(baseline.fit_residual[0].squaredNorm() /
                               static_cast<double>(baseline.fit_residual[0].size()));
  fmt::print("baseline: {:.3f} noises\n", rms / sigma);
  const MissingForce found = missing_force(*baseline.problem, baseline.x, {sigma});
  for (const std::string& words : found.words) fmt::print("  {}\n", words);
  for (const auto& p : found.parameters)
    fmt::print("  {:12} before {:.5g}, now {:.5g} +- {:.2g}\n", p.name, p.before, p.value,
               p.deviation);
  for (const auto& p : found.patterns)
    fmt::print("  {:34} prior {:.3g} {}, resolved {:.2f}\n", p.name, p.prior_deviation, p.unit,
               p.resolved);
  for (const auto& place : found.places)
    fmt::print("  {:34} log evidence {:.1f}\n", place.name, place.log_evidence);
  if (found.best) fmt::print("  best: {} {:.4f}\n", found.best->name, found.best->log_evidence);
  if (found.sensor)
    fmt::print("camera: {}, log evidence {:.1f}\n", found.sensor->name, found.sensor->log_evidence);
  fmt::print("found {}, share {:.4f}, log evidence {:.1f}, CPU {:.1f} s (asked: at most 30)\n",
             found.found, found.share, found.log_evidence, found.seconds);
  if (found.law) {
    fmt::print("law found {}: {} against {}, confirmed {:.3f}, chance {:.3f}\n", found.law->found,
               found.law->force, found.law->variable, found.law->confirmed, found.law->chance);
    fmt::print("  place        {:.6g} +- {:.2g} m\n", found.law->site.arc_length,
               found.law->place_deviation);
    for (const CandidateLaw::Constant& c : found.law->formula.constants)
      fmt::print("  {:12} {:.6g} +- {:.2g} {}\n", c.name, c.value, c.deviation, c.unit);
  }
  if ((hidden.wall_spring == 0 && !gusts.spread) || found.everywhere.empty()) return 0;
  const testing::Recovery modes = testing::recovery_of_modes(filmed, hidden, found);
  fmt::print(
      "two lowest modes normal to the cable below 2 Hz: error {:.1f} % (asked: 20), covered {:.1f} "
      "% (asked: 90 to "
      "97)\n",
      100 * modes.error, 100 * modes.covered);
  if (gusts.spread || found.at_best.empty() || found.best->joint >= 0) return 0;
  const testing::Recovery place = testing::recovery_at_place(filmed, hidden, found);
  fmt::print("at the place {:.3f} m (true {:.3f} m): error {:.1f} % (asked: 5), covered {:.1f} %\n",
             found.best->arc_length, testing::true_place(film), 100 * place.error,
             100 * place.covered);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "force_study: %s\n", error.what());
    return 1;
  }
}
