# Every public header compiles alone: one generated file per header, which includes it twice (a missing guard shows)
# and nothing else. Part of the ordinary build, so a header that leans on another fails there.
# The RHI's headers must be C++17 (engines include them), all others C++20.

get_property(LANTERN_ALL_MODULES GLOBAL PROPERTY LANTERN_MODULES)
if(LANTERN_UNITY)
  list(FILTER LANTERN_ALL_MODULES INCLUDE REGEX "^(LanternRHI|LanternModuleHeaders)$") # what hosts include; 3 s for each header
endif()
foreach(MODULE IN LISTS LANTERN_ALL_MODULES)
  get_property(MODULE_DIR GLOBAL PROPERTY LANTERN_MODULE_DIR_${MODULE})
  file(GLOB_RECURSE HEADERS CONFIGURE_DEPENDS RELATIVE ${MODULE_DIR}/Public ${MODULE_DIR}/Public/*.h)
  set(HEADER_SOURCES)
  foreach(HEADER IN LISTS HEADERS)
    string(REPLACE "/" "_" STEM ${HEADER})
    set(HEADER_SOURCE ${CMAKE_CURRENT_BINARY_DIR}/PublicHeaders/${STEM}.cpp)
    file(CONFIGURE OUTPUT ${HEADER_SOURCE} CONTENT "#include \"${HEADER}\"\n#include \"${HEADER}\"\n")
    list(APPEND HEADER_SOURCES ${HEADER_SOURCE})
  endforeach()
  if(HEADER_SOURCES)
    add_library(PublicHeaders_${MODULE} OBJECT ${HEADER_SOURCES})
    set_target_properties(PublicHeaders_${MODULE} PROPERTIES UNITY_BUILD OFF) # each must compile alone
    target_link_libraries(PublicHeaders_${MODULE} PRIVATE ${MODULE} LanternOptions)
    if(MODULE STREQUAL "LanternRHI")
      set_target_properties(PublicHeaders_${MODULE} PROPERTIES CXX_STANDARD 17)
    endif()
  endif()
endforeach()
