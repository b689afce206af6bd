// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGmshLabelMeshWriter.h"

#include "MeshSets.h"
#include "WholeFile.h"

#include <vtkObjectFactory.h>

#include <algorithm>
#include <limits>

vtkStandardNewMacro(vtkGmshLabelMeshWriter);

namespace
{
using namespace LabelMesh;

constexpr int TriangleType = 2;
constexpr int TetrahedronType = 4;

/// The fields of the format's sections, as text or as bytes. In text a space follows each field.
class Fields
{
public:
  Fields(WholeFile& file, bool binary)
    : File(file)
    , Binary(binary)
  {
  }

  Fields& Int(Index value) { return this->Put(value, int(value)); }
  Fields& Size(Index value) { return this->Put(value, std::size_t(value)); }
  Fields& Real(double value) { return this->Put(value, value); }
  void EndLine()
  {
    if (!this->Binary)
    {
      this->File << '\n';
    }
  }
  void Begin(const char* section) { this->File << '$' << section << '\n'; }
  void End(const char* section) { this->File << (this->Binary ? "\n$End" : "$End") << section << '\n'; }

private:
  template <typename Text, typename Bytes>
  Fields& Put(Text text, Bytes bytes)
  {
    if (this->Binary)
    {
      this->File.Binary(bytes);
    }
    else
    {
      this->File << text << ' ';
    }
    return *this;
  }

  WholeFile& File;
  bool Binary;
};

/// Entities of dimension 3 are sets.Elements, of dimension 2 sets.Patches; their tags are their places, from 1 on.
struct Model
{
  const TetraData& Data;
  const MeshSets& Sets;
  std::vector<Index> VolumeTags;               ///< physical, of each set of elements
  std::vector<std::vector<Index>> SurfaceTags; ///< physical, of each patch
  std::vector<std::vector<std::int32_t>> NodesOfPatches, NodesOfElements;
};

std::vector<Index> VolumeTags(const TetraData& data, const MeshSets& sets)
{
  const bool labels = std::all_of(sets.Elements.begin(), sets.Elements.end(),
    [&data](const ElementSet& set)
    {
      const Label label = data.Materials[set.Material].Label;
      return label > 0 && label <= std::numeric_limits<std::int32_t>::max();
    });
  std::vector<Index> tags;
  for (const ElementSet& set : sets.Elements)
  {
    tags.push_back(labels ? data.Materials[set.Material].Label : Index(tags.size()) + 1);
  }
  return tags;
}

/// Each node once: on the first surface that has it, else in its material.
void ShareNodes(Model& model)
{
  const TetraMesh& mesh = model.Data.Mesh;
  constexpr std::int32_t nobody = -1;
  const auto patches = std::int32_t(model.Sets.Patches.size());
  std::vector<std::int32_t> owners(mesh.Points.size(), nobody);
  for (std::int32_t p = 0; p < patches; ++p)
  {
    for (const TetraFace& face : model.Sets.Patches[p].Faces)
    {
      for (const int c : FaceCorners[face.Opposite])
      {
        std::int32_t& owner = owners[mesh.Corners[face.Tetra][c]];
        owner = owner == nobody ? p : owner;
      }
    }
  }
  for (std::size_t e = 0; e < model.Sets.Elements.size(); ++e)
  {
    for (const std::int32_t tetra : model.Sets.Elements[e].Tetrahedra)
    {
      for (const std::int32_t corner : mesh.Corners[tetra])
      {
        owners[corner] = owners[corner] == nobody ? patches + std::int32_t(e) : owners[corner];
      }
    }
  }
  model.NodesOfPatches.resize(model.Sets.Patches.size());
  model.NodesOfElements.resize(model.Sets.Elements.size());
  for (std::size_t n = 0; n < owners.size(); ++n)
  {
    auto& nodes = owners[n] < patches ? model.NodesOfPatches[owners[n]] : model.NodesOfElements[owners[n] - patches];
    nodes.push_back(std::int32_t(n));
  }
}

Model MakeModel(const TetraData& data, const MeshSets& sets)
{
  Model model{ data, sets, VolumeTags(data, sets), {}, {}, {} };
  model.SurfaceTags.resize(sets.Patches.size());
  for (std::size_t s = 0; s < sets.Faces.size(); ++s)
  {
    for (const std::size_t p : sets.Faces[s].Patches)
    {
      model.SurfaceTags[p].push_back(Index(s) + 1);
    }
  }
  ShareNodes(model);
  return model;
}

/// These two sections are text in binary files too.
void WriteFormatAndNames(const Model& model, bool binary, WholeFile& file)
{
  file << "$MeshFormat\n4.1 " << (binary ? '1' : '0') << " 8\n";
  if (binary)
  {
    file.Binary(int(1)) << '\n'; // tells the order of bytes
  }
  file << "$EndMeshFormat\n$PhysicalNames\n" << Index(model.Sets.Faces.size() + model.Sets.Elements.size()) << '\n';
  for (std::size_t s = 0; s < model.Sets.Faces.size(); ++s)
  {
    file << "2 " << Index(s) + 1 << " \"" << model.Sets.Faces[s].Name << "\"\n";
  }
  for (std::size_t e = 0; e < model.Sets.Elements.size(); ++e)
  {
    file << "3 " << model.VolumeTags[e] << " \"" << model.Sets.Elements[e].Name << "\"\n";
  }
  file << "$EndPhysicalNames\n";
}

class Box
{
public:
  void Add(const Vec3& x)
  {
    this->Low = this->Low.cwiseMin(x);
    this->High = this->High.cwiseMax(x);
  }
  void Write(Fields& fields) const
  {
    for (const Vec3* corner : { &this->Low, &this->High })
    {
      fields.Real(corner->x()).Real(corner->y()).Real(corner->z());
    }
  }

private:
  Vec3 Low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 High = Vec3::Constant(-std::numeric_limits<double>::infinity());
};

void WriteSurfaceEntity(const Model& model, std::size_t p, Fields& fields)
{
  const TetraMesh& mesh = model.Data.Mesh;
  Box box;
  for (const TetraFace& face : model.Sets.Patches[p].Faces)
  {
    for (const int c : FaceCorners[face.Opposite])
    {
      box.Add(mesh.Points[mesh.Corners[face.Tetra][c]]);
    }
  }
  fields.Int(Index(p) + 1);
  box.Write(fields);
  fields.Size(Index(model.SurfaceTags[p].size()));
  for (const Index tag : model.SurfaceTags[p])
  {
    fields.Int(tag);
  }
  fields.Size(0).EndLine(); // no bounding curves
}

void WriteVolumeEntity(const Model& model, std::size_t e, Fields& fields)
{
  const TetraMesh& mesh = model.Data.Mesh;
  const ElementSet& set = model.Sets.Elements[e];
  Box box;
  for (const std::int32_t tetra : set.Tetrahedra)
  {
    for (const std::int32_t corner : mesh.Corners[tetra])
    {
      box.Add(mesh.Points[corner]);
    }
  }
  fields.Int(Index(e) + 1);
  box.Write(fields);
  fields.Size(1).Int(model.VolumeTags[e]);
  // Surfaces whose triangles point out of the volume, and, negative, into it.
  std::vector<Index> surfaces;
  for (std::size_t p = 0; p < model.Sets.Patches.size(); ++p)
  {
    const auto& pair = model.Sets.Patches[p].Materials;
    if (pair[0] == set.Material || pair[1] == set.Material)
    {
      surfaces.push_back(pair[0] == set.Material ? Index(p) + 1 : -Index(p) - 1);
    }
  }
  fields.Size(Index(surfaces.size()));
  for (const Index surface : surfaces)
  {
    fields.Int(surface);
  }
  fields.EndLine();
}

void WriteEntities(const Model& model, Fields& fields)
{
  fields.Begin("Entities");
  fields.Size(0).Size(0).Size(Index(model.Sets.Patches.size())).Size(Index(model.Sets.Elements.size())).EndLine();
  for (std::size_t p = 0; p < model.Sets.Patches.size(); ++p)
  {
    WriteSurfaceEntity(model, p, fields);
  }
  for (std::size_t e = 0; e < model.Sets.Elements.size(); ++e)
  {
    WriteVolumeEntity(model, e, fields);
  }
  fields.End("Entities");
}

void WriteNodeBlocks(
  const std::vector<Vec3>& points, const std::vector<std::vector<std::int32_t>>& nodes, int dimension, Fields& fields)
{
  for (std::size_t entity = 0; entity < nodes.size(); ++entity)
  {
    fields.Int(dimension).Int(Index(entity) + 1).Int(0).Size(Index(nodes[entity].size())).EndLine();
    for (const std::int32_t n : nodes[entity])
    {
      fields.Size(Index(n) + 1).EndLine();
    }
    for (const std::int32_t n : nodes[entity])
    {
      fields.Real(points[n].x()).Real(points[n].y()).Real(points[n].z()).EndLine();
    }
  }
}

void WriteNodes(const Model& model, Fields& fields)
{
  const Index count = Index(model.Data.Mesh.Points.size());
  fields.Begin("Nodes");
  fields.Size(Index(model.NodesOfPatches.size() + model.NodesOfElements.size()))
    .Size(count)
    .Size(1)
    .Size(count)
    .EndLine();
  WriteNodeBlocks(model.Data.Mesh.Points, model.NodesOfPatches, 2, fields);
  WriteNodeBlocks(model.Data.Mesh.Points, model.NodesOfElements, 3, fields);
  fields.End("Nodes");
}

void WriteElements(const Model& model, Fields& fields)
{
  const TetraMesh& mesh = model.Data.Mesh;
  const MeshSets& sets = model.Sets;
  Index triangle = Index(mesh.Corners.size());
  Index count = triangle;
  for (const FacePatch& patch : sets.Patches)
  {
    count += Index(patch.Faces.size());
  }
  fields.Begin("Elements");
  fields.Size(Index(sets.Patches.size() + sets.Elements.size())).Size(count).Size(1).Size(count).EndLine();
  for (std::size_t p = 0; p < sets.Patches.size(); ++p)
  {
    fields.Int(2).Int(Index(p) + 1).Int(TriangleType).Size(Index(sets.Patches[p].Faces.size())).EndLine();
    for (const TetraFace& face : sets.Patches[p].Faces)
    {
      fields.Size(++triangle);
      for (const int c : FaceCorners[face.Opposite])
      {
        fields.Size(Index(mesh.Corners[face.Tetra][c]) + 1);
      }
      fields.EndLine();
    }
  }
  for (std::size_t e = 0; e < sets.Elements.size(); ++e)
  {
    fields.Int(3).Int(Index(e) + 1).Int(TetrahedronType).Size(Index(sets.Elements[e].Tetrahedra.size())).EndLine();
    for (const std::int32_t tetra : sets.Elements[e].Tetrahedra)
    {
      fields.Size(Index(tetra) + 1);
      for (const std::int32_t corner : mesh.Corners[tetra])
      {
        fields.Size(Index(corner) + 1);
      }
      fields.EndLine();
    }
  }
  fields.End("Elements");
}
}

LabelMesh::NameRules vtkGmshLabelMeshWriter::Rules() const
{
  return { 120, false, {} }; // Gmsh reads lines of 127 bytes
}

void vtkGmshLabelMeshWriter::WriteSets(const TetraData& data, const MeshSets& sets, WholeFile& file)
{
  const Model model = MakeModel(data, sets);
  WriteFormatAndNames(model, this->Binary != 0, file);
  Fields fields(file, this->Binary != 0);
  WriteEntities(model, fields);
  WriteNodes(model, fields);
  WriteElements(model, fields);
}

void vtkGmshLabelMeshWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Binary: " << this->Binary << "\n";
}
