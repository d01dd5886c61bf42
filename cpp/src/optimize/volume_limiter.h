#pragma once

/// @file Splits tetrahedra that are larger than a permitted volume, until none is left. Each step halves the longest edge
/// of such a tetrahedron that is not on the boundary, in all tetrahedra at the edge, and so halves their volumes. A
/// tetrahedron with all edges on the boundary is split into four by a node at its centroid. The boundary and the
/// interfaces never change.

#include <cstdint>
#include <vector>

#include "base/task.h"
#include "optimize/tet_complex.h"
#include "tetrafront/status.h"
#include "topology/tet_mesh.h"

namespace tetrafront {

/// Returns how many elements of at most this volume a mesh needs at least: parts never extend beyond the element that they replace.
[[nodiscard]] double neededElements(const TetMesh& mesh, double maxVolume);

class VolumeLimiter {
 public:
  /// Ends with an error if more than `maxTetrahedra` are required.
  VolumeLimiter(TetMesh mesh, double maxVolume, std::size_t maxTetrahedra);

  /// Splits the elements. O(n + splits).
  Task<> run(Work& work);

  /// Returns the mesh at any time.
  [[nodiscard]] TetMesh mesh() const { return complex_.toMesh(); }
  /// The same with fewer copies; once, as the last call.
  [[nodiscard]] TetMesh take() { return complex_.take(); }
  [[nodiscard]] std::size_t innerNodeCount() const { return complex_.freeNodeCount(); }
  [[nodiscard]] std::size_t tetrahedronCount() const { return complex_.elementCount(); }
  /// Returns, once finished, kTooManyElements if the limit of their number is reached, kLargeTetrahedra if tetrahedra
  /// remain that rounding does not allow to split; else nothing.
  [[nodiscard]] std::vector<Diagnostic> diagnostics() const;

 private:
  [[nodiscard]] double volumeRatio(TetId tet) const;
  [[nodiscard]] double fraction() const;
  std::size_t splitSome(std::uint32_t budget, std::size_t& next, bool& hasSplit);
  bool split(TetId tet);
  bool splitEdge(TetId tet, std::size_t edge);
  bool splitAtCentroid(TetId tet);
  /// Returns false if the edge is on the boundary or on an interface.
  bool findRing(TetId tet, NodeId from, NodeId to);
  bool replaceIfValid(const std::vector<Corners>& made);

  double maxVolume_;
  std::size_t maxTetrahedra_;
  double required_;  ///< lower bound of the number of tetrahedra after the splits
  TetComplex complex_;
  std::size_t given_ = 0;  ///< number of tetrahedra before the splits
  bool hasTooMany_ = false;
  std::vector<TetId> ring_;
  std::vector<NewElement> fresh_;
};

}  // namespace tetrafront
