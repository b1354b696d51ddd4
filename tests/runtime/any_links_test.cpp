// SPDX-License-Identifier: BSD-3-Clause
//
// The one model for any number of links against those derived and compiled for one number: the same
// bits, function by function and in whole simulations.
#include "runtime/any_links.hpp"

#include <doctest/doctest.h>

#include <cstring>
#include <random>
#include <string>
#include <thread>

#include "common/input_error.hpp"
#include "common/most_links.hpp"
#include "runtime/adjoint.hpp"
#include "runtime/batch_dynamics.hpp"
#include "runtime/rest_states.hpp"
#include "runtime/sensitivity.hpp"
#include "tests/runtime/cable_case.hpp"

namespace {

using catena::any_links_model;
using catena::Model;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<Model> single_models() {
  return {Model::load(CHAIN_5), Model::built_in(12), Model::load(CHAIN_37), Model::built_in(60),
          Model::load(CHAIN_240)};
}

/// Numbers from a seed, and what a function wrote: vectors aligned for several directions.
struct Numbers {
  explicit Numbers(std::size_t count) : values((count + 3) / 4) {}
  struct alignas(32) Four {
    double of[4] = {};
  };
  double* data() { return values.data()->of; }
  const double* data() const { return values.data()->of; }
  std::vector<Four> values;
};

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  Numbers numbers(int count, double low, double high) {
    Numbers made(static_cast<std::size_t>(count));
    std::uniform_real_distribution<double> uniform(low, high);
    for (int i = 0; i < count; ++i) made.data()[i] = uniform(engine_);
    return made;
  }

 private:
  std::mt19937 engine_;
};

struct Place {
  Place(Random& random, int n, int several = 1)
      : q(random.numbers(several * n, -3.2, 3.2)),
        v(random.numbers(several * n, -5.0, 5.0)),
        a(random.numbers(several * n, -50.0, 50.0)),
        p(random.numbers(several * (6 * n + 2), 0.1, 1.0)) {}
  catena_point at() const {
    return {0.0, q.data(), v.data(), a.data(), nullptr, nullptr, p.data()};
  }
  Numbers q, v, a, p;
};

bool same_bits(const void* a, const void* b, std::size_t count) {
  return std::memcmp(a, b, count * sizeof(double)) == 0;
}
bool same_bits(const MatrixXd& a, const MatrixXd& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() &&
         same_bits(a.data(), b.data(), static_cast<std::size_t>(a.size()));
}

/// What every function of a table says of one point, one after the other.
std::vector<double> everything(const catena_model& table, unsigned seed) {
  const int n = table.links;
  Random random(seed);
  const Place place(random, n), direction(random, n), directions(random, n, CATENA_DIRECTIONS);
  const Numbers weights = random.numbers(n, -1.0, 1.0);
  const catena_point at = place.at(), along = direction.at(), along_all = directions.at();
  std::vector<double> all;
  const auto keep = [&](int count, const auto& fill) {
    Numbers out(static_cast<std::size_t>(count));
    fill(out.data());
    all.insert(all.end(), out.data(), out.data() + count);
  };
  const auto keep_status = [&](int count, const auto& fill) {
    keep(count, [&](double* out) { all.push_back(fill(out)); });
  };
  keep(n, [&](double* r) { table.residual(table.context, &at, r); });
  keep(n, [&](double* dr) { table.residual_tangent(table.context, &at, &along, dr); });
  keep(CATENA_DIRECTIONS * n,
       [&](double* dr) { table.residual_tangents(table.context, &at, &along_all, dr); });
  for (int term = 0; term < table.terms; ++term)
    keep(n, [&](double* r) { table.residual_term(table.context, &at, term, r); });
  keep(n * n, [&](double* mass) { table.mass_matrix(table.context, &at, mass); });
  keep(n, [&](double* h) { table.bias(table.context, &at, h); });
  keep_status(n, [&](double* a) { return table.acceleration(table.context, &at, a); });
  keep_status(table.batch * n, [&](double* a) {
    Random other(seed + 100);
    struct alignas(64) Set {
      double of[8];
    };
    const auto aligned = [&](int count, double low, double high) {
      const Numbers values = other.numbers(table.batch * count, low, high);
      std::vector<Set> packed(static_cast<std::size_t>(table.batch * count / 8 + 1));
      std::memcpy(packed.data(), values.data(),
                  static_cast<std::size_t>(table.batch * count) * sizeof(double));
      return packed;
    };
    const auto q = aligned(n, -3.2, 3.2), v = aligned(n, -5.0, 5.0),
               p = aligned(6 * n + 2, 0.1, 1.0);
    auto result = aligned(n, 0.0, 0.0);
    const catena_point sets{0.0,     q.data()->of, v.data()->of, nullptr,
                            nullptr, nullptr,      p.data()->of};
    const int failed = table.accelerations(table.context, &sets, result.data()->of);
    std::memcpy(a, result.data(), static_cast<std::size_t>(table.batch * n) * sizeof(double));
    return failed;
  });
  std::vector<double> work(static_cast<std::size_t>(table.newton_work));
  all.push_back(table.newton_factor(table.context, &at, 1.0, 3e-3, 9e-6, work.data()));
  const auto keep_solution = [&](const Numbers& right, int count, const auto& solve) {
    keep(count, [&](double* x) {
      std::copy_n(right.data(), count, x);
      solve(table.context, work.data(), x);
    });
  };
  keep_solution(place.a, n, table.newton_solve);
  keep_solution(place.a, n, table.newton_solve_transposed);
  keep_solution(directions.a, CATENA_DIRECTIONS * n, table.newton_solves);
  keep(table.energies, [&](double* e) { table.energy(table.context, &at, e); });
  const int points = n + 2;
  keep(2 * points, [&](double* x) { table.positions(table.context, &at, x, x + points); });
  keep(2 * points,
       [&](double* x) { table.positions_tangent(table.context, &at, &along, x, x + points); });
  keep(2 * points, [&](double* x) { table.velocities(table.context, &at, x, x + points); });
  keep(3 * n, [&](double* x) { table.internal_forces(table.context, &at, x, x + n, x + 2 * n); });
  keep(2 * n + table.parameters, [&](double* x) {
    table.residual_adjoint(table.context, &at, weights.data(), nullptr, x, x + n, nullptr,
                           x + 2 * n);
  });
  return all;
}

TEST_CASE("every function gives the bits of the model for that number of links") {
  for (const Model& single : single_models()) {
    const Model any = any_links_model(single.links());
    CAPTURE(single.links());
    for (unsigned seed = 1; seed <= 5; ++seed) {
      const std::vector<double> expected = everything(single.table(), seed),
                                got = everything(any.table(), seed);
      REQUIRE(got.size() == expected.size());
      for (std::size_t k = 0; k < got.size(); ++k) {
        CAPTURE(k);
        REQUIRE(std::isfinite(expected[k]));
        REQUIRE(same_bits(&got[k], &expected[k], 1));
      }
    }
  }
}

TEST_CASE("the table's counts and names are those of the model for that number of links") {
  for (const Model& single : single_models()) {
    const Model any = any_links_model(single.links());
    CAPTURE(single.links());
    const catena_model &a = any.table(), &b = single.table();
    CHECK(std::string(a.id) == b.id);
    CHECK(std::string(a.description_hash) == b.description_hash);
    for (const auto count :
         {&catena_model::links, &catena_model::coordinates, &catena_model::states,
          &catena_model::signals, &catena_model::parameters, &catena_model::terms,
          &catena_model::energies, &catena_model::observes, &catena_model::structured,
          &catena_model::batch})
      CHECK(a.*count == b.*count);
    for (int i = 0; i < b.coordinates; ++i) {
      CHECK(std::string(a.coordinate[i].name) == b.coordinate[i].name);
      CHECK(std::string(a.coordinate[i].unit) == b.coordinate[i].unit);
    }
    for (int i = 0; i < b.parameters; ++i) {
      const catena_parameter &one = a.parameter[i], &other = b.parameter[i];
      CHECK(std::string(one.name) == other.name);
      CHECK(std::string(one.unit) == other.unit);
      CHECK(std::string(one.description) == other.description);
      for (const auto value : {&catena_parameter::default_value, &catena_parameter::lower,
                               &catena_parameter::upper, &catena_parameter::neutral})
        CHECK(same_bits(&(one.*value), &(other.*value), 1));
    }
    for (int i = 0; i < b.terms; ++i) CHECK(std::string(a.term[i].name) == b.term[i].name);
    for (int i = 0; i < b.energies; ++i) {
      CHECK(std::string(a.energy_item[i].name) == b.energy_item[i].name);
      CHECK(a.energy_item[i].kind == b.energy_item[i].kind);
    }
  }
}

TEST_CASE(
    "simulations, sensitivities and gradients have the bits of the model for that number of "
    "links") {
  for (const Model& single : single_models()) {
    const Model any = any_links_model(single.links());
    CAPTURE(single.links());
    const auto run = [](const Model& model) {
      const VectorXd p = catena::testing::cable_parameters(model, 20.0, 0.1);
      const auto start = catena::straight(model, 0.6);
      const std::vector<double> times{0.0, 0.05, 0.1};
      const auto forward = catena::simulate_with_sensitivities(
          model, p, start,
          {catena::SensitivityDirection::parameter(model, 0),
           catena::SensitivityDirection::parameter(model, 3 * model.links())},
          times);
      const auto gradient = catena::simulate_with_gradient(
          model, p, start, times,
          [](const catena::Trajectory& motion, catena::Trajectory& slope) { slope.q = motion.q; });
      REQUIRE(forward.status == catena::Status::kSuccess);
      REQUIRE(gradient.status == catena::Status::kSuccess);
      MatrixXd all(forward.trajectory.q.rows(), 0);
      const auto append = [&](const MatrixXd& columns) {
        all.conservativeResize(Eigen::NoChange, all.cols() + columns.cols());
        all.rightCols(columns.cols()) = columns;
      };
      append(forward.trajectory.q);
      append(forward.trajectory.v);
      for (const auto& sensitivity : forward.sensitivity) append(sensitivity.q);
      append(gradient.gradient.q);
      append(gradient.gradient.parameters.head(model.links()));
      return std::make_pair(all, forward.trajectory.energy);
    };
    const auto [expected, expected_energy] = run(single);
    const auto [got, energy] = run(any);
    CHECK(same_bits(got, expected));
    CHECK(same_bits(energy, expected_energy));
  }
}

TEST_CASE("a batch of eight points is evaluated where its arrays fit on the stack") {
  for (const int n : {7, 1000, 1001}) {
    CAPTURE(n);
    const Model model = any_links_model(n);
    CHECK((model.table().batch == 1) == (n > 1000 || any_links_model(7).table().batch == 1));
    catena::BatchDynamics sets(model);
    const VectorXd p = catena::testing::cable_parameters(model, 20.0, 0.1);
    for (int k = 0; k < catena::BatchDynamics::kBatch; ++k) {
      sets.set_parameters(k, p);
      for (int i = 0; i < n; ++i) sets.q(k, i) = 0.1 * k + 0.001 * i;
    }
    REQUIRE(sets.evaluate(0.0) == 0);
    for (int k = 0; k < catena::BatchDynamics::kBatch; ++k) {
      VectorXd q(n), a(n);
      for (int i = 0; i < n; ++i) q[i] = 0.1 * k + 0.001 * i;
      const VectorXd zero = VectorXd::Zero(n);
      const catena_point at{0.0, q.data(), zero.data(), nullptr, nullptr, nullptr, p.data()};
      REQUIRE(model.acceleration(at, a.data()) == 0);
      for (int i = 0; i < n; ++i) {
        const double together = sets.acceleration(k, i);
        REQUIRE(same_bits(&together, &a[i], 1));
      }
    }
  }
}

TEST_CASE("a mass matrix without a pivot is reported at the same place") {
  for (const Model& single : single_models()) {
    const int n = single.links();
    CAPTURE(n);
    const Model any = any_links_model(n);
    VectorXd p = catena::testing::cable_parameters(single, 20.0, 0.1), a(n);
    p.segment(n / 3, n / 2).setZero();  // lengths, and with them what M has of these links
    p.segment(2 * n, n).setZero();      // inertias
    const VectorXd q = VectorXd::Constant(n, 0.3);
    const catena_point at{0.0, q.data(), q.data(), q.data(), nullptr, nullptr, p.data()};
    const int row = single.acceleration(at, a.data());
    CHECK(row > 0);
    CHECK(any.acceleration(at, a.data()) == row);
  }
}

TEST_CASE("the largest fits the stack of a thread, and goes through a simulation's step") {
  const Model model = any_links_model(catena::kMostLinks);
  const int n = model.links();
  REQUIRE(n == 10'000);
  std::thread([&] {
    Random random(3);
    const Place place(random, n), directions(random, n, CATENA_DIRECTIONS);
    const catena_point at = place.at(), along = directions.at();
    const Numbers weights = random.numbers(n, -1.0, 1.0);
    Numbers out(static_cast<std::size_t>(10 * n));
    double* x = out.data();
    const catena_model& table = model.table();
    table.residual_tangents(table.context, &at, &along, x);
    CHECK(std::isfinite(x[CATENA_DIRECTIONS * n - 1]));
    table.residual_adjoint(table.context, &at, weights.data(), nullptr, x, x + n, nullptr,
                           x + 2 * n);
    CHECK(std::isfinite(x[2 * n + 6 * n + 1]));
    table.internal_forces(table.context, &at, x, x + n, x + 2 * n);
    CHECK(std::isfinite(x[3 * n - 1]));
    REQUIRE(table.acceleration(table.context, &at, x) == 0);
    CHECK(std::isfinite(x[n - 1]));
  }).join();
  catena::SimulationOptions options;
  options.relative_tolerance = 1e-4;
  const auto run = catena::simulate(model, catena::testing::cable_parameters(model, 20.0, 0.1),
                                    catena::straight(model, 0.6), {0.0, 1e-6}, options);
  CHECK(run.status == catena::Status::kSuccess);
}

TEST_CASE("few links are built in, and more than can be are refused") {
  CHECK(&any_links_model(3).table() == &Model::built_in(3).table());
  CHECK_THROWS_AS(any_links_model(1), catena::InputError);
  CHECK_THROWS_AS(any_links_model(-7), catena::InputError);
  CHECK_THROWS_WITH_AS(any_links_model(10'001),
                       "a model of 10001 links: at most 10000 are possible", catena::InputError);
}

/// Height of the load under the support, hanging straight: the sum of the lengths.
double hanging_length(const Model& model) {
  const int n = model.links();
  const VectorXd p = catena::testing::cable_parameters(model, 20.0, 0.1);
  const VectorXd q = VectorXd::Zero(n);
  VectorXd side(n + 2), down = VectorXd::Constant(n + 3, -1.0);
  const catena_point at{0.0, q.data(), q.data(), q.data(), nullptr, nullptr, p.data()};
  model.positions(at, side.data(), down.data());
  CHECK(down[n + 1] == doctest::Approx(p.head(n).sum()));
  CHECK(down[n + 2] == -1.0);  // written no further
  return down[n + 1];
}

TEST_CASE("two models of different numbers of links live and work side by side") {
  const Model few = any_links_model(7), many = any_links_model(31);
  const auto motion = [](const Model& model) {
    return catena::simulate(model, catena::testing::cable_parameters(model, 20.0, 0.1),
                            catena::straight(model, 0.6), {0.0, 0.05, 0.1});
  };
  const MatrixXd few_alone = motion(few).trajectory.q, many_alone = motion(many).trajectory.q;
  REQUIRE(few_alone.rows() == 7);
  REQUIRE(many_alone.rows() == 31);
  MatrixXd few_beside, many_beside;
  std::thread other([&] { many_beside = motion(many).trajectory.q; });
  few_beside = motion(few).trajectory.q;
  other.join();
  CHECK(same_bits(few_beside, few_alone));
  CHECK(same_bits(many_beside, many_alone));
}

TEST_CASE("a thousand models live at once, each its own") {
  std::vector<Model> held;
  for (int k = 0; k < 1000; ++k) held.push_back(any_links_model(5 + k));
  for (int k = 0; k < 1000; ++k) {
    const Model& model = held[static_cast<std::size_t>(k)];
    CAPTURE(k);
    REQUIRE(model.links() == 5 + k);
    CHECK(hanging_length(model) > 0.0);
  }
  const Model twice = any_links_model(100);  // one number of links may be there more than once
  CHECK(twice.table().context != held[95].table().context);
  const Model kept = held.back();
  held.clear();  // the others go, this one stays
  CHECK(kept.links() == 1004);
  CHECK(hanging_length(kept) > 0.0);
}

TEST_CASE("threads ask for models at the same time") {
  std::vector<std::thread> threads;
  std::vector<int> wrong(4, 0);
  for (std::size_t t = 0; t < wrong.size(); ++t)
    threads.emplace_back([&wrong, t] {
      for (int k = 0; k < 2000; ++k) {
        const int n = 5 + (k * 7 + static_cast<int>(t)) % 11;
        const Model model = any_links_model(n);
        const VectorXd zero = VectorXd::Zero(n), p = VectorXd::Ones(6 * n + 2);
        VectorXd side(n + 2), down(n + 2);
        const catena_point at{0.0,     zero.data(), zero.data(), zero.data(),
                              nullptr, nullptr,     p.data()};
        model.positions(at, side.data(), down.data());
        if (down[n + 1] != n) ++wrong[t];
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (const int count : wrong) CHECK(count == 0);
}

}  // namespace
