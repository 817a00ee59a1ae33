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
  set(CMAKE_CXX_COMPILER_LAUNCHER ${LANTERN_CCACHE})
endif()

add_library(LanternOptions INTERFACE)
target_compile_options(LanternOptions INTERFACE -Wall -Wextra -Wshadow -Wno-missing-field-initializers -Werror=return-type)
if(LANTERN_SANITIZE)
  target_compile_options(LanternOptions INTERFACE -fsanitize=${LANTERN_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
  target_link_options(LanternOptions INTERFACE -fsanitize=${LANTERN_SANITIZE})
endif()

# lantern_module(NAME SOURCES a.cpp … PUBLIC deps … PRIVATE deps …): a static library in the current folder,
# Public/ for others, Private/ for itself. Layering is enforced: a module sees only what it links.
function(lantern_module NAME)
  cmake_parse_arguments(M "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  if(M_SOURCES)
    add_library(${NAME} STATIC ${M_SOURCES})
    target_include_directories(${NAME} PUBLIC Public PRIVATE Private)
    target_link_libraries(${NAME} PUBLIC ${M_PUBLIC} PRIVATE LanternOptions ${M_PRIVATE})
  else()
    add_library(${NAME} INTERFACE)
    target_include_directories(${NAME} INTERFACE Public)
    target_link_libraries(${NAME} INTERFACE ${M_PUBLIC})
  endif()
  set_property(GLOBAL APPEND PROPERTY LANTERN_MODULES ${NAME})
  set_property(GLOBAL PROPERTY LANTERN_MODULE_DIR_${NAME} ${CMAKE_CURRENT_SOURCE_DIR})
endfunction()

# lantern_test(NAME LABELS fast|… SOURCES … LIBS … [ENVIRONMENT K=V …]): a GoogleTest program, one ctest entry per
# test case, with Vulkan validation on. WHOLE: one entry for the program, for many small cases whose program takes
# longer to start than they do (OpenImageIO's libraries: 0.3 s).
function(lantern_test NAME)
  cmake_parse_arguments(T "WHOLE" "TIMEOUT" "SOURCES;LIBS;LABELS;ENVIRONMENT" ${ARGN})
  add_executable(${NAME} ${T_SOURCES})
  target_link_libraries(${NAME} PRIVATE ${T_LIBS} LanternOptions GTest::gtest_main GTest::gmock)
  target_compile_definitions(${NAME} PRIVATE LANTERN_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  if(NOT T_TIMEOUT)
    set(T_TIMEOUT 120)
  endif()
  if(T_WHOLE)
    add_test(NAME ${NAME} COMMAND ${NAME})
    set_tests_properties(${NAME} PROPERTIES LABELS "${T_LABELS}" TIMEOUT ${T_TIMEOUT} ENVIRONMENT "${T_ENVIRONMENT}")
    return()
  endif()
  include(GoogleTest)
  gtest_discover_tests(${NAME} DISCOVERY_TIMEOUT 60
    PROPERTIES LABELS "${T_LABELS}" TIMEOUT ${T_TIMEOUT} ENVIRONMENT "${T_ENVIRONMENT}")
endfunction()
