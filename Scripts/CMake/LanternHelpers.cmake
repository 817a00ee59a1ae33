# One way to declare a module, a program and a test.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

find_program(LANTERN_CCACHE ccache)
if(LANTERN_CCACHE)
  # ccache keeps files with a precompiled header only if it need not look at that header's own time and defines. Paths below
  # the repository are relative, so that another copy of it (Tests/NewPass) finds what this one has compiled.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros
    CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1 ${LANTERN_CCACHE})
endif()

add_library(LanternOptions INTERFACE)
target_compile_options(LanternOptions INTERFACE -Wall -Wextra -Wshadow -Wno-missing-field-initializers -Werror=return-type)
if(LANTERN_WERROR)
  target_compile_options(LanternOptions INTERFACE -Werror)
endif()
if(LANTERN_SANITIZE)
  target_compile_options(LanternOptions INTERFACE -fsanitize=${LANTERN_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
  target_link_options(LanternOptions INTERFACE -fsanitize=${LANTERN_SANITIZE})
endif()

if(LANTERN_UNITY)
  set(CMAKE_UNITY_BUILD ON)
  set(CMAKE_UNITY_BUILD_BATCH_SIZE 8)
  # Names of one file's anonymous namespace are no mistake in the next one.
  target_compile_options(LanternOptions INTERFACE -Wno-shadow $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()

# lantern_keep_apart(FILE …): with LANTERN_UNITY, what defines a name of another of these files is compiled alone: passes name
# their variables alike, tests their constants.
function(lantern_keep_apart)
  set(KNOWN)
  foreach(FILE ${ARGN})
    if(NOT LANTERN_UNITY OR NOT FILE MATCHES "[.]cpp$")
      continue()
    endif()
    get_filename_component(FILE ${FILE} ABSOLUTE)
    if(NOT EXISTS ${FILE})
      continue()
    endif()
    file(READ ${FILE} TEXT)
    string(REGEX REPLACE "\n(namespace|using) [^\n]*" "" TEXT "${TEXT}")
    string(REGEX MATCHALL "\n(struct|class|enum|enum class) [A-Za-z0-9_]+|\n[A-Za-z][A-Za-z0-9_:<>,*&. ]*[ *&][A-Za-z0-9_]+( =|{|[(][\n\t ]*\"|[(][^][;()\"]*[)])"
      NAMES "${TEXT}")
    list(TRANSFORM NAMES REPLACE "( =|{|[(][\n\t ]*\")$" "")
    list(TRANSFORM NAMES REPLACE "^[^(]*[ *&]" "") # functions keep what they take
    foreach(NAME ${NAMES})
      if(NAME IN_LIST KNOWN)
        set_source_files_properties(${FILE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
      endif()
    endforeach()
    list(APPEND KNOWN ${NAMES})
  endforeach()
endfunction()

# lantern_precompile(TARGET HEADER …): headers of others that most files read, and that take longer to read than these. Scripts/Lint
# without --plugin and the preset asan build without, so that a missing include is found.
function(lantern_precompile TARGET)
  target_precompile_headers(${TARGET} PRIVATE ${ARGN})
  target_compile_options(${TARGET} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>) # for ccache
endfunction()

# lantern_sources(OUT FOLDER): every .cpp file of the folder and of those below it.
function(lantern_sources OUT FOLDER)
  file(GLOB_RECURSE SOURCES CONFIGURE_DEPENDS ${FOLDER}/*.cpp)
  set(${OUT} ${SOURCES} PARENT_SCOPE)
endfunction()

# lantern_module(NAME [EXCLUDE regex] [SOURCES more.h …] PUBLIC deps … PRIVATE deps …): a static library of the current
# folder. Public/ is for others, Private/ for itself; every .cpp file of Private/ is compiled, but for those that EXCLUDE
# names. A module without any is headers only. Layering is enforced: a module sees only what it links.
function(lantern_module NAME)
  cmake_parse_arguments(M "" "EXCLUDE" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(SOURCES)
  if(IS_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/Private AND NOT NAME MATCHES "Headers$")
    lantern_sources(SOURCES ${CMAKE_CURRENT_SOURCE_DIR}/Private)
  endif()
  if(M_EXCLUDE)
    list(FILTER SOURCES EXCLUDE REGEX ${M_EXCLUDE})
  endif()
  if(SOURCES)
    lantern_keep_apart(${SOURCES})
    add_library(${NAME} STATIC ${SOURCES} ${M_SOURCES})
    target_include_directories(${NAME} PUBLIC Public PRIVATE Private)
    target_link_libraries(${NAME} PUBLIC ${M_PUBLIC} PRIVATE LanternOptions ${M_PRIVATE})
    # Headers of the standard library take a third of the time that a file of a module takes.
    lantern_precompile(${NAME} <algorithm> <array> <atomic> <bit> <cmath> <cstdint> <functional> <map> <memory> <mutex> <optional>
      <span> <string> <string_view> <unordered_map> <utility> <variant> <vector>)
  else()
    add_library(${NAME} INTERFACE)
    target_include_directories(${NAME} INTERFACE Public)
    target_link_libraries(${NAME} INTERFACE ${M_PUBLIC})
  endif()
  set_property(GLOBAL APPEND PROPERTY LANTERN_MODULES ${NAME})
  set_property(GLOBAL PROPERTY LANTERN_MODULE_DIR_${NAME} ${CMAKE_CURRENT_SOURCE_DIR})
endfunction()

# What tests leave for later ones: SPIR-V, the validation layers' verdicts, drivers' machine code. Scripts/Test empties it.
set(LANTERN_TEST_CACHES ${CMAKE_BINARY_DIR}/Caches)
# Ends what hangs, and decides nothing else. The longest test takes 90 s on two idle cores with empty caches; single waits
# have ten minutes (Tests/Support/WaitTools.h).
set(LANTERN_TEST_TIMEOUT 1800)

# lavapipe's caches do not tell how many lanes their code is for (Docs/Performance.md).
set(LANTERN_TEST_LANES LP_NATIVE_VECTOR_WIDTH=set:128)

# lantern_run_test(NAME [TRACES] LABELS fast|… COMMAND … [TIMEOUT seconds] [ENVIRONMENT K=V …]): a program as one ctest entry. TRACES:
# it traces rays for longer than it waits for the driver's compiler, which optimizes its shaders (Scripts/Test).
function(lantern_run_test NAME)
  cmake_parse_arguments(T "TRACES" "TIMEOUT" "COMMAND;LABELS;ENVIRONMENT" ${ARGN})
  set(MODIFICATIONS ${LANTERN_TEST_LANES} MESA_SHADER_CACHE_DIR=unset:)
  if(T_TRACES)
    list(APPEND MODIFICATIONS GALLIVM_PERF=unset:)
  endif()
  if(NOT T_TIMEOUT)
    set(T_TIMEOUT ${LANTERN_TEST_TIMEOUT})
  endif()
  add_test(NAME ${NAME} COMMAND ${T_COMMAND})
  set_tests_properties(${NAME} PROPERTIES LABELS "${T_LABELS}" TIMEOUT ${T_TIMEOUT}
    ENVIRONMENT "XDG_CACHE_HOME=${LANTERN_TEST_CACHES};${T_ENVIRONMENT}"
    ENVIRONMENT_MODIFICATION "${MODIFICATIONS}")
endfunction()

# What Tests/LongTests.txt lists, as GoogleTest's filter.
file(STRINGS ${PROJECT_SOURCE_DIR}/Tests/LongTests.txt LANTERN_LONG_TESTS REGEX "^[^#]")
list(JOIN LANTERN_LONG_TESTS ":" LANTERN_LONG_TESTS)
set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/Tests/LongTests.txt)

# lantern_long_tests(PROGRAM LABEL): those of a program as a ctest entry of their own, which is slow.
function(lantern_long_tests PROGRAM LABEL)
  lantern_run_test(Long.${PROGRAM} TRACES COMMAND ${PROGRAM} --gtest_filter=${LANTERN_LONG_TESTS} LABELS "${LABEL};slow" TIMEOUT 14400)
  set_tests_properties(Long.${PROGRAM} PROPERTIES FAIL_REGULAR_EXPRESSION "Running 0 tests")
endfunction()

# GoogleTest's headers, precompiled once for all test programs.
function(lantern_precompile_test NAME)
  if(NOT TARGET LanternTestHeaders)
    file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/LanternTestHeaders.cpp CONTENT "int main() { return 0; }\n")
    add_executable(LanternTestHeaders ${CMAKE_BINARY_DIR}/LanternTestHeaders.cpp)
    target_link_libraries(LanternTestHeaders PRIVATE LanternOptions GTest::gtest GTest::gmock)
    lantern_precompile(LanternTestHeaders <gmock/gmock.h> <gtest/gtest.h>)
  endif()
  target_precompile_headers(${NAME} REUSE_FROM LanternTestHeaders)
  target_compile_options(${NAME} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endfunction()

# lantern_test_program(NAME [SOURCES …] [EXCLUDE regex] LIBS …): a GoogleTest program without a ctest entry. Without SOURCES it
# has all .cpp files of the current folder, but for those that EXCLUDE names.
function(lantern_test_program NAME)
  cmake_parse_arguments(T "" "EXCLUDE" "SOURCES;LIBS" ${ARGN})
  if(NOT T_SOURCES)
    lantern_sources(T_SOURCES ${CMAKE_CURRENT_SOURCE_DIR})
    if(LANTERN_TEST_FILES AND NOT NAME STREQUAL "RepoTests")
      list(FILTER T_SOURCES INCLUDE REGEX ${LANTERN_TEST_FILES})
    endif()
  endif()
  if(NOT T_SOURCES)
    list(APPEND T_SOURCES ${CMAKE_BINARY_DIR}/LanternTestHeaders.cpp)
  endif()
  if(T_EXCLUDE)
    list(FILTER T_SOURCES EXCLUDE REGEX ${T_EXCLUDE})
  endif()
  lantern_keep_apart(${T_SOURCES})
  add_executable(${NAME} ${T_SOURCES})
  target_link_libraries(${NAME} PRIVATE ${T_LIBS} LanternOptions GTest::gtest_main GTest::gmock)
  target_include_directories(${NAME} PRIVATE ${PROJECT_SOURCE_DIR}/Tests)
  lantern_precompile_test(${NAME})
  target_compile_definitions(${NAME} PRIVATE
    LANTERN_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    LANTERN_TEST_CACHE="${LANTERN_TEST_CACHES}/lantern")
endfunction()

# lantern_test(NAME LABELS fast|… [SOURCES …] [EXCLUDE regex] LIBS … [TIMEOUT seconds]): the same with one ctest entry per test case. WHOLE:
# one entry for the program, for many small cases whose program takes longer to start than they do (OpenImageIO's libraries:
# 0.3 s).
function(lantern_test NAME)
  cmake_parse_arguments(T "WHOLE" "TIMEOUT;EXCLUDE" "SOURCES;LIBS;LABELS" ${ARGN})
  lantern_test_program(${NAME} SOURCES ${T_SOURCES} EXCLUDE "${T_EXCLUDE}" LIBS ${T_LIBS})
  if(NOT T_TIMEOUT)
    set(T_TIMEOUT ${LANTERN_TEST_TIMEOUT})
  endif()
  if(T_WHOLE)
    lantern_run_test(${NAME} COMMAND ${NAME} LABELS ${T_LABELS} TIMEOUT ${T_TIMEOUT})
    return()
  endif()
  include(GoogleTest)
  gtest_discover_tests(${NAME} TEST_FILTER -${LANTERN_LONG_TESTS} DISCOVERY_TIMEOUT ${LANTERN_TEST_TIMEOUT}
    PROPERTIES LABELS "${T_LABELS}" TIMEOUT ${T_TIMEOUT} ENVIRONMENT "XDG_CACHE_HOME=${LANTERN_TEST_CACHES}"
      ENVIRONMENT_MODIFICATION ${LANTERN_TEST_LANES}) # gtest_discover_tests keeps one element of a list
endfunction()
