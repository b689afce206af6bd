// SPDX-License-Identifier: BSD-3-Clause
// The tables and the words of vtkLabelMeshReport.
#ifndef ReportTables_h
#define ReportTables_h

#include "ReportFacts.h"

#include <string>

class vtkFieldData;
class vtkTable;

namespace LabelMesh
{
/// The columns are listed in vtkLabelMeshReport.h.
void FillMaterials(vtkTable* table, const ReportFacts& facts);
void FillInterfaces(vtkTable* table, const ReportFacts& facts);
void FillLosses(vtkTable* table, const ReportFacts& facts);
void AddTotals(vtkFieldData* fieldData, const ReportFacts& facts);
void AddDistances(vtkFieldData* fieldData, const std::vector<double>& distances);

/// "certified: ..." with the figures that it stands on, or "not certified: ..." with each kind of fault, how often it
/// occurs and in which labels.
std::string CertificateOf(const ReportFacts& facts);
}

#endif
