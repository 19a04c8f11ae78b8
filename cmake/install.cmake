# What is installed where: `cmake --install build`; the same as Debian packages: `cpack -G DEB` in the build folder.
#   program      bin/orbc, man page, completions; share/orbc: scripts, schema, examples; share/doc/orbc: licences   → orbc.deb
#   development  include/orbc/compiler/… and exporters/…, libraries, find_package(orbc)                             → liborbc-dev.deb
include(CMakePackageConfigHelpers)
set(ORBC_DATA_DIR ${CMAKE_INSTALL_DATADIR}/orbc)
set(ORBC_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/orbc)
set(ORBC_SHARE ${CMAKE_BINARY_DIR}/share)

install(TARGETS orbc RUNTIME COMPONENT program)
install(PROGRAMS scripts/povray-pipe scripts/render_blender.py DESTINATION ${ORBC_DATA_DIR} COMPONENT program)
install(FILES scripts/drawing.py DESTINATION ${ORBC_DATA_DIR} COMPONENT program)
install(FILES schema/orbc-scene.schema.json schema/diagnostics.md DESTINATION ${ORBC_DATA_DIR} COMPONENT program)
install(DIRECTORY examples DESTINATION ${ORBC_DATA_DIR} COMPONENT program)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program RENAME copyright)
install(FILES README.md THIRD_PARTY.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
# Notices of what is compiled in from headers and static libraries; shared libraries bring their own.
foreach(package libboost1.74-dev libcgal-dev libcli11-dev libhwy-dev libopenmesh-dev libtinygltf-dev nlohmann-json3-dev)
  foreach(notice /usr/share/doc/${package}/copyright ${CMAKE_SOURCE_DIR}/.packages/usr/share/doc/${package}/copyright)
    if(EXISTS ${notice})
      install(FILES ${notice} DESTINATION ${CMAKE_INSTALL_DOCDIR}/third-party COMPONENT program RENAME ${package})
      break()
    endif()
  endforeach()
endforeach()

# The build folder is laid out the same way, so that the program finds in it what it finds when installed.
file(MAKE_DIRECTORY ${ORBC_SHARE}/orbc ${ORBC_SHARE}/manual)
foreach(shipped scripts/povray-pipe scripts/render_blender.py scripts/drawing.py)
  get_filename_component(name ${shipped} NAME)
  file(CREATE_LINK ${CMAKE_SOURCE_DIR}/${shipped} ${ORBC_SHARE}/orbc/${name} SYMBOLIC)
endforeach()

# The designer's page, if scripts/web has built it by then; without it `orbc design` says so.
install(FILES ${ORBC_SHARE}/orbc/designer.html DESTINATION ${ORBC_DATA_DIR} COMPONENT program OPTIONAL)

# Man page and completions are printed by the program itself, from the same table as its --help.
if(NOT ORBC_SANITIZE)
  set(manual ${ORBC_SHARE}/manual/orbc.1.gz ${ORBC_SHARE}/manual/orbc.bash ${ORBC_SHARE}/manual/orbc.zsh ${ORBC_SHARE}/manual/orbc.fish)
  add_custom_command(OUTPUT ${manual} DEPENDS orbc WORKING_DIRECTORY ${ORBC_SHARE}/manual VERBATIM COMMAND sh -ec
    "\"$0\" man | gzip -9n > orbc.1.gz; for shell in bash zsh fish; do \"$0\" completion $shell > orbc.$shell; done" $<TARGET_FILE:orbc>)
  add_custom_target(manual ALL DEPENDS ${manual})
  set(to ${ORBC_SHARE}/manual)
  install(FILES ${to}/orbc.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
  install(FILES ${to}/orbc.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program RENAME orbc)
  install(FILES ${to}/orbc.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT program)
  # Debian's zsh reads vendor-completions under /usr and site-functions under /usr/local.
  install(CODE "set(orbc_zsh site-functions)\nif(CMAKE_INSTALL_PREFIX STREQUAL \"/usr\")\n  set(orbc_zsh vendor-completions)\nendif()" COMPONENT program)
  install(FILES ${to}/orbc.zsh DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/\${orbc_zsh}" COMPONENT program RENAME _orbc)
endif()

install(FILES exporters/standpoint.h exporters/text.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/orbc/exporters COMPONENT development)
configure_package_config_file(cmake/orbcConfig.cmake.in orbcConfig.cmake INSTALL_DESTINATION ${ORBC_PACKAGE_DIR})
write_basic_package_version_file(orbcConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(EXPORT orbc NAMESPACE orbc:: FILE orbcTargets.cmake DESTINATION ${ORBC_PACKAGE_DIR} COMPONENT development)
install(FILES ${CMAKE_BINARY_DIR}/orbcConfig.cmake ${CMAKE_BINARY_DIR}/orbcConfigVersion.cmake DESTINATION ${ORBC_PACKAGE_DIR} COMPONENT development)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the authors of orbc <orbc@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "compiler of rooms with mirrors: orbifolds to POV-Ray, Blender and SVG")
set(CPACK_RESOURCE_FILE_LICENSE ${CMAKE_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME orbc)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "povray, python3")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "blender, python3-numpy")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "orbc turns an orbifold such as *22222 into pictures that POV-Ray or Blender draws truly, although light in these rooms follows curves.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME liborbc-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "libboost-dev, libfmt-dev, libgmp-dev, libhwy-dev, libjpeg-dev, libopenexr-dev, libopenmesh1, libpng-dev, libtbb-dev, libtiff-dev, libtinygltf-dev, libwebp-dev, libyaml-cpp-dev, pkg-config")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Headers and static libraries of orbc, for find_package(orbc).")
include(CPack)
