// SPDX-License-Identifier: GPL-3.0-or-later
//
// Seeded mistakes in correct derivations: a sign, an index, a factor, sine for cosine, a missing
// mass. Each mutant is first confirmed to be wrong, in doubles, against the closed forms of chapter
// 4, which share no code with the checker's own derivation; then the checker must find it.
#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "generator/checking/lexer.hpp"
#include "reference/coriolis.hpp"
#include "reference/gravity.hpp"
#include "reference/joint_matrix.hpp"
#include "reference/mass_matrix.hpp"
#include "tests/generator/checking/checked.hpp"

using namespace catena;
using namespace catena::checking;
using namespace catena::tests;

namespace {

enum class Mistake { kSign, kIndex, kFactor, kSineForCosine, kMissingMass };

/// A place in the text and what stands there after the mistake.
struct Mutation {
  Mistake mistake;
  Location at;
  std::size_t length;
  std::string replacement;
};

/// Every mistake that can be made at one token.
std::vector<Mutation> mutations_of(const std::string& text, int links) {
  std::vector<Mutation> result;
  const std::vector<Token> tokens = tokenize(text, "test");
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const Token& token = tokens[i];
    const auto add = [&](Mistake mistake, const std::string& replacement) {
      result.push_back({mistake, token.at, token.text.size(), replacement});
    };
    if (token.kind == Token::Kind::kSign && token.text == "+") add(Mistake::kSign, "-");
    if (token.kind == Token::Kind::kSign && token.text == "-") add(Mistake::kSign, "+");
    if (token.kind == Token::Kind::kNumber && i > 0 && tokens[i - 1].text == "/")
      add(Mistake::kFactor, token.text == "2" ? "1" : "2");
    if (token.kind != Token::Kind::kName) continue;
    if (token.text == "sin") add(Mistake::kSineForCosine, "cos");
    if (token.text == "cos") add(Mistake::kSineForCosine, "sin");
    const std::size_t split = token.text.rfind('_');
    if (split == std::string::npos) continue;
    const std::string family = token.text.substr(0, split);
    if (family == "m") add(Mistake::kMissingMass, "0");
    if (token.text == "m_c") continue;
    const int index = std::stoi(token.text.substr(split + 1));
    add(Mistake::kIndex, family + "_" + std::to_string(index % links + 1));
  }
  return result;
}

std::string mutated(const std::string& text, const Mutation& mutation) {
  std::size_t start = 0;
  for (int line = 1; line < mutation.at.line; ++line) start = text.find('\n', start) + 1;
  std::string result = text;
  return result.replace(start + static_cast<std::size_t>(mutation.at.column) - 1, mutation.length,
                        mutation.replacement);
}

/// x of A x = b, A positive definite.
template <class Matrix>
std::vector<double> solved(Matrix a, std::vector<double> b) {
  for (std::size_t k = 0; k < b.size(); ++k)
    for (std::size_t i = k + 1; i < b.size(); ++i) {
      const double factor = a[i][k] / a[k][k];
      for (std::size_t j = k; j < b.size(); ++j) a[i][j] -= factor * a[k][j];
      b[i] -= factor * b[k];
    }
  for (std::size_t k = b.size(); k-- > 0;) {
    for (std::size_t j = k + 1; j < b.size(); ++j) b[k] -= a[k][j] * b[j];
    b[k] /= a[k][k];
  }
  return b;
}

/// A state in doubles, and the closed forms there.
class ClosedForms {
 public:
  ClosedForms(const ChainSymbols& symbols, std::mt19937_64& random) {
    const auto draw = [&](const std::vector<GiNaC::ex>& family, double least, double most) {
      std::vector<double> values;
      for (std::size_t i = 1; i < family.size(); ++i) {
        values.push_back(least + (most - least) * static_cast<double>(random() >> 11) * 0x1p-53);
        state_[family[i]] = values.back();
      }
      return values;
    };
    chain_ = {draw(symbols.length, 0.5, 2),
              draw(symbols.mass, 0.5, 2),
              draw(symbols.inertia, 0.5, 2),
              draw(symbols.stiffness, 0.5, 2),
              draw(symbols.damping, 0.5, 2),
              1.3,
              9.81};
    state_[symbols.load_mass] = chain_.load_mass;
    state_[symbols.gravity] = chain_.gravity;
    angle_ = draw(symbols.angle, -3, 3);
    rate_ = draw(symbols.rate, -2, 2);
    acceleration_ = draw(symbols.acceleration, -2, 2);
    torque_ = draw(symbols.torque, -2, 2);
  }

  double of(const Entry& entry) const {
    const auto row = static_cast<std::size_t>(entry.row) - 1;
    const auto column = static_cast<std::size_t>(entry.column) - 1;
    const auto mass = reference::mass_matrix(chain_, angle_);
    const auto damping = reference::joint_matrix(chain_.damping);
    const auto stiffness = reference::joint_matrix(chain_.stiffness);
    const auto coriolis = reference::coriolis(chain_, angle_, rate_);
    const auto gravity = reference::gravity(chain_, angle_);
    switch (entry.quantity) {
      case Quantity::kMass:
        return mass[row][column];
      case Quantity::kDamping:
        return damping[row][column];
      case Quantity::kStiffness:
        return stiffness[row][column];
      case Quantity::kCoriolis:
        return coriolis[row];
      case Quantity::kGravity:
        return gravity[row];
      case Quantity::kEquation: {
        if (entry.label.rfind("thetaddot", 0) == 0) {
          std::vector<double> right;
          for (std::size_t i = 0; i < angle_.size(); ++i) {
            right.push_back(torque_[i] - coriolis[i] - gravity[i]);
            for (std::size_t j = 0; j < angle_.size(); ++j)
              right[i] -= damping[i][j] * rate_[j] + stiffness[i][j] * angle_[j];
          }
          return acceleration_[row] - solved(mass, right)[row];
        }
        double sum = coriolis[row] + gravity[row] - torque_[row];
        for (std::size_t j = 0; j < angle_.size(); ++j)
          sum += mass[row][j] * acceleration_[j] + damping[row][j] * rate_[j] +
                 stiffness[row][j] * angle_[j];
        return sum;
      }
      default:
        break;
    }
    FAIL("no closed form for " << entry.label);
    return 0;
  }

  double by_hand(const Entry& entry) const {
    const GiNaC::ex value = (entry.value - entry.right).subs(state_).evalf();
    return GiNaC::ex_to<GiNaC::numeric>(value).to_double();
  }

 private:
  reference::Chain<double> chain_;
  std::vector<double> angle_, rate_, acceleration_, torque_;
  GiNaC::exmap state_;
};

/// Labels of the entries that are wrong at two random states.
std::set<std::string> wrong_entries(const Derivation& derivation, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::set<std::string> wrong;
  for (int state = 0; state < 2; ++state) {
    const ClosedForms closed(*derivation.chain, random);
    for (const Entry& entry : derivation.entries) {
      if (entry.quantity == Quantity::kLagrangian) continue;  // shows in the equations
      const double hand = closed.by_hand(entry), expected = closed.of(entry);
      // Doubles: both are sums of about a hundred products near 1.
      if (std::abs(hand - expected) > 1e-10 * (1 + std::abs(hand) + std::abs(expected)))
        wrong.insert(entry.label);
    }
  }
  return wrong;
}

}  // namespace

TEST_CASE("seeded mistakes are found, and only where they are") {
  constexpr int kOfEachKind = 12;
  struct Source {
    std::string file;
    int links;
  };
  std::mt19937_64 random(20191107);
  std::map<Mistake, int> caught;
  for (const Source& source :
       {Source{"chapter_3_two_links.txt", 2}, Source{"chapter_3_three_links.txt", 3},
        Source{"chapter_3_four_links.txt", 4}}) {
    const std::string text = example(source.file);
    const std::vector<Mutation> all = mutations_of(text, source.links);
    for (const Mistake mistake : {Mistake::kSign, Mistake::kIndex, Mistake::kFactor,
                                  Mistake::kSineForCosine, Mistake::kMissingMass}) {
      std::vector<Mutation> candidates;
      for (const Mutation& mutation : all)
        if (mutation.mistake == mistake) candidates.push_back(mutation);
      REQUIRE(!candidates.empty());
      for (int i = 0; i < kOfEachKind / 3; ++i) {
        const Mutation& mutation = candidates[random() % candidates.size()];
        const std::string mutant = mutated(text, mutation);
        INFO(source.file << ":" << mutation.at.line << ":" << mutation.at.column << " -> "
                         << mutation.replacement);
        const Checked result = checked(mutant);
        const std::set<std::string> wrong = wrong_entries(result.derivation, random());
        for (std::size_t k = 0; k < result.findings.size(); ++k) {
          const Entry& entry = result.derivation.entries[k];
          const Finding& finding = result.findings[k];
          CHECK(finding.verdict != Verdict::kUndecided);
          if (entry.quantity == Quantity::kLagrangian) continue;
          INFO(entry.label << ": " << finding.difference);
          const bool found = finding.verdict == Verdict::kDifferent;
          CHECK(found == (wrong.count(entry.label) == 1));
          if (!found) continue;
          CHECK(!finding.difference.empty());
          CHECK(!finding.origins.empty());
          CHECK(finding.value != finding.expected);
        }
        if (!wrong.empty()) ++caught[mistake];
      }
    }
  }
  int total = 0;
  for (const auto& kind : caught) {
    INFO("kind " << static_cast<int>(kind.first));
    CHECK(kind.second >= 6);
    total += kind.second;
  }
  CHECK(caught.size() == 5);
  MESSAGE(total << " mutants confirmed wrong and found");
  CHECK(total >= 30);
}

TEST_CASE("mistakes before and in an elimination of four links are found in the accelerations") {
  const std::string lagrangian = example("chapter_3_four_links.txt");
  const std::string elimination =
      "for i = 1..n\n"
      "  b[i] = -E[i]\n"
      "  for j = 1..n\n"
      "    A[i,j] = diff(E[i], thetaddot_j)\n"
      "    b[i] = at(b[i], thetaddot_j, 0)\n"
      "  end\n"
      "end\n"
      "for k = 1..n-1\n"
      "  for i = k+1..n\n"
      "    factor = A[i,k]/A[k,k]\n"
      "    A[i,j] = A[i,j] - factor*A[k,j] for j = k+1..n\n"
      "    b[i] = b[i] - factor*b[k]\n"
      "  end\n"
      "end\n"
      "for r = 0..n-1\n"
      "  i = n - r\n"
      "  a[i] = (b[i] - sum(j = i+1..n, A[i,j]*a[j]))/A[i,i]\n"
      "  thetaddot[i] = a[i]\n"
      "end\n";
  std::vector<std::string> mutants;
  std::mt19937_64 random(20191108);
  const std::string energies = lagrangian.substr(0, lagrangian.find("\n# Euler"));
  const std::vector<Mutation> all = mutations_of(energies, 4);
  for (const Mistake mistake : {Mistake::kSign, Mistake::kIndex, Mistake::kFactor,
                                Mistake::kSineForCosine, Mistake::kMissingMass}) {
    std::vector<Mutation> candidates;
    for (const Mutation& mutation : all)
      if (mutation.mistake == mistake) candidates.push_back(mutation);
    for (int i = 0; i < 5; ++i)
      mutants.push_back(left_sides(mutated(lagrangian, candidates[random() % candidates.size()])) +
                        elimination);
  }
  for (const auto& [right, wrong] : std::vector<std::pair<std::string, std::string>>{
           {"= -E[i]", "= E[i]"},
           {"factor = A[i,k]/A[k,k]", "factor = A[k,i]/A[i,i]"},
           {"- factor*A[k,j]", "+ factor*A[k,j]"},
           {"- factor*b[k]", "- 2*factor*b[k]"},
           {"sum(j = i+1..n,", "sum(j = i+2..n,"},
           {"b[i] - sum(", "b[i] + sum("}}) {
    std::string text = elimination;
    text.replace(text.find(right), right.size(), wrong);
    mutants.push_back(left_sides(lagrangian) + text);
  }
  int caught = 0;
  for (const std::string& mutant : mutants) {
    INFO(mutant);
    const Checked result = checked(mutant);
    const std::set<std::string> wrong = wrong_entries(result.derivation, random());
    for (std::size_t k = 0; k < result.findings.size(); ++k) {
      const Entry& entry = result.derivation.entries[k];
      if (entry.quantity == Quantity::kLagrangian) continue;
      const Finding& finding = result.findings[k];
      const bool is_wrong = wrong.count(entry.label) == 1;
      INFO(entry.label);
      CHECK(finding.verdict == (is_wrong ? Verdict::kDifferent : Verdict::kEqual));
      CHECK(is_wrong == (finding.value != finding.expected));
    }
    if (!wrong.empty()) ++caught;
  }
  MESSAGE(caught << " of " << mutants.size() << " mutants confirmed wrong and found");
  CHECK(caught >= 25);
}

TEST_CASE("a mistake is named by where it sits") {
  struct Row {
    std::string text;
    std::string label;
    std::string origin;
  };
  const std::vector<Row> rows = {
      {"M[1,2] = l_1*l_2*(m_2/2 + m_3)*cos(theta_1 - theta_2)", "M[1,2]",
       "kinetic energy of the load: missing"},
      {"M[1,2] = l_1*l_2*(m_2 + m_3 + m_c)*cos(theta_1 - theta_2)", "M[1,2]",
       "kinetic energy of link 2: multiplied by 2"},
      {"M[1,2] = -l_1*l_2*(m_2/2 + m_3 + m_c)*cos(theta_1 - theta_2)", "M[1,2]",
       "the whole entry has the wrong sign"},
      {"M[3,3] = l_3^2*(m_3/4 + m_c)", "M[3,3]", "rotational energy of link 3: missing"},
      {"M[3,3] = l_3^2*(m_3/4 + m_2 + m_c) + I_3", "M[3,3]", "m_2 does not belong here: l_3^2*m_2"},
      {"K[1,1] = k_1 - k_2", "K[1,1]", "spring of joint 2: has the wrong sign"},
      {"C[2,2] = c_2/2 + c_3", "C[2,2]", "damper of joint 2: multiplied by 1/2"},
      {"G[2] = (m_2/2 + m_3 + m_c)*g*l_2*cos(theta_2)", "G[2]",
       "gravity of link 2: off by g*l_2*m_2*cos(theta_2)/2 - g*l_2*m_2*sin(theta_2)/2"},
      {"equation 1: diff(1/2*k_1*theta_1^2, theta_1) = 0", "equation 1", "torque T_1: missing"},
      {"equation 3: diff(1/2*k_3*(theta_3 - theta_2)^2, theta_3) = 0", "equation 3",
       "torque T_3: missing"},
  };
  for (const Row& row : rows) {
    INFO(row.text);
    const Checked result = checked("links 3\n" + row.text);
    const std::vector<std::string>& origins = result.of(row.label).origins;
    bool named = false;
    for (const std::string& origin : origins) {
      INFO(origin);
      named = named || origin == row.origin;
      CHECK(!origin.empty());
    }
    CHECK(named);
  }
}
