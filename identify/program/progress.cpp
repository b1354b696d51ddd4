// SPDX-License-Identifier: BSD-3-Clause
#include "identify/program/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <iostream>
#include <utility>

namespace catena {

ProgressLine::ProgressLine(bool wanted) : shown_(wanted && isatty(STDERR_FILENO)) {}

ProgressLine::~ProgressLine() { clear_line(); }

void ProgressLine::clear() {
  const std::lock_guard lock(mutex_);
  clear_line();
}

void ProgressLine::clear_line() {
  if (written_) std::cerr << "\r\033[K" << std::flush;
  written_ = false;
}

void ProgressLine::show(double share, const std::string& text) {
  if (!shown_) return;
  const std::lock_guard lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  if (written_ && now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  const double seconds = std::chrono::duration<double>(now - begin_).count();
  std::string line = "\r\033[K" + text;
  if (share > 0) line += fmt::format(", at most {:.0f} s left", seconds * (1 - share) / share);
  std::cerr << line << std::flush;
  written_ = true;
}

Waiting::Waiting(bool wanted, std::function<std::string()> text) : line_(wanted) {
  if (!line_.is_shown()) return;
  thread_ = std::thread([this, text = std::move(text)] {
    const auto begin = std::chrono::steady_clock::now();
    std::unique_lock lock(mutex_);
    auto next = std::chrono::milliseconds(1000);
    while (!over_.wait_until(lock, begin + next, [this] { return is_over_; })) {
      line_.show(0,
                 fmt::format("{}, {:.0f} s", text(), std::chrono::duration<double>(next).count()));
      next += std::chrono::milliseconds(500);
    }
  });
}

Waiting::~Waiting() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  over_.notify_all();
  if (thread_.joinable()) thread_.join();
}

}  // namespace catena
