// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/sealed_part.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>

#include "identify/diagnosis/diagnose.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/near.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;

namespace sealed_part_test {
namespace {

constexpr int kFrames = 200;
constexpr int kSealed = 20;  // a third of the last 30 %
constexpr double kShift = 5e-3;

/// A case of two links, one marker at the tip with 1 mm of noise, the last frames moved to the side.
Case the_case(const testing::TemporaryFolder& folder, double shift, const std::string& more = "") {
  Case truth = testing::sections(testing::kTwoLinks);
  testing::add_experiment(truth, "run");
  Recording recording = testing::with_truth(truth, Model::built_in(2),
                                            testing::empty_markers({1.0}, kFrames, 0.05), 1e-3);
  recording.measured.row(0).tail(kSealed).array() += shift;
  std::string text = "time_s,side_1_m,down_1_m\n";
  for (Eigen::Index k = 0; k < kFrames; ++k)
    text += fmt::format("{},{},{}\n", recording.time[static_cast<std::size_t>(k)],
                        recording.measured(0, k), recording.measured(1, k));
  folder.write("markers.csv", text);
  return read_case(
      folder.write("case.toml", std::string("format = 1\nkind = \"case\"\n") + testing::kTwoLinks +
                                    "[[experiment]]\nname = \"run\"\ndata = \"markers.csv\"\n"
                                    "kind = \"markers\"\n" +
                                    more));
}

Diagnosis diagnosed(double shift) {
  const testing::TemporaryFolder folder;
  const Case asked = the_case(folder, shift);
  DiagnosisContext context(asked, {}, folder.path(), fit_least_squares, {});
  return diagnose(asked, context, {.max_effects = 0, .max_links = 2});
}

double sealed_from(const std::string& more) {
  const testing::TemporaryFolder folder;
  Case asked = the_case(folder, 0, more);
  DiagnosisContext context(asked, {}, folder.path(), fit_least_squares, {});
  seal_last_part(asked, context);
  return asked.experiments[0].sealed_from;
}

}  // namespace

TEST_CASE("the last third of what is held out is sealed, where the rest is enough to choose by") {
  CHECK(sealed_from("fit_until = 6.95\n") == doctest::Approx(8.95));
  CHECK(sealed_from("use = \"validate\"\n") == doctest::Approx(0.05 * (kFrames - 66 - 1)));
  CHECK(std::isinf(sealed_from("fit_until = 8.25\n")));  // 34 frames: 23 would be left
  CHECK(sealed_from("fit_until = 8.2\n") == doctest::Approx(9.4));
  CHECK(std::isinf(sealed_from("")));  // nothing is held out
  CHECK(std::isinf(sealed_from("window = 2.5\nfit_until = 5.0\n")));
}

TEST_CASE("nothing in a diagnosis sees the sealed part, but the number that is printed") {
  const Diagnosis quiet = diagnosed(0), moved = diagnosed(kShift);
  CHECK(quiet.verdict == DiagnosisVerdict::kNone);
  CHECK(moved.sentence == quiet.sentence);
  CHECK(moved.notes == quiet.notes);
  CHECK(moved.final.x == quiet.final.x);
  CHECK(moved.final_held_out.count == 2 * (60 - kSealed));
  CHECK(moved.final_held_out.rms == quiet.final_held_out.rms);
  CHECK(moved.noise[0].level == quiet.noise[0].level);
  CHECK(sealed_rms(quiet.final) == catena::near(1e-3, 0.3));
  const double expected = std::sqrt((1e-6 + std::pow(kShift, 2) + 1e-6) / 2);
  CHECK(sealed_rms(moved.final) == catena::near(expected, 0.1));
}

TEST_CASE("what is shown and written has no seal") {
  const Diagnosis found = diagnosed(0);
  const Problem sealed = *found.final.problem, opened = with_opened_seals(sealed);
  CHECK(std::isnan(sealed.experiments()[0].recording.measured(0, kFrames - 1)));
  CHECK(opened.experiments()[0].recording.measured.allFinite());
  CHECK(opened.experiments()[0].recording.sealed.size() == 0);
  CHECK(std::isinf(opened.with(found.final.x).experiments[0].sealed_from));
}

}  // namespace sealed_part_test
