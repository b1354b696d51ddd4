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
                                const std::vector<int>& form, Index first, Index columns) {
  const MatrixXd gram = gram_of(candidate, form);
  const MatrixXd cross = candidate.cross(form, Eigen::seqN(first, columns));
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

std::optional<FittedColumn> fit_of_column(const CandidateLaw& law,
                                          const LawTrials::OfCandidate& candidate,
                                          std::vector<int> form, Index column, double cost) {
  const bool pieces = law.has_pieces(form);
  if (pieces) {
    constexpr double kVisited = 1e-8;  // where the motion hardly goes nothing is known
    const double least = kVisited * gram_of(candidate, form).diagonal().maxCoeff();
    std::erase_if(form, [&](int term) { return !(candidate.gram.coeff(term, term) > least); });
  }
  while (!form.empty()) {
    const std::optional<LinearFit> fit = fit_of(candidate, form, column, 1);
    if (!fit) return std::nullopt;
    FittedColumn fitted{form, fit->coefficients.col(0), fit->explained[0]};
    // What each one explains that the others do not; less than nothing where it makes energy.
    VectorXd alone = VectorXd::Constant(1, HUGE_VAL);
    if (pieces) {
      const MatrixXd covariance = inverse(gram_of(candidate, form));
      alone = fitted.coefficients.cwiseAbs2().cwiseQuotient(covariance.diagonal());
      alone = (fitted.coefficients.array() < 0).select(alone, -alone);
    }
    Index least = 0;
    if (alone.minCoeff(&least) >= cost) {
      if (!law.admits(fitted.coefficients)) return std::nullopt;
      return fitted;
    }
    form.erase(form.begin() + least);
  }
  return std::nullopt;
}

std::vector<ChosenLaw> choose_law(const std::vector<CandidateLaw>& candidates,
                                  const LawTrials& trials, LawForms of) {
  const Index columns = trials.squares.size();
  std::vector<ChosenLaw> best(static_cast<std::size_t>(columns));
  const double count = std::log(static_cast<double>(trials.rows));
  for (std::size_t c = 0; c < candidates.size(); ++c)
    for (const std::vector<int>& form : candidates[c].forms()) {
      const CandidateLaw& law = candidates[c];
      if (law.is_curve(form) != (of == LawForms::kCurves)) continue;
      const bool pieces = law.has_pieces(form);
      const std::optional<LinearFit> fit = fit_of(trials.candidates[c], form, 0, columns);
      if (!fit && !pieces) continue;
      const auto score = [&](double explained, Index t, const std::vector<int>& used) {
        return (explained - count * law.constants(used)) / trials.squares[t];
      };
      for (Index t = 0; t < columns; ++t) {
        ChosenLaw& chosen = best[static_cast<std::size_t>(t)];
        if (!pieces) {
          const double here = score(fit->explained[t], t, form);
          if (here > chosen.score && law.admits(fit->coefficients.col(t)))
            chosen = {c, form, here, VectorXd(fit->coefficients.col(t))};
          continue;
        }
        // All of the pieces explain most.
        if (fit && score(fit->explained[t], t, {form.front()}) <= chosen.score) continue;
        const auto fitted = fit_of_column(law, trials.candidates[c], form, t, count);
        if (!fitted) continue;
        const double here = score(fitted->explained, t, fitted->form);
        if (here > chosen.score) chosen = {c, fitted->form, here, fitted->coefficients};
      }
    }
  return best;
}

double explained_squares(const LawTrials& trials, Index column, const ChosenLaw& law) {
  if (law.explained_in_second) return *law.explained_in_second;
  const LawTrials::OfCandidate& of = trials.candidates[law.candidate];
  const VectorXd& b = law.coefficients;
  const VectorXd cross = of.cross(law.form, column);
  return 2 * b.dot(cross) - b.dot(gram_of(of, law.form) * b);
}

double explained_by_law(const LawTrials& trials, Index column, const ChosenLaw& law, double least) {
  const double before = trials.squares[column];
  if (law.form.empty() || !(before > least)) return 0;
  return explained_squares(trials, column, law) / (before - least);
}

}  // namespace catena
