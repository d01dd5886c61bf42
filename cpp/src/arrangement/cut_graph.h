#pragma once

/// @file Segments in one plane, divided where they intersect. What remains has only ends in common.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "arrangement/cut_points.h"

namespace tetrafront {

/// A segment in the plane of a triangle; a point if both ends are the same.
struct CutSegment {
  CutPointId from;
  CutPointId to;
  CutPlane plane;  ///< another plane that contains the segment; unused for a point
};

class CutGraph {
 public:
  using Edge = std::pair<CutPointId, CutPointId>;  ///< the lower point first

  /// `plane`: that of all segments, as it is seen in `view`. Adds the points where segments cross to `points`.
  CutGraph(CutPoints& points, const CutPlane& plane, const CutView& view)
      : points_(points), plane_(plane), view_(view) {}

  void add(const CutSegment& segment);

  /// Divides the segments; ends early if there are too many points (CutPoints::isFull()). O(n^2) for n segments, O(n log n) if few of them overlap along an axis.
  void divide();

  /// Returns all ends and divided points, ascending.
  [[nodiscard]] std::span<const CutPointId> vertices() const { return vertices_; }
  /// Returns the parts of the segments, each once, ascending.
  [[nodiscard]] std::span<const Edge> edges() const { return edges_; }

 private:
  struct Entry {
    CutSegment segment;
    Vec2 low;
    Vec2 high;
    std::vector<CutPointId> inside;  ///< points that divide the segment
  };

  [[nodiscard]] bool isOnSegment(const CutSegment& segment, CutPointId point) const;
  void intersect(Entry& s, Entry& t);
  /// Returns the orientation of an end of `t` with `s`; divides `s` there if the end is on it.
  int touch(Entry& s, CutPointId end);
  void emit(Entry& entry);

  CutPoints& points_;
  CutPlane plane_;
  CutView view_;
  std::vector<Entry> entries_;
  std::vector<CutPointId> vertices_;
  std::vector<Edge> edges_;
};

}  // namespace tetrafront
