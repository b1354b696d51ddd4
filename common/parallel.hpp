// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace catena {

/// Calls work(0) .. work(count - 1), each once, on up to `threads` threads, the caller's among
/// them; on fewer where the system gives no more. No two calls may write the same data. After an
/// exception no further call begins; the first one is thrown again when all threads have ended.
template <class Work>
void in_parallel(std::size_t count, int threads, const Work& work) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  const auto run = [&] {
    for (std::size_t i; (i = next++) < count;) try {
        work(i);
      } catch (...) {
        const std::scoped_lock lock(mutex);
        if (!failure) failure = std::current_exception();
        next = count;
      }
  };
  std::vector<std::thread> helpers;
  helpers.reserve(std::min(count, static_cast<std::size_t>(std::max(threads, 1))));
  try {
    for (int t = 1; t < threads && static_cast<std::size_t>(t) < count; ++t)
      helpers.emplace_back(run);
  } catch (const std::exception&) {  // too many threads or too little memory for one more
  }
  run();
  for (std::thread& helper : helpers) helper.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace catena
