// SPDX-License-Identifier: BSD-3-Clause
#include "IndicatorSet.h"

#include "Parallel.h"

#include <limits>
#include <stdexcept>
#include <tuple>

namespace LabelMesh
{
namespace
{
constexpr double Overshoot = 0.3; // voxels: how far the spline of a signed distance may overshoot its samples
using Row = Eigen::Array4f;

/// The Catmull-Rom weights of four consecutive samples at t in [0, 1] from the second, and their derivatives.
struct Weights
{
  Row Value, First, Second;

  explicit Weights(float t)
  {
    const float t2 = t * t, t3 = t2 * t;
    this->Value = Row(-0.5f * t3 + t2 - 0.5f * t, 1.5f * t3 - 2.5f * t2 + 1.0f, -1.5f * t3 + 2.0f * t2 + 0.5f * t,
      0.5f * t3 - 0.5f * t2);
    this->First = Row(-1.5f * t2 + 2.0f * t - 0.5f, 4.5f * t2 - 5.0f * t, -4.5f * t2 + 4.0f * t + 0.5f, 1.5f * t2 - t);
    this->Second = Row(-3.0f * t + 2.0f, 9.0f * t - 5.0f, -9.0f * t + 4.0f, 3.0f * t - 1.0f);
  }
};

/// The 4^3 samples around a position, as rows along x, and the position within their middle cell.
struct Stencil
{
  std::array<float, 3> T{};
  const float* Samples = nullptr;
  Index RowStride = 0, SliceStride = 0;
  std::array<float, 64> Copy; // only where the support passes the border of the block

  /// False when x lies beyond the block.
  bool Locate(const IndicatorBlock& block, const Vec3& x)
  {
    const auto& dims = block.Frame.Dims;
    std::array<int, 3> cell;
    bool inner = true;
    for (int a = 0; a < 3; ++a)
    {
      const double u = (x[a] - block.Frame.Origin[a]) / block.Frame.Spacing[a];
      if (!(u >= 0.0 && u <= dims[a] - 1))
      {
        return false;
      }
      cell[a] = std::max(std::min(int(u), dims[a] - 2), 0);
      this->T[a] = float(u - cell[a]);
      inner = inner && cell[a] >= 1 && cell[a] + 2 < dims[a];
    }
    if (inner)
    {
      this->Samples = block.Values + block.Frame.At(cell[0] - 1, cell[1] - 1, cell[2] - 1);
      this->RowStride = dims[0];
      this->SliceStride = Index(dims[0]) * dims[1];
    }
    else
    {
      this->CopyClamped(block, cell);
    }
    return true;
  }

  Row At(int j, int k) const
  {
    return Eigen::Map<const Row>(this->Samples + j * this->RowStride + k * this->SliceStride);
  }

private:
  void CopyClamped(const IndicatorBlock& block, const std::array<int, 3>& cell)
  {
    const auto clamped = [&](int axis, int offset)
    { return std::clamp(cell[axis] + offset, 0, block.Frame.Dims[axis] - 1); };
    int n = 0;
    for (int k = -1; k < 3; ++k)
    {
      for (int j = -1; j < 3; ++j)
      {
        for (int i = -1; i < 3; ++i)
        {
          this->Copy[n++] = block.Values[block.Frame.At(clamped(0, i), clamped(1, j), clamped(2, k))];
        }
      }
    }
    this->Samples = this->Copy.data();
    this->RowStride = 4;
    this->SliceStride = 16;
  }
};

float Dot(const Row& a, const Row& b)
{
  return (a * b).sum();
}
}

IndicatorSet::IndicatorSet(std::vector<IndicatorBlock> blocks, LabelMesh::Label background, const Lattice& working)
  : Blocks(std::move(blocks))
  , Working_(working)
{
  if (this->Blocks.empty() || this->Blocks.size() >= NoMaterial)
  {
    throw std::invalid_argument("expected 1 to 65534 materials, found " + std::to_string(this->Blocks.size()));
  }
  for (std::size_t m = 0; m < this->Blocks.size(); ++m)
  {
    if (m > 0 && this->Blocks[m].Label <= this->Blocks[m - 1].Label)
    {
      throw std::invalid_argument("the materials' labels are not in ascending order");
    }
    if (this->Blocks[m].Label == background)
    {
      this->Background_ = MaterialId(m);
    }
  }
  this->FindCandidates(this->FindLabels());
}

double IndicatorSet::Value(MaterialId m, const Vec3& x) const
{
  const IndicatorBlock& block = this->Blocks[m];
  Stencil stencil;
  if (!stencil.Locate(block, x))
  {
    return block.Outside;
  }
  const Weights wx(stencil.T[0]), wy(stencil.T[1]), wz(stencil.T[2]);
  Row sum = Row::Zero();
  for (int k = 0; k < 4; ++k)
  {
    Row slice = Row::Zero();
    for (int j = 0; j < 4; ++j)
    {
      slice += wy.Value[j] * stencil.At(j, k);
    }
    sum += wz.Value[k] * slice;
  }
  return Dot(sum, wx.Value);
}

double IndicatorSet::ValueAndGradient(MaterialId m, const Vec3& x, Vec3& gradient) const
{
  const IndicatorBlock& block = this->Blocks[m];
  Stencil stencil;
  if (!stencil.Locate(block, x))
  {
    gradient.setZero();
    return block.Outside;
  }
  const Weights wx(stencil.T[0]), wy(stencil.T[1]), wz(stencil.T[2]);
  Row sum = Row::Zero(), alongY = Row::Zero(), alongZ = Row::Zero();
  for (int k = 0; k < 4; ++k)
  {
    Row slice = Row::Zero(), sliceY = Row::Zero();
    for (int j = 0; j < 4; ++j)
    {
      const Row row = stencil.At(j, k);
      slice += wy.Value[j] * row;
      sliceY += wy.First[j] * row;
    }
    sum += wz.Value[k] * slice;
    alongY += wz.Value[k] * sliceY;
    alongZ += wz.First[k] * slice;
  }
  gradient = Vec3(Dot(sum, wx.First), Dot(alongY, wx.Value), Dot(alongZ, wx.Value)).cwiseQuotient(block.Frame.Spacing);
  return Dot(sum, wx.Value);
}

double IndicatorSet::Difference(MaterialId a, MaterialId b, const Vec3& x, Vec3& gradient) const
{
  const IndicatorBlock &first = this->Blocks[a], &second = this->Blocks[b];
  const SampleBox &firstBox = this->Boxes[a], &secondBox = this->Boxes[b];
  bool inner = firstBox.Aligned && secondBox.Aligned;
  std::array<Index, 3> cell{};
  std::array<float, 3> t{};
  for (int axis = 0; axis < 3 && inner; ++axis)
  {
    const double u = (x[axis] - this->Working_.Origin[axis]) / this->Working_.Spacing[axis];
    cell[axis] = u > 0.0 ? Index(u) : -1;
    t[axis] = float(u - double(cell[axis]));
    for (const auto& [box, block] : { std::tie(firstBox, first), std::tie(secondBox, second) })
    {
      const Index local = cell[axis] - box.Offset[axis];
      inner = inner && local >= 1 && local + 2 < block.Frame.Dims[axis];
    }
  }
  if (!inner)
  {
    Vec3 other;
    const double difference = this->ValueAndGradient(a, x, gradient) - this->ValueAndGradient(b, x, other);
    gradient -= other;
    return difference;
  }
  const auto corner = [&cell](const IndicatorBlock& block, const SampleBox& box)
  {
    return block.Values +
      block.Frame.At(cell[0] - box.Offset[0] - 1, cell[1] - box.Offset[1] - 1, cell[2] - box.Offset[2] - 1);
  };
  const float* const samples[2] = { corner(first, firstBox), corner(second, secondBox) };
  const auto row = [&](int n, const IndicatorBlock& block, int j, int k)
  { return Eigen::Map<const Row>(samples[n] + block.Frame.At(0, j, k)); };
  const Weights wx(t[0]), wy(t[1]), wz(t[2]);
  Row sum = Row::Zero(), alongY = Row::Zero(), alongZ = Row::Zero();
  for (int k = 0; k < 4; ++k)
  {
    Row slice = Row::Zero(), sliceY = Row::Zero();
    for (int j = 0; j < 4; ++j)
    {
      const Row difference = row(0, first, j, k) - row(1, second, j, k);
      slice += wy.Value[j] * difference;
      sliceY += wy.First[j] * difference;
    }
    sum += wz.Value[k] * slice;
    alongY += wz.Value[k] * sliceY;
    alongZ += wz.First[k] * slice;
  }
  gradient =
    Vec3(Dot(sum, wx.First), Dot(alongY, wx.Value), Dot(alongZ, wx.Value)).cwiseQuotient(this->Working_.Spacing);
  return Dot(sum, wx.Value);
}

double IndicatorSet::ValueGradientHessian(MaterialId m, const Vec3& x, Vec3& gradient, Mat3& hessian) const
{
  const IndicatorBlock& block = this->Blocks[m];
  Stencil stencil;
  if (!stencil.Locate(block, x))
  {
    gradient.setZero();
    hessian.setZero();
    return block.Outside;
  }
  const Weights wx(stencil.T[0]), wy(stencil.T[1]), wz(stencil.T[2]);
  Row sum = Row::Zero(), y = Row::Zero(), z = Row::Zero(), yy = Row::Zero(), yz = Row::Zero(), zz = Row::Zero();
  for (int k = 0; k < 4; ++k)
  {
    Row slice = Row::Zero(), sliceY = Row::Zero(), sliceYY = Row::Zero();
    for (int j = 0; j < 4; ++j)
    {
      const Row row = stencil.At(j, k);
      slice += wy.Value[j] * row;
      sliceY += wy.First[j] * row;
      sliceYY += wy.Second[j] * row;
    }
    sum += wz.Value[k] * slice;
    y += wz.Value[k] * sliceY;
    yy += wz.Value[k] * sliceYY;
    z += wz.First[k] * slice;
    yz += wz.First[k] * sliceY;
    zz += wz.Second[k] * slice;
  }
  const Vec3& s = block.Frame.Spacing;
  gradient = Vec3(Dot(sum, wx.First), Dot(y, wx.Value), Dot(z, wx.Value)).cwiseQuotient(s);
  const double xy = Dot(y, wx.First) / (s[0] * s[1]);
  const double xz = Dot(z, wx.First) / (s[0] * s[2]);
  const double yzMixed = Dot(yz, wx.Value) / (s[1] * s[2]);
  hessian << Dot(sum, wx.Second) / (s[0] * s[0]), xy, xz, //
    xy, Dot(yy, wx.Value) / (s[1] * s[1]), yzMixed,       //
    xz, yzMixed, Dot(zz, wx.Value) / (s[2] * s[2]);
  return Dot(sum, wx.Value);
}

Index IndicatorSet::TileOf(const Vec3& x) const
{
  Index tile[3];
  for (int a = 0; a < 3; ++a)
  {
    const double cell = (x[a] - this->Working_.Origin[a]) / this->Working_.Spacing[a];
    tile[a] = cell > 0.0 ? std::min<Index>(Index(cell) / TileSize, this->TileDims[a] - 1) : 0;
  }
  return tile[0] + this->TileDims[0] * (tile[1] + Index(this->TileDims[1]) * tile[2]);
}

MaterialSpan IndicatorSet::Candidates(const Vec3& x) const
{
  const Index tile = this->TileOf(x);
  const Index first = this->TileStarts[tile];
  return { this->CandidateIds.data() + first, int(this->TileStarts[tile + 1] - first) };
}

int IndicatorSet::Largest(const Vec3& x, int k, RankedMaterial* ranked) const
{
  int count = 0;
  for (const MaterialId m : this->Candidates(x))
  {
    const double value = this->Value(m, x);
    int at = count;
    for (; at > 0 && ranked[at - 1].Value < value; --at)
    {
      if (at < k)
      {
        ranked[at] = ranked[at - 1];
      }
    }
    if (at < k)
    {
      ranked[at] = { m, value };
      count = std::min(count + 1, k);
    }
  }
  return count;
}

MaterialId IndicatorSet::LargestMaterial(const Vec3& x) const
{
  return this->LargestBut(x, nullptr, 0).Material;
}

RankedMaterial IndicatorSet::LargestBut(const Vec3& x, const MaterialId* excluded, int count) const
{
  RankedMaterial best{ NoMaterial, -std::numeric_limits<double>::infinity() };
  const MaterialSpan candidates = this->Candidates(x);
  if (count == 0 && candidates.Count == 1)
  {
    return { *candidates.First, this->Value(*candidates.First, x) };
  }
  for (const MaterialId m : candidates)
  {
    if (std::find(excluded, excluded + count, m) != excluded + count)
    {
      continue;
    }
    const double value = this->Value(m, x);
    if (value > best.Value)
    {
      best = { m, value };
    }
  }
  return best;
}

bool IndicatorSet::IsBeaten(MaterialId a, MaterialId b, const Vec3& x) const
{
  const MaterialSpan candidates = this->Candidates(x);
  if (candidates.Count <= 2)
  {
    return false;
  }
  double value = 0.0;
  bool known = false;
  for (const MaterialId m : candidates)
  {
    if (m == a || m == b || !this->CanWinAt(m, x))
    {
      continue;
    }
    value = known ? value : this->Value(a, x);
    known = true;
    if (this->Value(m, x) > value)
    {
      return true;
    }
  }
  return false;
}

bool IndicatorSet::CanWinAt(MaterialId m, const Vec3& x) const
{
  Index at[3];
  for (int a = 0; a < 3; ++a)
  {
    const double sample = (x[a] - this->Working_.Origin[a]) / this->Working_.Spacing[a] + 0.5;
    at[a] = std::clamp<Index>(Index(sample), 0, this->Working_.Dims[a] - 1);
  }
  const auto sampled = [&](MaterialId n, double& value)
  {
    const IndicatorBlock& block = this->Blocks[n];
    const SampleBox& box = this->Boxes[n];
    Index local[3];
    bool inside = box.Aligned;
    for (int a = 0; a < 3; ++a)
    {
      local[a] = at[a] - box.Offset[a];
      inside = inside && local[a] >= 0 && local[a] < block.Frame.Dims[a];
    }
    value = inside ? block.Values[block.Frame.At(local[0], local[1], local[2])] : 0.0;
    return inside;
  };
  double value, largest;
  return !sampled(m, value) || !sampled(this->Labels_[this->Working_.At(at[0], at[1], at[2])], largest) ||
    value >= largest - this->Slack();
}

double IndicatorSet::Slack() const
{
  // Indicators are distances (1-Lipschitz): with the nearest sample at most half a cell's diagonal away, a material can
  // only be the largest near a sample where it is at most a diagonal, and the spline's overshoot, below the largest.
  return this->Working_.Spacing.norm() + Overshoot * this->VoxelSize();
}
}
