// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/readers.hpp"

#include <filesystem>
#include <stdexcept>

#include "common/input_error.hpp"
#include "common/toml_reader.hpp"
#include "description/description.hpp"
#include "description/effect_reader.hpp"
#include "description/expression_syntax.hpp"
#include "description/formula.hpp"
#include "description/unit.hpp"
#include "generator/checking/comparison.hpp"
#include "generator/checking/evaluator.hpp"
#include "generator/checking/findings_text.hpp"
#include "generator/checking/parser.hpp"
#include "identify/cases/case_reader.hpp"
#include "identify/recordings/recording.hpp"
#include "identify/report/page.hpp"
#include "identify/report/report_figures.hpp"
#include "identify/results/result_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace catena::tests {

std::filesystem::path written(const std::string& name, const std::string& text) {
  static const testing::TemporaryFolder folder;
  return folder.write(name, text);
}

namespace {

void read_source(DataSource source, DataKind kind, const std::string& text) {
  ExperimentSpec experiment;
  experiment.data = written("recording.csv", text);
  experiment.source = source;
  experiment.kind = kind;
  (void)read_recording(experiment, 4, 1.0);
}

void read_a_case(const std::string& text) { (void)parse_case(text, "case.toml", "."); }

void read_an_effect(const std::string& text) {
  const Effect effect = read_effect(TomlTable::parse(text, "effect.toml", "effect"));
  (void)formulas(effect);
  Description description = plain_chain();
  description.effects.push_back(effect);
  (void)canonical_text(description);
}

void read_a_description(const std::string& text) {
  (void)canonical_text(read_description(written("model.toml", text)));
}

void read_a_formula(const std::string& text) { (void)parse_syntax({text, "formula", 1, "force"}); }

void read_a_unit(const std::string& text) {
  try {
    const Unit unit = Unit::parse(text);
    if (Unit::parse(unit.text()) != unit) throw std::logic_error("a unit is not read as written");
  } catch (const std::invalid_argument&) {
  }
}

void read_markers(const std::string& text) {
  read_source(DataSource::kCatena, DataKind::kMarkers, text);
}
void read_angles(const std::string& text) {
  read_source(DataSource::kCatena, DataKind::kAngles, text);
}
void read_tracker(const std::string& text) {
  read_source(DataSource::kTracker, DataKind::kMarkers, text);
}
void read_kinovea(const std::string& text) {
  read_source(DataSource::kKinovea, DataKind::kMarkers, text);
}
void read_deeplabcut(const std::string& text) {
  read_source(DataSource::kDeepLabCut, DataKind::kMarkers, text);
}

void read_a_result(const std::string& text) {
  const results::Document document = results::read_document(written("result.json", text));
  (void)report::to_html(document, report::report_figures(document));
}

checking::Derivation derivation_of(const std::string& text) {
  return checking::evaluate(checking::parse_derivation(text, "derivation"), "derivation");
}

void read_a_derivation(const std::string& text) { (void)derivation_of(text); }

void compare_a_derivation(const std::string& text) {  // it takes a hundred times as long
  const checking::Derivation derivation = derivation_of(text);
  (void)findings_text("derivation", derivation, compare(derivation, 1));
}

template <void (*read)(const std::string&)>
void refused_or_read(const std::string& text) {
  try {
    read(text);
  } catch (const InputError&) {
  }
}

constexpr Reader kReaders[] = {
    {"case", refused_or_read<read_a_case>},
    {"effect", refused_or_read<read_an_effect>},
    {"description", refused_or_read<read_a_description>},
    {"formula", refused_or_read<read_a_formula>},
    {"unit", refused_or_read<read_a_unit>},
    {"markers", refused_or_read<read_markers>},
    {"angles", refused_or_read<read_angles>},
    {"tracker", refused_or_read<read_tracker>},
    {"kinovea", refused_or_read<read_kinovea>},
    {"deeplabcut", refused_or_read<read_deeplabcut>},
    {"run_log", refused_or_read<read_a_run_log>},
    {"result", refused_or_read<read_a_result>},
    {"derivation", refused_or_read<read_a_derivation>},
    {"comparison", refused_or_read<compare_a_derivation>},
};

}  // namespace

std::span<const Reader> readers() { return kReaders; }

}  // namespace catena::tests
