// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "description/description.hpp"
#include "description/effect.hpp"
#include "identify/cases/case.hpp"
#include "identify/problem/problem.hpp"

namespace catena {

/// What a parameter of an effect is to the search for it.
enum class ParameterRole {
  kAmplitude,  ///< has a finite neutral value: the trajectory has a slope there
  kShape,      ///< has none (a frequency, a wind speed): means nothing without an amplitude
  kPhase,  ///< a shape of which only sine and cosine matter: found with the amplitude it belongs to
  kLimit,  ///< vanishes at infinity: the slope is taken by its inverse
};

struct CandidateParameter {
  std::string name;  ///< "air_drag_quadratic.normal", as in the model's parameter table
  std::string unit, description;
  double lower = 0, upper = 0;
  double neutral = 0;  ///< kAmplitude only
  double value = 0;    ///< where the search for it starts: the default or the neutral value
  ParameterRole role = ParameterRole::kAmplitude;
  int amplitude = -1;  ///< kPhase: the amplitude it belongs to
  int at_most = -1;    ///< kAmplitude: another one, which this one does not exceed; -1: none
  double deviation = kNotGiven;  ///< kAmplitude: of a normal prior about `neutral`; NaN: none
};

/// One effect that may be missing.
struct Candidate {
  std::string id, title;
  Effect effect;        ///< effect.form_of: of two laws of one effect the name goes to that one
  bool sensor = false;  ///< changes what is reported, not the motion
  /// Its parameters are the case's own: no description of a model has it.
  bool of_case = false;
  /// Brings further coordinates or states: others should not pay for them, and at a limit they have
  /// no neutral value to rest at.
  bool own_model = false;
  /// Depends on time itself: it may bring energy in for ever, as nothing does that is passive.
  bool driven = false;
  std::vector<CandidateParameter> parameters;
  std::string unavailable;  ///< why it cannot be tried here; empty: it can

  /// Indices into `parameters` of those with this role.
  std::vector<int> with_role(ParameterRole role) const;
};

/// Whether a parameter of this name is one of the effect of this id, or is itself what the id says: a known in doubt.
bool belongs_to(const std::string& parameter, const std::string& id);

/// An effect as a candidate; `unavailable` where it can be tried in no case.
Candidate candidate_of(Effect effect);

/// The built-in effects and those of the files given, less what the case has in its model already
/// (`present`): in the order of their ids. What cannot be tried says why: what the case calls impossible,
/// what is rare and which the case does not call possible, what acts only on bodies without mass (a thread
/// has no drag, nor a load that is not there), what another sensor than the case's reports, and what has no
/// meaning in the space of the model. Throws InputError for effects that the case names and nobody knows.
std::vector<Candidate> library_of_candidates(const std::vector<std::filesystem::path>& files,
                                             const Description& present, const Case& the_case);

/// Values of the shape parameters (in the order of candidate.parameters, kShape ones only) at which
/// the score is taken: the frequencies given, velocities of both signs at a sixtieth, a twentieth
/// and a sixth of their bound, other scales around their default. One empty vector if the candidate
/// has no shape.
std::vector<Eigen::VectorXd> shape_grid(const Candidate& candidate,
                                        const std::vector<double>& frequencies);

}  // namespace catena
