// SPDX-License-Identifier: BSD-3-Clause
#include "SmoothMaximum.h"

#include <algorithm>
#include <limits>

namespace LabelMesh
{
namespace
{
/// Equation 10.
double Gate(double v, double epsilon)
{
  return 1 + v / std::sqrt(v * v + epsilon * epsilon);
}

/// The factor of grad v in equation 13: its two terms, 1 / s - v^2 / s^3 with s^2 = v^2 + epsilon^2, in one.
double GateSlope(double v, double epsilon)
{
  const double squared = v * v + epsilon * epsilon;
  return epsilon * epsilon / (squared * std::sqrt(squared));
}

/// The product of g(v_i - v_j) over all j but i and `without`.
double Gates(const double* values, int count, int i, int without, double epsilon)
{
  double product = 1;
  for (int j = 0; j < count; ++j)
  {
    if (j != i && j != without)
    {
      product *= Gate(values[i] - values[j], epsilon);
    }
  }
  return product;
}

/// The materials that compete with m at x.
std::vector<MaterialId> RivalsOf(const IndicatorSet& indicators, MaterialId m, const Vec3& x)
{
  std::vector<MaterialId> rivals;
  for (const MaterialId candidate : indicators.Candidates(x))
  {
    if (candidate != m)
    {
      rivals.push_back(candidate);
    }
  }
  // Candidates are those that can win nearby. Farther inside m the second largest need not be one of them.
  MaterialId second = m;
  double largest = -std::numeric_limits<double>::infinity();
  for (int other = 0; other < indicators.NumberOfMaterials(); ++other)
  {
    const double value = other == m ? largest : indicators.Value(MaterialId(other), x);
    if (value > largest)
    {
      largest = value;
      second = MaterialId(other);
    }
  }
  if (second != m && std::find(rivals.begin(), rivals.end(), second) == rivals.end())
  {
    rivals.push_back(second);
  }
  return rivals;
}
}

double SmoothMaximum(const double* values, int count, double epsilon, double* partials)
{
  const double scale = std::ldexp(1.0, 1 - count);
  double sum = 0;
  for (int i = 0; i < count; ++i)
  {
    sum += values[i] * Gates(values, count, i, i, epsilon);
  }
  for (int k = 0; partials && k < count; ++k)
  {
    double partial = Gates(values, count, k, k, epsilon);
    for (int j = 0; j < count; ++j)
    {
      if (j != k)
      {
        // v_k enters the gates of its own term and one gate of every other term.
        const double slope = GateSlope(values[k] - values[j], epsilon);
        partial +=
          slope * (values[k] * Gates(values, count, k, j, epsilon) - values[j] * Gates(values, count, j, k, epsilon));
      }
    }
    partials[k] = scale * partial;
  }
  return scale * sum;
}

double InsideOutside(const IndicatorSet& indicators, MaterialId m, const Vec3& x, double epsilon, Vec3* gradient)
{
  const std::vector<MaterialId> rivals = RivalsOf(indicators, m, x);
  const int count = int(rivals.size());
  std::vector<double> values(count), partials(count);
  std::vector<Vec3> gradients(count);
  for (int n = 0; n < count; ++n)
  {
    values[n] = gradient ? indicators.ValueAndGradient(rivals[n], x, gradients[n]) : indicators.Value(rivals[n], x);
  }
  const double own = gradient ? indicators.ValueAndGradient(m, x, *gradient) : indicators.Value(m, x);
  if (count == 0)
  {
    return own;
  }
  const double largest = SmoothMaximum(values.data(), count, epsilon, gradient ? partials.data() : nullptr);
  for (int n = 0; gradient && n < count; ++n)
  {
    *gradient -= partials[n] * gradients[n];
  }
  return own - largest;
}

double CellIndicator(
  const IndicatorSet& indicators, const MaterialId* materials, int count, const Vec3& x, double epsilon, Vec3* gradient)
{
  double sum = 0;
  if (gradient)
  {
    gradient->setZero();
  }
  for (int n = 0; n < count; ++n)
  {
    Vec3 slope;
    const double value = InsideOutside(indicators, materials[n], x, epsilon, gradient ? &slope : nullptr);
    sum += value * value;
    if (gradient)
    {
      *gradient += 2 * value * slope; // equation 5
    }
  }
  return sum;
}
}
