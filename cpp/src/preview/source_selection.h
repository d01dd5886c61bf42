#pragma once

/// @file Selects the sources that are needed from many proposed ones.

#include <utility>
#include <vector>

#include "field/size_sources.h"
#include "tetrafront/background_grid.h"

namespace tetrafront {

/// Keeps a source unless those kept before already ask for about its size, so that a curve gets about one source per
/// element and not one per sample.
class SourceSelection {
 public:
  /// Sources must be added in ascending order of size.
  void add(const SizeSource& source);

  [[nodiscard]] std::vector<SizeSource> take() { return std::move(kept_); }

 private:
  [[nodiscard]] bool isRedundant(const SizeSource& source) const;
  [[nodiscard]] bool isServed(const Vec3& position, double enough) const;

  std::vector<SizeSource> kept_;
  SizeSources indexed_;  ///< the first `indexedCount_` of kept_, in a tree
  std::size_t indexedCount_ = 0;
};

}  // namespace tetrafront
