// SPDX-License-Identifier: BSD-3-Clause
// Meshes two touching boxes and prints how many triangles came out.
#include "vtkLabelMesher.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <iostream>

int main()
{
  vtkNew<vtkImageData> labels;
  labels->SetDimensions(20, 14, 14);
  labels->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  for (int k = 0; k < 14; ++k)
  {
    for (int j = 0; j < 14; ++j)
    {
      for (int i = 0; i < 20; ++i)
      {
        const bool inside = i >= 3 && i < 17 && j >= 3 && j < 11 && k >= 3 && k < 11;
        const int label = !inside ? 0 : (i < 10 ? 1 : 2);
        labels->SetScalarComponentFromDouble(i, j, k, 0, label);
      }
    }
  }

  vtkNew<vtkLabelMesher> mesher;
  mesher->SetInputData(labels);
  mesher->Update();

  auto* mesh = vtkPolyData::SafeDownCast(mesher->GetOutputDataObject(0));
  const vtkIdType triangles = mesh ? mesh->GetNumberOfPolys() : 0;
  std::cout << triangles << " triangles\n";
  return triangles > 0 ? 0 : 1;
}
