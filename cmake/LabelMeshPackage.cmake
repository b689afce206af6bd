# SPDX-License-Identifier: BSD-3-Clause
# What find_package(LabelMesh) reads, in the build tree and installed. The targets themselves are exported by
# vtk_module_build().
include(CMakePackageConfigHelpers)

vtk_module_export_find_packages(
  CMAKE_DESTINATION "${LABELMESH_CMAKE_DESTINATION}"
  FILE_NAME "LabelMesh-vtk-module-find-packages.cmake"
  MODULES ${labelmesh_modules})

set(labelmesh_package "${CMAKE_BINARY_DIR}/${LABELMESH_CMAKE_DESTINATION}")
configure_package_config_file(cmake/LabelMeshConfig.cmake.in "${labelmesh_package}/LabelMeshConfig.cmake"
  INSTALL_DESTINATION "${LABELMESH_CMAKE_DESTINATION}")
write_basic_package_version_file("${labelmesh_package}/LabelMeshConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
configure_file(cmake/FindTetGen.cmake "${labelmesh_package}/FindTetGen.cmake" COPYONLY)

install(
  FILES
    "${labelmesh_package}/LabelMeshConfig.cmake"
    "${labelmesh_package}/LabelMeshConfigVersion.cmake"
    "${labelmesh_package}/FindTetGen.cmake"
  DESTINATION "${LABELMESH_CMAKE_DESTINATION}")
install(FILES LICENSE NOTICE README.md CHANGELOG.md DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(DIRECTORY Examples/Cxx Examples/Python DESTINATION "${CMAKE_INSTALL_DOCDIR}/examples")
