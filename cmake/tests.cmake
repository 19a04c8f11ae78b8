# tests/unit/<room>/*.cpp becomes the program test_<room>; so do tests/property, tests/reference.
find_package(Catch2 2.13 REQUIRED)
include(Catch)

add_library(orbc_test_main STATIC ${CMAKE_SOURCE_DIR}/tests/support/main.cpp)
target_link_libraries(orbc_test_main PUBLIC Catch2::Catch2 orbc_flags)
# The framework alone: 30 seconds with sanitizers and optimisation, and nobody waits for it.
set_source_files_properties(${CMAKE_SOURCE_DIR}/tests/support/main.cpp PROPERTIES COMPILE_OPTIONS "-O0;-g0")

# orbc_tests(name folder [LABELS slow] USES rooms…)
function(orbc_tests name folder)
  cmake_parse_arguments(TEST "" "LABELS" "USES;LIBRARIES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${folder}/*.cpp)
  if(NOT sources)
    message(FATAL_ERROR "${name}: there is no test in ${folder}/")
  endif()
  if(NOT TEST_LABELS)
    set(TEST_LABELS fast)
  endif()
  list(TRANSFORM TEST_USES PREPEND orbc::)
  add_executable(${name} ${sources})
  orbc_unity(${name})
  target_link_libraries(${name} PRIVATE orbc_test_main ${TEST_USES} ${TEST_LIBRARIES})
  target_compile_definitions(${name} PRIVATE ORBC_SOURCE_DIR="${CMAKE_SOURCE_DIR}" ORBC_BINARY_DIR="${CMAKE_BINARY_DIR}")
  # [long]: the same code over many rooms; under sanitizers that takes minutes and shows nothing more.
  set(which)
  if(ORBC_SANITIZE)
    set(which "~[long]~[.]")  # a filter alone would bring the hidden ones along
  endif()
  # Every case is a test of its own, named "<program>: <case>": the cores share the long programs, and a failure names its case.
  catch_discover_tests(${name} TEST_SPEC ${which} TEST_PREFIX "${name}: " WORKING_DIRECTORY ${CMAKE_SOURCE_DIR}
    PROPERTIES LABELS ${TEST_LABELS} TIMEOUT 1200)
endfunction()

if(ORBC_CORE_ONLY)  # of rooms whose tests read no file
  foreach(room base geometry notation)
    orbc_tests(test_${room} tests/unit/${room} USES ${room})
  endforeach()
  return()
endif()

foreach(room base geometry image image_io notation scene room mesh mesh_io animation verify diff)
  orbc_tests(test_${room} tests/unit/${room} USES ${room})
endforeach()
foreach(room place cover bend trace surface light bake render cutoff lod native_lights driver)  # their scenes name meshes and pictures
  orbc_tests(test_${room} tests/unit/${room} USES ${room} mesh_io)
endforeach()
foreach(room cover bend trace light)
  orbc_tests(property_${room} tests/property/${room} USES ${room})
endforeach()
foreach(exporter ${ORBC_EXPORTERS})
  orbc_tests(test_${exporter} tests/unit/${exporter} USES ${exporter})
endforeach()
# The same over thousands of rooms.
add_test(NAME beams_of_thousands COMMAND property_cover [slow] WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
set_tests_properties(beams_of_thousands PROPERTIES LABELS slow TIMEOUT 1200)
orbc_tests(test_watertight tests/watertight USES driver)
# The same from a thousand eyes.
add_test(NAME watertight_thousand COMMAND test_watertight [slow] WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
set_tests_properties(watertight_thousand PROPERTIES LABELS slow TIMEOUT 1200)
# GCC 12 sees an impossible size in the comparison of two byte vectors (false positive at -O3).
target_compile_options(test_cover PRIVATE -Wno-error=stringop-overread)
# And an overlap in the insertion of a literal into a string (false positive at -O3, GCC bug 105651).
target_compile_options(test_mesh_io PRIVATE -Wno-error=restrict)
# The JSON Schema and the reader give the same verdicts.
add_test(NAME scene_schema COMMAND /usr/bin/python3 ${CMAKE_SOURCE_DIR}/scripts/check_schema.py --reader $<TARGET_FILE:test_scene>)
set_tests_properties(scene_schema PROPERTIES LABELS fast TIMEOUT 300)
if(ORBC_FUZZ)  # tests/fuzz/<room>_fuzz.cpp; everything it links is instrumented
  target_compile_options(orbc_flags INTERFACE $<BUILD_INTERFACE:-fsanitize=fuzzer-no-link>)
  file(GLOB fuzzers CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/fuzz/*_fuzz.cpp)
  foreach(fuzzer ${fuzzers})
    get_filename_component(name ${fuzzer} NAME_WE)
    string(REPLACE "_fuzz" "" room ${name})
    add_executable(${name} ${fuzzer})
    if(room STREQUAL program)  # the rooms behind the command line
      target_link_libraries(${name} PRIVATE orbc::driver orbc::pov orbc::gltf)
    else()
      target_link_libraries(${name} PRIVATE orbc::${room})
    endif()
    target_link_options(${name} PRIVATE -fsanitize=fuzzer)
  endforeach()
endif()
include(cmake/system_tests.cmake)
# The longest first, so that no core waits for one of them in the end.
foreach(test watertight_thousand system_examples system_verify_rooms system_flat_scenes system_same_bytes system_plans system_edges system_picture_files)
  set_tests_properties(${test} PROPERTIES COST 100)
endforeach()
