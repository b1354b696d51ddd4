// SPDX-License-Identifier: BSD-3-Clause
//
// The model's functions beside code for the same chain: an expert's loops (expert.hpp), and the
// mass matrix and forces that SymPy writes with common subexpressions, solved by Eigen's Cholesky, and
// what CasADi writes (casadi_chain.cpp). Results are compared first; what disagrees ends the program.
//
//   expert_code [--model N library.so | --sympy N library.so | --casadi N library.so]...  >  file.csv
#include <dlfcn.h>

#include <Eigen/Cholesky>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "benchmarks/expert.hpp"
#include "benchmarks/interleaved.hpp"

namespace {

using catena::Model;
using catena::benchmark::Cable;
using catena::benchmark::Expert;
using catena::benchmark::nanoseconds;
using Eigen::VectorXd;

constexpr double kRestAngle = 0.6;               // rad, of joint 1
constexpr double kNewton[] = {1.0, 1e-3, 1e-6};  // of da, dv, dq: a step of about 1 ms

/// One state for all: the start with rates, and accelerations of their own size.
struct Motion {
  explicit Motion(int n)
      : q(Cable(n).start()), v(0.5 * q), a(q), dq(q.reverse()), dv(0.1 * q), da(q.array().sin()) {}
  VectorXd q, v, a, dq, dv, da;
};

void must_agree(const char* what, int links, const VectorXd& one, const VectorXd& other) {
  // Both eliminate in O(n), in another order: rounding grows with the condition, below n^3.
  const double limit = 1e-14 * links * links * links + 1e-12;
  const double difference = (one - other).cwiseAbs().maxCoeff() / one.cwiseAbs().maxCoeff();
  std::fprintf(stderr, "%4d links, %s: differ by %.1e of the largest\n", links, what, difference);
  if (difference < limit) return;
  std::fprintf(stderr, "more than %.1e: not timed\n", limit);
  std::exit(1);
}

void print(int links, const char* what, const char* rival, double ours, double theirs) {
  std::printf("%d,%s,%s,%.4g,%.4g,%.2f\n", links, what, rival, ours, theirs, theirs / ours);
}

void compare_with_expert(const Model& model) {
  const int n = model.links();
  const Cable cable(n);
  const std::unique_ptr<Expert> expert = catena::benchmark::make_expert(cable, kRestAngle);
  if (!expert) return;
  const VectorXd p = cable.parameters(model, kRestAngle);
  const Motion motion(n);
  const VectorXd none = VectorXd::Zero(p.size());
  const catena_point at{0,       motion.q.data(), motion.v.data(), motion.a.data(),
                        nullptr, nullptr,         p.data()};
  const catena_point along{0,       motion.dq.data(), motion.dv.data(), motion.da.data(),
                           nullptr, nullptr,          none.data()};
  const double *q = motion.q.data(), *v = motion.v.data(), *a = motion.a.data();
  VectorXd ours(n), theirs(n), work(model.table().newton_work);
  const auto factor = [&] {
    if (model.newton_factor(at, kNewton[0], kNewton[1], kNewton[2], work.data()) != 0) std::abort();
  };
  const auto expert_factor = [&] {
    expert->newton_factor(q, v, a, kNewton[0], kNewton[1], kNewton[2]);
  };
  struct Row {
    const char* what;
    std::function<void()> ours, theirs;
  };
  const Row rows[] = {
      {"forward dynamics",
       [&] {
         if (model.acceleration(at, ours.data()) != 0) std::abort();
       },
       [&] { expert->accelerations(q, v, theirs.data()); }},
      {"residual", [&] { model.residual(at, ours.data()); },
       [&] { expert->residual(q, v, a, theirs.data()); }},
      {"tangent", [&] { model.residual_tangent(at, along, ours.data()); },
       [&] {
         expert->tangent(q, v, a, motion.dq.data(), motion.dv.data(), motion.da.data(),
                         theirs.data());
       }},
      {"Newton factor and solve",
       [&] {
         factor();
         ours = motion.da;
         model.newton_solve(work.data(), ours.data());
       },
       [&] {
         expert_factor();
         theirs = motion.da;
         expert->newton_solve(theirs.data());
       }},
      {"Newton solve",
       [&] {
         ours = motion.da;
         model.newton_solve(work.data(), ours.data());
       },
       [&] {
         theirs = motion.da;
         expert->newton_solve(theirs.data());
       }},
  };
  for (const Row& row : rows) {
    row.ours();
    row.theirs();
    must_agree(row.what, n, ours, theirs);
    const std::vector<double> times = nanoseconds({row.ours, row.theirs});
    print(n, row.what, "expert", times[0], times[1]);
  }
}

void* opened(const char* library) {
  void* handle = dlopen(library, RTLD_NOW);
  if (handle == nullptr) throw std::runtime_error(dlerror());
  return handle;
}

/// `chain` of what scripts/sympy_chain writes, with the names of p.
struct SympyChain {
  explicit SympyChain(const char* library) {
    void* handle = opened(library);
    evaluate = reinterpret_cast<decltype(evaluate)>(dlsym(handle, "chain"));
    names = static_cast<const char* const*>(dlsym(handle, "chain_parameters"));
  }

  /// l3, m3, I3, k3, c3 and T3 are of link 3; m_c is the load and g gravity.
  VectorXd parameters(const Cable& cable) const {
    const std::map<char, double> of_link = {{'l', cable.length},  {'m', cable.mass},
                                            {'I', cable.inertia}, {'k', cable.stiffness},
                                            {'c', cable.damping}, {'T', 0.0}};
    std::vector<double> p;
    for (const char* const* name = names; *name != nullptr; ++name) {
      const std::string word = *name;
      if (word == "m_c")
        p.push_back(cable.load);
      else if (word == "g")
        p.push_back(cable.gravity);
      else if (word == "T1")
        p.push_back(cable.stiffness * kRestAngle);
      else
        p.push_back(of_link.at(word.front()));
    }
    return Eigen::Map<const VectorXd>(p.data(), static_cast<Eigen::Index>(p.size()));
  }

  void (*evaluate)(const double* q, const double* v, const double* p, double* mass, double* force);
  const char* const* names;
};

template <int N>
void compare_with_sympy(const Model& model, const SympyChain& chain) {
  const VectorXd ours_p = Cable(N).parameters(model, kRestAngle), p = chain.parameters(Cable(N));
  const Motion motion(N);
  const catena_point at{0,       motion.q.data(), motion.v.data(), motion.a.data(),
                        nullptr, nullptr,         ours_p.data()};
  Eigen::Matrix<double, N, N> mass;
  Eigen::Matrix<double, N, 1> force, theirs;
  VectorXd ours(N);
  const auto call = [&] {
    if (model.acceleration(at, ours.data()) != 0) std::abort();
  };
  const auto call_sympy = [&] {
    chain.evaluate(motion.q.data(), motion.v.data(), p.data(), mass.data(), force.data());
    theirs = mass.llt().solve(force);
  };
  call();
  call_sympy();
  must_agree("forward dynamics, SymPy", N, ours, theirs);
  const std::vector<double> times = nanoseconds({call, call_sympy});
  print(N, "forward dynamics", "SymPy", times[0], times[1]);
}

/// A function that CasADi wrote, with its arrays for what is between.
class CasadiFunction {
 public:
  CasadiFunction(void* handle, const std::string& name)
      : evaluate_(reinterpret_cast<Evaluate*>(dlsym(handle, name.c_str()))) {
    const auto sizes = reinterpret_cast<int (*)(long long*, long long*, long long*, long long*)>(
        dlsym(handle, (name + "_work").c_str()));
    long long arguments = 0, results = 0, integers = 0, numbers = 0;
    sizes(&arguments, &results, &integers, &numbers);
    arguments_.resize(static_cast<std::size_t>(arguments));
    results_.resize(static_cast<std::size_t>(results));
    integers_.resize(static_cast<std::size_t>(integers));
    numbers_.resize(static_cast<std::size_t>(numbers));
  }

  void operator()(const std::vector<const VectorXd*>& in, VectorXd& out) {
    for (std::size_t i = 0; i < in.size(); ++i) arguments_[i] = in[i]->data();
    results_[0] = out.data();
    evaluate_(arguments_.data(), results_.data(), integers_.data(), numbers_.data(), 0);
  }

 private:
  using Evaluate = int(const double**, double**, long long*, double*, int);
  Evaluate* evaluate_;
  std::vector<const double*> arguments_;
  std::vector<double*> results_;
  std::vector<long long> integers_;
  std::vector<double> numbers_;
};

void compare_with_casadi(const Model& model, const char* library) {
  const int n = model.links();
  const VectorXd p = Cable(n).parameters(model, kRestAngle);
  const Motion motion(n);
  const VectorXd none = VectorXd::Zero(p.size());
  const catena_point at{0,       motion.q.data(), motion.v.data(), motion.a.data(),
                        nullptr, nullptr,         p.data()};
  const catena_point along{0,       motion.dq.data(), motion.dv.data(), motion.da.data(),
                           nullptr, nullptr,          none.data()};
  void* handle = opened(library);
  VectorXd ours(n), theirs(n);
  const auto compare = [&](const char* what, const char* name, const std::function<void()>& call,
                           const std::vector<const VectorXd*>& in) {
    CasadiFunction function(handle, name);
    const auto call_casadi = [&] { function(in, theirs); };
    call();
    call_casadi();
    must_agree(what, n, ours, theirs);
    const std::vector<double> times = nanoseconds({call, call_casadi});
    print(n, what, "CasADi", times[0], times[1]);
  };
  const VectorXd &q = motion.q, &v = motion.v, &a = motion.a;
  compare("forward dynamics", "accelerations",
          [&] {
            if (model.acceleration(at, ours.data()) != 0) std::abort();
          },
          {&q, &v, &p});
  compare("residual", "residual", [&] { model.residual(at, ours.data()); }, {&q, &v, &a, &p});
  compare("tangent", "residual_tangent", [&] { model.residual_tangent(at, along, ours.data()); },
          {&q, &v, &a, &p, &motion.dq, &motion.dv, &motion.da});
}

}  // namespace

int main(int argc, char** argv) {
  std::map<int, Model> models;
  std::map<int, SympyChain> chains;
  std::map<int, const char*> casadi;
  for (int i = 1; i + 2 < argc; i += 3) {
    const int n = std::stoi(argv[i + 1]);
    if (std::string(argv[i]) == "--sympy")
      chains.emplace(n, argv[i + 2]);
    else if (std::string(argv[i]) == "--casadi")
      casadi.emplace(n, argv[i + 2]);
    else
      models.emplace(n, Model::load(argv[i + 2]));
  }
  for (const int n : Model::built_in_links()) models.emplace(n, Model::built_in(n));
  std::printf("links,what,rival,catena_ns,rival_ns,rival_over_catena\n");
  for (const auto& [n, model] : models) compare_with_expert(model);
  for (const auto& [n, chain] : chains) {
    if (n == 2) compare_with_sympy<2>(models.at(n), chain);
    if (n == 3) compare_with_sympy<3>(models.at(n), chain);
    if (n == 4) compare_with_sympy<4>(models.at(n), chain);
    if (n == 12) compare_with_sympy<12>(models.at(n), chain);
  }
  for (const auto& [n, library] : casadi) compare_with_casadi(models.at(n), library);
  return 0;
}
