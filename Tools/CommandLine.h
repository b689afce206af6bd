// SPDX-License-Identifier: BSD-3-Clause
// The command line of labelmesh.
#ifndef CommandLine_h
#define CommandLine_h

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

/// What a material has of its own (--material LABEL:key=value,...). Radii in voxels, lengths in world units.
struct MaterialOptions
{
  std::optional<double> Radius, OpeningRadius, ClosingRadius, MaximumLength;
  std::optional<std::string> Name;
  std::optional<std::array<double, 3>> Color;
};

struct CommandLine
{
  bool Help = false;
  bool Version = false;
  std::string Input;
  std::string Mesh, Surfaces, Particles, Tets, Report, ErrorMap; ///< files to write; empty: not asked for
  bool Grid = false;                                             ///< --method grid
  bool TetsByTetGen = false;                                     ///< --tet-method tetgen
  int TetRefinementRounds = 0;                                   ///< --tet-refine
  std::optional<int> TetImprovePasses;                           ///< --tet-improve
  bool TetSlide = true;                                          ///< --tet-slide
  std::vector<long long> Labels;
  long long Background = 0;
  long long MinimumComponent = 0; ///< voxels
  int MaximumUpsampling = 1;      ///< samples per voxel along each axis
  std::map<long long, MaterialOptions> Materials;
  std::map<std::array<long long, 2>, double> InterfaceLengths; ///< --interface A,B:length=L; world units
  bool FlatBorder = false;                                     ///< --border flat
  bool Tightening = false;                                     ///< --smoothing tighten
  std::optional<double> Radius, Epsilon, MinimumLength, MaximumLength, MaximumDeviation, Gradation;
  std::optional<double> VolumeGradation, VolumeMaximumLength;
  long long Triangles = 0;
  std::optional<double> MemoryLimit; ///< GiB
  int Threads = 0;                   ///< 0: as many as there are
  bool Quiet = false;
};

/// Throws std::invalid_argument with a sentence.
CommandLine ParseCommandLine(int argc, char** argv);

/// What --help prints.
std::string HelpText();

#endif
