// SPDX-License-Identifier: GPL-3.0-or-later
//
// Correct entries in other clothes: none may be refused.
#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/generator/checking/checked.hpp"

using namespace catena;
using namespace catena::checking;
using namespace catena::tests;

TEST_CASE("rearranged correct entries are proved equal") {
  const std::vector<std::string> rows = {
      // sums of angles written out, halves and doubles of angles
      "M[1,2] = l_1*l_2*(m_2/2 + m_3 + m_c)*(cos(theta_1)*cos(theta_2) + "
      "sin(theta_1)*sin(theta_2))",
      "M[1,3] = l_3*l_1*cos(theta_3 - theta_1)*(2*m_c + m_3)/2",
      "M[2,3] = (m_3/2 + m_c)*l_2*l_3*(1 - 2*sin((theta_2 - theta_3)/2)^2)",
      "M[2,3] = (m_3/2 + m_c)*l_2*l_3*(2*cos(1/2*theta_2 - 1/2*theta_3)^2 - 1)",
      "M[3,3] = I_3 + l_3^2*(m_3 + 4*m_c)/4",
      "M[1,1] = I_1 + m_1*(l_1/2)^2 + (m_2 + m_3 + m_c)*l_1^2*(sin(theta_1)^2 + cos(theta_1)^2)",
      "M[1,1] = (I_1*(m_2 - m_3) + l_1^2*(m_1/4 + m_2 + m_3 + m_c)*(m_2 - m_3))/(m_2 - m_3)",
      "M[2,2] = l_2^2*(m_2/4 + sum(k = 3..n, m_k) + m_c)/1 + I_2",
      "G[1] = g*l_1*sin(theta_1)*(m_1 + 2*m_2 + 2*m_3 + 2*m_c)/2",
      "G[2] = 2*(m_2/2 + m_3 + m_c)*g*l_2*sin(theta_2/2)*cos(theta_2/2)",
      "G[3] = (m_3/2 + m_c)*g*l_3*tan(theta_3)*cos(theta_3)",
      "G[3] = (m_3/2 + m_c)*g*l_3*cos(pi/2 - theta_3)",
      "G[3] = sqrt(l_3^2)*(m_3/2 + m_c)*g*sin(theta_3)",
      "F[1] = -l_1*l_2*(m_2/2 + m_3 + m_c)*sin(theta_2 - theta_1)*thetadot_2^2 "
      "- l_1*l_3*(m_3/2 + m_c)*sin(theta_3 - theta_1)*thetadot_3^2",
      "F[3] = -l_3*(m_3/2 + m_c)*(l_1*thetadot_1^2*sin(theta_1 - theta_3) + "
      "l_2*thetadot_2^2*sin(theta_2 - theta_3))",
      "F[2] = diff(M23, theta_2)*0 + l_2*(l_3*(m_3/2 + m_c)*sin(theta_2 - theta_3)*thetadot_3^2 "
      "- l_1*(m_2/2 + m_3 + m_c)*sin(theta_1 - theta_2)*thetadot_1^2)",
      "K[1,1] = ((k_1 + k_2)^2 - 0)/(k_1 + k_2)",
      "K[2,3] = (k_2^2 - k_3^2)/(k_2 + k_3) - k_2",
      "V = k_1/2*theta_1^2 + k_2/2*(theta_1^2 - 2*theta_1*theta_2 + theta_2^2) + "
      "k_3/2*(theta_2 - theta_3)^2 + 2*g*l_1*(m_1/2 + m_2 + m_3 + m_c)*sin(theta_1/2)^2 - "
      "g*l_2*(m_2/2 + m_3 + m_c)*cos(theta_2) - g*l_3*(m_3/2 + m_c)*cos(theta_3)",
      "D = c_1*thetadot_1^2/2 + c_2*(thetadot_1 - thetadot_2)^2/2 + "
      "c_3*(thetadot_3 - thetadot_2)^2/2",
  };
  for (const std::string& row : rows) {
    INFO(row);
    const Checked result = checked("links 3\nM23 = 0*theta_1\n" + row);
    CHECK(result.count(Verdict::kEqual) == 1);
    CHECK(result.findings.size() == 1);
  }
}

TEST_CASE("a Lagrangian may differ by what no equation of motion sees") {
  const std::string lagrangian = example("chapter_3_two_links.txt");
  const std::string first = lagrangian.substr(0, lagrangian.find("\n# Euler"));
  for (const std::string extra :
       {"+ m_1*g*l_1", "+ ddt(sin(theta_1)*theta_2)*I_1", "- thetadot_1*theta_1*k_1"}) {
    INFO(extra);
    const Checked result = checked(first + "\nL = L " + extra);
    CHECK(result.of("L").verdict == Verdict::kEqual);
    CHECK(result.of("L").remark.find("no equation of motion sees") != std::string::npos);
  }
  CHECK(checked(first + "\nL = L + thetadot_1*theta_2*k_1").of("L").verdict == Verdict::kDifferent);
}

TEST_CASE("an equation of motion may be multiplied by what is not zero") {
  const std::string text = example("chapter_3_two_links.txt") +
                           "equation 2: FACTOR*(ddt(diff(L, thetadot_2)) - diff(L, theta_2)) = "
                           "FACTOR*(T_2 - c_2*(thetadot_2 - thetadot_1))\n";
  const auto with = [&](const std::string& factor) {
    std::string result = text;
    for (std::size_t at; (at = result.find("FACTOR")) != std::string::npos;)
      result.replace(at, 6, factor);
    return checked(result).findings.back();
  };
  for (const auto& row : {std::pair<std::string, std::string>{"(-1)", "-1"},
                          {"2", "2"},
                          {"1/l_2", "1/l_2"},
                          {"(m_1 + m_2)", "(m_1 + m_2)"},
                          {"1/(l_1^2*m_c + I_1)", "1/(l_1^2*m_c + I_1)"},
                          {"theta_1", "theta_1"},
                          {"cos(theta_2)", "cos(theta_2)"}}) {
    INFO(row.first);
    const Finding finding = with(row.first);
    CHECK(finding.verdict == Verdict::kEqual);
    CHECK(finding.remark == "multiplied by " + row.second);
  }
  const Finding nothing = with("0");
  CHECK(nothing.verdict == Verdict::kDifferent);
  CHECK(nothing.remark == "it states nothing: both sides are the same for every motion");
}

TEST_CASE("combinations of the equations of motion are named") {
  struct Row {
    std::string equation, remark;
  };
  const std::vector<Row> rows = {
      {"equation 1: E[1] + E[2] = 0", "the sum equation 1 + equation 2"},
      {"equation 2: E[1] - 2*E[3] = 0", "the sum equation 1 - 2*(equation 3)"},
      {"equation 1: l_2*E[1] = (m_c + m_1)*E[2]",
       "the sum l_2*(equation 1) - (m_1 + m_c)*(equation 2)"},
      {"equation 3: cos(theta_2)*E[1] + sin(theta_1)*E[2] + E[3] = 0",
       "the sum cos(theta_2)*(equation 1) + sin(theta_1)*(equation 2) + equation 3"},
      {"equation 1: E[2] = 0", "it is equation 2"},
      {"equation 3: E[3]/thetadot_1 = 0", "multiplied by 1/thetadot_1"},
  };
  for (const Row& row : rows) {
    INFO(row.equation);
    const Checked result = checked(left_sides(example("chapter_3_three_links.txt")) + row.equation);
    const Finding& finding = result.findings.back();
    CHECK(finding.verdict == Verdict::kEqual);
    CHECK(finding.remark == row.remark);
  }
}

TEST_CASE("equations solved for accelerations are proved, and what is wrong in them found") {
  const std::string solved = left_sides(example("chapter_3_two_links.txt")) +
                             "for i = 1..2\n"
                             "  R[i] = -at(at(E[i], thetaddot_1, 0), thetaddot_2, 0)\n"
                             "end\n"
                             "M11 = (m_1/4 + m_2 + m_c)*l_1^2 + I_1\n"
                             "M12 = l_1*l_2*(m_2/2 + m_c)*cos(theta_1 - theta_2)\n"
                             "M22 = (m_2/4 + m_c)*l_2^2 + I_2\n";
  const Checked right =
      checked(solved +
              "thetaddot_1 = (M22*R[1] - M12*R[2])/(M11*M22 - M12^2)\n"
              "equation 2: (M11*R[2] - M12*R[1])/(M11*M22 - M12^2) = thetaddot_2\n");
  CHECK(right.of("thetaddot[1]").verdict == Verdict::kEqual);
  CHECK(right.of("thetaddot[1]").remark == "solved for thetaddot_1");
  CHECK(right.of("equation 2").verdict == Verdict::kEqual);
  CHECK(independent_equations(right.findings, 2) == 2);

  const Checked wrong = checked(solved +
                                "R[2] = R[2] + 2*(m_2/2 + m_c)*g*l_2*sin(theta_2)\n"
                                "thetaddot_1 = (M22*R[1] - M12*R[2])/(M11*M22 - M12^2)\n"
                                "thetaddot_2 = (M11*R[2] - M12*R[1])/(M11*M22 + M12^2)\n");
  const Finding& gravity = wrong.of("thetaddot[1]");
  CHECK(gravity.verdict == Verdict::kDifferent);
  CHECK(gravity.origins == std::vector<std::string>{"gravity"});
  CHECK(gravity.value != gravity.expected);
  CHECK(wrong.of("thetaddot[2]").verdict == Verdict::kDifferent);
}

TEST_CASE("without torques an equation solved for an acceleration is proved by the mass matrix") {
  const Checked result = checked(
      "links 2\ngiven T_i = 0 for i = 1..2\ngiven k_i = 0 for i = 1..2\n"
      "given c_i = 0 for i = 1..2\n"
      "M11 = (m_1/4 + m_2 + m_c)*l_1^2 + I_1; M12 = l_1*l_2*(m_2/2 + m_c)*cos(theta_1 - theta_2)\n"
      "M22 = (m_2/4 + m_c)*l_2^2 + I_2\n"
      "F12 = l_1*l_2*(m_2/2 + m_c)*sin(theta_1 - theta_2)\n"
      "R1 = -F12*thetadot_2^2 - (m_1/2 + m_2 + m_c)*g*l_1*sin(theta_1)\n"
      "R2 = F12*thetadot_1^2 - (m_2/2 + m_c)*g*l_2*sin(theta_2)\n"
      "thetaddot_2 = (M11*R2 - M12*R1)/(M11*M22 - M12^2)");
  CHECK(result.of("thetaddot[2]").verdict == Verdict::kEqual);
}

TEST_CASE("rearranged solved equations of four links are not refused") {
  const std::string accelerations = example("accelerations_by_elimination.txt");
  const auto with = [&](const std::string& before, const std::string& after) {
    std::string text = accelerations;
    const std::size_t at = text.find(before);
    REQUIRE(at != std::string::npos);
    return checked(text.replace(at, before.size(), after));
  };
  const std::string cosine = "cos(theta_i - theta_j)", sine = "sin(theta_i - theta_j)*thetadot_j^2";
  for (const auto& row : std::vector<std::pair<std::string, std::string>>{
           {cosine, "(1 - 2*sin((theta_i - theta_j)/2)^2)"},
           {cosine, "(cos(theta_i)*cos(theta_j) + sin(theta_i)*sin(theta_j))"},
           {sine, "cos(theta_i - theta_j)*tan(theta_i - theta_j)*thetadot_j*thetadot_j"},
           {"links 4",
            "links 4\ngiven I_i = m_i*l_i^2/12 for i = 1..n\ngiven T_i = 0 for i = 1..n"},
           // each acceleration by those after it, which stay symbols
           {"A[i,j]*a[j]", "A[i,j]*thetaddot[j]"},
           {"thetaddot[i] = a[i]", "equation i: (a[i] - thetaddot[i])*A[i,i]*exp(theta_1) = 0"}}) {
    INFO(row.second);
    const Checked result = with(row.first, row.second);
    CHECK(result.count(Verdict::kEqual) == 4);
    CHECK(independent_equations(result.findings, 4) == 4);
  }
  // logarithms are beyond what is decided; numbers are no proof
  const Checked beyond = with("= a[i]", "= a[i] + log(l_1^2 + 1) - 2*log(sqrt(l_1^2 + 1))");
  CHECK(beyond.count(Verdict::kUndecided) == 4);
}

TEST_CASE("an equation too long to be expanded that says nothing is told") {
  const Checked result = checked(example("accelerations_by_elimination.txt") +
                                 "equation 1: a[1]*(1 - sin(theta_1)^2 - cos(theta_1)^2) = 0\n");
  CHECK(result.count(Verdict::kEqual) == 4);
  CHECK(result.findings.back().verdict == Verdict::kDifferent);
  CHECK(result.findings.back().remark ==
        "it states nothing: both sides are the same for every motion");
}

TEST_CASE("true equations that do not determine the motion are told") {
  const Checked result = checked(left_sides(example("chapter_3_two_links.txt")) +
                                 "equation 1: E[1] + E[2] = 0\nequation 2: -2*E[2] = 2*E[1]\n");
  CHECK(result.count(Verdict::kEqual) == 3);  // the Lagrangian too
  CHECK(independent_equations(result.findings, 2) == 1);
}

TEST_CASE("what is given may stand in what else is given, in any order") {
  const std::string uniform = "given I_i = m_i*l_i^2/12 for i = 1..n\n";
  const std::string equal_links = "given l_i = l_1 for i = 2..n\ngiven m_i = m_1 for i = 2..n\n";
  for (const std::string& given : {uniform + equal_links, equal_links + uniform}) {
    const Checked result = checked("links 3\n" + given + "M[3,3] = (m_1/3 + m_c)*l_1^2");
    CHECK(result.of("M[3,3]").verdict == Verdict::kEqual);
  }
}
