// SPDX-License-Identifier: BSD-3-Clause
//
// Two links on encoders: what the encoders report wrongly is told from friction, and friction from it.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <random>

#include "identify/diagnosis/diagnose.hpp"
#include "identify/diagnosis/diagnosis_text.hpp"
#include "identify/diagnosis/variant.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "identify/noise/cosine_spectrum.hpp"
#include "tests/identify/diagnosis/two_link_case.hpp"
#include "tests/support/near.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;

namespace encoder_test {
namespace {

const std::vector<std::string> kEffects = {"encoder_error", "pivot_dry_friction"};
constexpr double kNoise = 1e-3;  // rad
constexpr int kFrames = 300;

Case on_encoders() {
  Case the_case = testing::two_links_with(kEffects);
  the_case.experiments.front().kind = DataKind::kAngles;
  return the_case;
}

/// Angles of both links, no values yet.
Recording empty_angles() {
  Recording recording;
  for (int k = 0; k < kFrames; ++k) recording.time.push_back(k / 60.0);
  for (int link = 1; link <= 2; ++link) {
    PointSpec point;
    point.name = fmt::format("link {}", link);
    point.link = link;
    recording.points.push_back(point);
    recording.channels.push_back({link - 1, Component::kAngle, point.name});
  }
  recording.measured.setZero(2, kFrames);
  recording.fit_frames = kFrames;
  return recording;
}

using Reported = double (*)(double angle);

/// The diagnosis of a film from this angle (rad), with so much dry friction at the pivot (N m), on encoders that
/// report angles so.
Diagnosis diagnosed(double start, double friction, Reported reported) {
  const testing::TemporaryFolder folder;
  Case the_case = on_encoders();
  the_case.initial.coefficients = {start};
  DiagnosisContext context(the_case, {}, folder.path(), fit_least_squares,
                           testing::provider_of_build());
  Candidate effect = *context.find("pivot_dry_friction");
  for (CandidateParameter& parameter : effect.parameters)
    if (parameter.name == "pivot_dry_friction.moment") parameter.value = friction;
  const Recording recording = testing::with_truth(with_effects(the_case, {effect}, true),
                                                  context.model_with(kEffects, 2), empty_angles());
  std::mt19937_64 random(1);
  std::string text = "time_s,theta_1_rad,theta_2_rad";
  for (Eigen::Index k = 0; k < kFrames; ++k) {
    text += fmt::format("\n{}", recording.time[static_cast<std::size_t>(k)]);
    for (const double angle : recording.measured.col(k))
      text += fmt::format(",{}", reported(angle) + kNoise * normal_number(random));
  }
  ExperimentSpec& spec = the_case.experiments.front();
  spec.data = folder.write("angles.csv", text + "\n");
  spec.fit_until = recording.time[7 * kFrames / 10];
  return diagnose(the_case, context, {.max_links = 2});
}

double value_of(const Diagnosis& found, const std::string& name) {
  for (const FinalParameter& parameter : found.parameters)
    if (parameter.name == name) return parameter.value;
  return std::nan("");
}

}  // namespace

TEST_CASE("an encoder that errs with its angle is named, with its harmonics") {
  // An axis off the centre of the disc, and the disc tilted. Small angles do not tell the harmonics apart.
  const Diagnosis found = diagnosed(2.0, 0, [](double angle) {
    return angle + 0.01 * std::sin(angle) + 0.006 * std::cos(angle) + 0.004 * std::sin(2 * angle);
  });
  CAPTURE(diagnosis_table(found, find_out(found)));
  CHECK(found.verdict == DiagnosisVerdict::kNamed);
  CHECK(found.effects == std::vector<std::string>{"encoder_error"});
  CHECK(value_of(found, "encoder_error.sine") == catena::near(0.01, 0.2));
  CHECK(value_of(found, "encoder_error.second_sine") == catena::near(0.004, 0.2));
}

TEST_CASE("dry friction of a pivot on encoders is not called an error of the encoder") {
  const Diagnosis found = diagnosed(0.6, 0.01, [](double angle) { return angle; });
  CAPTURE(diagnosis_table(found, find_out(found)));
  CHECK(found.verdict == DiagnosisVerdict::kNamed);
  CHECK(found.effects == std::vector<std::string>{"pivot_dry_friction"});
}

}  // namespace encoder_test
