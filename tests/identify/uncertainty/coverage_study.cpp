// SPDX-License-Identifier: BSD-3-Clause
//
// coverage_study FILE RECORDINGS: one line to FILE for each recording with white and with autocorrelated
// noise; those that stand there already are not made again. scripts/study_coverage reads it.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "tests/identify/uncertainty/coverage.hpp"

int main(int argc, char** argv) {
  if (argc != 3 || std::atoi(argv[2]) < 1) {
    std::fputs("coverage_study FILE RECORDINGS\n", stderr);
    return 2;
  }
  std::set<std::string> done;  // "0.6,17"
  std::string kept;
  {
    std::ifstream in(argv[1]);
    std::ostringstream bytes;
    bytes << in.rdbuf();
    kept = bytes.str();
    kept.resize(kept.rfind('\n') == std::string::npos ? 0 : kept.rfind('\n') + 1);  // whole lines
    std::istringstream lines(kept);
    for (std::string line; std::getline(lines, line);)
      done.insert(line.substr(0, line.find(',', line.find(',') + 1)));
  }
  if (!kept.empty()) std::filesystem::resize_file(argv[1], kept.size());
  std::ofstream out(argv[1], kept.empty() ? std::ios::out : std::ios::app);
  out.precision(17);
  const catena::Problem problem = catena::testing::perfect();
  if (kept.empty()) {
    out << "autocorrelation,seed";
    for (const catena::Unknown& unknown : problem.unknowns())
      out << "," << unknown.name << " inside," << unknown.name << " width," << unknown.name
          << " truth";
    out << std::endl;
  }
  for (int seed = 1; seed <= std::atoi(argv[2]); ++seed)
    for (const char* autocorrelation : {"0.0", "0.6"}) {
      const std::string key = std::string(autocorrelation) + "," + std::to_string(seed);
      if (done.contains(key)) continue;
      const catena::testing::Covered covered = catena::testing::covered(
          problem, std::atof(autocorrelation), static_cast<unsigned>(seed));
      out << key;
      for (Eigen::Index j = 0; j < covered.inside.size(); ++j)
        out << "," << covered.inside[j] << "," << covered.width[j] << "," << problem.start()[j];
      out << std::endl;  // at once: a run that is stopped loses one recording
    }
  return out ? 0 : 1;
}
