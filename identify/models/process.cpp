// SPDX-License-Identifier: BSD-3-Clause
#include "identify/models/process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

extern char** environ;

namespace catena {
namespace {

std::vector<char*> argument_array(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  for (const std::string& argument : command)
    arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  return arguments;
}

[[noreturn]] void fail(const std::string& program, int error) {
  throw std::runtime_error(program + ": cannot be run: " + std::strerror(error));
}

}  // namespace

ProcessResult run_process(const std::vector<std::string>& command, bool capture_output) {
  std::array<int, 2> ends{-1, -1};
  if (capture_output && pipe2(ends.data(), O_CLOEXEC) != 0) fail(command.front(), errno);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (capture_output) {
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  }
  pid_t child = 0;
  const int error = posix_spawnp(&child, command.front().c_str(), &actions, nullptr,
                                 argument_array(command).data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (capture_output) close(ends[1]);
  ProcessResult result;
  if (error != 0) {
    if (capture_output) close(ends[0]);
    fail(command.front(), error);
  }
  if (capture_output) {
    std::array<char, 4096> buffer;
    for (ssize_t got; (got = read(ends[0], buffer.data(), buffer.size())) != 0;) {
      if (got > 0) result.output.append(buffer.data(), static_cast<std::size_t>(got));
      if (got < 0 && errno != EINTR) break;
    }
    close(ends[0]);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  result.exit_status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

void become_process(const std::vector<std::string>& command) {
  execvp(command.front().c_str(), argument_array(command).data());
  fail(command.front(), errno);
}

std::filesystem::path program_directory() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path();
}

}  // namespace catena
