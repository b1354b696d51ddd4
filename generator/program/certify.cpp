// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "common/input_error.hpp"
#include "common/large_work.hpp"
#include "common/whole_file.hpp"
#include "generator/certificate/certificate.hpp"
#include "generator/emission/any_links_writer.hpp"
#include "generator/program/commands.hpp"
#include "generator/program/model_options.hpp"

namespace catena {
namespace {

using Json = nlohmann::ordered_json;

struct CertifyOptions {
  ModelOptions model;
  std::string folder = "generated";
  std::string format = "c++";
  bool write = false;
  bool library = false;
};

std::optional<std::string> text_of(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  return bytes_of_file(path);
}

// Where two texts differ first: "line 12".
std::string first_difference(const std::string& a, const std::string& b) {
  std::size_t at = 0, line = 1;
  while (at < a.size() && at < b.size() && a[at] == b[at]) line += a[at++] == '\n' ? 1 : 0;
  return "line " + std::to_string(line);
}

// Emitted files that are not, byte by byte, what is derived now.
std::vector<std::string> changed_files(const Json& certificate, const EmittedFiles& files,
                                       const std::filesystem::path& folder) {
  std::vector<std::string> changed;
  for (const auto& [name, hash] : certificate.at("exact").at("files").items()) {
    const auto text = text_of(folder / name);
    if (!text) {
      changed.push_back(name + " is not there");
    } else if (*text != files.at(name)) {
      changed.push_back(name + " is not what is derived, from " +
                        first_difference(*text, files.at(name)) + " on");
    }
  }
  return changed;
}

Json certificate_on_file(const std::filesystem::path& path) {
  const auto text = text_of(path);
  if (!text) {
    throw InputError(path.string() + ": there is no such file; write it with certify --write");
  }
  try {
    return Json::parse(*text);
  } catch (const Json::parse_error& error) {
    throw InputError(path.string() + ": not valid JSON: " + error.what());
  }
}

/// Measured with air_drag_quadratic on one core of 2.5 GHz: 20 s for 40 links, 77 s for 80; a third
/// to a half of it without. The exact evaluation, with rational numbers, takes most.
WorkEstimate certificate_estimate(const Description& description) {
  const double by_square = description.effects.empty() ? 0.005 : 0.012;
  WorkEstimate estimate;
  for (const int links : description.links) estimate.seconds += by_square * links * links;
  return estimate;
}

bool certify(const CertifyOptions& options, const Description& description, int links) {
  const Language language = language_of(options.format);
  const EmittedFiles files = emit_files(
      description, {links}, false, [](const ModelSummary&, double) {}, std::nullopt, language);
  const Json now = make_certificate(description, links, files, language);
  const std::string model = now.at("model");
  const std::filesystem::path folder = options.folder,
                              path = folder / certificate_name(model, language);
  std::vector<std::string> problems = failures(now);
  for (const std::string& changed : changed_files(now, files, folder)) problems.push_back(changed);
  if (!options.write) {
    for (const std::string& different : differences(certificate_on_file(path), now)) {
      problems.push_back(different);
    }
  } else if (problems.empty()) {
    write_whole_file(path, now.dump(2) + "\n");
  }
  std::printf("%-24s %s\n", model.c_str(),
              !problems.empty() ? "FAILED"
              : options.write   ? "certified"
                                : "as certified");
  for (const std::string& problem : problems) std::printf("  %s\n", problem.c_str());
  std::fflush(stdout);
  return problems.empty();
}

// What the models have in common: their look-up, the list for CMake, the one for any number.
bool certify_library(const CertifyOptions& options, const Description& description) {
  const EmittedFiles files =
      emit_files(description, description.links, true, [](const ModelSummary&, double) {});
  bool same = true;
  const std::string any_links = any_links_name(description);
  for (const std::string& name :
       {std::string("models.hpp"), std::string("models.cpp"), std::string("CMakeLists.txt"),
        std::string("any_links_table.hpp"), any_links + ".hpp", any_links + ".cpp"}) {
    if (!files.contains(name)) continue;
    const auto text = text_of(std::filesystem::path(options.folder) / name);
    if (text && *text == files.at(name)) continue;
    same = false;
    std::printf("%s is not %s\n", name.c_str(), text ? "what is derived" : "there");
  }
  return same;
}

}  // namespace

void add_certify_command(CLI::App& app, int& status) {
  auto options = std::make_shared<CertifyOptions>();
  CLI::App* command =
      app.add_subcommand("certify", "Compare emitted models with their certificates");
  add_model_options(*command, options->model);
  command->add_option("--folder", options->folder, "where the emitted models are")
      ->capture_default_str();
  add_format_option(*command, options->format);
  command->add_flag("--library", options->library, "compare what models have in common too");
  command->add_flag("--write", options->write, "write the certificates instead of comparing");
  command->footer(
      "Exit status 1 if a byte of the emitted code differs, a proof fails or a number\n"
      "is out of its tolerance.\nExample: catena certify --description generator/models.toml "
      "--folder generated");
  command->callback([options, &status] {
    const Description description = description_of(options->model);
    if (options->library && options->format == "c") {
      throw InputError(
          "--library with --format c: the look-up of the models is C++; leave one away");
    }
    require_yes(options->model.yes, "certifying", certificate_estimate(description));
    for (const int n : description.links) {
      if (!certify(*options, description, n)) status = 1;
    }
    if (options->library && !certify_library(*options, description)) status = 1;
  });
}

}  // namespace catena
