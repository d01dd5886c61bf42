#pragma once

/// @file The front: the faces between meshed and empty volume, with the structures that find them.
/// Invariant: the active faces form a closed, consistently oriented, embedded set of triangles.
/// Each is counter-clockwise seen from its empty side.

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "field/size_field.h"
#include "geom/box.h"
#include "search/face_grid.h"
#include "search/indexed_heap.h"
#include "tetrafront/options.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// Returns the triple rotated so that its smallest node is first. Triangles with the same
/// orientation have the same result.
inline NodeTriple smallestFirst(const NodeTriple& t) {
  if (t[1] < t[0] && t[1] < t[2]) return {t[1], t[2], t[0]};
  if (t[2] < t[0] && t[2] < t[1]) return {t[2], t[0], t[1]};
  return t;
}

struct FrontFace {
  NodeTriple nodes;
  float size;              ///< root mean square of the edge lengths
  std::uint32_t region;    ///< region on the empty side
  FieldHint hint;          ///< where the last query of the size field from this face was
  std::uint8_t ruleClass;  ///< number of rule classes under which the face failed; 0: strict rules
  bool active;
};

/// What decides when a face becomes the base face, in the layered order: lower buckets first, then lower layers.
struct FrontRank {
  std::uint32_t bucket;  ///< of the size: a factor of 4 each
  std::uint32_t layers;  ///< sum of the layers of the nodes
};

class Front {
 public:
  /// `typicalSize` > 0 is the median size of the initial faces; it scales the size buckets, the
  /// tiles and the grid. `origin` is the lowest corner of the model, from which tiles and cells are
  /// counted.
  Front(double typicalSize, const Vec3& origin, FrontOrder order);

  // Nodes.

  /// Adds a node. Its layer is 0 on the given surface and grows inward by one per new node. `hint`
  /// is where the size field was last queried near it.
  NodeId addNode(const Vec3& position, std::uint16_t layer, FieldHint hint = {});
  void dropNodesFrom(std::size_t count);
  [[nodiscard]] const Vec3& node(NodeId id) const { return nodes_[id.index()]; }
  [[nodiscard]] std::span<const Vec3> nodes() const { return nodes_; }
  /// Moves the positions of all nodes out; once, at the end.
  [[nodiscard]] std::vector<Vec3> takeNodes() { return std::move(nodes_); }
  /// Upper bound of the distance along any axis between two nodes that ever existed.
  [[nodiscard]] double extent() const { return 2.0 * maxOffset_; }
  [[nodiscard]] std::uint16_t layer(NodeId id) const { return layers_[id.index()]; }
  [[nodiscard]] FieldHint hint(NodeId id) const { return hints_[id.index()]; }

  // Faces.

  /// Adds an active face; `queued` also puts it into the heap.
  FaceId addFace(const NodeTriple& nodes, std::uint32_t region, FieldHint hint, bool queued);
  void removeFace(FaceId face);
  [[nodiscard]] const FrontFace& face(FaceId id) const { return faces_[id.index()]; }
  void setHint(FaceId face, FieldHint hint) { faces_[face.index()].hint = hint; }
  /// Returns the active faces, ascending. O(slots).
  [[nodiscard]] std::vector<FaceId> activeFaces() const;
  /// Number of slots for faces, active and free.
  [[nodiscard]] std::size_t slotCount() const { return faces_.size(); }
  [[nodiscard]] std::uint32_t activeCount() const { return activeCount_; }
  [[nodiscard]] Box boxOf(FaceId face) const;

  // The order in which faces become base faces (step F4).

  [[nodiscard]] double typicalSize() const { return typicalSize_; }
  [[nodiscard]] FrontRank rankOf(const FrontFace& face) const;

  [[nodiscard]] bool isQueueEmpty() const { return heap_.empty(); }
  /// Takes the next base face from the heap; it stays active.
  FaceId popBase() { return FaceId(heap_.pop()); }
  /// Puts a face back into the heap, under the rules of class `ruleClass`.
  void requeue(FaceId face, std::uint8_t ruleClass);
  /// Sets the class of a face outside the heap. The face stays active but does not become a base
  /// face.
  void setAside(FaceId face, std::uint8_t ruleClass) { faces_[face.index()].ruleClass = ruleClass; }
  void clearQueue() { heap_.clear(); }
  void setOrder(FrontOrder order) { order_ = order; }

  /// Writes the indices of the faces whose boxes overlap `box`, and returns their number; see
  /// FaceGrid::query.
  std::size_t facesNear(const Box& box, std::vector<std::uint32_t>& faces) const {
    return grid_.query(box, faces);
  }

 private:
  [[nodiscard]] std::uint64_t keyOf(const FrontFace& face);
  /// The logarithm of a size: its bucket above kBucketBits, its place in the bucket below.
  [[nodiscard]] std::uint32_t sizeInBuckets(float size) const;
  /// Index of the tile that contains the face, among faces of one bucket and layer.
  [[nodiscard]] std::uint64_t tileOf(const FrontFace& face, int bucket) const;

  FrontOrder order_;
  double typicalSize_;
  Vec3 origin_;
  double maxOffset_ = 0.0;  ///< largest distance of a node from the origin along an axis
  std::vector<Vec3> nodes_;
  std::vector<std::uint16_t> layers_;
  std::vector<FieldHint> hints_;
  std::vector<FrontFace> faces_;
  std::vector<FaceId> freeSlots_;
  std::uint32_t activeCount_ = 0;
  std::uint64_t sequence_ = 0;
  IndexedHeap heap_;
  FaceGrid grid_;
};

}  // namespace tetrafront
