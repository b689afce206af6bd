// SPDX-License-Identifier: BSD-3-Clause
#include "ReadVolume.h"

#include "Messages.h"

#include <vtkAlgorithm.h>
#include <vtkCellData.h>
#include <vtkImageData.h>
#include <vtkImageReader2.h>
#include <vtkMatrix4x4.h>
#include <vtkMetaImageReader.h>
#include <vtkNIFTIImageReader.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkXMLImageDataReader.h>

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace
{
namespace fs = std::filesystem;

[[noreturn]] void Fail(const std::string& sentence)
{
  throw std::runtime_error(sentence);
}

/// Row by row; its columns are the axes of the image in the world.
using Matrix = std::array<double, 9>;
constexpr Matrix Identity = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };

bool IsOrthonormal(const Matrix& m)
{
  constexpr double tolerance = 1e-4;
  for (int a = 0; a < 3; ++a)
  {
    for (int b = 0; b < 3; ++b)
    {
      const double dot = m[a] * m[b] + m[3 + a] * m[3 + b] + m[6 + a] * m[6 + b];
      if (!(std::abs(dot - (a == b ? 1.0 : 0.0)) < tolerance))
      {
        return false;
      }
    }
  }
  return true;
}

/// Unit columns from axes that are listed one after the other.
Matrix FromAxes(const std::array<double, 9>& axes)
{
  Matrix matrix = Identity;
  for (int a = 0; a < 3; ++a)
  {
    const double length = std::hypot(axes[3 * a], axes[3 * a + 1], axes[3 * a + 2]);
    for (int c = 0; c < 3; ++c)
    {
      matrix[3 * c + a] = axes[3 * a + c] / length;
    }
  }
  return matrix;
}

/// The value of a "key separator value" line of a text header that ends where `last` says; empty when there is none.
std::string HeaderValue(const std::string& file, const std::string& key, const std::string& separator)
{
  std::ifstream stream(file, std::ios::binary);
  constexpr int mostLines = 1000; // a header has tens
  std::string line;
  for (int n = 0; n < mostLines && std::getline(stream, line) && line != "\r" && !line.empty(); ++n)
  {
    const std::size_t at = line.find(separator);
    std::string name = line.substr(0, at);
    name.erase(name.find_last_not_of(" \t") + 1);
    if (at != std::string::npos && name == key)
    {
      return line.substr(at + separator.size());
    }
    if (name == "ElementDataFile") // the last line of a MetaImage header
    {
      break;
    }
  }
  return "";
}

std::vector<double> NumbersIn(std::string text)
{
  std::replace_if(
    text.begin(), text.end(), [](char c) { return c == '(' || c == ')' || c == ','; }, ' ');
  std::istringstream stream(text);
  std::vector<double> numbers;
  for (double number; stream >> number;)
  {
    numbers.push_back(number);
  }
  return numbers;
}

void SetAxes(const std::string& text, const std::string& what, vtkImageData* image)
{
  const std::vector<double> numbers = NumbersIn(text);
  if (text.empty() || (numbers.size() == 4 && what == "TransformMatrix")) // 2-D: refused by the filters, in words
  {
    return;
  }
  std::array<double, 9> axes{};
  if (numbers.size() != 9)
  {
    Fail("its header has a " + what + " of " + std::to_string(numbers.size()) + " numbers, expected 9");
  }
  std::copy(numbers.begin(), numbers.end(), axes.begin());
  const Matrix matrix = FromAxes(axes);
  if (!IsOrthonormal(matrix))
  {
    Fail("the axes in its " + what + " are not at right angles; resample it to an orthogonal grid");
  }
  image->SetDirectionMatrix(matrix.data());
}

void OrientMetaImage(const std::string& file, vtkImageData* image)
{
  for (const char* key : { "TransformMatrix", "Rotation", "Orientation" }) // one meaning, three names
  {
    const std::string value = HeaderValue(file, key, "=");
    if (!value.empty())
    {
      SetAxes(value, "TransformMatrix", image);
      return;
    }
  }
}

/// World = M * (origin + spacing * index), M without scale.
void OrientNifti(vtkNIFTIImageReader* reader, vtkImageData* image)
{
  for (vtkMatrix4x4* form : { reader->GetSFormMatrix(), reader->GetQFormMatrix() })
  {
    if (!form)
    {
      continue;
    }
    Matrix matrix;
    for (int n = 0; n < 9; ++n)
    {
      matrix[n] = form->GetElement(n / 3, n % 3);
    }
    if (IsOrthonormal(matrix))
    {
      double origin[4] = { 0, 0, 0, 1 };
      image->GetOrigin(origin);
      form->MultiplyPoint(origin, origin);
      image->SetOrigin(origin);
      image->SetDirectionMatrix(matrix.data());
      return;
    }
  }
  if (reader->GetSFormMatrix() || reader->GetQFormMatrix())
  {
    Fail("its sform and qform are not rotations; resample it to an orthogonal grid");
  }
}

/// The file's suffix in lower case, .nii.gz as one.
std::string SuffixOf(const std::string& file)
{
  fs::path path(file);
  std::string suffix = path.extension().string();
  if (suffix == ".gz")
  {
    suffix = path.stem().extension().string() + suffix;
  }
  std::transform(suffix.begin(), suffix.end(), suffix.begin(), [](unsigned char c) { return std::tolower(c); });
  return suffix;
}

/// MetaIO reports on std::cerr only: its words are kept here instead, and count as errors.
class StreamCapture
{
public:
  StreamCapture()
    : Cerr(std::cerr.rdbuf(this->Words.rdbuf()))
    , Cout(std::cout.rdbuf(this->Words.rdbuf()))
  {
  }
  ~StreamCapture()
  {
    std::cerr.rdbuf(this->Cerr);
    std::cout.rdbuf(this->Cout);
  }
  StreamCapture(const StreamCapture&) = delete;
  StreamCapture& operator=(const StreamCapture&) = delete;
  std::string Text() const { return this->Words.str(); }

private:
  std::ostringstream Words;
  std::streambuf* Cerr;
  std::streambuf* Cout;
};

vtkSmartPointer<vtkAlgorithm> ReaderOf(const std::string& file, const std::string& suffix)
{
  if (suffix == ".vti")
  {
    vtkNew<vtkXMLImageDataReader> reader;
    reader->SetFileName(file.c_str());
    return reader.Get();
  }
  vtkSmartPointer<vtkImageReader2> reader;
  if (suffix == ".mha" || suffix == ".mhd")
  {
    reader = vtkSmartPointer<vtkMetaImageReader>::New();
  }
  else if (suffix == ".nii" || suffix == ".nii.gz")
  {
    reader = vtkSmartPointer<vtkNIFTIImageReader>::New();
  }
  else
  {
    Fail("its suffix is none of .mha .mhd .nrrd .nii .nii.gz .vti");
  }
  if (!reader->CanReadFile(file.c_str()))
  {
    Fail("it is not a " + suffix + " file, or a broken one");
  }
  reader->SetFileName(file.c_str());
  return reader;
}

/// Number of points of an extent that is written as six numbers; -1 when it is none.
double PointsIn(const std::string& text, const std::string& key, std::size_t from = 0)
{
  const std::size_t at = text.find(key + "=\"", from);
  if (at == std::string::npos)
  {
    return -1;
  }
  const std::size_t begin = at + key.size() + 2;
  const std::vector<double> numbers =
    NumbersIn(text.substr(begin, std::min<std::size_t>(text.find('"', begin) - begin, 200)));
  double points = numbers.size() == 6 ? 1 : -1;
  for (std::size_t a = 0; a < 3 && numbers.size() == 6; ++a)
  {
    points *= std::max(numbers[2 * a + 1] - numbers[2 * a] + 1, 0.0);
  }
  return points;
}

/// vtkXMLImageDataReader ends the program when there is not the memory that a broken extent asks for.
void RequireSaneVti(const std::string& file)
{
  std::ifstream stream(file, std::ios::binary);
  std::string text(std::min<std::uintmax_t>(fs::file_size(file), 1 << 20), '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  constexpr double densest = 1e4; // points per byte: more than any compressor of VTK packs
  const double whole = PointsIn(text, "WholeExtent");
  double pieces = 0;
  for (std::size_t at = 0; (at = text.find("<Piece", at)) != std::string::npos; ++at)
  {
    pieces += std::max(PointsIn(text, " Extent", at), 0.0);
  }
  // Pieces share the points of their faces, at most all eight the same one.
  if (whole > densest * static_cast<double>(fs::file_size(file)) || pieces > 8 * whole)
  {
    Fail("it is broken or truncated: its extents ask for more points than it can hold");
  }
}

constexpr double DensestPacking = 1100; // voxels per byte: deflate packs 1032 to 1 at best

/// MetaIO loops over as many axes as the header says, and VTK ends the program when there is not the memory for them.
void RequireSaneMetaImage(const std::string& file)
{
  const std::vector<double> dimensions = NumbersIn(HeaderValue(file, "NDims", "="));
  if (dimensions.size() != 1 || (dimensions[0] != 2 && dimensions[0] != 3))
  {
    Fail("it is not a MetaImage of three dimensions, or its header is broken");
  }
  double samples = 1;
  for (const double size : NumbersIn(HeaderValue(file, "DimSize", "=")))
  {
    samples *= size;
  }
  const std::string data = OneLine(HeaderValue(file, "ElementDataFile", "="));
  std::error_code missing;
  const std::uintmax_t bytes =
    fs::file_size(data == "LOCAL" ? fs::path(file) : fs::path(file).parent_path() / data, missing);
  if (!missing && !(samples <= DensestPacking * static_cast<double>(bytes)))
  {
    Fail("it is truncated: its data end too early");
  }
}

/// vtkNIFTIImageReader crashes at types that it does not know.
void RequireSaneNifti(const std::string& file)
{
  std::array<unsigned char, 80> header{};
  gzFile stream = gzopen(file.c_str(), "rb"); // packed or not
  const int read = stream ? gzread(stream, header.data(), static_cast<unsigned>(header.size())) : 0;
  if (stream)
  {
    gzclose(stream);
  }
  const auto number = [&](int at, int bytes, bool swapped)
  {
    std::int64_t value = 0;
    for (int n = 0; n < bytes; ++n)
    {
      value |= static_cast<std::int64_t>(header[at + (swapped ? bytes - 1 - n : n)]) << 8 * n;
    }
    return value;
  };
  const bool swapped = number(0, 4, false) != 348 && number(0, 4, false) != 540;
  const std::int64_t kind = number(0, 4, swapped);
  if (read != static_cast<int>(header.size()) || (kind != 348 && kind != 540))
  {
    Fail("it is not a NIfTI file, or a broken one");
  }
  const bool second = kind == 540; // NIfTI-2
  const std::int64_t type = number(second ? 12 : 70, 2, swapped);
  const std::set<std::int64_t> types = { 2, 4, 8, 16, 64, 256, 512, 768, 1024, 1280 };
  if (types.count(type) == 0)
  {
    Fail("its voxels have the NIfTI type " + std::to_string(type) + ", expected integers, float or double");
  }
  double samples = 1;
  for (int a = 1; a <= 3; ++a)
  {
    samples *= static_cast<double>(second ? number(16 + 8 * a, 8, swapped) : number(40 + 2 * a, 2, swapped));
  }
  if (!(samples <= DensestPacking * static_cast<double>(fs::file_size(file))))
  {
    Fail("it is truncated: its data end too early");
  }
}

vtkSmartPointer<vtkImageData> Read(const std::string& file, std::map<long long, LabelStyle>& styles)
{
  const std::string suffix = SuffixOf(file);
  if (suffix == ".nrrd")
  {
    return ReadNrrd(file, styles);
  }
  if (suffix == ".vti")
  {
    RequireSaneVti(file);
  }
  else if (suffix == ".mha" || suffix == ".mhd")
  {
    RequireSaneMetaImage(file);
  }
  else if (suffix == ".nii" || suffix == ".nii.gz")
  {
    RequireSaneNifti(file);
  }
  const StreamCapture capture;
  const vtkSmartPointer<vtkAlgorithm> reader = ReaderOf(file, suffix);
  Messages messages(reader);
  reader->Update();
  const std::string error = messages.FirstError();
  if (!error.empty() || reader->GetErrorCode() != 0 || !capture.Text().empty())
  {
    const std::string words = error.empty() ? OneLine(capture.Text()) : error;
    Fail("it is broken or truncated" + (words.empty() ? "" : " (" + words + ")"));
  }
  vtkImageData* image = vtkImageData::SafeDownCast(reader->GetOutputDataObject(0));
  if (!image || image->GetNumberOfPoints() == 0)
  {
    Fail("it holds no voxels");
  }
  vtkNew<vtkImageData> oriented;
  oriented->ShallowCopy(image);
  if (suffix == ".mha" || suffix == ".mhd")
  {
    OrientMetaImage(file, oriented);
  }
  else if (auto* nifti = vtkNIFTIImageReader::SafeDownCast(reader))
  {
    OrientNifti(nifti, oriented);
  }
  return oriented.Get();
}
}

vtkSmartPointer<vtkImageData> ReadVolume(const std::string& file, std::map<long long, LabelStyle>& styles)
{
  std::error_code ignored;
  if (!fs::exists(file, ignored))
  {
    Fail("there is no file '" + file + "'");
  }
  if (fs::is_directory(file, ignored) || !std::ifstream(file))
  {
    Fail("'" + file + "' cannot be opened for reading");
  }
  try
  {
    return Read(file, styles);
  }
  catch (const std::exception& problem)
  {
    Fail("cannot read '" + file + "': " + problem.what());
  }
}
