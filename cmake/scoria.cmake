# Options that every target shares, and one-line helpers for libraries and tests.

set(SCORIA_MARCH "x86-64-v3" CACHE STRING "Value of -march; empty for the compiler's default")
option(SCORIA_WERROR "Warnings are errors" OFF)
option(SCORIA_PCH "Precompile the headers that most sources include" OFF)
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
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict -Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overflow>
  # And these of what comes from precompiled headers.
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<BOOL:${SCORIA_PCH}>>:-Wno-stringop-overread>
  $<$<BOOL:${SCORIA_WERROR}>:-Werror>
  $<$<BOOL:${SCORIA_MARCH}>:-march=${SCORIA_MARCH}>)
if(SCORIA_SANITIZE)
  target_compile_options(scoria_options INTERFACE
    -fsanitize=${SCORIA_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(scoria_options INTERFACE -fsanitize=${SCORIA_SANITIZE})
endif()

# scoria_precompiled(NAME HEADERS <a> ... LINK targets): headers parsed once for all that use them (SCORIA_PCH). Off where
# a compiler cache does more, so that a source which lacks an include does not go unseen.
set(scoria_pch_source ${CMAKE_CURRENT_LIST_DIR}/precompiled.cc)
function(scoria_precompiled name)
  if(NOT SCORIA_PCH)
    return()
  endif()
  cmake_parse_arguments(ARG "" "" "HEADERS;LINK" ${ARGN})
  add_library(${name} OBJECT ${scoria_pch_source})
  target_link_libraries(${name} PRIVATE ${ARG_LINK} scoria_options)
  target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
endfunction()
function(scoria_use_precompiled target name)
  if(SCORIA_PCH)
    target_precompile_headers(${target} REUSE_FROM ${name})
  endif()
endfunction()

# scoria_library(NAME SOURCES a.cc ... PUBLIC targets PRIVATE targets): static library scoria::NAME.
function(scoria_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(scoria_${name} STATIC ${ARG_SOURCES})
  add_library(scoria::${name} ALIAS scoria_${name})
  target_include_directories(scoria_${name} PUBLIC ${PROJECT_SOURCE_DIR})
  target_link_libraries(scoria_${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE} scoria_options)
  scoria_use_precompiled(scoria_${name} scoria_pch)
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
