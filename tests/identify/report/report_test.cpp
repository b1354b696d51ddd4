// SPDX-License-Identifier: BSD-3-Clause
#include "identify/report/report.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <random>
#include <set>

#include "common/cpu_seconds.hpp"
#include "common/input_error.hpp"
#include "identify/report/assets.hpp"
#include "identify/report/page.hpp"
#include "identify/report/payload.hpp"
#include "identify/report/report_figures.hpp"
#include "identify/report/residuals.hpp"
#include "identify/results/result_file.hpp"
#include "tests/identify/report/made_results.hpp"
#include "tests/support/failure.hpp"
#include "tests/support/near.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

namespace catena::report {
namespace {

using nlohmann::json;

std::filesystem::path write(const std::filesystem::path& file, const json& value) {
  std::ofstream(file) << value;
  return file;
}

Document read(const json& value) {
  const testing::TemporaryFolder folder;
  return read_document(write(folder.path() / "result.json", value));
}

std::set<std::string> families(const std::vector<ReportFigure>& figures) {
  std::set<std::string> names;
  for (const ReportFigure& entry : figures)  // "frames-2" is the second row of frames
    names.insert(entry.family.substr(0, entry.family.find('-')));
  return names;
}

TEST_CASE("the keys of format 1 are read") {
  const json diagnosis = made_diagnosis();
  REQUIRE(diagnosis["format"] == 1);
  CHECK(read(diagnosis).diagnosis->noise == diagnosis["floor"].get<double>());
}

TEST_CASE("forces inside the cable are drawn as lines and as a map") {
  json written = {{"format", 2}, {"kind", "result"}, {"command", "simulate"}};
  written["experiments"] = {{{"name", "run"},
                             {"trajectory", {{"time", {0.0, 0.1}}, {"angle", {{0.1, 0.2}}}}},
                             {"forces", {{"tension", {{3.0, 4.0}}}, {"moment", {{-1.0, 1.0}}}}}}};
  const auto figures = report_figures(read(written));
  CHECK(families(figures).contains("moment_map"));
  const auto tension = std::find_if(figures.begin(), figures.end(), [](const ReportFigure& entry) {
    return entry.family == "tension";
  });
  REQUIRE(tension != figures.end());
  CHECK(tension->figure.series.at(0).y == std::vector<double>{3.0, 4.0});
}

TEST_CASE("a file that cannot be read says where and why") {
  struct Row {
    std::function<void(json&)> spoil;
    const char* words;
  };
  const std::vector<Row> rows = {
      {[](json& r) { r["kind"] = "case"; },
       "result.kind is \"case\"; it must be \"result\" or \"diagnosis\""},
      {[](json& r) { r["format"] = 3; }, "result.format is 3; this program reads formats 1 and 2"},
      {[](json& r) { r = 3; }, "it must be a result or a diagnosis"},
      {[](json& r) { r["title"] = 7; }, "result.title is 7; it must be text"},
      {[](json& r) { r["experiments"][0]["trajectory"]["side"][1].push_back(1.0); },
       "result.experiments[0].trajectory.side[1] is"},
      {[](json& r) { r["experiments"][0]["measured"]["side"].erase(0); },
       "it has 12 rows where side has 11"},
      {[](json& r) {
         r["experiments"][0]["predicted"]["side"].erase(0);
         r["experiments"][0]["predicted"]["down"].erase(0);
       },
       "predicted has 11 rows for 12 points"},
      {[](json& r) { r["experiments"][0]["predicted"].erase("down"); },
       "experiments[0].predicted.down is null; it has 0 rows where side has 12"},
      {[](json& r) {
         r["experiments"][0]["measured"].erase("side");
         r["experiments"][0]["measured"].erase("time");
       },
       "it has 12 rows where side has 0"},
      {[](json& r) {
         r["experiments"][0]["measured"]["angle"] = r["experiments"][0]["measured"]["side"];
       },
       "measured has angles beside positions of markers"},
      {[](json& r) {
         r["experiments"][0]["measured"]["across"] =
             json::array({r["experiments"][0]["measured"]["side"][0]});
       },
       "it has 1 rows where side has 12"},
      {[](json& r) {
         r["experiments"][0]["measured"]["across"] = r["experiments"][0]["measured"]["side"];
       },
       "predicted has 0 rows of across where side has 12"},
      {[](json& r) {
         for (const char* const of : {"measured", "predicted"})
           r["experiments"][0][of]["across"] = r["experiments"][0][of]["side"];
       },
       "either the motion is in space and the markers are not, or the reverse"},
      {[](json& r) {
         r["experiments"][0]["forces"] = {{"tension", {{1.0, 2.0}}}, {"moment", json::array()}};
       },
       "each row of tension must have one number per time of the trajectory"},
      {[](json& r) { r["parameters"][0]["interval"] = {1}; },
       "parameters[0].interval is [1]; it must have two ends"},
      {[](json& r) { r["parameters"][0]["value"] = "big"; },
       "parameters[0].value is \"big\"; it must be a number or null"},
      {[](json& r) { r["optimiser"]["history"]["error"].push_back(1.0); },
       "it must have one number per error"},
      {[](json& r) { r["experiments"][0]["energy"]["items"][0]["value"] = {1}; },
       "one number per time of the energy"},
      {[](json& r) {
         r["correlation"] = {{1, 0}, {0}};
       },
       "it has 1 entries where 2 are due"},
  };
  for (const Row& row : rows) {
    CAPTURE(row.words);
    json result = made_identification(3, 1, 30);
    row.spoil(result);
    std::string message;
    try {
      read(result);
    } catch (const InputError& error) {
      message = error.what();
    }
    CAPTURE(message);
    CHECK(message.find(row.words) != std::string::npos);
    CHECK(message.find("result.json") != std::string::npos);
  }
  const testing::TemporaryFolder folder;
  CHECK_THROWS_WITH_AS(read_document(folder.path() / "none.json"),
                       doctest::Contains("cannot be read"), InputError);
  std::ofstream(folder.path() / "half.json") << "{\"format\": 1, ";
  CHECK_THROWS_WITH_AS(read_document(folder.path() / "half.json"), doctest::Contains("not JSON"),
                       InputError);
  const auto said_of = [&](const std::string& text) {
    std::ofstream(folder.path() / "any.json") << text;
    return failure([&] { read_document(folder.path() / "any.json"); });
  };
  CHECK(said_of(R"({"format": 1e999})").find("any.json: number overflow parsing '1e999'") !=
        std::string::npos);
  for (const std::size_t depth : {201, 40'000}) {
    const std::string opening(depth - 1, '['), closing(depth - 1, ']');
    const std::string text =
        fmt::format(R"({{"format": 1, "kind": "result", "title": {}{}}})", opening, closing);
    CHECK(said_of(text).find("nested more than 200 deep") != std::string::npos);
  }
  const std::string deepest = std::string(200, '[') + std::string(200, ']');
  CHECK(said_of(deepest).find("nested") == std::string::npos);
}

TEST_CASE(
    "a folder stands for its diagnosis, else for its result; a round's result may be a file") {
  const testing::TemporaryFolder folder;
  write(folder.path() / "result.json", made_pendulum());
  CHECK(read_document(folder.path()).result.title == "A made-up double pendulum");
  json diagnosis = made_diagnosis();
  write(folder.path() / "after.json", diagnosis["rounds"][1]["result"]);
  diagnosis["rounds"][1]["result"] = "after.json";
  write(folder.path() / "diagnosis.json", diagnosis);
  const Document document = read_document(folder.path());
  REQUIRE(document.diagnosis);
  CHECK(document.result.title == "A made-up diagnosis");
  CHECK(document.diagnosis->rounds[1].result->experiments.size() == 1);
}

TEST_CASE("null is NaN for a number and infinity for the end of an interval") {
  const Document document = read(made_identification(3, 1, 30));
  const Parameter& beta = document.result.parameters[1];
  CHECK(std::isnan(beta.lower));
  REQUIRE(beta.interval);
  CHECK(std::isinf(beta.interval->high));
  CHECK(beta.interval->low == 0.2);
  CHECK(std::isnan(document.result.optimiser->history.error[10]));
}

TEST_CASE("what is written is read again: the same text comes out") {
  const std::string first = text_of(read(made_identification(3, 1, 30)).result);
  CHECK(text_of(read(json::parse(first)).result) == first);
  const std::string diagnosis = text_of(*read(made_diagnosis()).diagnosis);
  json again = json::parse(diagnosis);
  for (json& round : again["rounds"]) round["result"] = nullptr;  // files that are not there
  CHECK(text_of(*read(again).diagnosis) == diagnosis);
}

TEST_CASE("every figure that the data allow, each drawable under its own name") {
  struct Row {
    json result;
    std::set<std::string> families;
  };
  const std::set<std::string> motion = {"shapes", "frames", "position_side", "position_down"};
  const auto with = [](std::set<std::string> all, const std::set<std::string>& more) {
    all.insert(more.begin(), more.end());
    return all;
  };
  const std::set<std::string> seen =
      with(motion, {"residuals", "error_over_time", "residual_map", "spectrum_side",
                    "spectrum_down", "autocorrelation", "quantiles", "energy", "energy_balance"});
  for (const Row& row :
       {Row{made_simulation(4, 2, 50),
            with(motion, {"position_angle", "energy", "energy_balance"})},
        Row{made_identification(4, 2, 50),
            with(seen, {"error_by_step", "parameter_by_step", "waterfall", "profile", "correlation",
                        "error_by_links"})},
        Row{made_pendulum(),
            {"shapes", "frames", "position_angle", "residuals", "error_over_time", "residual_map",
             "spectrum_angle", "autocorrelation", "quantiles"}},
        Row{made_diagnosis(),
            with(seen,
                 {"gap", "predictions", "shares", "scores", "before_after_error",
                  "before_after_position", "residual_map_before", "residual_map_after",
                  "before_after_spectrum", "missing_force_side", "missing_force_bands_side"})}}) {
    const auto figures = report_figures(read(row.result));
    CHECK(families(figures) == row.families);
    std::set<std::string> ids;
    for (const ReportFigure& entry : figures) {
      CAPTURE(entry.figure.id);
      CHECK_NOTHROW(check(entry.figure));
      CHECK(ids.insert(entry.figure.id).second);
      CHECK_FALSE(entry.figure.title.empty());
      CHECK_FALSE(entry.figure.x.label.empty());
    }
  }
}

TEST_CASE("shares and predictions are bars, their intervals are lines") {
  const auto figures = report_figures(read(made_diagnosis()));
  const auto series_of = [&](const std::string& family) {
    const auto found = std::find_if(figures.begin(), figures.end(), [&](const ReportFigure& each) {
      return each.family == family;
    });
    REQUIRE(found != figures.end());
    return found->figure.series;
  };
  const auto shares = series_of("shares");
  REQUIRE(shares.size() == 3);
  CHECK(shares[0].mark == Mark::kBars);
  CHECK(shares[0].x == std::vector<double>{84, 16});
  CHECK(shares[1].mark == Mark::kBars);
  CHECK(shares[1].x == std::vector<double>{80, 20});
  CHECK(shares[2].mark == Mark::kLine);
  CHECK(shares[2].x.size() == 12);  // two ends and a gap, of two shares in two parts
  CHECK(shares[2].x[3] == 70);
  CHECK(shares[2].y[3] == shares[1].y[0]);
  const auto predictions = series_of("predictions");
  REQUIRE(predictions.size() == 3);
  CHECK(predictions[0].mark == Mark::kBars);
  CHECK(predictions[0].x == std::vector<double>{1.3, 12});
  CHECK(predictions[1].x[4] == 2);
  CHECK(predictions[2].x[4] == 6);
}

TEST_CASE("a diagnosis names results in its folder only") {
  const testing::TemporaryFolder folder;
  write(folder.path() / "mine.json", made_pendulum());
  std::filesystem::create_directory(folder.path() / "theirs");
  std::filesystem::create_symlink(folder.path() / "mine.json", folder.path() / "theirs/link.json");
  std::filesystem::create_directory_symlink(folder.path(), folder.path() / "theirs/round_1");
  json diagnosis = made_diagnosis();
  for (const std::string& file :
       {std::string("../mine.json"), (folder.path() / "mine.json").string(),
        std::string("link.json"), std::string("round_1/mine.json"), std::string("/dev/zero"),
        std::string("round_0/../../mine.json"), std::string("")}) {
    CAPTURE(file);
    diagnosis["rounds"][0]["result"] = file;
    const auto theirs = write(folder.path() / "theirs/diagnosis.json", diagnosis);
    CHECK(failure([&] { read_document(theirs); }).find("a file within the folder") !=
          std::string::npos);
  }
}

TEST_CASE("many experiments of one name do not take the square of their number") {
  constexpr std::size_t kMany = 20'000;
  const json energy = {
      {"time", {0, 1}},
      {"items", json::array({{{"name", "kinetic"}, {"kind", "kinetic"}, {"value", {0, 1}}}})},
      {"imbalance", 0}};
  json many = made_pendulum();
  many["experiments"] = json::array();
  for (std::size_t i = 0; i < kMany; ++i)
    many["experiments"].push_back({{"name", "a"}, {"energy", energy}});
  const Document document = read(many);
  const double begin = cpu_seconds();
  const std::vector<ReportFigure> figures = report_figures(document);
  CHECK(cpu_seconds() - begin < 10);
  CHECK(figures.size() >= kMany);
}

TEST_CASE("a result with next to nothing in it still makes a report") {
  const Document document = read({{"format", 1}, {"kind", "result"}, {"command", "simulate"}});
  CHECK(report_figures(document).empty());
  CHECK(to_html(document, {}).find("<h1>catena simulate</h1>") != std::string::npos);
}

TEST_CASE("the HTML stands alone: nothing from elsewhere, nothing that ends the script early") {
  const Document document = read(made_identification(4, 2, 50));
  const std::string html = to_html(document, report_figures(document));
  const std::string page = html.substr(0, html.rfind("<script>"));  // its words, not the script's
  const auto count = [](const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
  };
  CHECK(count(page, " src=") == 0);
  CHECK(count(page, "<link") == 0);
  CHECK(count(page, "@import") == 0);
  CHECK(count(page, "url(http") == 0);
  CHECK(count(html, "</script>") == 2);
  CHECK(count(html, "{{") == count(asset_script(), "{{"));  // every place of the template is filled
  CHECK(html.find("<h1>A made-up cable &lt;1&gt; &amp; its fit</h1>") != std::string::npos);
  CHECK(html.find("links = 4  # &lt;b&gt; &amp; &quot;quotes&quot;") != std::string::npos);
  CHECK(html.find("practically not; the data bound it from below only") != std::string::npos);
  CHECK(html.find("0.2\u00a0…\u00a0∞") != std::string::npos);
  CHECK(html.find("As derived from the Lagrangian and the effects, with 2 links") !=
        std::string::npos);
  CHECK(html.find("- k_{1} \\theta_{1}^{2} &lt; 0") !=
        std::string::npos);                                         // for the script to typeset
  CHECK(html.find("Dissipation per length") != std::string::npos);  // the built-in effect's formula
  CHECK(to_html(document, report_figures(document)) == html);
}

TEST_CASE("texts of a file are escaped on the page: none becomes markup") {
  const std::string attack = "\"><script>alert(1)</script><img src=x onerror=alert(1)>";
  const auto spoil = [&](json& value, const auto& again) -> void {
    if (value.is_string()) {
      value = attack;
    } else if (value.is_object() || value.is_array()) {
      for (json& part : value) again(part, again);
    }
  };
  for (json result : {made_identification(3, 1, 30), made_diagnosis()}) {
    const std::string kind = result["kind"];
    spoil(result, spoil);
    result["kind"] = kind;
    if (result.contains("rounds"))
      for (json& round : result["rounds"]) round["result"]["kind"] = "result";
    const Document document = read(result);
    std::string html = to_html(document, report_figures(document));
    html.resize(html.rfind("<script>"));  // what follows is the page's own
    CHECK(html.find("&quot;&gt;&lt;script&gt;alert(1)") != std::string::npos);
    CHECK(html.find("<script>alert") == std::string::npos);
    CHECK(html.find("<img") == std::string::npos);
  }
}

TEST_CASE("the page's policy allows its own script alone") {
  const std::string html = to_html(read(made_pendulum()), {});
  const auto start = html.rfind("<script>") + 8;
  const std::string script = html.substr(start, html.rfind("</script>") - start);
  CHECK(script == asset_script());
  CHECK(html.find("default-src 'none'; script-src 'sha256-") != std::string::npos);
}

TEST_CASE("what is laid over the measurement is what the sensors see, where the result says it") {
  json result = made_identification(3, 2, 30);
  json& experiment = result["experiments"][0];
  experiment["seen"] = {{"time", experiment["trajectory"]["time"]},
                        {"side", experiment["trajectory"]["side"]},
                        {"down", experiment["trajectory"]["down"]}};
  for (json& row : experiment["seen"]["side"])
    for (json& side : row) side = side.get<double>() + 5;
  const Document document = read(result);
  const auto figures = report_figures(document);
  for (const ReportFigure& entry : figures) {
    if (entry.experiment != "run 1" || entry.family != "shapes") continue;
    for (const Series& series : entry.figure.series)
      CHECK((series.x.front() > 4) == (series.name == "simulated"));
  }
  const json data = json::parse(payload(document, figures, 0));
  const json& motion = data["motions"][0];
  const auto column = [&](const json& index) { return data["columns"][index.get<std::size_t>()]; };
  CHECK(column(motion["side"][0])[0] == 5);
  CHECK(column(motion["measured"]["side"][0])[0] < 4);
}

TEST_CASE("60 links, 12 markers, 6 s at 60 Hz stay under 5 MB") {
  const Document document = read(made_identification(60, 6, 60));
  CHECK(to_html(document, report_figures(document)).size() < 5'000'000);
}

TEST_CASE("the data as JSON: figures refer to columns; long ones are thinned only where asked") {
  const Document document = read(made_identification(4, 2, 50));
  const auto figures = report_figures(document);
  for (const std::size_t most : {std::size_t{0}, std::size_t{30}}) {
    CAPTURE(most);
    const json data = json::parse(payload(document, figures, most));
    CHECK(data["kind"] == "report");
    std::size_t longest = 0;
    for (const json& figure : data["figures"]) {
      for (const json& series : figure["series"]) {
        const json& x = data["columns"].at(series["x"].get<std::size_t>());
        CHECK(x.size() == data["columns"].at(series["y"].get<std::size_t>()).size());
        longest = std::max(longest, x.size());
      }
    }
    CHECK(longest == (most == 0 ? 101 : 30));  // 101 frames; every third of 90 steps
  }
}

TEST_CASE(
    "a diagnosis gives its estimates' errors to the last round's parameters, and its formulas") {
  const Document document = read(made_diagnosis());
  const auto& parameters = document.result.parameters;
  REQUIRE(parameters.size() == 4);
  CHECK(parameters[2].name == "drag");
  CHECK(parameters[2].value == 0.00891);
  REQUIRE(parameters[2].interval);
  CHECK(parameters[2].interval->high == 0.00905);
  CHECK(parameters[2].verdict == "identifiable");
  const std::string html = to_html(document, {});
  for (const char* shown :
       {"12 links are enough", "The case's 12 links are those of the final model",
        "too small a change to matter", "it opposes the motion and grows with its square",
        "film it for 12 s; look at the load", "the predictions differ by 8.7 times the noise there",
        "Refitted, and worse", "10<sup>−523</sup>", "dissipated power",
        "equals the case's to 3×10⁻¹⁵", "normal = 0.0091\u00a0kg/m²"}) {
    CAPTURE(shown);
    CHECK(html.find(shown) != std::string::npos);
  }
}

TEST_CASE("formulas are read one by one or as two lists") {
  json diagnosis = made_diagnosis();
  json& candidate = diagnosis["rounds"][0]["candidates"][0];
  candidate["formulas"] = {{"mathml", json::array({"<math><mi>Q</mi></math>"})},
                           {"latex", json::array({"Q"})}};
  const auto formulas = read(diagnosis).diagnosis->rounds[0].candidates[0].formulas;
  REQUIRE(formulas.size() == 1);
  CHECK(formulas[0].mathml == "<math><mi>Q</mi></math>");
  CHECK(formulas[0].latex == "Q");
}

TEST_CASE(
    "in space residuals have their length, shapes three views, and the player all positions") {
  const Document plane = read(made_identification(4, 2, 50));
  const Document space = read(made_identification_in_space(4, 2, 50));
  const Residuals flat = residuals_of(plane.result.experiments[0]);
  const Residuals turned = residuals_of(space.result.experiments[0]);
  for (std::size_t t = 0; t < flat.time.size(); ++t) {
    CHECK(turned.across[3][t] == doctest::Approx(0.5 * flat.side[3][t]));
    CHECK(turned.size[3][t] == doctest::Approx(flat.size[3][t]));
    CHECK(turned.radial[3][t] == catena::near(flat.radial[3][t], 1e-9));
  }
  const auto figures = report_figures(space);
  std::vector<std::string> views;
  for (const ReportFigure& entry : figures)
    if (entry.family == "shapes" && entry.experiment == "run 1")
      views.push_back(entry.variant_kind + ": " + entry.figure.x.label + ", " +
                      entry.figure.y.label);
  CHECK(views ==
        std::vector<std::string>{"View: side, down", "View: across, down", "View: side, across"});
  for (const char* family : {"position_across", "spectrum_across"})
    CHECK(families(figures).contains(family));
  for (const ReportFigure& entry : figures) CHECK_NOTHROW(check(entry.figure));

  const json data = json::parse(payload(space, figures, 0));
  const auto last = [&](const json& rows) {
    return data["columns"][rows.back().get<std::size_t>()].back().get<double>();
  };
  for (const json& positions : {data["motions"][0], data["motions"][0]["measured"]})
    CHECK(last(positions["across"]) ==
          doctest::Approx(last(positions["side"]) * 0.5 / std::sqrt(0.75)));
  CHECK_FALSE(
      json::parse(payload(plane, report_figures(plane), 0))["motions"][0].contains("across"));
}

TEST_CASE("autocorrelation and quantiles are those of the noise in the fitted part") {
  constexpr std::size_t kFitted = 4000, kFrames = 4400;
  std::mt19937_64 random(1);
  std::normal_distribution<double> gauss(0, 1e-3);
  Experiment experiment;
  experiment.name = "run";
  experiment.fit_until = 0.01 * (kFitted - 1);
  experiment.measured.emplace();
  Measured& measured = *experiment.measured;
  measured.points = {Point{.name = "link 1"}};
  measured.values.angle = measured.predicted.angle = {results::Row(kFrames, 0.0)};
  double noise = 0;
  for (std::size_t k = 0; k < kFrames; ++k) {
    noise =
        0.6 * noise + 0.8 * gauss(random);  // variance 1e-6, correlation 0.6 from frame to frame
    measured.values.time.push_back(0.01 * static_cast<double>(k));
    measured.values.angle[0][k] = k < kFitted ? noise : 1.0;
  }
  std::vector<ReportFigure> figures;
  add_noise_figures(experiment, figures);
  REQUIRE(figures.size() == 2);
  const Series& correlation = figures[0].figure.series.front();
  CHECK(correlation.y[0] == 1);
  CHECK(correlation.y[1] == catena::near(0.6, 0.05));
  CHECK(correlation.y[2] == catena::near(0.36, 0.15));
  CHECK(figures[0].figure.rules.back().at == catena::near(1.96 / std::sqrt(kFitted), 1e-3));
  const Series& quantiles = figures[1].figure.series.back();
  for (std::size_t i = 10; i + 10 < quantiles.x.size(); ++i)  // in mrad, of deviation 1
    CHECK(quantiles.y[i] == doctest::Approx(quantiles.x[i]).epsilon(0.1).scale(1));
}

TEST_CASE("files: one CSV for each figure, and the parameters") {
  const testing::TemporaryFolder folder;
  const Document document = read(made_diagnosis());
  const Written written =
      write_report(document, {folder.path() / "deep/report.html", folder.path() / "csv"});
  const auto files = [&](const char* name) {
    const std::filesystem::directory_iterator entries(folder.path() / name);
    return static_cast<std::size_t>(std::distance(begin(entries), end(entries)));
  };
  CHECK(files("csv") == written.figures + 2);  // and manifest.sha256
  CHECK(std::filesystem::file_size(folder.path() / "deep/report.html") == written.html_bytes);
  const std::string parameters = testing::text_of(folder.path() / "csv/parameters.csv");
  CHECK(parameters.find("\nbeta,0.9544,1,true,,0.2,inf,1.8,,100,practically_not,stiffness\n") !=
        std::string::npos);
  CHECK(testing::text_of(folder.path() / "csv/gap.csv") ==
        "series,model,gap / mm\nfitted part,baseline,31\nfitted part,with air_drag_quadratic,1.2\n"
        "held out,baseline,44\nheld out,with air_drag_quadratic,1.3\n");
  // What an earlier report wrote is replaced, nothing else.
  CHECK_NOTHROW(write_report(document, {{}, folder.path() / "csv"}));
  const auto refusal = [&](const char* name, const char* mine) {
    std::filesystem::create_directories(folder.path() / name);
    std::ofstream(folder.path() / name / mine) << "mine";
    const std::string said = failure([&] { write_report(document, {{}, folder.path() / name}); });
    CHECK(testing::text_of(folder.path() / name / mine) == "mine");
    CHECK(files(name) == 1);
    return said;
  };
  CHECK(refusal("mine", "parameters.csv").find("was not written by catena") != std::string::npos);
  const std::filesystem::path page = folder.path() / "deep/report.html",
                              mine = folder.path() / "mine.csv";
  CHECK_NOTHROW(write_report(document, {page, {}}));
  std::ofstream(mine) << "t,x1,y1\n";
  CHECK(failure([&] {
          write_report(document, {mine, {}});
        }).find("is no report of catena") != std::string::npos);
  CHECK(testing::text_of(mine) == "t,x1,y1\n");
  CHECK(refusal("result", "result.json").find("give another folder") != std::string::npos);
}

}  // namespace
}  // namespace catena::report
