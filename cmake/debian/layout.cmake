# SPDX-License-Identifier: BSD-3-Clause
# Run by cpack on the files that it packs: Debian's Python and its documentation have places of their own.
set(root "${CPACK_TEMPORARY_INSTALL_DIRECTORY}")
file(MAKE_DIRECTORY "${root}/usr/lib/python3/dist-packages")
file(CREATE_LINK "../../../${CPACK_LABELMESH_PYTHON_PACKAGE}" "${root}/usr/lib/python3/dist-packages/labelmesh" SYMBOLIC)
file(RENAME "${root}/usr/share/doc/LabelMesh" "${root}/usr/share/doc/labelmesh")
file(READ "${root}/usr/share/doc/labelmesh/LICENSE" licence)
file(READ "${root}/usr/share/doc/labelmesh/NOTICE" notice)
file(WRITE "${root}/usr/share/doc/labelmesh/copyright" "${notice}\n${licence}")
file(REMOVE "${root}/usr/share/doc/labelmesh/LICENSE" "${root}/usr/share/doc/labelmesh/NOTICE")
