// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "identify/fit/fit.hpp"
#include "identify/fit/shard.hpp"

namespace catena {

// The kinds of refits, with the values that are kept of each.
inline constexpr const char* kBootstrapRefit = "bootstrap";  ///< the unknowns
inline constexpr const char* kProfileRefit = "profile";      ///< verdict, values, as many costs
inline constexpr const char* kEndOfRefits =
    "end";  ///< of a shard: the bootstrap's number, profiles

/// One of the refits that follow a fit.
struct Refit {
  std::string kind;  ///< one of those above
  int index = 0;
  std::string fit;  ///< the fit that it starts from: name_of(FitResult)
  bool operator<(const Refit& other) const {
    return std::tie(kind, index, fit) < std::tie(other.kind, other.index, other.fit);
  }
};

/// Differs between fits that found different values: 16 digits.
std::string name_of(const FitResult& fit);

/// The log of a run of `catena identify`: one line for every finished evaluation, start and refit (of a
/// profile or the bootstrap), appended and handed to the system at once, so that a run that is killed at
/// any moment can be taken up again. Numbers are written exactly. Every line ends with a check of itself and those
/// before it; a last line that was cut off is not believed.
///
/// A start that was finished is taken from the log. One that was not is begun again: it asks for
/// the same points in the same order, and those that were evaluated without derivatives are
/// recalled. So a resumed run ends where it would have ended undisturbed.
class RunLog {
 public:
  /// `key` identifies case, data and model; `unknowns` is their number. With `resume` an existing log
  /// is read and continued; throws InputError if it belongs to another key, or names the line that was
  /// damaged or edited, or that no run writes.
  /// Otherwise the log begins anew. Throws InputError if it cannot be written, or the file is no
  /// log. Where it cannot be written later (a full disk), `notice` is told once, and the run goes on
  /// without.
  RunLog(const std::filesystem::path& file, const std::string& key, Eigen::Index unknowns,
         bool resume, std::function<void(const std::string&)> notice = {});
  ~RunLog();
  RunLog(const RunLog&) = delete;
  RunLog& operator=(const RunLog&) = delete;

  // All may be called from several threads.
  /// What was found for exactly these unknowns; null if it was not recorded.
  const HistoryEntry* recall(int start, const Eigen::VectorXd& x) const;
  /// Appends an evaluation, unless it is the next one that was recorded already.
  void record(int start, const HistoryEntry& entry);
  /// A start that was finished: its result; nothing if it was not.
  std::optional<FitResult> finished(int start) const;
  void finish(int start, const FitResult& result);
  /// What came of a refit; nothing if it was not finished.
  std::optional<Eigen::VectorXd> refitted(const Refit& refit) const;
  void finish(const Refit& refit, const Eigen::VectorXd& values);

  /// Knows from now on, too, what the log of a shard says of finished starts and refits. Throws
  /// InputError as the constructor does, and if another shard's work is in it.
  void take_over(const std::filesystem::path& file, const Shard& shard);
  /// Something that was finished could not be written (`notice` was told).
  bool failed() const { return failed_; }

 private:
  struct Start {
    std::vector<HistoryEntry> entries;        // as read
    std::map<std::string, std::size_t> by_x;  // exact unknowns -> index of their first entry
    std::size_t replayed = 0;                 // how many of them this run asked for again
    std::optional<FitResult> result;
  };

  /// What a log says.
  struct Record {
    std::map<int, Start> starts;
    std::map<Refit, Eigen::VectorXd> refits;
    std::size_t whole = 0;  // bytes of its whole lines
    std::string check;      // of the last of them
  };

  Record read(const std::string& name, const std::string& text) const;
  bool can_be(const Refit& refit, const Eigen::VectorXd& values) const;
  void append(const std::string& content);
  void write(const std::string& line);

  std::string name_, key_;
  Eigen::Index unknowns_;
  std::function<void(const std::string&)> notice_;
  std::FILE* file_ = nullptr;
  std::atomic<bool> failed_ = false;
  std::string check_;  // of the last line
  mutable std::mutex mutex_;
  std::map<int, Start> starts_;
  std::map<Refit, Eigen::VectorXd> refits_;
};

}  // namespace catena
