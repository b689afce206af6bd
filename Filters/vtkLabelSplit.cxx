// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLabelSplit.h"

#include "Core/MaterialMasks.h"
#include "FilterSupport.h"
#include "IndicatorCollection.h"
#include "LabelImage.h"
#include "LabelMeshNames.h"
#include "LabelPreparation.h"
#include "MemoryEstimate.h"
#include "ServerPieces.h"

#include <vtkAbstractArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <set>
#include <stdexcept>

vtkStandardNewMacro(vtkLabelSplit);

namespace
{
using namespace LabelMesh;

constexpr double LargestRadius = 100; // voxels, of openings and closings: their cost grows with the cube

// Voxels that labels are continued beyond a flat border: where they end, smoothing rounds them, and that is felt a few
// voxels away.
constexpr double ContinuedVoxels = 5;

template <typename Map>
double ValueOr(const Map& map, vtkIdType label, double other)
{
  const auto found = map.find(label);
  return found == map.end() ? other : found->second;
}

template <typename Map, typename Value>
bool Assign(Map& map, vtkIdType label, const Value& value)
{
  const auto found = map.find(label);
  if (found != map.end() && found->second == value)
  {
    return false;
  }
  map[label] = value;
  return true;
}

/// The first labels of a list, in words.
template <typename List>
std::string ListOf(const List& labels)
{
  constexpr std::size_t shown = 10;
  std::string text;
  std::size_t n = 0;
  for (const auto label : labels)
  {
    if (n++ == shown)
    {
      return text + " and " + std::to_string(labels.size() - shown) + " more";
    }
    text += (n > 1 ? ", " : "") + std::to_string(label);
  }
  return text;
}

std::string ArraysOf(vtkImageData* image)
{
  std::string names;
  for (vtkDataSetAttributes* attributes : { static_cast<vtkDataSetAttributes*>(image->GetPointData()),
         static_cast<vtkDataSetAttributes*>(image->GetCellData()) })
  {
    for (int n = 0; n < attributes->GetNumberOfArrays(); ++n)
    {
      const char* name = attributes->GetAbstractArray(n)->GetName();
      names += std::string(names.empty() ? "'" : ", '") + (name ? name : "") + "'";
    }
  }
  return names.empty() ? "it has no arrays" : "its arrays are " + names;
}

double RadiusIn(const Lattice& lattice, const char* what, double voxels)
{
  if (!(voxels >= 0) || voxels > LargestRadius)
  {
    throw std::invalid_argument(std::string("The ") + what + " radius is " + std::to_string(voxels) +
      " voxels; expected 0 to " + std::to_string(int(LargestRadius)) + ".");
  }
  return voxels * lattice.VoxelSize();
}

/// The array to process as labels, those that were not asked for merged into the background. `missing`: what was asked
/// for and does not occur.
LabelImage LabelsToSplit(vtkLabelSplit* filter, vtkImageData* input, vtkDataArray* array, int association,
  const std::vector<vtkIdType>& asked, std::vector<Label>& missing)
{
  if (!array)
  {
    throw std::invalid_argument("The image has no such array of labels; " + ArraysOf(input) +
      ". Choose a point or cell array of integers with SetInputArrayToProcess.");
  }
  LabelImage image = ReadLabelImage(input, array, association == vtkDataObject::FIELD_ASSOCIATION_CELLS);
  const std::set<Label> wanted(asked.begin(), asked.end());
  std::copy_if(wanted.begin(), wanted.end(), std::back_inserter(missing),
    [&](Label label)
    {
      return label != filter->GetBackgroundLabel() &&
        !std::binary_search(image.Labels.begin(), image.Labels.end(), label);
    });
  const std::vector<Label> kept =
    asked.empty() ? std::vector<Label>(image.Labels) : std::vector<Label>(wanted.begin(), wanted.end());
  MergeIntoBackground(image, kept, filter->GetBackgroundLabel());
  return image;
}

/// The box of a material's block, relative to the first source sample. Where the material reaches the border it goes on
/// for `layers` samples. It lies within the working grid.
Box BlockBox(const Box& material, const Lattice& source, bool background, int padding, int layers)
{
  Box box;
  for (int a = 0; a < 3; ++a)
  {
    const int first = background ? 0 : material[2 * a], last = background ? source.Dims[a] - 1 : material[2 * a + 1];
    const int reach = background ? padding : BlockReach(source, a, padding);
    const int most = padding + layers;
    box[2 * a] = std::max(first - reach - (first == 0 ? layers : 0), -most);
    box[2 * a + 1] = std::min(last + reach + (last == source.Dims[a] - 1 ? layers : 0), source.Dims[a] - 1 + most);
  }
  return box;
}

/// Samples beyond the border that repeat the nearest label: none with a closed border.
int ContinuedLayers(vtkLabelSplit* filter, const Lattice& source)
{
  if (filter->GetBorder() == vtkLabelSplit::Closed)
  {
    return 0;
  }
  // An opening or closing feels the end of the labels from as far as its radius.
  const double voxels = ContinuedVoxels + std::clamp(filter->GetLargestRadius(), 0.0, LargestRadius);
  return int(std::ceil(voxels * source.VoxelSize() / source.Spacing.minCoeff()));
}

UpsamplingOptions UpsamplingOptionsOf(vtkLabelSplit* filter)
{
  UpsamplingOptions options;
  options.Limit = filter->GetMaximumUpsampling();
  options.Background = filter->GetBackgroundLabel();
  options.FlatBorder = filter->GetBorder() == vtkLabelSplit::Flat;
  options.Padding = filter->GetPadding();
  options.MemoryLimit = filter->GetMemoryLimit();
  return options;
}

GridFrame BlockFrame(const GridFrame& source, const Box& box)
{
  std::array<int, 6> extent = box;
  for (int e = 0; e < 6; ++e)
  {
    extent[e] += source.Extent()[e / 2 * 2];
  }
  return GridFrame(extent, source.Origin(), source.Spacing(), source.Direction());
}

/// Appends the blocks, or only the materials to the header. Returns the labels of materials of which resampling or
/// opening left nothing; where resampling did, there is no block.
std::vector<Label> AppendMasks(vtkLabelSplit* filter, const LabelImage& image, bool headerOnly,
  CollectionHeader& header, vtkPartitionedDataSetCollection* output, const Monitor& monitor)
{
  const Lattice source = image.Frame.Samples();
  const int count = int(image.Labels.size());
  const int layers = ContinuedLayers(filter, source);
  const std::vector<Box> boxes = BoxesOf(image.Ids, source, count);
  const MaterialId background = IdOf(image, header.Background);
  std::vector<Label> lost;
  for (int id = 0; id < count; ++id)
  {
    if (id != background && boxes[id][1] < boxes[id][0])
    {
      lost.push_back(image.Labels[id]);
      continue;
    }
    Material material;
    material.Label = image.Labels[id];
    material.Name = filter->GetMaterialName(material.Label);
    filter->GetMaterialColor(material.Label, material.Color.data());
    header.Materials.push_back(material);
    if (headerOnly)
    {
      continue;
    }
    monitor.Step(double(id) / count, "Mask of " + material.Name);
    MaskOptions options;
    options.OpeningRadius = RadiusIn(source, "opening", filter->GetMaterialOpeningRadius(material.Label));
    options.ClosingRadius = RadiusIn(source, "closing", filter->GetMaterialClosingRadius(material.Label));
    options.ContinuedLayers = layers;
    const Box box = BlockBox(boxes[id], source, id == background, filter->GetPadding(), layers);
    const GridFrame frame = BlockFrame(header.Source, box);
    const Index size = frame.Samples().Size();
    vtkNew<vtkUnsignedCharArray> mask;
    mask->SetName(Names::Mask);
    mask->SetNumberOfValues(size);
    std::uint8_t* const values = mask->GetPointer(0);
    MaskOf(image.Ids, source, MaterialId(id), background, box, options, values);
    if (options.OpeningRadius > 0 && !std::memchr(values, 1, static_cast<std::size_t>(size)))
    {
      lost.push_back(material.Label);
    }
    AppendBlock(output, material, frame, mask);
  }
  return lost;
}
}

vtkLabelSplit::vtkLabelSplit()
{
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, vtkDataSetAttributes::SCALARS);
}

void vtkLabelSplit::AddLabel(vtkIdType label)
{
  this->Labels.push_back(label);
  this->Modified();
}

void vtkLabelSplit::ClearLabels()
{
  if (!this->Labels.empty())
  {
    this->Labels.clear();
    this->Modified();
  }
}

void vtkLabelSplit::SetMaterialOpeningRadius(vtkIdType label, double radius)
{
  if (Assign(this->MaterialOpeningRadii, label, radius))
  {
    this->Modified();
  }
}

void vtkLabelSplit::ClearMaterialOpeningRadii()
{
  if (!this->MaterialOpeningRadii.empty())
  {
    this->MaterialOpeningRadii.clear();
    this->Modified();
  }
}

void vtkLabelSplit::SetMaterialClosingRadius(vtkIdType label, double radius)
{
  if (Assign(this->MaterialClosingRadii, label, radius))
  {
    this->Modified();
  }
}

void vtkLabelSplit::ClearMaterialClosingRadii()
{
  if (!this->MaterialClosingRadii.empty())
  {
    this->MaterialClosingRadii.clear();
    this->Modified();
  }
}

double vtkLabelSplit::GetMaterialOpeningRadius(vtkIdType label) const
{
  return ValueOr(this->MaterialOpeningRadii, label, label == this->BackgroundLabel ? 0.0 : this->OpeningRadius);
}

double vtkLabelSplit::GetMaterialClosingRadius(vtkIdType label) const
{
  return ValueOr(this->MaterialClosingRadii, label, label == this->BackgroundLabel ? 0.0 : this->ClosingRadius);
}

double vtkLabelSplit::GetLargestRadius() const
{
  double largest = std::max(this->OpeningRadius, this->ClosingRadius);
  for (const auto* radii : { &this->MaterialOpeningRadii, &this->MaterialClosingRadii })
  {
    for (const auto& [label, radius] : *radii)
    {
      largest = std::max(largest, radius);
    }
  }
  return largest;
}

void vtkLabelSplit::SetMaterialName(vtkIdType label, const char* name)
{
  if (Assign(this->MaterialNames, label, std::string(name ? name : "")))
  {
    this->Modified();
  }
}

void vtkLabelSplit::ClearMaterialNames()
{
  if (!this->MaterialNames.empty())
  {
    this->MaterialNames.clear();
    this->Modified();
  }
}

void vtkLabelSplit::SetMaterialColor(vtkIdType label, double red, double green, double blue)
{
  if (Assign(this->MaterialColors, label, std::array<double, 3>{ red, green, blue }))
  {
    this->Modified();
  }
}

void vtkLabelSplit::ClearMaterialColors()
{
  if (!this->MaterialColors.empty())
  {
    this->MaterialColors.clear();
    this->Modified();
  }
}

std::string vtkLabelSplit::GetMaterialName(vtkIdType label) const
{
  const auto name = this->MaterialNames.find(label);
  return name != this->MaterialNames.end() && !name->second.empty() ? name->second : DefaultMaterial(label).Name;
}

void vtkLabelSplit::GetMaterialColor(vtkIdType label, double color[3]) const
{
  const auto own = this->MaterialColors.find(label);
  if (own != this->MaterialColors.end())
  {
    std::copy_n(own->second.data(), 3, color);
  }
  else
  {
    std::copy_n(DefaultMaterial(label).Color.data(), 3, color);
  }
}

int vtkLabelSplit::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int vtkLabelSplit::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* inInfo = inputVector[0]->GetInformationObject(0);
  vtkInformation* outInfo = outputVector->GetInformationObject(0);
  GridFrame frame;
  const bool known = this->ResamplingFactor > 0 &&
    PromisedFrame(inInfo, PromisesCellData(this->GetInputArrayInformation(0), inInfo), frame);
  if (known)
  {
    try
    {
      const double factor = this->Upsamples() ? this->FindUpsampling(inputVector) : this->ResamplingFactor;
      const GridFrame source = Resampled(frame, factor);
      PublishFrame(outInfo, source, this->Padding + ContinuedLayers(this, source.Samples()));
      return 1;
    }
    catch (const std::invalid_argument&)
    {
      // RequestData says what is wrong with the factor or with the labels.
    }
  }
  UnpublishFrame(outInfo);
  return 1;
}

double vtkLabelSplit::FindUpsampling(vtkInformationVector** inputVector)
{
  int port = 0;
  if (vtkAlgorithm* producer = this->GetInputAlgorithm(0, 0, port))
  {
    producer->Update(port);
  }
  vtkImageData* input = vtkImageData::GetData(inputVector[0], 0);
  const std::array<vtkMTimeType, 2> state{ input->GetMTime(), this->GetMTime() };
  if (input->GetNumberOfPoints() > 0 && state != this->UpsamplingState)
  {
    int association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
    vtkDataArray* array = this->GetInputArrayToProcess(0, inputVector, association);
    std::vector<Label> missing;
    LabelImage image = LabelsToSplit(this, input, array, association, this->Labels, missing);
    if (this->MinimumComponentSize > 0)
    {
      vtkNew<vtkFieldData> unused;
      DropSmall(image, this->BackgroundLabel, this->MinimumComponentSize, unused);
    }
    this->UpsamplingFactor = ChooseUpsampling(image, UpsamplingOptionsOf(this)).Factor;
    this->UpsamplingState = state;
  }
  return input->GetNumberOfPoints() > 0 ? this->UpsamplingFactor : 1;
}

int vtkLabelSplit::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  RequestAll(inputVector[0]->GetInformationObject(0));
  return 1;
}

int vtkLabelSplit::FillOutputPortInformation(int port, vtkInformation* info)
{
  PromiseFirstPiece(info);
  return this->Superclass::FillOutputPortInformation(port, info);
}

int vtkLabelSplit::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const bool first = RequestedPiece(request, outputVector).IsFirst();
  vtkImageData* input = vtkImageData::GetData(inputVector[0], 0);
  vtkPartitionedDataSetCollection* output = vtkPartitionedDataSetCollection::GetData(outputVector, 0);
  return RunStage(this,
    [&](const Monitor& monitor)
    {
      RequireWhole(inputVector[0]->GetInformationObject(0), input);
      CollectionHeader header;
      header.Background = this->BackgroundLabel;
      header.Padding = this->Padding;
      header.FlatBorder = this->Border == Flat;
      if (input->GetNumberOfPoints() == 0)
      {
        WriteHeader(output, header);
        return;
      }
      monitor.Step(0.0, "Reading labels");
      int association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
      vtkDataArray* array = this->GetInputArrayToProcess(0, inputVector, association);
      std::vector<Label> missing;
      LabelImage image = LabelsToSplit(this, input, array, association, this->Labels, missing);
      if (this->MemoryLimit > 0)
      {
        RequireMemory(
          EstimateMemory(image, this->BackgroundLabel, this->Padding, this->ResamplingFactor), this->MemoryLimit);
      }
      if (this->MinimumComponentSize > 0)
      {
        DropSmall(image, this->BackgroundLabel, this->MinimumComponentSize, output->GetFieldData());
      }
      monitor.Step(0.1, "Resampling");
      if (this->Upsamples())
      {
        const Upsampling upsampling = ChooseUpsampling(image, UpsamplingOptionsOf(this));
        WriteUpsampling(output->GetFieldData(), upsampling);
        if (upsampling.HeldByMemory)
        {
          vtkWarningMacro("" << upsampling.Reason);
        }
        Resample(image, upsampling);
      }
      else
      {
        Resample(image, this->ResamplingFactor);
      }
      header.Source = image.Frame;
      header.Padding = this->Padding + ContinuedLayers(this, image.Frame.Samples());
      const std::vector<Label> lost = AppendMasks(this, image, !first, header, output, monitor.Part(0.2, 1.0));
      if (!first)
      {
        AppendEmptyBlocks(output, header);
        return;
      }
      WriteHeader(output, header);
      if (!missing.empty())
      {
        vtkWarningMacro("No sample has the labels " << ListOf(missing) << ", which were asked for.");
      }
      if (!lost.empty())
      {
        vtkWarningMacro("Nothing is left of the materials "
          << ListOf(lost) << ". Use a smaller opening radius or a larger resampling factor.");
      }
      if (header.Materials.size() == 1)
      {
        vtkWarningMacro("There is nothing to mesh: every voxel has the background label "
          << this->BackgroundLabel << (this->Labels.empty() ? "." : " or a label that was not asked for."));
      }
    });
}

void vtkLabelSplit::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Labels:";
  for (const vtkIdType label : this->Labels)
  {
    os << " " << label;
  }
  os << (this->Labels.empty() ? " (all)\n" : "\n");
  os << indent << "BackgroundLabel: " << this->BackgroundLabel << "\n";
  os << indent << "Padding: " << this->Padding << "\n";
  os << indent << "Border: " << (this->Border == Flat ? "Flat" : "Closed") << "\n";
  os << indent << "ResamplingFactor: " << this->ResamplingFactor << "\n";
  os << indent << "MaximumUpsampling: " << this->MaximumUpsampling << "\n";
  os << indent << "MinimumComponentSize: " << this->MinimumComponentSize << "\n";
  os << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
  os << indent << "OpeningRadius: " << this->OpeningRadius << "\n";
  os << indent << "ClosingRadius: " << this->ClosingRadius << "\n";
  const auto print = [&](const char* what, const auto& map)
  {
    os << indent << what << ":";
    for (const auto& [label, value] : map)
    {
      os << " " << label << ": " << value;
    }
    os << "\n";
  };
  print("MaterialOpeningRadii", this->MaterialOpeningRadii);
  print("MaterialClosingRadii", this->MaterialClosingRadii);
  print("MaterialNames", this->MaterialNames);
  os << indent << "MaterialColors:";
  for (const auto& [label, color] : this->MaterialColors)
  {
    os << " " << label << ": (" << color[0] << ", " << color[1] << ", " << color[2] << ")";
  }
  os << "\n";
}
