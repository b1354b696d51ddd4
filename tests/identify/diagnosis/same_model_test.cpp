// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/same_model.hpp"

#include <doctest/doctest.h>

#include "identify/diagnosis/context.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/data.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;

namespace {

using Names = std::map<std::string, std::string>;

Names names_of(int links, const std::string& cable) {
  const testing::TemporaryFolder folder;
  Case the_case = testing::sections("[model]\nlinks = " + std::to_string(links) + "\n[cable]\n" +
                                    cable + "[initial]\nshape = \"straight\"\nangle = 0.6\n");
  testing::add_experiment(the_case, "run");
  // Few effects, so that the model is made in a second.
  for (const std::string& id : built_in_effect_ids())
    if (!id.starts_with("air_drag") && id.find("dry_friction") == std::string::npos &&
        id != "load_drag" && id != "joint_damping_quadratic")
      the_case.diagnosis.impossible.push_back(id);
  ProviderOptions options;
  options.derive_program = tests::build_folder() / "bin" / "catena-derive";
  DiagnosisContext context(the_case, {}, folder.path(), fit_least_squares, options);
  return names_of_same_models(context.library(), context.model_with_all(links));
}

}  // namespace

TEST_CASE("on one link, effects that are the same model go by one name") {
  CHECK(names_of(1, "link_lengths = [1.0]\nlink_masses = [0.0]\nload_mass = 0.1\n") ==
        Names{{"joint_damping_quadratic", "load_drag"},
              {"joint_dry_friction", "pivot_dry_friction"}});
  CHECK(names_of(1, "link_lengths = [1.0]\nlink_masses = [0.1]\n") ==
        Names{{"air_drag_isotropic", "air_drag_quadratic"},
              {"joint_damping_quadratic", "air_drag_quadratic"},
              {"joint_dry_friction", "pivot_dry_friction"}});
}

TEST_CASE("with more links they are different models") {
  CHECK(names_of(2, "length = 1.0\ndensity = 0.2\nload_mass = 0.1\n").empty());
}
