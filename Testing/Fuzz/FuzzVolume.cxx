// SPDX-License-Identifier: BSD-3-Clause
#include "FuzzVolume.h"

#include "RandomNumbers.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>
#include <vector>

namespace
{
using Voxel = std::array<int, 3>;

/// Voxels of small numbers, which become labels later; 0 at first.
class Voxels
{
public:
  explicit Voxels(const Voxel& dims)
    : Dims(dims)
    , Values(static_cast<std::size_t>(dims[0]) * dims[1] * dims[2], 0)
  {
  }
  bool Holds(const Voxel& v) const
  {
    return v[0] >= 0 && v[0] < this->Dims[0] && v[1] >= 0 && v[1] < this->Dims[1] && v[2] >= 0 && v[2] < this->Dims[2];
  }
  int& At(const Voxel& v)
  {
    return this->Values[(static_cast<std::size_t>(v[2]) * this->Dims[1] + v[1]) * this->Dims[0] + v[0]];
  }
  /// Sets a voxel, if it is within.
  void Set(const Voxel& v, int value)
  {
    if (this->Holds(v))
    {
      this->At(v) = value;
    }
  }
  template <typename Rule>
  void Fill(Rule&& rule)
  {
    Voxel v;
    for (v[2] = 0; v[2] < this->Dims[2]; ++v[2])
    {
      for (v[1] = 0; v[1] < this->Dims[1]; ++v[1])
      {
        for (v[0] = 0; v[0] < this->Dims[0]; ++v[0])
        {
          this->At(v) = rule(v, this->At(v));
        }
      }
    }
  }

  Voxel Dims;
  std::vector<int> Values;
};

Voxel RandomVoxel(const Voxels& voxels, RandomNumbers& random)
{
  return { random.Integer(0, voxels.Dims[0] - 1), random.Integer(0, voxels.Dims[1] - 1),
    random.Integer(0, voxels.Dims[2] - 1) };
}

double SquaredDistance(const Voxel& a, const Voxel& b)
{
  double sum = 0;
  for (int c = 0; c < 3; ++c)
  {
    sum += double(a[c] - b[c]) * (a[c] - b[c]);
  }
  return sum;
}

void Noise(Voxels& voxels, RandomNumbers& random)
{
  const int labels = random.Integer(1, 4);
  const double filled = random.Real(0.02, 1.0);
  voxels.Fill([&](const Voxel&, int) { return random.Chance(filled) ? random.Integer(1, labels) : 0; });
}

void Checkerboard(Voxels& voxels, RandomNumbers& random)
{
  const Voxel period = { random.Integer(1, 4), random.Integer(1, 4), random.Integer(1, 4) };
  const int labels = random.Integer(2, 3);
  voxels.Fill([&](const Voxel& v, int) { return (v[0] / period[0] + v[1] / period[1] + v[2] / period[2]) % labels; });
}

/// Cells of the nearest site; label 0 is one of them, so that they reach the border.
void Voronoi(Voxels& voxels, RandomNumbers& random)
{
  std::vector<Voxel> sites(random.Integer(2, 30));
  std::generate(sites.begin(), sites.end(), [&] { return RandomVoxel(voxels, random); });
  const int labels = random.Integer(2, 30);
  voxels.Fill(
    [&](const Voxel& v, int)
    {
      const auto nearest = std::min_element(sites.begin(), sites.end(),
        [&](const Voxel& a, const Voxel& b) { return SquaredDistance(a, v) < SquaredDistance(b, v); });
      return int(nearest - sites.begin()) % labels;
    });
}

/// Plates of one or two voxels, upright or slanted, that cut each other.
void Plates(Voxels& voxels, RandomNumbers& random)
{
  for (int n = random.Integer(1, 6); n > 0; --n)
  {
    const Voxel through = RandomVoxel(voxels, random);
    Voxel normal = { 0, 0, 0 };
    normal[random.Integer(0, 2)] = 1;
    normal[random.Integer(0, 2)] += random.Integer(-1, 1);
    const int thickness = random.Integer(1, 2);
    voxels.Fill(
      [&](const Voxel& v, int old)
      {
        const int height =
          normal[0] * (v[0] - through[0]) + normal[1] * (v[1] - through[1]) + normal[2] * (v[2] - through[2]);
        return height >= 0 && height < thickness ? n : old;
      });
  }
}

/// Walks of a voxel: along an axis, or by edges and corners.
void Threads(Voxels& voxels, RandomNumbers& random)
{
  for (int n = random.Integer(1, 8); n > 0; --n)
  {
    Voxel at = RandomVoxel(voxels, random);
    Voxel step = { random.Integer(-1, 1), random.Integer(-1, 1), random.Integer(-1, 1) };
    for (int length = random.Integer(1, 60); length > 0; --length)
    {
      voxels.Set(at, n);
      if (random.Chance(0.1))
      {
        step[random.Integer(0, 2)] = random.Integer(-1, 1);
      }
      for (int c = 0; c < 3; ++c)
      {
        at[c] += step[c];
      }
    }
  }
}

void Shells(Voxels& voxels, RandomNumbers& random)
{
  const Voxel centre = RandomVoxel(voxels, random);
  const double thickness = random.Real(1.0, 4.0);
  const int labels = random.Integer(2, 5);
  const bool cubes = random.Chance(0.3);
  const double outermost = random.Real(2.0, 20.0);
  voxels.Fill(
    [&](const Voxel& v, int)
    {
      double radius = 0;
      for (int c = 0; c < 3; ++c)
      {
        const double along = std::abs(v[c] - centre[c]);
        radius = cubes ? std::max(radius, along) : radius + along * along;
      }
      radius = cubes ? radius : std::sqrt(radius);
      return radius > outermost ? 0 : 1 + int(radius / thickness) % labels;
    });
}

void OneVoxel(Voxels& voxels, RandomNumbers& random)
{
  voxels.Set(RandomVoxel(voxels, random), 1);
}

void Uniform(Voxels& voxels, RandomNumbers& random)
{
  const int value = random.Integer(0, 1);
  voxels.Fill([&](const Voxel&, int) { return value; });
}

/// Blocks, each of which starts at a corner of the one before.
void BlocksThatTouch(Voxels& voxels, RandomNumbers& random)
{
  Voxel at = RandomVoxel(voxels, random);
  const int labels = random.Integer(1, 4);
  for (int n = random.Integer(2, 8); n > 0; --n)
  {
    const Voxel size = { random.Integer(1, 6), random.Integer(1, 6), random.Integer(1, 6) };
    voxels.Fill(
      [&](const Voxel& v, int old)
      {
        const bool inside = v[0] >= at[0] && v[0] < at[0] + size[0] && v[1] >= at[1] && v[1] < at[1] + size[1] &&
          v[2] >= at[2] && v[2] < at[2] + size[2];
        return inside ? 1 + n % labels : old;
      });
    for (int c = 0; c < 3; ++c)
    {
      at[c] += random.Chance(0.7) ? size[c] : -1;
    }
  }
}

void Balls(Voxels& voxels, RandomNumbers& random)
{
  for (int n = random.Integer(1, 8); n > 0; --n)
  {
    const Voxel centre = RandomVoxel(voxels, random);
    const double radius = random.Real(0.5, 10.0);
    voxels.Fill([&](const Voxel& v, int old) { return SquaredDistance(v, centre) < radius * radius ? n : old; });
  }
}

/// Two halves whose common wall is one voxel thick and has holes.
void WallWithHoles(Voxels& voxels, RandomNumbers& random)
{
  const int axis = random.Integer(0, 2);
  const int place = random.Integer(0, voxels.Dims[axis] - 1);
  const double holes = random.Real(0.0, 0.5);
  voxels.Fill(
    [&](const Voxel& v, int)
    {
      const int side = v[axis] < place ? 1 : 2;
      return v[axis] == place && !random.Chance(holes) ? 3 : side;
    });
}

/// Single voxels of wrong labels, as segmentations by machine have them.
void Sprinkle(Voxels& voxels, RandomNumbers& random)
{
  const double share = random.Real(0.0, 0.1);
  voxels.Fill([&](const Voxel&, int old) { return random.Chance(share) ? random.Integer(0, 3) : old; });
}

struct Kind
{
  const char* Name;
  void (*Make)(Voxels&, RandomNumbers&);
  double Weight;
};

const std::array<Kind, 11> Kinds = { { { "noise", Noise, 1.5 }, { "checkerboard", Checkerboard, 1 },
  { "Voronoi cells", Voronoi, 2 }, { "plates", Plates, 1.5 }, { "threads", Threads, 1.5 }, { "shells", Shells, 1.5 },
  { "one voxel", OneVoxel, 0.3 }, { "uniform", Uniform, 0.2 }, { "blocks that touch", BlocksThatTouch, 1.5 },
  { "balls", Balls, 1.5 }, { "wall with holes", WallWithHoles, 0.8 } } };

const Kind& RandomKind(RandomNumbers& random)
{
  double sum = 0;
  for (const Kind& kind : Kinds)
  {
    sum += kind.Weight;
  }
  double at = random.Real(0, sum);
  for (const Kind& kind : Kinds)
  {
    at -= kind.Weight;
    if (at < 0)
    {
      return kind;
    }
  }
  return Kinds.back();
}

Voxel RandomSize(RandomNumbers& random)
{
  Voxel size;
  for (int& n : size)
  {
    n = random.Chance(0.1) ? random.Integer(1, 3) : random.Integer(2, 24);
  }
  return size;
}

/// The label that each small number stands for: all different, all of the type.
std::vector<double> RandomLabels(int count, int type, RandomNumbers& random, std::string& words)
{
  const bool real = type == VTK_FLOAT || type == VTK_DOUBLE;
  const double largest = real ? 1 << 24 : std::min(vtkDataArray::GetDataTypeMax(type), std::ldexp(1.0, 31) - 1);
  const double least = real ? -(1 << 24) : std::max(vtkDataArray::GetDataTypeMin(type), -std::ldexp(1.0, 31));
  std::vector<double> labels;
  if (random.Chance(0.6))
  {
    words += "labels 0, 1, 2, ...";
    for (int n = 0; n < count; ++n)
    {
      labels.push_back(n);
    }
    return labels;
  }
  words += "sparse labels";
  std::set<double> used;
  while (int(labels.size()) < count)
  {
    const double spread = random.Chance(0.5) ? 1.0 : 1e-6;
    const double label = std::floor(random.Real(std::max(least, largest * -spread), std::max(largest * spread, 60.0)));
    if (label <= largest && used.insert(label).second)
    {
      labels.push_back(label);
    }
  }
  return labels;
}

void RandomFrame(vtkImageData* image, RandomNumbers& random, std::string& words)
{
  double spacing[3] = { 1, 1, 1 };
  if (random.Chance(0.6))
  {
    const double scale = std::pow(10.0, random.Real(-3, 3));
    for (double& s : spacing)
    {
      s = scale * std::pow(10.0, random.Real(0, 1));
    }
  }
  image->SetSpacing(spacing);
  if (random.Chance(0.5))
  {
    image->SetOrigin(random.Real(-100, 100), random.Real(-100, 100), random.Real(-100, 100));
  }
  double matrix[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  if (random.Chance(0.3))
  {
    // a rotation from a unit quaternion
    double q[4];
    double norm = 0;
    for (double& c : q)
    {
      c = random.Real(-1, 1);
      norm += c * c;
    }
    for (double& c : q)
    {
      c /= std::sqrt(norm);
    }
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    const double rotation[9] = { 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), 2 * (x * y + w * z),
      1 - 2 * (x * x + z * z), 2 * (y * z - w * x), 2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y) };
    std::copy(rotation, rotation + 9, matrix);
  }
  if (random.Chance(0.3))
  {
    const int axis = random.Integer(0, 2);
    for (int row = 0; row < 3; ++row)
    {
      matrix[3 * row + axis] *= -1;
    }
    words += ", mirrored";
  }
  image->SetDirectionMatrix(matrix);
}
}

FuzzVolume MakeFuzzVolume(std::uint64_t seed)
{
  RandomNumbers random(seed);
  FuzzVolume volume;
  const Kind& kind = RandomKind(random);
  Voxels voxels(RandomSize(random));
  volume.Words = kind.Name;
  kind.Make(voxels, random);
  if (random.Chance(0.15))
  {
    volume.Words += " with single voxels";
    Sprinkle(voxels, random);
  }
  volume.Words += ", ";

  const std::array<int, 12> types = { VTK_UNSIGNED_CHAR, VTK_SIGNED_CHAR, VTK_CHAR, VTK_SHORT, VTK_UNSIGNED_SHORT,
    VTK_INT, VTK_UNSIGNED_INT, VTK_LONG_LONG, VTK_UNSIGNED_LONG_LONG, VTK_ID_TYPE, VTK_FLOAT, VTK_DOUBLE };
  const int type = types[random.Integer(0, int(types.size()) - 1)];
  const int count = *std::max_element(voxels.Values.begin(), voxels.Values.end()) + 1;
  const std::vector<double> labels = RandomLabels(std::max(count, 2), type, random, volume.Words);
  volume.Background = static_cast<vtkIdType>(random.Chance(0.7) ? labels[0] : labels[random.Integer(0, count - 1)]);

  const bool cells = random.Chance(0.3);
  Voxel first = { 0, 0, 0 };
  if (random.Chance(0.4))
  {
    first = { random.Integer(-50, 50), random.Integer(-50, 50), random.Integer(-50, 50) };
  }
  volume.Image = vtkSmartPointer<vtkImageData>::New();
  int extent[6];
  for (int c = 0; c < 3; ++c)
  {
    extent[2 * c] = first[c];
    extent[2 * c + 1] = first[c] + voxels.Dims[c] - (cells ? 0 : 1);
  }
  volume.Image->SetExtent(extent);
  RandomFrame(volume.Image, random, volume.Words);
  auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
  array->SetName("Labels");
  array->SetNumberOfTuples(static_cast<vtkIdType>(voxels.Values.size()));
  for (std::size_t n = 0; n < voxels.Values.size(); ++n)
  {
    array->SetComponent(static_cast<vtkIdType>(n), 0, labels[voxels.Values[n]]);
  }
  vtkDataSetAttributes* attributes = volume.Image->GetPointData();
  if (cells)
  {
    attributes = volume.Image->GetCellData();
  }
  attributes->SetScalars(array);
  volume.Solid = *std::min_element(voxels.Dims.begin(), voxels.Dims.end()) >= 2;

  std::ostringstream words;
  words << volume.Words << ", " << voxels.Dims[0] << " x " << voxels.Dims[1] << " x " << voxels.Dims[2] << " "
        << array->GetDataTypeAsString() << (cells ? " cells" : " points") << ", spacing "
        << volume.Image->GetSpacing()[0] << " " << volume.Image->GetSpacing()[1] << " " << volume.Image->GetSpacing()[2]
        << ", background " << volume.Background;
  volume.Words = words.str();
  return volume;
}
