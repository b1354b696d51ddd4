// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace catena {

/// Where a place of the chain is and how it moves: side, down (m), their rates (m/s), the angle of
/// its link (rad) and its rate (rad/s).
using PlaceMotion = Eigen::Matrix<double, 6, 1>;

/// The motion of the place at arc length s, and its derivatives by the state (q, v, z).
struct PlaceKinematics {
  PlaceMotion motion;
  Eigen::MatrixXd by_state;  ///< 6 x states
};
/// `state`: (q, v, z) with `coordinates` of q and of v, the angles of the links first.
PlaceKinematics place_kinematics(const Eigen::VectorXd& state, Eigen::Index coordinates,
                                 const Eigen::VectorXd& lengths, double s);

/// Whether a place is the end of the cable, but for rounding.
inline bool at_end(double s, double length) { return s > length * (1 - 1e-6); }

/// A force of a place and the variable that it goes with.
enum class ConjugatePair {
  kSidePosition,
  kDownPosition,
  kSideVelocity,
  kDownVelocity,
  kNormalVelocity,
  kTangentialVelocity,
  kSpeed,
  kAngle,
  kAngularVelocity,
};

/// A force as a function of one variable of the place: a sum of terms with free coefficients. The
/// terms of a position are powers of its distance from the middle of the visited range, from 0 to
/// 3. Those of a velocity are odd: its sign, itself, |v| v and v^3. The sign is smooth,
/// v / sqrt(v^2 + step^2), with a step of 5 % of the largest velocity.
class PlaceLaw {
 public:
  /// `visited`: motions of the place.
  PlaceLaw(ConjugatePair pair, const std::vector<PlaceMotion>& visited);

  bool dissipative() const;  ///< the force is against a velocity
  static constexpr int terms() { return 4; }
  double variable(const PlaceMotion& motion) const;
  /// Terms at a value of the variable, in units of the largest in the visited range.
  Eigen::VectorXd basis(double variable) const;
  /// The forces of each term: (side, down) x terms, or 1 x terms of the torque.
  Eigen::MatrixXd force(const PlaceMotion& motion) const;

  /// Sets of terms that make a formula, simplest first.
  std::vector<std::vector<int>> forms() const;
  /// Whether these coefficients make a law: every term is there (least squares give 0 to one that the
  /// others imitate; then a form without it says the same), and it can give no energy: it is of a
  /// position, or every term is against the velocity.
  bool admits(const Eigen::VectorXd& coefficients) const;

  std::string force_name() const, variable_name() const;

  struct Constant {
    std::string name, unit;
    double value = 0, deviation = 0;
    bool amplitude = true;  ///< the law vanishes where all of these are zero
  };
  /// The law in physical units.
  struct Formula {
    std::string text;  ///< "side force = -linear x (side position - rest)"
    std::vector<Constant> constants;
    bool dissipation = false;  ///< `energy` is one, else a potential
    /// The integral of -force over the variable in the language of effects (docs/effects.md). The
    /// place is `offset` past the middle of a link; the torque is at the pivot.
    std::string energy;
    std::vector<Constant> fixed;  ///< further constants in it, known
  };
  /// `covariance`: of the coefficients.
  Formula formula(const std::vector<int>& form, const Eigen::VectorXd& coefficients,
                  const Eigen::MatrixXd& covariance) const;

 private:
  ConjugatePair pair_;
  double middle_ = 0, half_ = 1;  // of the visited range; of a velocity 0 and the largest
};

/// Those of a place on the cable, or of the torque at the support.
std::vector<PlaceLaw> place_laws(bool torque, const std::vector<PlaceMotion>& visited);

}  // namespace catena
