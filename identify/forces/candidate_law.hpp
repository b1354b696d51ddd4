// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "identify/forces/law_memory.hpp"
#include "identify/forces/law_terms.hpp"
#include "identify/forces/law_variable.hpp"

namespace catena {

/// A force as a function of one variable of a site: a sum of terms (law_terms.hpp) with free
/// coefficients. Terms of a position count from the middle of the visited range, those of a joint's
/// angle, of a distance and of velocities from 0.
class CandidateLaw {
 public:
  /// What a variable has besides its site.
  struct Numbers {
    ChainVector fixed_point = {};  ///< m, of the distance
    double lag = 0;                ///< s, where it relaxes
  };
  /// `visited`: the motions that the law is to explain.
  CandidateLaw(LawSite site, LawVariable variable, const LawChain& chain,
               const std::vector<LawMotion>& visited, const Numbers& numbers);

  const LawSite& site() const { return site_; }
  /// How many arc lengths of places are free: that of one inside of the cable, those of a pair. The end is known.
  Eigen::Index places() const;
  /// The force is against a velocity, an acceleration or a stretch that relaxes: no coefficient is positive.
  bool against() const { return !has_potential(variable_); }
  /// The force changes with the rates of the turns.
  bool follows_rates() const { return against() || of_tension(); }
  /// The force depends on nothing but the time.
  bool has_time() const { return timed_of(variable_).has_value(); }
  /// What the force looks at besides the state of its time.
  LawMemory memory() const { return {site_, variable_, numbers_.lag}; }
  Eigen::Index terms() const { return static_cast<Eigen::Index>(grammar_.terms.size()); }
  /// Sets of terms that make a formula, simplest first.
  const std::vector<std::vector<int>>& forms() const { return grammar_.forms; }

  /// Numbers that a formula has: coefficients, shapes, the fixed point, the lag.
  double constants(const std::vector<int>& form) const;

  /// Generalised forces on the turns of the links, turns x terms of the form. `state`: (q, v, z), and the memory.
  Eigen::MatrixXd force(const Eigen::VectorXd& state, const std::vector<int>& form) const;
  /// Whether it is friction that holds a joint. The sign of a rate that only noise moves says nothing of it.
  bool sticks(const std::vector<int>& form) const;
  /// What makes its force of the rates, turns x turns: the force over each rate, not its slope, which is nearly zero at
  /// every rate but the smallest ones.
  Eigen::MatrixXd resistance(const Eigen::VectorXd& state, const std::vector<int>& form,
                             const Eigen::VectorXd& coefficients) const;
  /// Of all terms.
  Eigen::MatrixXd force(const Eigen::VectorXd& state) const;

  /// Whether these coefficients make a law: every term is there (least squares give 0 to one that the
  /// others imitate; then a form without it says the same), and it can give no energy: it has a
  /// potential, every term is against the velocity, or it is a mass or a spring before a dashpot, none negative.
  bool admits(const Eigen::VectorXd& coefficients) const;

  /// Numbers that the force of a formula is not linear in: the arc lengths of places inside of the cable, m; the
  /// fixed point, m; the lag, s; the shape of every term that has one, in units of the half width (s
  /// of the time), and its moment, s.
  Eigen::VectorXd numbers(const std::vector<int>& form) const;
  /// Changes of these over which the force is close to linear.
  Eigen::VectorXd steps(const std::vector<int>& form) const;
  /// The law with other numbers; nothing where no law has them.
  std::optional<CandidateLaw> with(const std::vector<int>& form,
                                   const Eigen::VectorXd& numbers) const;
  /// Whether it is a curve against a velocity or what relaxes, of which pieces may be missing.
  bool has_pieces(const std::vector<int>& form) const;
  /// Whether it is a curve of straight pieces: no formula.
  bool is_curve(const std::vector<int>& form) const;
  /// Whether both formulas have terms of the same kinds; of curves against a velocity whether both are odd or none.
  bool has_terms_of(const std::vector<int>& form, const CandidateLaw& other,
                    const std::vector<int>& other_form) const;
  /// Whether both are of the same force and variable at the same site.
  bool same_pair(const CandidateLaw& other) const;
  /// Whether fits of both could find the same law: they differ by nothing but numbers.
  bool differs_by_numbers(const std::vector<int>& form, const CandidateLaw& other,
                          const std::vector<int>& other_form) const;
  /// The same law with sharp steps and edges: for an effect, whose fit needs no force that is linear in the state.
  CandidateLaw sharp() const;
  /// The same law on another chain.
  CandidateLaw on(const LawChain& chain) const;

  std::string force_name() const, variable_name() const;

  struct Constant {
    std::string name, unit;
    double value = 0, deviation = 0;
    bool amplitude = true;        ///< the law vanishes where all of these are zero
    double lower = 0, upper = 0;  ///< what a fit may give it
  };
  /// The law in physical units.
  struct Formula {
    std::string text;  ///< "side force = -linear x (side position - rest)"
    std::vector<Constant> constants;
    /// What follows declares a potential, a dissipation, a mass, a spring before a dashpot, a force or a torque that
    /// goes with the tension (law_effect.cpp).
    enum class Kind {
      kPotential,
      kDissipation,
      kMass,
      kRelaxing,
      kForce,
      kTorque
    } kind = Kind::kPotential;
    bool curve = false;  ///< straight pieces between knots: no formula fits
    /// The integral of -force over the variable in the language of effects (docs/effects.md), that of gravity for a
    /// mass; of the time the force; of a curve of pieces, and with the tension, -force. A place is `offset`
    /// past the middle of a link.
    std::string energy;
    /// Of a curve of pieces: what the energy names. `motion` is the velocity, or what relaxes, which the effect names.
    Definitions definitions;
    /// The velocity or rate along which a spring before a dashpot or a force acts; of a speed its components.
    std::vector<std::string> along;
    std::string variable_unit;
    std::vector<Constant> fixed;  ///< further constants in it, known
  };
  /// `covariance`: of the coefficients and the numbers.
  Formula formula(const std::vector<int>& form, const Eigen::VectorXd& coefficients,
                  const Eigen::MatrixXd& covariance) const;

 private:
  bool has_point() const { return variable_ == LawVariable::kDistance; }
  bool is_distance() const { return has_point() || variable_ == LawVariable::kChord; }
  bool of_tension() const { return variable_ == LawVariable::kTension; }
  bool is_angle() const {
    return variable_ == LawVariable::kJointAngle || variable_ == LawVariable::kCurvature;
  }
  /// Of the visited range.
  void choose_grammar(double least, double most);
  /// `spread`: the root mean square.
  void add_velocity_curves(double spread);
  /// Numbers of the fixed point, if it has one.
  Eigen::Index of_point() const { return has_point() ? numbers_.fixed_point.size() : 0; }
  bool has_lag() const { return relaxing_of(variable_).has_value(); }
  Formula::Kind kind() const;
  /// A factor of a term in physical units. `coefficient`, `deviation`: over the half width, as in a fit.
  Constant amplitude(const std::string& name, int power, double coefficient,
                     double deviation) const;
  /// What a term has in the energy of a formula.
  std::string energy_of(const LawTerm& term, const std::string& symbols) const;
  void add_spring_about_rest(Formula& formula, const Eigen::VectorXd& coefficients,
                             const Eigen::MatrixXd& covariance) const;
  void add_terms(Formula& formula, const std::vector<int>& form,
                 const Eigen::VectorXd& coefficients, const Eigen::VectorXd& deviations) const;
  /// A curve of pieces, or against the time: through which values.
  std::string pieces_in_words(const std::vector<int>& form) const;
  /// Known constants that the energy names.
  void add_fixed(Formula& formula, const std::vector<int>& form) const;
  std::string shape_name(int term) const;
  bool has_moment(int term) const;

  LawSite site_;
  LawVariable variable_;
  LawChain chain_;
  Numbers numbers_;
  LawGrammar grammar_;
  double middle_ = 0, half_ = 1;
};

/// Candidates at a site, each with every variable. For the distance of a place, fixed points around
/// what it visits; for what relaxes, some lags.
std::vector<CandidateLaw> candidates_at(const LawSite& site, const LawChain& chain,
                                        const std::vector<LawMotion>& visited);
/// Forces that depend on nothing but the time.
std::vector<CandidateLaw> candidates_of_time(const LawSite& site, const LawChain& chain,
                                             const std::vector<LawMotion>& visited);

}  // namespace catena
