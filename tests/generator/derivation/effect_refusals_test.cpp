// SPDX-License-Identifier: GPL-3.0-or-later
//
// What effect files cannot mean, found where they are derived: each is refused with its file, line and rule.
#include <doctest/doctest.h>

#include <string>

#include "generator/derivation/chain.hpp"
#include "tests/support/failure.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;

TEST_CASE("laws that only the plane has are refused in space with their line") {
  const testing::TemporaryFolder folder;
  const std::string head =
      "format = 1\nkind = \"effect\"\nid = \"own\"\ntitle = \"Own\"\ndescription = \"One\"\n"
      "[parameters.c]\nunit = \"UNIT\"\nneutral = 0.0\ndescription = \"c\"\n";
  struct Row {
    std::string unit, body, said;
  };
  const Row rows[] = {
      {"N", "[[dissipation]]\nat = \"link_centre\"\nvalue = \"c*velocity_normal\"\n",
       ":12: dissipation.value: in \"c*velocity_normal\": \"velocity_normal\" is the size of a "
       "vector"},
      {"N m/rad", "[[potential]]\nat = \"joint\"\nvalue = \"c*(joint_angle - 1)^2/2\"\n",
       ":12: potential.value: in \"c*(joint_angle - 1)^2/2\": \"joint_angle\" is the size of a "
       "vector"},
      {"N m s^2/rad^2", "[[dissipation]]\nat = \"joint\"\nvalue = \"c*sqrt(joint_rate^2)^3/3\"\n",
       ":12: dissipation.value: in \"c*sqrt(joint_rate^2)^3/3\": \"joint_rate\" is the size of a"},
      {"N", "[[force]]\nat = \"link_centre\"\nnormal = \"c\"\n",
       ":12: force.normal: in \"c\": in space a force normal to a link has the direction of"},
      {"N s^2/m^2", "[[force]]\nat = \"load\"\nnormal = \"-c*velocity_normal^2\"\n",
       ":12: force.normal: in \"-c*velocity_normal^2\": in space a force normal to a link"},
      {"N m s^2/rad^2", "[[torque]]\nat = \"joint\"\nvalue = \"-c*joint_rate^2\"\n",
       ":12: torque.value: in \"-c*joint_rate^2\": in space this is a vector along joint_rate"},
  };
  for (const Row& row : rows) {
    std::string text = head + row.body;
    text.replace(text.find("UNIT"), 4, row.unit);
    const auto path = folder.write("own.toml", text);
    Description description = plain_chain();
    description.space = Space::kThreeDimensional;
    description.effects.push_back(read_effect(path));
    const std::string said = failure([&] { Chain(description, 2); });
    CAPTURE(said);
    CHECK(said.find(path.string() + row.said) == 0);
    description.space = Space::kPlane;
    Chain(description, 2);
  }
}

TEST_CASE("what a load with coordinates of its own cannot mean is refused with its line") {
  const testing::TemporaryFolder folder;
  const std::string head =
      "format = 1\nkind = \"effect\"\nid = \"own\"\ntitle = \"Own\"\ndescription = \"One\"\n"
      "[parameters.c]\nunit = \"N\"\nneutral = 0.0\ndescription = \"c\"\n[[coordinate]]\nname = "
      "\"swing\"\nunit = \"rad\"\nper = \"load\"\n";
  struct Row {
    std::string body, said;
  };
  const Row rows[] = {
      {"[[force]]\nat = \"load\"\nalong = \"sqrt(velocity_side^2 + velocity_down^2)\"\nvalue = "
       "\"c*cos(swing)\"\n",
       ":16: force.along: in \"sqrt(velocity_side^2 + velocity_down^2)\": it is not linear in "
       "velocities"},
      {"[[force]]\nat = \"load\"\nalong = \"cos(swing)\"\nvalue = "
       "\"c*velocity_side\"\n",
       ":16: force.along: in \"cos(swing)\": it is not linear in velocities"},
      {"[[force]]\nat = \"load\"\nalong = \"swing_rate\"\nvalue = \"c\"\n",
       ":17: force.value: in \"c\": it is in N where N m is wanted"},
      {"[[force]]\nat = \"joint\"\nalong = \"velocity_side\"\nvalue = \"c*cos(swing)\"\n",
       ":17: force.value: in \"c*cos(swing)\": \"swing\" has no meaning here"},
      {"[kinematics]\nload_side = \"swing_rate*c\"\n[[kinetic]]\nat = \"load\"\nvalue = "
       "\"load_mass*velocity_side^2/2\"\n",
       ":15: kinematics.load_side: in \"swing_rate*c\": \"swing_rate\" has no meaning here"},
      {"[kinematics]\nload_mass = \"swing*c\"\n[[kinetic]]\nat = \"load\"\nvalue = "
       "\"load_mass*velocity_side^2/2\"\n",
       ":15: kinematics.load_mass: in \"swing*c\": \"swing\" has no meaning here"},
  };
  for (const Row& row : rows) {
    const auto path = folder.write("own.toml", head + row.body);
    for (const Space space : {Space::kPlane, Space::kThreeDimensional}) {
      Description description = plain_chain();
      description.space = space;
      description.effects.push_back(read_effect(path));
      const std::string said = failure([&] { Chain(description, 2); });
      CAPTURE(said);
      CHECK(said.find(path.string() + row.said) == 0);
    }
  }
}
