// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/trajectory.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "common/input_error.hpp"
#include "tests/runtime/driven_model.hpp"

namespace {

namespace fs = std::filesystem;

struct TemporaryFolder {
  fs::path path = fs::temp_directory_path() / "catena_trajectory_test";
  TemporaryFolder() {
    fs::remove_all(path);
    fs::create_directory(path);
  }
  ~TemporaryFolder() { fs::remove_all(path); }
};

TEST_CASE("a trajectory is written with names and comes back with the same bits") {
  const TemporaryFolder folder;
  const catena::Model model(catena::testing::DrivenModel::table());
  catena::Trajectory trajectory;
  trajectory.time = {0.0, 0.1};
  trajectory.q.resize(2, 2);
  trajectory.q << 1.0 / 3.0, -2e-300, 0.1, 12345.678901234567;
  trajectory.v = trajectory.q * 3.0;
  trajectory.z = Eigen::MatrixXd::Constant(1, 2, 0.7);
  const fs::path file = folder.path / "motion.csv";
  catena::write_trajectory_csv(file, model, trajectory);

  std::ifstream in(file);
  std::string line;
  REQUIRE(std::getline(in, line));
  CHECK(line == "time,theta_1,theta_2,theta_1_rate,theta_2_rate,maxwell.torque_1");
  for (int k = 0; k < 2; ++k) {
    REQUIRE(std::getline(in, line));
    std::istringstream cells(line);
    std::vector<double> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
    CHECK(row == std::vector<double>{trajectory.time[static_cast<std::size_t>(k)],
                                     trajectory.q(0, k), trajectory.q(1, k), trajectory.v(0, k),
                                     trajectory.v(1, k), 0.7});
  }
  CHECK_FALSE(std::getline(in, line));
}

TEST_CASE("where nothing can be written there is an error and no file") {
  const TemporaryFolder folder;
  const catena::Model model(catena::testing::DrivenModel::table());
  const fs::path file = folder.path / "missing" / "motion.csv";
  CHECK_THROWS_AS(catena::write_trajectory_csv(file, model, {}), catena::InputError);
  CHECK(fs::is_empty(folder.path));
}

}  // namespace
