// SPDX-License-Identifier: GPL-3.0-or-later
//
// The LaTeX is compared with the equations printed in chapter 3, typed in by hand. Chapter 3 calls
// the mass matrix I; catena calls it M everywhere (docs/model.md).
#include <doctest/doctest.h>

#include <string>

#include "generator/emission/latex_document.hpp"
#include "generator/emission/latex_monomials.hpp"

using namespace catena;

namespace latex_test {
namespace {

// Without spaces, line breaks, alignment and needless braces: "\theta_{1}" is "\theta_1".
std::string plain(const std::string& latex) {
  std::string text;
  for (std::size_t i = 0; i < latex.size(); ++i) {
    const bool index = latex[i] == '{' && i + 2 < latex.size() && latex[i + 2] == '}';
    if (index) {
      text += latex[i + 1];
      i += 2;
    } else if (latex.compare(i, 2, "\\\\") == 0) {
      ++i;
    } else if (latex[i] != ' ' && latex[i] != '\n' && latex[i] != '&') {
      text += latex[i];
    }
  }
  for (const char* word : {"\\left", "\\right", "{}"}) {
    for (auto at = text.find(word); at != std::string::npos; at = text.find(word)) {
      text.erase(at, std::string(word).size());
    }
  }
  return text;
}

struct Row {
  int links;
  const char* equation;
};

const Row kChapter3[] = {
    // (3.1)
    {2, R"(L = \frac{1}{2} I_{R_1} \dot{\theta}_1^2 + \frac{1}{2} I_{R_2} \dot{\theta}_2^2
        + \frac{1}{2} (\frac{m_1}{4} + m_2 + m_c) l_1^2 \dot{\theta}_1^2
        + \frac{1}{2} (\frac{m_2}{4} + m_c) l_2^2 \dot{\theta}_2^2
        + (\frac{m_2}{2} + m_c) l_1 l_2 \cos(\theta_1 - \theta_2) \dot{\theta}_1 \dot{\theta}_2
        - \frac{1}{2} k_1 \theta_1^2 - \frac{1}{2} k_2 (\theta_2 - \theta_1)^2
        - (\frac{m_1}{2} + m_2 + m_c) g l_1 (1 - \cos \theta_1)
        - (\frac{m_2}{2} + m_c) g l_2 (1 - \cos \theta_2))"},
    // (3.2), (3.3)
    {2, R"(= T_{\theta_1} - c_1 \dot{\theta}_1 - c_2 (\dot{\theta}_1 - \dot{\theta}_2)
        = T_{\theta_1} - (c_1 + c_2) \dot{\theta}_1 + c_2 \dot{\theta}_2)"},
    {2, R"(= T_{\theta_2} - c_2 (\dot{\theta}_2 - \dot{\theta}_1)
        = T_{\theta_2} + c_2 \dot{\theta}_1 - c_2 \dot{\theta}_2)"},
    // after (3.5)
    {2, R"(M_{11} = (\frac{m_1}{4} + m_2 + m_c) l_1^2 + I_{R_1})"},
    {2, R"(M_{12} = l_1 l_2 (\frac{m_2}{2} + m_c) \cos(\theta_1 - \theta_2))"},
    {2, R"(C = \begin{bmatrix} c_1 + c_2 & -c_2 \\ -c_2 & c_2 \end{bmatrix})"},
    {2, R"(K = \begin{bmatrix} k_1 + k_2 & -k_2 \\ -k_2 & k_2 \end{bmatrix})"},
    {2, R"(f_1 = l_1 l_2 (\frac{m_2}{2} + m_c) \sin(\theta_1 - \theta_2) \dot{\theta}_2^2)"},
    {2, R"(f_2 = -l_1 l_2 (\frac{m_2}{2} + m_c) \sin(\theta_1 - \theta_2) \dot{\theta}_1^2)"},
    {2, R"(g_1 = (\frac{m_1}{2} + m_2 + m_c) g l_1 \sin \theta_1)"},
    // (3.8)
    {3,
     R"(= T_{\theta_2} - c_2 (\dot{\theta}_2 - \dot{\theta}_1) - c_3 (\dot{\theta}_2 - \dot{\theta}_3)
        = T_{\theta_2} + c_2 \dot{\theta}_1 - (c_2 + c_3) \dot{\theta}_2 + c_3 \dot{\theta}_3)"},
    {3, R"(f_2 = -l_1 l_2 (\frac{m_2}{2} + m_3 + m_c) \sin(\theta_1 - \theta_2) \dot{\theta}_1^2
        + l_2 l_3 (\frac{m_3}{2} + m_c) \sin(\theta_2 - \theta_3) \dot{\theta}_3^2)"},
    {3, R"(K = \begin{bmatrix} k_1 + k_2 & -k_2 & 0 \\ -k_2 & k_2 + k_3 & -k_3 \\ 0 & -k_3 & k_3
        \end{bmatrix})"},
    // (3.10), its products and springs
    {4,
     R"(+ (\frac{m_2}{2} + m_3 + m_4 + m_c) l_1 l_2 \cos(\theta_1 - \theta_2) \dot{\theta}_1 \dot{\theta}_2
        + (\frac{m_3}{2} + m_4 + m_c) l_1 l_3 \cos(\theta_1 - \theta_3) \dot{\theta}_1 \dot{\theta}_3
        + (\frac{m_4}{2} + m_c) l_1 l_4 \cos(\theta_1 - \theta_4) \dot{\theta}_1 \dot{\theta}_4
        + (\frac{m_3}{2} + m_4 + m_c) l_2 l_3 \cos(\theta_2 - \theta_3) \dot{\theta}_2 \dot{\theta}_3
        + (\frac{m_4}{2} + m_c) l_2 l_4 \cos(\theta_2 - \theta_4) \dot{\theta}_2 \dot{\theta}_4
        + (\frac{m_4}{2} + m_c) l_3 l_4 \cos(\theta_3 - \theta_4) \dot{\theta}_3 \dot{\theta}_4
        - \frac{1}{2} k_1 \theta_1^2 - \frac{1}{2} k_2 (\theta_2 - \theta_1)^2
        - \frac{1}{2} k_3 (\theta_3 - \theta_2)^2 - \frac{1}{2} k_4 (\theta_4 - \theta_3)^2)"},
    {4, R"(M_{23} = l_2 l_3 (\frac{m_3}{2} + m_4 + m_c) \cos(\theta_2 - \theta_3))"},
};

}  // namespace

TEST_CASE("the equations stand as chapter 3 prints them") {
  for (const Row& row : kChapter3) {
    CAPTURE(row.equation);
    const std::string text = plain(latex_document(plain_chain(), {row.links}));
    CHECK(text.find(plain(row.equation)) != std::string::npos);
  }
}

TEST_CASE("an effect stands with its formula and its generalised forces") {
  Description description = plain_chain();
  description.effects.push_back(built_in_effect("pivot_stiffness"));
  const std::string text = plain(latex_document(description, {2}));
  CHECK(text.find(plain(R"(V = \frac{\mathrm{change} \, \varphi^2}{2})")) != std::string::npos);
  CHECK(text.find(
            plain(R"(Q^{\mathrm{pivot\_stiffness}}_1 = - \theta_1 \mathinner{\mathrm{change}})")) ==
        std::string::npos);
  CHECK(text.find(
            plain(R"(Q^{\mathrm{pivot\_stiffness}}_1 = - \mathinner{\mathrm{change}} \theta_1)")) !=
        std::string::npos);
  CHECK(text.find(plain(R"(Q^{\mathrm{pivot\_stiffness}}_2 = 0)")) != std::string::npos);
}

TEST_CASE("the derived equations one by one, those of the effects last") {
  Description description = plain_chain();
  description.effects.push_back(built_in_effect("pivot_stiffness"));
  const std::vector<LatexEquations> found = derived_equations(description, 2);
  REQUIRE(found.size() == 11);
  CHECK(found.front().words == "The Lagrangian is");
  CHECK(found.back().words == "The generalised forces of pivot_stiffness are");
  CHECK(plain(found.back().latex).find(plain(R"(Q^{\mathrm{pivot\_stiffness}}_2 = 0)")) !=
        std::string::npos);
  const std::string document = latex_document(description, {2});
  for (const LatexEquations& one : found) {
    CAPTURE(one.words);
    CHECK(document.find(one.latex) != std::string::npos);
  }
}

TEST_CASE("sines and cosines are put together without changing the value") {
  const auto c = [](int i) { return MonomialFactor{Role::kCosine, i, 0}; };
  const auto s = [](int i) { return MonomialFactor{Role::kSine, i, 0}; };
  struct Case {
    MonomialSum before, after;
  };
  const Case cases[] = {
      // (sin^2 + cos^2)^2 = 1
      {{{{{s(1), 4}}, 1}, {{{s(1), 2}, {c(1), 2}}, 2}, {{{c(1), 4}}, 1}}, {{{}, 1}}},
      // (c1 c2 + s1 s2)^2 = cos^2(1 - 2)
      {{{{{c(1), 2}, {c(2), 2}}, 1},
        {{{c(1), 1}, {c(2), 1}, {s(1), 1}, {s(2), 1}}, 2},
        {{{s(1), 2}, {s(2), 2}}, 1}},
       {{{{MonomialFactor{Role::kCosine, 1, 2}, 2}}, 1}}},
      // s1 c2 - c1 s2 = sin(1 - 2); the other way round it is its negative
      {{{{{c(1), 1}, {s(2), 1}}, 3}, {{{s(1), 1}, {c(2), 1}}, -3}},
       {{{{MonomialFactor{Role::kSine, 1, 2}, 1}}, -3}}},
      // s1 c2 + c1 s2 stays
      {{{{{c(1), 1}, {s(2), 1}}, 1}, {{{s(1), 1}, {c(2), 1}}, 1}},
       {{{{c(1), 1}, {s(2), 1}}, 1}, {{{s(1), 1}, {c(2), 1}}, 1}}},
      // 2 - 2 c1
      {{{{}, 2}, {{{c(1), 1}}, -2}}, {{{{MonomialFactor{Role::kVersine, 1, 0}, 1}}, 2}}},
      // 3 s1^2 + c1^2 = 2 s1^2 + 1
      {{{{{s(1), 2}}, 3}, {{{c(1), 2}}, 1}}, {{{{s(1), 2}}, 2}, {{}, 1}}},
  };
  for (const Case& one : cases) {
    MonomialSum sum = one.before;
    combine_trigonometry(sum);
    REQUIRE(sum.size() == one.after.size());
    auto expected = one.after.begin();
    for (const auto& [powers, value] : sum) {
      CHECK(!(powers < expected->first));
      CHECK(!(expected->first < powers));
      CHECK(value.is_equal(expected->second));
      ++expected;
    }
  }
}

TEST_CASE("names that two effects share are told apart, others stand alone") {
  Description description = plain_chain();
  for (const char* id : {"load_drag", "link_damping", "pivot_stiffness"}) {
    description.effects.push_back(built_in_effect(id));
  }
  const std::string text = latex_document(description, {2});
  CHECK(text.find("\\mathinner{\\mathrm{load\\_drag.coefficient}}") != std::string::npos);
  CHECK(text.find("\\mathinner{\\mathrm{link\\_damping.coefficient}}") != std::string::npos);
  CHECK(text.find("\\mathinner{\\mathrm{change}}") != std::string::npos);
}

TEST_CASE("every abbreviation is explained, once") {
  for (const std::vector<std::string>& ids :
       {std::vector<std::string>{"support_motion"}, {"steady_wind", "support_motion"}}) {
    Description description = plain_chain();
    for (const std::string& id : ids) description.effects.push_back(built_in_effect(id));
    const std::string text = latex_document(description, {3});
    const auto count = [&](const std::string& what) {
      int found = 0;
      for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
        ++found;
      return found;
    };
    int k = 1;
    for (; count("R_{" + std::to_string(k) + "}") > 0; ++k) {
      const std::string name = "R_{" + std::to_string(k) + "}";
      CAPTURE(name);
      CHECK(count("  " + name + " ={}& ") + count("  " + name + "^{2} ={}& ") == 1);
      CHECK(count(name) > 1);
    }
    CHECK(k > 4);  // sine and cosine of the phases of both directions
  }
}

TEST_CASE("rest angles stand in the equations") {
  Description description = plain_chain();
  description.effects.push_back(built_in_effect("pivot_rest_angle"));
  const std::string text = latex_document(description, {2});
  CHECK(text.find("= \\vec{T} + \\vec{E}") != std::string::npos);
  CHECK(text.find("e_{1} ={}& k_{1} \\mathinner{\\mathrm{rest}}") != std::string::npos);
  CHECK(text.find("e_{2} ={}& 0") != std::string::npos);
  CHECK(latex_document(plain_chain(), {2}).find("\\vec{E}") == std::string::npos);
}

}  // namespace latex_test
