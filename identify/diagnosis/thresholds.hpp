// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace catena {

/// Standard deviations of what a case states and a camera reports, each as a ruler, a balance and a
/// camera on a tripod have them.
struct PlausibleErrors {
  double angle = 0.035;    ///< rad: gravity, the camera, the clamp; 2 degrees
  double place = 5e-3;     ///< m: of a mark, or of the origin
  double time = 0.01;      ///< s: of the first frame; a third of a frame at 30 Hz
  double ratio = 0.02;     ///< scale, lens
  double mass = 0.03;      ///< share of the load, and of the cable's mass per length
  double length = 5e-3;    ///< share of the cable's length
  double turn = 0.1;       ///< rad over the whole cable: a rest shape that is not straight
  double shutter = 0.015;  ///< s: in which a picture is read, a cable's length of it
};

/// The limits that were chosen and on which a verdict depends. Each says its unit, its reason, and the
/// evidence. What is no choice (Student's t, the relative error of a level) and what a numerical method needs
/// (blocks, grids, steps) stands where it is used; the limits of noise stand in identify/noise, those of a
/// missing force and of its law in identify/forces (MissingForceThresholds, LawThresholds).
///
/// "Chosen" means: set on recordings of the kinds of docs/power.md, with other seeds, and not
/// varied since. The rates of docs/power.md are evidence for all of them together. Numbers of trials
/// below are those of 600 trials before that study, with the same limits and other rules of what is
/// left (docs/power/trials_before.csv). A change of any one needs a new power study (scripts/power_study).
struct DiagnosisThresholds {
  // Which part of a recording is for what? (baseline.cpp, sealed_part.cpp)

  /// Share of a recording that is held out where the case holds nothing out: fits keep most of it.
  double held_out_share = 0.3;
  /// Share of what is held out that is sealed: a tenth of such a recording. Two tenths are left to
  /// choose by.
  double sealed_share = 1.0 / 3;
  /// RMS over the scatter of the motion, below which a fit follows it: a fit in step with the motion
  /// leaves less, one out of step about 1.
  double follows = 0.3;

  // Is there a gap? (gap_test.cpp)

  /// Standard deviations. Two tests on each of two parts of a recording: by chance, 4.5 are passed
  /// less than once in 10^5 tests. Evidence: no false alarm on 403 quiet recordings.
  double gap_significance = 4.5;
  /// Misfit over noise. A long recording makes a smaller misfit significant, not important. Evidence:
  /// a smooth misfit of half the noise is found in 200 of 200 recordings (parts_test.cpp).
  double gap_misfit = 0.4;
  /// RMS over noise. The noise is estimated from the same residuals, to some per cent. Evidence: of 403
  /// quiet recordings 95 % lie below 1.11; those above have noise of other kinds, and no other test
  /// passes there.
  double gap_size = 1.15;

  // What is left when an explanation was added (verdict.cpp, remainder.cpp, prediction_errors.cpp,
  // predictive_accuracy.cpp)

  /// What the law of a right effect gets wrong, as a share of what the effect explains: its
  /// coefficient is no constant, and links are no cable. Measured coefficients of drag and of friction
  /// scatter by a tenth from one motion to the next. Effects that leave more than noise and this, beyond
  /// `chance`, do not close the gap (remainder.hpp).
  double law_error = 0.1;
  /// Standard deviations, misfit over noise: too little to look for an effect, too much for a name
  /// at this number of links. Chosen below gap_significance and gap_misfit.
  double trace_significance = 4;
  double trace_misfit = 0.15;
  /// Misfit over noise, below which nothing is called missing. Evidence: no effect was named on 403
  /// quiet recordings.
  double too_small_to_name = 0.6;
  /// RMS over RMS of the held-out part of another model: no worse than that up to the statistical
  /// error of an RMS. Evidence: on a recording of a black cable, where nothing asked for it, a pair
  /// of effects left 10.9 mm held out, three times as much as one of them alone.
  double as_good_held_out = 1.05;

  // Is an explanation acceptable? (choice.cpp)

  /// Probability that the best of all that was tried explains as much by chance
  /// (maximum_statistic.hpp), and that noise and errors of laws leave as much (remainder.hpp). Of 100
  /// gaps with another cause one gets a name; of 100 right effects one is said to leave a gap. A level
  /// that was chosen before any outcome was seen.
  double chance = 0.01;
  /// Share of the squared misfit that an explanation must remove: 5 % of its RMS, as `as_good_held_out` has it.
  double worthwhile = 0.1;
  /// Share of the squared misfit before the first effect that a further one must remove: the square of
  /// `law_error`. What the law of a large effect gets so wrong, others fit.
  double detail = 0.01;
  /// So many effects need only predict the held-out part no worse. Further ones must predict it
  /// better: three can imitate much that is none of them. Trials of docs/power.md hide two at most.
  int effects_unconfirmed = 2;

  /// What a user may have measured wrong. Physics beside a gap is certain if it explains `worthwhile` of
  /// the misfit that these do not (errors_of_knowns.hpp).
  PlausibleErrors errors_of_knowns;

  // Do the data decide between two models? (compare.cpp)

  /// Odds at which chance explains a lead, in what was fitted and in what was held out: one in a
  /// thousand comparisons of two models is decided by chance.
  double odds = 1000;

  // What does a prediction leave? (prediction_errors.cpp)

  /// Of the interval of what is left where nothing was fitted: as for every other interval. 39 recordings are
  /// drawn, the fewest of which the least and the largest are its ends. Chosen before any outcome was seen.
  double prediction_level = 0.95;
  /// RMS over the RMS where it was fitted, from which on a prediction that the interval holds is said not to be
  /// determined: 15 of 16 parts of its square are then none of what the fitted part leaves. Chosen like the level.
  double undetermined = 4;

  // How many links? (links.cpp)

  /// Predicted change over misfit, from which on more links are fitted: the square, 2 %, bounds
  /// what they could explain beside something else. Chosen; it saves time only.
  double links_worth_a_fit = 0.15;
  /// Share of the squared misfit that more links must remove. Chosen; half of `worthwhile`, for a
  /// cable has no links and their number needs no name.
  double links_worthwhile = 0.05;

  // How closely is simulated? (close_simulation.cpp)

  /// Of a simulation in the search, RMS over the noise: its square, 1 %, is what it adds to that of the
  /// residuals. Chosen before any outcome was seen. Evidence that it is needed: of a rod with dry friction, 30 s on an
  /// encoder, the same unknowns leave 2.3 mrad at a tolerance of 1e-6, and 3.2 at 1e-8 and less.
  double simulation_error = 0.1;

  // How far is looked? (diagnosis_state.cpp, diagnose.cpp, search.cpp, candidate_scores.cpp, refits.cpp,
  // pairs.cpp, look_back.cpp, trim.cpp)

  /// RMS over noise, above which the linear score may rank wrongly: more is refitted, from more
  /// starts. Evidence: at strength 10, 43 of 43 names were right.
  double far = 4;
  /// log10 of the probability by chance, and share of the best score, that a score must have for a
  /// refit. Chosen; they save time only.
  double refit_log10_p = -2;
  double refit_score = 0.03;
  /// Further refits where the gap is far.
  int more_refits_when_far = 2;
  /// Times the integrator's steps of the base, beyond which a simulation of a refit has failed: what
  /// whirls or is that stiff is not what was recorded, be it in a model of its own. Chosen; it saves time only. Of 152 refits of one
  /// recording, two that ended at 25 times the base's misfit took 28 of 38 s.
  long steps_of_refits = 20;
  /// FitOptions::stall, for all fits: joints that soften without end fold and whirl ever faster. Chosen; it saves time only. Of 3100
  /// simulations of 3 films that succeeded none took more than 0.85 times the first one's steps from one frame to the next. Of 634 of a magnet that failed
  /// 263 took more than 17 times, and with others like them 200 of 434 s.
  double stall = 2;
  /// Sum of squares over the mean square that a step of a refit must promise: a tenth of what the cheapest decision
  /// needs, the logarithm of some hundred residuals for one unknown (Bayesian information criterion). What is
  /// chosen is fitted as closely as the case asks. Chosen for this reason; it saves time only.
  double worth_a_step = 0.5;
  /// Effects with coordinates or states of their own that are refitted: each costs a model.
  int own_model_refits = 2;
  /// Refits that leave a gap, tried again from other starts, those first of which the linearised model was most wrong:
  /// what sticks and slips has more than one minimum.
  std::size_t tried_elsewhere = 3;
  /// The best explanations that are tried with twice the links, together.
  std::size_t tried_with_more_links = 3;
  /// Pairs: so many first effects, each with so many second ones.
  std::size_t firsts_of_pairs = 4;
  int seconds_of_pairs = 3;
  /// Looks forward and back.
  int rounds = 2;
  /// Standard errors from its neutral value, within which an amplitude is put back there: 95 %.
  double needless_amplitude = 2;
};

inline constexpr DiagnosisThresholds kThresholds;

}  // namespace catena
