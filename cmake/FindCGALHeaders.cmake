# SPDX-License-Identifier: BSD-3-Clause
# CGAL's headers and GMP, which they compute with where floating point does not tell. CGAL's own package would add
# -frounding-math to everything that links it, where inner loops that know nothing of rounding modes would suffer.
# Defines the target CGALHeaders::CGALHeaders.
# CGAL's triangulations are GPL-3.0: a binary made with them is under GPL-3.0.
find_path(CGALHeaders_INCLUDE_DIR CGAL/Delaunay_triangulation_3.h)
find_library(CGALHeaders_GMP_LIBRARY NAMES gmp)
mark_as_advanced(CGALHeaders_INCLUDE_DIR CGALHeaders_GMP_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CGALHeaders REQUIRED_VARS CGALHeaders_INCLUDE_DIR CGALHeaders_GMP_LIBRARY)

if(CGALHeaders_FOUND AND NOT TARGET CGALHeaders::CGALHeaders)
  add_library(CGALHeaders::CGALHeaders INTERFACE IMPORTED)
  set_target_properties(CGALHeaders::CGALHeaders PROPERTIES
    INTERFACE_LINK_LIBRARIES "${CGALHeaders_GMP_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${CGALHeaders_INCLUDE_DIR}")
endif()
