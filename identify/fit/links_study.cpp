// SPDX-License-Identifier: BSD-3-Clause
#include "identify/fit/links_study.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "common/in_quotes.hpp"
#include "common/input_error.hpp"
#include "identify/fit/error.hpp"

namespace catena {

Case case_for_links(const Case& the_case, int links) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(the_case.file.string() + ": " + what +
                     "; a study of the number of links needs a case that holds for any number");
  };
  if (!the_case.cable.link_lengths.empty() || !the_case.cable.link_masses.empty() ||
      !the_case.cable.link_inertias.empty())
    refuse("cable: gives numbers per link");
  for (const ParameterSpec& parameter : the_case.parameters)
    if (parameter.sets.find("..") != std::string::npos ||
        (!parameter.sets.empty() &&
         std::isdigit(static_cast<unsigned char>(parameter.sets.back()))))
      refuse("parameter " + in_quotes(parameter.name) + ": sets = " + in_quotes(parameter.sets));
  const auto check = [&](InitialSpec& initial) {
    for (std::vector<double>* of_links : {&initial.azimuths, &initial.azimuth_rates}) {
      if (of_links->empty()) continue;
      if (std::set<double>(of_links->begin(), of_links->end()).size() > 1)
        refuse("initial: gives azimuths per link");
      of_links->resize(static_cast<std::size_t>(links), of_links->front());
    }
    if (initial.shape == Shape::kAngles ||
        (!initial.at_rest && initial.velocity_shape == Shape::kAngles))
      refuse("initial: gives numbers per link");
  };
  Case other = the_case;
  other.links = links;
  check(other.initial);
  for (ExperimentSpec& experiment : other.experiments) {
    if (experiment.initial) check(*experiment.initial);
    if (experiment.kind == DataKind::kAngles)
      refuse(experiment.name + ": measures angles of links");
    for (const PointSpec& point : experiment.points)
      if (point.joint) refuse(experiment.name + ": " + point.name + " is at a joint");
  }
  return other;
}

std::vector<LinksResult> links_study(const Case& the_case, const std::vector<int>& links,
                                     const std::function<Model(const Case&)>& model_of,
                                     const FitOptions& options, const LeastSquares& least_squares) {
  std::vector<LinksResult> results;
  for (const int count : links) {
    const Case other = case_for_links(the_case, count);
    const Problem problem(other, model_of(other));
    LinksResult result;
    result.links = count;
    result.fit = fit(problem, options, least_squares);
    if (std::isfinite(result.fit.error)) {
      const Evaluation evaluation = evaluate(problem, result.fit.x, true, false);
      const bool held_out = residuals_of(problem, evaluation, Part::kValidation).value.size() > 0;
      result.validation_error =
          held_out ? error_of(problem, evaluation, Part::kValidation) : kNotGiven;
    }
    for (const Unknown& unknown : problem.unknowns()) result.names.push_back(unknown.name);
    results.push_back(std::move(result));
    if (results.back().fit.status == FitStatus::kInterrupted) break;
  }
  return results;
}

namespace {

double least_error(const std::vector<LinksResult>& results) {
  double least = std::numeric_limits<double>::infinity();
  for (const LinksResult& result : results) least = std::fmin(least, result.fit.error);
  return least;
}

}  // namespace

int recommended_links(const std::vector<LinksResult>& results, double budget) {
  const double most = (1 + budget) * least_error(results);
  int fewest = -1;
  for (const LinksResult& result : results)
    if (std::isfinite(result.fit.error) && result.fit.error <= most &&
        (fewest < 0 || result.links < fewest))
      fewest = result.links;
  return fewest;
}

bool more_links_are_worse(const std::vector<LinksResult>& results, double budget) {
  const auto finest = std::max_element(
      results.begin(), results.end(),
      [](const LinksResult& a, const LinksResult& b) { return a.links < b.links; });
  return finest != results.end() && finest->fit.error > (1 + budget) * least_error(results);
}

}  // namespace catena
