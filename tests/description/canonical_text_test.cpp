// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include "common/sha256.hpp"
#include "description/description.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace catena;
using testing::replaced;

namespace canonical_text_test {
namespace {

const std::string kEffect =
    "format = 1\nkind = \"effect\"\nid = \"push\"\ntitle = \"Push\"\ndescription = \"A push\"\n"
    "[parameters.f]\nunit = \"N\"\ndescription = \"f\"\nneutral = 0.0\nupper = 1.0\n"
    "[constants.w]\nvalue = 1e-3\nunit = \"1/s\"\n"
    "[[force]]\nat = \"load\"\nside = \"f*cos(w*time)\"\ndown = \"f\"\n";

std::string canonical(const std::string& effect_text, const std::string& name = "push.toml") {
  const testing::TemporaryFolder folder;
  Description description = plain_chain();
  description.effects.push_back(read_effect(folder.write(name, effect_text)));
  return canonical_text(description);
}

}  // namespace

TEST_CASE("changes that leave the equations alone leave the canonical text alone") {
  const std::string text = canonical(kEffect);
  CHECK(canonical(kEffect, "other.toml") == text);
  CHECK(canonical("# a comment\n\n" + kEffect) == text);
  CHECK(canonical(replaced(kEffect, "f*cos(w*time)", " f * cos( w*time ) ")) == text);
  CHECK(canonical(replaced(kEffect, "A push", "Another text")) == text);
  CHECK(canonical(replaced(kEffect, "1e-3", "0.001")) == text);
  CHECK(canonical(replaced(kEffect, "neutral = 0.0\nupper = 1.0\n",
                           "upper = 1.0\nneutral = 0\n")) == text);
  CHECK(canonical(replaced(kEffect, "side = \"f*cos(w*time)\"\ndown = \"f\"\n",
                           "down = \"f\"\nside = \"f*cos(w*time)\"\n")) == text);
}

TEST_CASE("changes of the equations change the canonical text") {
  const std::string text = canonical(kEffect);
  struct Change {
    const char *from, *to;
  };
  const Change changes[] = {
      {"cos(", "sin("},
      {"1e-3", "1e-4"},
      {"upper = 1.0", "upper = 2.0"},
      {"neutral = 0.0", "neutral = 0.5"},
      {"at = \"load\"", "at = \"joint\""},
      {"down = \"f\"\n", ""},
      {"\"push\"", "\"pull\""},
      {"unit = \"N\"", "unit = \"kg\""},
  };
  for (const Change& change : changes) {
    CAPTURE(change.from);
    CHECK(canonical(replaced(kEffect, change.from, change.to)) != text);
  }
  Description both = plain_chain(), other = plain_chain();
  both.effects = {built_in_effect("buoyancy"), built_in_effect("load_drag")};
  other.effects = {built_in_effect("load_drag"), built_in_effect("buoyancy")};
  CHECK(canonical_text(both) != canonical_text(other));  // their order is that of the parameters
  other = both;
  other.id = "another", other.links = {7}, other.source_file = "elsewhere";
  CHECK(canonical_text(both) == canonical_text(other));
}

TEST_CASE("SHA-256 of the standard's examples and across the padding") {
  CHECK(sha256_hex("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(sha256_hex("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(sha256_hex("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
        "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  CHECK(sha256_hex(std::string(1000000, 'a')) ==
        "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  CHECK(sha256_hex(std::string(55, 'x')) != sha256_hex(std::string(56, 'x')));
}

}  // namespace canonical_text_test
