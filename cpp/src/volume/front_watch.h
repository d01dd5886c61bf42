#pragma once

/// @file Ends a front before it is empty: one that needs too many elements, leaves the background grid, or advances for ever. It
/// looks after every step.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "field/size_field.h"
#include "tetrafront/status.h"
#include "volume/elements.h"
#include "volume/front.h"

namespace tetrafront {

class FrontWatch {
 public:
  enum class End : std::uint8_t {
    kNone,
    kTooManyElements,
    kOutsideGrid,
    kStuck,  ///< its bookkeeping is broken, or its boundary is not closed
  };

  /// `triangles`: of the boundary.
  FrontWatch(const SizeField& field, std::size_t triangles, std::uint32_t maxTetrahedra)
      : field_(&field), triangles_(triangles), maxTetrahedra_(maxTetrahedra) {}

  /// Begins when the front has its boundary. `enclosedVolume`: six times that of the boundary.
  void begin(const Front& front, double enclosedVolume);

  [[nodiscard]] bool isRunning() const { return end_ == End::kNone; }
  [[nodiscard]] End end() const { return end_; }

  /// Whether faces may come again under relaxed rules, whose steps have cost so much.
  [[nodiscard]] bool allowsRelaxation(const Elements& elements, std::uint64_t relaxedCost) const;
  /// Call it after a step of this cost. Clears the queue of a front that costs too much: recovery closes it at less cost.
  void look(Front& front, const Elements& elements, std::uint32_t cost);
  /// Checks the nodes that recovery has added.
  void lookAtNodes(const Front& front);

  /// Share of the enclosed volume that is filled, 0 to 1.
  [[nodiscard]] double filledFraction() const;
  /// Estimated progress of the front until it closes or stalls, 0 to 1. Among needles, little volume is filled when the front
  /// reaches its cost limit, so the cost counts too.
  [[nodiscard]] double fraction(const Elements& elements) const;
  /// Names the end, unless the front is stuck.
  [[nodiscard]] std::vector<Diagnostic> diagnostics(const Front& front,
                                                    const Elements& elements) const;

 private:
  void measureNew(const Front& front, const Elements& elements);
  [[nodiscard]] bool isStuck(const Front& front) const;

  const SizeField* field_;
  std::size_t triangles_;
  std::uint32_t maxTetrahedra_;
  End end_ = End::kNone;
  std::uint64_t cost_ = 0;
  std::size_t stepsWithoutElement_ = 0;
  std::size_t checkedNodes_ = 0;
  std::size_t measuredElements_ = 0;
  double enclosedVolume_ = 0.0;  ///< times six
  double filledVolume_ = 0.0;    ///< times six
};

}  // namespace tetrafront
