#pragma once

/// @file The number of elements that a metric asks for, and the price of each that an adaptation has in excess.

#include <algorithm>

#include "adapt/adapt_mesh.h"
#include "adapt/badness.h"
#include "base/task.h"

namespace tetrafront {

/// While a mesh has more elements than its metric asks for, each has a price, which is part of the badness: changes that lower
/// their number are preferred, while edges keep their lengths.
class ElementNumber {
 public:
  /// Both must outlive this.
  ElementNumber(const AdaptMesh& mesh, Badness& badness) : mesh_(mesh), badness_(badness) {}

  /// Computes the number that the metric asks for on the mesh as it is.
  Task<> measure(Work& work);
  /// Sets the price by the number that was measured last. `outOfBounds`: share of the edges out of bounds, 0 to 1.
  void setPrice(double outOfBounds);
  /// Sets the price to 0.
  void clearPrice() {
    price_ = 0.0;
    badness_.setPerElement(0.0);
  }

  /// Elements of the mesh / elements that the metric asked for when it was last measured.
  [[nodiscard]] double excess() const {
    return static_cast<double>(mesh_.elementCount()) / std::max(1.0, targetCount_);
  }
  [[nodiscard]] bool isExceeded() const { return excess() > 1.0; }

 private:
  const AdaptMesh& mesh_;
  Badness& badness_;
  double targetCount_ = 0.0;
  double price_ = 0.0;
};

}  // namespace tetrafront
