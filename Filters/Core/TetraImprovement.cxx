// SPDX-License-Identifier: BSD-3-Clause
#include "TetraImprovement.h"

#include "TetraComplex.h"
#include "TetraFlips.h"
#include "TetraInsertion.h"
#include "TetraQuality.h"
#include "TetraSmoothing.h"

#include <algorithm>

namespace LabelMesh
{
namespace
{
/// One attempt after another at tetrahedra that are to become better.
class Improver
{
public:
  Improver(TetraComplex& complex, const TetraImproveOptions& options, TetraImproveResult& result)
    : Complex(complex)
    , Options(options)
    , Result(result)
  {
  }

  /// Works on every tetrahedron below a wanted quality, the worst first. Returns how many became better.
  Index Pass(double wanted, const Monitor& monitor)
  {
    const std::vector<std::int32_t> bad = this->Below(wanted);
    constexpr std::size_t stride = 1024;
    Index better = 0;
    for (std::size_t n = 0; n < bad.size(); ++n)
    {
      if (n % stride == 0)
      {
        monitor.Step(double(n) / double(bad.size()));
      }
      // What was mended with another is dead, or not below any more.
      if (this->Complex.IsAlive(bad[n]) && this->Complex.Quality(bad[n]) < wanted)
      {
        better += this->Improve(bad[n]);
      }
    }
    return better;
  }

private:
  std::vector<std::int32_t> Below(double quality) const
  {
    std::vector<std::int32_t> below;
    for (Index t = 0; t < this->Complex.Size(); ++t)
    {
      if (this->Complex.IsAlive(t) && this->Complex.Quality(t) < quality)
      {
        below.push_back(std::int32_t(t));
      }
    }
    std::stable_sort(below.begin(), below.end(),
      [this](std::int32_t a, std::int32_t b) { return this->Complex.Quality(a) < this->Complex.Quality(b); });
    return below;
  }

  bool Improve(Index t)
  {
    return this->Flip(t) || this->Move(t) || this->Contract(t) ||
      (this->Complex.Quality(t) < this->Options.InsertionBelow && this->Insert(t));
  }

  bool Flip(Index t)
  {
    for (const auto& [i, j] : TetraEdges)
    {
      if (RemoveEdge(this->Complex, t, i, j))
      {
        ++this->Result.Edges;
        return true;
      }
    }
    for (int j = 0; j < 4; ++j)
    {
      if (RemoveFaces(this->Complex, t, j))
      {
        ++this->Result.Faces;
        return true;
      }
    }
    return false;
  }
  bool Move(Index t)
  {
    Index moves = 0;
    for (const std::int32_t v : this->Complex.Corners(t))
    {
      moves += !this->Complex.IsFixed(v) && RaiseWorstAt(this->Complex, v);
    }
    this->Result.Moves += moves;
    return moves > 0;
  }
  bool Contract(Index t)
  {
    const TetraCorners corners = this->Complex.Corners(t);
    for (const auto& [i, j] : TetraEdges)
    {
      if (LabelMesh::Contract(this->Complex, corners[i], corners[j]) ||
        LabelMesh::Contract(this->Complex, corners[j], corners[i]))
      {
        ++this->Result.Contractions;
        return true;
      }
    }
    return false;
  }
  bool Insert(Index t)
  {
    const bool inserted = InsertVertex(this->Complex, t);
    this->Result.Insertions += inserted;
    return inserted;
  }

  TetraComplex& Complex;
  const TetraImproveOptions& Options;
  TetraImproveResult& Result;
};
}

TetraImproveResult ImproveTetrahedra(TetraMesh& mesh, const TetraImproveOptions& options, const Monitor& monitor)
{
  TetraImproveResult result;
  monitor.Step(0.0, "Improving tetrahedra");
  TetraComplex complex(std::move(mesh));
  Improver improver(complex, options, result);
  const auto mend = [&](double first, double last)
  {
    for (int pass = 0; pass < options.Passes; ++pass)
    {
      const double begin = first + (last - first) * pass / options.Passes;
      ++result.Passes;
      if (improver.Pass(options.WantedQuality, monitor.Part(begin, begin + (last - first) / options.Passes)) == 0)
      {
        return;
      }
    }
  };
  mend(0.1, 0.5);
  for (int pass = 0; pass < options.SmoothingPasses; ++pass)
  {
    monitor.Step(0.5 + 0.4 * pass / options.SmoothingPasses);
    result.Moves += SmoothAll(complex, options.WantedQuality);
  }
  mend(0.9, 1.0);
  TetraSliding sliding(complex, options.Slide);
  for (int round = 0; round < options.Slide.Rounds; ++round)
  {
    const Index moved = sliding.Round();
    if (moved == 0)
    {
      break;
    }
    result.Slides += moved;
    improver.Pass(options.Slide.Below, monitor.Part(1.0, 1.0));
  }
  mesh = complex.Compacted();
  return result;
}
}
