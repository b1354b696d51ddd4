# SPDX-License-Identifier: BSD-3-Clause
#
# cmake -D OUTPUT=file.cpp -D "EFFECTS=a.toml b.toml" -P embed_effects.cmake
# Writes a source that holds the built-in effect files, so that nothing has to be found at run time.

separate_arguments(EFFECTS)
set(text "// Written by embed_effects.cmake from description/effects/; do not edit.\n")
string(APPEND text "#include \"description/built_in_effects.hpp\"\n\n")
string(APPEND text "namespace catena {\nnamespace {\n\nconstexpr BuiltInEffect kEffects[] = {\n")
foreach(file ${EFFECTS})
  cmake_path(GET file STEM id)
  file(READ ${file} content)
  string(APPEND text "{\"${id}\", R\"toml(${content})toml\"},\n")
endforeach()
string(APPEND text "};\n\n}  // namespace\n\n")
string(APPEND text "std::span<const BuiltInEffect> built_in_effects() { return kEffects; }\n\n")
string(APPEND text "}  // namespace catena\n")
file(WRITE ${OUTPUT} "${text}")
