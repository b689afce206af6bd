// SPDX-License-Identifier: BSD-3-Clause
// TetGen, one run at a time.
#ifndef LabelMesh_Core_TetGenRun_h
#define LabelMesh_Core_TetGenRun_h

#include <string>

class tetgenio;

namespace LabelMesh
{
/// Runs TetGen with its command-line switches. One at a time per process: TetGen is not thread-safe. Throws
/// std::runtime_error where it fails: "TetGen could not `what`: " and its reason.
void RunTetGen(const std::string& switches, tetgenio& input, tetgenio& output, const std::string& what);
}

#endif
