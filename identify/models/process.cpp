// SPDX-License-Identifier: BSD-3-Clause
#include "identify/models/process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

extern char** environ;

namespace catena {
namespace {

constexpr int kPatience = 100;  // ms between looks at `stop`

std::vector<char*> argument_array(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  for (const std::string& argument : command)
    arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  return arguments;
}

[[noreturn]] void fail(const std::string& program, int error, const char* what = "cannot be run") {
  throw std::runtime_error(program + ": " + what + ": " + std::strerror(error));
}

/// A pipe whose ends are closed with it.
struct Pipe {
  std::array<int, 2> ends{-1, -1};
  int error = 0;  ///< of reading

  explicit Pipe(const std::string& program) {
    if (pipe2(ends.data(), O_CLOEXEC) != 0) fail(program, errno);
  }
  ~Pipe() {
    for (const int end : {0, 1}) close_end(static_cast<std::size_t>(end));
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  void close_end(std::size_t end) {
    if (ends[end] >= 0) close(ends[end]);
    ends[end] = -1;
  }
  void read_into(std::string& text) {
    std::array<char, 4096> buffer;
    const ssize_t got = read(ends[0], buffer.data(), buffer.size());
    if (got > 0) text.append(buffer.data(), static_cast<std::size_t>(got));
    if (got < 0 && errno != EINTR) error = errno;
    if (got == 0 || error != 0) close_end(0);
  }
};

/// Ends a process group, kindly first: compilers remove their temporary files.
int end_group(pid_t leader) {
  int status = 0;
  kill(-leader, SIGTERM);
  for (int tenths = 0; tenths < 10; ++tenths) {
    if (waitpid(leader, &status, WNOHANG) == leader) return status;
    poll(nullptr, 0, kPatience);
  }
  kill(-leader, SIGKILL);
  waitpid(leader, &status, 0);
  return status;
}

}  // namespace

ProcessResult run_process(const std::vector<std::string>& command, const std::atomic<bool>* stop) {
  Pipe output(command.front()), errors(command.front());
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, output.ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, errors.ends[1], STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  // A group of its own can be ended with all that it started.
  if (stop) posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t child = 0;
  const int error = posix_spawnp(&child, command.front().c_str(), &actions, &attributes,
                                 argument_array(command).data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  if (error != 0) fail(command.front(), error);
  output.close_end(1);
  errors.close_end(1);
  ProcessResult result;
  const auto ended = [&result](int status) {
    result.exit_status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return result;
  };
  // Both are read as they come: a full pipe would stop the program.
  while (output.ends[0] >= 0 || errors.ends[0] >= 0) {
    std::array<pollfd, 2> open{pollfd{output.ends[0], POLLIN, 0},
                               pollfd{errors.ends[0], POLLIN, 0}};
    if (poll(open.data(), open.size(), stop ? kPatience : -1) < 0 && errno != EINTR) break;
    if (stop && stop->load()) return ended(end_group(child));
    if (open[0].revents != 0) output.read_into(result.output);
    if (open[1].revents != 0) errors.read_into(result.errors);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  for (const int failed : {output.error, errors.error})
    if (failed != 0) fail(command.front(), failed, "what it says cannot be read");
  return ended(status);
}

void become_process(const std::vector<std::string>& command) {
  execvp(command.front().c_str(), argument_array(command).data());
  fail(command.front(), errno);
}

std::filesystem::path program_directory() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path();
}

const char* environment_variable(const char* name) {
  const char* value = std::getenv(name);
  return value && *value ? value : nullptr;
}

}  // namespace catena
