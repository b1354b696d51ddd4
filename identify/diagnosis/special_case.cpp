// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/special_case.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace catena {

using Eigen::Index;
using Eigen::VectorXd;

bool is_special_case(const Candidate& special, const Candidate& general, const Model& both) {
  if (special.own_model || general.own_model || special.sensor != general.sensor || special.sensor)
    return false;
  const Index count = both.parameters();
  VectorXd p = both.default_parameters();
  for (Index i = 0; i < count; ++i)
    if (!std::isfinite(p[i]))
      p[i] =
          std::isfinite(both.table().parameter[i].neutral) ? both.table().parameter[i].neutral : 1;
  VectorXd with_special = p, with_general = p;
  const std::size_t special_stem = special.id.size(), general_stem = general.id.size();
  for (const CandidateParameter& parameter : special.parameters) {
    if (parameter.role != ParameterRole::kAmplitude) return false;
    const std::string twin = general.id + parameter.name.substr(special_stem);
    const auto same = std::find_if(general.parameters.begin(), general.parameters.end(),
                                   [&](const CandidateParameter& other) {
                                     return other.name == twin && other.unit == parameter.unit;
                                   });
    if (same == general.parameters.end() || same->name.size() <= general_stem) return false;
    const double value = parameter.neutral + std::min(0.1, parameter.upper - parameter.neutral);
    with_special[both.parameter_index(parameter.name)] = value;
    with_general[both.parameter_index(twin)] = value;
  }
  std::mt19937_64 random(1);
  const Index n = both.coordinates();
  double worst = 0, size = 0;
  for (int state = 0; state < 5; ++state) {
    const auto draw = [&](double scale) {
      return VectorXd(VectorXd::NullaryExpr(
          n, [&] { return scale * (static_cast<double>(random() >> 11) * 0x1.0p-52 - 1); }));
    };
    const VectorXd q = draw(1.5), v = draw(3), a = draw(10);
    const VectorXd z = VectorXd::Zero(both.states()), u = VectorXd::Zero(3 * both.signals());
    VectorXd r[3] = {VectorXd(n), VectorXd(n), VectorXd(n)};
    const VectorXd* values[3] = {&p, &with_special, &with_general};
    for (int k = 0; k < 3; ++k) {
      const catena_point at{0, q.data(), v.data(), a.data(), z.data(), u.data(), values[k]->data()};
      both.residual(at, r[k].data());
    }
    worst = std::max(worst, (r[1] - r[2]).lpNorm<Eigen::Infinity>());
    size = std::max(size, (r[1] - r[0]).lpNorm<Eigen::Infinity>());
  }
  return size > 0 && worst < 1e-9 * size;
}

}  // namespace catena
