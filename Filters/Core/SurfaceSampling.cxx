// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceSampling.h"

#include "Parallel.h"
#include "PointTree.h"
#include "Relaxation.h"

namespace LabelMesh
{
namespace
{
/// Random bits from (seed, index): the same for any number of threads.
std::uint64_t RandomBits(std::uint64_t seed, std::uint64_t index)
{
  std::uint64_t z = seed * 0xD1B54A32D192ED03ull + index * 0x9E3779B97F4A7C15ull;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
  return z ^ (z >> 31);
}
double RandomUnit(std::uint64_t seed, std::uint64_t index)
{
  return double(RandomBits(seed, index) >> 11) * 0x1.0p-53;
}

/// How many candidates an edge gives: one is enough while a voxel is no longer than a target length.
int CandidatesPerEdge(double voxel, double h)
{
  const double ratio = 1.3 * voxel / h;
  return std::clamp(int(std::ceil(ratio * ratio)), 1, 12);
}

class CandidateFinder
{
public:
  CandidateFinder(const IndicatorSet& indicators, const Grid<float>& targetLength, std::uint32_t seed)
    : Indicators(indicators)
    , TargetLength(targetLength)
    , Seed(seed)
  {
  }

  std::vector<Particle> Run() const
  {
    return ParallelCollect<Particle>(this->Indicators.Working().Dims[2],
      [this](Index k, std::vector<Particle>& found) { this->FindInLayer(k, found); });
  }

private:
  void FindInLayer(Index k, std::vector<Particle>& found) const
  {
    const Lattice& frame = this->Indicators.Working();
    const MaterialId* labels = this->Indicators.Labels().data();
    const Index steps[3] = { 1, frame.Dims[0], Index(frame.Dims[0]) * frame.Dims[1] };
    for (Index j = 0; j < frame.Dims[1]; ++j)
    {
      for (Index i = 0; i < frame.Dims[0]; ++i)
      {
        const Index at = frame.At(i, j, k);
        const Index coordinates[3] = { i, j, k };
        for (int axis = 0; axis < 3; ++axis)
        {
          if (coordinates[axis] + 1 < frame.Dims[axis] &&
            this->Indicators.HaveInterface(labels[at], labels[at + steps[axis]]))
          {
            Vec3 middle = frame.Position(double(i), double(j), double(k));
            middle[axis] += 0.5 * frame.Spacing[axis];
            this->FindAtEdge(labels[at], labels[at + steps[axis]], middle, std::uint64_t(3 * at + axis), found);
          }
        }
      }
    }
  }

  void FindAtEdge(
    MaterialId a, MaterialId b, const Vec3& middle, std::uint64_t edge, std::vector<Particle>& found) const
  {
    const Lattice& frame = this->Indicators.Working();
    Particle particle;
    particle.Materials.Insert(a);
    particle.Materials.Insert(b);
    const int count = CandidatesPerEdge(frame.VoxelSize(), this->TargetLength.Trilinear(middle));
    for (int n = 0; n < count; ++n)
    {
      Vec3 start = middle;
      for (int axis = 0; n > 0 && axis < 3; ++axis)
      {
        const double unit = RandomUnit(this->Seed + 1, (edge * 16 + std::uint64_t(n)) * 3 + std::uint64_t(axis));
        start[axis] += (unit - 0.5) * frame.Spacing[axis];
      }
      if (PutOnInterface(
            this->Indicators, particle.Materials[0], particle.Materials[1], start, frame.Spacing.maxCoeff(), particle))
      {
        particle.TargetLength = this->TargetLength.Trilinear(particle.Position);
        found.push_back(particle);
      }
    }
  }

  const IndicatorSet& Indicators;
  const Grid<float>& TargetLength;
  std::uint32_t Seed;
};

PointTree TreeOf(const std::vector<Particle>& particles)
{
  return PointTree(
    Index(particles.size()), [&](Index n) -> const Vec3& { return particles[n].Position; },
    [&](Index n) { return particles[n].TargetLength; });
}

/// Calls body(n, near) for each n in [first, last), with what is near particle n of `particles`.
template <typename Body>
void ForEachNear(const PointTree& tree, double factor, const std::vector<Particle>& particles, Index first, Index last,
  const Body& body)
{
  PointTree::Scaled near(tree, factor);
  for (Index begin = first; begin < last; begin += PointTree::Width)
  {
    const Index end = std::min(last, begin + PointTree::Width);
    near.Gather(
      begin, end, [&](Index n) -> const Vec3& { return particles[n].Position; },
      [&](Index n) { return particles[n].TargetLength; });
    for (Index n = begin; n < end; ++n)
    {
      body(n, near);
    }
  }
}
}

std::vector<Particle> InterfaceCandidates(
  const IndicatorSet& indicators, const Grid<float>& targetLength, std::uint32_t seed)
{
  // Passes through space in its own order, each with a random share of the candidates: nearly as irregular as a random
  // order, and what is near in space stays near in memory.
  constexpr int passes = 8;
  const std::vector<Particle> found = CandidateFinder(indicators, targetLength, seed).Run();
  std::vector<Particle> candidates;
  candidates.reserve(found.size());
  for (std::uint64_t pass = 0; pass < passes; ++pass)
  {
    for (std::size_t n = 0; n < found.size(); ++n)
    {
      if (RandomBits(seed, n) % passes == pass)
      {
        candidates.push_back(found[n]);
      }
    }
  }
  return candidates;
}

ProtectionBalls::ProtectionBalls(const std::vector<Particle>& particles, const std::vector<Curve>& curves)
{
  std::vector<Vec3> centres;
  std::vector<double> radii;
  for (const Curve& curve : curves)
  {
    for (std::size_t n = 1; n < curve.Particles.size(); ++n)
    {
      const Vec3 &a = particles[curve.Particles[n - 1]].Position, &b = particles[curve.Particles[n]].Position;
      const double radius = 0.5 * ProtectionFactor * (b - a).norm();
      if (radius > 0)
      {
        centres.push_back(0.5 * (a + b));
        radii.push_back(radius);
      }
    }
  }
  this->Balls = NeighborGrid(radii.size());
  for (std::size_t n = 0; n < radii.size(); ++n)
  {
    this->Balls.Insert(centres[n], radii[n]);
  }
}

bool ProtectionBalls::Contains(const Vec3& x) const
{
  return this->Balls.AnyReaches(x);
}

CandidatePool::CandidatePool(std::vector<Particle> candidates, const ProtectionBalls& protection)
  : Candidates(std::move(candidates))
{
  std::vector<char> isProtected(this->Candidates.size());
  ParallelFor(0, Index(this->Candidates.size()), 1024,
    [&](Index first, Index last)
    {
      for (Index n = first; n < last; ++n)
      {
        isProtected[n] = protection.Contains(this->Candidates[n].Position);
      }
    });
  std::size_t kept = 0;
  for (std::size_t n = 0; n < this->Candidates.size(); ++n)
  {
    if (!isProtected[n])
    {
      this->Candidates[kept++] = this->Candidates[n];
    }
  }
  this->Candidates.resize(kept);
  this->Blockers.assign(kept, -1);
}

void CandidatePool::Renumber(const std::vector<std::int32_t>& numbers)
{
  ParallelFor(0, Index(this->Blockers.size()), 65536,
    [&](Index first, Index last)
    {
      for (Index n = first; n < last; ++n)
      {
        this->Blockers[n] = this->Blockers[n] >= 0 ? numbers[this->Blockers[n]] : -1;
      }
    });
}

void CandidatePool::AddWhereFree(std::vector<Particle>& particles, double distance)
{
  const auto collides = [&](const Particle& candidate, const Particle& other, double squared)
  {
    const double least = std::min(candidate.TargetLength, other.TargetLength);
    return squared < distance * distance * least * least &&
      (squared <= HardCore * HardCore * least * least || Interact(candidate, other));
  };
  // Against those that are there already in parallel; then one after another against those that were added.
  const Index before = Index(particles.size());
  {
    const PointTree there = TreeOf(particles);
    ParallelFor(0, Index(this->Candidates.size()), 1024,
      [&](Index first, Index last)
      {
        PointTree::Scaled near(there, distance);
        for (Index n = first; n < last; ++n)
        {
          const Particle& candidate = this->Candidates[n];
          std::int32_t& blocker = this->Blockers[n];
          const auto blocks = [&](Index other, double squared)
          {
            const bool found = collides(candidate, particles[other], squared);
            blocker = found ? std::int32_t(other) : blocker;
            return found;
          };
          // Most are still blocked by the particle that blocked them last time.
          if (blocker >= 0 && blocks(blocker, (particles[blocker].Position - candidate.Position).squaredNorm()))
          {
            continue;
          }
          blocker = -1;
          near.Gather(
            n, n + 1, [&](Index) -> const Vec3& { return candidate.Position; },
            [&](Index) { return candidate.TargetLength; });
          near.Any(candidate.Position, candidate.TargetLength, blocks);
        }
      });
  }
  // Those of a batch are asked in parallel about all that was added before it, then one after another about its own.
  constexpr Index batch = 16384;
  const Index count = Index(this->Candidates.size());
  NeighborGrid added;
  const auto isFree = [&](Index n, const NeighborGrid& grid, Index first)
  {
    const Particle& candidate = this->Candidates[n];
    return this->Blockers[n] < 0 &&
      !grid.AnyScaled(candidate.Position, candidate.TargetLength, distance,
        [&](Index other, double squared)
        {
          const bool found = collides(candidate, particles[first + other], squared);
          this->Blockers[n] = found ? std::int32_t(first + other) : -1;
          return found;
        });
  };
  for (Index start = 0; start < count; start += batch)
  {
    const Index end = std::min(count, start + batch), first = Index(particles.size());
    ParallelFor(start, end, 256,
      [&](Index from, Index to)
      {
        for (Index n = from; n < to; ++n)
        {
          isFree(n, added, before);
        }
      });
    NeighborGrid own;
    for (Index n = start; n < end; ++n)
    {
      if (isFree(n, own, first))
      {
        const Particle& candidate = this->Candidates[n];
        this->Blockers[n] = std::int32_t(particles.size());
        particles.push_back(candidate);
        own.Insert(candidate.Position, candidate.TargetLength);
      }
    }
    for (Index n = first; n < Index(particles.size()); ++n)
    {
      added.Insert(particles[n].Position, particles[n].TargetLength);
    }
  }
}

std::vector<std::int32_t> DeleteCrowded(std::vector<Particle>& particles, const ProtectionBalls& protection)
{
  const PointTree tree = TreeOf(particles);
  // Who is too close to whom, in parallel; then who stays, one after another.
  struct Conflict
  {
    Index Later, Earlier; // Earlier -1: a protection ball
  };
  constexpr Index chunk = 1024;
  const Index count = Index(particles.size());
  const std::vector<Conflict> conflicts = ParallelCollect<Conflict>((count + chunk - 1) / chunk,
    [&](Index c, std::vector<Conflict>& found)
    {
      ForEachNear(tree, CrowdedDistance, particles, c * chunk, std::min(count, (c + 1) * chunk),
        [&](Index i, const PointTree::Scaled& near)
        {
          const Particle& p = particles[i];
          if (p.CellDimension < 2)
          {
            return;
          }
          if (protection.Contains(p.Position))
          {
            found.push_back({ i, -1 });
          }
          near.ForEach(p.Position, p.TargetLength,
            [&](Index j, double squared)
            {
              const double core = HardCore * std::min(p.TargetLength, particles[j].TargetLength);
              if (j < i && (squared < core * core || Interact(p, particles[j])))
              {
                found.push_back({ i, j });
              }
            });
        });
    });
  // Of a crowded pair the later one goes; particles of 0- and 1-cells come first.
  std::vector<char> alive(particles.size(), 1);
  for (const Conflict& conflict : conflicts)
  {
    if (conflict.Earlier < 0 || alive[conflict.Earlier])
    {
      alive[conflict.Later] = 0;
    }
  }
  std::vector<std::int32_t> numbers(particles.size(), -1);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    if (alive[i])
    {
      numbers[i] = std::int32_t(kept);
      particles[kept++] = particles[i];
    }
  }
  particles.resize(kept);
  return numbers;
}
}
