# The libraries of the core for WebAssembly (emscripten 3.1.6 of Debian 12): headers of this machine's packages, and yaml-cpp and
# OpenMesh from their sources.
# `-I/usr/include` would bring the C library of this machine, so a folder of links holds those headers alone.
set(ORBC_WASM_INCLUDE ${CMAKE_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${ORBC_WASM_INCLUDE})
foreach(library CGAL boost fmt hwy nlohmann stb tiny_gltf.h)
  file(CREATE_LINK /usr/include/${library} ${ORBC_WASM_INCLUDE}/${library} SYMBOLIC)
endforeach()
add_library(orbc_headers INTERFACE)
target_include_directories(orbc_headers SYSTEM INTERFACE ${ORBC_WASM_INCLUDE})
# Of the libraries for pictures and threads the core has none (exporters/html/core/pictures.cpp).
foreach(name fmt::fmt-header-only Boost::headers CGAL::CGAL PkgConfig::HWY PNG::PNG JPEG::JPEG PkgConfig::PICTURES PkgConfig::OPENEXR TBB::tbb)
  add_library(${name} INTERFACE IMPORTED)
  target_link_libraries(${name} INTERFACE orbc_headers)
endforeach()
target_compile_definitions(fmt::fmt-header-only INTERFACE FMT_HEADER_ONLY)
# The kernels need vectors of doubles, which Highway 1.0.3 does not have for WebAssembly: it emulates them by loops, which the compiler takes.
target_compile_definitions(PkgConfig::HWY INTERFACE HWY_COMPILE_ONLY_EMU128)
# WebAssembly has one rounding mode: without the second definition CGAL's predicates would be silently wrong.
target_compile_definitions(CGAL::CGAL INTERFACE CGAL_DISABLE_GMP CGAL_ALWAYS_ROUND_TO_NEAREST)

# CGAL and yaml-cpp throw; what is not compiled for exceptions would abort there.
add_compile_options(-fwasm-exceptions -msimd128)
add_link_options(-fwasm-exceptions)
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")

set(ORBC_YAML_SOURCE ${CMAKE_SOURCE_DIR}/.packages/yaml-cpp)  # unpacked by scripts/web
file(GLOB yaml_sources ${ORBC_YAML_SOURCE}/src/*.cpp)
if(NOT yaml_sources)
  message(FATAL_ERROR "the source of yaml-cpp is not in ${ORBC_YAML_SOURCE}; scripts/web unpacks it")
endif()
add_library(yaml-cpp STATIC ${yaml_sources})
set_target_properties(yaml-cpp PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
target_include_directories(yaml-cpp SYSTEM PUBLIC ${ORBC_YAML_SOURCE}/include)
target_compile_definitions(yaml-cpp PUBLIC YAML_CPP_STATIC_DEFINE)
target_compile_options(yaml-cpp PRIVATE -w -Oz)

set(ORBC_OPENMESH_SOURCE ${CMAKE_SOURCE_DIR}/.packages/openmesh/src)
file(GLOB openmesh_sources ${ORBC_OPENMESH_SOURCE}/OpenMesh/Core/Mesh/*.cc ${ORBC_OPENMESH_SOURCE}/OpenMesh/Core/Utils/*.cc
  ${ORBC_OPENMESH_SOURCE}/OpenMesh/Core/System/*.cc ${ORBC_OPENMESH_SOURCE}/OpenMesh/Tools/Decimater/*.cc)
list(FILTER openmesh_sources EXCLUDE REGEX "PropertyCreator|RandomNumber")
add_library(openmesh STATIC ${openmesh_sources})
target_include_directories(openmesh SYSTEM PUBLIC ${ORBC_OPENMESH_SOURCE})
target_compile_options(openmesh PRIVATE -w -Oz)
set(ORBC_OPENMESH openmesh)

# tinygltf is one header that makes its library; pictures are left to who reads with it.
file(WRITE ${CMAKE_BINARY_DIR}/tinygltf.cpp "#include <nlohmann/json.hpp>\n#define TINYGLTF_IMPLEMENTATION\n#define TINYGLTF_NO_INCLUDE_JSON
#define TINYGLTF_NO_STB_IMAGE\n#define TINYGLTF_NO_STB_IMAGE_WRITE\n#include <tiny_gltf.h>
namespace tinygltf {
bool LoadImageData(Image*, int, std::string*, std::string*, int, int, const unsigned char*, int, void*) { return false; }
bool WriteImageData(const std::string*, const std::string*, const Image*, bool, std::string*, void*) { return false; }
}\n")
add_library(tinygltf STATIC ${CMAKE_BINARY_DIR}/tinygltf.cpp)
target_link_libraries(tinygltf PUBLIC orbc_headers)
target_compile_options(tinygltf PRIVATE -w -Oz)
set(TINYGLTF_LIBRARY tinygltf)

set(ORBC_FMT fmt::fmt-header-only)
set(ORBC_YAML yaml-cpp)
