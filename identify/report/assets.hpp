// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace catena::report {

/// What the HTML report is made of besides data, embedded in the program from web/.
const char* asset_script();           ///< web/dist/report.js
const char* asset_style();            ///< web/dist/report.css
const char* asset_chain_equations();  ///< web/source/chain_equations.html
const char* asset_page();  ///< web/source/page.html: {{name}} stands for what is filled in

}  // namespace catena::report
