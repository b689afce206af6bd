# SPDX-License-Identifier: BSD-3-Clause
# The Debian package: `cpack` in the build folder of the preset paraview. It has the plugin, which Debian's ParaView loads by
# itself, the application, the Python package, and what C++ projects need.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME labelmesh)
set(CPACK_PACKAGE_VENDOR "LabelMesh developers")
set(CPACK_PACKAGE_CONTACT "LabelMesh developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Meshes of label volumes for ParaView, VTK and the command line")
set(CPACK_PACKAGE_DESCRIPTION "Watertight, conforming, adaptive triangle meshes of the material interfaces of label
volumes, and tetrahedra inside them: a ParaView plugin, VTK filters for C++ and Python, and the program labelmesh.")
set(CPACK_PACKAGING_INSTALL_PREFIX "/usr")
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_PRE_BUILD_SCRIPTS "${CMAKE_CURRENT_LIST_DIR}/debian/layout.cmake")
set(CPACK_LABELMESH_PYTHON_PACKAGE "${labelmesh_site_packages}/labelmesh") # for that script

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON) # the exact ParaView too, whose libraries keep no promises between versions
set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3-paraview")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA "${CMAKE_CURRENT_LIST_DIR}/debian/prerm")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "paraview-dev")
include(CPack)
