// SPDX-License-Identifier: BSD-3-Clause
#include "ReportFacts.h"

#include "Core/MeshLabels.h"
#include "Core/Parallel.h"
#include "LabelImage.h"
#include "LabelMeshNames.h"
#include "RebuiltVoxels.h"

#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTypeInt64Array.h>
#include <vtkVariant.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>

namespace LabelMesh
{
namespace
{
MaterialId IdOf(const std::vector<Material>& materials, Label label)
{
  const auto at =
    std::lower_bound(materials.begin(), materials.end(), label, [](const Material& m, Label l) { return m.Label < l; });
  return at != materials.end() && at->Label == label ? MaterialId(at - materials.begin()) : NoMaterial;
}

std::vector<MaterialId> IdsOf(const std::vector<Material>& materials, const std::vector<Label>& labels)
{
  std::vector<MaterialId> ids;
  std::transform(labels.begin(), labels.end(), std::back_inserter(ids),
    [&materials](Label label) { return IdOf(materials, label); });
  return ids;
}

/// The volume's labels; those that the mesh does not list are background.
LabelImage ReadVolume(const ReportInputs& inputs, const InterfaceData& mesh)
{
  LabelImage volume = ReadLabelImage(inputs.Volume, inputs.VolumeLabels, inputs.LabelsOfCells);
  if (inputs.Mesh->GetFieldData()->GetAbstractArray(Names::Labels))
  {
    std::vector<Label> kept;
    std::transform(mesh.Materials.begin(), mesh.Materials.end(), std::back_inserter(kept),
      [](const Material& m) { return m.Label; });
    vtkFieldData* stages = inputs.Stages ? inputs.Stages->GetFieldData() : nullptr;
    vtkDataArray* dropped = stages ? stages->GetArray(Names::DroppedLabels) : nullptr;
    for (vtkIdType n = 0; dropped && n < dropped->GetNumberOfValues(); ++n)
    {
      kept.push_back(dropped->GetVariantValue(n).ToTypeInt64());
    }
    std::sort(kept.begin(), kept.end());
    MergeIntoBackground(volume, kept, mesh.Background);
  }
  return volume;
}

/// Adds labels to the mesh's materials, and renumbers its triangles and sets.
void AddMaterials(const std::vector<Label>& labels, InterfaceData& mesh)
{
  std::vector<Label> old;
  std::set<Label> all(labels.begin(), labels.end());
  std::map<Label, Material> known;
  for (const Material& material : mesh.Materials)
  {
    old.push_back(material.Label);
    all.insert(material.Label);
    known[material.Label] = material;
  }
  mesh.Materials.clear();
  for (const Label label : all)
  {
    const auto at = known.find(label);
    mesh.Materials.push_back(at != known.end() ? at->second : DefaultMaterial(label));
  }
  if (mesh.Materials.size() >= NoMaterial)
  {
    throw std::invalid_argument("The mesh and the label image have " + std::to_string(mesh.Materials.size()) +
      " labels together, at most " + std::to_string(NoMaterial - 1) + " are possible.");
  }
  const std::vector<MaterialId> ids = IdsOf(mesh.Materials, old);
  for (InterfaceTriangle& triangle : mesh.Triangles)
  {
    triangle.Materials = { ids[triangle.Materials[0]], ids[triangle.Materials[1]] };
  }
  for (MaterialSet& set : mesh.Sets)
  {
    MaterialSet renumbered;
    for (const MaterialId id : set)
    {
      renumbered.Insert(ids[id]);
    }
    set = renumbered;
  }
}

/// Volumes by material from the field data of a collection; empty when it has none.
std::vector<double> FieldVolumes(vtkDataObject* object, const char* name, const std::vector<Material>& materials)
{
  vtkFieldData* fieldData = object ? object->GetFieldData() : nullptr;
  vtkDataArray* array = fieldData ? fieldData->GetArray(name) : nullptr;
  std::vector<double> volumes;
  if (array)
  {
    volumes.assign(materials.size(), std::numeric_limits<double>::quiet_NaN());
    const std::vector<Material> listed = ReadMaterials(fieldData);
    const std::size_t count = std::min(listed.size(), std::size_t(array->GetNumberOfValues()));
    for (std::size_t i = 0; i < count; ++i)
    {
      const MaterialId id = IdOf(materials, listed[i].Label);
      if (id != NoMaterial)
      {
        volumes[id] = array->GetVariantValue(vtkIdType(i)).ToDouble();
      }
    }
  }
  return volumes;
}

/// A world position as a continuous index that begins with 0.
Vec3 IndexOf(const GridFrame& frame, const Vec3& world)
{
  const std::array<int, 6>& extent = frame.Extent();
  return frame.ToIndex(world) - Vec3(extent[0], extent[2], extent[4]);
}

/// The components that Label Split was asked to drop, from the field data of a collection. Their labels must be among
/// the materials.
std::vector<Loss> ReadDropped(vtkDataObject* object, const GridFrame& frame, const std::vector<Material>& materials)
{
  vtkFieldData* fieldData = object ? object->GetFieldData() : nullptr;
  std::array<vtkDataArray*, 4> arrays{};
  const char* const names[] = { Names::DroppedLabels, Names::DroppedInto, Names::DroppedVoxels,
    Names::DroppedPositions };
  for (int n = 0; n < 4; ++n)
  {
    arrays[n] = fieldData ? fieldData->GetArray(names[n]) : nullptr;
    if (!arrays[n] || arrays[n]->GetNumberOfTuples() != arrays[0]->GetNumberOfTuples() ||
      arrays[n]->GetNumberOfComponents() != (n == 3 ? 3 : 1))
    {
      return {};
    }
  }
  const Lattice samples = frame.Samples();
  std::vector<Loss> dropped;
  for (vtkIdType n = 0; n < arrays[0]->GetNumberOfTuples(); ++n)
  {
    Loss loss;
    loss.Kind = Loss::Dropped;
    loss.Stage = LossStage::Split;
    for (int side = 0; side < 2; ++side)
    {
      loss.Materials[side] = IdOf(materials, arrays[side]->GetVariantValue(n).ToTypeInt64());
    }
    loss.Parts = 1;
    loss.Voxels = loss.Largest = arrays[2]->GetVariantValue(n).ToTypeInt64();
    Vec3 world;
    arrays[3]->GetTuple(n, world.data());
    const Vec3 at = IndexOf(frame, world).array().round();
    const auto inside = [&](int a) { return at[a] >= 0 && at[a] < samples.Dims[a]; };
    if (loss.Materials[0] != NoMaterial && loss.Materials[1] != NoMaterial && inside(0) && inside(1) && inside(2))
    {
      loss.Sample = samples.At(Index(at[0]), Index(at[1]), Index(at[2]));
      dropped.push_back(loss);
    }
  }
  return dropped;
}

/// Gives the voxels of dropped components to the labels that the mesh has there.
void ApplyDropped(const std::vector<Loss>& dropped, const std::array<int, 3>& dims, MaterialId background,
  std::size_t materials, std::vector<MaterialId>& ids)
{
  if (dropped.empty())
  {
    return;
  }
  std::map<Index, MaterialId> given; // by the first voxel
  for (const Loss& loss : dropped)
  {
    given[loss.Sample] = loss.Materials[1];
  }
  const VoxelObjects objects = FindVoxelParts(dims, ids, background, int(materials));
  for (const VoxelRun& run : objects.Runs)
  {
    const auto found = given.find(objects.Parts[run.Part].First);
    if (found != given.end())
    {
      std::fill(ids.begin() + run.First, ids.begin() + run.Last, found->second);
    }
  }
}

/// What the indicators say of the voxels; empty when nothing was given that tells.
std::vector<MaterialId> TightIdsOf(
  const ReportInputs& inputs, const LabelImage& image, const std::vector<Material>& materials, MaterialId background)
{
  std::vector<Label> labels;
  if (inputs.Tightened && inputs.Tightened->GetNumberOfPoints() > 0)
  {
    labels = RebuiltLabelsAt(inputs.Tightened, image.Frame, materials[background].Label);
  }
  else if (inputs.Stages)
  {
    labels = ReadRebuiltVoxels(inputs.Stages->GetFieldData(), image);
  }
  std::vector<MaterialId> ids = IdsOf(materials, labels);
  std::replace(ids.begin(), ids.end(), NoMaterial, background);
  return ids;
}

std::vector<Vec3> IndicesOf(const GridFrame& frame, const std::vector<Vec3>& points)
{
  std::vector<Vec3> indices;
  indices.reserve(points.size());
  for (const Vec3& point : points)
  {
    indices.push_back(IndexOf(frame, point));
  }
  return indices;
}

std::vector<ParticleSite> ReadParticles(
  vtkPolyData* particles, const GridFrame& frame, const std::vector<Material>& materials)
{
  vtkDataArray* sets = particles->GetPointData()->GetArray(Names::Materials);
  vtkDataArray* numbers = particles->GetPointData()->GetArray(Names::NumberOfMaterials);
  if (particles->GetNumberOfPoints() > 0 && (!sets || !numbers))
  {
    throw std::invalid_argument(std::string("The particles have no point arrays '") + Names::Materials + "' and '" +
      Names::NumberOfMaterials + "'. Connect the output of Particle Sample Cells.");
  }
  vtkNew<vtkTypeInt64Array> labels; // doubles would round large ones
  if (sets)
  {
    labels->DeepCopy(sets);
  }
  std::vector<ParticleSite> sites(static_cast<std::size_t>(particles->GetNumberOfPoints()));
  for (std::size_t n = 0; n < sites.size(); ++n)
  {
    Vec3 world;
    particles->GetPoint(vtkIdType(n), world.data());
    sites[n].Position = IndexOf(frame, world);
    const int count = std::min(int(numbers->GetComponent(vtkIdType(n), 0)), labels->GetNumberOfComponents());
    for (int c = 0; c < count; ++c)
    {
      const MaterialId id = IdOf(materials, labels->GetTypedComponent(vtkIdType(n), c));
      if (id != NoMaterial)
      {
        sites[n].Materials.Insert(id);
      }
    }
  }
  return sites;
}

void CountMisclassified(const std::vector<MaterialId>& meshIds, std::size_t materials, VolumeFacts& volume)
{
  volume.Misclassified.assign(materials, 0);
  for (std::size_t v = 0; v < meshIds.size(); ++v)
  {
    volume.Misclassified[volume.Ids[v]] += meshIds[v] != volume.Ids[v] ? 1 : 0;
    volume.Undecided += meshIds[v] == NoMaterial ? 1 : 0;
  }
}

void FindVolumeFacts(const ReportInputs& inputs, const LabelImage& image, ReportFacts& facts, const Monitor& monitor)
{
  const std::vector<Material>& materials = facts.Mesh.Materials;
  VolumeFacts& volume = facts.Volume;
  volume.Frame = image.Frame;
  const std::vector<MaterialId> ids = IdsOf(materials, image.Labels);
  volume.Ids.reserve(image.Ids.size());
  std::transform(
    image.Ids.begin(), image.Ids.end(), std::back_inserter(volume.Ids), [&ids](MaterialId id) { return ids[id]; });
  const std::array<int, 3> dims = image.Frame.Samples().Dims;
  const std::vector<Loss> dropped = ReadDropped(inputs.Stages, volume.Frame, materials);
  ApplyDropped(dropped, dims, facts.Background, materials.size(), volume.Ids);
  volume.Voxels = FindVoxelObjects(dims, volume.Ids, facts.Background, int(materials.size()));
  monitor.Step(0.3);
  const std::vector<MaterialId> meshIds =
    LabelsByMesh(dims, IndicesOf(volume.Frame, facts.Mesh.Points), facts.Mesh.Triangles, facts.Background);
  CountMisclassified(meshIds, materials.size(), volume);
  monitor.Step(0.7);

  LedgerInput ledger{ dims, volume.Voxels, meshIds, {}, {}, facts.MaskVolumes, facts.TightVolumes, {}, {} };
  for (const MaterialCheck& check : facts.Check.Materials)
  {
    ledger.Triangles.push_back(check.Quality.Triangles);
  }
  for (const PairCheck& pair : facts.Check.Pairs)
  {
    ledger.Pairs.insert(pair.Materials);
  }
  ledger.TightIds = TightIdsOf(inputs, image, materials, facts.Background);
  if (inputs.Particles)
  {
    ledger.Particles = ReadParticles(inputs.Particles, volume.Frame, materials);
  }
  volume.Losses = FindLosses(ledger);
  volume.Losses.insert(volume.Losses.begin(), dropped.begin(), dropped.end());
  volume.LostParts.assign(materials.size(), 0);
  for (const Loss& loss : volume.Losses)
  {
    if (loss.Kind != Loss::TouchingPair && loss.Kind != Loss::Dropped)
    {
      volume.LostParts[loss.Materials[0]] += loss.Parts;
    }
  }
}
}

bool ReportFacts::Certified() const
{
  const MeshCheck& check = this->Check;
  return check.Quality.Triangles > 0 && check.SelfIntersectingPairs == 0 && check.DuplicateTriangles == 0 &&
    check.DegenerateTriangles == 0 && check.SameMaterialTriangles == 0 && check.WrongFaces == 0 &&
    std::all_of(check.Materials.begin(), check.Materials.end(), [](const MaterialCheck& m) { return m.Sound(); });
}

ReportFacts FindFacts(const ReportInputs& inputs, const Monitor& monitor)
{
  ReportFacts facts;
  facts.Mesh = ReadInterface(inputs.Mesh);
  facts.HasVolume = inputs.Volume != nullptr;
  const LabelImage image = facts.HasVolume ? ReadVolume(inputs, facts.Mesh) : LabelImage();
  facts.ShowBackground = IdOf(facts.Mesh.Materials, facts.Mesh.Background) != NoMaterial ||
    std::binary_search(image.Labels.begin(), image.Labels.end(), facts.Mesh.Background);
  std::vector<Label> labels = image.Labels;
  labels.push_back(facts.Mesh.Background);
  AddMaterials(labels, facts.Mesh);
  facts.Background = IdOf(facts.Mesh.Materials, facts.Mesh.Background);
  facts.MaskVolumes = FieldVolumes(inputs.Stages, Names::MaskVolumes, facts.Mesh.Materials);
  facts.TightVolumes = FieldVolumes(inputs.Stages, Names::TightVolumes, facts.Mesh.Materials);
  monitor.Step(0.1, "Checking the mesh");
  facts.Check = CheckMesh(facts.Mesh.Points, facts.Mesh.Triangles, int(facts.Mesh.Materials.size()), facts.Mesh.Sets);
  if (facts.HasVolume)
  {
    monitor.Step(0.6, "Looking for what was lost");
    FindVolumeFacts(inputs, image, facts, monitor.Part(0.6, 1.0));
  }
  return facts;
}

std::vector<double> DistancesOf(const ReportFacts& facts)
{
  const VolumeFacts& volume = facts.Volume;
  const LabelVoxels voxels{ volume.Frame.Samples().Dims, volume.Frame.Spacing(), facts.Background, volume.Ids };
  return DistancesToVoxels(voxels, IndicesOf(volume.Frame, facts.Mesh.Points), facts.Mesh.Triangles);
}
}
