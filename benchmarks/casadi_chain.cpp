// SPDX-License-Identifier: BSD-3-Clause
//
// casadi_chain LINKS OUTPUT.c: the plain chain as CasADi's users write it, for comparison. Forward dynamics
// by the recursion of articulated bodies in the plane, the residual by the recursion of forces, its tangent
// by CasADi's forward differentiation; written as C. Parameters as catena orders them.
#include <casadi/casadi.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace {

using casadi::SX;

struct Chain {
  explicit Chain(int count)
      : n(count),
        q(SX::sym("q", n)),
        v(SX::sym("v", n)),
        a(SX::sym("a", n)),
        p(SX::sym("p", 6 * n + 2)) {
    for (int i = 0; i < n; ++i) {
      const SX sine = sin(q(i)), cosine = cos(q(i));
      along.push_back(vertcat(sine, cosine));
      across.push_back(vertcat(cosine, -sine));
    }
  }

  SX length(int i) const { return p(i); }
  SX mass(int i) const { return p(n + i); }
  SX inertia(int i) const { return p(2 * n + i); }
  SX load() const { return p(6 * n); }
  SX gravity() const { return vertcat(SX(0), p(6 * n + 1)); }

  /// Moment of the joint above link i.
  SX joint(int i) const {
    const SX bend = i > 0 ? q(i) - q(i - 1) : q(i), rate = i > 0 ? v(i) - v(i - 1) : v(i);
    return p(3 * n + i) * bend + p(4 * n + i) * rate;
  }
  SX moment(int i) const {
    const SX own = p(5 * n + i) - joint(i);
    return i + 1 < n ? own + joint(i + 1) : own;
  }

  SX accelerations() const {
    SX phi = load() * SX::eye(2), force = -load() * gravity();
    std::vector<SX> rows(n), rests(n), pivots(n);
    for (int i = n - 1; i >= 0; --i) {
      const SX l = length(i), m = mass(i), square = v(i) * v(i);
      const SX row = l * mtimes(phi, across[i]) + m * l / 2 * across[i];
      const SX turned = l * mtimes(phi, along[i]);
      pivots[i] = inertia(i) + m * l * l / 4 + l * l * dot(across[i], mtimes(phi, across[i]));
      rests[i] = moment(i) + m * l / 2 * dot(across[i], gravity()) +
                 l * (square * dot(across[i], turned) - dot(across[i], force));
      rows[i] = row;
      force = force - m * gravity() - square * (m * l / 2 * along[i] + turned) +
              row * (rests[i] / pivots[i]);
      phi = m * SX::eye(2) + phi - mtimes(row, row.T()) / pivots[i];
    }
    SX base = SX::zeros(2), out;
    for (int i = 0; i < n; ++i) {
      const SX angular = (rests[i] - dot(rows[i], base)) / pivots[i];
      base = base + length(i) * (angular * across[i] - v(i) * v(i) * along[i]);
      out = vertcat(out, angular);
    }
    return out;
  }

  SX residual() const {
    std::vector<SX> centre(n);
    SX base = SX::zeros(2);
    for (int i = 0; i < n; ++i) {
      const SX half = length(i) / 2 * (a(i) * across[i] - v(i) * v(i) * along[i]);
      centre[i] = base + half;
      base = base + 2 * half;
    }
    SX force = load() * (base - gravity()), out;
    for (int i = n - 1; i >= 0; --i) {
      const SX own = mass(i) * (centre[i] - gravity());
      out =
          vertcat(inertia(i) * a(i) + length(i) * dot(across[i], own / 2 + force) - moment(i), out);
      force = force + own;
    }
    return out;
  }

  int n;
  SX q, v, a, p;
  std::vector<SX> along, across;  // unit vectors (side, down)
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const Chain chain(std::stoi(argv[1]));
  const std::vector<SX> motion = {chain.q, chain.v, chain.a, chain.p};
  const SX dq = SX::sym("dq", chain.n), dv = SX::sym("dv", chain.n), da = SX::sym("da", chain.n);
  const SX r = chain.residual();
  const SX tangent = jtimes(r, vertcat(chain.q, chain.v, chain.a), vertcat(dq, dv, da));
  const std::filesystem::path output = argv[2];
  casadi::CodeGenerator code(output.filename().string());
  code.add(
      casadi::Function("accelerations", {chain.q, chain.v, chain.p}, {cse(chain.accelerations())}));
  code.add(casadi::Function("residual", motion, {cse(r)}));
  code.add(casadi::Function("residual_tangent", {chain.q, chain.v, chain.a, chain.p, dq, dv, da},
                            {cse(tangent)}));
  code.generate(output.parent_path().string() + "/");
  return 0;
}
