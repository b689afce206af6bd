// SPDX-License-Identifier: BSD-3-Clause
#include "TetGenRun.h"

#define TETLIBRARY
#include <tetgen.h>

#include <mutex>
#include <stdexcept>

namespace LabelMesh
{
namespace
{
std::string Reason(int code)
{
  switch (code)
  {
    case 1:
      return "out of memory";
    case 2:
      return "an internal error";
    case 3:
      return "a self-intersection";
    case 4:
      return "a feature below its tolerance";
    case 5:
      return "two nearly coincident facets";
    case 10:
      return "an input error";
    default:
      return "error " + std::to_string(code);
  }
}
}

void RunTetGen(const std::string& switches, tetgenio& input, tetgenio& output, const std::string& what)
{
  static std::mutex tetgenIsNotThreadSafe;
  std::string modifiable = switches;
  try
  {
    const std::lock_guard<std::mutex> lock(tetgenIsNotThreadSafe);
    tetrahedralize(modifiable.data(), &input, &output);
  }
  catch (int code)
  {
    throw std::runtime_error("TetGen could not " + what + ": " + Reason(code) +
      ". A smaller Epsilon, FeatureSizeFloor or MinimumLength may help; the mesh without tetrahedra is of use all the "
      "same.");
  }
}
}
