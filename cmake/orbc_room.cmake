# Flags of every target: no contraction (watertight edges need bitwise equal evaluations), no fast-math.
add_library(orbc_flags INTERFACE)
target_include_directories(orbc_flags INTERFACE $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/orbc>)
target_compile_options(orbc_flags INTERFACE $<BUILD_INTERFACE:-Wall;-Wextra;-Wpedantic;-Wshadow;-ffp-contract=off>)
if(ORBC_WERROR AND NOT ORBC_SANITIZE)  # sanitizers make GCC 12 warn of what is not there
  target_compile_options(orbc_flags INTERFACE $<BUILD_INTERFACE:-Werror>)
endif()
if(ORBC_SANITIZE)
  target_compile_options(orbc_flags INTERFACE $<BUILD_INTERFACE:-fsanitize=${ORBC_SANITIZE};-fno-omit-frame-pointer;-g1>)
  target_link_options(orbc_flags INTERFACE $<BUILD_INTERFACE:-fsanitize=${ORBC_SANITIZE}>)
  if(ORBC_SANITIZE MATCHES "undefined")
    target_compile_options(orbc_flags INTERFACE $<BUILD_INTERFACE:-fno-sanitize-recover=undefined>)
  endif()
  # The tree's walk is one large inlined kernel for each space: instrumented it takes GCC 12 more than 3 minutes. Single rays and brute force hold it.
  set_source_files_properties(compiler/trace/bvh/traverse.cpp PROPERTIES COMPILE_OPTIONS "-fno-sanitize=all;-O2;-g0")
endif()
set_target_properties(orbc_flags PROPERTIES EXPORT_NAME flags)
install(TARGETS orbc_flags EXPORT orbc COMPONENT development)

# One translation unit a room: parsing headers is two thirds of a build of 180 files (486 -> 140 s of processor time in eight rooms, measured).
# Files that bring compile options of their own, and those that Highway compiles again for each instruction set, stay apart.
function(orbc_unity target)
  if(ORBC_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
  endif()
endfunction()
set_source_files_properties(compiler/trace/bvh/traverse.cpp compiler/bend/log_map_simd.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)

# orbc_embed(scene_schema schema/orbc-scene.schema.json): the file becomes a function of the library orbc_embedded that returns its bytes.
# That library is apart from cli, whose own files would otherwise wait for all rooms before they are compiled.
function(orbc_embed name file)
  set(output ${CMAKE_BINARY_DIR}/embedded/${name}.cpp)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DNAME=${name} -DFILE=${CMAKE_SOURCE_DIR}/${file} -DOUTPUT=${output} -P ${CMAKE_SOURCE_DIR}/cmake/embed.cmake
    DEPENDS ${CMAKE_SOURCE_DIR}/${file} ${CMAKE_SOURCE_DIR}/cmake/embed.cmake)
  if(NOT TARGET orbc_embedded)
    add_library(orbc_embedded STATIC)
    target_link_libraries(orbc_embedded PUBLIC orbc_flags)
  endif()
  target_sources(orbc_embedded PRIVATE ${output})
endfunction()

# orbc_room(bend USES geometry place cover LIBRARIES hwy::hwy): the folder compiler/bend becomes the target orbc::bend.
# FOLDER names another place (exporters/pov). Every .cpp in the folder belongs to the room. INTERNAL rooms are not installed for others.
# FLAT: the folders below it are rooms of their own.
# NOT_IN_CORE: names of sources that a build with ORBC_CORE_ONLY leaves out, as a regular expression.
# COLD rooms read and print, once a run: they are optimised less, which takes a third of their compile time away (measured: scene, cli).
function(orbc_room name)
  cmake_parse_arguments(ROOM "INTERNAL;COLD;FLAT" "FOLDER;NOT_IN_CORE" "USES;LIBRARIES;PRIVATE" ${ARGN})
  if(NOT ROOM_FOLDER)
    set(ROOM_FOLDER compiler/${name})
  endif()
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${ROOM_FOLDER}/*.cpp)
  if(NOT ROOM_FLAT)
    file(GLOB below CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${ROOM_FOLDER}/*/*.cpp)
    list(APPEND sources ${below})
  endif()
  list(FILTER sources EXCLUDE REGEX "/main\\.cpp$")
  if(ORBC_CORE_ONLY AND ROOM_NOT_IN_CORE)
    list(FILTER sources EXCLUDE REGEX "/${ROOM_NOT_IN_CORE}\\.cpp$")
  endif()
  if(NOT sources)
    message(FATAL_ERROR "room ${name}: there is no source in ${ROOM_FOLDER}/")
  endif()
  list(TRANSFORM ROOM_USES PREPEND orbc::)
  add_library(orbc_${name} STATIC ${sources})
  orbc_unity(orbc_${name})
  target_link_libraries(orbc_${name} PUBLIC orbc_flags ${ROOM_USES} ${ROOM_LIBRARIES} PRIVATE ${ROOM_PRIVATE})
  if(ROOM_COLD AND EMSCRIPTEN)
    target_compile_options(orbc_${name} PRIVATE -Oz)  # the page is to be small
  elseif(ROOM_COLD)
    target_compile_options(orbc_${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
  add_library(orbc::${name} ALIAS orbc_${name})
  set_target_properties(orbc_${name} PROPERTIES EXPORT_NAME ${name})
  if(NOT ROOM_INTERNAL)
    install(TARGETS orbc_${name} EXPORT orbc ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
    # Headers that read OpenMesh, tinygltf or Highway serve the room's own files alone: who links the room needs none of these libraries.
    install(DIRECTORY ${CMAKE_SOURCE_DIR}/${ROOM_FOLDER}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/orbc/${ROOM_FOLDER} COMPONENT development
      FILES_MATCHING PATTERN "*.h"
      PATTERN "*-inl.h" EXCLUDE
      PATTERN "mesh/collapse_module.h" EXCLUDE
      PATTERN "mesh/decimation_state.h" EXCLUDE
      PATTERN "mesh_io/gltf_*.h" EXCLUDE)
  endif()
endfunction()
