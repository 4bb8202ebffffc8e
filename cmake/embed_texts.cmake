# Writes a C++ source with the texts of files, as EmbeddedDefinitions() of logs/ros:
#   cmake -D OUTPUT=x.cc -D FILES=a,b,c -P embed_texts.cmake
string(REPLACE "," ";" FILES "${FILES}")
set(table "")
foreach(file IN LISTS FILES)
  get_filename_component(name "${file}" NAME)
  file(READ "${file}" text)
  string(APPEND table "    {\"${name}\", R\"scoria(${text})scoria\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "// Generated from logs/ros/definitions.
#include \"logs/ros/embedded_definitions.h\"

namespace scoria::logs {
namespace {

constexpr EmbeddedText kTexts[] = {
${table}};

}  // namespace

std::span<const EmbeddedText> EmbeddedDefinitions() { return kTexts; }

}  // namespace scoria::logs
")
