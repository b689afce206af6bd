// SPDX-License-Identifier: BSD-3-Clause
#include "TetraChecks.h"

#include "Parallel.h"
#include "TetraQuality.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace LabelMesh
{
namespace
{
struct Figures
{
  double Ratio, Volume;
  std::array<double, 6> Angles;
};

std::vector<Figures> FiguresOf(const TetraMesh& mesh)
{
  std::vector<Figures> figures(mesh.Corners.size());
  ParallelFor(0, Index(figures.size()), 4096,
    [&](Index first, Index last)
    {
      for (Index t = first; t < last; ++t)
      {
        const auto& [a, b, c, d] = mesh.Corners[t];
        const auto& x = mesh.Points;
        figures[t] = { TetraRadiusRatio(x[a], x[b], x[c], x[d]), SignedVolume(x[a], x[b], x[c], x[d]),
          DihedralAngles(x[a], x[b], x[c], x[d]) };
      }
    });
  return figures;
}

TetraCheck CheckOf(const std::vector<Figures>& figures, const std::vector<std::int32_t>& tetrahedra)
{
  TetraCheck check;
  check.MinDihedral = check.MaxDihedral = std::numeric_limits<double>::quiet_NaN();
  check.Tetrahedra = Index(tetrahedra.size());
  if (tetrahedra.empty())
  {
    return check;
  }
  check.MinDihedral = 180.0;
  check.MaxDihedral = 0.0;
  std::vector<double> ratios;
  ratios.reserve(tetrahedra.size());
  double sum = 0.0, least = std::numeric_limits<double>::infinity();
  for (const std::int32_t t : tetrahedra)
  {
    const Figures& f = figures[t];
    ratios.push_back(f.Ratio);
    sum += f.Ratio;
    check.Volume += f.Volume;
    check.TurnedOver += !(f.Volume > 0.0);
    check.Slivers += !(f.Ratio >= SliverRatio);
    if (f.Ratio < least)
    {
      least = f.Ratio;
      check.Worst = t;
    }
    for (const double angle : f.Angles)
    {
      check.MinDihedral = std::min(check.MinDihedral, angle);
      check.MaxDihedral = std::max(check.MaxDihedral, angle);
      ++check.Dihedrals[std::min(int(angle * DihedralBins / 180.0), DihedralBins - 1)];
    }
  }
  const auto percentile = ratios.begin() + std::ptrdiff_t(ratios.size() / 100);
  std::nth_element(ratios.begin(), percentile, ratios.end());
  check.FirstPercentileRatio = *percentile;
  check.MinRadiusRatio = least;
  check.MeanRadiusRatio = sum / double(ratios.size());
  return check;
}
}

TetraChecks CheckTetrahedra(const TetraMesh& mesh, Index materials)
{
  const std::vector<Figures> figures = FiguresOf(mesh);
  std::vector<std::int32_t> all(mesh.Corners.size());
  std::vector<std::vector<std::int32_t>> byMaterial(static_cast<std::size_t>(materials));
  for (std::size_t t = 0; t < all.size(); ++t)
  {
    all[t] = std::int32_t(t);
    byMaterial[mesh.Materials[t]].push_back(std::int32_t(t));
  }
  TetraChecks checks;
  checks.All = CheckOf(figures, all);
  for (const std::vector<std::int32_t>& tetrahedra : byMaterial)
  {
    checks.Materials.push_back(CheckOf(figures, tetrahedra));
  }
  return checks;
}
}
