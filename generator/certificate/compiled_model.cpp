// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/certificate/compiled_model.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace catena {
namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

// Runs a program with its error output in a file. Returns its exit status, -1 if it was killed.
int run(const std::vector<std::string>& command, const std::filesystem::path& errors) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot start " + command[0]);
  if (child == 0) {
    const int file = open(errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (file >= 0) dup2(file, STDERR_FILENO);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

CompiledModel::CompiledModel(const EmittedFiles& files, const std::string& name,
                             Language language) {
  const bool c = language == Language::kC;
  std::string pattern = (std::filesystem::temp_directory_path() / "catena_XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) {
    throw std::runtime_error("cannot make a folder in " +
                             std::filesystem::temp_directory_path().string());
  }
  folder_ = pattern;
  try {
    for (const auto& [file, text] : files) std::ofstream(folder_ / file, std::ios::binary) << text;
    const char* wanted = std::getenv(c ? "CC" : "CXX");
    const std::string compiler = wanted != nullptr && *wanted != '\0' ? wanted : c ? "cc" : "c++";
    const auto library = folder_ / "model.so", errors = folder_ / "errors";
    const int status =
        run({compiler, c ? "-std=c99" : "-std=c++20", "-O0", "-ffp-contract=off", "-shared",
             "-fPIC", "-DCATENA_SHARED_LIBRARY", "-I" + folder_.string(),
             (folder_ / (name + (c ? ".c" : ".cpp"))).string(), "-o", library.string(), "-lm"},
            errors);
    if (status == 127) {
      throw std::runtime_error(compiler +
                               (c ? " cannot be run; a C compiler is needed (set CC to it)"
                                  : " cannot be run; a C++ compiler is needed (set CXX to it)"));
    }
    if (status != 0)
      throw std::runtime_error(compiler + " failed on " + name + ":\n" + text_of(errors));
    library_ = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library_ == nullptr) throw std::runtime_error(std::string("cannot load it: ") + dlerror());
    const std::string symbol = c ? name : CATENA_MODEL_ENTRY;
    const auto entry = reinterpret_cast<catena_model_entry>(dlsym(library_, symbol.c_str()));
    if (entry == nullptr) throw std::runtime_error(name + " has no " + symbol);
    table_ = entry();
  } catch (...) {
    if (library_ != nullptr) dlclose(library_);
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
    throw;
  }
}

CompiledModel::~CompiledModel() {
  dlclose(library_);
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

}  // namespace catena
