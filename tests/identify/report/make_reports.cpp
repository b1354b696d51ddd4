// SPDX-License-Identifier: BSD-3-Clause
//
// make_reports FOLDER: writes the reports that the browser test opens.
#include <fstream>
#include <iostream>

#include "identify/report/report.hpp"
#include "tests/identify/report/made_results.hpp"

int main(int argc, char** argv) {
  using namespace catena::report;
  if (argc != 2) {
    std::cerr << "usage: make_reports FOLDER\n";
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  for (const auto& [name, result] :
       {std::pair("simulation", made_simulation(60, 6, 60)),
        std::pair("identification", made_identification(12, 6, 30)),
        std::pair("space", made_identification_in_space(12, 6, 30)),
        std::pair("large", made_identification(60, 6, 60)), std::pair("pendulum", made_pendulum()),
        std::pair("diagnosis", made_diagnosis())}) {
    const auto file = folder / (std::string(name) + ".json");
    std::ofstream(file) << result;
    const Written written =
        write_report(read_document(file), {folder / (std::string(name) + ".html"), {}});
    std::cout << name << ": " << written.figures << " figures, " << written.html_bytes
              << " bytes\n";
  }
}
