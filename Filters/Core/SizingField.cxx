// SPDX-License-Identifier: BSD-3-Clause
#include "SizingField.h"

#include "Parallel.h"

#include <limits>
#include <numeric>
#include <stdexcept>

namespace LabelMesh
{
namespace
{
constexpr float Unbounded = 1e30f; // finite, so that an interpolation weight of zero makes it vanish

constexpr double CurvatureFloor = 0.6; // of Epsilon * floor: the curvature of sampled fields is not trusted beyond
constexpr double ShellVoxels =
  2.0; // samples this near to an interface sample hold its h0: every corner of a crossed cell

constexpr double HexagonArea = 0.866; // h^2: the area that each particle of a hexagonal packing has
// The share of that ideal number which the sampling reaches, by h in voxels, as measured on balls of radius 30: its
// first particles are chosen among one candidate per label-changing grid edge, few for each where h is near a voxel.
constexpr std::array<std::array<double, 2>, 8> PackingShares{ { { 0.5, 0.78 }, { 0.75, 0.85 }, { 1.0, 0.935 },
  { 1.5, 0.96 }, { 2.0, 1.04 }, { 3.0, 1.15 }, { 4.0, 1.18 }, { 6.0, 1.23 } } };

constexpr double TargetTolerance = 0.005; // relative, of the predicted number
constexpr int TargetIterations = 12;

void Check(const SizingOptions& options)
{
  const auto require = [](bool holds, const std::string& what)
  {
    if (!holds)
    {
      throw std::invalid_argument(what);
    }
  };
  require(options.Epsilon > 0 && std::isfinite(options.Epsilon),
    "Epsilon is " + std::to_string(options.Epsilon) + "; expected a positive share of the feature size, such as 0.5");
  require(options.FeatureSizeFloor >= 0,
    "FeatureSizeFloor is " + std::to_string(options.FeatureSizeFloor) + "; expected 0 voxels or more");
  require(options.FeatureSizeFloor > 0 || options.MinimumLength > 0,
    "FeatureSizeFloor and MinimumLength are both 0: the length would vanish at junctions; give one of them");
  require(options.MaximumDeviation >= 0,
    "MaximumDeviation is " + std::to_string(options.MaximumDeviation) + "; expected 0 (no bound) or more voxels");
  require(options.Gradation > 0, "Gradation is " + std::to_string(options.Gradation) + "; expected a positive slope");
  require(options.MinimumLength >= 0 && options.MaximumLength >= 0 && options.TargetTriangles >= 0,
    "MinimumLength, MaximumLength and TargetTriangles must not be negative; 0 turns them off");
  require(options.MaximumLength == 0 || options.MinimumLength <= options.MaximumLength,
    "MinimumLength " + std::to_string(options.MinimumLength) + " is above MaximumLength " +
      std::to_string(options.MaximumLength));
}

/// The vectors of a chamfer mask that go back in the order of the samples, and their lengths.
struct Chamfer
{
  struct Row
  {
    int Dx, Dy, Dz;
    float Rise;
  };
  std::vector<Row> Rows; ///< to other rows along x
  float RiseX = 0;       ///< to the previous sample

  Chamfer(const Vec3& spacing, double slope)
  {
    // An axis with a finer spacing has more steps, or the mask would leave wide angles between its vectors.
    int reach[3];
    for (int a = 0; a < 3; ++a)
    {
      reach[a] = std::clamp(int(std::lround(spacing.maxCoeff() / spacing[a])), 1, 3);
    }
    this->RiseX = float(slope * spacing[0]);
    for (int dz = -reach[2]; dz <= 0; ++dz)
    {
      for (int dy = -reach[1]; dy <= reach[1]; ++dy)
      {
        for (int dx = -reach[0]; dx <= reach[0]; ++dx)
        {
          if ((dz < 0 || dy < 0) && std::gcd(std::gcd(dx, dy), dz) == 1)
          {
            const double length = spacing.cwiseProduct(Vec3(dx, dy, dz)).norm();
            this->Rows.push_back({ dx, dy, dz, float(slope * length) });
          }
        }
      }
    }
  }
};

/// to[i] = min(to[i], from[i] + rise): apart, so that the compiler sees that the rows do not overlap.
void LowerRow(float* __restrict to, const float* __restrict from, int count, float rise)
{
  for (int i = 0; i < count; ++i)
  {
    const float value = from[i] + rise;
    to[i] = value < to[i] ? value : to[i];
  }
}

/// The user's bound on the working lattice.
std::vector<float> SampleBound(const Lattice& working, const Grid<float>& user)
{
  Grid<float> bound = user;
  for (float& length : bound.Values)
  {
    length = length > 0 && length < Unbounded ? length : Unbounded;
  }
  std::vector<float> sampled(static_cast<std::size_t>(working.Size()), Unbounded);
  ParallelFor(0, working.Dims[2], 1,
    [&](Index first, Index last)
    {
      for (Index at = working.At(0, 0, first); at < working.At(0, 0, last); ++at)
      {
        const auto c = working.Coordinates(at);
        const Vec3 x = working.Position(c[0], c[1], c[2]);
        const Vec3 index = bound.Frame.ToIndex(x);
        bool inside = true;
        for (int a = 0; a < 3; ++a)
        {
          inside = inside && index[a] >= -0.5 && index[a] <= bound.Frame.Dims[a] - 0.5;
        }
        if (inside)
        {
          sampled[at] = std::min(Unbounded, float(bound.Trilinear(x)));
        }
      }
    });
  return sampled;
}

/// A label-changing grid edge and the area of interface that it stands for.
struct Crossing
{
  Index First = 0, Second = 0;
  float Area = 0;
};

/// All of them. The area of interface with unit normal n per edge is V / sum |n_a| s_a, with V the volume of a voxel.
std::vector<Crossing> FindCrossings(const IndicatorSet& indicators)
{
  const Lattice& lattice = indicators.Working();
  const auto& labels = indicators.Labels();
  const Index stride[3] = { 1, lattice.Dims[0], Index(lattice.Dims[0]) * lattice.Dims[1] };
  std::vector<std::vector<Crossing>> slices(lattice.Dims[2]);
  const auto visit = [&](Index at, const std::array<int, 3>& c, std::vector<Crossing>& found)
  {
    for (int a = 0; a < 3; ++a)
    {
      const Index next = at + stride[a];
      if (c[a] + 1 >= lattice.Dims[a] || !indicators.HaveInterface(labels[at], labels[next]))
      {
        continue;
      }
      Vec3 x = lattice.Position(c[0], c[1], c[2]), first, second;
      x[a] += 0.5 * lattice.Spacing[a];
      indicators.ValueAndGradient(labels[at], x, first);
      indicators.ValueAndGradient(labels[next], x, second);
      const Vec3 g = (first - second).cwiseAbs();
      const double length = g.norm();
      const double shadow = length > 1e-9 ? g.dot(lattice.Spacing) / length : lattice.Spacing[a];
      found.push_back({ at, next, float(lattice.VoxelVolume() / shadow) });
    }
  };
  ParallelFor(0, lattice.Dims[2], 1,
    [&](Index first, Index last)
    {
      for (Index k = first; k < last; ++k)
      {
        for (Index at = lattice.At(0, 0, k); at < lattice.At(0, 0, k + 1); ++at)
        {
          visit(at, lattice.Coordinates(at), slices[k]);
        }
      }
    });
  std::vector<Crossing> crossings;
  for (const auto& slice : slices)
  {
    crossings.insert(crossings.end(), slice.begin(), slice.end());
  }
  return crossings;
}

double PackingShare(double voxels)
{
  const auto above = std::find_if(
    PackingShares.begin(), PackingShares.end(), [voxels](const auto& entry) { return entry[0] >= voxels; });
  if (above == PackingShares.begin() || above == PackingShares.end())
  {
    return above == PackingShares.end() ? PackingShares.back()[1] : PackingShares.front()[1];
  }
  const auto& [x0, y0] = *(above - 1);
  const auto& [x1, y1] = *above;
  return y0 + (y1 - y0) * (voxels - x0) / (x1 - x0);
}

double Predict(const std::vector<Crossing>& crossings, const Grid<float>& h)
{
  const double voxel = h.Frame.VoxelSize();
  double sum = 0;
  for (const Crossing& crossing : crossings)
  {
    const double length = 0.5 * (double(h.Values[crossing.First]) + h.Values[crossing.Second]);
    sum += PackingShare(length / voxel) * crossing.Area / (HexagonArea * length * length);
  }
  return sum;
}

/// The sizing field of given features and any scale of h0.
class SizingField
{
public:
  SizingField(
    const IndicatorSet& indicators, const FeatureSizes& features, const SizingOptions& options, const Grid<float>* user)
    : Frame(indicators.Working())
    , Features(features)
    , Options(options)
    , UserBound(user ? SampleBound(indicators.Working(), *user) : std::vector<float>())
  {
  }

  void Compute(double scale, std::vector<float>& h) const
  {
    const std::vector<float> wanted = this->InitialLengths(scale);
    h.resize(this->Frame.Size());
    ParallelFor(0, this->Frame.Dims[2], 1,
      [&](Index first, Index last)
      {
        for (Index k = first; k < last; ++k)
        {
          this->SpreadSlice(int(k), wanted, h);
        }
      });
    LimitGradient(this->Frame, this->Options.Gradation, h);
    const float most = float(this->Options.MaximumLength > 0 ? this->Options.MaximumLength : this->Features.Largest);
    const float least = float(this->Options.MinimumLength);
    ParallelFor(0, Index(h.size()), 65536,
      [&](Index first, Index last)
      {
        for (Index at = first; at < last; ++at)
        {
          h[at] = std::max(std::min(h[at], most), least);
        }
      });
  }

private:
  /// h0 of every interface sample.
  std::vector<float> InitialLengths(double scale) const
  {
    const SizingOptions& o = this->Options;
    const double floor = o.FeatureSizeFloor * this->Frame.VoxelSize();
    // An edge of length h stays h^2 curvature / 8 beside a curved surface.
    const double deviation = o.MaximumDeviation > 0 ? o.MaximumDeviation * this->Frame.VoxelSize() : Unbounded;
    const auto materialMaximum = [&o](MaterialId m)
    {
      const double most = m < o.MaterialMaximumLength.size() ? o.MaterialMaximumLength[m] : 0;
      return most > 0 ? most : double(Unbounded);
    };
    const auto interfaceMaximum = [&o](const std::array<MaterialId, 2>& materials)
    {
      const auto [first, second] = std::minmax(materials[0], materials[1]);
      const auto own = o.InterfaceMaximumLength.find({ first, second });
      return own != o.InterfaceMaximumLength.end() && own->second > 0 ? own->second : double(Unbounded);
    };
    std::vector<float> lengths(this->Features.Samples.size());
    ParallelFor(0, Index(lengths.size()), 4096,
      [&](Index first, Index last)
      {
        for (Index n = first; n < last; ++n)
        {
          const InterfaceSample& sample = this->Features.Samples[n];
          double h = o.Epsilon * std::max(double(sample.FeatureSize), floor);
          if (sample.Curvature > 0)
          {
            h = std::min(h, std::max(1.0 / sample.Curvature, CurvatureFloor * o.Epsilon * floor));
            h = std::min(h, std::max(std::sqrt(8.0 * deviation / sample.Curvature), o.Epsilon * floor));
          }
          h = std::min({ scale * h, materialMaximum(sample.Materials[0]), materialMaximum(sample.Materials[1]),
            interfaceMaximum(sample.Materials) });
          h = o.MaximumLength > 0 ? std::min(h, o.MaximumLength) : h;
          lengths[n] = float(std::max(h, o.MinimumLength));
        }
      });
    return lengths;
  }

  /// h0 at the samples around the interface: interpolation between them then gives h0 on it, and not more.
  void SpreadSlice(int k, const std::vector<float>& wanted, std::vector<float>& h) const
  {
    Index at = this->Frame.At(0, 0, k);
    for (int j = 0; j < this->Frame.Dims[1]; ++j)
    {
      for (int i = 0; i < this->Frame.Dims[0]; ++i, ++at)
      {
        float length =
          this->UserBound.empty() ? Unbounded : std::max(this->UserBound[at], float(this->Options.MinimumLength));
        const std::int32_t nearest = this->Features.Nearest[at];
        if (nearest >= 0)
        {
          const Vec3 offset =
            this->Frame.ToIndex(this->Features.Samples[nearest].Position.cast<double>()) - Vec3(i, j, k);
          if (offset.squaredNorm() <= ShellVoxels * ShellVoxels)
          {
            length = std::min(length, wanted[nearest]);
          }
        }
        h[at] = length;
      }
    }
  }

  const Lattice& Frame;
  const FeatureSizes& Features;
  const SizingOptions& Options;
  const std::vector<float> UserBound;
};

/// Scales h0 until the predicted number of particles is half the triangles wanted. The number falls as the scale grows,
/// as its inverse square where nothing else bounds h: a secant in logarithms, kept within the bracket found so far.
void ScaleToTarget(const SizingField& field, const std::vector<Crossing>& crossings, double particles,
  SizingResult& result, const Monitor& monitor)
{
  double low = 0, high = std::numeric_limits<double>::infinity();
  double exponent = -2, previousScale = 0, previousCount = 0;
  for (int iteration = 0; iteration < TargetIterations; ++iteration)
  {
    monitor.Step(double(iteration) / TargetIterations, "Scaling to the target");
    const double count = result.PredictedParticles;
    if (!(count > 0) || std::abs(count / particles - 1) < TargetTolerance)
    {
      return;
    }
    (count > particles ? low : high) = result.Scale;
    if (previousScale > 0 && count != previousCount)
    {
      exponent = std::clamp(std::log(count / previousCount) / std::log(result.Scale / previousScale), -4.0, -0.1);
    }
    previousScale = result.Scale;
    previousCount = count;
    double next = result.Scale * std::clamp(std::pow(particles / count, 1 / exponent), 0.01, 100.0);
    if (!(next > low && next < high))
    {
      next = std::sqrt(low * high);
    }
    if (!(next > 1e-6 && next < 1e6))
    {
      return; // another bound decides
    }
    result.Scale = next;
    field.Compute(result.Scale, result.TargetLength.Values);
    result.PredictedParticles = Predict(crossings, result.TargetLength);
  }
}

/// The feature size of the nearest interface sample.
Grid<float> SpreadFeatureSize(const Lattice& frame, const FeatureSizes& features)
{
  Grid<float> sizes(frame, float(features.Largest));
  if (!features.Samples.empty())
  {
    ParallelFor(0, frame.Size(), 65536,
      [&](Index first, Index last)
      {
        for (Index at = first; at < last; ++at)
        {
          sizes.Values[at] = features.Samples[features.Nearest[at]].FeatureSize;
        }
      });
  }
  return sizes;
}
}

void LimitGradient(const Lattice& lattice, double slope, std::vector<float>& h)
{
  const Chamfer chamfer(lattice.Spacing, slope);
  const int nx = lattice.Dims[0], ny = lattice.Dims[1], nz = lattice.Dims[2];
  const auto lower = [&](int j, int k, int sign)
  {
    float* row = h.data() + lattice.At(0, j, k);
    for (const Chamfer::Row& vector : chamfer.Rows)
    {
      const int dx = sign * vector.Dx, y = j + sign * vector.Dy, z = k + sign * vector.Dz;
      if (y >= 0 && y < ny && z >= 0 && z < nz)
      {
        const int first = std::max(0, -dx);
        LowerRow(row + first, h.data() + lattice.At(first + dx, y, z), nx - std::abs(dx), vector.Rise);
      }
    }
    return row;
  };
  for (int k = 0; k < nz; ++k)
  {
    for (int j = 0; j < ny; ++j)
    {
      float* row = lower(j, k, 1);
      for (int i = 1; i < nx; ++i)
      {
        row[i] = std::min(row[i], row[i - 1] + chamfer.RiseX);
      }
    }
  }
  for (int k = nz - 1; k >= 0; --k)
  {
    for (int j = ny - 1; j >= 0; --j)
    {
      float* row = lower(j, k, -1);
      for (int i = nx - 2; i >= 0; --i)
      {
        row[i] = std::min(row[i], row[i + 1] + chamfer.RiseX);
      }
    }
  }
}

SizingResult ComputeSizing(
  const IndicatorSet& indicators, const SizingOptions& options, const Grid<float>* user, const Monitor& monitor)
{
  Check(options);
  SizingResult result;
  result.TargetLength.Frame = indicators.Working();
  const FeatureSizes features = FindFeatureSizes(indicators, monitor.Part(0.0, 0.7));
  const std::vector<Crossing> crossings = FindCrossings(indicators);
  monitor.Step(0.75, "Limiting the gradient");
  const SizingField field(indicators, features, options, user);
  field.Compute(1.0, result.TargetLength.Values);
  result.PredictedParticles = Predict(crossings, result.TargetLength);
  if (options.TargetTriangles > 0)
  {
    ScaleToTarget(field, crossings, 0.5 * options.TargetTriangles, result, monitor.Part(0.8, 0.95));
  }
  result.FeatureSize = SpreadFeatureSize(indicators.Working(), features);
  monitor.Step(1.0);
  return result;
}

double PredictParticles(const IndicatorSet& indicators, const Grid<float>& targetLength)
{
  return Predict(FindCrossings(indicators), targetLength);
}
}
