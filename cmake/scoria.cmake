# Options that every target shares, and one-line helpers for libraries and tests.

set(SCORIA_MARCH "x86-64-v3" CACHE STRING "Value of -march; empty for the compiler's default")
option(SCORIA_WERROR "Warnings are errors" OFF)
option(SCORIA_UNITY "Compile the sources of a folder together, which is quicker; OFF shows a missing include" ON)
if(CMAKE_CXX_COMPILER_LAUNCHER)
  set(parse_once OFF)
else()
  set(parse_once ON)
endif()
option(SCORIA_PCH "Parse the headers of others once, where no compiler cache does more; OFF shows a missing include" ${parse_once})
set(SCORIA_SANITIZE "" CACHE STRING "Value of -fsanitize, such as address,undefined; with fuzzer-no-link the fuzz targets are programs")

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
if(SCORIA_SANITIZE)
  set(CMAKE_CXX_FLAGS_DEBUG "-O1 -gline-tables-only")  # the tests walk, so they must be quick enough
else()
  set(CMAKE_CXX_FLAGS_DEBUG "-O0 -g")
endif()

add_library(scoria_options INTERFACE)
target_compile_options(scoria_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wold-style-cast
  # g++ 12 reports these falsely, inside the standard library, fmt and Eigen, when it inlines at -O3.
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict -Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread>
  # And this of a class whose members are a source's own types, when a source is included by that of its folder.
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<BOOL:${SCORIA_UNITY}>>:-Wno-subobject-linkage>
  $<$<BOOL:${SCORIA_WERROR}>:-Werror>
  $<$<BOOL:${SCORIA_MARCH}>:-march=${SCORIA_MARCH}>)
if(SCORIA_SANITIZE)
  target_compile_options(scoria_options INTERFACE
    -fsanitize=${SCORIA_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(scoria_options INTERFACE -fsanitize=${SCORIA_SANITIZE})
endif()

# scoria_precompile(NAME HEADERS <a> ... LINK targets OPTIONS options): headers that are parsed once for the targets that say
# scoria_use_precompiled(TARGET NAME).
set(scoria_precompiled_source ${CMAKE_CURRENT_LIST_DIR}/precompiled.cc)
function(scoria_precompile name)
  cmake_parse_arguments(ARG "" "" "HEADERS;LINK;OPTIONS" ${ARGN})
  if(SCORIA_PCH)
    add_library(${name} OBJECT ${scoria_precompiled_source})
    target_link_libraries(${name} PRIVATE ${ARG_LINK} scoria_options)
    target_compile_options(${name} PRIVATE ${ARG_OPTIONS})
    target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
  endif()
endfunction()
function(scoria_use_precompiled target name)
  if(SCORIA_PCH)
    target_precompile_headers(${target} REUSE_FROM ${name})
  endif()
endfunction()

# scoria_by_folder(TARGET): the sources of one folder become one unit of compilation (SCORIA_UNITY), so a name that is
# local to a source differs from those of its neighbours.
function(scoria_by_folder target)
  if(NOT SCORIA_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    if(IS_ABSOLUTE ${source})  # generated
      continue()
    endif()
    cmake_path(GET source PARENT_PATH folder)
    string(MAKE_C_IDENTIFIER "${folder}_" group)
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
  endforeach()
endfunction()

# scoria_library(NAME [WALKS] SOURCES a.cc ... PUBLIC targets PRIVATE targets): static library scoria::NAME. For the
# release, sources of one that WALKS are compiled alone: a compiler fuses products and sums of functions that it inlines,
# and so the bits of a walk depend on what it sees.
function(scoria_library name)
  cmake_parse_arguments(ARG "WALKS" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(scoria_${name} STATIC ${ARG_SOURCES})
  add_library(scoria::${name} ALIAS scoria_${name})
  target_include_directories(scoria_${name} PUBLIC ${PROJECT_SOURCE_DIR})
  target_link_libraries(scoria_${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE} scoria_options)
  scoria_use_precompiled(scoria_${name} scoria_headers)
  if(NOT ARG_WALKS OR NOT CMAKE_BUILD_TYPE STREQUAL "Release")
    scoria_by_folder(scoria_${name})
  endif()
endfunction()

# scoria_link_graph(TARGET VARIABLE): every link that TARGET needs, its own and those of what it links, as "from to" lines.
function(scoria_link_graph target variable)
  set(waiting ${target})
  set(known)
  set(lines)
  while(waiting)
    list(POP_FRONT waiting from)
    if(from IN_LIST known OR NOT TARGET ${from})
      continue()
    endif()
    list(APPEND known ${from})
    set(links)
    foreach(property LINK_LIBRARIES INTERFACE_LINK_LIBRARIES)
      get_target_property(some ${from} ${property})
      if(some)
        list(APPEND links ${some})
      endif()
    endforeach()
    list(TRANSFORM links REPLACE "^\\$<LINK_ONLY:(.*)>$" "\\1")
    list(REMOVE_DUPLICATES links)
    foreach(to ${links})
      if(TARGET ${to})
        get_target_property(aliased ${to} ALIASED_TARGET)
        if(aliased)
          set(to ${aliased})
        endif()
      endif()
      list(APPEND lines "${from} ${to}")
      list(APPEND waiting ${to})
    endforeach()
  endwhile()
  list(JOIN lines "\n" text)
  set(${variable} "${text}\n" PARENT_SCOPE)
endfunction()
