#pragma once

/// @file Frees the memory of an array that is no longer needed, while its owner lives on.

#include <vector>

namespace tetrafront {

/// Empties the array and frees its memory; an assignment of {} would keep it.
template <class Value>
void freeMemory(std::vector<Value>& values) {
  std::vector<Value>().swap(values);
}

}  // namespace tetrafront
