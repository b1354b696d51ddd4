// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/derivation/unit_vector_functions.hpp"

namespace catena {

using GiNaC::ex;

namespace {

const GiNaC::numeric kMinusHalf(-1, 2);

// Values, in as many digits as GiNaC is told to use.
ex value_of_squared_angle(const ex& cosine) { return GiNaC::pow(GiNaC::acos(cosine), 2).evalf(); }
ex value_of_angle_over_sine(const ex& cosine) {
  return (GiNaC::acos(cosine) / GiNaC::sqrt(1 - GiNaC::pow(cosine, 2))).evalf();
}
ex value_of_angle_over_sine_slope(const ex& cosine) {
  return ((cosine * value_of_angle_over_sine(cosine) - 1) / (1 - GiNaC::pow(cosine, 2))).evalf();
}
ex value_of_inverse_square_root(const ex& x) { return GiNaC::pow(x, kMinusHalf).evalf(); }

ex simplified_inverse_square_root(const ex& x) {
  return x.is_equal(1) ? ex(1) : inverse_square_root(x).hold();
}

ex derivative_of_squared_angle(const ex& cosine, unsigned) { return -2 * angle_over_sine(cosine); }
ex derivative_of_angle_over_sine(const ex& cosine, unsigned) {
  return angle_over_sine_slope(cosine);
}
ex derivative_of_angle_over_sine_slope(const ex& cosine, unsigned) {
  return angle_over_sine_curvature(cosine);
}
ex derivative_of_inverse_square_root(const ex& x, unsigned) {
  return kMinusHalf * GiNaC::pow(inverse_square_root(x), 3);
}

}  // namespace

REGISTER_FUNCTION(squared_angle,
                  evalf_func(value_of_squared_angle).derivative_func(derivative_of_squared_angle))
REGISTER_FUNCTION(angle_over_sine, evalf_func(value_of_angle_over_sine)
                                       .derivative_func(derivative_of_angle_over_sine))
REGISTER_FUNCTION(angle_over_sine_slope, evalf_func(value_of_angle_over_sine_slope)
                                             .derivative_func(derivative_of_angle_over_sine_slope))
REGISTER_FUNCTION(angle_over_sine_curvature, dummy())
REGISTER_FUNCTION(inverse_square_root, eval_func(simplified_inverse_square_root)
                                           .evalf_func(value_of_inverse_square_root)
                                           .derivative_func(derivative_of_inverse_square_root))
REGISTER_FUNCTION(sign_or_one, dummy())

}  // namespace catena
