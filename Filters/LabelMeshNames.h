// SPDX-License-Identifier: BSD-3-Clause
// Every array, block and field-data name of LabelMesh, in one place.
#ifndef LabelMeshNames_h
#define LabelMeshNames_h

namespace LabelMesh::Names
{
// Point arrays of the material blocks: the name tells the stage.
inline constexpr char Mask[] = "Mask";                   ///< uint8: 1 inside, 0 outside
inline constexpr char TightDistance[] = "TightDistance"; ///< float32, world length, > 0 inside
inline constexpr char Indicator[] = "Indicator";         ///< float32, world length, > 0 inside

// Field data of a block (and of each surface of a material).
inline constexpr char Label[] = "Label"; ///< int64 x 1; also the point array of a rebuilt label image and
                                         ///< the cell array of tetrahedra
inline constexpr char Color[] = "Color"; ///< float64 x 3, 0 to 1

// Field data of a collection, and of the interface mesh where it applies.
inline constexpr char Labels[] = "Labels";                   ///< int64 x N, ascending
inline constexpr char MaterialNames[] = "MaterialNames";     ///< string x N
inline constexpr char MaterialColors[] = "MaterialColors";   ///< float64 x 3 x N, 0 to 1
inline constexpr char BackgroundLabel[] = "BackgroundLabel"; ///< int64
inline constexpr char VoxelSize[] = "VoxelSize";             ///< float64 x 3: spacing of the source grid
inline constexpr char SourceExtent[] = "SourceExtent";       ///< int32 x 6
inline constexpr char SourceOrigin[] = "SourceOrigin";       ///< float64 x 3
inline constexpr char SourceDirection[] = "SourceDirection"; ///< float64 x 9, row by row
inline constexpr char Padding[] = "Padding";                 ///< int32: samples around the source grid
inline constexpr char Border[] = "Border";                   ///< int32: 1 flat; not there where closed
inline constexpr char IndicatorKernel[] = "IndicatorKernel"; ///< string
inline constexpr char MaskVolumes[] = "MaskVolumes";         ///< float64 x N, world length cubed
inline constexpr char TightVolumes[] = "TightVolumes";       ///< float64 x N, world length cubed
inline constexpr char KeptVolumes[] = "KeptVolumes";         ///< float64 x N, TightVolumes / MaskVolumes
inline constexpr char KeptFromCutting[] = "KeptFromCutting"; ///< int64, see vtkDelaunayLabelMesh.h
// Components of labels that were too small (MinimumComponentSize), as they were in the label image.
inline constexpr char DroppedLabels[] = "DroppedLabels";       ///< int64 x M
inline constexpr char DroppedInto[] = "DroppedInto";           ///< int64 x M: the labels that got their voxels
inline constexpr char DroppedVoxels[] = "DroppedVoxels";       ///< int64 x M
inline constexpr char DroppedPositions[] = "DroppedPositions"; ///< float64 x 3 x M, world: the first voxel of each
// What was chosen where finer grids are allowed (MaximumUpsampling).
inline constexpr char Upsampling[] = "Upsampling";             ///< int32: samples per voxel along each axis
inline constexpr char UpsamplingReason[] = "UpsamplingReason"; ///< string: a sentence
// Voxels whose label in the indicators is another than theirs, by vtkLabelMesher.
inline constexpr char RebuiltVoxels[] = "RebuiltVoxels"; ///< int64 x K: positions in the label volume, x fastest
inline constexpr char RebuiltLabels[] = "RebuiltLabels"; ///< int64 x K: the labels that they have there
inline constexpr char IndicatorsRoot[] = "Indicators";   ///< root of a collection's assembly
inline constexpr char SurfacesRoot[] = "Surfaces";
inline constexpr char CatmullRom[] = "CatmullRom";

// Images.
inline constexpr char Margin[] = "Margin";                ///< float32, world length: largest minus second indicator
inline constexpr char TargetLength[] = "TargetLength";    ///< float32, world length; also on particles
inline constexpr char FeatureSize[] = "FeatureSize";      ///< float32, world length
inline constexpr char InsideOutside[] = "InsideOutside_"; ///< prefix; eq. 1
inline constexpr char CellIndicator[] = "CellIndicator";  ///< eq. 2 to 4

// Particles and meshes.
inline constexpr char CellDimension[] = "CellDimension";         ///< uint8, 0 to 3
inline constexpr char NumberOfMaterials[] = "NumberOfMaterials"; ///< uint8
inline constexpr char Materials[] = "Materials";                 ///< int64 x 8, ascending, the rest repeats the last
inline constexpr char BorderFaces[] = "BorderFaces"; ///< uint8, bits: which faces of the volume's box a particle is on
inline constexpr char Residual[] = "Residual";       ///< float64, world length
inline constexpr char Normal[] = "Normal";           ///< float64 x 3 (particles on 2-cells; else zero)
inline constexpr char BoundaryLabels[] =
  "BoundaryLabels"; ///< cells, int64 x 2: normal points from the first to the second
inline constexpr char DistanceToVoxels[] = "DistanceToVoxels"; ///< points, float64, world length (error map)
// ParaView's charts take this column for the x axis by themselves, since its own Histogram writes it.
inline constexpr char BinExtents[] = "bin_extents";  ///< column, float64: centres of a histogram's bins
inline constexpr char RadiusRatio[] = "RadiusRatio"; ///< cells, float64: 2 r_in / r_circ; of tetrahedra 3 r_in / r_circ
}

#endif
