// SPDX-License-Identifier: BSD-3-Clause
#include "identify/fit/minimise.hpp"

#include <cmath>
#include <nlopt.hpp>
#include <stdexcept>

namespace catena {
namespace {

// The simplex needs a number it can compare and average.
constexpr double kWorst = 1e100;

nlopt::algorithm algorithm_of(FitMethod method) {
  switch (method) {
    case FitMethod::kNelderMead:
      return nlopt::LN_NELDERMEAD;
    case FitMethod::kLbfgs:
      return nlopt::LD_LBFGS;
    case FitMethod::kSlsqp:
      return nlopt::LD_SLSQP;
    case FitMethod::kMma:
      return nlopt::LD_MMA;
    case FitMethod::kLeastSquares:
      break;
  }
  throw std::invalid_argument("least squares is not among NLopt's methods");
}

std::vector<double> plain(const Eigen::VectorXd& x) { return {x.begin(), x.end()}; }

Eigen::VectorXd vector(const std::vector<double>& x) {
  return Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
}

struct Search {
  const Objective& objective;
  const MinimiserOptions& options;
  nlopt::opt solver;
  Minimum best;

  double evaluate(const std::vector<double>& x, std::vector<double>& slope) {
    Eigen::VectorXd gradient;
    const double value = objective(vector(x), slope.empty() ? nullptr : &gradient);
    std::copy(gradient.begin(), gradient.end(), slope.begin());
    if (value < best.value) {
      best.value = value;
      best.x = vector(x);
    }
    if (options.must_stop && options.must_stop()) solver.force_stop();
    return std::isfinite(value) ? value : kWorst;
  }
};

}  // namespace

Minimum minimise(const Objective& objective, const Eigen::VectorXd& start,
                 const MinimiserOptions& options) {
  Search search{objective,
                options,
                nlopt::opt(algorithm_of(options.method), static_cast<unsigned>(start.size())),
                {start, std::numeric_limits<double>::infinity(), false, ""}};
  nlopt::opt& solver = search.solver;
  if (options.lower.size()) solver.set_lower_bounds(plain(options.lower));
  if (options.upper.size()) solver.set_upper_bounds(plain(options.upper));
  if (options.first_steps.size()) solver.set_initial_step(plain(options.first_steps));
  solver.set_xtol_rel(options.x_tolerance);
  solver.set_ftol_rel(options.value_tolerance);
  const nlopt::vfunc evaluate = [](const std::vector<double>& x, std::vector<double>& slope,
                                   void* data) {
    return static_cast<Search*>(data)->evaluate(x, slope);
  };
  solver.set_min_objective(evaluate, &search);
  std::vector<double> x = plain(start);
  double value = 0;
  try {
    solver.optimize(x, value);
  } catch (const nlopt::forced_stop&) {
    search.best.stopped = true;
  } catch (const nlopt::roundoff_limited&) {
    search.best.message = "stopped at the limit of rounding";
  } catch (const std::invalid_argument&) {
    throw;
  } catch (const std::runtime_error& error) {  // NLopt: generic failure of a line search
    search.best.message = std::string("stopped by NLopt: ") + error.what();
  }
  return search.best;
}

}  // namespace catena
