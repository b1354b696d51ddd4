// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/same_model.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

#include "linear_algebra/decompositions.hpp"

namespace catena {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kStates = 8;
constexpr double kDifferenceStep = 0.1;  // of an amplitude, in its unit
constexpr double kEqual = 1e-6;          // relative: above roundings and the floors of |v|
constexpr double kNothing = 1e-9;        // of the residual: an amplitude that does nothing

/// A candidate, and how r changes with each of its amplitudes that does anything.
struct Span {
  const Candidate* candidate = nullptr;
  MatrixXd slopes;  // kStates * coordinates x amplitudes
};

/// Values between 0.3 and 1.7 where nothing is known: no two terms agree by chance.
VectorXd generic_parameters(const Model& model, std::mt19937_64& random) {
  VectorXd p = model.default_parameters();
  for (Index i = 0; i < p.size(); ++i) {
    const double neutral = model.table().parameter[i].neutral;
    const double drawn = 0.3 + 1.4 * static_cast<double>(random() >> 11) * 0x1.0p-53;
    if (std::isfinite(neutral))
      p[i] = neutral;
    else if (!std::isfinite(p[i]))
      p[i] = drawn;
  }
  return p;
}

/// r at the same random states for any parameters.
VectorXd residuals(const Model& model, const VectorXd& parameters) {
  std::mt19937_64 random(2);
  const Index n = model.coordinates();
  VectorXd stacked(kStates * n);
  for (int state = 0; state < kStates; ++state) {
    const auto draw = [&](double scale) {
      return VectorXd(VectorXd::NullaryExpr(
          n, [&] { return scale * (static_cast<double>(random() >> 11) * 0x1.0p-52 - 1); }));
    };
    const VectorXd q = draw(1.5), v = draw(3), a = draw(10);
    const VectorXd z = VectorXd::Zero(model.states());
    const VectorXd u = VectorXd::Zero(Index{3} * model.signals());
    VectorXd r(n);
    model.residual(
        {0.1 * state, q.data(), v.data(), a.data(), z.data(), u.data(), parameters.data()},
        r.data());
    stacked.segment(state * n, n) = r;
  }
  return stacked;
}

/// Whether a candidate is known by what its amplitudes do at any state.
bool comparable(const Candidate& candidate) {
  return candidate.unavailable.empty() && !candidate.own_model && !candidate.sensor &&
         candidate.with_role(ParameterRole::kAmplitude).size() == candidate.parameters.size();
}

Span span_of(const Candidate& candidate, const Model& all, const VectorXd& parameters,
             const VectorXd& plain) {
  std::vector<VectorXd> columns;
  for (const CandidateParameter& parameter : candidate.parameters) {
    VectorXd changed = parameters;
    const double room = parameter.upper - parameter.neutral;
    changed[all.parameter_index(parameter.name)] += std::min(kDifferenceStep, room);
    const VectorXd slope = residuals(all, changed) - plain;
    if (slope.norm() > kNothing * plain.norm()) columns.push_back(slope.normalized());
  }
  Span span{&candidate, MatrixXd(plain.size(), static_cast<Index>(columns.size()))};
  for (std::size_t j = 0; j < columns.size(); ++j)
    span.slopes.col(static_cast<Index>(j)) = columns[j];
  return span;
}

bool contains(const MatrixXd& space, const MatrixXd& columns) {
  return (space * least_squares(space, columns) - columns).colwise().norm().maxCoeff() < kEqual;
}

bool same(const Span& a, const Span& b) {
  return contains(a.slopes, b.slopes) && contains(b.slopes, a.slopes);
}

int place_of(const Effect& effect) {
  const auto rank = [](Place place) {
    switch (place) {
      case Place::kLoad:
        return 0;
      case Place::kLink:
      case Place::kLinkCentre:
        return 1;
      case Place::kPivot:
        return 2;
      default:
        return 3;
    }
  };
  int first = rank(Place::kAnywhere);
  for (const ForceTerm& term : effect.forces) first = std::min(first, rank(term.at));
  for (const ScalarTerm& term : effect.scalars) first = std::min(first, rank(term.at));
  return first;
}

/// The smaller one has the name.
auto claim(const Span& span) {
  const Effect& effect = span.candidate->effect;
  return std::make_tuple(!effect.form_of.empty(), span.slopes.cols(), place_of(effect), effect.id);
}

}  // namespace

std::map<std::string, std::string> names_of_same_models(const std::vector<Candidate>& library,
                                                        const Model& all) {
  std::mt19937_64 random(1);
  const VectorXd parameters = generic_parameters(all, random);
  const VectorXd plain = residuals(all, parameters);
  std::vector<Span> spans;
  for (const Candidate& candidate : library) {
    if (!comparable(candidate)) continue;
    Span span = span_of(candidate, all, parameters, plain);
    if (span.slopes.cols() > 0) spans.push_back(std::move(span));
  }
  std::sort(spans.begin(), spans.end(),
            [](const Span& a, const Span& b) { return claim(a) < claim(b); });
  std::map<std::string, std::string> names;
  for (auto span = spans.begin(); span != spans.end(); ++span)
    for (auto other = spans.begin(); other != span; ++other)
      if (!names.contains(other->candidate->id) && same(*other, *span)) {
        names[span->candidate->id] = other->candidate->id;
        break;
      }
  return names;
}

}  // namespace catena
