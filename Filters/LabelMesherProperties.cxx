// SPDX-License-Identifier: BSD-3-Clause
// The properties of vtkLabelMesher, which are those of its stages.
#include "LabelMesherPipeline.h"

void vtkLabelMesher::AddLabel(vtkIdType label)
{
  this->Stages->Split->AddLabel(label);
}

void vtkLabelMesher::ClearLabels()
{
  this->Stages->Split->ClearLabels();
}

vtkIdType vtkLabelMesher::GetNumberOfLabels() const
{
  return this->Stages->Split->GetNumberOfLabels();
}

vtkIdType vtkLabelMesher::GetLabel(vtkIdType index) const
{
  return this->Stages->Split->GetLabel(index);
}

void vtkLabelMesher::SetMaterialName(vtkIdType label, const char* name)
{
  this->Stages->Style->SetMaterialName(label, name);
}

void vtkLabelMesher::ClearMaterialNames()
{
  this->Stages->Style->ClearMaterialNames();
}

std::string vtkLabelMesher::GetMaterialName(vtkIdType label) const
{
  return this->Stages->Style->GetMaterialName(label);
}

void vtkLabelMesher::SetMaterialColor(vtkIdType label, double red, double green, double blue)
{
  this->Stages->Style->SetMaterialColor(label, red, green, blue);
}

void vtkLabelMesher::ClearMaterialColors()
{
  this->Stages->Style->ClearMaterialColors();
}

void vtkLabelMesher::GetMaterialColor(vtkIdType label, double color[3]) const
{
  this->Stages->Style->GetMaterialColor(label, color);
}

void vtkLabelMesher::SetBackgroundLabel(vtkIdType label)
{
  this->Stages->Split->SetBackgroundLabel(label);
}

vtkIdType vtkLabelMesher::GetBackgroundLabel() const
{
  return this->Stages->Split->GetBackgroundLabel();
}

void vtkLabelMesher::SetPadding(int samples)
{
  this->Stages->Split->SetPadding(samples);
}

int vtkLabelMesher::GetPadding() const
{
  return this->Stages->Split->GetPadding();
}

void vtkLabelMesher::SetBorder(int border)
{
  this->Stages->Split->SetBorder(border);
}

int vtkLabelMesher::GetBorder() const
{
  return this->Stages->Split->GetBorder();
}

void vtkLabelMesher::SetBorderToClosed()
{
  this->Stages->Split->SetBorderToClosed();
}

void vtkLabelMesher::SetBorderToFlat()
{
  this->Stages->Split->SetBorderToFlat();
}

void vtkLabelMesher::SetResamplingFactor(double factor)
{
  this->Stages->Split->SetResamplingFactor(factor);
}

double vtkLabelMesher::GetResamplingFactor() const
{
  return this->Stages->Split->GetResamplingFactor();
}

void vtkLabelMesher::SetMaximumUpsampling(int limit)
{
  this->Stages->Split->SetMaximumUpsampling(limit);
}

int vtkLabelMesher::GetMaximumUpsampling() const
{
  return this->Stages->Split->GetMaximumUpsampling();
}

void vtkLabelMesher::SetMinimumComponentSize(vtkIdType voxels)
{
  this->Stages->Split->SetMinimumComponentSize(voxels);
}

vtkIdType vtkLabelMesher::GetMinimumComponentSize() const
{
  return this->Stages->Split->GetMinimumComponentSize();
}

void vtkLabelMesher::SetMemoryLimit(double gibibytes)
{
  this->Stages->Split->SetMemoryLimit(gibibytes);
}

double vtkLabelMesher::GetMemoryLimit() const
{
  return this->Stages->Split->GetMemoryLimit();
}

void vtkLabelMesher::SetOpeningRadius(double radius)
{
  this->Stages->Split->SetOpeningRadius(radius);
}

double vtkLabelMesher::GetOpeningRadius() const
{
  return this->Stages->Split->GetOpeningRadius();
}

void vtkLabelMesher::SetClosingRadius(double radius)
{
  this->Stages->Split->SetClosingRadius(radius);
}

double vtkLabelMesher::GetClosingRadius() const
{
  return this->Stages->Split->GetClosingRadius();
}

void vtkLabelMesher::SetSmoothing(int smoothing)
{
  this->Stages->Tighten->SetSmoothing(smoothing);
}

int vtkLabelMesher::GetSmoothing() const
{
  return this->Stages->Tighten->GetSmoothing();
}

void vtkLabelMesher::SetSmoothingToVolumeKeeping()
{
  this->Stages->Tighten->SetSmoothingToVolumeKeeping();
}

void vtkLabelMesher::SetSmoothingToTightening()
{
  this->Stages->Tighten->SetSmoothingToTightening();
}

void vtkLabelMesher::SetFidelity(double fidelity)
{
  this->Stages->Tighten->SetFidelity(fidelity);
}

double vtkLabelMesher::GetFidelity() const
{
  return this->Stages->Tighten->GetFidelity();
}

void vtkLabelMesher::SetRounds(int rounds)
{
  this->Stages->Tighten->SetRounds(rounds);
}

int vtkLabelMesher::GetRounds() const
{
  return this->Stages->Tighten->GetRounds();
}

void vtkLabelMesher::SetRadius(double radius)
{
  this->Stages->Tighten->SetRadius(radius);
}

double vtkLabelMesher::GetRadius() const
{
  return this->Stages->Tighten->GetRadius();
}

void vtkLabelMesher::SetAntialiasIterations(int iterations)
{
  this->Stages->Tighten->SetAntialiasIterations(iterations);
}

int vtkLabelMesher::GetAntialiasIterations() const
{
  return this->Stages->Tighten->GetAntialiasIterations();
}

void vtkLabelMesher::SetTightenIterations(int iterations)
{
  this->Stages->Tighten->SetTightenIterations(iterations);
}

int vtkLabelMesher::GetTightenIterations() const
{
  return this->Stages->Tighten->GetTightenIterations();
}

void vtkLabelMesher::SetPerturbation(double voxels)
{
  this->Stages->Reconstruct->SetPerturbation(voxels);
}

double vtkLabelMesher::GetPerturbation() const
{
  return this->Stages->Reconstruct->GetPerturbation();
}

void vtkLabelMesher::SetEpsilon(double epsilon)
{
  this->Stages->Sizing->SetEpsilon(epsilon);
}

double vtkLabelMesher::GetEpsilon() const
{
  return this->Stages->Sizing->GetEpsilon();
}

void vtkLabelMesher::SetFeatureSizeFloor(double voxels)
{
  this->Stages->Sizing->SetFeatureSizeFloor(voxels);
}

double vtkLabelMesher::GetFeatureSizeFloor() const
{
  return this->Stages->Sizing->GetFeatureSizeFloor();
}

void vtkLabelMesher::SetMaximumDeviation(double voxels)
{
  this->Stages->Sizing->SetMaximumDeviation(voxels);
}

double vtkLabelMesher::GetMaximumDeviation() const
{
  return this->Stages->Sizing->GetMaximumDeviation();
}

void vtkLabelMesher::SetGradation(double gradation)
{
  this->Stages->Sizing->SetGradation(gradation);
}

double vtkLabelMesher::GetGradation() const
{
  return this->Stages->Sizing->GetGradation();
}

void vtkLabelMesher::SetMinimumLength(double length)
{
  this->Stages->Sizing->SetMinimumLength(length);
}

double vtkLabelMesher::GetMinimumLength() const
{
  return this->Stages->Sizing->GetMinimumLength();
}

void vtkLabelMesher::SetMaximumLength(double length)
{
  this->Stages->Sizing->SetMaximumLength(length);
}

double vtkLabelMesher::GetMaximumLength() const
{
  return this->Stages->Sizing->GetMaximumLength();
}

void vtkLabelMesher::SetTargetTriangles(vtkIdType triangles)
{
  this->Stages->Sizing->SetTargetTriangles(triangles);
}

vtkIdType vtkLabelMesher::GetTargetTriangles() const
{
  return this->Stages->Sizing->GetTargetTriangles();
}

void vtkLabelMesher::SetSweeps(int sweeps)
{
  this->Stages->Sample->SetSweeps(sweeps);
}

int vtkLabelMesher::GetSweeps() const
{
  return this->Stages->Sample->GetSweeps();
}

void vtkLabelMesher::SetSeed(int seed)
{
  this->Stages->Sample->SetSeed(seed);
}

int vtkLabelMesher::GetSeed() const
{
  return this->Stages->Sample->GetSeed();
}

void vtkLabelMesher::SetRepairRounds(int rounds)
{
  this->Stages->Mesh->SetRepairRounds(rounds);
}

int vtkLabelMesher::GetRepairRounds() const
{
  return this->Stages->Mesh->GetRepairRounds();
}

void vtkLabelMesher::SetImprovePasses(int passes)
{
  this->Stages->Mesh->SetImprovePasses(passes);
}

int vtkLabelMesher::GetImprovePasses() const
{
  return this->Stages->Mesh->GetImprovePasses();
}

void vtkLabelMesher::SetRepairBelow(double ratio)
{
  this->Stages->Mesh->SetRepairBelow(ratio);
}

double vtkLabelMesher::GetRepairBelow() const
{
  return this->Stages->Mesh->GetRepairBelow();
}

void vtkLabelMesher::SetChordCorrection(bool on)
{
  this->Stages->Mesh->SetChordCorrection(on);
}

bool vtkLabelMesher::GetChordCorrection() const
{
  return this->Stages->Mesh->GetChordCorrection();
}

void vtkLabelMesher::SetVolumeCorrection(bool on)
{
  this->Stages->Mesh->SetVolumeCorrection(on);
}

bool vtkLabelMesher::GetVolumeCorrection() const
{
  return this->Stages->Mesh->GetVolumeCorrection();
}

void vtkLabelMesher::SetMaterialOpeningRadius(vtkIdType label, double radius)
{
  this->Stages->Split->SetMaterialOpeningRadius(label, radius);
}

double vtkLabelMesher::GetMaterialOpeningRadius(vtkIdType label) const
{
  return this->Stages->Split->GetMaterialOpeningRadius(label);
}

void vtkLabelMesher::ClearMaterialOpeningRadii()
{
  this->Stages->Split->ClearMaterialOpeningRadii();
}

void vtkLabelMesher::SetMaterialClosingRadius(vtkIdType label, double radius)
{
  this->Stages->Split->SetMaterialClosingRadius(label, radius);
}

double vtkLabelMesher::GetMaterialClosingRadius(vtkIdType label) const
{
  return this->Stages->Split->GetMaterialClosingRadius(label);
}

void vtkLabelMesher::ClearMaterialClosingRadii()
{
  this->Stages->Split->ClearMaterialClosingRadii();
}

void vtkLabelMesher::SetMaterialRadius(vtkIdType label, double radius)
{
  this->Stages->Tighten->SetMaterialRadius(label, radius);
}

double vtkLabelMesher::GetMaterialRadius(vtkIdType label) const
{
  return this->Stages->Tighten->GetMaterialRadius(label);
}

void vtkLabelMesher::ClearMaterialRadii()
{
  this->Stages->Tighten->ClearMaterialRadii();
}

void vtkLabelMesher::SetMaterialMaximumLength(vtkIdType label, double length)
{
  this->Stages->Sizing->SetMaterialMaximumLength(label, length);
}

double vtkLabelMesher::GetMaterialMaximumLength(vtkIdType label) const
{
  return this->Stages->Sizing->GetMaterialMaximumLength(label);
}

void vtkLabelMesher::ClearMaterialMaximumLengths()
{
  this->Stages->Sizing->ClearMaterialMaximumLengths();
}

void vtkLabelMesher::SetInterfaceMaximumLength(vtkIdType labelA, vtkIdType labelB, double length)
{
  this->Stages->Sizing->SetInterfaceMaximumLength(labelA, labelB, length);
}

double vtkLabelMesher::GetInterfaceMaximumLength(vtkIdType labelA, vtkIdType labelB) const
{
  return this->Stages->Sizing->GetInterfaceMaximumLength(labelA, labelB);
}

void vtkLabelMesher::ClearInterfaceMaximumLengths()
{
  this->Stages->Sizing->ClearInterfaceMaximumLengths();
}

void vtkLabelMesher::SetTetrahedra(int mode)
{
  this->Stages->Mesh->SetTetrahedra(mode);
  this->Stages->Sample->SetSampleVolume(this->GetTetrahedra() == vtkDelaunayLabelMesh::Packed);
}

int vtkLabelMesher::GetTetrahedra() const
{
  return this->Stages->Mesh->GetTetrahedra();
}

void vtkLabelMesher::SetTetrahedraToOff()
{
  this->SetTetrahedra(vtkDelaunayLabelMesh::Off);
}

void vtkLabelMesher::SetTetrahedraToPacked()
{
  this->SetTetrahedra(vtkDelaunayLabelMesh::Packed);
}

void vtkLabelMesher::SetTetrahedraToTetGen()
{
  this->SetTetrahedra(vtkDelaunayLabelMesh::TetGen);
}

void vtkLabelMesher::SetRefinementRounds(int rounds)
{
  this->Stages->Mesh->SetRefinementRounds(rounds);
}

int vtkLabelMesher::GetRefinementRounds() const
{
  return this->Stages->Mesh->GetRefinementRounds();
}

void vtkLabelMesher::SetRadiusEdgeRatio(double ratio)
{
  this->Stages->Mesh->SetRadiusEdgeRatio(ratio);
}

double vtkLabelMesher::GetRadiusEdgeRatio() const
{
  return this->Stages->Mesh->GetRadiusEdgeRatio();
}

void vtkLabelMesher::SetMinimumDihedral(double degrees)
{
  this->Stages->Mesh->SetMinimumDihedral(degrees);
}

double vtkLabelMesher::GetMinimumDihedral() const
{
  return this->Stages->Mesh->GetMinimumDihedral();
}

void vtkLabelMesher::SetTetraImprovePasses(int passes)
{
  this->Stages->Mesh->SetTetraImprovePasses(passes);
}

int vtkLabelMesher::GetTetraImprovePasses() const
{
  return this->Stages->Mesh->GetTetraImprovePasses();
}

void vtkLabelMesher::SetSlideSurface(bool on)
{
  this->Stages->Mesh->SetSlideSurface(on);
}

bool vtkLabelMesher::GetSlideSurface() const
{
  return this->Stages->Mesh->GetSlideSurface();
}

const char* vtkLabelMesher::GetTetrahedraFailure() const
{
  return this->Stages->Mesh->GetTetrahedraFailure();
}

void vtkLabelMesher::SetVolumeGradation(double gradation)
{
  this->Stages->Sample->SetVolumeGradation(gradation);
}

double vtkLabelMesher::GetVolumeGradation() const
{
  return this->Stages->Sample->GetVolumeGradation();
}

void vtkLabelMesher::SetVolumeMaximumLength(double length)
{
  this->Stages->Sample->SetVolumeMaximumLength(length);
}

double vtkLabelMesher::GetVolumeMaximumLength() const
{
  return this->Stages->Sample->GetVolumeMaximumLength();
}

void vtkLabelMesher::SetMaterialVolumeMaximumLength(vtkIdType label, double length)
{
  this->Stages->Sample->SetMaterialVolumeMaximumLength(label, length);
}

double vtkLabelMesher::GetMaterialVolumeMaximumLength(vtkIdType label) const
{
  return this->Stages->Sample->GetMaterialVolumeMaximumLength(label);
}

void vtkLabelMesher::ClearMaterialVolumeMaximumLengths()
{
  this->Stages->Sample->ClearMaterialVolumeMaximumLengths();
}
