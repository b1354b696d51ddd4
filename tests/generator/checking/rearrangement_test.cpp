// SPDX-License-Identifier: GPL-3.0-or-later
//
// Correct entries in other clothes: none may be refused.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tests/generator/checking/text.hpp"

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

TEST_CASE("an equation of motion may be multiplied by a constant, and by nothing else") {
  const std::string text = example("chapter_3_two_links.txt") +
                           "equation 2: FACTOR*(ddt(diff(L, thetadot_2)) - diff(L, theta_2)) = "
                           "FACTOR*(T_2 - c_2*(thetadot_2 - thetadot_1))\n";
  const auto with = [&](const std::string& factor) {
    std::string result = text;
    for (std::size_t at; (at = result.find("FACTOR")) != std::string::npos;)
      result.replace(at, 6, factor);
    return checked(result).findings.back().verdict;
  };
  for (const std::string factor : {"(-1)", "2", "1/l_2", "(m_1 + m_2)", "1/(l_1^2*m_c + I_1)"}) {
    INFO(factor);
    CHECK(with(factor) == Verdict::kEqual);
  }
  for (const std::string factor : {"theta_1", "cos(theta_2)", "0"}) {
    INFO(factor);
    CHECK(with(factor) == Verdict::kDifferent);
  }
}
