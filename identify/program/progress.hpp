// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace catena {

/// One line on standard error that is written over and over, on a terminal only; silent elsewhere.
class ProgressLine {
 public:
  explicit ProgressLine(bool wanted);
  bool is_shown() const { return shown_; }
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// `share` of the work that is done, 0 to 1; the time left is reckoned from it.
  void show(double share, const std::string& text);
  /// Takes the line away, for something else to be written. May be called from several threads, as
  /// show().
  void clear();

 private:
  void clear_line();

  std::mutex mutex_;
  bool shown_;
  bool written_ = false;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point last_;
};

/// Says on a terminal what is being waited for, from the second second on, and how long it has been.
class Waiting {
 public:
  /// `text`: what is going on; asked for every half second, in a thread of its own.
  Waiting(bool wanted, std::function<std::string()> text);
  ~Waiting();
  /// Takes the line away, for something else to be written. May be called from several threads.
  void clear() { line_.clear(); }
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;

 private:
  ProgressLine line_;
  std::mutex mutex_;
  std::condition_variable over_;
  bool is_over_ = false;
  std::thread thread_;
};

}  // namespace catena
