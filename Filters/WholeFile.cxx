// SPDX-License-Identifier: BSD-3-Clause
#include "WholeFile.h"

#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <filesystem>

namespace LabelMesh
{
namespace
{
namespace fs = std::filesystem;

constexpr std::size_t BufferSize = 1 << 20;
/// More than any number takes: a double's shortest text has 24 characters at most.
constexpr std::size_t NumberSize = 64;
}

WholeFile::WholeFile(const std::string& path)
  : Path(path)
{
  const fs::path parent = fs::path(path).parent_path();
  std::string hidden = ((parent.empty() ? fs::path(".") : parent) / ".labelmesh-XXXXXX").string();
  if (!mkdtemp(hidden.data()))
  {
    this->Fail(errno);
  }
  this->Folder = hidden;
  this->Staged = (fs::path(hidden) / "file").string();
  this->Stream = std::fopen(this->Staged.c_str(), "wb");
  if (!this->Stream)
  {
    const int reason = errno;
    std::error_code ignored;
    fs::remove_all(this->Folder, ignored);
    this->Fail(reason);
  }
  this->Buffer.reserve(BufferSize + NumberSize);
}

WholeFile::~WholeFile()
{
  if (this->Stream)
  {
    std::fclose(this->Stream);
  }
  std::error_code ignored;
  fs::remove_all(this->Folder, ignored);
}

WholeFile& WholeFile::operator<<(std::string_view text)
{
  this->Buffer.append(text);
  if (this->Buffer.size() >= BufferSize)
  {
    this->Flush();
  }
  return *this;
}

WholeFile& WholeFile::operator<<(char letter)
{
  return *this << std::string_view(&letter, 1);
}

WholeFile& WholeFile::operator<<(Index number)
{
  char text[NumberSize];
  const auto end = std::to_chars(text, text + NumberSize, number).ptr;
  return *this << std::string_view(text, std::size_t(end - text));
}

WholeFile& WholeFile::operator<<(double number)
{
  char text[NumberSize];
  const auto end = std::to_chars(text, text + NumberSize, number).ptr;
  return *this << std::string_view(text, std::size_t(end - text));
}

WholeFile& WholeFile::Narrow(double number, int width)
{
  char text[NumberSize];
  auto end = std::to_chars(text, text + NumberSize, number).ptr;
  for (int digits = 16; end - text > width; --digits)
  {
    end = std::to_chars(text, text + NumberSize, number, std::chars_format::general, digits).ptr;
  }
  return *this << std::string_view(text, std::size_t(end - text));
}

void WholeFile::Commit()
{
  this->Flush();
  std::FILE* stream = this->Stream;
  this->Stream = nullptr;
  if (std::fclose(stream) != 0)
  {
    this->Fail(errno);
  }
  std::error_code error;
  fs::rename(this->Staged, this->Path, error);
  if (error)
  {
    this->Fail(error.value());
  }
}

void WholeFile::Flush()
{
  if (std::fwrite(this->Buffer.data(), 1, this->Buffer.size(), this->Stream) != this->Buffer.size())
  {
    this->Fail(errno);
  }
  this->Buffer.clear();
}

void WholeFile::Fail(int reason) const
{
  throw CannotWrite(reason, "Cannot write '" + this->Path + "'");
}
}
