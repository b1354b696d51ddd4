// SPDX-License-Identifier: GPL-3.0-or-later
#include "identify/report/page.hpp"
#include "identify/report/report_figures.hpp"
#include "identify/results/result_file.hpp"
#include "tests/fuzz/readers.hpp"

namespace catena::tests {
namespace {

void read_a_result(const std::string& text) {
  const results::Document document = results::read_document(written("result.json", text));
  (void)report::to_html(document, report::report_figures(document));
}

constexpr Reader kResultReaders[] = {{"result", refused_or_read<read_a_result>}};

}  // namespace

std::span<const Reader> result_readers() { return kResultReaders; }

}  // namespace catena::tests
