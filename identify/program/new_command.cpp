// SPDX-License-Identifier: BSD-3-Clause
#include "identify/program/new_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>
#include <sstream>

#include "common/command_line.hpp"
#include "common/in_a_line.hpp"
#include "common/input_error.hpp"
#include "common/split.hpp"
#include "common/whole_file.hpp"
#include "identify/cases/case_reader.hpp"
#include "identify/cases/case_writer.hpp"
#include "identify/program/command.hpp"
#include "identify/program/recording_picture.hpp"
#include "identify/recordings/recognise.hpp"

namespace catena {
namespace {

namespace fs = std::filesystem;

constexpr int kLinks = 12;  // a fit of a film takes seconds; `identify --links-study` tries others

struct NewOptions {
  fs::path recording, output;
  bool quiet = false;
  double density = kNotGiven, load_mass = kNotGiven;
  KnownOfRecording known;
};

/// Asks for a number at the terminal until there is one.
double asked(const std::string& question) {
  for (std::string line;;) {
    std::cout << question << ": " << std::flush;
    if (!std::getline(std::cin, line)) throw InputError("no answer");
    std::istringstream in(line);
    double value = 0;
    const bool whole = in >> value && (in >> std::ws).eof();
    if (whole && value >= 0 && std::isfinite(value)) return value;
    std::cout
        << "a number that is not negative, with a decimal point and without a unit, is wanted\n";
  }
}

/// What no recording tells: asked for at a terminal, else an error that names the options.
void complete(NewOptions& options) {
  struct Measure {
    double* value;
    const char *option, *question;
  };
  const Measure measures[] = {
      {&options.known.length, "--length", "length of the cable, from the support to its end, m"},
      {&options.density, "--density", "mass of the cable per length, kg/m"},
      {&options.load_mass, "--load-mass", "mass of the load at the end, kg (0: none)"}};
  std::string missing;
  for (const Measure& measure : measures) {
    if (!std::isnan(*measure.value)) continue;
    if (isatty(STDIN_FILENO))
      *measure.value = asked(measure.question);
    else
      missing += fmt::format("\n  {}  {}", measure.option, measure.question);
  }
  if (!missing.empty()) throw InputError("no recording tells these measures; give" + missing);
  for (const Measure& measure : measures)
    if (!std::isfinite(*measure.value) || *measure.value < 0 ||
        (*measure.value == 0 && measure.value != &options.load_mass))
      throw InputError(
          fmt::format("{}: {}; must be {} and finite", measure.option, *measure.value,
                      measure.value == &options.load_mass ? "not negative" : "positive"));
}

double with_digits(double value, int digits) {
  return std::strtod(fmt::format("{:.{}g}", value, digits).c_str(), nullptr);
}

/// Two significant digits.
double about(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
  return with_digits(std::round(value / unit) * unit, 2);
}

Case case_of(const NewOptions& options, const RecognisedRecording& found) {
  Case the_case;
  the_case.title = found.spec.name;
  the_case.links = kLinks;
  the_case.cable.length = options.known.length;
  the_case.cable.density = options.density;
  the_case.cable.load_mass = options.load_mass;
  // A first guess: bending over a two-hundredth of the cable. It lasts a tenth of a second.
  const double pull =
      the_case.cable.gravity * (options.load_mass + 0.5 * options.density * options.known.length);
  const double guess = 5e-4 * pull * options.known.length * options.known.length;
  constexpr double kLeast = 1e-100,
                   kMost = 1e100;  // N m^2: numbers that go on from it stay numbers
  if (!(guess > kLeast && guess < kMost))
    throw InputError(fmt::format(
        "--length {}, --density {} and --load-mass {} make a cable that bends with {:.3g} N m^2 or "
        "so, which cannot be meant; give m, kg/m and kg",
        options.known.length, options.density, options.load_mass, guess));
  const double stiffness = about(guess);
  const auto add = [&](const char* name, const char* sets, const char* unit, double value) {
    ParameterSpec parameter;
    parameter.name = name;
    parameter.sets = sets;
    parameter.unit = unit;
    parameter.value = value;
    parameter.lower = about(1e-3 * value);
    parameter.upper = about(1e3 * value);
    parameter.free = true;
    parameter.scale = Scale::kLogarithmic;
    the_case.parameters.push_back(parameter);
  };
  add("EI", "bending_stiffness", "N m^2", stiffness);
  add("damping", "damping_length", "N m^2 s/rad", about(0.1 * stiffness));
  the_case.initial.shape = Shape::kSmooth;
  the_case.initial.free = true;
  the_case.initial.terms =
      std::min(the_case.initial.terms, static_cast<int>(found.spec.points.size()) + 2);
  the_case.initial.at_rest = found.at_rest;
  the_case.initial.velocity_free = !found.at_rest;
  the_case.experiments.push_back(found.spec);
  the_case.optimiser.method = FitMethod::kLeastSquares;
  return the_case;
}

/// The case with a comment on the lines that need one.
std::string commented(const std::string& text, const RecognisedRecording& found) {
  std::map<std::string, std::string> comments = {
      {"[model] links", "more are finer and slower"},
      {"[cable] length", "m, from the support to the end"},
      {"[cable] density", "kg/m"},
      {"[cable] load_mass", "kg, at the end"},
      {"[[parameter]] value", "a first guess"},
      {"[initial] shape", "at the start: a polynomial along the cable, found with the rest"},
      {"[initial.velocity] shape",
       "it moves in the first frame; at rest if this table is left out"},
      {"[[experiment]] from", "s"},
      {"[[experiment]] fit_until", "s; later frames only tell how well the fit predicts"},
      {"[[experiment]] markers", "from the support on; arc_length: m along the cable"},
      {"[[experiment]] origin", "the support, in the axes of the file"},
      {"[[experiment]] vertical", "the second column of a marker grows upwards"},
  };
  for (const std::string& key : found.estimated)
    comments["[[experiment]] " + key] =
        key == "from" ? "s; the release: nothing moves before"
                      : "estimated from how the cable hangs; measure it in the picture";
  std::string out, table;
  for (const std::string_view view : lines_of(text)) {
    const std::string line(view);
    if (line.starts_with('[')) table = line;
    const auto comment = comments.find(table + " " + line.substr(0, line.find(" =")));
    out += line;
    if (comment != comments.end() && line.find(" = ") != std::string::npos)
      out += std::string(line.size() < 34 ? 34 - line.size() : 1, ' ') + "# " + comment->second;
    out += "\n";
  }
  return out;
}

int make_case(NewOptions options) {
  complete(options);
  RecognisedRecording found = recognise_recording(options.recording, options.known);
  fs::path output = options.output;
  if (output.empty()) output = fs::path(options.recording).replace_extension(".toml");
  if (output.extension() != ".toml")
    throw InputError("--output: " + output.string() + "; the name of a case file ends in .toml");
  const fs::path picture = fs::path(output).replace_extension(".svg");
  for (const fs::path& file : {output, picture})
    if (fs::exists(file))
      throw InputError(file.string() + " exists already; give another name by --output");

  found.spec.where = output.string();
  found.spec.keep_outliers = true;  // to be drawn
  const Recording recording = read_recording(found.spec, kLinks, options.known.length);
  found.spec.keep_outliers = false;
  const double begin = recording.time.front(), end = recording.time.back();
  found.spec.fit_until = begin + with_digits(0.7 * (end - begin), 3);
  const std::string text =
      fmt::format(
          "# Made by catena new from {}.\n# catena identify {} --check tells what the data "
          "can determine; without --check it fits.\n",
          in_a_line(options.recording.filename().string()), in_a_line(output.string())) +
      commented(case_text(case_of(options, found), output.parent_path()), found);
  if (!is_utf8(text))
    throw InputError(options.recording.string() + " and " + output.string() +
                     ": their names and folders are written into the case and have to be UTF-8; "
                     "rename them (mv)");
  write_whole_file(output, text);
  write_whole_file(picture,
                   recording_picture(recording, find_outliers(recording, options.known.length),
                                     options.recording.filename().string(), options.known.length));
  if (!options.quiet)
    for (const std::string& line : found.understood) std::cout << line << "\n";
  // What the case would say; it is there to be corrected, whatever that is.
  try {
    CommonOptions common;
    common.quiet = options.quiet;
    show_warnings(Problem(read_case(output), Model::built_in(kLinks)), common);
  } catch (const InputError& error) {
    std::cerr << "catena: warning: " << error.what() << "\n";
  }
  if (options.quiet) return kExitSuccess;
  for (const std::string& key : found.estimated)
    if (key != "from")
      std::cout << key
                << " is estimated from how the cable hangs; measure it and correct the case\n";
  std::cout << "written to " << output.string() << "; compare the picture: " << picture.string()
            << "\n";
  return kExitSuccess;
}

}  // namespace

void add_new_command(CLI::App& program, int& exit_status) {
  static NewOptions options;
  CLI::App* command = program.add_subcommand("new", "make a case from a recording of markers");
  command->footer(
      "Example:\n  catena new film.csv --length 1.5 --density 0.12 --load-mass 0.2\n"
      "writes film.toml, a case to be fitted, and film.svg, a picture of what was\n"
      "understood. Measures that are not given are asked for at a terminal.");
  command->add_option("RECORDING", options.recording, "CSV file, or a tracker's export")
      ->required();
  command->add_option("-o,--output", options.output,
                      "case file; default: beside the recording, with .toml");
  command->add_option("--length", options.known.length, "of the cable, m");
  command->add_option("--density", options.density, "mass of the cable per length, kg/m");
  command->add_option("--load-mass", options.load_mass, "kg, at the end");
  command
      ->add_option("--markers", options.known.arc_lengths,
                   "m along the cable: 0.4,0.9,1.5; else evenly spaced")
      ->delimiter(',')
      ->check(positive_number());
  command->add_option("--origin", options.known.origin, "the support in the file's axes: 640,52")
      ->delimiter(',')
      ->expected(2);
  command->add_option("--metres-per-pixel", options.known.metres_per_pixel, "of a file in pixels")
      ->check(positive_number());
  command
      ->add_option("--frame-rate", options.known.frame_rate,
                   "frames per second, of a file that counts frames")
      ->check(positive_number());
  command->add_flag("-q,--quiet", options.quiet, "print nothing but errors and warnings");
  command->callback([&exit_status] { exit_status = make_case(options); });
}

}  // namespace catena
