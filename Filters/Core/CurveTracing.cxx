// SPDX-License-Identifier: BSD-3-Clause
#include "CurveTracing.h"

#include "Junction.h"
#include "Parallel.h"

#include <unordered_map>

namespace LabelMesh
{
namespace
{
using Triple = std::array<MaterialId, 3>;

// All in voxels.
constexpr double StepLength = 0.2;
constexpr double SmallestStep = 0.02;
constexpr double SameZeroCell = 0.05; // two solutions for the same four materials this close are one
constexpr double VisitedDistance = 0.6;
constexpr double SeedReach = 1.5;       // how far a solution may lie from the cell that suggested it
constexpr double ClosingDistance = 0.1; // how near to where it was a closed curve passes again
constexpr Index MostSteps = 1000000;

/// Positions by the voxel they are in, for look-ups among near ones.
class PositionHash
{
public:
  explicit PositionHash(double cell)
    : Cell(cell)
  {
  }
  void Insert(const Vec3& x, Index value) { this->Buckets[this->Key(this->CellOf(x))].push_back(value); }
  /// Calls visit(value) for all in the 27 cells around x until it returns true; returns whether one did.
  template <typename Visit>
  bool AnyNear(const Vec3& x, Visit&& visit) const
  {
    const std::array<Index, 3> c = this->CellOf(x);
    for (Index k = c[2] - 1; k <= c[2] + 1; ++k)
    {
      for (Index j = c[1] - 1; j <= c[1] + 1; ++j)
      {
        for (Index i = c[0] - 1; i <= c[0] + 1; ++i)
        {
          const auto bucket = this->Buckets.find(this->Key({ i, j, k }));
          if (bucket == this->Buckets.end())
          {
            continue;
          }
          for (const Index value : bucket->second)
          {
            if (visit(value))
            {
              return true;
            }
          }
        }
      }
    }
    return false;
  }

private:
  std::array<Index, 3> CellOf(const Vec3& x) const
  {
    return { Index(std::floor(x[0] / this->Cell)), Index(std::floor(x[1] / this->Cell)),
      Index(std::floor(x[2] / this->Cell)) };
  }
  static std::uint64_t Key(const std::array<Index, 3>& c)
  {
    constexpr std::uint64_t mask = (1u << 21) - 1;
    return (std::uint64_t(c[0]) & mask) | ((std::uint64_t(c[1]) & mask) << 21) | ((std::uint64_t(c[2]) & mask) << 42);
  }

  double Cell;
  std::unordered_map<std::uint64_t, std::vector<Index>> Buckets;
};

/// A cell of the lattice with the different labels of its corners, ascending.
struct SeedCell
{
  Vec3 Centre;
  MaterialSet Labels;
};

std::vector<SeedCell> FindSeedCells(const IndicatorSet& indicators)
{
  const Lattice& frame = indicators.Working();
  const MaterialId* labels = indicators.Labels().data();
  const Index row = frame.Dims[0], slice = row * frame.Dims[1];
  const Index corners[8] = { 0, 1, row, row + 1, slice, slice + 1, slice + row, slice + row + 1 };
  return ParallelCollect<SeedCell>(frame.Dims[2] - 1,
    [&](Index k, std::vector<SeedCell>& seeds)
    {
      for (Index j = 0; j + 1 < frame.Dims[1]; ++j)
      {
        for (Index i = 0; i + 1 < frame.Dims[0]; ++i)
        {
          const MaterialId* corner = labels + frame.At(i, j, k);
          MaterialSet found;
          for (const Index offset : corners)
          {
            if (corner[offset] != *corner || found.Size() == 0)
            {
              found.Insert(corner[offset]);
            }
          }
          if (found.Size() >= 3)
          {
            seeds.push_back({ frame.Position(double(i) + 0.5, double(j) + 0.5, double(k) + 0.5), found });
          }
        }
      }
    });
}

class Tracer
{
public:
  explicit Tracer(const IndicatorSet& indicators)
    : Indicators(indicators)
    , Voxel(indicators.VoxelSize())
    , Reach(SeedReach * indicators.Working().Spacing.maxCoeff())
    , ZeroCellHash(this->Voxel)
    , VisitedHash(VisitedDistance * this->Voxel)
  {
  }

  JunctionNetwork Run(const Monitor& monitor)
  {
    monitor.Step(0.0, "Tracing junction curves");
    const std::vector<SeedCell> seeds = FindSeedCells(this->Indicators);
    // Steps are short, so that an abort is heeded soon.
    const auto forEachSeed = [&seeds](const Monitor& part, auto&& body)
    {
      constexpr std::size_t seedsPerStep = 1024;
      for (std::size_t first = 0; first < seeds.size(); first += seedsPerStep)
      {
        const double done = double(first) / double(seeds.size());
        const Monitor here = part.Part(done, done);
        here.Step(0.0);
        for (std::size_t n = first; n < std::min(first + seedsPerStep, seeds.size()); ++n)
        {
          body(seeds[n], here);
        }
      }
    };
    forEachSeed(monitor.Part(0.0, 0.2), [this](const SeedCell& seed, const Monitor&) { this->SeedZeroCells(seed); });
    this->TraceFromZeroCells(monitor.Part(0.2, 0.6));
    forEachSeed(monitor.Part(0.6, 1.0),
      [this](const SeedCell& seed, const Monitor& here)
      {
        this->SeedOneCells(seed);
        this->TraceFromZeroCells(here); // those that the new curve discovered
      });
    this->CountOpenEnds();
    monitor.Step(1.0);
    return std::move(this->Network);
  }

private:
  struct End
  {
    Index ZeroCell;
    Triple Materials;
    bool operator==(const End& other) const
    {
      return this->ZeroCell == other.ZeroCell && this->Materials == other.Materials;
    }
  };
  struct EndHash
  {
    std::size_t operator()(const End& e) const
    {
      std::uint64_t h = std::uint64_t(e.ZeroCell) * 0x9E3779B97F4A7C15ull;
      for (const MaterialId m : e.Materials)
      {
        h = (h ^ m) * 0xBF58476D1CE4E5B9ull;
      }
      return std::size_t(h ^ (h >> 31));
    }
  };

  double ValueOf(MaterialId m, const Vec3& x) const { return this->Indicators.Value(m, x); }

  /// True where no other material exceeds those of the junction.
  bool Dominant(const MaterialId* materials, int count, const Vec3& x) const
  {
    const RankedMaterial rival = this->Indicators.LargestBut(x, materials, count);
    return rival.Material == NoMaterial || rival.Value <= this->ValueOf(materials[0], x) + 1e-3 * this->Voxel;
  }

  /// The 0-cell of four materials near x, known or new; -1 where there is none within reach.
  Index SolveZeroCell(const MaterialSet& four, const Vec3& x, double reach)
  {
    if (!this->Indicators.AnyInside(four.begin(), 4))
    {
      return -1;
    }
    const Projection p = ProjectToJunction(this->Indicators, four.begin(), 4, x, { 30, 1e-4, 0.4 });
    if (!p.Converged || (p.Position - x).norm() > reach || !this->Dominant(four.begin(), 4, p.Position))
    {
      return -1;
    }
    Index known = -1;
    this->ZeroCellHash.AnyNear(p.Position,
      [&](Index z)
      {
        const ZeroCell& cell = this->Network.ZeroCells[z];
        const bool same = cell.Materials == four && (cell.Position - p.Position).norm() < SameZeroCell * this->Voxel;
        known = same ? z : known;
        return same;
      });
    if (known < 0)
    {
      known = Index(this->Network.ZeroCells.size());
      this->Network.ZeroCells.push_back({ p.Position, four });
      this->ZeroCellHash.Insert(p.Position, known);
    }
    return known;
  }

  void SeedZeroCells(const SeedCell& seed)
  {
    const MaterialSet& m = seed.Labels;
    for (int a = 0; a < m.Size(); ++a)
    {
      for (int b = a + 1; b < m.Size(); ++b)
      {
        for (int c = b + 1; c < m.Size(); ++c)
        {
          for (int d = c + 1; d < m.Size(); ++d)
          {
            MaterialSet four;
            four.Insert(m[a]);
            four.Insert(m[b]);
            four.Insert(m[c]);
            four.Insert(m[d]);
            this->SolveZeroCell(four, seed.Centre, this->Reach);
          }
        }
      }
    }
  }

  void TraceFromZeroCells(const Monitor& monitor)
  {
    constexpr Index cellsPerStep = 64;
    for (; this->NextZeroCell < Index(this->Network.ZeroCells.size()); ++this->NextZeroCell)
    {
      if (this->NextZeroCell % cellsPerStep == 0)
      {
        monitor.Step(double(this->NextZeroCell) / double(this->Network.ZeroCells.size()));
      }
      const ZeroCell cell = this->Network.ZeroCells[this->NextZeroCell];
      for (int leaving = 3; leaving >= 0; --leaving)
      {
        Triple triple;
        for (int n = 0, at = 0; n < 4; ++n)
        {
          if (n != leaving)
          {
            triple[at++] = cell.Materials[n];
          }
        }
        if (this->Ends.count({ this->NextZeroCell, triple }) || !this->Indicators.AnyInside(triple.data(), 3))
        {
          continue;
        }
        Vec3 tangent = CurveTangent(this->Indicators, triple.data(), cell.Position);
        Vec3 own, leavingGradient;
        this->Indicators.ValueAndGradient(triple[0], cell.Position, own);
        this->Indicators.ValueAndGradient(cell.Materials[leaving], cell.Position, leavingGradient);
        if (tangent.dot(leavingGradient - own) > 0)
        {
          tangent = -tangent; // towards where the fourth material falls
        }
        OneCell curve;
        curve.Materials = triple;
        curve.Start = this->NextZeroCell;
        curve.Points.push_back(cell.Position);
        this->Follow(curve, tangent);
        if (curve.Points.size() > 1)
        {
          this->Accept(std::move(curve));
        }
      }
    }
  }

  /// Extends the curve from its last point along `tangent` until it closes, meets a 0-cell or is lost.
  void Follow(OneCell& curve, Vec3 tangent)
  {
    PositionHash passed(this->Voxel);
    const double sense =
      CurveTangent(this->Indicators, curve.Materials.data(), curve.Points.back()).dot(tangent) < 0 ? -1.0 : 1.0;
    double step = StepLength * this->Voxel;
    for (Index n = 0; n < MostSteps; ++n)
    {
      const Vec3 from = curve.Points.back();
      const Projection p =
        ProjectToJunction(this->Indicators, curve.Materials.data(), 3, from + step * tangent, { 6, 1e-3, 0.3 });
      const Vec3 move = p.Position - from;
      const double moved = move.norm();
      // Equation 8 turns the tangent of the other side of a thin sliver round: taking no turn means that a step does
      // not end on the neighbouring curve.
      const Vec3 next = p.Converged ? Vec3(sense * CurveTangent(this->Indicators, curve.Materials.data(), p.Position))
                                    : Vec3(Vec3::Zero());
      const bool smooth = p.Converged && moved < 1.5 * step && moved > 0.5 * step && move.dot(tangent) > 0.7 * moved &&
        next.dot(tangent) > 0.7;
      if (!smooth)
      {
        step *= 0.5;
        if (step < SmallestStep * this->Voxel)
        {
          return;
        }
        continue;
      }
      const RankedMaterial rival = this->Indicators.LargestBut(p.Position, curve.Materials.data(), 3);
      if (rival.Material != NoMaterial && rival.Value > this->ValueOf(curve.Materials[0], p.Position))
      {
        this->EndAtZeroCell(curve, rival.Material, p.Position);
        return;
      }
      const Index met = this->MetAgain(curve, passed, from, p.Position);
      if (met >= 0)
      {
        // At its start; where the steps had to be small, at one of its first points.
        curve.Closed = curve.Start < 0;
        curve.Points.erase(curve.Points.begin(), curve.Points.begin() + (curve.Closed ? met : 0));
        return;
      }
      passed.Insert(from, Index(curve.Points.size()) - 1);
      curve.Points.push_back(p.Position);
      tangent = next;
      step = std::min(1.5 * step, StepLength * this->Voxel);
    }
  }

  /// The point of the curve that its next segment passes again in the same direction; -1 where there is none.
  Index MetAgain(const OneCell& curve, const PositionHash& passed, const Vec3& from, const Vec3& to) const
  {
    const Index recent = Index(curve.Points.size()) - 5;
    Index met = -1;
    passed.AnyNear(to,
      [&](Index n)
      {
        const bool again = n < recent && (curve.Points[n + 1] - curve.Points[n]).dot(to - from) > 0 &&
          DistanceToSegment(curve.Points[n], from, to) < ClosingDistance * this->Voxel;
        met = again ? n : met;
        return again;
      });
    return met;
  }

  void EndAtZeroCell(OneCell& curve, MaterialId rival, const Vec3& x)
  {
    // Where several materials overtake within one step, the first one found may itself be dominated at its 0-cell.
    for (int attempt = 0; attempt < 4; ++attempt)
    {
      MaterialSet four;
      for (const MaterialId m : curve.Materials)
      {
        four.Insert(m);
      }
      four.Insert(rival);
      const Index cell = this->SolveZeroCell(four, x, 0.75 * this->Voxel);
      if (cell >= 0)
      {
        curve.End = cell;
        curve.Points.push_back(this->Network.ZeroCells[cell].Position);
        return;
      }
      const Projection p = ProjectToJunction(this->Indicators, four.begin(), 4, x, { 30, 1e-4, 0.4 });
      const RankedMaterial other = this->Indicators.LargestBut(p.Position, four.begin(), 4);
      if (!p.Converged || other.Material == NoMaterial)
      {
        return;
      }
      rival = other.Material;
    }
  }

  void SeedOneCells(const SeedCell& seed)
  {
    const MaterialSet& m = seed.Labels;
    for (int a = 0; a < m.Size(); ++a)
    {
      for (int b = a + 1; b < m.Size(); ++b)
      {
        for (int c = b + 1; c < m.Size(); ++c)
        {
          this->SeedOneCell({ m[a], m[b], m[c] }, seed.Centre);
        }
      }
    }
  }

  void SeedOneCell(const Triple& triple, const Vec3& x)
  {
    if (!this->Indicators.AnyInside(triple.data(), 3))
    {
      return;
    }
    const Projection p = ProjectToJunction(this->Indicators, triple.data(), 3, x, { 20, 1e-3, 0.4 });
    if (!p.Converged || (p.Position - x).norm() > this->Reach || this->Visited(triple, p.Position) ||
      !this->Dominant(triple.data(), 3, p.Position))
    {
      return;
    }
    const Vec3 tangent = CurveTangent(this->Indicators, triple.data(), p.Position);
    OneCell curve;
    curve.Materials = triple;
    curve.Points.push_back(p.Position);
    this->Follow(curve, tangent);
    if (!curve.Closed)
    {
      // The other way, to the other end.
      std::reverse(curve.Points.begin(), curve.Points.end());
      std::swap(curve.Start, curve.End);
      this->Follow(curve, -tangent);
    }
    if (curve.Points.size() > 1)
    {
      this->Accept(std::move(curve));
    }
  }

  bool Visited(const Triple& triple, const Vec3& x) const
  {
    const double radius = VisitedDistance * this->Voxel;
    return this->VisitedHash.AnyNear(x,
      [&](Index n)
      {
        const VisitedPoint& point = this->VisitedPoints[n];
        return point.Materials == triple && (point.Position - x).norm() < radius;
      });
  }

  void MarkVisited(const Triple& triple, const Vec3* points, Index count)
  {
    for (Index n = 0; n < count; ++n)
    {
      this->VisitedHash.Insert(points[n], Index(this->VisitedPoints.size()));
      this->VisitedPoints.push_back({ points[n], triple });
    }
  }

  void Accept(OneCell&& curve)
  {
    this->MarkVisited(curve.Materials, curve.Points.data(), Index(curve.Points.size()));
    for (const Index end : { curve.Start, curve.End })
    {
      if (end >= 0)
      {
        ++this->Ends[{ end, curve.Materials }];
      }
    }
    this->Network.OpenEnds += curve.Closed ? 0 : (curve.Start < 0) + (curve.End < 0);
    this->Network.OneCells.push_back(std::move(curve));
  }

  void CountOpenEnds()
  {
    Index single = 0;
    for (const auto& [end, count] : this->Ends)
    {
      single += count == 1;
    }
    Index expected = 0;
    for (const ZeroCell& cell : this->Network.ZeroCells)
    {
      // Each of the four triples that has anything but outside.
      const Index outside = std::count_if(
        cell.Materials.begin(), cell.Materials.end(), [this](MaterialId m) { return this->Indicators.IsOutside(m); });
      expected += outside == 3 ? 3 : 4;
    }
    this->Network.OpenEnds += expected - single;
  }

  const IndicatorSet& Indicators;
  double Voxel;
  double Reach; // world length
  JunctionNetwork Network;
  PositionHash ZeroCellHash, VisitedHash;
  struct VisitedPoint
  {
    Vec3 Position;
    Triple Materials;
  };
  std::vector<VisitedPoint> VisitedPoints;
  std::unordered_map<End, int, EndHash> Ends;
  Index NextZeroCell = 0;
};
}

double DistanceToSegment(const Vec3& x, const Vec3& a, const Vec3& b)
{
  const Vec3 ab = b - a;
  const double squared = ab.squaredNorm();
  const double t = squared > 0 ? std::clamp((x - a).dot(ab) / squared, 0.0, 1.0) : 0.0;
  return (x - a - t * ab).norm();
}

JunctionNetwork TraceJunctions(const IndicatorSet& indicators, const Monitor& monitor)
{
  return Tracer(indicators).Run(monitor);
}
}
