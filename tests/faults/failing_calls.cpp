// SPDX-License-Identifier: BSD-3-Clause
//
// Loaded before the system's libraries (LD_PRELOAD): memory or files fail at one call, or from it on.
// failures_test runs programs with it. In the environment:
//
//   FAILING_CALLS  "memory" or "files"
//   FAILING_AT     the number of the call, from 1; 0: none fails
//   FAILING_ON     set: all calls from that one on
//   FAILING_ERROR  the errno of failing files
//   FAILING_IN     the program it is about; what that starts is left alone
//   FAILING_COUNT  a file that gets the number of calls when the program ends, and then the numbers of those
//                  calls that were the first with their stack of callers, if FAILING_STACKS is set
//
// Calls are counted from the begin of main: nothing can catch an exception before.
#include <dlfcn.h>
#include <errno.h>
#include <execinfo.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <new>

namespace {

std::atomic<long> counted = 0;
bool memory = false, files = false, and_on = false;
long fail_at = 0;
int file_error = EIO;
thread_local int depth = 0;  // of calls that are made by calls counted already
constexpr int kDeepest = 256;

// A table of stacks by their hash, without memory that is asked for.
constexpr std::size_t kStacks = 1 << 20;
std::atomic<uint64_t> stacks[kStacks];
std::atomic<long> first_with_stack[kStacks];
bool notes_stacks = false;

void note_stack(long number) {
  void* callers[kDeepest];
  ++depth;
  const int count = backtrace(callers, kDeepest);
  --depth;
  uint64_t hash = 14695981039346656037u;
  for (int i = 0; i < count; ++i)
    hash = (hash ^ reinterpret_cast<uint64_t>(callers[i])) * 1099511628211u;
  hash |= 1;
  for (std::size_t at = (hash >> 20) % kStacks, left = kStacks; left > 0;
       at = (at + 1) % kStacks, --left) {
    uint64_t there = 0;
    if (stacks[at].compare_exchange_strong(there, hash)) {
      first_with_stack[at] = number;
      return;
    }
    if (there == hash) return;
  }
}

bool fails(bool counts) {
  if (!counts || depth > 0) return false;
  const long number = ++counted;
  if (notes_stacks) note_stack(number);
  return fail_at > 0 && (number == fail_at || (and_on && number > fail_at));
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

/// Empty while dlsym, which may ask for memory itself, is looking for it.
template <class Function>
Function next_memory_call(const char* name) {
  static thread_local bool looking = false;
  if (looking) return nullptr;
  looking = true;
  const auto found = next<Function>(name);
  looking = false;
  return found;
}

/// As the next operator new of that name; the memory that it asks for is not counted again.
void* new_call(const char* name, void* (*&real)(std::size_t), std::size_t size) {
  if (!real) real = next<void* (*)(std::size_t)>(name);
  if (fails(memory)) {
    if (const std::new_handler handler = std::get_new_handler()) handler();
    throw std::bad_alloc();
  }
  ++depth;
  void* const got = real(size);
  --depth;
  return got;
}

const char* text_of(const char* name) {
  const char* text = getenv(name);
  return text ? text : "";
}

int (*real_main)(int, char**, char**);

void write_count() {
  files = memory = false;
  FILE* const file = fopen(text_of("FAILING_COUNT"), "w");
  if (!file) return;
  fprintf(file, "%ld\n", counted.load());
  for (const std::atomic<long>& number : first_with_stack)
    if (number > 0) fprintf(file, "%ld\n", number.load());
  fclose(file);
}

int counted_main(int argc, char** argv, char** environment) {
  atexit(write_count);
  if (strcmp(program_invocation_short_name, text_of("FAILING_IN")) == 0) {
    fail_at = atol(text_of("FAILING_AT"));
    and_on = *text_of("FAILING_ON") != 0;
    file_error = atoi(text_of("FAILING_ERROR"));
    memory = strcmp(text_of("FAILING_CALLS"), "memory") == 0;
    files = strcmp(text_of("FAILING_CALLS"), "files") == 0;
    notes_stacks = *text_of("FAILING_STACKS") != 0;
    void* loads_what_backtrace_needs[1];
    ++depth;
    backtrace(loads_what_backtrace_needs, 1);
    --depth;
  }
  return real_main(argc, argv, environment);
}

}  // namespace

extern "C" {

int __libc_start_main(int (*main)(int, char**, char**), int argc, char** argv, void (*init)(),
                      void (*fini)(), void (*rtld_fini)(), void* stack_end) {
  real_main = main;
  return next<decltype(&__libc_start_main)>("__libc_start_main")(counted_main, argc, argv, init,
                                                                 fini, rtld_fini, stack_end);
}

/// SUNDIALS 6 does not look whether its logger got memory: what it asks for does not fail.
// NOLINTNEXTLINE(readability-identifier-naming): the name is of SUNDIALS
int SUNLogger_Create(void* communicator, int rank, void** logger) {
  ++depth;
  const int status =
      next<int (*)(void*, int, void**)>("SUNLogger_Create")(communicator, rank, logger);
  --depth;
  return status;
}

// They serve while the next ones are looked for.
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

#define MEMORY_CALL(NAME, GLIBC, PARAMETERS, ARGUMENTS)            \
  void* NAME PARAMETERS {                                          \
    static void*(*real)PARAMETERS = nullptr;                       \
    if (!real) real = next_memory_call<void*(*)PARAMETERS>(#NAME); \
    if (fails(memory)) {                                           \
      errno = ENOMEM;                                              \
      return nullptr;                                              \
    }                                                              \
    return (real ? real : GLIBC)ARGUMENTS;                         \
  }
MEMORY_CALL(malloc, __libc_malloc, (std::size_t size), (size))
MEMORY_CALL(calloc, __libc_calloc, (std::size_t count, std::size_t size), (count, size))
MEMORY_CALL(realloc, __libc_realloc, (void* old, std::size_t size), (old, size))
MEMORY_CALL(aligned_alloc, __libc_memalign, (std::size_t alignment, std::size_t size),
            (alignment, size))

#define FILE_CALL(RESULT, FAILURE, NAME, PARAMETERS, ARGUMENTS) \
  RESULT NAME PARAMETERS {                                      \
    static RESULT(*real) PARAMETERS = nullptr;                  \
    if (!real) real = next<RESULT(*) PARAMETERS>(#NAME);        \
    if (fails(files)) {                                         \
      errno = file_error;                                       \
      return FAILURE;                                           \
    }                                                           \
    return real ARGUMENTS;                                      \
  }
FILE_CALL(int, -1, open, (const char* path, int flags, mode_t mode), (path, flags, mode))
FILE_CALL(int, -1, open64, (const char* path, int flags, mode_t mode), (path, flags, mode))
FILE_CALL(int, -1, openat, (int at, const char* path, int flags, mode_t mode),
          (at, path, flags, mode))
FILE_CALL(int, -1, openat64, (int at, const char* path, int flags, mode_t mode),
          (at, path, flags, mode))
FILE_CALL(FILE*, nullptr, fopen, (const char* path, const char* mode), (path, mode))
FILE_CALL(FILE*, nullptr, fopen64, (const char* path, const char* mode), (path, mode))
FILE_CALL(ssize_t, -1, read, (int file, void* bytes, std::size_t size), (file, bytes, size))
FILE_CALL(ssize_t, -1, write, (int file, const void* bytes, std::size_t size), (file, bytes, size))
FILE_CALL(ssize_t, -1, writev, (int file, const iovec* parts, int count), (file, parts, count))
FILE_CALL(int, -1, fsync, (int file), (file))
FILE_CALL(int, -1, rename, (const char* from, const char* to), (from, to))
FILE_CALL(int, -1, mkdir, (const char* path, mode_t mode), (path, mode))
FILE_CALL(char*, nullptr, mkdtemp, (char* pattern), (pattern))
}

void* operator new(std::size_t size) {
  static void* (*real)(std::size_t) = nullptr;
  return new_call("_Znwm", real, size);
}

void* operator new[](std::size_t size) {
  static void* (*real)(std::size_t) = nullptr;
  return new_call("_Znam", real, size);
}
