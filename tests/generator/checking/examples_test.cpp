// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every derivation shipped as an example, with the verdicts it must get.
#include <doctest/doctest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "tests/generator/checking/checked.hpp"
#include "tests/support/data.hpp"

using namespace catena;
using namespace catena::checking;
using namespace catena::tests;

namespace {

struct Row {
  std::string file;
  int equal;
  int different;
  int undecided;
  std::vector<std::string> effects = {};
};

const std::vector<Row>& rows() {
  static const std::vector<Row> table = {{"chapter_3_two_links.txt", 19, 0, 0},
                                         {"chapter_3_three_links.txt", 37, 0, 0},
                                         {"chapter_3_four_links.txt", 61, 0, 0},
                                         {"mass_matrix_4_3.txt", 36, 0, 0},
                                         {"mass_matrix_4_3_point_masses.txt", 10, 0, 0},
                                         {"stiffness_4_11_as_printed.txt", 10, 6, 0},
                                         {"stiffness_4_11_swapped.txt", 10, 6, 0},
                                         {"stiffness_4_11_mended.txt", 32, 0, 0},
                                         {"coriolis_4_12.txt", 5, 0, 0},
                                         {"gravity_4_23.txt", 5, 0, 0},
                                         {"accelerations_by_cofactors.txt", 4, 0, 0},
                                         {"accelerations_by_elimination.txt", 4, 0, 0},
                                         {"air_drag.txt", 7, 0, 0, {"air_drag_linear"}},
                                         {"elevation_azimuth_4_1.txt", 128, 0, 0},
                                         {"lagrangian_2_9.txt", 0, 1, 0},
                                         {"lagrangian_2_9_mended.txt", 7, 0, 0},
                                         {"catenary_2_32_2_33.txt", 1, 1, 0},
                                         {"catenary_2_43.txt", 1, 0, 0},
                                         {"catenary_2_50_2_53.txt", 6, 5, 0},
                                         {"undecided_gudermann.txt", 0, 0, 1}};
  return table;
}

}  // namespace

TEST_CASE("the shipped examples get their verdicts") {
  for (const Row& row : rows()) {
    INFO(row.file);
    std::vector<Effect> effects;
    for (const std::string& id : row.effects) effects.push_back(built_in_effect(id));
    const Checked result = checked(example(row.file), std::nullopt, effects);
    CHECK(result.count(Verdict::kEqual) == row.equal);
    CHECK(result.count(Verdict::kDifferent) == row.different);
    CHECK(result.count(Verdict::kUndecided) == row.undecided);
    for (const Finding& finding : result.findings)
      CHECK(finding.by_evaluation == (row.file == "accelerations_by_elimination.txt"));
  }
}

TEST_CASE("every example file is in the table") {
  std::set<std::string> known;
  for (const Row& row : rows()) known.insert(row.file);
  for (const auto& entry :
       std::filesystem::directory_iterator(source_folder() / "examples" / "derivations")) {
    INFO(entry.path().string());
    CHECK(known.count(entry.path().filename().string()) == 1);
  }
}

TEST_CASE("the general forms hold for other numbers of links") {
  for (const std::string file : {"mass_matrix_4_3.txt", "coriolis_4_12.txt", "gravity_4_23.txt",
                                 "stiffness_4_11_mended.txt", "lagrangian_2_9_mended.txt"}) {
    for (const int links : {1, 2, 7, 12}) {
      INFO(file << ", " << links << " links");
      const Checked result = checked(example(file), links);
      CHECK(result.count(Verdict::kEqual) == static_cast<int>(result.findings.size()));
    }
  }
}

TEST_CASE("accelerations by elimination are proved or evaluated") {
  for (const int links : {2, 3, 4, 6, 12}) {
    INFO(links << " links");
    const Checked result = checked(example("accelerations_by_elimination.txt"), links);
    CHECK(result.count(Verdict::kEqual) == links);
    for (const Finding& finding : result.findings) CHECK(finding.by_evaluation == (links > 2));
    CHECK(independent_equations(result.findings, links) == links);
  }
}

TEST_CASE("single entries of a chain of 60 links are decided") {
  const Checked result = checked(R"(links 60
mu[i] = m_i/2 + m_c + sum(k = i+1..n, m_k) for i = 1..n
M[7,41] = l_7*l_41*mu[41]*cos(theta_7 - theta_41)
M[30,30] = l_30^2*(mu[30] - m_30/4) + I_30
F[30] = l_30*sum(j = 1..n if j != 30, l_j*mu[max(30,j)]*sin(theta_30 - theta_j)*thetadot_j^2)
G[1] = l_1*mu[1]*g*sin(theta_1)
G[2] = l_2*mu[1]*g*sin(theta_2)
K[59,60] = -k_60)");
  CHECK(result.count(Verdict::kEqual) == 5);
  CHECK(result.of("G[2]").verdict == Verdict::kDifferent);
  CHECK(result.of("G[2]").difference == "g*l_2*(m_1 + m_2)*sin(theta_2)/2");
}

TEST_CASE("(2.9) lacks the load's potential, and that is said") {
  const Finding found = checked(example("lagrangian_2_9.txt")).of("L");
  CHECK(found.origins == std::vector<std::string>{"gravity of the load: missing"});
  CHECK(found.difference ==
        "g*m_c*(l_1 + l_2 + l_3) - g*l_1*m_c*cos(theta_1) - g*l_2*m_c*cos(theta_2) - "
        "g*l_3*m_c*cos(theta_3)");
  CHECK(found.value != found.expected);
}

TEST_CASE("(4.11) as printed loses the springs off the diagonal") {
  const Checked result = checked(example("stiffness_4_11_as_printed.txt"));
  for (const std::string joint : {"2", "3", "4"}) {
    const std::string before = std::to_string(std::stoi(joint) - 1);
    for (const std::string& label :
         {"K[" + before + "," + joint + "]", "K[" + joint + "," + before + "]"}) {
      INFO(label);
      const Finding& found = result.of(label);
      CHECK(found.verdict == Verdict::kDifferent);
      CHECK(found.difference == "k_" + joint);
      CHECK(found.origins == std::vector<std::string>{"spring of joint " + joint + ": missing"});
    }
  }
  CHECK(result.derivation.notes.size() == 1);
}

TEST_CASE("(2.50) and (2.52) have a minus where cosh needs a plus") {
  const Checked result = checked(example("catenary_2_50_2_53.txt"));
  CHECK(result.of("(2.50) solves (2.48)").difference == "exp(-x/k)");
  CHECK(result.of("(2.52) solves (2.48)").difference == "exp(-x/k)");
  CHECK(result.of("(2.52) is (2.53)").difference == "-k*exp(-x/k)");
  CHECK(result.of("(2.52) starts at 0").difference == "-k");
  CHECK(result.of("(2.53) solves (2.37)").verdict == Verdict::kEqual);
}

TEST_CASE("(2.32)-(2.33): k cannot be both rho/H and H/rho") {
  const Checked result = checked(example("catenary_2_32_2_33.txt"));
  CHECK(result.of("(2.33), k = rho/H").difference == "S*rho/H - H*S/rho");
  CHECK(result.of("(2.33), k = H/rho").verdict == Verdict::kEqual);
}
