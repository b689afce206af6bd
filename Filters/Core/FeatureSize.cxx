// SPDX-License-Identifier: BSD-3-Clause
#include "FeatureSize.h"

#include "FeatureTransform.h"
#include "Junction.h"
#include "Parallel.h"

#include <Eigen/Geometry>

namespace LabelMesh
{
namespace
{
using Vec3f = Eigen::Vector3f;

constexpr double Degree = 0.017453292519943295;
constexpr double BaseAngle = 60 * Degree;     // between the directions at junctions of 120 degrees
constexpr double LargestAngle = 149 * Degree; // never more is asked for
constexpr double CosineBase = 0.5;
constexpr double CosineLargest = -0.8571673;
constexpr double SampleOffset = 0.6;      // voxels: how far beside the true nearest point a sample may stand
constexpr double LeastSeparation = 0.9;   // of the distance: nearest points closer together are one feature
constexpr double LargestProjection = 1.0; // voxels: farther than this the projection has left its crossing
constexpr double NearVoxels = 4.0;        // voxels: how far the nearest sample is chosen exactly
constexpr int MostMedialWalk = 64;        // steps along the interface to the nearest sample

/// Runs body(k, items) for every slice k and joins the lists in the order of the slices.
template <typename Item, typename Body>
std::vector<Item> CollectSlices(int slices, const Body& body)
{
  std::vector<std::vector<Item>> found(slices);
  ParallelFor(0, slices, 1,
    [&](Index first, Index last)
    {
      for (Index k = first; k < last; ++k)
      {
        body(int(k), found[k]);
      }
    });
  std::size_t count = 0;
  for (const auto& items : found)
  {
    count += items.size();
  }
  std::vector<Item> all;
  all.reserve(count);
  for (auto& items : found)
  {
    all.insert(all.end(), items.begin(), items.end());
    std::vector<Item>().swap(items);
  }
  return all;
}

/// A point with a distance, to be kept once per voxel: the one with the smallest distance.
struct MedialPoint
{
  Vec3f Position = Vec3f::Zero();
  float Distance = 0.0f; ///< to the interface, world length
};

/// The sample of the lattice nearest to a position.
Index NearestSample(const Lattice& lattice, const Vec3f& position)
{
  const Vec3 index = lattice.ToIndex(position.cast<double>());
  Index at[3];
  for (int a = 0; a < 3; ++a)
  {
    at[a] = std::clamp<Index>(Index(std::lround(index[a])), 0, lattice.Dims[a] - 1);
  }
  return lattice.At(at[0], at[1], at[2]);
}

/// Calls body for a sample of the lattice and those around it, 27 in all.
template <typename Body>
void ForEachAround(const Lattice& lattice, const std::array<int, 3>& c, const Body& body)
{
  const auto& dims = lattice.Dims;
  for (int k = std::max(0, c[2] - 1); k <= std::min(dims[2] - 1, c[2] + 1); ++k)
  {
    for (int j = std::max(0, c[1] - 1); j <= std::min(dims[1] - 1, c[1] + 1); ++j)
    {
      for (int i = std::max(0, c[0] - 1); i <= std::min(dims[0] - 1, c[0] + 1); ++i)
      {
        body(lattice.At(i, j, k));
      }
    }
  }
}

/// Keeps, of the items that fall to one voxel, the one of the smallest rank (the earlier of equals). Returns the voxels
/// of those kept, in the order of the items.
template <typename Item, typename Rank>
std::vector<Index> OnePerVoxel(const Lattice& lattice, std::vector<Item>& items, const Rank& rank)
{
  std::vector<std::pair<Index, std::int32_t>> order(items.size());
  ParallelFor(0, Index(items.size()), 4096,
    [&](Index first, Index last)
    {
      for (Index n = first; n < last; ++n)
      {
        order[n] = { NearestSample(lattice, items[n].Position), std::int32_t(n) };
      }
    });
  std::sort(order.begin(), order.end());
  std::vector<Item> kept;
  std::vector<Index> voxels;
  for (std::size_t n = 0; n < order.size();)
  {
    const Index voxel = order[n].first;
    std::int32_t best = order[n].second;
    for (++n; n < order.size() && order[n].first == voxel; ++n)
    {
      if (rank(items[order[n].second], voxel) < rank(items[best], voxel))
      {
        best = order[n].second;
      }
    }
    kept.push_back(items[best]);
    voxels.push_back(voxel);
  }
  items.swap(kept);
  return voxels;
}

/// Finds points on the interfaces.
class InterfaceSampler
{
public:
  explicit InterfaceSampler(const IndicatorSet& indicators)
    : Indicators(indicators)
    , Frame(indicators.Working())
    , Stride{ 1, this->Frame.Dims[0], Index(this->Frame.Dims[0]) * this->Frame.Dims[1] }
  {
  }

  /// The point of the interface near the crossing of the grid edge from `from`, one step along `axis`.
  InterfaceSample AtCrossing(const std::array<int, 3>& from, int axis) const
  {
    const Index at = this->Frame.At(from[0], from[1], from[2]);
    const auto& labels = this->Indicators.Labels();
    InterfaceSample sample;
    sample.Materials = { labels[at], labels[at + this->Stride[axis]] };
    const Vec3 u = this->Frame.Position(from[0], from[1], from[2]);
    Vec3 v = u;
    v[axis] += this->Frame.Spacing[axis];
    const auto difference = [&](const Vec3& x)
    { return this->Indicators.Value(sample.Materials[0], x) - this->Indicators.Value(sample.Materials[1], x); };
    const double first = difference(u), last = difference(v);
    const double t = first > last ? std::clamp(first / (first - last), 0.0, 1.0) : 0.5;
    const Vec3 crossing = u + t * (v - u);
    std::array<MaterialId, 2> pair = sample.Materials;
    if (IsBorder(pair[0]))
    {
      std::swap(pair[0], pair[1]);
    }
    const Projection projected = ProjectToJunction(this->Indicators, pair.data(), 2, crossing, { 4, 1e-2, 0.4 });
    const bool stayed = (projected.Position - crossing).norm() < LargestProjection * this->Frame.Spacing.maxCoeff();
    const Vec3 position = stayed ? projected.Position : crossing;
    sample.Position = position.cast<float>();
    this->Shape(position, sample);
    return sample;
  }

  /// One sample per voxel that has a crossing on one of its three forward edges.
  void InSlice(int k, std::vector<InterfaceSample>& samples) const
  {
    const auto& labels = this->Indicators.Labels();
    for (int j = 0; j < this->Frame.Dims[1]; ++j)
    {
      for (int i = 0; i < this->Frame.Dims[0]; ++i)
      {
        const Index at = this->Frame.At(i, j, k);
        const std::array<int, 3> here{ i, j, k };
        for (int a = 0; a < 3; ++a)
        {
          if (here[a] + 1 < this->Frame.Dims[a] &&
            this->Indicators.HaveInterface(labels[at], labels[at + this->Stride[a]]))
          {
            samples.push_back(this->AtCrossing(here, a));
            break;
          }
        }
      }
    }
  }

  /// The middle of materials one voxel thick: samples whose two neighbours along an axis lie across two interfaces that
  /// face away from each other.
  void ThinPartsInSlice(int k, std::vector<MedialPoint>& medial) const
  {
    const auto& labels = this->Indicators.Labels();
    for (int j = 0; j < this->Frame.Dims[1]; ++j)
    {
      for (int i = 0; i < this->Frame.Dims[0]; ++i)
      {
        const Index at = this->Frame.At(i, j, k);
        const std::array<int, 3> here{ i, j, k };
        for (int a = 0; a < 3; ++a)
        {
          if (here[a] > 0 && here[a] + 1 < this->Frame.Dims[a] &&
            this->Indicators.HaveInterface(labels[at], labels[at - this->Stride[a]]) &&
            this->Indicators.HaveInterface(labels[at], labels[at + this->Stride[a]]) && !IsBorder(labels[at]))
          {
            this->ThinPart(here, a, medial);
          }
        }
      }
    }
  }

private:
  void ThinPart(const std::array<int, 3>& here, int axis, std::vector<MedialPoint>& medial) const
  {
    std::array<int, 3> before = here;
    --before[axis];
    const InterfaceSample p = this->AtCrossing(before, axis);
    const InterfaceSample q = this->AtCrossing(here, axis);
    // Outward from the thin part: p's normal points into it.
    const Vec3f across = q.Position - p.Position;
    const bool apart = q.Normal.dot(across) > 0 && p.Normal.dot(across) > 0;
    if (apart && -p.Normal.dot(q.Normal) < float(CosineLargest))
    {
      medial.push_back({ 0.5f * (p.Position + q.Position), 0.5f * across.norm() });
    }
  }

  /// Normal and larger principal curvature of the interface f_a = f_b.
  void Shape(const Vec3& x, InterfaceSample& sample) const
  {
    Vec3 gradient[2];
    Mat3 hessian[2];
    for (int n = 0; n < 2; ++n)
    {
      this->Indicators.ValueGradientHessian(sample.Materials[n], x, gradient[n], hessian[n]);
    }
    const Vec3 g = gradient[1] - gradient[0];
    const double length = g.norm();
    if (length < 1e-6)
    {
      return;
    }
    const Vec3 normal = g / length;
    sample.Normal = normal.cast<float>();
    const Vec3 u = normal.unitOrthogonal();
    const Vec3 v = normal.cross(u);
    const Mat3 h = (hessian[1] - hessian[0]) / length;
    const double uu = u.dot(h * u), uv = u.dot(h * v), vv = v.dot(h * v);
    sample.Curvature = float(std::abs(0.5 * (uu + vv)) + std::sqrt(0.25 * (uu - vv) * (uu - vv) + uv * uv));
  }

  const IndicatorSet& Indicators;
  const Lattice& Frame;
  std::array<Index, 3> Stride;
};

/// The transform chose by the voxels that hold the samples; near the interface, where that error is large beside the
/// distance, chooses by the samples themselves among what the neighbours chose.
std::vector<std::int32_t> ChooseBySamples(
  const Lattice& lattice, const std::vector<InterfaceSample>& samples, const std::vector<std::int32_t>& byVoxels)
{
  std::vector<std::int32_t> chosen(byVoxels.size());
  const double reach = NearVoxels * lattice.Spacing.maxCoeff();
  const float near = float(reach * reach);
  const auto choose = [&](Index at, const std::array<int, 3>& c)
  {
    const Vec3f x = lattice.Position(c[0], c[1], c[2]).cast<float>();
    std::int32_t best = byVoxels[at], tried = best;
    float least = (samples[best].Position - x).squaredNorm();
    if (least > near)
    {
      return best;
    }
    ForEachAround(lattice, c,
      [&](Index voxel)
      {
        const std::int32_t s = byVoxels[voxel];
        if (s == best || s == tried)
        {
          return;
        }
        tried = s;
        const float distance = (samples[s].Position - x).squaredNorm();
        if (distance < least)
        {
          least = distance;
          best = s;
        }
      });
    return best;
  };
  ParallelFor(0, Index(lattice.Dims[1]) * lattice.Dims[2], 64,
    [&](Index first, Index last)
    {
      for (Index row = first; row < last; ++row)
      {
        const int j = int(row % lattice.Dims[1]), k = int(row / lattice.Dims[1]);
        for (int i = 0; i < lattice.Dims[0]; ++i)
        {
          chosen[lattice.At(i, j, k)] = choose(lattice.At(i, j, k), { i, j, k });
        }
      }
    });
  return chosen;
}

/// Finds the medial axis from the nearest interface samples.
class MedialAxis
{
public:
  MedialAxis(const IndicatorSet& indicators, const FeatureSizes& features, const std::vector<Index>& voxels)
    : Indicators(indicators)
    , Frame(indicators.Working())
    , Features(features)
    , Voxels(voxels)
    , Unit(float(this->Frame.Spacing.maxCoeff()))
  {
  }

  /// Medial points on the edges from the samples of slice k to their three forward neighbours.
  void InSlice(int k, std::vector<MedialPoint>& medial) const
  {
    const auto& dims = this->Frame.Dims;
    const std::array<Index, 3> stride{ 1, dims[0], Index(dims[0]) * dims[1] };
    const auto& labels = this->Indicators.Labels();
    const auto& nearest = this->Features.Nearest;
    for (int j = 0; j < dims[1]; ++j)
    {
      for (int i = 0; i < dims[0]; ++i)
      {
        const Index at = this->Frame.At(i, j, k);
        const std::array<int, 3> here{ i, j, k };
        for (int a = 0; a < 3; ++a)
        {
          if (here[a] + 1 >= dims[a] || nearest[at] == nearest[at + stride[a]] ||
            labels[at] != labels[at + stride[a]] || IsBorder(labels[at]))
          {
            continue;
          }
          const Vec3f u = this->Frame.Position(i, j, k).cast<float>();
          Vec3f v = u;
          v[a] += float(this->Frame.Spacing[a]);
          this->Edge(labels[at], { u, v }, nearest[at], nearest[at + stride[a]], medial);
        }
      }
    }
  }

private:
  const Vec3f& At(std::int32_t sample) const { return this->Features.Samples[sample].Position; }

  void Edge(MaterialId material, const std::array<Vec3f, 2>& ends, std::int32_t p, std::int32_t q,
    std::vector<MedialPoint>& medial) const
  {
    if (!this->IsMedial(material, ends, p, q))
    {
      return;
    }
    // A nearer sample may stand farther away than the transform looked.
    const auto& [u, v] = ends;
    p = this->Walk(u, p);
    q = this->Walk(v, q);
    if (p == q || !this->IsMedial(material, ends, p, q))
    {
      return;
    }
    // Where the edge is equally far from both; a little beyond its ends where the transform switched too early.
    const float atU = (u - this->At(p)).squaredNorm() - (u - this->At(q)).squaredNorm();
    const float atV = (v - this->At(p)).squaredNorm() - (v - this->At(q)).squaredNorm();
    const float t = atV > atU ? std::clamp(-atU / (atV - atU), -1.0f, 2.0f) : 0.5f;
    const Vec3f middle = u + t * (v - u);
    medial.push_back({ middle, std::min((middle - this->At(p)).norm(), (middle - this->At(q)).norm()) });
  }

  bool IsMedial(MaterialId material, const std::array<Vec3f, 2>& ends, std::int32_t p, std::int32_t q) const
  {
    const Vec3f toP = this->At(p) - ends[0], toQ = this->At(q) - ends[1], across = this->At(q) - this->At(p);
    const float distance2 = std::min(toP.squaredNorm(), toQ.squaredNorm());
    if (across.squaredNorm() < float(LeastSeparation * LeastSeparation) * distance2)
    {
      return false;
    }
    // Right beside a smooth interface the directions to its samples may differ by any angle, but the normals do not.
    const Vec3f normalP = this->Outward(material, p, toP), normalQ = this->Outward(material, q, toQ);
    const float normals = normalP.dot(normalQ);
    if (!(normals < float(CosineBase)))
    {
      return false;
    }
    if (this->OnBorder(p) || this->OnBorder(q))
    {
      // A face of the volume's box is no feature where it meets another face or an interface: flat up to its edge. Only
      // what is thin between the two is.
      return normals < float(CosineLargest) && normalQ.dot(across) > 0 && normalP.dot(across) < 0;
    }
    // Between the two sides of a thin part the directions to the samples err most, and the normals tell all.
    if (normals < float(CosineLargest) && normalQ.dot(across) > 0 && normalP.dot(across) < 0)
    {
      return true;
    }
    const float directions = toP.dot(toQ) / std::sqrt(toP.squaredNorm() * toQ.squaredNorm());
    if (!(directions < float(CosineBase))) // also where a sample is on the interface
    {
      return false;
    }
    const double angle = BaseAngle + 2 * std::atan(SampleOffset * this->Unit / std::sqrt(distance2));
    return directions < std::cos(std::min(LargestAngle, angle));
  }

  bool OnBorder(std::int32_t sample) const
  {
    const std::array<MaterialId, 2>& pair = this->Features.Samples[sample].Materials;
    return IsBorder(pair[0]) || IsBorder(pair[1]);
  }

  /// The interface's normal out of `material` at the sample n, which lies in the direction `to` from a point inside.
  Vec3f Outward(MaterialId material, std::int32_t n, const Vec3f& to) const
  {
    const InterfaceSample& sample = this->Features.Samples[n];
    const bool inwards = sample.Materials[0] == material ? false
      : sample.Materials[1] == material                  ? true
                                                         : sample.Normal.dot(to) < 0;
    return inwards ? Vec3f(-sample.Normal) : sample.Normal;
  }

  /// From the sample p downhill to one that is nearer to x than all around it.
  std::int32_t Walk(const Vec3f& x, std::int32_t p) const
  {
    float best = (x - this->At(p)).squaredNorm();
    for (int step = 0; step < MostMedialWalk; ++step)
    {
      const std::int32_t from = p;
      ForEachAround(this->Frame, this->Frame.Coordinates(this->Voxels[from]),
        [&](Index voxel)
        {
          const std::int32_t s = this->Features.Nearest[voxel];
          const float distance = (x - this->At(s)).squaredNorm();
          if (distance < best)
          {
            best = distance;
            p = s;
          }
        });
      if (p == from)
      {
        break;
      }
    }
    return p;
  }

  const IndicatorSet& Indicators;
  const Lattice& Frame;
  const FeatureSizes& Features;
  const std::vector<Index>& Voxels;
  float Unit; ///< what a voxel is to the sampling of the interface: the coarsest spacing
};

/// The distance from each interface sample to the nearest medial point.
void MeasureFeatures(const Lattice& lattice, const std::vector<MedialPoint>& medial,
  const std::vector<Index>& medialVoxels, const std::vector<Index>& sampleVoxels, FeatureSizes& features)
{
  if (medial.empty())
  {
    for (InterfaceSample& sample : features.Samples)
    {
      sample.FeatureSize = float(features.Largest);
    }
    return;
  }
  const std::vector<std::int32_t> nearest = NearestSeeds(lattice, medialVoxels);
  ParallelFor(0, Index(features.Samples.size()), 4096,
    [&](Index first, Index last)
    {
      for (Index n = first; n < last; ++n)
      {
        InterfaceSample& sample = features.Samples[n];
        const auto c = lattice.Coordinates(sampleVoxels[n]);
        float best = float(features.Largest * features.Largest);
        // The transform goes by voxels; the neighbours' choices stand in for what a point between voxels would choose.
        ForEachAround(lattice, c,
          [&](Index voxel)
          { best = std::min(best, (medial[nearest[voxel]].Position - sample.Position).squaredNorm()); });
        sample.FeatureSize = std::sqrt(best);
      }
    });
}
}

FeatureSizes FindFeatureSizes(const IndicatorSet& indicators, const Monitor& monitor)
{
  const Lattice& lattice = indicators.Working();
  const int slices = lattice.Dims[2];
  FeatureSizes features;
  features.Largest = lattice.Spacing.cwiseProduct(Vec3(lattice.Dims[0], lattice.Dims[1], lattice.Dims[2])).norm();

  monitor.Step(0.0, "Finding the interfaces");
  const InterfaceSampler sampler(indicators);
  features.Samples = CollectSlices<InterfaceSample>(
    slices, [&sampler](int k, std::vector<InterfaceSample>& samples) { sampler.InSlice(k, samples); });
  const std::vector<Index> voxels = OnePerVoxel(lattice, features.Samples,
    [&lattice](const InterfaceSample& sample, Index voxel)
    {
      const auto c = lattice.Coordinates(voxel);
      return (lattice.Position(c[0], c[1], c[2]).cast<float>() - sample.Position).squaredNorm();
    });

  monitor.Step(0.3, "Finding the nearest interface");
  features.Nearest = NearestSeeds(lattice, voxels);
  if (voxels.empty())
  {
    return features;
  }
  features.Nearest = ChooseBySamples(lattice, features.Samples, features.Nearest);

  monitor.Step(0.5, "Finding the medial axis");
  const MedialAxis axis(indicators, features, voxels);
  std::vector<MedialPoint> medial = CollectSlices<MedialPoint>(slices,
    [&](int k, std::vector<MedialPoint>& found)
    {
      axis.InSlice(k, found);
      sampler.ThinPartsInSlice(k, found);
    });
  const std::vector<Index> medialVoxels =
    OnePerVoxel(lattice, medial, [](const MedialPoint& point, Index) { return point.Distance; });

  monitor.Step(0.8, "Measuring the features");
  MeasureFeatures(lattice, medial, medialVoxels, voxels, features);
  monitor.Step(1.0);
  return features;
}
}
