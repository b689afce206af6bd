// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialStyle.h"

#include "LabelMeshNames.h"
#include "MaterialArrays.h"

#include <vtkDataArray.h>
#include <vtkDataAssembly.h>
#include <vtkDataObject.h>
#include <vtkDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkSmartPointer.h>

namespace LabelMesh
{
namespace
{
/// The blocks are shared with the original, so each gets a shallow copy of its own.
void StyleBlocks(vtkPartitionedDataSetCollection* surfaces, const std::function<Material(Label)>& styleOf)
{
  vtkNew<vtkDataAssembly> assembly;
  assembly->Initialize();
  assembly->SetRootNodeName(Names::SurfacesRoot);
  for (unsigned int block = 0; block < surfaces->GetNumberOfPartitionedDataSets(); ++block)
  {
    vtkDataSet* original = surfaces->GetPartition(block, 0);
    vtkDataArray* label = original ? original->GetFieldData()->GetArray(Names::Label) : nullptr;
    if (!label)
    {
      continue;
    }
    const Material material = styleOf(Label(label->GetComponent(0, 0)));
    vtkNew<vtkDoubleArray> color;
    color->SetName(Names::Color);
    color->SetNumberOfComponents(3);
    color->InsertNextTuple(material.Color.data());
    const auto copy = vtkSmartPointer<vtkDataSet>::Take(original->NewInstance());
    copy->ShallowCopy(original);
    copy->GetFieldData()->AddArray(color);
    surfaces->SetPartition(block, 0, copy);
    surfaces->GetMetaData(block)->Set(vtkCompositeDataSet::NAME(), material.Name.c_str());
    const int node = assembly->AddNode(vtkDataAssembly::MakeValidNodeName(material.Name.c_str()).c_str());
    assembly->AddDataSetIndex(node, block);
  }
  surfaces->SetDataAssembly(assembly);
}
}

void StyleMaterials(vtkDataObject* output, const std::function<Material(Label)>& styleOf)
{
  vtkFieldData* fieldData = output->GetFieldData();
  std::vector<Material> materials = ReadMaterials(fieldData);
  if (materials.empty())
  {
    return;
  }
  for (Material& material : materials)
  {
    material = styleOf(material.Label);
  }
  WriteMaterials(fieldData, materials, ReadBackground(fieldData));
  if (auto* surfaces = vtkPartitionedDataSetCollection::SafeDownCast(output))
  {
    StyleBlocks(surfaces, styleOf);
  }
}
}
