// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/trajectory.hpp"

#include <string>

#include "common/number_text.hpp"
#include "common/whole_file.hpp"

namespace catena {

void write_trajectory_csv(const std::filesystem::path& file, const Model& model,
                          const Trajectory& trajectory) {
  const catena_model& table = model.table();
  std::string text = "time";
  for (int i = 0; i < model.coordinates(); ++i) text += std::string(",") + table.coordinate[i].name;
  for (int i = 0; i < model.coordinates(); ++i)
    text += std::string(",") + table.coordinate[i].name + "_rate";
  for (int i = 0; i < model.states(); ++i) text += std::string(",") + table.state[i].name;
  text += '\n';
  for (std::size_t k = 0; k < trajectory.time.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    text += exact_number_text(trajectory.time[k]);
    for (const Eigen::MatrixXd* values : {&trajectory.q, &trajectory.v, &trajectory.z})
      for (Eigen::Index i = 0; i < values->rows(); ++i)
        text += ',' + exact_number_text((*values)(i, column));
    text += '\n';
  }
  write_whole_file(file, text);
}

}  // namespace catena
