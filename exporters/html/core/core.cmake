# The core of the designer's page: build-wasm/orbc-core.js holds the glue, build-wasm/orbc-core.wasm the rooms (scripts/web).
file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/exporters/html/core/*.cpp)
add_executable(orbc-core ${sources})
orbc_unity(orbc-core)
target_link_libraries(orbc-core PRIVATE orbc::pov orbc::gltf orbc::svg)
set(functions _orbc_asset _orbc_take_mesh _orbc_open _orbc_notation _orbc_copies _orbc_light _orbc_trace_begin _orbc_trace_tile _orbc_export _malloc _free)
list(JOIN functions "," functions)
target_link_options(orbc-core PRIVATE --no-entry "-sEXPORTED_FUNCTIONS=${functions}" -sMODULARIZE=1 -sEXPORT_NAME=createCore
  -sENVIRONMENT=web,worker,node -sALLOW_MEMORY_GROWTH=1 -sTOTAL_STACK=5MB -sMALLOC=emmalloc -O2)
