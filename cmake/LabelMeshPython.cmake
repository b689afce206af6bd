# SPDX-License-Identifier: BSD-3-Clause
# The Python package `labelmesh`: the filters, wrapped for VTK Python.
# The same place in both configurations: what VTK proposes differs between ParaView's VTK and Debian's.
set(labelmesh_site_packages
  "${CMAKE_INSTALL_LIBDIR}/python${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}/site-packages")

vtk_module_wrap_python(
  MODULES ${labelmesh_modules}
  TARGET LabelMesh::Python
  PYTHON_PACKAGE "labelmesh"
  MODULE_DESTINATION "${labelmesh_site_packages}"
  LIBRARY_DESTINATION "${CMAKE_INSTALL_LIBDIR}" # without it the module finds no library (no RPATH)
  CMAKE_DESTINATION "${LABELMESH_CMAKE_DESTINATION}"
  INSTALL_HEADERS OFF
  BUILD_STATIC OFF)

configure_file("${PROJECT_SOURCE_DIR}/cmake/labelmesh_init.py.in"
  "${CMAKE_BINARY_DIR}/${labelmesh_site_packages}/labelmesh/__init__.py" @ONLY)
install(FILES "${CMAKE_BINARY_DIR}/${labelmesh_site_packages}/labelmesh/__init__.py"
  DESTINATION "${labelmesh_site_packages}/labelmesh")

configure_file("${PROJECT_SOURCE_DIR}/cmake/install_stubs.cmake.in" "${CMAKE_BINARY_DIR}/install_stubs.cmake" @ONLY)
install(SCRIPT "${CMAKE_BINARY_DIR}/install_stubs.cmake")
