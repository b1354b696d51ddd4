// SPDX-License-Identifier: BSD-3-Clause
#include "identify/models/model_provider.hpp"

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "common/in_quotes.hpp"
#include "common/input_error.hpp"
#include "common/most_links.hpp"
#include "common/sha256.hpp"
#include "common/split.hpp"
#include "description/description.hpp"
#include "identify/models/process.hpp"
#include "runtime/any_links.hpp"

namespace catena {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDeriving = "deriving the model";

bool has_fused_multiply_add() {
#if defined(__x86_64__) && defined(__GNUC__)
  // Of x86-64-v3, by names that clang 14 knows, too; no processor has these without the rest.
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
         __builtin_cpu_supports("bmi2");
#else
  return false;
#endif
}

bool has_vectors_of_eight() {
#if defined(__x86_64__) && defined(__GNUC__)
  // Of x86-64-v4.
  return has_fused_multiply_add() && __builtin_cpu_supports("avx512vl") &&
         __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512cd");
#else
  return false;
#endif
}

bool can_run(const fs::path& program) { return access(program.c_str(), X_OK) == 0; }

fs::path find_in_path(const std::string& name) {
  const char* path = environment_variable("PATH");
  for (const std::string_view folder : split(path != nullptr ? path : "", ':'))
    if (!folder.empty() && can_run(fs::path(folder) / name)) return fs::path(folder) / name;
  return {};
}

bool is_there(const std::string& program) {
  return program.find('/') == std::string::npos ? !find_in_path(program).empty() : can_run(program);
}

/// Empty if there is none.
fs::path look_for_derive_program() {
  const std::string name = "catena-derive";
  const fs::path here = program_directory();
  for (const fs::path& candidate :
       {here / name, here / ".." / "libexec" / "catena" / name, here / ".." / "bin" / name})
    if (can_run(candidate)) return candidate.lexically_normal();
  return find_in_path(name);
}

/// Runs a step of making a model. Throws ModelError if it cannot be run.
ProcessResult run(const std::vector<std::string>& command, const std::string& purpose,
                  const std::string& hint, const std::atomic<bool>* stop) {
  try {
    return run_process(command, stop);
  } catch (const std::runtime_error& error) {
    throw ModelError(purpose + ": " + error.what() + hint);
  }
}

[[noreturn]] void fail(const ProcessResult& result, const std::string& program,
                       const std::string& purpose, const std::string& hint) {
  const int signal = result.exit_status - 128;
  throw ModelError(purpose + ": " + program +
                   (signal > 0 ? " was ended by signal " + std::to_string(signal)
                               : " ended with status " + std::to_string(result.exit_status)) +
                   hint + "\n" + (result.errors.empty() ? "It printed no error." : result.errors));
}

/// Runs catena-derive on the description as it was read; what it wrote to standard output. Throws
/// InputError where it finds the description at fault.
std::string run_derivation(const fs::path& derive, const Description& description, int links,
                           const std::vector<std::string>& options, const std::string& purpose,
                           const std::atomic<bool>* stop = nullptr) {
  const WorkFolder copies(temporary_folder(), "catena-derive-");
  std::vector<std::string> command = {derive.string(), "derive", "--links", std::to_string(links)};
  command.insert(command.end(), options.begin(), options.end());
  std::map<std::string, std::string> originals;
  if (!is_plain_chain(description)) {
    const Description copy = copy_as_read(description, copies.path());
    command.insert(command.end(), {"--description", copy.source_file});
    originals[copy.source_file] = description.source_file;
    for (std::size_t i = 0; i < copy.effects.size(); ++i)
      originals[copy.effects[i].source_file] = description.effects[i].source_file;
  }
  ProcessResult result = run(command, purpose, "", stop);
  for (const auto& [copy, original] : originals)
    for (std::size_t at; (at = result.errors.find(copy)) != std::string::npos;)
      result.errors.replace(at, copy.size(), original);
  if (result.exit_status == 2 && !result.errors.empty()) throw InputError(result.errors);
  if (result.exit_status != 0) fail(result, command.front(), purpose, "");
  return result.output;
}

fs::path source_in(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".cpp") return entry.path();
  throw ModelError(folder.string() + ": catena-derive wrote no source file");
}

/// Of the generator, which one diagnosis asks for dozens of times: hashed again when the file changes.
std::string hash_of_program(const fs::path& program) {
  using Version = std::pair<fs::file_time_type, std::uintmax_t>;
  static std::mutex mutex;
  static std::map<fs::path, std::pair<Version, std::string>> known;
  const std::lock_guard lock(mutex);
  auto& [version, hash] = known[program];
  if (const Version now{fs::last_write_time(program), fs::file_size(program)};
      hash.empty() || version != now) {
    hash = sha256_of_file(program);
    version = now;
  }
  return hash;
}

Description description_in(const fs::path& file) {
  return file.empty() ? plain_chain() : read_description(file);
}

}  // namespace

fs::path find_derive_program() {
  if (const fs::path found = look_for_derive_program(); !found.empty()) return found;
  throw ModelError(
      "catena-derive was not found beside this program, in ../libexec/catena or in PATH; it "
      "derives models that are not built in");
}

void derive_model(const Description& description, int links, const fs::path& folder) {
  run_derivation(find_derive_program(), description, links, {"--output", folder.string()},
                 kDeriving);
}

std::string derived_equations(const fs::path& description, int links) {
  return run_derivation(find_derive_program(), description_in(description), links, {"--equations"},
                        "deriving the equations");
}

Model provide_model(const fs::path& description_file, int links, const ProviderOptions& options) {
  const Description description = description_in(description_file);
  const bool plain = is_plain_chain(description);
  if (plain && Model::has_built_in(links)) return Model::built_in(links);

  const bool any_links = plain && links >= kFewestLinks && links <= kMostLinks;
  if (any_links && options.for_fits) return any_links_model(links);
  const auto without_compiling = [&](const std::string& missing) {
    if (options.notice)
      options.notice(missing + " was not found: " + std::to_string(links) +
                     " links are computed by the model for any number of links, with the same "
                     "results");
    return any_links_model(links);
  };
  // What the options name is to be there.
  if (any_links && options.derive_program.empty() && look_for_derive_program().empty())
    return without_compiling("catena-derive");
  const fs::path derive =
      options.derive_program.empty() ? find_derive_program() : options.derive_program;
  if (!can_run(derive)) throw ModelError(derive.string() + ": is no program that can be run");
  std::string compiler = options.compiler;
  if (compiler.empty())
    compiler = environment_variable("CXX") ? environment_variable("CXX") : "c++";
  // In the plane -O2 takes the compiler nearly twice as long where there are many effects, and what it compiles
  // is no faster. In space the motion of 60 links takes a sixth less time with it.
  const bool space = description.space == Space::kThreeDimensional;
  std::vector<std::string> flags = {"-std=c++20", space ? "-O2" : "-O1", "-shared",
                                    "-fPIC",      "-ffp-contract=off",   "-DCATENA_SHARED_LIBRARY"};
  // For this processor alone takes the compiler half the time.
  if (has_fused_multiply_add()) flags.push_back("-march=x86-64-v3");
  if (space) {
    // Loops with roots become vectors, as those of the plane do anyway.
    flags.insert(flags.end(), {"-ftree-vectorize", "-fvect-cost-model=dynamic", "-fno-math-errno",
                               "-fno-trapping-math"});
    // More and longer registers: in space a fifth less time, in the plane none. The last option counts.
    if (has_vectors_of_eight())
      flags.insert(flags.end(), {"-march=x86-64-v4", "-mprefer-vector-width=512"});
  }
  std::string decides = canonical_text(description) + "\nlinks " + std::to_string(links) + "\n" +
                        // models of another generator are not taken from the cache
                        hash_of_program(derive) + "\n" + "interface " +
                        std::to_string(CATENA_MODEL_ABI) + ", " +
                        std::to_string(sizeof(catena_model)) + " bytes\n" + compiler;
  for (const std::string& flag : flags) decides += " " + flag;
  if (options.for_fits) decides += "\nfor fits";
  const ModelCache cache(options.cache_directory.empty() ? ModelCache::default_folder()
                                                         : options.cache_directory);
  const std::string key = sha256_hex(decides);
  if (std::optional<Model> kept = cache.find(key)) return *std::move(kept);
  if (any_links && options.compiler.empty() && !is_there(compiler))
    return without_compiling("the compiler " + compiler);

  if (options.notice) {
    std::string foreign;
    for (const Effect& effect : description.effects)
      if (!effect.source_file.starts_with("built in"))
        foreign += (foreign.empty() ? "" : ", ") +
                   fs::path(effect.source_file).lexically_normal().string();
    options.notice("deriving and compiling the model " + in_quotes(description.id) + " with " +
                   std::to_string(links) + " links (kept in " + cache.folder().string() + ")" +
                   (foreign.empty() ? "" : "; it runs code made from " + foreign));
  }
  const WorkFolder work = cache.work_folder();
  const fs::path sources = work.path() / "model";
  std::vector<std::string> emission = {"--output", sources.string()};
  if (options.for_fits) emission.emplace_back("--for-fits");
  if (options.large_work) emission.emplace_back("--yes");
  run_derivation(derive, description, links, emission, kDeriving, options.stop);

  std::vector<std::string> command = {compiler};
  command.insert(command.end(), flags.begin(), flags.end());
  for (const std::string& argument : {"-I" + sources.string(), source_in(sources).string(),
                                      std::string("-o"), (sources / "model.so").string()})
    command.push_back(argument);
  const std::string purpose = "compiling the model";
  const std::string hint =
      "; a C++ compiler is needed for models that are not built in (set CXX to name one)";
  const ProcessResult compiled = run(command, purpose, hint, options.stop);
  if (compiled.exit_status != 0) fail(compiled, compiler, purpose, hint);
  if (!fs::exists(sources / "model.so"))
    throw ModelError(purpose + ": " + compiler + " ended with status 0, but made no model" + hint);
  return cache.keep(key, sources);
}

}  // namespace catena
