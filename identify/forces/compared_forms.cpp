// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/compared_forms.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "identify/forces/force_law.hpp"

namespace catena {
namespace {

/// Whether a formula says nearly the same as one of the same pair that has its terms and more.
bool says_nearly_the_same(const FittedForm& fewer, const FittedForm& more) {
  const auto has = [&](int term) {
    return std::find(more.form.begin(), more.form.end(), term) != more.form.end();
  };
  return fewer.form.size() < more.form.size() && fewer.law.same_pair(more.law) &&
         std::all_of(fewer.form.begin(), fewer.form.end(), has) &&
         fewer.squares - more.squares < kLawThresholds.worth * (more.without - more.squares);
}

/// Takes the best of `all.fits`.
void choose_best(ComparedForms& all) {
  double lowest = HUGE_VAL;
  for (const FittedForm& fitted : all.fits) lowest = std::min(lowest, all.criterion(fitted));
  const auto rank = [&](const FittedForm& fitted) {
    const bool decided_against = all.criterion(fitted) > lowest + kLawThresholds.undecided;
    return std::tuple(decided_against, fitted.law.is_curve(fitted.form), fitted.constants(),
                      all.criterion(fitted));
  };
  for (std::size_t i = 1; i < all.fits.size(); ++i)
    if (rank(all.fits[i]) < rank(all.fits[all.best])) all.best = i;
  const FittedForm& with_most_terms = all.fits[all.best];
  for (std::size_t i = 0; i < all.fits.size(); ++i)
    if (says_nearly_the_same(all.fits[i], with_most_terms) &&
        all.fits[i].constants() < all.fits[all.best].constants())
      all.best = i;
}

}  // namespace

double ComparedForms::criterion(const FittedForm& fitted) const {
  return fitted.squares / inflation + fitted.constants() * std::log(fitted.freedom);
}

std::vector<const FittedForm*> ComparedForms::not_told_from_best() const {
  const FittedForm& winner = fits[best];
  std::vector<const FittedForm*> some;
  for (const FittedForm& fitted : fits) {
    if (&fitted == &winner) continue;
    // In which direction a push acts is decided by exact fits: the steps in time of the linear equations are too long for
    // a short one.
    const bool other_direction =
        winner.law.has_time() && fitted.law.has_terms_of(fitted.form, winner.law, winner.form);
    if (other_direction || criterion(fitted) < criterion(winner) + kLawThresholds.undecided)
      some.push_back(&fitted);
  }
  return some;
}

double ComparedForms::left_more(const FittedForm& fitted) const {
  const FittedForm& winner = fits[best];
  return (criterion(fitted) - criterion(winner) - kLawThresholds.undecided) * inflation /
         winner.freedom;
}

std::vector<const FittedForm*> ComparedForms::behind_best() const {
  const FittedForm& winner = fits[best];
  const bool curve = winner.law.is_curve(winner.form);
  std::vector<const FittedForm*> behind;
  for (const FittedForm& fitted : fits)
    if (!fitted.law.is_curve(fitted.form) && (curve || !fitted.law.same_pair(winner.law)) &&
        left_more(fitted) >= 0)
      behind.push_back(&fitted);
  std::sort(behind.begin(), behind.end(), [&](const FittedForm* a, const FittedForm* b) {
    return criterion(*a) < criterion(*b);
  });
  std::vector<const FittedForm*> first_of_pairs;
  for (const FittedForm* fitted : behind)
    if (std::none_of(first_of_pairs.begin(), first_of_pairs.end(),
                     [&](const FittedForm* better) { return fitted->law.same_pair(better->law); }))
      first_of_pairs.push_back(fitted);
  return first_of_pairs;
}

std::optional<ComparedForms> compared_forms(const LawFit& fits,
                                            const std::vector<FittedForm>& begins) {
  ComparedForms all;
  double least = HUGE_VAL;
  for (const FittedForm& begin : begins) {
    FittedForm fitted = fits.fit_without_drive(begin);
    if (!std::isfinite(fitted.squares) || !fitted.law.admits(fitted.coefficients)) continue;
    if (fitted.squares < least) {
      least = fitted.squares;
      all.inflation = std::max(1.0, fitted.squares / fitted.freedom);
    }
    all.fits.push_back(std::move(fitted));
  }
  if (all.fits.empty()) return std::nullopt;
  choose_best(all);
  return all;
}

}  // namespace catena
