// SPDX-License-Identifier: BSD-3-Clause
// Names and colours of materials, given to what is meshed already.
#ifndef MaterialStyle_h
#define MaterialStyle_h

#include "IndicatorCollection.h"

#include <functional>

class vtkDataObject;

namespace LabelMesh
{
/// Gives the materials that the field data names (Labels, MaterialNames, MaterialColors) what `styleOf` says of each
/// label; with a collection of surfaces its blocks too, their names, colours and nodes of the assembly. Arrays are
/// replaced, not written to: `output` may be a shallow copy, and its original stays as it is.
void StyleMaterials(vtkDataObject* output, const std::function<Material(Label)>& styleOf);
}

#endif
