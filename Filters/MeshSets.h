// SPDX-License-Identifier: BSD-3-Clause
// What a mesh for simulation calls its parts: element sets per material, face sets per interface and side of the box.
#ifndef MeshSets_h
#define MeshSets_h

#include "Core/TetraFaces.h"
#include "TetraReader.h"

#include <string>
#include <vector>

namespace LabelMesh
{
/// What a format allows as the name of a set.
struct NameRules
{
  std::size_t MostBytes = 80;
  /// Only letters, digits and underscores, a letter first, small and capital letters the same (Abaqus); else all but
  /// double quotes and control characters.
  bool Plain = false;
  std::vector<std::string> Taken; ///< names that the format's writer needs itself
};

struct ElementSet
{
  std::string Name;
  MaterialId Material = NoMaterial;
  std::vector<std::int32_t> Tetrahedra;
};

/// Faces under one name: patches of `MeshSets`.
struct FaceSet
{
  std::string Name;
  std::vector<std::size_t> Patches;
};

struct MeshSets
{
  std::vector<FacePatch> Patches;
  std::vector<ElementSet> Elements; ///< a set per material that has tetrahedra, ascending by label
  /// A set per pair of materials, "<name>_<name>", then one per side of the mesh's box that has faces: "border_x_min",
  /// "border_x_max", ... A patch is in one or two sets.
  std::vector<FaceSet> Faces;
};

/// Names are made fit for the rules, and then unique: "_2", "_3", ... is added. Throws as FindPatches.
MeshSets FindSets(const TetraData& data, const NameRules& rules);

/// The points of a set's faces, ascending, each once.
std::vector<std::int32_t> PointsOf(const MeshSets& sets, const FaceSet& set, const TetraMesh& mesh);
}

#endif
