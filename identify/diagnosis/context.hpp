// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "description/description.hpp"
#include "identify/diagnosis/candidate.hpp"
#include "identify/fit/fit.hpp"
#include "identify/models/model_provider.hpp"

namespace catena {

/// Thrown where a diagnosis was asked to stop.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

/// How far a diagnosis is.
struct DiagnosisProgress {
  std::string doing;        ///< "refitting with load_drag"
  int done = 0, of = 0;     ///< tasks of this kind; of = 0: not counted
  double seconds_left = 0;  ///< until all of this kind are done, from those that are; NaN: unknown
  std::string best;         ///< the best model so far; empty before there is one
};

/// What every part of a diagnosis needs: the effects to look for, models that hold them, a solver,
/// and somebody to tell what is going on.
class DiagnosisContext {
 public:
  /// `effect_files`: the user's own effects; `folder`: where descriptions are written. Throws
  /// InputError for effects that the case names and nobody knows.
  DiagnosisContext(const Case& the_case, const std::vector<std::filesystem::path>& effect_files,
                   std::filesystem::path folder, LeastSquares least_squares,
                   ProviderOptions provider);

  /// All candidates; one by its id, null if there is none.
  const std::vector<Candidate>& library() const { return library_; }
  const Candidate* find(const std::string& id) const;
  /// Writes an effect file into the folder, and adds the effect to the library, which moves: for
  /// this effect and no others it has models of its own. Throws InputError for a file that is none.
  Candidate& add_effect(const std::string& id, const std::string& text);
  /// Adds a candidate to the library, which moves.
  void add(Candidate candidate) { library_.push_back(std::move(candidate)); }
  /// Whether the library or the case has an effect of this name.
  bool knows(const std::string& id) const;

  /// The description of the case with these effects of the library.
  Description description_with(const std::vector<std::string>& effects, int links,
                               const std::string& id) const;

  /// A model for fits with these effects: the case's model if there are none, else one with every
  /// candidate that can share a model. Derived and compiled once for every number of links. At the
  /// neutral values of the others it is the case's model with these effects, and as fast. An effect
  /// that shares none has a model of its own; beside others it is in one with all that can share one, so that
  /// what is tried beside it needs one model, not one each. Several threads may each have theirs made at once.
  Model model_with(const std::vector<std::string>& effects, int links);
  /// The same with every candidate that can share a model, and those of `needed` that cannot.
  Model model_with_all(int links, const std::vector<std::string>& needed = {});
  /// The case's model with these effects and no others, with all its functions. All three throw
  /// ModelError where a model cannot be made.
  Model complete_model_with(const std::vector<std::string>& effects, int links);

  LeastSquares least_squares;
  ProviderOptions provider;
  const SimulationSpec asked_simulation;  ///< by the case; the search simulates more roughly
  const std::atomic<bool>* stop = nullptr;
  int threads = 2;
  std::function<void(const DiagnosisProgress&)> notice;  ///< told whenever something begins or ends

  /// So many tasks of one kind begin (0: not counted); `doing` says what is done meanwhile.
  void begin(const std::string& doing, std::size_t count = 0);
  /// One of these tasks begins, or ends.
  void begin_task(const std::string& doing);
  void end_task();
  /// The best model so far.
  void tell_best(const std::string& words);
  std::string best() const;

  /// Whether somebody wants it to stop.
  bool stopped() const { return stop && stop->load(); }
  /// Throws Interrupted if somebody wants it to stop.
  void stop_if_asked() const {
    if (stopped()) throw Interrupted();
  }

 private:
  /// Those of these effects that a description of a model has.
  std::vector<std::string> in_model(const std::vector<std::string>& effects) const;
  /// The case's model with these effects and no others.
  Model made_with(const std::vector<std::string>& effects, int links, bool for_fits);
  /// What `make` gives, made once for a key.
  Model once(const std::string& key, const std::function<Model()>& make);
  void tell();  // with progress_mutex_ held

  Description original_;
  std::filesystem::path folder_;
  std::vector<Candidate> library_;
  std::map<std::string, std::shared_future<Model>> models_;  // by links and effects
  std::mutex models_mutex_;
  mutable std::mutex progress_mutex_;
  DiagnosisProgress progress_;
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace catena
