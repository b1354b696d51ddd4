// SPDX-License-Identifier: BSD-3-Clause
//
// How many links a cable needs: the same 2 m of it, held askew and let go, in more and more links.
// Their number is known only when the program runs; nothing is derived or compiled.
#include <cstdio>
#include <cstdlib>

#include "runtime/any_links.hpp"
#include "runtime/positions.hpp"
#include "runtime/rest_states.hpp"
#include "runtime/simulation.hpp"

int main(int count, char** arguments) {
  const int most = count > 1 ? std::atoi(arguments[1]) : 80;
  for (int links = 5; links <= most; links *= 2) {
    const catena::Model model = catena::any_links_model(links);
    const double length = 2.0 / links, mass = 0.15 * length;  // m, kg
    Eigen::VectorXd parameters = model.default_parameters();
    parameters.segment(0, links).setConstant(length);
    parameters.segment(links, links).setConstant(mass);
    parameters.segment(2 * links, links).setConstant(mass * length * length / 12);
    parameters.segment(3 * links, links).setConstant(0.05 / length);  // N m/rad: EI / length
    parameters.segment(4 * links, links).setConstant(0.01 / length);  // N m s/rad
    parameters[3 * links] *= 2;  // the clamp stands for half a link
    parameters[4 * links] *= 2;
    parameters[model.parameter_index("load_mass")] = 0.5;

    const auto run =
        catena::simulate(model, parameters, catena::straight(model, 0.7), {0.0, 0.5, 1.0});
    if (run.status != catena::Status::kSuccess) return 1;
    const catena::Positions at = catena::positions(model, parameters, 1.0, run.trajectory.q.col(2));
    std::printf("%4d links: load after 1 s at side %.4f m, down %.4f m\n", links,
                at.side[links + 1], at.down[links + 1]);
  }
}
