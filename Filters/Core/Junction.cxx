// SPDX-License-Identifier: BSD-3-Clause
#include "Junction.h"

#include <Eigen/Dense>

namespace LabelMesh
{
namespace
{
/// What must vanish on the junction of `base` and m, and its gradient: the difference of their indicators or, where m
/// is the space beyond a face of the volume's box, the distance to that face, which is exact.
double Condition(const IndicatorSet& indicators, MaterialId base, MaterialId m, const Vec3& x, Vec3& gradient)
{
  if (IsBorder(m))
  {
    gradient = BorderNormal(m);
    return indicators.Border()->Beyond(m, x);
  }
  return indicators.Difference(base, m, x, gradient);
}

/// The Gauss-Newton step -J^T (J J^T)^-1 g onto the junction of N + 1 materials; false where J is degenerate.
template <int N>
bool JunctionStep(const IndicatorSet& indicators, const MaterialId* materials, const Vec3& x, Vec3& step)
{
  Eigen::Matrix<double, N, 3> jacobian;
  Eigen::Matrix<double, N, 1> difference;
  for (int n = 0; n < N; ++n)
  {
    Vec3 gradient;
    difference[n] = Condition(indicators, materials[0], materials[n + 1], x, gradient);
    jacobian.row(n) = gradient;
  }
  const Eigen::Matrix<double, N, N> normal = jacobian * jacobian.transpose();
  // Gradients of distances have length about 1 and differences up to 2: a normal matrix this small relative to its
  // scale means parallel gradients, where no step is better than a wild one.
  const double scale = normal.trace();
  if (!(scale > 1e-6) || !(normal.determinant() > 1e-8 * std::pow(scale, N)))
  {
    return false;
  }
  const Eigen::Matrix<double, N, 1> multipliers = normal.inverse() * difference;
  step = -jacobian.transpose() * multipliers;
  return true;
}

bool JunctionStep(const IndicatorSet& indicators, const MaterialId* materials, int count, const Vec3& x, Vec3& step)
{
  switch (count)
  {
    case 2:
      return JunctionStep<1>(indicators, materials, x, step);
    case 3:
      return JunctionStep<2>(indicators, materials, x, step);
    default:
      return JunctionStep<3>(indicators, materials, x, step);
  }
}
}

Projection ProjectToJunction(
  const IndicatorSet& indicators, const MaterialId* materials, int count, const Vec3& x, const ProjectOptions& options)
{
  const double voxel = indicators.VoxelSize();
  Projection projection;
  projection.Position = x;
  projection.Residual = voxel;
  for (int iteration = 0; iteration < options.MaxIterations; ++iteration)
  {
    Vec3 step;
    if (!JunctionStep(indicators, materials, count, projection.Position, step))
    {
      return projection;
    }
    const double length = step.norm();
    projection.Residual = length;
    if (length > options.MaxStep * voxel)
    {
      step *= options.MaxStep * voxel / length;
    }
    projection.Position += step;
    if (length < options.Tolerance * voxel)
    {
      if (indicators.Border())
      {
        indicators.Border()->Snap(materials, count, projection.Position);
      }
      projection.Converged = true;
      return projection;
    }
  }
  return projection;
}

Vec3 InterfaceNormal(const IndicatorSet& indicators, MaterialId a, MaterialId b, const Vec3& x)
{
  // f_a grows towards the inside of a, so the normal from a into b is the negative of equation 6's.
  Vec3 normal;
  indicators.Difference(b, a, x, normal);
  const double length = normal.norm();
  return length > 1e-9 ? Vec3(normal / length) : Vec3::Zero();
}

Vec3 CurveTangent(const IndicatorSet& indicators, const MaterialId materials[3], const Vec3& x)
{
  Vec3 gradient[3];
  for (int n = 0; n < 3; ++n)
  {
    indicators.ValueAndGradient(materials[n], x, gradient[n]);
  }
  // Near the junction each inside/outside function is f_i - f_j for its largest rival f_j; their gradients and the
  // differences' span the same plane, and the three cross products of equation 8 are parallel: one serves.
  const auto across = [&](int n)
  { return IsBorder(materials[n]) ? Vec3(-BorderNormal(materials[n])) : Vec3(gradient[0] - gradient[n]); };
  const Vec3 tangent = across(1).cross(across(2));
  const double length = tangent.norm();
  return length > 1e-9 ? Vec3(tangent / length) : Vec3::Zero();
}
}
