# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -D OUTPUT=file.cpp -D "HEADERS=a.hpp b.hpp" -P embed_support.cmake
separate_arguments(HEADERS)
set(text "#include \"generator/emission/support_text.hpp\"\n\n")
string(APPEND text "std::map<std::string, std::string> catena::support_text() {\n  return {\n")
foreach(header ${HEADERS})
  get_filename_component(name ${header} NAME)
  file(READ ${header} content)
  string(APPEND text "{\"${name}\", R\"~~(${content})~~\"},\n")
endforeach()
string(APPEND text "  };\n}\n")
file(WRITE ${OUTPUT} "${text}")
