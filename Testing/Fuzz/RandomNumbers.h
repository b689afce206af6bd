// SPDX-License-Identifier: BSD-3-Clause
// Random numbers that are the same with every standard library.
#ifndef RandomNumbers_h
#define RandomNumbers_h

#include <cstdint>

/// SplitMix64 (Steele, Lea and Flood 2014).
class RandomNumbers
{
public:
  explicit RandomNumbers(std::uint64_t seed)
    : State(seed)
  {
  }
  std::uint64_t Bits()
  {
    std::uint64_t z = this->State += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
  }
  /// From [first, last], both included.
  int Integer(int first, int last)
  {
    return first + static_cast<int>(this->Bits() % static_cast<std::uint64_t>(last - first + 1));
  }
  /// From [first, last).
  double Real(double first, double last)
  {
    return first + (last - first) * static_cast<double>(this->Bits() >> 11) * 0x1p-53;
  }
  bool Chance(double probability) { return this->Real(0, 1) < probability; }

private:
  std::uint64_t State;
};

#endif
