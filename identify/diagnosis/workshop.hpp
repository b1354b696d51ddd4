// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
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

/// Thrown where a workshop's `stop` was set.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

/// What every part of a diagnosis needs: the effects to look for, models that hold them, a solver,
/// and somebody to tell what is going on.
class Workshop {
 public:
  /// `description`: of the case (empty: the plain chain); `effect_files`: the user's own effects;
  /// `folder`: where descriptions are written.
  Workshop(const std::filesystem::path& description,
           const std::vector<std::filesystem::path>& effect_files, std::filesystem::path folder,
           LeastSquares least_squares, ProviderOptions provider);

  const std::vector<Candidate>& library() const { return library_; }
  const Candidate* find(const std::string& id) const;

  /// Writes the description of the case with these effects of the library.
  void write_description_with(const std::vector<std::string>& effects, int links,
                              const std::string& id, const std::filesystem::path& file) const;

  /// The case's model with every candidate that can share a model, and those of `needed` that
  /// cannot. Derived and compiled once for every number of links: at the neutral values it is the
  /// case's model.
  Model model_with_all(int links, const std::vector<std::string>& needed = {});
  /// The case's model with these effects alone. Several threads may each have theirs made at once.
  Model model_with(const std::vector<std::string>& effects, int links);

  LeastSquares least_squares;
  ProviderOptions provider;
  const std::atomic<bool>* stop = nullptr;
  int threads = 2;
  std::function<void(const std::string&)> notice;  ///< one line on what is being done

  void say(const std::string& text);
  bool stopped() const { return stop && stop->load(); }
  /// Throws Interrupted if somebody wants it to stop.
  void stop_if_asked() const {
    if (stopped()) throw Interrupted();
  }

 private:
  Description original_;
  std::filesystem::path folder_;
  std::vector<Candidate> library_;
  std::map<std::string, std::shared_future<Model>> models_;  // by links and effects
  std::mutex mutex_;
};

}  // namespace catena
