// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "common/input_error.hpp"
#include "common/large_work.hpp"
#include "common/number_text.hpp"
#include "common/whole_file.hpp"
#include "generator/derivation/neutral_proof.hpp"
#include "generator/emission/emitted_files.hpp"
#include "generator/emission/latex_document.hpp"
#include "generator/program/commands.hpp"
#include "generator/program/model_options.hpp"

namespace catena {

namespace {

struct DeriveOptions {
  ModelOptions model;
  std::string output = "generated";
  bool library = false;
  bool any_links = false;
  bool for_fits = false;
  bool latex = false;
  bool equations = false;
  std::string format = "c++";
  std::string layout;  // empty: by the number of links
};

/// Throws InputError where a file would replace one that no derivation wrote. A folder with the
/// header of all models is one of derivations.
void require_own(const std::filesystem::path& folder, const EmittedFiles& files) {
  const auto text_of = [&](const std::string& name) {
    return std::filesystem::is_regular_file(folder / name) ? bytes_of_file(folder / name) : "";
  };
  const auto has = [](const std::string& text, const char* words) {
    return text.find(words) != std::string::npos;
  };
  if (has(text_of("catena_model.h"), "CATENA_MODEL_ABI")) return;
  const auto is_own = [&](const std::string& text) {
    return has(text, "Written by catena-derive") || has(text, R"("kind": "model_summary")");
  };
  for (const auto& [name, text] : files)
    if (const std::string old = text_of(name);
        std::filesystem::exists(folder / name) && old != text && !is_own(old))
      throw InputError((folder / name).string() +
                       " was not written by catena derive and would be replaced; move it away or "
                       "choose another folder (--output)");
}

void write_files(const std::filesystem::path& folder, const EmittedFiles& files) {
  make_folder(folder);
  require_own(folder, files);
  for (const auto& [name, text] : files) write_whole_file(folder / name, text);
}

void write_latex(const DeriveOptions& options, const Description& description) {
  for (const int n : description.links) {
    if (n > kMostLatexLinks) {
      throw InputError("--latex with " + std::to_string(n) + " links: at most " +
                       std::to_string(kMostLatexLinks) + " are written out; give fewer (--links)");
    }
  }
  const std::string name = description.id + ".tex";
  write_files(options.output, {{name, latex_document(description, description.links)}});
  std::printf("written to %s\n", (std::filesystem::path(options.output) / name).c_str());
}

/// Refuses effects that change the chain at their neutral values; certify proves it for the whole
/// model. Two links have every kind of place.
void require_neutral(const Description& description) {
  constexpr int kLinks = 2;
  for (const Effect& effect : description.effects) {
    Description alone = plain_chain();
    alone.effects = {effect};
    if (!why_not_in(alone.space, effect).empty()) alone.space = description.space;
    for (const Proof& proof : prove_neutral(alone, kLinks).proofs) {
      if (proof.equal) continue;
      std::string values;
      for (const EffectParameter& parameter : effect.parameters)
        if (!std::isnan(parameter.neutral))
          values += (values.empty() ? "" : ", ") + parameter.name + " = " +
                    shortest_number(parameter.neutral);
      throw InputError(effect.source_file + ": neutral: at " + values +
                       " the model should be the plain chain, but the effect changes the " +
                       proof.what + "; correct the neutral values or the terms");
    }
  }
}

/// Measured with air_drag_quadratic, the largest of the effects, on one core of 2.5 GHz: in proportion
/// to the links up to 1600, and to the effects.
WorkEstimate estimate_of(const Description& description) {
  const auto effects = static_cast<double>(description.effects.size());
  WorkEstimate estimate;
  for (const int links : description.links) {
    estimate.seconds += links * (0.01 + 0.03 * effects);
    estimate.bytes += links * (0.1e6 + 0.15e6 * effects);
  }
  return estimate;
}

/// What reports show: many links fill pages, and the equations repeat themselves.
void print_equations(const Description& description) {
  nlohmann::ordered_json list = nlohmann::json::array();
  const int links = std::min(description.links.front(), 3);
  for (const LatexEquations& one : derived_equations(description, links)) {
    list.push_back({{"title", one.words}, {"latex", one.latex}});
  }
  std::printf("%s\n", nlohmann::ordered_json{{"links", links}, {"equations", list}}.dump().c_str());
}

void derive(const DeriveOptions& options) {
  const Description description = description_of(options.model, !options.any_links);
  require_neutral(description);
  if (description.space != Space::kPlane) {
    const char* option = options.equations ? "--equations" : options.latex ? "--latex" : nullptr;
    if (option != nullptr)
      throw InputError(std::string(option) + ": " + description.id +
                       " is in space, of which this is not written yet; leave the option away, or "
                       "space = \"3d\"");
  }
  if (options.equations) {
    print_equations(description);
    return;
  }
  if (options.latex) {
    write_latex(options, description);
    return;
  }
  const Language language = language_of(options.format);
  const auto progress = [&](const ModelSummary& s, double seconds) {
    const bool linear = language == Language::kC ? s.mass_structured : s.structured;
    std::printf("%-24s %4d links  %s  %7.2f s\n", s.name.c_str(), s.links,
                linear ? "O(n)   " : "general", seconds);
    std::fflush(stdout);
  };
  if (options.library && language == Language::kC) {
    throw InputError("--library with --format c: the look-up of the models is C++; leave one away");
  }
  if (options.for_fits && language == Language::kC) {
    throw InputError("--for-fits with --format c: such a model is C++; leave one away");
  }
  if (options.any_links && language == Language::kC) {
    throw InputError(
        "--any-links with --format c: the model for any number of links is C++; leave one away");
  }
  require_yes(options.model.yes, "deriving", estimate_of(description));
  std::optional<Layout> layout;
  if (options.for_fits) layout = Layout::kLoops;
  if (!options.layout.empty()) {
    layout = options.layout == "straight" ? Layout::kStraight : Layout::kLoops;
  }
  EmittedFiles files;
  if (!description.links.empty())
    files = emit_files(description, description.links, options.library, progress, layout, language,
                       options.for_fits ? FunctionSet::kFits : FunctionSet::kAll);
  if (options.any_links) files.merge(emit_any_links_files(description));
  write_files(options.output, files);
  std::printf("written to %s\n", options.output.c_str());
}

}  // namespace

void add_derive_command(CLI::App& app, int& status) {
  auto options = std::make_shared<DeriveOptions>();
  CLI::App* command =
      app.add_subcommand("derive", "Derive a model's equations and write them as C++");
  add_model_options(*command, options->model);
  command->add_option("--output", options->output, "folder to write to")->capture_default_str();
  CLI::Option* library = command->add_flag("--library", options->library,
                                           "write what models have in common too: look-up,\n"
                                           "CMake's list, the plain chain of any length");
  CLI::Option* format = add_format_option(*command, options->format);
  CLI::Option* any_links =
      command->add_flag("--any-links", options->any_links,
                        "write the C++ for any number of links too: ID_any.hpp,\n"
                        "ID_any.cpp; alone without --links");
  command
      ->add_flag("--for-fits", options->for_fits,
                 "write only what fits call, in C++; effects at their\n"
                 "neutral values cost nothing")
      ->excludes(library)
      ->excludes(any_links);
  CLI::Option* layout =
      command
          ->add_option("--layout", options->layout, "straight lines or loops; default: the faster")
          ->check(CLI::IsMember({"straight", "loops"}));
  command->add_flag("--latex", options->latex, "write the equations as LaTeX instead, for reading")
      ->excludes(library)
      ->excludes(any_links)
      ->excludes(format)
      ->excludes(layout);
  command
      ->add_flag("--equations", options->equations,
                 "print those of at most 3 links, as reports show them")
      ->excludes(library)
      ->excludes(any_links)
      ->excludes(format)
      ->excludes(layout);
  command->footer("Example: catena derive --links 12 --effect air_drag_quadratic --output drag");
  command->callback([options, &status] {
    derive(*options);
    status = 0;
  });
}

}  // namespace catena
