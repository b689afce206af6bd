// SPDX-License-Identifier: BSD-3-Clause
#include "ReadNrrd.h"

#include <vtkDataArray.h>
#include <vtkPointData.h>

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace
{
namespace fs = std::filesystem;
using Fields = std::map<std::string, std::string>;

[[noreturn]] void Fail(const std::string& sentence)
{
  throw std::runtime_error(sentence);
}

std::string Trimmed(const std::string& text)
{
  const char* blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

std::string Lower(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// What is no field and no value of a field is not shown to the user as it stands: it may be anything.
std::string Quoted(const std::string& text)
{
  std::string shown = "'";
  for (const char c : text.substr(0, 40))
  {
    shown += c >= ' ' && c <= '~' ? c : '?';
  }
  return shown + (text.size() > 40 ? "...'" : "'");
}

struct Header
{
  Fields Standard; ///< "field: value", the field in lower case
  Fields Keys;     ///< "key:=value"
};

/// Reads up to and with the empty line that ends the header, or to the end of a header in a file of its own.
Header ReadHeader(std::istream& stream)
{
  constexpr std::size_t longest = 1 << 20; // lines of megabytes mean that this is no header
  Header header;
  std::string line;
  std::getline(stream, line);
  if (line.compare(0, 7, "NRRD000") != 0)
  {
    Fail("it is not a .nrrd file, or a broken one");
  }
  while (std::getline(stream, line))
  {
    line = Trimmed(line);
    if (line.empty())
    {
      return header;
    }
    const std::size_t colon = line.find(':');
    if (line[0] == '#')
    {
      continue;
    }
    if (colon == std::string::npos || line.size() > longest)
    {
      Fail("its header is broken at " + Quoted(line));
    }
    const bool key = line.compare(colon, 2, ":=") == 0;
    const std::string name = line.substr(0, colon);
    (key ? header.Keys[name] : header.Standard[Lower(name)]) = Trimmed(line.substr(colon + (key ? 2 : 1)));
  }
  return header;
}

std::string FieldOf(const Fields& fields, const std::string& name, const std::string& other = "")
{
  const auto found = fields.find(fields.count(name) ? name : other);
  return found != fields.end() ? found->second : "";
}

/// All the numbers of a field; brackets and commas only part them.
std::vector<double> Numbers(const Fields& fields, const std::string& name)
{
  std::string text = FieldOf(fields, name);
  std::replace_if(
    text.begin(), text.end(), [](char c) { return c == '(' || c == ')' || c == ','; }, ' ');
  std::istringstream stream(text);
  std::vector<double> numbers;
  for (std::string word; stream >> word;)
  {
    char* end = nullptr;
    const double number = std::strtod(word.c_str(), &end);
    if (*end != '\0' || !std::isfinite(number))
    {
      Fail("its header has " + Quoted(FieldOf(fields, name)) + " as " + name + ", expected numbers");
    }
    numbers.push_back(number);
  }
  return numbers;
}

/// The numbers of a field that has to have `count` of them; empty when it is not there.
std::vector<double> NumbersOf(const Fields& fields, const std::string& name, std::size_t count)
{
  const std::vector<double> numbers = Numbers(fields, name);
  if (fields.count(name) && numbers.size() != count)
  {
    Fail("its header has " + name + " of " + std::to_string(numbers.size()) + " numbers, expected " +
      std::to_string(count));
  }
  return numbers;
}

int TypeOf(const std::string& name)
{
  const std::pair<int, std::vector<const char*>> types[] = {
    { VTK_SIGNED_CHAR, { "signed char", "int8", "int8_t", "char" } },
    { VTK_UNSIGNED_CHAR, { "uchar", "unsigned char", "uint8", "uint8_t" } },
    { VTK_SHORT, { "short", "short int", "signed short", "signed short int", "int16", "int16_t" } },
    { VTK_UNSIGNED_SHORT, { "ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t" } },
    { VTK_INT, { "int", "signed int", "int32", "int32_t" } },
    { VTK_UNSIGNED_INT, { "uint", "unsigned int", "uint32", "uint32_t" } },
    { VTK_LONG_LONG,
      { "longlong", "long long", "long long int", "signed long long", "signed long long int", "int64", "int64_t" } },
    { VTK_UNSIGNED_LONG_LONG, { "ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t" } },
    { VTK_FLOAT, { "float" } },
    { VTK_DOUBLE, { "double" } },
  };
  for (const auto& type : types)
  {
    if (std::find(type.second.begin(), type.second.end(), name) != type.second.end())
    {
      return type.first;
    }
  }
  Fail("its header has the type " + Quoted(name) + ", expected an integer type, float or double");
}

std::array<int, 3> SizesOf(const Fields& fields)
{
  const std::vector<double> dimension = NumbersOf(fields, "dimension", 1);
  if (dimension.empty() || dimension[0] != 3)
  {
    Fail(FieldOf(fields, "dimension") == "4"
        ? "it has four axes, expected three: segments that overlap are no label volume; make one (in 3D Slicer: Export "
          "to labelmap)"
        : "its header has the dimension " + Quoted(FieldOf(fields, "dimension")) + ", expected 3");
  }
  const std::vector<double> sizes = NumbersOf(fields, "sizes", 3);
  std::array<int, 3> dims{};
  for (std::size_t a = 0; a < 3; ++a)
  {
    if (sizes.empty() || !(sizes[a] >= 1 && sizes[a] < std::numeric_limits<int>::max()) ||
      sizes[a] != std::floor(sizes[a]))
    {
      Fail("its header has the sizes " + Quoted(FieldOf(fields, "sizes")) + ", expected three whole numbers");
    }
    dims[a] = static_cast<int>(sizes[a]);
  }
  return dims;
}

/// Reads all that is left of a gzip stream, which has to be `size` bytes.
void Inflate(std::istream& stream, unsigned char* data, std::uint64_t size)
{
  z_stream inflater{};
  inflateInit2(&inflater, 15 + 32); // gzip or zlib, as the stream says
  std::vector<char> packed(1 << 16);
  std::uint64_t done = 0;
  int state = Z_OK;
  while (state == Z_OK && done < size)
  {
    if (inflater.avail_in == 0)
    {
      stream.read(packed.data(), static_cast<std::streamsize>(packed.size()));
      inflater.next_in = reinterpret_cast<unsigned char*>(packed.data());
      inflater.avail_in = static_cast<unsigned>(stream.gcount());
      if (stream.gcount() == 0)
      {
        break;
      }
    }
    const unsigned room = static_cast<unsigned>(std::min<std::uint64_t>(size - done, 1 << 30));
    inflater.next_out = data + done;
    inflater.avail_out = room;
    state = inflate(&inflater, Z_NO_FLUSH);
    done += room - inflater.avail_out;
  }
  inflateEnd(&inflater);
  if (done < size || (state != Z_OK && state != Z_STREAM_END))
  {
    Fail(state == Z_OK || state == Z_STREAM_END ? "it is truncated: its data end too early"
                                                : "its packed data are broken");
  }
}

void ReadText(std::istream& stream, vtkDataArray* array)
{
  for (vtkIdType n = 0; n < array->GetNumberOfTuples(); ++n)
  {
    double value = 0;
    if (!(stream >> value))
    {
      Fail("it is truncated: its data end too early, or are no numbers");
    }
    array->SetComponent(n, 0, value);
  }
}

std::uint64_t BytesLeft(std::istream& stream)
{
  const auto here = stream.tellg();
  stream.seekg(0, std::ios::end);
  const auto end = stream.tellg();
  stream.seekg(here);
  return here < 0 || end < here ? 0 : static_cast<std::uint64_t>(end - here);
}

bool IsBigEndian()
{
  const std::uint16_t one = 1;
  unsigned char first = 0;
  std::memcpy(&first, &one, 1);
  return first == 0;
}

void SwapBytes(unsigned char* data, std::uint64_t size, int width)
{
  for (std::uint64_t at = 0; at + width <= size; at += width)
  {
    std::reverse(data + at, data + at + width);
  }
}

/// Bytes from a stream at the first byte of the data. Their number is checked before memory is asked for: a broken
/// header may want any amount.
void ReadData(std::istream& stream, const Fields& fields, std::uint64_t samples, vtkDataArray* array)
{
  const std::string encoding = Lower(FieldOf(fields, "encoding"));
  const bool raw = encoding == "raw";
  const bool packed = encoding == "gzip" || encoding == "gz";
  const bool text = encoding == "text" || encoding == "txt" || encoding == "ascii";
  if (!raw && !packed && !text)
  {
    Fail("its encoding is " + Quoted(encoding) + ", expected raw, gzip or text");
  }
  const int width = array->GetDataTypeSize();
  constexpr std::uint64_t densest = 1100; // deflate packs 1032 to 1 at best
  const std::uint64_t left = BytesLeft(stream);
  if (samples > (raw ? left / width : packed ? left * densest / width : left))
  {
    Fail("it is truncated: its data end too early");
  }
  array->SetNumberOfTuples(static_cast<vtkIdType>(samples));
  if (text)
  {
    ReadText(stream, array);
    return;
  }
  auto* const data = static_cast<unsigned char*>(array->GetVoidPointer(0));
  const std::uint64_t size = samples * width;
  if (packed)
  {
    Inflate(stream, data, size);
  }
  else if (!stream.read(reinterpret_cast<char*>(data), static_cast<std::streamsize>(size)))
  {
    Fail("it is truncated: its data end too early");
  }
  const std::string endian = Lower(FieldOf(fields, "endian"));
  if (width > 1 && endian != "little" && endian != "big")
  {
    Fail("its header does not say whether it is of little or big endian");
  }
  if (width > 1 && (endian == "big") != IsBigEndian())
  {
    SwapBytes(data, size, width);
  }
}

/// Opens the file with the data when they are not in the header's own.
std::ifstream OpenData(const std::string& file, const std::string& name)
{
  if (name.compare(0, 4, "LIST") == 0 || name.find('%') != std::string::npos)
  {
    Fail("its data are in many files; put them into one");
  }
  const fs::path path = fs::path(name).is_absolute() ? fs::path(name) : fs::path(file).parent_path() / name;
  std::error_code ignored;
  std::ifstream stream(path, std::ios::binary);
  if (!stream || fs::is_directory(path, ignored))
  {
    Fail("its data file " + Quoted(name) + " cannot be opened");
  }
  return stream;
}

void SetFrame(const Fields& fields, vtkImageData* image)
{
  double spacing[3] = { 1, 1, 1 };
  const std::vector<double> spacings = NumbersOf(fields, "spacings", 3);
  const std::vector<double> axes = NumbersOf(fields, "space directions", 9);
  double matrix[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  for (std::size_t a = 0; a < 3; ++a)
  {
    spacing[a] = spacings.empty() ? 1.0 : spacings[a];
    if (!axes.empty())
    {
      spacing[a] =
        std::sqrt(axes[3 * a] * axes[3 * a] + axes[3 * a + 1] * axes[3 * a + 1] + axes[3 * a + 2] * axes[3 * a + 2]);
      for (std::size_t c = 0; c < 3; ++c)
      {
        matrix[3 * c + a] = axes[3 * a + c] / spacing[a];
      }
    }
    if (!(spacing[a] > 0) || !std::isfinite(spacing[a]))
    {
      Fail("its header has the spacing " + std::to_string(spacing[a]) + ", expected a positive length");
    }
  }
  for (int n = 0; n < 9; ++n)
  {
    const int a = n / 3, b = n % 3;
    const double dot = matrix[a] * matrix[b] + matrix[3 + a] * matrix[3 + b] + matrix[6 + a] * matrix[6 + b];
    if (!(std::abs(dot - (a == b)) < 1e-4))
    {
      Fail("the axes in its space directions are not at right angles; resample it to an orthogonal grid");
    }
  }
  image->SetSpacing(spacing);
  image->SetDirectionMatrix(matrix);
  const std::vector<double> origin = NumbersOf(fields, "space origin", 3);
  if (!origin.empty())
  {
    image->SetOrigin(origin.data());
  }
}

/// Segments are numbered from 0 without gaps.
std::map<long long, LabelStyle> StylesIn(const Fields& keys)
{
  std::map<long long, LabelStyle> styles;
  for (int segment = 0;; ++segment)
  {
    const std::string prefix = "Segment" + std::to_string(segment) + "_";
    const std::string value = FieldOf(keys, prefix + "LabelValue");
    char* end = nullptr;
    const long long label = std::strtoll(value.c_str(), &end, 10);
    if (value.empty() || *end != '\0')
    {
      return styles;
    }
    LabelStyle& style = styles[label];
    style.Name = FieldOf(keys, prefix + "Name");
    std::istringstream stream(FieldOf(keys, prefix + "Color"));
    std::array<double, 3> color{};
    if (stream >> color[0] >> color[1] >> color[2])
    {
      std::transform(color.begin(), color.end(), color.begin(), [](double c) { return std::clamp(c, 0.0, 1.0); });
      style.Color = color;
    }
  }
}
}

vtkSmartPointer<vtkImageData> ReadNrrd(const std::string& file, std::map<long long, LabelStyle>& styles)
{
  std::ifstream stream(file, std::ios::binary);
  const Header header = ReadHeader(stream);
  const Fields& fields = header.Standard;
  for (const char* skip : { "byte skip", "byteskip", "line skip", "lineskip" })
  {
    const std::string value = FieldOf(fields, skip);
    if (!value.empty() && value != "0")
    {
      Fail("its header has a " + std::string(skip) + ", which labelmesh does not know; write the file anew");
    }
  }
  const std::array<int, 3> dims = SizesOf(fields);
  const auto array =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(TypeOf(Lower(FieldOf(fields, "type")))));
  array->SetName("Labels");
  auto image = vtkSmartPointer<vtkImageData>::New();
  SetFrame(fields, image);
  // Below 2^93 as three sizes of 31 bits; more than 2^62 samples are more than any file has.
  const double samples = double(dims[0]) * dims[1] * dims[2];
  if (samples > 0x1p62)
  {
    Fail("it is truncated: its data end too early");
  }
  const std::uint64_t count = std::uint64_t(dims[0]) * dims[1] * dims[2];
  const std::string detached = FieldOf(fields, "data file", "datafile");
  if (detached.empty())
  {
    ReadData(stream, fields, count, array);
  }
  else
  {
    std::ifstream data = OpenData(file, detached);
    ReadData(data, fields, count, array);
  }
  image->SetDimensions(dims.data());
  image->GetPointData()->SetScalars(array);
  styles = StylesIn(header.Keys);
  return image;
}
