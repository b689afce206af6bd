// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeRelaxation.h"

#include "Parallel.h"
#include "PointTree.h"
#include "Relaxation.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <memory>

namespace LabelMesh
{
namespace
{
constexpr double ListRange = 1.25;       // neighbour lists reach so much farther than the interaction
constexpr double ListedMove = 0.2;       // target lengths: lists are kept while particles have moved less on average
constexpr double Regularization = 0.05;  // of the trace of the Hessian
constexpr double ShortestDistance = 0.2; // of the interaction range: nearer pairs repel no more strongly
constexpr double SurfaceReach = 0.9; // target lengths: how far the plane at a 2-cell particle stands for the surface

/// A particle's neighbours, in one array for all.
struct VolumeNeighbors
{
  std::vector<Index> Starts;
  std::vector<std::int32_t> Ids;

  VolumeNeighbors(const std::vector<Particle>& particles, Index first, double range)
  {
    const PointTree tree(
      Index(particles.size()), [&](Index n) -> const Vec3& { return particles[n].Position; },
      [&](Index n) { return particles[n].TargetLength; });
    constexpr Index chunk = 1024;
    const Index count = Index(particles.size()) - first;
    this->Starts.assign(count + 1, 0);
    this->Ids = ParallelCollect<std::int32_t>((count + chunk - 1) / chunk,
      [&](Index c, std::vector<std::int32_t>& found)
      {
        PointTree::Scaled near(tree, range);
        const Index end = std::min(count, (c + 1) * chunk);
        for (Index begin = c * chunk; begin < end; begin += PointTree::Width)
        {
          this->ListSome(near, particles, first, begin, std::min(end, begin + PointTree::Width), found);
        }
      });
    for (Index n = 0; n < count; ++n)
    {
      this->Starts[n + 1] += this->Starts[n];
    }
  }

private:
  void ListSome(PointTree::Scaled& near, const std::vector<Particle>& particles, Index offset, Index begin, Index end,
    std::vector<std::int32_t>& found)
  {
    near.Gather(
      offset + begin, offset + end, [&](Index n) -> const Vec3& { return particles[n].Position; },
      [&](Index n) { return particles[n].TargetLength; });
    for (Index n = begin; n < end; ++n)
    {
      const Particle& p = particles[offset + n];
      const std::size_t before = found.size();
      near.ForEach(p.Position, p.TargetLength,
        [&](Index j, double)
        {
          if (j != offset + n && Interact(p, particles[j]))
          {
            found.push_back(std::int32_t(j));
          }
        });
      this->Starts[n + 1] = Index(found.size() - before);
    }
  }
};

/// The Gauss-Newton step of p, world length; zero where nothing is in range.
Vec3 EnergyStep(const Particle& p, const std::vector<Particle>& all, const std::int32_t* ids, const std::int32_t* end)
{
  Vec3 force = Vec3::Zero();
  Mat3 hessian = Mat3::Zero();
  for (; ids != end; ++ids)
  {
    const Particle& q = all[*ids];
    const double range = VolumeRange * std::min(p.TargetLength, q.TargetLength);
    const Vec3 r = (p.Position - q.Position) / range;
    const double squared = r.squaredNorm();
    if (squared >= 1.0)
    {
      continue;
    }
    // E = (1 / d - 1)^2.
    const double i2 = 1.0 / std::max(squared, ShortestDistance * ShortestDistance), i = std::sqrt(i2), e = i - 1.0;
    force += (2.0 * e * i * i2 / range) * r;
    hessian += ((2.0 * i2 + 4.0 * e * i) * i2 * i2 / (range * range)) * r * r.transpose();
  }
  const double trace = hessian.trace();
  if (!(trace > 0.0))
  {
    return Vec3::Zero();
  }
  hessian.diagonal().array() += Regularization * trace;
  return hessian.llt().solve(force);
}

/// How far x is above the plane of a 2-cell particle's surface, towards the material, in world length.
double HeightAbove(const Particle& surface, MaterialId material, const Vec3& x)
{
  const double height = surface.Normal.dot(x - surface.Position);
  return surface.Materials[0] == material ? -height : height;
}

bool StandsForSurface(const Particle& q, const Particle& p)
{
  const double reach = SurfaceReach * std::min(p.TargetLength, q.TargetLength);
  return q.CellDimension == 2 && (q.Position - p.Position).squaredNorm() < reach * reach;
}

/// Moves p up to the least height above the surface at its neighbours.
void HoldOff(const std::vector<Particle>& all, const std::int32_t* ids, const std::int32_t* end, Particle& p)
{
  const MaterialId material = p.Materials[0];
  for (; ids != end; ++ids)
  {
    const Particle& q = all[*ids];
    if (StandsForSurface(q, p))
    {
      const double missing =
        LeastHeight * std::min(p.TargetLength, q.TargetLength) - HeightAbove(q, material, p.Position);
      if (missing > 0.0)
      {
        p.Position += (q.Materials[0] == material ? -missing : missing) * q.Normal;
      }
    }
  }
}
}

double RelaxVolume(const IndicatorSet& indicators, const Grid<float>& lengths, Index first,
  std::vector<Particle>& particles, const VolumeRelaxOptions& options, const Monitor& monitor)
{
  const Index count = Index(particles.size()) - first;
  std::vector<Vec3> steps(count, Vec3::Zero());
  std::vector<double> moves(count, 0.0);
  std::vector<Particle> moved(particles.begin() + first, particles.end());
  std::unique_ptr<VolumeNeighbors> lists;
  const auto moveOne = [&](Index n)
  {
    const Particle& p = particles[first + n];
    const std::int32_t *ids = lists->Ids.data() + lists->Starts[n], *end = lists->Ids.data() + lists->Starts[n + 1];
    Vec3 step = options.StepFactor * EnergyStep(p, particles, ids, end) + options.Momentum * steps[n];
    const double length = step.norm(), most = options.LargestStep * p.TargetLength;
    step *= length > most ? most / length : 1.0;
    Particle& to = moved[n];
    to = p;
    to.Position += step;
    HoldOff(particles, ids, end, to);
    const bool inside = indicators.LargestMaterial(to.Position) == p.Materials[0];
    to.Position = inside ? to.Position : p.Position;
    to.TargetLength = lengths.Trilinear(to.Position);
    steps[n] = inside ? step : Vec3::Zero();
    moves[n] = (to.Position - p.Position).norm() / p.TargetLength;
  };
  double mean = 0.0, sinceList = 0.0;
  for (int sweep = 0; sweep < options.Sweeps && count > 0; ++sweep)
  {
    monitor.Step(double(sweep) / options.Sweeps);
    if (!lists || sinceList > ListedMove)
    {
      lists = std::make_unique<VolumeNeighbors>(particles, first, ListRange * VolumeRange);
      sinceList = 0.0;
    }
    ParallelFor(0, count, 512,
      [&](Index begin, Index end)
      {
        for (Index n = begin; n < end; ++n)
        {
          moveOne(n);
        }
      });
    std::copy(moved.begin(), moved.end(), particles.begin() + first);
    double sum = 0.0;
    for (const double move : moves)
    {
      sum += move;
    }
    mean = sum / double(count);
    sinceList += mean;
  }
  return mean;
}

std::vector<std::int32_t> DeleteCrowdedVolume(
  Index first, double distance, double height, std::vector<Particle>& particles)
{
  const VolumeNeighbors near(particles, first, std::max(distance, SurfaceReach));
  std::vector<std::int32_t> numbers(particles.size(), -1);
  Index kept = 0;
  for (Index i = 0; i < Index(particles.size()); ++i)
  {
    const Particle& p = particles[i];
    bool stays = true;
    for (Index n = i < first ? 0 : near.Starts[i - first]; i >= first && n < near.Starts[i - first + 1] && stays; ++n)
    {
      // Numbers of those that come earlier are known; the particles themselves have moved down the array.
      const Index j = near.Ids[n];
      if (j > i || numbers[j] < 0)
      {
        continue;
      }
      const Particle& q = particles[numbers[j]];
      const double least = std::min(p.TargetLength, q.TargetLength);
      stays = (p.Position - q.Position).norm() >= distance * least &&
        !(StandsForSurface(q, p) && HeightAbove(q, p.Materials[0], p.Position) < height * least);
    }
    if (stays)
    {
      numbers[i] = std::int32_t(kept);
      particles[kept++] = Particle(p);
    }
  }
  particles.resize(kept);
  return numbers;
}
}
