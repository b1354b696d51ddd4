// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <iostream>

#include "identify/ceres/least_squares.hpp"
#include "identify/diagnosis/diagnose.hpp"
#include "identify/program/command.hpp"
#include "identify/program/progress.hpp"

namespace catena {
namespace {

struct DiagnoseOptions : CommonOptions {
  std::vector<std::filesystem::path> effects;
  DiagnosisOptions diagnosis;
  int threads = 2;
};

int diagnose_case(const DiagnoseOptions& options) {
  watch_for_interruption();
  const Case study = read_case(options.case_file);
  const auto folder = output_folder(options);
  std::filesystem::create_directories(folder / "models");
  ProviderOptions provider;
  provider.notice = [](const std::string& line) { std::cerr << "catena: " << line << "\n"; };
  Workshop workshop(study.description, options.effects, folder / "models", fit_least_squares,
                    provider);
  workshop.stop = &interrupted();
  workshop.threads = options.threads;
  workshop.notice = provider.notice;
  const Diagnosis found = diagnose(study, workshop, options.diagnosis);
  std::cout << "verdict: " << name_of(found.verdict) << "\n" << found.sentence << "\n";
  for (const Stage& stage : found.stages) {
    std::cout << fmt::format("stage +{} -{} links {} fit {:.3f} mm ratio {:.3f} misfit {:.3f} colour {:.1f} size {:.1f} held-out {:.3f} floor {:.3f}\n", stage.added, stage.removed, stage.links, 1e3 * stage.fit.rms, stage.fit.ratio(), 1e3*stage.fit.misfit, stage.fit.colour, stage.fit.size, 1e3 * stage.held_out.rms, 1e3*stage.fit.floor);
    std::cout << fmt::format("   finer: {} links predicted {:.3f} mm refitted {} taken {} {}\n", stage.finer.links, 1e3*stage.finer.predicted, stage.finer.refitted, stage.finer.taken, stage.finer.note);
    for (const Explanation& e : stage.explanations) {
      std::cout << fmt::format("   {:24} removes {:.3f} survives {:.3f} adm {} log10p {:.1f} {}", e.id, e.score.share, e.score.survives, e.score.admissible, e.log10_p, e.note);
      if (e.refitted) std::cout << fmt::format(" | refit {:.3f} held {:.3f} misfit share {:.2f} colour {:.1f} crit {:.0f} log10p {:.1f}", 1e3*e.fit.rms, 1e3*e.held_out.rms, e.comparison.misfit_share, e.comparison.colour, e.comparison.criterion, e.comparison.log10_p);
      for (auto& [n, v] : e.start) std::cout << fmt::format(" {}={:.4g}", n, v);
      std::cout << "\n";
    }
  }
  for (auto& a : found.alternatives) std::cout << "alternative " << a.explanation.id << " d " << a.decision.difference << " lead " << a.decision.lead << "\n";
  for (auto& a : found.runners_up) std::cout << "runner-up " << a.explanation.id << " d " << a.decision.difference << " lead " << a.decision.lead << "\n";
  for (auto& p : found.parameters) std::cout << fmt::format("{} = {:.5g} +- {:.2g} {}\n", p.name, p.value, p.standard_error, p.unit);
  std::cout << fmt::format("equality {:.2g} seconds {:.1f}\n", found.equality, found.seconds);
  return interrupted() ? kExitInterrupted : kExitSuccess;
}

}  // namespace

void add_diagnose_command(CLI::App& program, int& exit_status) {
  auto options = std::make_shared<DiagnoseOptions>();
  CLI::App* command = program.add_subcommand("diagnose", "find the effect that a model lacks");
  add_common_options(*command, *options);
  command->add_option("--effect", options->effects, "further effect files to look for")->check(CLI::ExistingFile);
  command->add_option("--max-effects", options->diagnosis.max_effects, "most effects to add")->check(CLI::Range(0, 6));
  command->add_option("--max-links", options->diagnosis.max_links, "most links to try")->check(CLI::Range(1, 500));
  command->add_option("--threads", options->threads, "threads")->check(CLI::Range(1, 64));
  command->callback([options, &exit_status] { exit_status = diagnose_case(*options); });
}

}  // namespace catena
