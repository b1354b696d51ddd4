// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/candidate.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "common/input_error.hpp"
#include "tests/support/failure.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;

namespace {

Case case_of(DataKind kind) {
  Case the_case;
  ExperimentSpec experiment;
  experiment.kind = kind;
  the_case.experiments = {experiment};
  return the_case;
}

/// Why an effect is not tried; empty: it is.
std::string why_not(const std::string& id, const Case& the_case) {
  const auto library = library_of_candidates({}, plain_chain(), the_case);
  const auto found =
      std::find_if(library.begin(), library.end(), [&](const auto& c) { return c.id == id; });
  REQUIRE(found != library.end());
  return found->unavailable;
}

}  // namespace

TEST_CASE("what a camera reports is not looked for in the angles of an encoder, and the reverse") {
  const Case camera = case_of(DataKind::kMarkers), encoder = case_of(DataKind::kAngles);
  for (const char* id : {"camera_tilt", "camera_lens", "scale", "origin_offset", "marker_offset"}) {
    CHECK(why_not(id, camera) == "");
    CHECK(why_not(id, encoder) == "a camera would report it; the data are angles");
  }
  CHECK(why_not("encoder_error", encoder) == "");
  CHECK(why_not("encoder_error", camera) == "an encoder would report it; the data are markers");
  CHECK(why_not("clock_offset", camera) == "");
  CHECK(why_not("clock_offset", encoder) == "");
}

TEST_CASE("a rare effect is looked for where the case calls it possible") {
  Case the_case = case_of(DataKind::kMarkers);
  CHECK(why_not("steady_wind", the_case) ==
        "rare; tried where the case has it in diagnosis.possible");
  the_case.diagnosis.possible = {"steady_wind"};
  CHECK(why_not("steady_wind", the_case) == "");
}

TEST_CASE("what the case calls impossible is not looked for, and must be an effect") {
  Case the_case = case_of(DataKind::kMarkers);
  the_case.diagnosis.impossible = {"pivot_damping"};
  CHECK(why_not("pivot_damping", the_case) == "the case says that it is impossible");
  CHECK(why_not("pivot_stiffness", the_case) == "");
  the_case.diagnosis.impossible = {"pivot_dampign"};
  CHECK(failure([&] {
          library_of_candidates({}, plain_chain(), the_case);
        }).find("did you mean \"pivot_damping\"?") != std::string::npos);
}

TEST_CASE("what holds the far end is not looked for") {
  const testing::TemporaryFolder folder;
  const auto file =
      folder.write("holds.toml",
                   "format = 1\nkind = \"effect\"\nid = \"holds\"\ntitle = \"Holds\"\n"
                   "description = \"Holds the end\"\n[held_end]\nside = \"0.5\"\n");
  Description chain = plain_chain();
  chain.space = Space::kThreeDimensional;
  const auto library = library_of_candidates({file}, chain, case_of(DataKind::kMarkers));
  const auto holds =
      std::find_if(library.begin(), library.end(), [](const auto& c) { return c.id == "holds"; });
  REQUIRE(holds != library.end());
  CHECK(holds->unavailable ==
        "it holds the cable at all values of its parameters; have it in the model");
}

TEST_CASE("what acts as a function of time drives the chain; a clock does not act") {
  const auto driven = [](const char* id) { return candidate_of(built_in_effect(id)).driven; };
  CHECK(driven("support_motion"));
  for (const char* passive : {"load_drag", "joint_hysteresis", "gravity_tilt", "clock_offset"})
    CHECK_FALSE(driven(passive));
}

TEST_CASE("what acts on a body without mass is not looked for") {
  Case thread = case_of(DataKind::kMarkers);
  thread.cable.link_masses = {0.0};
  thread.cable.load_mass = 0.1;
  const std::string reason = "acts on a body to which the case gives no mass";
  CHECK(why_not("air_drag_quadratic", thread) == reason);
  CHECK(why_not("load_drag", thread) == "");
  CHECK(why_not("added_mass", thread) == "");  // it has a term of the load
  CHECK(why_not("pivot_dry_friction", thread) == "");
  Case rod = case_of(DataKind::kAngles);
  rod.cable.link_masses = {0.2};
  CHECK(why_not("air_drag_quadratic", rod) == "");
  CHECK(why_not("load_drag", rod) == reason);
  ParameterSpec load;  // unknown, so it may be there
  load.sets = "load_mass";
  rod.parameters = {load};
  CHECK(why_not("load_drag", rod) == "");
}
