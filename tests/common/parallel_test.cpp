// SPDX-License-Identifier: BSD-3-Clause
#include "common/parallel.hpp"

#include <dlfcn.h>
#include <doctest/doctest.h>
#include <pthread.h>

#include <cerrno>

namespace {

std::atomic<int> g_threads_left = 0;

}  // namespace

// In the place of the system's: gives so many threads, then none.
extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes,
                              void* (*start)(void*), void* argument) noexcept {
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto create = reinterpret_cast<Create>(dlsym(RTLD_NEXT, "pthread_create"));
  return g_threads_left-- > 0 ? create(thread, attributes, start, argument) : EAGAIN;
}

TEST_CASE("where the system gives no more threads, fewer do all the work") {
  for (const int given : {0, 1, 8}) {
    CAPTURE(given);
    g_threads_left = given;
    std::vector<std::atomic<int>> done(100);
    catena::in_parallel(done.size(), 4, [&](std::size_t i) { ++done[i]; });
    for (const auto& count : done) CHECK(count == 1);
  }
}
