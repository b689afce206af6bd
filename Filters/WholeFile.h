// SPDX-License-Identifier: BSD-3-Clause
// A file that is written whole or not at all, with numbers in text as fast as they can be.
#ifndef WholeFile_h
#define WholeFile_h

#include "Core/Types.h"

#include <cstdio>
#include <string>
#include <string_view>
#include <system_error>

namespace LabelMesh
{
/// A file that cannot be written; code() is the system's reason.
class CannotWrite : public std::system_error
{
public:
  CannotWrite(int reason, const std::string& sentence)
    : std::system_error(reason, std::generic_category(), sentence)
  {
  }
};

/// Written in a hidden folder beside its place, and moved there by Commit; without it nothing has changed. All
/// functions throw CannotWrite.
class WholeFile
{
public:
  explicit WholeFile(const std::string& path);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  WholeFile& operator<<(std::string_view text);
  WholeFile& operator<<(char letter);
  WholeFile& operator<<(Index number);
  /// The shortest text that reads back as the same number.
  WholeFile& operator<<(double number);
  /// The nearest number that takes no more than `width` characters (at least 12).
  WholeFile& Narrow(double number, int width);
  /// The number's bytes.
  template <typename T>
  WholeFile& Binary(const T& number)
  {
    return *this << std::string_view(reinterpret_cast<const char*>(&number), sizeof(T));
  }

  void Commit();

private:
  void Flush();
  [[noreturn]] void Fail(int reason) const;

  std::string Path;
  std::string Folder;
  std::string Staged;
  std::FILE* Stream = nullptr;
  std::string Buffer;
};
}

#endif
