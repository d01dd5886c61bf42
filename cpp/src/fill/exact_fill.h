#pragma once

/// @file The guaranteed fill: tetrahedra for any closed, embedded, consistently turned set of
/// triangles, with new points inside only. All signs are exact, so nothing can go wrong but the last
/// step, where points inside must be brought to positions that doubles can hold; where that fails, what is
/// around these points is left open, and all else is filled.
///
/// The nodes are put into a nearly Delaunay mesh; edges, then triangles are recovered, by swaps and,
/// where these do not do it, points on the boundary; what is outside is dropped; and the points on the
/// boundary are replaced by points inside, of which most then turn out not to be needed.

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "base/ids.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// What is to be filled. Nodes are positions in `positions`; triangles are counter-clockwise seen from
/// where it is empty, and may bound several positions, with islands in them.
struct FillTask {
  std::vector<Vec3> positions;
  std::vector<NodeTriple> triangles;
};

struct FillResult {
  std::vector<Vec3> newPositions;  ///< of the nodes that follow those of the task
  std::vector<NodeQuad> tetrahedra;
  std::vector<std::uint32_t> triangleOfTetrahedron;  ///< some triangle of the position each is in
  /// Where State::kPartial: triangles of the task that no tetrahedron has, and the faces that together
  /// with them bound what is open, counter-clockwise seen from there, each with a triangle of its position.
  std::vector<std::uint32_t> openTriangles;
  std::vector<NodeTriple> openFaces;
  std::vector<std::uint32_t> triangleOfOpenFace;
};

class ExactFill {
 public:
  /// Orders in which the nodes can be inserted and the edges recovered: where a point inside has no
  /// position in doubles after one of them, it mostly has after another.
  static constexpr unsigned kOrders = 6;

  static constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

  /// `limit`: gives up after so many units of the budget of advance().
  explicit ExactFill(FillTask task, unsigned order = 0, std::uint64_t limit = kNoLimit);
  ExactFill(ExactFill&&) noexcept;
  ExactFill& operator=(ExactFill&&) noexcept;
  ~ExactFill();

  /// kPartial: points inside had no position in doubles; the result leaves open what is around them.
  /// kFailed: the triangles are not the closed boundary of something, or the limit is reached; there is
  /// no result.
  enum class State : std::uint8_t { kRunning, kDone, kPartial, kFailed };
  /// Works on for about `budget` times 2 microseconds, then returns; the outcome does not depend on it.
  State advance(std::uint32_t budget);

  /// How far it is, 0 to 1, estimated.
  [[nodiscard]] double fraction() const;

  /// Once done, in part or all.
  [[nodiscard]] const FillResult& result() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tetrafront
