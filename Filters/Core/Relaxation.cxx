// SPDX-License-Identifier: BSD-3-Clause
#include "Relaxation.h"

#include "Junction.h"
#include "Parallel.h"
#include "PointTree.h"

#include <Eigen/Geometry>

#include <cmath>
#include <optional>

namespace LabelMesh
{
namespace
{
using Vec3f = Eigen::Vector3f;

constexpr double FinalTolerance = 0.001; // voxels: Newton steps onto the interface end when one is shorter
constexpr double LargestResidual = 0.02; // voxels: how far off their interface particles may be
// Between sweeps. What is left after a Newton step is about its square over the radius of curvature, so that the
// particle is within LargestResidual.
constexpr double SweepTolerance = 0.15;
constexpr double LeastTurn = 0.2;         // cosine between the normals before and after a move
constexpr double ListRange = 1.25;        // neighbour lists reach so much farther than the interaction
constexpr double ListedMove = 0.2;        // target lengths: lists are kept while particles have moved less on average
constexpr float Regularization = 0.05f;   // of the trace of the Hessian
constexpr float ShortestDistance = 0.05f; // of the interaction range: nearer pairs repel no more strongly

/// What a particle's neighbours see of it, side by side in memory. Single precision: a step need not be exact, but it
/// has the same bits everywhere.
struct Neighbor
{
  float X, Y, Z;
  float Inverse; ///< of the interaction range

  explicit Neighbor(const Particle& p)
    : X(float(p.Position[0]))
    , Y(float(p.Position[1]))
    , Z(float(p.Position[2]))
    , Inverse(float(1.0 / (InteractionRange * p.TargetLength)))
  {
  }
};

/// Two unit vectors that span the plane with the unit normal n.
struct TangentFrame
{
  Vec3f U, V;
  explicit TangentFrame(const Vec3f& n)
  {
    const float sign = std::copysign(1.0f, n[2]);
    const float a = -1.0f / (sign + n[2]), b = n[0] * n[1] * a;
    this->U = Vec3f(1.0f + sign * n[0] * n[0] * a, sign * b, -sign * n[0]);
    this->V = Vec3f(b, sign + n[1] * n[1] * a, -n[1]);
  }
};

/// The derivatives of a particle's energy in its tangent plane, lengths in its own interaction range. Sums are kept in
/// lanes, for the compiler to compute several neighbours at once in a fixed order.
class PlaneDerivatives
{
public:
  void Add(const Neighbor& p, const TangentFrame& tangent, const std::vector<Neighbor>& neighbors,
    const std::int32_t* first, const std::int32_t* last)
  {
    for (; first < last; first += Batch)
    {
      const int count = int(std::min<std::ptrdiff_t>(Batch, last - first));
      alignas(16) std::array<float, Batch> dx, dy, dz, scale;
      for (int n = 0; n < count; ++n)
      {
        const Neighbor& q = neighbors[first[n]];
        dx[n] = p.X - q.X;
        dy[n] = p.Y - q.Y;
        dz[n] = p.Z - q.Z;
        scale[n] = std::max(p.Inverse, q.Inverse);
      }
      const int end = (count + Lanes - 1) / Lanes * Lanes;
      for (int n = count; n < end; ++n)
      {
        dx[n] = dy[n] = dz[n] = 1.0f / p.Inverse; // just out of range
        scale[n] = p.Inverse;
      }
      for (int n = 0; n < end; n += Lanes)
      {
        this->AddLanes(p.Inverse, tangent, dx.data() + n, dy.data() + n, dz.data() + n, scale.data() + n);
      }
    }
  }

  /// The regularised Newton step along U and V, in interaction ranges; false where nothing is in range.
  bool Step(float& u, float& v) const
  {
    const auto sum = [](const Row& row) { return (row[0] + row[1]) + (row[2] + row[3]); };
    const float ru = sum(this->U), rv = sum(this->V);
    float uu = sum(this->UU), vv = sum(this->VV);
    const float uv = sum(this->UV), trace = uu + vv;
    if (!(trace > 0.0f))
    {
      return false;
    }
    uu += Regularization * trace;
    vv += Regularization * trace;
    const float inverse = 1.0f / (uu * vv - uv * uv);
    u = (vv * ru - uv * rv) * inverse;
    v = (uu * rv - uv * ru) * inverse;
    return true;
  }

private:
  static constexpr int Lanes = 4;
  static constexpr int Batch = 64;
  using Row = std::array<float, Lanes>;

  /// E = (1 / d - 1)^2 with d = scale |p - q|.
  void AddLanes(
    float unit, const TangentFrame& tangent, const float* dx, const float* dy, const float* dz, const float* scale)
  {
    const float ux = tangent.U[0], uy = tangent.U[1], uz = tangent.U[2];
    const float vx = tangent.V[0], vy = tangent.V[1], vz = tangent.V[2];
    for (int n = 0; n < Lanes; ++n)
    {
      const float x = unit * dx[n], y = unit * dy[n], z = unit * dz[n], ratio = scale[n] / unit;
      const float s = ratio * ratio;
      const float squared = std::max(s * (x * x + y * y + z * z), ShortestDistance * ShortestDistance);
      const float i2 = 1.0f / squared, i = std::sqrt(i2);
      const float e = std::max(i - 1.0f, 0.0f), inside = e > 0.0f ? 1.0f : 0.0f;
      const float first = 2.0f * e * i * i2 * s;
      const float second = (2.0f * i2 + 4.0f * e * i) * i2 * i2 * s * s * inside;
      const float a = x * ux + y * uy + z * uz, b = x * vx + y * vy + z * vz;
      this->U[n] += first * a;
      this->V[n] += first * b;
      this->UU[n] += second * a * a;
      this->UV[n] += second * a * b;
      this->VV[n] += second * b * b;
    }
  }

  Row U{}, V{}; ///< minus the gradient
  Row UU{}, UV{}, VV{};
};

/// Gauss-Newton step of one particle in its tangent plane against its neighbours.
Vec3 EnergyStep(
  const Particle& p, const std::vector<Neighbor>& neighbors, const std::int32_t* first, const std::int32_t* last)
{
  const TangentFrame tangent(p.Normal.cast<float>());
  PlaneDerivatives derivatives;
  derivatives.Add(Neighbor(p), tangent, neighbors, first, last);
  float u, v;
  if (!derivatives.Step(u, v))
  {
    return Vec3::Zero();
  }
  return InteractionRange * p.TargetLength * (u * tangent.U + v * tangent.V).cast<double>();
}

/// Neighbours of the moving particles as lists in one array.
struct NeighborLists
{
  std::vector<Index> Starts;
  std::vector<std::int32_t> Ids;

  NeighborLists(const std::vector<Particle>& particles, const std::vector<Index>& moving)
  {
    const PointTree tree(
      Index(particles.size()), [&](Index n) -> const Vec3& { return particles[n].Position; },
      [&](Index n) { return particles[n].TargetLength; });
    constexpr Index chunk = 1024;
    const Index count = Index(moving.size());
    this->Starts.assign(count + 1, 0);
    this->Ids = ParallelCollect<std::int32_t>((count + chunk - 1) / chunk,
      [&](Index c, std::vector<std::int32_t>& found)
      {
        PointTree::Scaled near(tree, ListRange * InteractionRange);
        const Index end = std::min(count, (c + 1) * chunk);
        for (Index first = c * chunk; first < end; first += PointTree::Width)
        {
          this->ListSome(near, particles, moving, first, std::min(end, first + PointTree::Width), found);
        }
      });
    for (Index n = 0; n < count; ++n)
    {
      this->Starts[n + 1] += this->Starts[n];
    }
  }

private:
  void ListSome(PointTree::Scaled& near, const std::vector<Particle>& particles, const std::vector<Index>& moving,
    Index first, Index last, std::vector<std::int32_t>& found)
  {
    near.Gather(
      first, last, [&](Index n) -> const Vec3& { return particles[moving[n]].Position; },
      [&](Index n) { return particles[moving[n]].TargetLength; });
    for (Index n = first; n < last; ++n)
    {
      const Particle& p = particles[moving[n]];
      const std::size_t before = found.size();
      near.ForEach(p.Position, p.TargetLength,
        [&](Index j, double)
        {
          if (j != moving[n] && Interact(p, particles[j]))
          {
            found.push_back(std::int32_t(j));
          }
        });
      this->Starts[n + 1] = Index(found.size() - before);
    }
  }
};

/// As the public one, on a face of the volume's box.
bool PutOnBorder(
  const IndicatorSet& indicators, MaterialId inside, MaterialId border, const Vec3& x, double reach, Particle& particle)
{
  Vec3 at = x;
  indicators.Border()->Snap(&border, 1, at);
  if ((at - x).squaredNorm() > reach * reach || indicators.IsBeaten(inside, border, at))
  {
    return false;
  }
  particle.Position = at;
  particle.Normal = BorderNormal(border);
  particle.Residual = 0.0;
  return true;
}

/// As the public one; the Newton steps end when one is shorter than `tolerance` (voxels).
bool PutOnInterface(const IndicatorSet& indicators, MaterialId a, MaterialId b, const Vec3& x, double reach,
  double tolerance, Particle& particle)
{
  if (IsBorder(b))
  {
    return PutOnBorder(indicators, a, b, x, reach, particle);
  }
  const double voxel = indicators.VoxelSize();
  Vec3 at = x, gradient = Vec3::Zero();
  double residual = voxel;
  for (int iteration = 0; iteration < 4 && residual > tolerance * voxel; ++iteration)
  {
    const double value = indicators.Difference(a, b, at, gradient);
    const double squared = gradient.squaredNorm();
    if (!(squared > 1e-2))
    {
      return false;
    }
    Vec3 step = -value / squared * gradient;
    residual = step.norm();
    if (residual > 0.5 * voxel)
    {
      step *= 0.5 * voxel / residual;
    }
    at += step;
  }
  if (residual > std::max(LargestResidual, tolerance) * voxel || (at - x).squaredNorm() > reach * reach ||
    indicators.IsBeaten(a, b, at))
  {
    return false;
  }
  particle.Position = at;
  particle.Normal = -gradient.normalized();
  particle.Residual = residual;
  return true;
}

/// All sweeps over some particles.
class Relaxer
{
public:
  Relaxer(const IndicatorSet& indicators, const Grid<float>* targetLength, std::vector<Particle>& particles,
    const std::vector<Index>& moving, const RelaxOptions& options)
    : Indicators(indicators)
    , TargetLength(targetLength)
    , Particles(particles)
    , Moving(moving)
    , Options(options)
    , Steps(moving.size(), Vec3::Zero())
    , Moves(moving.size(), 0.0)
    , Before(particles.begin(), particles.end())
    , After(this->Before)
  {
  }

  double Run(const Monitor& monitor)
  {
    const Index count = Index(this->Moving.size());
    double mean = 0.0, sinceList = 0.0;
    for (int sweep = 0; sweep < this->Options.Sweeps; ++sweep)
    {
      monitor.Step(double(sweep) / this->Options.Sweeps);
      if (sweep == 0 || sinceList > ListedMove)
      {
        this->Lists.emplace(this->Particles, this->Moving);
        sinceList = 0.0;
      }
      const double tolerance = sweep + 1 == this->Options.Sweeps ? FinalTolerance : SweepTolerance;
      ParallelFor(0, count, 512,
        [&](Index first, Index last)
        {
          for (Index n = first; n < last; ++n)
          {
            this->MoveOne(n, tolerance);
          }
        });
      this->Before.swap(this->After);
      double sum = 0.0;
      for (const double move : this->Moves)
      {
        sum += move;
      }
      mean = count > 0 ? sum / double(count) : 0.0;
      sinceList += mean;
    }
    return mean;
  }

private:
  void MoveOne(Index n, double tolerance)
  {
    Particle& p = this->Particles[this->Moving[n]]; // neighbours read what it was before
    const std::int32_t* const ids = this->Lists->Ids.data();
    Vec3& previous = this->Steps[n];
    Vec3 step = this->Options.StepFactor *
        EnergyStep(p, this->Before, ids + this->Lists->Starts[n], ids + this->Lists->Starts[n + 1]) +
      this->Options.Momentum * ToTangentPlane(previous, p.Normal);
    const double length = step.norm(), most = this->Options.LargestStep * p.TargetLength;
    if (length > most)
    {
      step *= most / length;
    }
    Particle moved = p;
    const bool moves = PutOnInterface(this->Indicators, p.Materials[0], p.Materials[1], p.Position + step,
                         p.TargetLength, tolerance, moved) &&
      moved.Normal.dot(p.Normal) > LeastTurn;
    previous = moves ? step : Vec3::Zero();
    this->Moves[n] = moves ? (moved.Position - p.Position).norm() / p.TargetLength : 0.0;
    if (moves)
    {
      moved.TargetLength = this->TargetLength ? this->TargetLength->Trilinear(moved.Position) : p.TargetLength;
      p = moved;
    }
    this->After[this->Moving[n]] = Neighbor(p);
  }

  const IndicatorSet& Indicators;
  const Grid<float>* TargetLength;
  std::vector<Particle>& Particles;
  const std::vector<Index>& Moving;
  const RelaxOptions& Options;
  std::vector<Vec3> Steps;
  std::vector<double> Moves; ///< of the last sweep, in target lengths
  std::vector<Neighbor> Before, After;
  std::optional<NeighborLists> Lists;
};
}

bool PutOnInterface(
  const IndicatorSet& indicators, MaterialId a, MaterialId b, const Vec3& x, double reach, Particle& particle)
{
  return PutOnInterface(indicators, a, b, x, reach, FinalTolerance, particle);
}

double Relax(const IndicatorSet& indicators, const Grid<float>* targetLength, std::vector<Particle>& particles,
  const std::vector<Index>& moving, const RelaxOptions& options, const Monitor& monitor)
{
  return Relaxer(indicators, targetLength, particles, moving, options).Run(monitor);
}
}
