#pragma once

/// @file Changes of a patch's triangulation where it is not as wanted: needless nodes are removed,
/// sides much too long are divided, and triangles of small angles are replaced by better ones. Each
/// change is judged by the triangles it removes and those it makes, in space.

#include <cstdint>

#include "surface/patch_metric.h"
#include "surface/planar_links.h"
#include "surface/planar_mesh.h"
#include "surface/planar_moves.h"

namespace tetrafront {

class PlanarImprover {
 public:
  /// All must outlive this.
  PlanarImprover(const PatchMetric& metric, PlanarMesh& mesh, PlanarLinks& links,
                 PlanarMoves& moves);

  /// Divides the triangle's inner edges that join nodes which must not be.
  void part(std::uint32_t triangle);

  /// If the patch is one triangle and must be no other patch's too: divides it. The node belongs
  /// where it is put, and must not be moved or removed after that.
  void partLoneTriangle();

  /// Draws an inner node into a neighbour if it has an edge much shorter than wanted, or fewer
  /// than five triangles, and neither shapes nor lengths suffer.
  void thin(std::uint32_t node);

  /// Divides the longest side of a triangle if that is much longer than wanted.
  void refine(std::uint32_t triangle);

  /// Betters a triangle with a small angle by the best of: a side flipped, a node of its removed,
  /// a side divided; else its nodes are moved.
  void repair(std::uint32_t triangle);

 private:
  /// A change and the smallest sine of the triangles it leaves.
  struct Change {
    enum class Kind : std::uint8_t { kNone, kFlip, kCollapse, kSplit };
    Kind kind = Kind::kNone;
    double sine = 0.0;
    std::uint32_t at = 0;      ///< triangle, or node to be removed
    std::uint32_t corner = 0;  ///< of the triangle, or position in the node's ring
    Vec2 place{0.0};           ///< of a node to be added
  };

  [[nodiscard]] LocalSpace localAt(std::uint32_t node);
  [[nodiscard]] double sine(const LocalSpace& local, std::uint32_t a, std::uint32_t b,
                            std::uint32_t c) const;
  [[nodiscard]] double length(const LocalSpace& local, std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] double starSine(const LocalSpace& local, std::uint32_t centre) const;
  [[nodiscard]] double fanSine(const LocalSpace& local, std::uint32_t centre,
                               std::size_t into) const;
  [[nodiscard]] double longestOfFan(const LocalSpace& local, std::size_t into) const;
  [[nodiscard]] bool mayRemove() const;
  void considerFlip(std::uint32_t t, std::uint32_t k, Change& best);
  void considerCollapses(std::uint32_t node, Change& best);
  void considerSplit(std::uint32_t t, std::uint32_t k, Change& best);
  double splitSine(const LocalSpace& local, const PlanarLinks::Diamond& sides, const Vec2& at);
  void make(const Change& change);
  void addAndSplit(std::uint32_t t, std::uint32_t k, const Vec2& at);
  std::uint32_t addNode(const Vec2& at);

  const PatchMetric* metric_;
  PlanarMesh* mesh_;
  PlanarLinks* links_;
  PlanarMoves* moves_;
  bool hasSeam_ = false;
  PlanarLinks::Star star_;
  FieldHint hint_;
};

}  // namespace tetrafront
