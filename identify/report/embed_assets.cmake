# SPDX-License-Identifier: BSD-3-Clause
#
# cmake -D OUTPUT=file.cpp -D WEB=folder -P embed_assets.cmake
# Writes a source that holds the report's script, style, equations and page (assets.hpp).

set(text "// Written by embed_assets.cmake from identify/report/web; do not edit.\n")
string(APPEND text "#include \"identify/report/assets.hpp\"\n\nnamespace catena::report {\n")
foreach(asset "script=dist/report.js" "style=dist/report.css" "chain_equations=source/chain_equations.html"
        "page=source/page.html")
  string(REPLACE "=" ";" pair ${asset})
  list(GET pair 0 name)
  list(GET pair 1 file)
  file(READ ${WEB}/${file} content)
  string(APPEND text "const char* asset_${name}() {\n  return R\"asset(${content})asset\";\n}\n")
endforeach()
string(APPEND text "}  // namespace catena::report\n")
file(WRITE ${OUTPUT} "${text}")
