// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/law_choice.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "linear_algebra/decompositions.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

MatrixXd gram_of(const LawTrials::OfCandidate& candidate, const std::vector<int>& form) {
  const auto size = static_cast<Index>(form.size());
  return MatrixXd::NullaryExpr(size, size, [&](Index i, Index j) {
    return candidate.gram.coeff(form[static_cast<std::size_t>(i)],
                                form[static_cast<std::size_t>(j)]);
  });
}

}  // namespace

Eigen::SparseMatrix<double> products_in_forms(const Eigen::Ref<const MatrixXd>& terms,
                                              const std::vector<std::vector<int>>& forms) {
  std::vector<std::pair<int, int>> together;
  for (const std::vector<int>& form : forms)
    for (const int i : form)
      for (const int j : form) together.emplace_back(i, j);
  std::sort(together.begin(), together.end());
  together.erase(std::unique(together.begin(), together.end()), together.end());
  std::vector<Eigen::Triplet<double>> products;
  products.reserve(together.size());
  for (const auto& [i, j] : together) products.emplace_back(i, j, terms.col(i).dot(terms.col(j)));
  Eigen::SparseMatrix<double> gram(terms.cols(), terms.cols());
  gram.setFromTriplets(products.begin(), products.end());
  return gram;
}

std::optional<LinearFit> fit_of(const LawTrials::OfCandidate& candidate,
                                const std::vector<int>& form, Index columns) {
  const MatrixXd gram = gram_of(candidate, form);
  const MatrixXd cross = candidate.cross(form, Eigen::seqN(0, columns));
  const VectorXd scale = gram.diagonal().cwiseSqrt();
  if (!(scale.minCoeff() > 0)) return std::nullopt;
  const MatrixXd correlation =
      scale.cwiseInverse().asDiagonal() * gram * scale.cwiseInverse().asDiagonal();
  constexpr double kSingular = 1e-10;
  const SymmetricFactors factors(correlation);
  if (!(factors.reciprocal_condition() > kSingular)) return std::nullopt;
  LinearFit fit{MatrixXd(cross.rows(), columns), VectorXd(columns)};
  for (Index t = 0; t < columns; ++t) {
    fit.coefficients.col(t) = scale.cwiseInverse().cwiseProduct(
        factors.solve(VectorXd(scale.cwiseInverse().cwiseProduct(cross.col(t)))));
    fit.explained[t] = fit.coefficients.col(t).dot(cross.col(t));
  }
  return fit;
}

std::vector<ChosenLaw> choose_law(const std::vector<CandidateLaw>& candidates,
                                  const LawTrials& trials) {
  const Index columns = trials.squares.size();
  std::vector<ChosenLaw> best(static_cast<std::size_t>(columns));
  const double count = std::log(static_cast<double>(trials.rows));
  for (std::size_t c = 0; c < candidates.size(); ++c)
    for (const std::vector<int>& form : candidates[c].forms()) {
      const std::optional<LinearFit> fit = fit_of(trials.candidates[c], form, columns);
      if (!fit) continue;
      const double penalty = count * candidates[c].constants(form);
      for (Index t = 0; t < columns; ++t) {
        const double score = (fit->explained[t] - penalty) / trials.squares[t];
        ChosenLaw& chosen = best[static_cast<std::size_t>(t)];
        if (score > chosen.score && candidates[c].admits(fit->coefficients.col(t)))
          chosen = {c, form, score, VectorXd(fit->coefficients.col(t))};
      }
    }
  return best;
}

double explained_by_law(const LawTrials& trials, Index column, const ChosenLaw& law, double least) {
  const double before = trials.squares[column];
  if (law.form.empty() || !(before > least)) return 0;
  if (law.explained_in_second) return *law.explained_in_second / (before - least);
  const LawTrials::OfCandidate& of = trials.candidates[law.candidate];
  const VectorXd& b = law.coefficients;
  const MatrixXd gram = gram_of(of, law.form);
  const VectorXd cross = of.cross(law.form, column);
  return (2 * b.dot(cross) - b.dot(gram * b)) / (before - least);
}

}  // namespace catena
