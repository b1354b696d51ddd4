// SPDX-License-Identifier: BSD-3-Clause
#include "identify/models/model_provider.hpp"

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <memory>
#include <optional>

#include "common/input_error.hpp"
#include "identify/fit/error.hpp"
#include "tests/identify/differences.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/data.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;

namespace {

const char* const kSensors =
    "format = 1\nkind = \"model\"\nid = \"seen\"\n"
    "effects = [\"air_drag_quadratic\", \"clock_offset\", \"camera_tilt\", \"scale\"]\n";

ProviderOptions options_for(const testing::TemporaryFolder& folder,
                            std::vector<std::string>* notices) {
  ProviderOptions options;
  options.derive_program = tests::build_folder() / "bin" / "catena-derive";
  options.cache_directory = folder.path() / "cache";
  if (notices) options.notice = [notices](const std::string& line) { notices->push_back(line); };
  return options;
}

// A variable of the environment, for as long as this lives.
class Environment {
 public:
  Environment(const char* name, const char* value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    setenv(name, value, 1);
  }
  ~Environment() { before_ ? setenv(name_, before_->c_str(), 1) : unsetenv(name_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

std::size_t entries(const std::filesystem::path& folder) {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++count;
  return count;
}

}  // namespace

TEST_CASE("a built-in model needs nothing; any other is made once") {
  const testing::TemporaryFolder folder;
  std::vector<std::string> notices;
  const ProviderOptions options = options_for(folder, &notices);
  CHECK(provide_model({}, 12, options).links() == 12);
  CHECK(!std::filesystem::exists(folder.path() / "cache"));
  CHECK(provide_model({}, 1, options).links() == 1);
  REQUIRE(notices.size() == 1);
  CHECK(provide_model({}, 1, options).links() == 1);
  CHECK(notices.size() == 1);
  // the id of a description decides nothing: the same equations are not made again
  const auto plain = folder.write("plain.toml", "format = 1\nkind = \"model\"\nid = \"other\"\n");
  CHECK(provide_model(plain, 1, options).links() == 1);
  CHECK(entries(folder.path() / "cache") == 1);
}

TEST_CASE("code from somebody else's effect is announced") {
  const testing::TemporaryFolder folder;
  std::vector<std::string> notices;
  folder.write(
      "mine.toml",
      "format = 1\nkind = \"effect\"\nid = \"mine\"\ntitle = \"Mine\"\ndescription = \"x\"\n"
      "[parameters.strength]\nunit = \"N m\"\nneutral = 0.0\ndescription = \"x\"\n"
      "[[torque]]\nat = \"pivot\"\nvalue = \"strength\"\n");
  const auto description = folder.write(
      "d.toml", "format = 1\nkind = \"model\"\nid = \"d\"\neffects = [\"mine.toml\"]\n");
  const Model model = provide_model(description, 1, options_for(folder, &notices));
  REQUIRE(notices.size() == 1);
  CHECK(notices[0].find("mine.toml") != std::string::npos);
  CHECK(model.parameter_index("mine.strength") > 0);
}

TEST_CASE("what is missing or wrong is said") {
  const testing::TemporaryFolder folder;
  ProviderOptions options = options_for(folder, nullptr);
  CHECK_THROWS_AS(provide_model(folder.path() / "absent.toml", 1, options), InputError);
  const auto bad = folder.write(
      "bad.toml", "format = 1\nkind = \"model\"\nid = \"d\"\neffects = [\"air_drag_qadratic\"]\n");
  CHECK_THROWS_AS(provide_model(bad, 1, options), InputError);
  options.compiler = "/no/such/compiler";
  std::string message;
  try {
    provide_model({}, 1, options);
  } catch (const ModelError& error) {
    message = error.what();
  }
  CHECK(message.find("/no/such/compiler") != std::string::npos);
  CHECK(message.find("CXX") != std::string::npos);
  options.derive_program = "/no/such/catena-derive";
  CHECK_THROWS_AS(provide_model({}, 5, options), ModelError);
  CHECK(entries(folder.path() / "cache") == 0);  // nothing half made is left behind
}

TEST_CASE("the plain chain does without a compiler") {
  const testing::TemporaryFolder folder;
  std::vector<std::string> notices;
  const ProviderOptions options = options_for(folder, &notices);
  auto no_compiler = std::make_unique<Environment>("CXX", "/no/such/compiler");
  const Model model = provide_model({}, 13, options);
  CHECK(model.table().context != nullptr);  // the model for any number of links
  REQUIRE(notices.size() == 1);
  CHECK(notices[0] ==
        "the compiler /no/such/compiler was not found: 13 links are computed by the model for any "
        "number of links, with the same results");
  CHECK(!std::filesystem::exists(folder.path() / "cache"));
  // an effect, or a single link, does not
  const auto drag = folder.write(
      "d.toml", "format = 1\nkind = \"model\"\nid = \"d\"\neffects = [\"load_drag\"]\n");
  CHECK_THROWS_AS(provide_model(drag, 13, options), ModelError);
  CHECK_THROWS_AS(provide_model({}, 1, options), ModelError);
  // with a compiler it is compiled; what is in the cache needs none
  no_compiler.reset();
  CHECK(provide_model({}, 13, options).table().context == nullptr);
  const Environment nothing_in_path("PATH", "/no/such/folder");
  CHECK(provide_model({}, 13, options).table().context == nullptr);
  const Environment by_name("CXX", "c++");
  const Model other = provide_model({}, 14, options);
  CHECK(other.table().context != nullptr);
}

TEST_CASE("two processes at once share the cache") {
  const testing::TemporaryFolder folder;
  const ProviderOptions options = options_for(folder, nullptr);
  std::vector<pid_t> children;
  for (int i = 0; i < 3; ++i) {
    const pid_t child = fork();
    if (child == 0) {
      int status = 1;
      try {
        status = provide_model({}, 1, options).links() == 1 ? 0 : 1;
      } catch (...) {
      }
      _exit(status);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = 1;
    waitpid(child, &status, 0);
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
  }
  CHECK(entries(folder.path() / "cache") == 1);
}

TEST_CASE("sensors are differentiated like the physics") {
  const testing::TemporaryFolder folder;
  const auto description = folder.write("seen.toml", kSensors);
  const Model model = provide_model(description, 2, options_for(folder, nullptr));
  Case the_case = testing::sections(R"(
[model]
links = 2
[cable]
length = 1.0
density = 0.3
load_mass = 0.2
[[parameter]]
name = "k"
sets = "stiffness"
value = 0.05
[[parameter]]
name = "c"
sets = "damping"
value = 0.002
[[parameter]]
name = "drag"
sets = "air_drag_quadratic.normal"
value = 0.05
free = true
[initial]
shape = "straight"
angle = 0.6
)");
  for (int i = 0; i < model.parameters(); ++i) {
    const std::string name = model.table().parameter[i].name;
    if (name.starts_with("clock_offset") || name.starts_with("camera_tilt") ||
        name.starts_with("scale")) {
      ParameterSpec parameter;
      parameter.name = parameter.sets = name;
      parameter.value = model.table().parameter[i].neutral + 0.02;
      parameter.free = true;
      the_case.parameters.push_back(parameter);
    }
  }
  REQUIRE(the_case.parameters.size() == 6);
  testing::add_experiment(the_case, "run");
  the_case.experiments[0].start = 0.01;
  // from 0.23 s on: at the start itself the clock has a kink, where the cable is let go
  Recording recording = testing::empty_markers({0.3, 1.0}, 30, 0.05);
  for (double& t : recording.time) t += 0.23;
  const Problem problem(the_case, model, {recording});
  const Eigen::VectorXd x = problem.start();
  const Residuals at = residuals_of(problem, evaluate(problem, x, true, true), Part::kFit);
  const auto residuals = [&](const Eigen::VectorXd& at_x) {
    return residuals_of(problem, evaluate(problem, at_x, true, false), Part::kFit).value;
  };
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    CAPTURE(problem.unknowns()[static_cast<std::size_t>(j)].name);
    const Eigen::VectorXd difference = testing::central_difference(residuals, x, j, 1e-4);
    CHECK((difference - at.jacobian.col(j)).cwiseAbs().maxCoeff() <
          1e-4 * at.jacobian.col(j).cwiseAbs().maxCoeff());
    CHECK(at.jacobian.col(j).cwiseAbs().maxCoeff() > 1e-3);
  }
}

namespace {

// What a fit asks of a model, at a state that depends on no parameter.
struct Answers {
  explicit Answers(const Model& model, const std::vector<std::pair<std::string, double>>& values) {
    const int n = model.coordinates();
    Eigen::VectorXd q(n), v(n), a(n), p = model.default_parameters();
    for (int i = 0; i < n; ++i) {
      q[i] = 0.5 - 0.2 * i;
      v[i] = 0.3 + 0.7 * i;
      a[i] = 2.0 - i;
    }
    for (int k = 0; k < p.size(); ++k)
      if (!std::isfinite(p[k])) p[k] = 0.1 + 0.01 * k;
    for (const auto& [name, value] : values) p[model.parameter_index(name)] = value;
    Eigen::VectorXd dp = Eigen::VectorXd::Zero(p.size());
    dp[model.parameter_index("load_mass")] = 1;
    for (const auto& [name, value] : values) dp[model.parameter_index(name)] = 1;
    const Eigen::VectorXd none(0);
    const catena_point at{0.4, q.data(), v.data(), a.data(), none.data(), none.data(), p.data()};
    const catena_point along{0, v.data(), a.data(), q.data(), none.data(), none.data(), dp.data()};
    numbers.resize(n, 4);
    model.residual(at, numbers.col(0).data());
    model.residual_tangent(at, along, numbers.col(1).data());
    CHECK(model.acceleration(at, numbers.col(2).data()) == 0);
    std::vector<double> work(static_cast<std::size_t>(model.table().newton_work));
    CHECK(model.newton_factor(at, 1.0, 0.02, 0.0004, work.data()) == 0);
    numbers.col(3) = numbers.col(0);
    model.newton_solve(work.data(), numbers.col(3).data());
  }
  Eigen::MatrixXd numbers;
};

}  // namespace

TEST_CASE("a model for fits has the numbers of the complete one, and its effects can rest") {
  const testing::TemporaryFolder folder;
  ProviderOptions options = options_for(folder, nullptr);
  const auto description =
      folder.write("d.toml",
                   "format = 1\nkind = \"model\"\nid = \"d\"\neffects = [\"added_mass\", "
                   "\"air_drag_quadratic\", "
                   "\"joint_dry_friction\", \"support_motion\", \"rest_curvature\", \"scale\"]\n");
  const Model complete = provide_model(description, 5, options);
  options.for_fits = true;
  const Model fits = provide_model(description, 5, options);
  CHECK(entries(folder.path() / "cache") == 2);
  CHECK((fits.table().energy == nullptr));
  CHECK((fits.table().mass_matrix == nullptr));
  CHECK(fits.energies() == 0);
  const Model plain = provide_model({}, 5, options);
  CHECK(plain.table().context != nullptr);  // nothing was compiled
  // At the neutral values it is the plain chain, its residual to the last bit.
  const Eigen::MatrixXd resting_all = Answers(fits, {}).numbers, bare = Answers(plain, {}).numbers;
  CHECK(resting_all.col(0) == bare.col(0));
  CHECK((resting_all - bare).norm() < 1e-13 * bare.norm());
  // Every effect alone, and all together, is what it is in the complete model.
  std::vector<std::pair<std::string, double>> all;
  for (const auto& one :
       std::vector<std::pair<std::string, double>>{{"added_mass.normal", 0.1},
                                                   {"added_mass.tangential", 0.03},
                                                   {"air_drag_quadratic.normal", 0.2},
                                                   {"joint_dry_friction.moment", 0.02},
                                                   {"support_motion.side_amplitude", 0.05},
                                                   {"rest_curvature.curvature", 0.3}}) {
    all.push_back(one);
    for (const auto& values : {decltype(all){one}, all}) {
      CAPTURE(one.first);
      const Eigen::MatrixXd expected = Answers(complete, values).numbers;
      CHECK((expected - Answers(plain, {}).numbers).norm() > 1e-4);
      CHECK((Answers(fits, values).numbers - expected).norm() < 1e-12 * expected.norm());
    }
  }
  // A derivative by a resting effect is there as well.
  const std::vector<std::pair<std::string, double>> resting = {{"air_drag_quadratic.normal", 0.0}};
  const Eigen::MatrixXd expected = Answers(complete, resting).numbers;
  CHECK((Answers(fits, resting).numbers - expected).norm() < 1e-12 * expected.norm());
  CHECK((expected.col(1) - Answers(plain, {}).numbers.col(1)).norm() > 1e-4);
}
