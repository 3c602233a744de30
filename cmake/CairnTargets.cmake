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
