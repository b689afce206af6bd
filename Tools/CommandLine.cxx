// SPDX-License-Identifier: BSD-3-Clause
#include "CommandLine.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <sstream>
#include <stdexcept>

namespace
{
[[noreturn]] void Fail(const std::string& sentence)
{
  throw std::invalid_argument(sentence);
}

double ParseNumber(const std::string& option, const std::string& text, double least)
{
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value))
  {
    Fail(option + " needs a number, found '" + text + "'");
  }
  if (value < least)
  {
    std::ostringstream bound;
    bound << least;
    Fail(option + " must be at least " + bound.str() + ", found " + text);
  }
  return value;
}

long long ParseInteger(const std::string& option, const std::string& text)
{
  char* end = nullptr;
  const long long value = std::strtoll(text.c_str(), &end, 10);
  if (text.empty() || *end != '\0')
  {
    Fail(option + " needs an integer, found '" + text + "'");
  }
  return value;
}

std::vector<std::string> Split(const std::string& text, char separator)
{
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);)
  {
    parts.push_back(part);
  }
  return parts;
}

std::array<double, 3> ParseColor(const std::string& option, const std::string& text)
{
  char* end = nullptr;
  const unsigned long value = text.size() == 7 && text[0] == '#' ? std::strtoul(text.c_str() + 1, &end, 16) : 0;
  if (!end || *end != '\0')
  {
    Fail(option + ": a color is written #rrggbb, found '" + text + "'");
  }
  return { (value >> 16 & 255) / 255.0, (value >> 8 & 255) / 255.0, (value & 255) / 255.0 };
}

void ParseMaterial(const std::string& text, std::map<long long, MaterialOptions>& materials)
{
  const std::string option = "--material " + text;
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos || colon + 1 == text.size())
  {
    Fail("--material needs LABEL:key=value,..., found '" + text + "'");
  }
  MaterialOptions& material = materials[ParseInteger(option, text.substr(0, colon))];
  for (const std::string& setting : Split(text.substr(colon + 1), ','))
  {
    const std::size_t equals = setting.find('=');
    const std::string key = setting.substr(0, equals);
    const std::string value = equals == std::string::npos ? "" : setting.substr(equals + 1);
    std::map<std::string, std::optional<double>*> numbers = { { "radius", &material.Radius },
      { "opening", &material.OpeningRadius }, { "closing", &material.ClosingRadius },
      { "max-length", &material.MaximumLength } };
    if (const auto number = numbers.find(key); number != numbers.end())
    {
      *number->second = ParseNumber(option + ": " + key, value, 0.0);
    }
    else if (key == "name" && !value.empty())
    {
      material.Name = value;
    }
    else if (key == "color")
    {
      material.Color = ParseColor(option, value);
    }
    else
    {
      Fail(option + ": '" + setting + "' is none of radius=, opening=, closing=, max-length=, name=, color=");
    }
  }
}

void ParseInterface(const std::string& text, std::map<std::array<long long, 2>, double>& lengths)
{
  const std::string option = "--interface " + text;
  const std::size_t colon = text.find(":length=");
  const std::vector<std::string> labels = Split(text.substr(0, colon), ',');
  if (colon == std::string::npos || labels.size() != 2)
  {
    Fail("--interface needs A,B:length=L, found '" + text + "'");
  }
  const long long a = ParseInteger(option, labels[0]), b = ParseInteger(option, labels[1]);
  if (a == b)
  {
    Fail(option + ": an interface is between two labels");
  }
  lengths[{ std::min(a, b), std::max(a, b) }] = ParseNumber(option + ": length", text.substr(colon + 8), 0.0);
}

using Action = std::function<void(const std::string& option, const std::string& value)>;

/// The options that take a value.
std::map<std::string, Action> Actions(CommandLine& line)
{
  const auto text = [](std::string& target) -> Action
  {
    return [&target](const std::string& option, const std::string& value)
    {
      if (value.empty())
      {
        Fail(option + " needs a file name");
      }
      target = value;
    };
  };
  const auto number = [](std::optional<double>& target, double least) -> Action
  {
    return [&target, least](const std::string& option, const std::string& value)
    { target = ParseNumber(option, value, least); };
  };
  return {
    { "-o", text(line.Mesh) },
    { "--surfaces", text(line.Surfaces) },
    { "--particles", text(line.Particles) },
    { "--report", text(line.Report) },
    { "--error-map", text(line.ErrorMap) },
    { "--tets", text(line.Tets) },
    { "--tet-method",
      [&line](const std::string&, const std::string& value)
      {
        if (value != "packed" && value != "tetgen")
        {
          Fail("--tet-method is packed or tetgen, found '" + value + "'");
        }
        line.TetsByTetGen = value == "tetgen";
      } },
    { "--tet-refine",
      [&line](const std::string& option, const std::string& value)
      {
        line.TetRefinementRounds =
          static_cast<int>(std::min(ParseNumber(option, std::to_string(ParseInteger(option, value)), 0), 100.0));
      } },
    { "--tet-improve",
      [&line](const std::string& option, const std::string& value)
      {
        line.TetImprovePasses =
          static_cast<int>(std::min(ParseNumber(option, std::to_string(ParseInteger(option, value)), 0), 1000.0));
      } },
    { "--tet-slide",
      [&line](const std::string&, const std::string& value)
      {
        if (value != "on" && value != "off")
        {
          Fail("--tet-slide is on or off, found '" + value + "'");
        }
        line.TetSlide = value == "on";
      } },
    { "--volume-gradation", number(line.VolumeGradation, 0.01) },
    { "--volume-max-length", number(line.VolumeMaximumLength, 0.0) },
    { "--method",
      [&line](const std::string&, const std::string& value)
      {
        if (value != "particle" && value != "grid")
        {
          Fail("--method is particle or grid, found '" + value + "'");
        }
        line.Grid = value == "grid";
      } },
    { "--border",
      [&line](const std::string&, const std::string& value)
      {
        if (value != "closed" && value != "flat")
        {
          Fail("--border is closed or flat, found '" + value + "'");
        }
        line.FlatBorder = value == "flat";
      } },
    { "--smoothing",
      [&line](const std::string&, const std::string& value)
      {
        if (value != "volume" && value != "tighten")
        {
          Fail("--smoothing is volume or tighten, found '" + value + "'");
        }
        line.Tightening = value == "tighten";
      } },
    { "--radius", number(line.Radius, 0.0) },
    { "--epsilon", number(line.Epsilon, 1e-3) },
    { "--min-length", number(line.MinimumLength, 0.0) },
    { "--max-length", number(line.MaximumLength, 0.0) },
    { "--deviation", number(line.MaximumDeviation, 0) },
    { "--gradation", number(line.Gradation, 1e-3) },
    { "--memory-limit", number(line.MemoryLimit, 0.0) },
    { "--material", [&line](const std::string&, const std::string& value) { ParseMaterial(value, line.Materials); } },
    { "--interface",
      [&line](const std::string&, const std::string& value) { ParseInterface(value, line.InterfaceLengths); } },
    { "--labels",
      [&line](const std::string& option, const std::string& value)
      {
        for (const std::string& label : Split(value, ','))
        {
          line.Labels.push_back(ParseInteger(option, label));
        }
        if (line.Labels.empty())
        {
          Fail("--labels needs labels, like 1,2,5");
        }
      } },
    { "--background",
      [&line](const std::string& option, const std::string& value) { line.Background = ParseInteger(option, value); } },
    { "--min-component",
      [&line](const std::string& option, const std::string& value)
      {
        line.MinimumComponent =
          static_cast<long long>(ParseNumber(option, std::to_string(ParseInteger(option, value)), 0));
      } },
    { "--upsample",
      [&line](const std::string& option, const std::string& value)
      {
        const long long limit = ParseInteger(option, value);
        if (limit < 1 || limit > 4)
        {
          Fail("--upsample is " + value + "; expected 1 to 4 samples per voxel along each axis, at most");
        }
        line.MaximumUpsampling = static_cast<int>(limit);
      } },
    { "--triangles",
      [&line](const std::string& option, const std::string& value) {
        line.Triangles = static_cast<long long>(ParseNumber(option, std::to_string(ParseInteger(option, value)), 1));
      } },
    { "--threads",
      [&line](const std::string& option, const std::string& value)
      {
        line.Threads =
          static_cast<int>(std::min(ParseNumber(option, std::to_string(ParseInteger(option, value)), 1), 4096.0));
      } },
  };
}

bool EndsWith(const std::string& text, const std::string& end)
{
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

void RequireSuffix(const std::string& option, const std::string& file, const std::vector<std::string>& suffixes)
{
  const auto fits = [&file](const std::string& suffix)
  { return EndsWith(file, suffix) && file.size() > suffix.size(); };
  if (!file.empty() && std::none_of(suffixes.begin(), suffixes.end(), fits))
  {
    std::string all = suffixes[0];
    for (std::size_t n = 1; n < suffixes.size(); ++n)
    {
      all += (n + 1 < suffixes.size() ? ", " : " or ") + suffixes[n];
    }
    Fail(option + " writes a " + all + " file, found '" + file + "'");
  }
}

/// What only makes sense together.
void Check(const CommandLine& line, const std::set<std::string>& given)
{
  if (line.Input.empty())
  {
    Fail("no input file is given; labelmesh --help shows how it is used");
  }
  RequireSuffix("-o", line.Mesh, { ".vtp" });
  RequireSuffix("--surfaces", line.Surfaces, { ".vtpc" });
  RequireSuffix("--particles", line.Particles, { ".vtp" });
  RequireSuffix("--tets", line.Tets, { ".vtu", ".msh", ".inp" });
  RequireSuffix("--report", line.Report, { ".json" });
  RequireSuffix("--error-map", line.ErrorMap, { ".vtp" });
  std::set<std::string> files = { line.Input };
  for (const std::string& file : { line.Mesh, line.Surfaces, line.Particles, line.Tets, line.Report, line.ErrorMap })
  {
    if (!file.empty() && !files.insert(file).second)
    {
      Fail("'" + file + "' is named twice; every file needs a name of its own");
    }
  }
  if (files.size() == 1)
  {
    Fail("there is nothing to write: give -o FILE.vtp, --surfaces FILE.vtpc, --particles FILE.vtp, --tets FILE.vtu or "
         "--report FILE.json");
  }
  for (const char* option :
    { "--tet-method", "--tet-refine", "--tet-improve", "--tet-slide", "--volume-gradation", "--volume-max-length" })
  {
    if (line.Tets.empty() && given.count(option))
    {
      Fail(std::string(option) + " belongs to --tets FILE.vtu; leave it out without");
    }
  }
  for (const char* option :
    { "--particles", "--tets", "--border", "--smoothing", "--radius", "--material", "--interface", "--epsilon",
      "--min-length", "--max-length", "--deviation", "--gradation", "--memory-limit", "--min-component", "--upsample" })
  {
    if (line.Grid && given.count(option))
    {
      Fail(std::string(option) + " belongs to --method particle; leave it out with --method grid");
    }
  }
  if (line.MinimumLength && line.MaximumLength && *line.MaximumLength > 0 && *line.MinimumLength > *line.MaximumLength)
  {
    Fail("--min-length is larger than --max-length");
  }
}
}

CommandLine ParseCommandLine(int argc, char** argv)
{
  CommandLine line;
  const std::map<std::string, Action> actions = Actions(line);
  std::set<std::string> given;
  for (int i = 1; i < argc; ++i)
  {
    std::string option = argv[i];
    if (option == "--help" || option == "-h" || option == "--version")
    {
      (option == "--version" ? line.Version : line.Help) = true;
      return line;
    }
    if (option == "--quiet")
    {
      line.Quiet = true;
      continue;
    }
    if (option.empty() || option[0] != '-')
    {
      if (!line.Input.empty())
      {
        Fail("two input files are given, '" + line.Input + "' and '" + option + "'; labelmesh takes one");
      }
      line.Input = option;
      continue;
    }
    // --option=value is as good as --option value.
    const std::size_t equals = option.find('=');
    const bool joined = option.compare(0, 2, "--") == 0 && equals != std::string::npos;
    const std::string joinedValue = joined ? option.substr(equals + 1) : "";
    option = joined ? option.substr(0, equals) : option;
    const auto action = actions.find(option);
    if (action == actions.end())
    {
      Fail("there is no option " + option + "; labelmesh --help lists them");
    }
    if (!joined && i + 1 == argc)
    {
      Fail(option + " needs a value");
    }
    action->second(option, joined ? joinedValue : argv[++i]);
    given.insert(option);
  }
  Check(line, given);
  return line;
}

std::string HelpText()
{
  return R"(usage: labelmesh INPUT [-o mesh.vtp] [--surfaces s.vtpc] [--particles p.vtp] [--tets t.vtu] [--report r.json]
                       [options]

Meshes all material interfaces of a label volume: watertight, conforming, adaptive.
INPUT: .mha .mhd .nrrd .nii .nii.gz .vti; one integer label per voxel. Names and colors of 3D Slicer's .seg.nrrd are
kept.

Files to write (each only when asked for, and only whole):
  -o FILE.vtp           triangles, each once, with the labels of its two sides (BoundaryLabels)
  --surfaces FILE.vtpc  a closed surface per material, and the folder FILE beside it
  --particles FILE.vtp  the particles, with the cells they lie on
  --tets FILE.vtu       tetrahedra that fill the materials and conform to the triangles, with their Label; as .msh
                        (Gmsh) or .inp (Abaqus, CalculiX) with named sets of materials and interfaces
  --report FILE.json    the certificate, counts, quality, volumes, what was lost and why, times
  --error-map FILE.vtp  the triangles with each point's distance to the voxels' own interface (DistanceToVoxels)

Which labels:
  --labels 1,2,5        mesh these, all others are background (default: all)
  --background L        the background's label (default 0)
  --min-component N     connected parts of a label with fewer voxels go to the label around them (default 0: none)

Method:
  --method particle     particles on smooth indicator functions (default)
  --method grid         marching cubes, smoothing, decimation: the baseline to compare with

Particle method (radii in voxels, lengths in world units):
  --upsample N          where labels are thin or small, up to N samples per voxel along each axis (1 to 4), as few as
                        will do, within --memory-limit (default 1: none)
  --border closed       space around the volume is background: surfaces close there, rounded (default)
  --border flat         surfaces end exactly in the faces of the box of voxels, with its edges and corners
  --smoothing volume    all materials together, their volumes and thin parts stay (default)
  --smoothing tighten   the paper's: each material by itself, smoother; thin parts wear down
  --radius R            least radius of curvature after smoothing (default 0.7)
  --material LABEL:key=value,...  for one material: radius=R, opening=R, closing=R, max-length=L, name=TEXT,
                        color=#rrggbb; may be given several times
  --interface A,B:length=L  longest edge on the interface between two labels; may be given several times
  --epsilon E           edge length over feature size (default 0.65)
  --min-length L, --max-length L  bounds of the edge length
  --deviation D         voxels that edges may stay beside curved surfaces (default 0.2; 0: no bound)
  --gradation G         how fast edge lengths may change (default 0.4)
  --memory-limit GIB    refuse volumes that would take more memory, by estimate (default 0: no limit)

Tetrahedra (with --tets):
  --tet-method packed   spheres packed inside the materials become their inner points (default)
  --tet-method tetgen   TetGen inserts inner points
  --tet-refine N        rounds of inserting points where packed slivers are (default 0)
  --tet-improve N       passes over badly shaped tetrahedra at most (default 10; 0: none)
  --tet-slide on|off    whether vertices of the triangles move a little where slivers have no other cure (default on)
  --volume-gradation G  how fast edges grow inside (default 0.4)
  --volume-max-length L bound of the edge length inside (default: none)

Both methods:
  --triangles N         about how many triangles to make
  --threads N           threads to use (default: all)
  --quiet               no progress, no warnings, no certificate at the end
  --version, --help

Exit status: 0 when every file asked for was written, else 1 and one line that says why.
)";
}
