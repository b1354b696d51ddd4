// SPDX-License-Identifier: BSD-3-Clause
#include <mujoco/mujoco.h>
#include <time.h>

#include <cstring>
#include <functional>
#include <sstream>
#include <stdexcept>

#include "benchmarks/spatial_peer.hpp"

namespace catena::benchmark {
namespace {

/// x to the side, z up. `joint`: of each link, from 0.
std::string description(const Cable& cable, const std::string& option,
                        const std::function<std::string(int)>& joint) {
  const int n = cable.links;
  std::ostringstream text;
  text.precision(17);
  text << "<mujoco><size nstack='" << 100000 + 40 * n * n << "' njmax='0' nconmax='0'/>"
       << "<compiler angle='radian' boundmass='0' boundinertia='0'/><option gravity='0 0 "
       << -cable.gravity << "' " << option
       << "><flag contact='disable' constraint='disable' equality='disable' limit='disable' "
          "frictionloss='disable'/></option><worldbody>";
  for (int i = 0; i < n; ++i) {
    const RigidLink link(cable, i);
    text << "<body pos='0 0 " << (i == 0 ? 0.0 : -cable.length) << "'>" << joint(i)
         << "<inertial pos='0 0 " << -link.centre << "' mass='" << link.mass << "' diaginertia='"
         << link.inertia << ' ' << link.inertia << ' ' << link.inertia << "'/>";
  }
  for (int i = 0; i < n; ++i) text << "</body>";
  text << "</worldbody></mujoco>";
  return text.str();
}

/// A positive turn about -y moves a hanging link towards +x.
std::string in_plane(const Cable& cable, double rest_angle, const std::string& option) {
  return description(cable, option, [&](int i) {
    std::ostringstream text;
    text.precision(17);
    text << "<joint type='hinge' axis='0 -1 0' stiffness='" << cable.stiffness << "' damping='"
         << cable.damping << "' springref='" << (i == 0 ? rest_angle : 0.0) << "'/>";
    return text.str();
  });
}

struct Engine {
  explicit Engine(const std::string& text) {
    auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), "chain.xml", static_cast<int>(text.size()));
    std::memcpy(files->filedata[0], text.data(), text.size());
    char error[1000] = "";
    model = mj_loadXML("chain.xml", files.get(), error, sizeof error);
    mj_deleteVFS(files.get());
    if (model == nullptr) throw std::runtime_error(error);
    data = mj_makeData(model);
  }
  ~Engine() {
    mj_deleteData(data);
    mj_deleteModel(model);
  }
  mjModel* model;
  mjData* data;
};

class MujocoPeer : public Peer {
 public:
  explicit MujocoPeer(const Cable& cable) : engine_(in_plane(cable, 0.0, "")) {}
  const char* name() const override { return "MuJoCo"; }
  void accelerations(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                     Eigen::VectorXd& a) override {
    mju_copy(engine_.data->qpos, q.data(), engine_.model->nq);
    mju_copy(engine_.data->qvel, v.data(), engine_.model->nv);
    mj_forward(engine_.model, engine_.data);
    mju_copy(a.data(), engine_.data->qacc, engine_.model->nv);
  }

 private:
  Engine engine_;
};

class SpatialMujoco : public SpatialPeer {
 public:
  explicit SpatialMujoco(const Cable& cable)
      : engine_(description(cable, "", [](int) { return "<joint type='ball'/>"; })) {}
  const char* name() const override { return "MuJoCo"; }
  void set(const SpatialState& state) override {
    positions_.clear();
    rates_.clear();
    for (const auto& [turn, rate] : ball_joints(state, frame())) {
      positions_.insert(positions_.end(), {turn.w(), turn.x(), turn.y(), turn.z()});
      rates_.insert(rates_.end(), rate.begin(), rate.end());
    }
  }
  void accelerate(const Vectors& moments) override {
    mju_copy(engine_.data->qpos, positions_.data(), engine_.model->nq);
    mju_copy(engine_.data->qvel, rates_.data(), engine_.model->nv);
    for (std::size_t i = 0; i < moments.size(); ++i)  // of body i + 1: force, then moment
      mju_copy3(engine_.data->xfrc_applied + 6 * (i + 1) + 3, moments[i].data());
    mj_forward(engine_.model, engine_.data);
  }
  Vectors relative_accelerations() const override {
    Vectors result;
    for (int i = 0; i < engine_.model->nv; i += 3) result.emplace_back(engine_.data->qacc + i);
    return result;
  }
  Frame frame() const override { return Frame::kOfLink; }

 private:
  Engine engine_;
  std::vector<double> positions_, rates_;
};

}  // namespace

std::unique_ptr<Peer> make_mujoco(const Cable& cable) {
  return std::make_unique<MujocoPeer>(cable);
}

std::unique_ptr<SpatialPeer> make_mujoco_in_space(const Cable& cable) {
  return std::make_unique<SpatialMujoco>(cable);
}

Solution simulate_mujoco(const Cable& cable, double rest_angle, const std::vector<double>& times,
                         double time_step, bool runge_kutta) {
  std::ostringstream option;
  option.precision(17);
  option << "timestep='" << time_step << "' integrator='" << (runge_kutta ? "RK4" : "implicit")
         << "'";
  const Engine engine(in_plane(cable, rest_angle, option.str()));
  const Eigen::VectorXd start = relative_angles(cable.start());
  mju_copy(engine.data->qpos, start.data(), engine.model->nq);
  Solution solution;
  solution.q.resize(cable.links, static_cast<Eigen::Index>(times.size()));
  const clock_t begin = clock();
  for (std::size_t k = 0; k < times.size(); ++k) {
    while (engine.data->time < times[k] - time_step / 2) mj_step(engine.model, engine.data);
    const Eigen::VectorXd q = Eigen::Map<Eigen::VectorXd>(engine.data->qpos, cable.links);
    solution.q.col(static_cast<Eigen::Index>(k)) = absolute_angles(q);
  }
  solution.cpu_seconds = static_cast<double>(clock() - begin) / CLOCKS_PER_SEC;
  return solution;
}

}  // namespace catena::benchmark
