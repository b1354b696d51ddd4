// SPDX-License-Identifier: BSD-3-Clause
//
// coverage_study parameters|predictions FILE RECORDINGS: one line to FILE for each recording of each kind; those
// that stand there already are not made again. scripts/study_coverage reads it.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>
#include <string>

#include "tests/identify/diagnosis/predicted_films.hpp"
#include "tests/identify/uncertainty/coverage.hpp"

namespace {

using namespace catena;

/// What is studied: the names of the columns, and those of one recording.
struct Study {
  std::vector<std::string> kinds;
  std::string kind, columns;  ///< what the kinds are called, and what is said of each
  unsigned first_seed = 1;
  std::function<void(const std::string& kind, unsigned seed, std::ostream& out)> measure;
};

Study of_parameters() {
  const Problem problem = testing::perfect();
  std::string columns;
  for (const Unknown& unknown : problem.unknowns())
    columns += "," + unknown.name + " inside," + unknown.name + " width," + unknown.name + " truth";
  return {
      {"0.0", "0.6"},
      "autocorrelation",
      columns,
      1,
      [problem](const std::string& kind, unsigned seed, std::ostream& out) {
        const testing::Covered covered = testing::covered(problem, std::atof(kind.c_str()), seed);
        for (Eigen::Index j = 0; j < covered.inside.size(); ++j)
          out << "," << covered.inside[j] << "," << covered.width[j] << "," << problem.start()[j];
      }};
}

/// Seeds 1 to 40 belong to the tests.
Study of_predictions() {
  std::string columns;
  for (const char* part : {"held out", "sealed"})
    for (const char* column : {" inside", " width", " truth"})
      columns.append(",").append(part).append(column);
  const auto measure = [](const std::string& kind, unsigned seed, std::ostream& out) {
    const double correlation = kind == "20" ? 0.6 : 0;
    const PredictionErrors errors = testing::errors_of(
        testing::fitted_to({.fitted = std::atoi(kind.c_str()), .correlation = correlation}, seed));
    for (const PredictionError& part : {errors.held_out, errors.sealed})
      out << "," << testing::holds(part) << "," << part.high - part.low << "," << part.observed;
  };
  return {{"60", "8", "20"}, "fitted frames", columns, 1001, measure};
}

/// The lines of a file, which then ends with a whole one.
std::string kept_of(const char* file) {
  std::ifstream in(file);
  std::ostringstream bytes;
  bytes << in.rdbuf();
  std::string kept = bytes.str();
  kept.resize(kept.rfind('\n') == std::string::npos ? 0 : kept.rfind('\n') + 1);
  if (!kept.empty()) std::filesystem::resize_file(file, kept.size());
  return kept;
}

int run(int argc, char** argv) {
  const std::string what = argc == 4 ? argv[1] : "";
  if ((what != "parameters" && what != "predictions") || std::atoi(argv[3]) < 1) {
    std::fputs("coverage_study parameters|predictions FILE RECORDINGS\n", stderr);
    return 2;
  }
  const Study study = what == "parameters" ? of_parameters() : of_predictions();
  const std::string kept = kept_of(argv[2]);
  std::set<std::string> done;  // "0.6,17"
  std::istringstream lines(kept);
  for (std::string line; std::getline(lines, line);)
    done.insert(line.substr(0, line.find(',', line.find(',') + 1)));
  std::ofstream out(argv[2], kept.empty() ? std::ios::out : std::ios::app);
  out.precision(17);
  if (kept.empty()) out << study.kind << ",seed" << study.columns << std::endl;
  for (unsigned number = 0; number < static_cast<unsigned>(std::atoi(argv[3])); ++number)
    for (const std::string& kind : study.kinds) {
      const unsigned seed = study.first_seed + number;
      const std::string key = kind + "," + std::to_string(seed);
      if (done.contains(key)) continue;
      out << key;
      study.measure(kind, seed, out);
      out << std::endl;  // at once: a run that is stopped loses one recording
    }
  return out ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "coverage_study: %s\n", error.what());
    return 1;
  }
}
