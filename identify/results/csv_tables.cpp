// SPDX-License-Identifier: BSD-3-Clause
#include "identify/results/csv_tables.hpp"

#include <cmath>
#include <tuple>

#include "common/number_text.hpp"

namespace catena {
namespace {

/// A CSV text: first the names, then rows of exact numbers.
class Csv {
 public:
  void name(const std::string& text) { field(text); }
  void number(double value) { field(std::isnan(value) ? "" : exact_number_text(value)); }
  void end_line() {
    text_ += '\n';
    first_ = true;
  }
  void field(const std::string& text) {
    if (!first_) text_ += ',';
    first_ = false;
    const bool plain = text.find_first_of(",\"\n") == std::string::npos;
    if (!plain) text_ += '"';
    for (const char c : text) text_ += c == '"' ? "\"\"" : std::string(1, c);
    if (!plain) text_ += '"';
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
  bool first_ = true;
};

std::string unit_suffix(std::string unit) {
  for (char& c : unit)
    if (c == ' ' || c == '/') c = '_';
  return unit == "1" ? "" : "_" + unit;
}

}  // namespace

std::string positions_csv(const Motion& motion) {
  Csv csv;
  const Eigen::Index ends = motion.side.rows() - 1;
  csv.name("time_s");
  for (Eigen::Index i = 1; i <= ends; ++i) {
    const std::string place = i < ends ? std::to_string(i) : "load";
    csv.name("side_" + place + "_m");
    csv.name("down_" + place + "_m");
    if (motion.across.size()) csv.name("across_" + place + "_m");
  }
  csv.end_line();
  for (Eigen::Index k = 0; k < motion.side.cols(); ++k) {
    csv.number(motion.simulation.trajectory.time[static_cast<std::size_t>(k)]);
    for (Eigen::Index i = 1; i <= ends; ++i) {
      csv.number(motion.side(i, k));
      csv.number(motion.down(i, k));
      if (motion.across.size()) csv.number(motion.across(i, k));
    }
    csv.end_line();
  }
  return csv.take();
}

std::string angles_csv(const Model& model, const Motion& motion) {
  const catena_model& table = model.table();
  const Trajectory& path = motion.simulation.trajectory;
  Csv csv;
  csv.name("time_s");
  const int coordinates = table.coordinates - model.constraints();  // without integrals of a force
  for (int i = 0; i < coordinates; ++i)
    csv.name(table.coordinate[i].name + unit_suffix(table.coordinate[i].unit));
  for (int i = 0; i < coordinates; ++i)
    csv.name(std::string(table.coordinate[i].name) + "_rate" +
             unit_suffix(std::string(table.coordinate[i].unit) + "/s"));
  for (int i = 0; i < table.states; ++i)
    csv.name(table.state[i].name + unit_suffix(table.state[i].unit));
  csv.end_line();
  for (Eigen::Index k = 0; k < path.q.cols(); ++k) {
    csv.number(path.time[static_cast<std::size_t>(k)]);
    for (const double value : path.q.col(k).head(coordinates)) csv.number(value);
    for (const double value : path.v.col(k).head(coordinates)) csv.number(value);
    for (const double value : path.z.col(k)) csv.number(value);
    csv.end_line();
  }
  return csv.take();
}

std::string forces_csv(const Motion& motion) {
  const InternalForces& forces = motion.forces;
  const char* const axes[] = {"side", "down", "across"};
  const std::tuple<const char*, const char*, const Eigen::MatrixXd&> kinds[] = {
      {"moment_", "_N_m", forces.moment},
      {"tension_", "_N", forces.tension},
      {"curvature_", "_rad_m", forces.curvature}};
  std::vector<std::tuple<std::string, const char*, const Eigen::MatrixXd&>> reactions;
  const auto add = [&](const std::string& what, const InternalForces::Reaction& reaction) {
    reactions.emplace_back(what + "_force", "_N", reaction.force);
    reactions.emplace_back(what + "_moment", "_N_m", reaction.moment);
  };
  add("support", forces.support);
  for (const InternalForces::Held& held : forces.held)
    add(held.link == forces.moment.rows() ? "end" : "joint_" + std::to_string(held.link),
        held.reaction);
  Csv csv;
  csv.name("time_s");
  for (const auto& [name, unit, values] : kinds)
    for (Eigen::Index i = 1; i <= values.rows(); ++i) csv.name(name + std::to_string(i) + unit);
  for (const auto& [name, unit, values] : reactions)
    for (Eigen::Index i = 0; i < values.rows(); ++i)
      csv.name(name + (values.rows() == 1 ? std::string() : std::string("_") + axes[i]) + unit);
  csv.end_line();
  for (Eigen::Index k = 0; k < forces.moment.cols(); ++k) {
    csv.number(motion.simulation.trajectory.time[static_cast<std::size_t>(k)]);
    for (const auto& [name, unit, values] : kinds)
      for (const double value : values.col(k)) csv.number(value);
    for (const auto& [name, unit, values] : reactions)
      if (values.size())
        for (const double value : values.col(k)) csv.number(value);
    csv.end_line();
  }
  return csv.take();
}

std::string energy_csv(const Model& model, const Motion& motion) {
  const catena_model& table = model.table();
  const Trajectory& path = motion.simulation.trajectory;
  Csv csv;
  csv.name("time_s");
  for (int i = 0; i < table.energies; ++i) csv.name(std::string(table.energy_item[i].name) + "_J");
  csv.end_line();
  for (Eigen::Index k = 0; k < path.energy.cols(); ++k) {
    csv.number(path.time[static_cast<std::size_t>(k)]);
    for (const double value : path.energy.col(k)) csv.number(value);
    csv.end_line();
  }
  return csv.take();
}

std::string events_csv(const Motion& motion) {
  Csv csv;
  for (const char* name : {"time_s", "event", "change"}) csv.name(name);
  csv.end_line();
  for (const Event& event : motion.simulation.events) {
    csv.number(event.time);
    csv.field(event.name);
    csv.field(event.rising ? "rises" : "falls");
    csv.end_line();
  }
  return csv.take();
}

std::string residuals_csv(const Problem& problem, const Evaluation& evaluation) {
  static const char* const kComponents[] = {"side_m", "down_m", "angle_rad", "across_m"};
  Csv csv;
  for (const char* name :
       {"experiment", "part", "point", "component", "time_s", "measured", "simulated", "residual"})
    csv.name(name);
  csv.end_line();
  for (std::size_t e = 0; e < problem.experiments().size(); ++e) {
    const Experiment& experiment = problem.experiments()[e];
    const Recording& recording = experiment.recording;
    const Eigen::MatrixXd& simulated = evaluation.predictions[e].simulated;
    for (Eigen::Index k = 0; k < simulated.cols(); ++k)
      for (Eigen::Index c = 0; c < simulated.rows(); ++c) {
        const double measured = recording.measured(c, k);
        if (std::isnan(measured)) continue;
        const Channel& channel = recording.channels[static_cast<std::size_t>(c)];
        const bool fit = experiment.fitted() && k < recording.fit_frames;
        csv.field(experiment.spec.name);
        csv.field(fit ? "fit" : "validate");
        csv.field(recording.points[static_cast<std::size_t>(channel.point)].name);
        csv.field(kComponents[static_cast<int>(channel.component)]);
        csv.number(recording.time[static_cast<std::size_t>(k)]);
        csv.number(measured);
        csv.number(simulated(c, k));
        csv.number(simulated(c, k) - measured);
        csv.end_line();
      }
  }
  return csv.take();
}

std::string history_csv(const Problem& problem, const FitResult& fit) {
  Csv csv;
  csv.name("step");
  csv.name("error");
  for (const Unknown& unknown : problem.unknowns()) csv.name(unknown.name);
  csv.end_line();
  for (std::size_t k = 0; k < fit.history.size(); ++k) {
    csv.field(std::to_string(k + 1));
    csv.number(fit.history[k].error);
    for (const double value : fit.history[k].x) csv.number(value);
    csv.end_line();
  }
  return csv.take();
}

}  // namespace catena
