// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/final_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "identify/diagnosis/compare.hpp"
#include "identify/diagnosis/diagnosis.hpp"
#include "identify/diagnosis/variant.hpp"
#include "linear_algebra/decompositions.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Largest difference between the residuals r of two models at seeded random states and parameters,
/// relative to the largest |r|, `larger` having parameters more than `smaller`, held at their
/// neutral values. Further coordinates of `larger` rest at zero.
double largest_difference(const Model& smaller, const Model& larger, unsigned seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1.0p-53;
  };
  const auto fill = [&](VectorXd& values, Index count, double low, double high) {
    for (Index i = 0; i < count; ++i) values[i] = uniform(low, high);
  };
  double worst = 0, size = 0;
  for (int state = 0; state < 20; ++state) {
    const Index n = smaller.coordinates();
    VectorXd q = VectorXd::Zero(larger.coordinates()), v = q, a = q;
    VectorXd z = VectorXd::Zero(larger.states()), u = VectorXd::Zero(3 * larger.signals());
    fill(q, n, -1.5, 1.5);
    fill(v, n, -3, 3);
    fill(a, n, -10, 10);
    fill(z, z.size(), -0.01, 0.01);
    const double t = uniform(0, 5);
    VectorXd p = VectorXd::Zero(smaller.parameters());
    for (Index i = 0; i < p.size(); ++i) {
      const catena_parameter& entry = smaller.table().parameter[i];
      p[i] = std::isfinite(entry.neutral) ? entry.neutral : uniform(0.1, 1.0);
    }
    VectorXd larger_p = larger.default_parameters();
    for (Index i = 0; i < larger_p.size(); ++i) {
      const catena_parameter& entry = larger.table().parameter[i];
      if (std::isfinite(entry.neutral))
        larger_p[i] = entry.neutral;
      else if (!std::isfinite(larger_p[i]))
        larger_p[i] = std::isinf(entry.neutral) ? 1e6 : 1.0;
    }
    for (Index i = 0; i < p.size(); ++i)
      larger_p[larger.parameter_index(smaller.table().parameter[i].name)] = p[i];
    VectorXd r(n), larger_r(larger.coordinates());
    const VectorXd small_z = z.head(smaller.states()), small_u = u.head(3 * smaller.signals());
    const catena_point at{t,       q.data(), v.data(), a.data(), small_z.data(), small_u.data(),
                          p.data()};
    const catena_point there{t, q.data(), v.data(), a.data(), z.data(), u.data(), larger_p.data()};
    smaller.residual(at, r.data());
    larger.residual(there, larger_r.data());
    worst = std::max(worst, (r - larger_r.head(n)).lpNorm<Eigen::Infinity>());
    size = std::max(size, r.lpNorm<Eigen::Infinity>());
  }
  return size > 0 ? worst / size : worst;
}

}  // namespace

VectorXd standard_errors(const FittedModel& model, const std::vector<NoiseModel>& noise) {
  MatrixXd jacobian = fitted_jacobian(model, noise);
  VectorXd scale = jacobian.colwise().norm();
  for (Index j = 0; j < scale.size(); ++j) {
    if (scale[j] == 0) scale[j] = 1;
    jacobian.col(j) /= scale[j];
  }
  const EigenPairs eigen = symmetric_eigenpairs(jacobian.transpose() * jacobian);
  const double variance = std::max(
      1.0, sum_of_squares(model, noise) / static_cast<double>(std::max<Index>(1, jacobian.rows())));
  const double factor = std::sqrt(variance * autocorrelation_factor(white_residuals(model, noise)));
  VectorXd errors(scale.size());
  for (Index j = 0; j < errors.size(); ++j) {
    double sum = 0;
    for (Index k = 0; k < scale.size(); ++k) {
      const double share = eigen.vectors(j, k), value = eigen.values[k];
      if (value > 1e-13 * eigen.values[scale.size() - 1])
        sum += share * share / value;
      else if (std::abs(share) > 1e-6)
        sum = std::numeric_limits<double>::infinity();
    }
    errors[j] = factor * std::sqrt(sum) / scale[j];
  }
  return errors;
}

void make_final_model(Diagnosis& diagnosis, const Case& asked, DiagnosisContext& context) {
  Case the_case = diagnosis.final.problem->with(diagnosis.final.x);
  the_case.simulation = asked.simulation;
  the_case.optimiser = asked.optimiser;
  const Model model = context.complete_model_with(diagnosis.effects, the_case.links);
  if (!diagnosis.effects.empty())
    diagnosis.equality = largest_difference(context.model_with({}, the_case.links), model, 1);
  const auto problem = std::make_shared<const Problem>(the_case, model);
  FittedModel refitted =
      fit_model(problem, transfer(*diagnosis.final.problem, diagnosis.final.x, *problem),
                diagnosis.noise, context.least_squares, context.stop);
  // A fit that cannot leave its start is there already.
  if (!refitted.ok)
    refitted = assess(problem, transfer(*diagnosis.final.problem, diagnosis.final.x, *problem),
                      context.least_squares, context.stop);
  if (!refitted.ok)
    throw std::runtime_error("the final model cannot be simulated: " + refitted.message);
  diagnosis.final = std::move(refitted);
}

std::vector<FinalParameter> final_parameters(const Diagnosis& diagnosis) {
  std::vector<FinalParameter> parameters;
  const Problem& problem = *diagnosis.final.problem;
  const VectorXd errors = standard_errors(diagnosis.final, diagnosis.noise);
  for (std::size_t j = 0; j < problem.unknowns().size(); ++j) {
    const Unknown& unknown = problem.unknowns()[j];
    if (unknown.group == Unknown::Group::kInitial) continue;
    FinalParameter parameter;
    parameter.name = unknown.name;
    parameter.unit = unknown.unit;
    for (const std::string& effect : diagnosis.effects)
      if (belongs_to(unknown.name, effect)) parameter.effect = effect;
    parameter.value = diagnosis.final.x[static_cast<Index>(j)];
    parameter.standard_error = errors[static_cast<Index>(j)];
    parameters.push_back(parameter);
  }
  return parameters;
}

}  // namespace catena
