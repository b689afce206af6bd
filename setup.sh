#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# From a bare Debian 12 to a working LabelMesh:
#   ./setup.sh demo    installs what is missing, builds, meshes two spheres both ways, writes demo/ and a comparison
#   ./setup.sh test    the same set-up, then all tests, with ParaView's VTK and with plain VTK
#   ./setup.sh build   stops after the build: build/bin/labelmesh, build/lib/python3*/site-packages, the plugin
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

# Each line: what for.
packages=(
  g++ cmake ninja-build                                            # build
  paraview paraview-dev python3-paraview                           # ParaView 5.11 with its own VTK
  libcgal-dev libtet1.5-dev libeigen3-dev zlib1g-dev libgtest-dev              # libraries of our own
  libopenmpi-dev libutfcpp-dev libdouble-conversion-dev libexpat1-dev liblz4-dev liblzma-dev libtbb-dev  # VTK's packages ask
  libpng-dev libjpeg-dev libtiff-dev python3-dev                   #   for the development files of what they were built with
  libqt5opengl5-dev qtbase5-dev qttools5-dev qtxmlpatterns5-dev-tools libqt5svg5-dev # help pages and widgets of the plugin
  libboost-dev libnetcdf-dev libhdf5-openmpi-dev libxml2-dev libglew-dev            #   what ParaView's Qt components name
  python3-numpy python3-matplotlib                                 # volumes of the demo and the tests; figures
  mpi-default-bin xvfb xauth                                       # pvbatch; a display for pictures and for the application
)
test_packages=(
  dpkg-dev                                                         # makes and tries the Debian package
  gmsh python3-gmsh calculix-ccx                                   # read the meshes for simulation, and solve with them
)

say()
{
  printf '\n== %s\n' "$*"
}

as_root()
{
  if [ "$(id -u)" = 0 ]
  then
    "$@"
  elif command -v sudo >/dev/null
  then
    sudo "$@"
  else
    echo "setup.sh: run me as root, or install sudo: packages are missing." >&2
    return 1
  fi
}

apt()
{
  as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq "$@"
}

# install_packages PACKAGE...: those that are missing.
install_packages()
{
  local missing=() package
  for package in "$@"
  do
    if [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" != installed ]
    then
      missing+=("$package")
    fi
  done
  if [ ${#missing[@]} -gt 0 ]
  then
    say "Installing ${missing[*]}"
    apt update
    apt install --no-install-recommends -y -o Dpkg::Use-Pty=0 "${missing[@]}" >/dev/null
  fi
}

# Debian's VTK 9.1 cannot be installed beside ParaView (python3-vtk9 and python3-paraview exclude each other), so it is
# unpacked into a folder of its own.
unpack_vtk()
{
  local prefix=build-vtk/prefix
  vtk_dir=$(echo "$PWD/$prefix"/usr/lib/*/cmake/vtk-9.1)
  if [ ! -e "$vtk_dir/vtk-config.cmake" ]
  then
    say "Unpacking VTK 9.1 into $prefix"
    local packages=(libvtk9-dev libvtk9.1 python3-vtk9 vtk9) folder=build-vtk/packages package
    rm -rf "$prefix" "$folder"
    mkdir -p "$prefix" "$folder"
    (cd "$folder" && { apt-get -qq download "${packages[@]}" 2>/dev/null || { apt update && apt-get -qq download "${packages[@]}"; }; })
    for package in "$folder"/*.deb
    do
      dpkg -x "$package" "$prefix"
    done
    vtk_dir=$(echo "$PWD/$prefix"/usr/lib/*/cmake/vtk-9.1)
  fi
}

# build_preset PRESET FOLDER [OPTION...]: the log of the configuration is only shown when it fails.
build_preset()
{
  local preset=$1 folder=$2
  shift 2
  say "Building in $folder (preset $preset)"
  mkdir -p "$folder"
  if ! cmake --preset "$preset" "$@" >"$folder/configure.log" 2>&1
  then
    cat "$folder/configure.log"
    return 1
  fi
  cmake --build "$folder" -j "$(nproc)"
}

run_tests()
{
  say "Testing in $1"
  ctest --test-dir "$1" --output-on-failure --no-tests=error -j "$(nproc)"
}

demo()
{
  local mesh=demo/two_spheres triangles
  mkdir -p demo
  say "Meshing two spheres: by particles, and on the grid with as many triangles"
  /usr/bin/python3 Data/make_volumes.py demo two_spheres
  build/bin/labelmesh $mesh.mha --method particle -o $mesh.particle.vtp --surfaces $mesh.particle.vtpc \
    --particles $mesh.particles.vtp --report $mesh.particle.json
  triangles=$(/usr/bin/python3 -c 'import json, sys; print(json.load(open(sys.argv[1]))["triangles"])' $mesh.particle.json)
  build/bin/labelmesh $mesh.mha --method grid --triangles "$triangles" -o $mesh.grid.vtp \
    --surfaces $mesh.grid.vtpc --report $mesh.grid.json
  say "Rendering"
  OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 Testing/with_display.sh \
    pvbatch Examples/render_comparison.py $mesh.particle.vtp $mesh.grid.vtp $mesh.png
  say "Results, in demo/"
  ls demo
  echo
  /usr/bin/python3 Examples/compare_reports.py $mesh.particle.json $mesh.grid.json
}

case "${1:-}" in
  build)
    install_packages "${packages[@]}"
    build_preset paraview build -DLABELMESH_TESTING=OFF
    say "Built: build/bin/labelmesh, $(echo build/lib/python3*/site-packages), $(echo build/lib/paraview-5.11/plugins/LabelMesh/*.so)"
    ;;
  demo)
    install_packages "${packages[@]}"
    build_preset paraview build -DLABELMESH_TESTING=OFF
    demo
    ;;
  test)
    install_packages "${packages[@]}" "${test_packages[@]}"
    unpack_vtk
    build_preset paraview build -DLABELMESH_TESTING=ON
    build_preset vtk build-vtk -DLABELMESH_TESTING=ON -DVTK_DIR="$vtk_dir"
    run_tests build
    run_tests build-vtk
    ;;
  *)
    sed -n '3,6s/^# \{0,1\}//p' "$0"
    exit 2
    ;;
esac
