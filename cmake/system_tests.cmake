# Tests that run real programs: povray, blender, node. One line each; labels render and slow.
add_executable(sample_products ${CMAKE_SOURCE_DIR}/tests/system/sample_products.cpp)
target_link_libraries(sample_products PRIVATE orbc::pov orbc::gltf orbc::svg)

# orbc_system_test(name script timeout labels…): runs tests/system/<script> with the folder of the built programs; exit code 77 = a program is missing.
function(orbc_system_test name script timeout)
  add_test(NAME ${name} COMMAND /usr/bin/python3 ${CMAKE_SOURCE_DIR}/tests/system/${script} ${CMAKE_RUNTIME_OUTPUT_DIRECTORY} WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
  set_tests_properties(${name} PROPERTIES LABELS "${ARGN}" TIMEOUT ${timeout} SKIP_RETURN_CODE 77)
endfunction()

orbc_system_test(system_pov_colours pov_colours.py 300 render)
orbc_system_test(system_cameras_povray cameras_povray.py 300 render)
orbc_system_test(system_povray_pipe povray_pipe.py 400 render)
orbc_system_test(system_gltf_valid gltf_valid.py 300 fast)
orbc_system_test(system_svg_pictures svg_pictures.py 300 fast)
orbc_system_test(system_blender blender.py 600 render slow)

add_executable(mirror_room ${CMAKE_SOURCE_DIR}/tests/system/mirror_room.cpp)
target_link_libraries(mirror_room PRIVATE orbc::driver orbc::pov)
orbc_system_test(system_mirrors_against_copies mirrors_against_copies.py 900 render)
orbc_system_test(system_lamp_against_povray lamp_against_povray.py 120 render)
orbc_system_test(system_native_lights native_lights.py 300 render)
orbc_system_test(system_masks masks.py 600 render)
orbc_system_test(system_metals metals.py 600 render)
orbc_system_test(system_examples examples.py 1800 render)
orbc_system_test(system_command_line command_line.py 300 fast)
orbc_system_test(system_verify_rooms verify_rooms.py 1800 render slow)
orbc_system_test(system_scripts scripts.py 300 fast)
if(NOT ORBC_SANITIZE)  # packages are made of what people use
  orbc_system_test(system_package package.py 900 render)
endif()
