// SPDX-License-Identifier: BSD-3-Clause
// Slopes of a level-set function at samples beside its zero set.
#ifndef LabelMesh_Core_ZeroCrossing_h
#define LabelMesh_Core_ZeroCrossing_h

#include "Lattice.h"

namespace LabelMesh
{
/// The gradient that leaves the zero set where it is: along each axis the difference across the zero set where it lies
/// between the sample and a neighbour, else the central difference. Then phi / |gradient| is the distance to the plane
/// through the crossings, also where a part is thinner than a voxel (the subcell fix of Russo and Smereka).
class ZeroCrossing
{
public:
  explicit ZeroCrossing(const Lattice& frame)
    : Step{ 1, frame.Dims[0], Index(frame.Dims[0]) * frame.Dims[1] }
  {
    for (int a = 0; a < 3; ++a)
    {
      this->Inverse[a] = float(1 / frame.Spacing[a]);
    }
  }

  /// True when the sample is beside the zero set.
  bool Slopes(const float* p, float slopes[3]) const
  {
    bool beside = false;
    for (int a = 0; a < 3; ++a)
    {
      slopes[a] = Slope(p[-this->Step[a]], p[0], p[this->Step[a]], beside) * this->Inverse[a];
    }
    return beside;
  }

private:
  static float Slope(float before, float here, float after, bool& beside)
  {
    const bool first = (before > 0) != (here > 0), second = (after > 0) != (here > 0);
    const float back = here - before, ahead = after - here;
    beside = beside || first || second;
    return first && second ? (std::abs(back) > std::abs(ahead) ? back : ahead)
      : first              ? back
      : second             ? ahead
                           : 0.5f * (after - before);
  }

  std::array<Index, 3> Step;
  float Inverse[3];
};
}

#endif
