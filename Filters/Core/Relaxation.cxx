// SPDX-License-Identifier: BSD-3-Clause
#include "Relaxation.h"

#include "Junction.h"
#include "NeighborGrid.h"
#include "Parallel.h"

#include <Eigen/Dense>

#include <optional>

namespace LabelMesh
{
namespace
{
constexpr int SweepsPerList = 5;        // neighbour lists are kept that long
constexpr double SweepTolerance = 0.02; // voxels: how far off their interface particles may be between sweeps
constexpr double FinalTolerance = 0.001;
constexpr double LargestResidual = 0.02;
constexpr double LeastTurn = 0.2;       // cosine between the normals before and after a move
constexpr double ListRange = 1.12;      // and so much longer than the interaction
constexpr double Regularization = 0.05; // of the trace of the Hessian

struct TangentFrame
{
  Vec3 U, V;
  explicit TangentFrame(const Vec3& normal)
  {
    // The axis least along the normal, made orthogonal to it.
    Vec3::Index axis;
    normal.cwiseAbs().minCoeff(&axis);
    this->U = ToTangentPlane(Vec3::Unit(axis), normal).normalized();
    this->V = normal.cross(this->U);
  }
};

/// What a particle's neighbours see of it, side by side in memory.
struct Neighbor
{
  Vec3 Position;
  double TargetLength;
};

/// Gauss-Newton step of one particle in its tangent plane against its neighbours.
Vec3 EnergyStep(const Particle& p, const std::vector<Neighbor>& particles, const Index* first, const Index* last)
{
  const TangentFrame tangent(p.Normal);
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  Eigen::Matrix2d hessian = Eigen::Matrix2d::Zero();
  for (const Index* j = first; j != last; ++j)
  {
    const Neighbor& q = particles[*j];
    const double scale = 1.0 / (InteractionRange * std::min(p.TargetLength, q.TargetLength));
    const Vec3 off = p.Position - q.Position;
    const double length = off.norm();
    const double d = std::max(scale * length, 0.05);
    if (d >= 1.0 || !(length > 0.0))
    {
      continue;
    }
    const double u = 1.0 / d - 1.0; // E = u^2
    const double first1 = -2.0 * u / (d * d) * scale;
    const double second = (2.0 / (d * d) + 4.0 * u / d) / (d * d) * scale * scale;
    const Eigen::Vector2d r(off.dot(tangent.U) / length, off.dot(tangent.V) / length);
    gradient += first1 * r;
    hessian += second * r * r.transpose();
  }
  const double trace = hessian.trace();
  if (!(trace > 0.0))
  {
    return Vec3::Zero();
  }
  hessian += Regularization * trace * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d step = -(hessian.inverse() * gradient);
  return step[0] * tangent.U + step[1] * tangent.V;
}

/// Neighbours of the moving particles as lists in one array.
struct NeighborLists
{
  std::vector<Index> Starts, Ids;

  NeighborLists(const std::vector<Particle>& particles, const std::vector<Index>& moving)
  {
    NeighborGrid grid(particles.size());
    for (const Particle& p : particles)
    {
      grid.Insert(p.Position, p.TargetLength);
    }
    constexpr Index chunk = 1024;
    const Index count = Index(moving.size()), chunks = (count + chunk - 1) / chunk;
    this->Starts.assign(count + 1, 0);
    this->Ids = ParallelCollect<Index>(chunks,
      [&](Index c, std::vector<Index>& found)
      {
        for (Index n = c * chunk; n < std::min(count, (c + 1) * chunk); ++n)
        {
          const Particle& p = particles[moving[n]];
          const std::size_t before = found.size();
          grid.VisitScaled(p.Position, p.TargetLength, ListRange * InteractionRange,
            [&](Index j, double)
            {
              if (j != moving[n] && Interact(p, particles[j]))
              {
                found.push_back(j);
              }
            });
          this->Starts[n + 1] = Index(found.size() - before);
        }
      });
    for (Index n = 0; n < count; ++n)
    {
      this->Starts[n + 1] += this->Starts[n];
    }
  }
};

/// As the public one; the Newton steps end when one is shorter than `tolerance` (voxels).
bool PutOnInterface(const IndicatorSet& indicators, MaterialId a, MaterialId b, const Vec3& x, double reach,
  double tolerance, Particle& particle)
{
  const double voxel = indicators.VoxelSize();
  Vec3 at = x, gradientA, gradientB, difference = Vec3::Zero();
  double residual = voxel;
  for (int iteration = 0; iteration < 4 && residual > tolerance * voxel; ++iteration)
  {
    const double value = indicators.ValueAndGradient(a, at, gradientA) - indicators.ValueAndGradient(b, at, gradientB);
    difference = gradientA - gradientB;
    const double squared = difference.squaredNorm();
    if (!(squared > 1e-2))
    {
      return false;
    }
    Vec3 step = -value / squared * difference;
    residual = step.norm();
    if (residual > 0.5 * voxel)
    {
      step *= 0.5 * voxel / residual;
    }
    at += step;
  }
  if (residual > LargestResidual * voxel || (at - x).squaredNorm() > reach * reach)
  {
    return false;
  }
  const MaterialId pair[2] = { a, b };
  if (indicators.Candidates(at).Count > 2)
  {
    const RankedMaterial rival = indicators.LargestBut(at, pair, 2);
    if (rival.Material != NoMaterial && rival.Value > indicators.Value(a, at))
    {
      return false;
    }
  }
  particle.Position = at;
  particle.Normal = -difference.normalized();
  particle.Residual = residual;
  return true;
}
}

bool PutOnInterface(
  const IndicatorSet& indicators, MaterialId a, MaterialId b, const Vec3& x, double reach, Particle& particle)
{
  return PutOnInterface(indicators, a, b, x, reach, FinalTolerance, particle);
}

double Relax(const IndicatorSet& indicators, const Grid<float>* targetLength, std::vector<Particle>& particles,
  const std::vector<Index>& moving, const RelaxOptions& options)
{
  const Index count = Index(moving.size());
  std::vector<Vec3> steps(count, Vec3::Zero());
  std::vector<double> moves(count, 0.0);
  std::vector<Neighbor> neighbors;
  neighbors.reserve(particles.size());
  for (const Particle& p : particles)
  {
    neighbors.push_back({ p.Position, p.TargetLength });
  }
  std::optional<NeighborLists> lists;
  for (int sweep = 0; sweep < options.Sweeps; ++sweep)
  {
    if (sweep % SweepsPerList == 0)
    {
      lists.emplace(particles, moving);
    }
    const double tolerance = sweep + 1 == options.Sweeps ? FinalTolerance : SweepTolerance;
    ParallelFor(0, count, 512,
      [&](Index first, Index last)
      {
        for (Index n = first; n < last; ++n)
        {
          Particle& p = particles[moving[n]]; // neighbours read their own copy of what they need
          const Index* const ids = lists->Ids.data();
          Vec3 step = options.Damping * EnergyStep(p, neighbors, ids + lists->Starts[n], ids + lists->Starts[n + 1]) +
            options.Momentum * ToTangentPlane(steps[n], p.Normal);
          const double length = step.norm(), most = options.LargestStep * p.TargetLength;
          if (length > most)
          {
            step *= most / length;
          }
          Particle moved = p;
          const Vec3 target = p.Position + step;
          const bool stays =
            !PutOnInterface(indicators, p.Materials[0], p.Materials[1], target, p.TargetLength, tolerance, moved) ||
            moved.Normal.dot(p.Normal) <= LeastTurn;
          if (stays)
          {
            steps[n].setZero();
            moves[n] = 0.0;
            continue;
          }
          steps[n] = step;
          moves[n] = (moved.Position - p.Position).norm() / p.TargetLength;
          moved.TargetLength = targetLength ? targetLength->Trilinear(moved.Position) : p.TargetLength;
          p = moved;
        }
      });
    ParallelFor(0, count, 4096,
      [&](Index first, Index last)
      {
        for (Index n = first; n < last; ++n)
        {
          neighbors[moving[n]] = { particles[moving[n]].Position, particles[moving[n]].TargetLength };
        }
      });
  }
  double sum = 0.0;
  for (const double move : moves)
  {
    sum += move;
  }
  return count > 0 ? sum / double(count) : 0.0;
}
}
