// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace catena {

/// One line on standard error that is written over and over, on a terminal only; silent elsewhere.
class ProgressLine {
 public:
  explicit ProgressLine(bool wanted);
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

}  // namespace catena
