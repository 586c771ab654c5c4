# Debian packages by `cpack`, from a build that is configured for the prefix /usr: ./dev package makes and tests them.
# The program is the package lamina, the Python module python3-lamina, libraries and headers liblamina-dev. What they
# depend on follows from the libraries that they are linked to (dpkg-shlibdeps).
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/lamina RENAME copyright COMPONENT app)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/liblamina-dev RENAME copyright COMPONENT core)
if(LAMINA_PYTHON)
  install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-lamina RENAME copyright COMPONENT python)
endif()

set(CPACK_PACKAGE_NAME lamina)
set(CPACK_PACKAGE_CONTACT "the lamina authors <lamina@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX ${CMAKE_INSTALL_PREFIX})
set(CPACK_GENERATOR DEB)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_COMPONENTS_ALL core ${LAMINA_COMPONENTS} sizing)

if(LAMINA_APP)
  list(APPEND CPACK_COMPONENTS_ALL app)
endif()
set(CPACK_DEBIAN_APP_PACKAGE_NAME lamina)
set(CPACK_COMPONENT_APP_DESCRIPTION "Makes meshes for viscous flow round airfoils: boundary layers along walls, and
 graded Delaunay triangles out to the far field, for SU2, OpenFOAM, CGNS, Gmsh, FUN3D and ParaView.")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME liblamina-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_SHLIBDEPS OFF)  # static libraries: whoever links them needs what they were built on
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libtbb-dev, libfmt-dev, zlib1g-dev, libcairo2-dev")
if(LAMINA_CGNS)
  string(APPEND CPACK_DEBIAN_DEV_PACKAGE_DEPENDS ", libcgns-dev")
endif()
set(CPACK_COMPONENT_GROUP_DEV_DESCRIPTION "Libraries and headers of lamina, for find_package(lamina) and pkg-config.")

if(LAMINA_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  math(EXPR next_python "${LAMINA_PYTHON_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-lamina)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3 (>= 3.${LAMINA_PYTHON_MINOR}), python3 (<< 3.${next_python}), python3-numpy (>= 1:1.22)")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-matplotlib, python3-meshio")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
    "${PROJECT_SOURCE_DIR}/packaging/debian/postinst;${PROJECT_SOURCE_DIR}/packaging/debian/prerm")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION
    "Python package lamina: meshes for viscous flow round airfoils as NumPy arrays.")
endif()

include(CPack)
cpack_add_component_group(dev)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  if(NOT component MATCHES "^(app|python)$")
    cpack_add_component(${component} GROUP dev)
  endif()
endforeach()
