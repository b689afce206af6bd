// SPDX-License-Identifier: BSD-3-Clause
#include "MeshSets.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

namespace LabelMesh
{
namespace
{
bool IsPlain(unsigned char c)
{
  return c < 128 && (std::isalnum(c) || c == '_');
}

/// At most `most` bytes, and no part of a character (of UTF-8) at the end.
std::string Cut(const std::string& name, std::size_t most)
{
  if (name.size() <= most)
  {
    return name;
  }
  std::size_t end = most;
  while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0) == 0x80)
  {
    --end;
  }
  return name.substr(0, end);
}

std::string Fitted(const std::string& name, const NameRules& rules)
{
  std::string fitted = name;
  for (char& letter : fitted)
  {
    const auto c = static_cast<unsigned char>(letter);
    if (rules.Plain ? !IsPlain(c) : c < 32 || c == 127 || c == '"')
    {
      letter = '_';
    }
  }
  if (fitted.empty() || (rules.Plain && !std::isalpha(static_cast<unsigned char>(fitted[0]))))
  {
    fitted = "M" + fitted;
  }
  return Cut(fitted, rules.MostBytes);
}

std::string Key(std::string name, const NameRules& rules)
{
  if (rules.Plain)
  {
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return char(std::toupper(c)); });
  }
  return name;
}

/// Names of one kind of set, all different.
class UniqueNames
{
public:
  explicit UniqueNames(const NameRules& rules)
    : Rules(rules)
  {
    for (const std::string& name : rules.Taken)
    {
      this->Used.insert(Key(name, rules));
    }
  }

  std::string Add(const std::string& name)
  {
    const std::string fitted = Fitted(name, this->Rules);
    std::string unique = fitted;
    for (int n = 2; !this->Used.insert(Key(unique, this->Rules)).second; ++n)
    {
      const std::string number = "_" + std::to_string(n);
      unique = Cut(fitted, this->Rules.MostBytes - number.size()) + number;
    }
    return unique;
  }

private:
  const NameRules& Rules;
  std::set<std::string> Used;
};

std::vector<ElementSet> FindElements(const TetraData& data, const NameRules& rules)
{
  std::vector<ElementSet> all(data.Materials.size());
  for (std::size_t tetra = 0; tetra < data.Mesh.Materials.size(); ++tetra)
  {
    all[data.Mesh.Materials[tetra]].Tetrahedra.push_back(std::int32_t(tetra));
  }
  std::vector<ElementSet> elements;
  UniqueNames names(rules);
  for (std::size_t m = 0; m < all.size(); ++m)
  {
    if (!all[m].Tetrahedra.empty())
    {
      all[m].Material = MaterialId(m);
      all[m].Name = names.Add(data.Materials[m].Name);
      elements.push_back(std::move(all[m]));
    }
  }
  return elements;
}

std::vector<FaceSet> FindFaces(
  const std::vector<FacePatch>& patches, const std::vector<Material>& materials, const NameRules& rules)
{
  static constexpr const char* sides[6] = { "border_x_min", "border_x_max", "border_y_min", "border_y_max",
    "border_z_min", "border_z_max" };
  std::map<std::array<MaterialId, 2>, std::vector<std::size_t>> ofPairs;
  std::map<int, std::vector<std::size_t>> ofSides;
  for (std::size_t p = 0; p < patches.size(); ++p)
  {
    ofPairs[patches[p].Materials].push_back(p);
    if (patches[p].Side != NoSide)
    {
      ofSides[patches[p].Side].push_back(p);
    }
  }
  std::vector<FaceSet> faces;
  UniqueNames names(rules);
  for (auto& [pair, found] : ofPairs)
  {
    faces.push_back({ names.Add(materials[pair[0]].Name + "_" + materials[pair[1]].Name), std::move(found) });
  }
  for (auto& [side, found] : ofSides)
  {
    faces.push_back({ names.Add(sides[side]), std::move(found) });
  }
  return faces;
}
}

MeshSets FindSets(const TetraData& data, const NameRules& rules)
{
  MeshSets sets;
  sets.Patches = FindPatches(data.Mesh, data.Background, data.Axes);
  sets.Elements = FindElements(data, rules);
  sets.Faces = FindFaces(sets.Patches, data.Materials, rules);
  return sets;
}

std::vector<std::int32_t> PointsOf(const MeshSets& sets, const FaceSet& set, const TetraMesh& mesh)
{
  std::vector<std::int32_t> points;
  for (const std::size_t p : set.Patches)
  {
    for (const TetraFace& face : sets.Patches[p].Faces)
    {
      for (const int c : FaceCorners[face.Opposite])
      {
        points.push_back(mesh.Corners[face.Tetra][c]);
      }
    }
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}
}
