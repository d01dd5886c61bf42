#pragma once

/// @file Elements that are not kept as arrays, but made when they are asked for.

#include <array>
#include <cstdint>
#include <span>

#include "base/ids.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

class ElementSource {
 public:
  struct Element {
    NodeQuad nodes;  ///< in the orientation of VolumeMesh::tetrahedra
    std::array<Vec3, 4> corners;
  };

  ElementSource() = default;
  ElementSource(const ElementSource&) = delete;
  ElementSource& operator=(const ElementSource&) = delete;
  virtual ~ElementSource() = default;

  /// Number of nodes that elements of this source alone have. In elements, they come after `sharedCount()` others.
  [[nodiscard]] virtual std::uint32_t nodeCount() const = 0;
  /// Number of nodes that other elements have too; their positions are kept elsewhere.
  [[nodiscard]] virtual std::uint32_t sharedCount() const = 0;
  [[nodiscard]] virtual std::uint32_t elementCount() const = 0;
  /// Returns the position of a node that is not shared, counted from 0.
  [[nodiscard]] virtual Vec3 positionOf(std::uint32_t node) const = 0;
  /// Copies the elements from `first` on. Those of a block cost far less than as many single ones.
  virtual void copyElements(std::uint32_t first, std::span<Element> to) const = 0;
};

}  // namespace tetrafront
