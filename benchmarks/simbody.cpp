// SPDX-License-Identifier: BSD-3-Clause
#include <Simbody.h>
#include <time.h>

#include <functional>

#include "benchmarks/spatial_peer.hpp"

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

Eigen::Vector3d eigen(const SimTK::Vec3& v) { return {v[0], v[1], v[2]}; }
SimTK::Vec3 simtk(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

/// The state of a chain in space whose bodies are those of `matter` after the ground.
SpatialState state_of(const SimTK::SimbodyMatterSubsystem& matter, const SimTK::State& state) {
  SpatialState result;
  for (SimTK::MobilizedBodyIndex i(1); i < matter.getNumBodies(); ++i) {
    const SimTK::MobilizedBody& body = matter.getMobilizedBody(i);
    const SimTK::Rotation& turn = body.getBodyRotation(state);
    Eigen::Matrix3d rotation;
    for (int column = 0; column < 3; ++column)
      rotation.col(column) = eigen(SimTK::Vec3(turn(column)));
    result.rotation.push_back(rotation);
    result.angular_velocity.push_back(eigen(body.getBodyAngularVelocity(state)));
  }
  return result;
}

/// moments(), of whatever state.
class Bending : public SimTK::Force::Custom::Implementation {
 public:
  Bending(const Cable& cable, const SimTK::SimbodyMatterSubsystem& matter)
      : cable_(cable), matter_(matter) {}
  void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& on_bodies,
                 SimTK::Vector_<SimTK::Vec3>&, SimTK::Vector&) const override {
    const Vectors all = moments(cable_, state_of(matter_, state));
    for (std::size_t i = 0; i < all.size(); ++i)
      on_bodies[static_cast<int>(i) + 1][0] += simtk(all[i]);
  }
  SimTK::Real calcPotentialEnergy(const SimTK::State&) const override { return 0; }

 private:
  Cable cable_;
  const SimTK::SimbodyMatterSubsystem& matter_;
};

/// x to the side, y across, z up.
struct SpatialChain {
  explicit SpatialChain(const Cable& cable)
      : matter(system), forces(system), gravity(forces, matter, SimTK::Vec3(0, 0, -cable.gravity)) {
    SimTK::MobilizedBody parent = matter.Ground();
    for (int i = 0; i < cable.links; ++i) {
      const RigidLink link(cable, i);
      const SimTK::Vec3 centre(0, 0, -link.centre), end(0, 0, -cable.length);
      const SimTK::Body::Rigid body(SimTK::MassProperties(
          link.mass, centre, SimTK::Inertia(link.inertia).shiftFromMassCenter(centre, link.mass)));
      parent = SimTK::MobilizedBody::Ball(parent, SimTK::Transform(i == 0 ? SimTK::Vec3(0) : end),
                                          body, SimTK::Transform());
    }
    SimTK::Force::Custom(forces, new Bending(cable, matter));
    system.realizeTopology();
  }

  void put(const SpatialState& from, SimTK::State& state) const {
    int k = 0;
    for (const auto& [turn, rate] : ball_joints(from, SpatialPeer::Frame::kOfParent)) {
      const double parts[] = {turn.w(), turn.x(), turn.y(), turn.z()};
      for (int c = 0; c < 4; ++c) state.updQ()[4 * k + c] = parts[c];
      for (int c = 0; c < 3; ++c) state.updU()[3 * k + c] = rate[c];
      ++k;
    }
  }

  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter;
  SimTK::GeneralForceSubsystem forces;
  SimTK::Force::UniformGravity gravity;
};

/// It computes the moments itself, as part of its forces.
class SpatialSimbody : public SpatialPeer {
 public:
  explicit SpatialSimbody(const Cable& cable) : chain_(cable) {
    state_ = chain_.system.getDefaultState();
    chain_.system.realizeModel(state_);
  }
  const char* name() const override { return "Simbody"; }
  void set(const SpatialState& state) override { chain_.put(state, state_); }
  void accelerate(const Vectors&) override {
    state_.updQ();  // what follows from it is computed again
    chain_.system.realize(state_, SimTK::Stage::Acceleration);
  }
  Vectors relative_accelerations() const override {
    const SimTK::Vector& rates = state_.getUDot();
    Vectors result;
    for (int i = 0; i < rates.size(); i += 3)
      result.emplace_back(rates[i], rates[i + 1], rates[i + 2]);
    return result;
  }
  Frame frame() const override { return Frame::kOfParent; }

 private:
  SpatialChain chain_;
  SimTK::State state_;
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

std::unique_ptr<SpatialPeer> make_simbody_in_space(const Cable& cable) {
  return std::make_unique<SpatialSimbody>(cable);
}

namespace {

/// The motion from a state at the given times; `seen` is what the solution keeps of each.
Solution simulated(const SimTK::MultibodySystem& system, const SimTK::State& start,
                   const std::vector<double>& times, double accuracy,
                   const std::function<Eigen::VectorXd(const SimTK::State&)>& seen) {
  SimTK::CPodesIntegrator integrator(system, SimTK::CPodes::BDF);
  integrator.setAccuracy(accuracy);
  integrator.setInternalStepLimit(100'000'000);
  SimTK::TimeStepper stepper(system, integrator);
  std::vector<Eigen::VectorXd> columns;
  const clock_t begin = clock();
  stepper.initialize(start);
  for (const double time : times) {
    if (time > 0.0) stepper.stepTo(time);
    columns.push_back(seen(integrator.getState()));
  }
  Solution solution;
  solution.cpu_seconds = static_cast<double>(clock() - begin) / CLOCKS_PER_SEC;
  solution.q.resize(columns.front().size(), static_cast<Eigen::Index>(times.size()));
  for (std::size_t k = 0; k < times.size(); ++k)
    solution.q.col(static_cast<Eigen::Index>(k)) = columns[k];
  return solution;
}

}  // namespace

Solution simulate_simbody(const Cable& cable, double rest_angle, const std::vector<double>& times,
                          double accuracy) {
  Chain chain(cable, rest_angle);
  SimTK::State state = chain.system.getDefaultState();
  chain.system.realizeModel(state);
  const Eigen::VectorXd start = relative_angles(cable.start());
  for (int i = 0; i < cable.links; ++i) state.updQ()[i] = start[i];
  return simulated(chain.system, state, times, accuracy, [&](const SimTK::State& now) {
    Eigen::VectorXd q(cable.links);
    for (int i = 0; i < cable.links; ++i) q[i] = now.getQ()[i];
    return absolute_angles(q);
  });
}

Solution simulate_simbody_in_space(const Cable& cable, const std::vector<double>& times,
                                   double accuracy) {
  const SpatialChain chain(cable);
  SimTK::State state = chain.system.getDefaultState();
  chain.system.realizeModel(state);
  chain.put(askew_start(cable), state);
  return simulated(chain.system, state, times, accuracy, [&](const SimTK::State& now) {
    return joints(cable, state_of(chain.matter, now));
  });
}

}  // namespace catena::benchmark
