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
#include <vtkNrrdReader.h>
#include <vtkPointData.h>
#include <vtkXMLImageDataReader.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
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

void OrientNrrd(const std::string& file, vtkImageData* image)
{
  const std::string directions = HeaderValue(file, "space directions", ":");
  if (directions.empty())
  {
    return;
  }
  SetAxes(directions, "space directions", image);
  const std::vector<double> axes = NumbersIn(directions);
  double spacing[3];
  for (int a = 0; a < 3; ++a)
  {
    spacing[a] = std::hypot(axes[3 * a], axes[3 * a + 1], axes[3 * a + 2]);
  }
  image->SetSpacing(spacing);
  const std::vector<double> origin = NumbersIn(HeaderValue(file, "space origin", ":"));
  if (origin.size() == 3)
  {
    image->SetOrigin(origin.data());
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
  else if (suffix == ".nrrd")
  {
    reader = vtkSmartPointer<vtkNrrdReader>::New();
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

/// Bytes of one sample of a NRRD type; 0 for types that are not known here.
std::size_t NrrdSampleSize(const std::string& type)
{
  const std::size_t first = type.find_first_not_of(' ');
  const std::string name = first == std::string::npos ? "" : OneLine(type.substr(first));
  const std::pair<std::size_t, std::vector<const char*>> sizes[] = {
    { 1, { "char", "signed char", "int8", "int8_t", "uchar", "unsigned char", "uint8", "uint8_t" } },
    { 2,
      { "short", "short int", "signed short", "signed short int", "int16", "int16_t", "ushort", "unsigned short",
        "unsigned short int", "uint16", "uint16_t" } },
    { 4, { "int", "signed int", "int32", "int32_t", "uint", "unsigned int", "uint32", "uint32_t", "float" } },
    { 8,
      { "longlong", "long long", "long long int", "signed long long", "signed long long int", "int64", "int64_t",
        "ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t", "double" } }
  };
  for (const auto& size : sizes)
  {
    if (std::find(size.second.begin(), size.second.end(), name) != size.second.end())
    {
      return size.first;
    }
  }
  return 0;
}

/// Bytes behind the header of a NRRD file, which ends with an empty line.
std::uintmax_t NrrdDataSize(const std::string& file)
{
  std::ifstream stream(file, std::ios::binary);
  std::string line;
  while (std::getline(stream, line) && !line.empty() && line != "\r")
  {
  }
  const auto begin = stream.tellg();
  return begin < 0 ? 0 : fs::file_size(file) - static_cast<std::uintmax_t>(begin);
}

/// vtkNrrdReader does not notice raw data that end early, and never comes back from a gzip stream that does. The last
/// four bytes of such a stream hold the length of what was packed, which the header gives too.
void RequireWholeNrrd(const std::string& file)
{
  const std::string encoding = OneLine(HeaderValue(file, "encoding", ":"));
  const bool detached = !HeaderValue(file, "data file", ":").empty() || !HeaderValue(file, "datafile", ":").empty();
  std::size_t expected = NrrdSampleSize(HeaderValue(file, "type", ":"));
  for (const double size : NumbersIn(HeaderValue(file, "sizes", ":")))
  {
    expected *= static_cast<std::size_t>(std::max(size, 0.0));
  }
  if (detached || expected == 0)
  {
    return;
  }
  bool whole = encoding != "raw" || NrrdDataSize(file) >= expected;
  if (encoding == "gzip" || encoding == "gz")
  {
    std::array<unsigned char, 4> tail{};
    std::ifstream stream(file, std::ios::binary);
    stream.seekg(-4, std::ios::end);
    stream.read(reinterpret_cast<char*>(tail.data()), 4);
    const std::uint32_t packed = tail[0] | tail[1] << 8 | tail[2] << 16 | static_cast<std::uint32_t>(tail[3]) << 24;
    whole = stream && packed == static_cast<std::uint32_t>(expected);
  }
  if (!whole)
  {
    Fail("it is truncated: its data end too early");
  }
}

vtkSmartPointer<vtkImageData> Read(const std::string& file)
{
  const std::string suffix = SuffixOf(file);
  if (suffix == ".nrrd")
  {
    RequireWholeNrrd(file);
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
  else if (suffix == ".nrrd")
  {
    OrientNrrd(file, oriented);
  }
  else if (auto* nifti = vtkNIFTIImageReader::SafeDownCast(reader))
  {
    OrientNifti(nifti, oriented);
  }
  return oriented.Get();
}
}

vtkSmartPointer<vtkImageData> ReadVolume(const std::string& file)
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
    return Read(file);
  }
  catch (const std::exception& problem)
  {
    Fail("cannot read '" + file + "': " + problem.what());
  }
}
