// SPDX-License-Identifier: BSD-3-Clause
#include "description/description.hpp"

#include <doctest/doctest.h>

#include "common/whole_file.hpp"
#include "tests/support/failure.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;

namespace {

const std::string kHead = "format = 1\nkind = \"model\"\nid = \"chain\"\n";
const std::string kEffect =
    "format = 1\nkind = \"effect\"\nid = \"push\"\ntitle = \"Push\"\ndescription = \"A push\"\n"
    "[parameters.f]\nunit = \"N\"\ndescription = \"f\"\nneutral = 0.0\n"
    "[[force]]\nat = \"load\"\nside = \"f\"\n";

}  // namespace

TEST_CASE("a description names built-in effects and files beside it") {
  const testing::TemporaryFolder folder;
  folder.write("push.toml", kEffect);
  const auto path = folder.write(
      "chain.toml", kHead + "links = [2, 12]\neffects = [\"load_drag\", \"push.toml\"]\n");
  const Description description = read_description(path);
  CHECK(description.id == "chain");
  CHECK(description.links == std::vector<int>{2, 12});
  REQUIRE(description.effects.size() == 2);
  CHECK(description.effects[0].id == "load_drag");
  CHECK(description.effects[1].id == "push");
}

TEST_CASE("a written description reads back to the same model, from another folder too") {
  const testing::TemporaryFolder folder;
  folder.write("push.toml", kEffect);
  const auto path =
      folder.write("chain.toml", kHead + "links = [3]\neffects = [\"buoyancy\", \"push.toml\"]\n");
  const Description description = read_description(path);
  std::filesystem::create_directory(folder.path() / "results");
  for (const char* name : {"again.toml", "results/again.toml"}) {
    CAPTURE(name);
    write_description(description, folder.path() / name);
    const Description again = read_description(folder.path() / name);
    CHECK(again.links == description.links);
    CHECK(canonical_text(again) == canonical_text(description));
  }
}

TEST_CASE("the plane is the default; space is another model, and is written") {
  const testing::TemporaryFolder folder;
  const Description plane = read_description(folder.write("plane.toml", kHead));
  CHECK(canonical_text(read_description(
            folder.write("said.toml", kHead + "space = \"plane\"\n"))) == canonical_text(plane));
  CHECK(is_plain_chain(plane));
  const Description space =
      read_description(folder.write("space.toml", kHead + "space = \"3d\"\n"));
  CHECK(space.space == Space::kThreeDimensional);
  CHECK(!is_plain_chain(space));
  CHECK(canonical_text(space) != canonical_text(plane));
  write_description(space, folder.path() / "again.toml");
  CHECK(canonical_text(read_description(folder.path() / "again.toml")) == canonical_text(space));
}

TEST_CASE("errors in a description name their line") {
  const testing::TemporaryFolder folder;
  folder.write("push.toml", kEffect);
  folder.write("holds.toml",
               "format = 1\nkind = \"effect\"\nid = \"holds\"\ntitle = \"Holds\"\n"
               "description = \"Holds the end\"\n[held_end]\nside = \"0.5\"\n");
  for (const char* id : {"middle", "other"})
    folder.write(std::string(id) + ".toml",
                 "format = 1\nkind = \"effect\"\nid = \"" + std::string(id) +
                     "\"\ntitle = \"Holds\"\n"
                     "description = \"Holds a joint\"\n[held_joint]\nlink = 6\nside = \"0.5\"\n");
  folder.write("lift.toml",
               "format = 1\nkind = \"effect\"\nid = \"lift\"\ntitle = \"Lift\"\n"
               "description = \"Moves the load\"\n[kinematics]\nload_across = \"0.5\"\n");
  folder.write("rub.toml",
               "format = 1\nkind = \"effect\"\nid = \"rub\"\ntitle = \"Rub\"\n"
               "description = \"Over the tension\"\n[[torque]]\nat = \"joint\"\n"
               "value = \"-steady_tension*joint_rate\"\n");
  struct Row {
    std::string body, said;
  };
  const Row rows[] = {
      {"links = [0]\n", ":4: links: 0 is not a link count; give whole numbers from 1"},
      {"links = [2.5]\n", ":4: links: 2.5 in the list is not a whole number"},
      {"links = 12\n", ":4: links: 12 is a whole number where a list of whole numbers is wanted"},
      {"effects = [\"loaddrag\"]\n",
       ":4: effects: \"loaddrag\" is not a built-in effect; did you mean \"load_drag\"?"},
      {"effects = [\"pull.toml\"]\n", ":4: effects: there is no file"},
      {"effects = [\"load_drag\", \"load_drag\"]\n",
       ":4: effects: \"load_drag\" stands there twice; name each effect once"},
      {"space = \"2d\"\n", ":4: space: \"2d\""},
      {"space = \"3d\"\neffects = [\"camera_tilt\"]\n",
       ":5: effects: \"camera_tilt\" acts in the plane only: built in: camera_tilt:21: "
       "sensor.side: it says "
       "nothing of what is across; in space a sensor gives `across`, too"},
      {"space = \"3d\"\neffects = [\"encoder_error\"]\n",
       ":5: effects: \"encoder_error\" acts in the plane only: built in: encoder_error:47: "
       "sensor.angle: links "
       "have no angle"},
      {"space = \"3d\"\neffects = [\"axial_stretch\"]\n",
       ":5: effects: \"axial_stretch\" acts in the plane only: built in: axial_stretch:34: "
       "kinematics.extension: links in space do not stretch yet. Space is \"3d\"; leave one of "
       "them "
       "away"},
      {"effects = [\"load_body\"]\n",
       ":4: effects: \"load_body\" needs space = \"3d\", as its file says, and space is \"plane\""},
      {"space = \"3d\"\neffects = [\"swinging_load\"]\n",
       ":5: effects: \"swinging_load\" needs space = \"plane\", as its file says, and space is "
       "\"3d\""},
      {"space = \"3d\"\neffects = [\"load_body\", \"holds.toml\"]\n",
       ":5: effects: \"holds\": a cable that is held besides at its support has no load with "
       "coordinates of its own"},
      {"space = \"3d\"\neffects = [\"middle.toml\", \"holds.toml\", \"other.toml\"]\n",
       ":5: effects: \"other\" is the second effect that holds the far end of link 6, beside "
       "\"middle\"; leave one away"},
      {"effects = [\"middle.toml\"]\n",
       ":4: effects: \"middle\" holds a point of the cable, which needs space = \"3d\""},
      {"effects = [\"lift.toml\"]\n",
       ":4: effects: \"lift\" moves the load across the plane, which needs space = \"3d\""},
      {"space = \"3d\"\neffects = [\"rub.toml\", \"holds.toml\"]\n",
       ":5: effects: \"rub\" uses steady_tension, which is what hangs below a joint; beside "
       "\"holds\", "
       "which holds the cable, too, it has no meaning. Leave one away"},
      {"efects = []\n", ":4: unknown key \"efects\"; did you mean \"effects\"?"},
  };
  for (const Row& row : rows) {
    const auto path = folder.write("chain.toml", kHead + row.body);
    const std::string said = failure([&] { read_description(path); });
    CAPTURE(said);
    CHECK(said.find(path.string() + row.said) == 0);
  }
  const auto path = folder.write("bad.toml", "format = 1\nkind = \"model\"\nid = \"a chain\"\n");
  CHECK(failure([&] { read_description(path); }).find("\"a chain\" is not a name") !=
        std::string::npos);
}

TEST_CASE("an effect beside a held end has no id of what holds it") {
  const testing::TemporaryFolder folder;
  folder.write("holds.toml",
               "format = 1\nkind = \"effect\"\nid = \"holds\"\ntitle = \"Holds\"\n"
               "description = \"Holds the end\"\n[held_end]\nside = \"0.5\"\n");
  for (const char* id : {"hold", "end", "gap", "push"}) {
    CAPTURE(id);
    std::string text = kEffect;
    text.replace(text.find("\"push\""), 6, "\"" + std::string(id) + "\"");
    folder.write("push.toml", text);
    const auto path = folder.write(
        "chain.toml", kHead + "space = \"3d\"\neffects = [\"push.toml\", \"holds.toml\"]\n");
    if (id == std::string("push")) {
      CHECK(read_description(path).holding().size() == 1);
      continue;
    }
    const std::string said = failure([&] { read_description(path); });
    CAPTURE(said);
    CHECK(said.find(path.string() + ":5: effects: \"" + id +
                    "\" is a name of what holds the cable; give the effect another id") == 0);
    // where nothing holds the end the names are free
    CHECK(read_description(
              folder.write("free.toml", kHead + "space = \"3d\"\neffects = [\"push.toml\"]\n"))
              .effects.size() == 1);
  }
}

TEST_CASE("a file is written whole or not at all") {
  const testing::TemporaryFolder folder;
  const auto missing = folder.path() / "none" / "chain.toml";
  CHECK(failure([&] { write_whole_file(missing, "text"); }).find("cannot be written") !=
        std::string::npos);
  write_whole_file(folder.path() / "a.txt", "text");
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    CHECK(entry.path().filename() == "a.txt");
    ++files;
  }
  CHECK(files == 1);
}
