// SPDX-License-Identifier: BSD-3-Clause
#include "ExactPredicates.h"

#include <cmath>
#include <limits>

namespace LabelMesh
{
namespace
{
/// Half a unit in the last place of 1: the largest relative error of one rounding.
constexpr double Rounding = std::numeric_limits<double>::epsilon() / 2;

/// Bounds of the error of the plain determinants, relative to the sum of their terms' magnitudes.
constexpr double SpaceBound = (7.0 + 56.0 * Rounding) * Rounding;
constexpr double PlaneBound = (3.0 + 16.0 * Rounding) * Rounding;

int Sign(double value)
{
  return value > 0.0 ? 1 : (value < 0.0 ? -1 : 0);
}

/// A sum of doubles that is not rounded: terms of growing magnitude that share no bits, none of them zero.
/// The capacity is that of the determinant of nine differences: 3 x (2 x 2 x 2 x 2) x 2 x 2.
class Expansion
{
public:
  Expansion() = default;
  /// a - b
  static Expansion Difference(double a, double b)
  {
    Expansion result;
    const double high = a - b;
    const double part = a - high;
    result.Push((a - (high + part)) + (part - b));
    result.Push(high);
    return result;
  }

  int Sign() const { return this->Size == 0 ? 0 : LabelMesh::Sign(this->Terms[this->Size - 1]); }

  Expansion operator-() const
  {
    Expansion result;
    for (int i = 0; i < this->Size; ++i)
    {
      result.Push(-this->Terms[i]);
    }
    return result;
  }

  Expansion operator+(const Expansion& other) const
  {
    // Terms of both in the order of their magnitude, each added to what was carried from the one before.
    Expansion result;
    double carried = 0.0;
    for (int i = 0, j = 0; i < this->Size || j < other.Size;)
    {
      const bool own = j == other.Size || (i < this->Size && std::abs(this->Terms[i]) < std::abs(other.Terms[j]));
      result.PushSum(carried, own ? this->Terms[i++] : other.Terms[j++]);
    }
    result.Push(carried);
    return result;
  }

  Expansion operator*(double factor) const
  {
    Expansion result;
    double carried = 0.0;
    for (int i = 0; i < this->Size; ++i)
    {
      const double product = this->Terms[i] * factor;
      result.PushSum(carried, std::fma(this->Terms[i], factor, -product));
      result.PushSum(carried, product);
    }
    result.Push(carried);
    return result;
  }

  Expansion operator*(const Expansion& other) const
  {
    Expansion result;
    for (int i = 0; i < other.Size; ++i)
    {
      result = result + *this * other.Terms[i];
    }
    return result;
  }

private:
  void Push(double term)
  {
    if (term != 0.0)
    {
      this->Terms[this->Size++] = term;
    }
  }
  /// Carries the rounded sum on and keeps what was rounded off.
  void PushSum(double& carried, double term)
  {
    const double sum = carried + term;
    const double part = sum - carried;
    this->Push((carried - (sum - part)) + (term - part));
    carried = sum;
  }

  int Size = 0;
  double Terms[192]; // only the first Size are set
};

/// The signs of determinants whose rounded value is too small to tell.
int ExactOrientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  Expansion u[3], v[3], w[3];
  for (int i = 0; i < 3; ++i)
  {
    u[i] = Expansion::Difference(b[i], a[i]);
    v[i] = Expansion::Difference(c[i], a[i]);
    w[i] = Expansion::Difference(d[i], a[i]);
  }
  const auto term = [&](int i, int j, int k) { return (u[i] * v[j] + -(u[j] * v[i])) * w[k]; };
  return (term(1, 2, 0) + term(2, 0, 1) + term(0, 1, 2)).Sign();
}

int ExactOrientation(const Vec3& a, const Vec3& b, const Vec3& c, int u, int v)
{
  const auto product = [&](int i, int j)
  { return Expansion::Difference(b[i], a[i]) * Expansion::Difference(c[j], a[j]); };
  return (product(u, v) + -product(v, u)).Sign();
}
}

int Orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  const double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
  const double vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
  const double wx = d[0] - a[0], wy = d[1] - a[1], wz = d[2] - a[2];
  const double yz = uy * vz, zy = uz * vy, zx = uz * vx, xz = ux * vz, xy = ux * vy, yx = uy * vx;
  const double determinant = (yz - zy) * wx + (zx - xz) * wy + (xy - yx) * wz;
  const double magnitude = (std::abs(yz) + std::abs(zy)) * std::abs(wx) + (std::abs(zx) + std::abs(xz)) * std::abs(wy) +
    (std::abs(xy) + std::abs(yx)) * std::abs(wz);
  // No magnitude at all: every term has a factor that is exactly zero, as in a plane of the grid.
  if (std::abs(determinant) > SpaceBound * magnitude || magnitude == 0.0)
  {
    return Sign(determinant);
  }
  return ExactOrientation(a, b, c, d);
}

int Orientation(const Vec3& a, const Vec3& b, const Vec3& c, int u, int v)
{
  const double uv = (b[u] - a[u]) * (c[v] - a[v]), vu = (b[v] - a[v]) * (c[u] - a[u]);
  const double determinant = uv - vu;
  const double magnitude = std::abs(uv) + std::abs(vu);
  if (std::abs(determinant) > PlaneBound * magnitude || magnitude == 0.0)
  {
    return Sign(determinant);
  }
  return ExactOrientation(a, b, c, u, v);
}

bool Collinear(const Vec3& a, const Vec3& b, const Vec3& c)
{
  return Orientation(a, b, c, 0, 1) == 0 && Orientation(a, b, c, 1, 2) == 0 && Orientation(a, b, c, 2, 0) == 0;
}
}
