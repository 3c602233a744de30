# One static library per folder of cairn/: every *.cpp of the folder is its source, every *_test.cpp its test.
# Adding a file needs no list to be edited (CONFIGURE_DEPENDS looks again at every build).

add_library(cairn_options INTERFACE)
add_library(cairn::options ALIAS cairn_options)
set_target_properties(cairn_options PROPERTIES EXPORT_NAME options)
target_compile_features(cairn_options INTERFACE cxx_std_20)
target_compile_definitions(cairn_options INTERFACE EIGEN_MPL2_ONLY)
target_include_directories(cairn_options INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)

# Warnings are ours, not our users': private to Cairn's own targets. FMA contraction is off so that the same
# source gives the same bytes on every x86-64 build. -Wrestrict is off: g++ 12 sees overlaps in std::string that
# are not there (GCC bug 105651). -Wpass-failed is off: clang at -O1 does not unroll the loops that ask for it.
function(cairn_compile_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> $<$<CXX_COMPILER_ID:Clang>:-Wno-pass-failed>
    -ffp-contract=off $<$<BOOL:${CAIRN_WERROR}>:-Werror>)
  # The paths of cairn/core/simd.hpp; SSSE3 would add nothing but compile time.
  target_compile_definitions(${target} PRIVATE HWY_DISABLED_TARGETS=HWY_SSSE3)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_EXTENSIONS OFF)
endfunction()

# Joins the target's sources, as far as cmake/unity_groups.py finds them fit, if CAIRN_UNITY is on. A local name may
# then hide one of another file: nothing to warn of.
function(cairn_join_sources target)
  if(NOT CAIRN_UNITY)
    return()
  endif()
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  execute_process(COMMAND ${Python3_EXECUTABLE} -B ${PROJECT_SOURCE_DIR}/cmake/unity_groups.py 12 ${sources}
                  WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} OUTPUT_VARIABLE groups COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]+" groups "${groups}")
  foreach(line IN LISTS groups)  # GROUP FILE
    string(REGEX MATCH "^([0-9]+) (.*)$" line "${line}")
    set_source_files_properties(${CMAKE_MATCH_2} PROPERTIES UNITY_GROUP ${CMAKE_MATCH_1})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  target_compile_options(${target} PRIVATE -Wno-shadow)
endfunction()

# cairn_add_test(NAME [LABEL label] SOURCES... LIBRARIES... [ENVIRONMENT VARIABLE=value])
# Labels: unit (the default) conformance property golden statistical e2e.
function(cairn_add_test name)
  cmake_parse_arguments(ARG "" "LABEL;ENVIRONMENT" "SOURCES;LIBRARIES" ${ARGN})
  if(NOT ARG_LABEL)
    set(ARG_LABEL unit)
  endif()
  set(environment "")
  if(ARG_ENVIRONMENT)
    set(environment ENVIRONMENT ${ARG_ENVIRONMENT})
  endif()
  add_executable(${name} ${ARG_SOURCES})
  cairn_compile_options(${name})
  cairn_join_sources(${name})
  # Tests are compiled more often than they run long. At -O1 g++ 12 sees uninitialised values in Eigen that are not.
  target_compile_options(${name} PRIVATE $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU>>:-O1;-Wno-maybe-uninitialized>)
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} GTest::gmock GTest::gtest_main)
  # Tests look for recordings in CAIRN_DATA, then in this folder beside the checkout.
  target_compile_definitions(${name} PRIVATE CAIRN_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  gtest_discover_tests(${name} PROPERTIES LABELS ${ARG_LABEL} ${environment} DISCOVERY_TIMEOUT 60)
endfunction()

# cairn_add_library(NAME [SUBFOLDERS folders...] PUBLIC libs... PRIVATE libs...)
function(cairn_add_library name)
  cmake_parse_arguments(ARG "" "" "SUBFOLDERS;PUBLIC;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  foreach(folder IN LISTS ARG_SUBFOLDERS)
    file(GLOB more CONFIGURE_DEPENDS ${folder}/*.cpp)
    list(APPEND sources ${more})
  endforeach()
  set(tests ${sources})
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
  list(FILTER tests INCLUDE REGEX "_test\\.cpp$")
  if(sources)
    add_library(cairn_${name} STATIC ${sources})
    cairn_compile_options(cairn_${name})
    cairn_join_sources(cairn_${name})
    target_link_libraries(cairn_${name} PUBLIC cairn::options ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  else()  # headers only
    add_library(cairn_${name} INTERFACE)
    target_link_libraries(cairn_${name} INTERFACE cairn::options ${ARG_PUBLIC})
  endif()
  add_library(cairn::${name} ALIAS cairn_${name})
  set_target_properties(cairn_${name} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY CAIRN_LIBRARIES cairn_${name})
  if(CAIRN_BUILD_TESTS AND tests)
    cairn_add_test(cairn_${name}_test SOURCES ${tests} LIBRARIES cairn::${name} cairn_test_support)
  endif()
endfunction()
