// SPDX-License-Identifier: BSD-3-Clause
#include <Simbody.h>
#include <time.h>

#include "benchmarks/peer.hpp"

namespace catena::benchmark {
namespace {

/// x to the side, y up; pins turn about z, a positive turn moves a hanging link towards +x.
struct Chain {
  Chain(const Cable& cable, double rest_angle)
      : matter(system), forces(system), gravity(forces, matter, SimTK::Vec3(0, -cable.gravity, 0)) {
    SimTK::MobilizedBody parent = matter.Ground();
    for (int i = 0; i < cable.links; ++i) {
      const SimTK::Vec3 middle(0, -cable.length / 2, 0), end(0, -cable.length, 0);
      SimTK::MassProperties link(
          cable.mass, middle,
          SimTK::Inertia(cable.inertia).shiftFromMassCenter(middle, cable.mass));
      if (i + 1 == cable.links) {  // the load is part of the last link
        const double mass = cable.mass + cable.load;
        link = SimTK::MassProperties(mass, (cable.mass * middle + cable.load * end) / mass,
                                     link.getInertia() + SimTK::Inertia(end, cable.load));
      }
      const SimTK::Body::Rigid body(link);
      const SimTK::Vec3 joint = i == 0 ? SimTK::Vec3(0) : end;
      SimTK::MobilizedBody::Pin next(parent, SimTK::Transform(joint), body, SimTK::Transform());
      SimTK::Force::MobilityLinearSpring(forces, next, SimTK::MobilizerQIndex(0), cable.stiffness,
                                         i == 0 ? rest_angle : 0.0);
      SimTK::Force::MobilityLinearDamper(forces, next, SimTK::MobilizerUIndex(0), cable.damping);
      parent = next;
    }
    system.realizeTopology();
  }

  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter;
  SimTK::GeneralForceSubsystem forces;
  SimTK::Force::UniformGravity gravity;
};

class SimbodyPeer : public Peer {
 public:
  explicit SimbodyPeer(const Cable& cable) : chain_(cable, 0.0) {
    state_ = chain_.system.getDefaultState();
    chain_.system.realizeModel(state_);
  }
  const char* name() const override { return "Simbody"; }
  void accelerations(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                     Eigen::VectorXd& a) override {
    const int n = static_cast<int>(q.size());
    SimTK::Vector& state_q = state_.updQ();
    SimTK::Vector& state_v = state_.updU();
    for (int i = 0; i < n; ++i) {
      state_q[i] = q[i];
      state_v[i] = v[i];
    }
    chain_.system.realize(state_, SimTK::Stage::Acceleration);
    const SimTK::Vector& rates = state_.getUDot();
    for (int i = 0; i < n; ++i) a[i] = rates[i];
  }

 private:
  Chain chain_;
  SimTK::State state_;
};

}  // namespace

std::unique_ptr<Peer> make_simbody(const Cable& cable) {
  return std::make_unique<SimbodyPeer>(cable);
}

Solution simulate_simbody(const Cable& cable, double rest_angle, const std::vector<double>& times,
                          double accuracy) {
  Chain chain(cable, rest_angle);
  SimTK::State state = chain.system.getDefaultState();
  chain.system.realizeModel(state);
  const Eigen::VectorXd start = relative_angles(cable.start());
  for (int i = 0; i < cable.links; ++i) state.updQ()[i] = start[i];
  SimTK::CPodesIntegrator integrator(chain.system, SimTK::CPodes::BDF);
  integrator.setAccuracy(accuracy);
  integrator.setInternalStepLimit(100'000'000);
  SimTK::TimeStepper stepper(chain.system, integrator);
  Solution solution;
  solution.q.resize(cable.links, static_cast<Eigen::Index>(times.size()));
  const clock_t begin = clock();
  stepper.initialize(state);
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (times[k] > 0.0) stepper.stepTo(times[k]);
    Eigen::VectorXd q(cable.links);
    for (int i = 0; i < cable.links; ++i) q[i] = integrator.getState().getQ()[i];
    solution.q.col(static_cast<Eigen::Index>(k)) = absolute_angles(q);
  }
  solution.cpu_seconds = static_cast<double>(clock() - begin) / CLOCKS_PER_SEC;
  return solution;
}

}  // namespace catena::benchmark
