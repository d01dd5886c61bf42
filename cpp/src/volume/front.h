#pragma once

/// @file The front: the faces between meshed and empty space, with everything that finds them
/// again. Kept invariant: the active faces form a closed, consistently turned, embedded complex of
/// triangles; each is counter-clockwise seen from the empty side.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "field/size_field.h"
#include "geom/box.h"
#include "search/face_grid.h"
#include "search/indexed_heap.h"
#include "tetrafront/options.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// The triple turned so that its least node leads; equal for equal oriented triangles.
inline NodeTriple smallestFirst(const NodeTriple& t) {
  if (t[1] < t[0] && t[1] < t[2]) return {t[1], t[2], t[0]};
  if (t[2] < t[0] && t[2] < t[1]) return {t[2], t[0], t[1]};
  return t;
}

struct FrontFace {
  NodeTriple nodes;
  float size;              ///< root mean square of the three side lengths
  std::uint32_t region;    ///< the region on its empty side
  FieldHint hint;          ///< where the size field was last asked from here
  std::uint8_t ruleClass;  ///< how often it could not be completed; 0 = the strict rules
  bool active;
};

class Front {
 public:
  /// `typicalSize`: median size of the first faces, > 0; sets the size buckets, tiles and the grid.
  /// `origin`: the lowest corner of all there will be, which tiles and cells are counted from.
  Front(double typicalSize, const Vec3& origin, FrontOrder order);

  // Nodes. The layer is 0 on the given surface and grows inward by one per new node.
  // The hint tells where the size field was last asked near it.
  NodeId addNode(const Vec3& position, std::uint16_t layer, FieldHint hint = {});
  void dropNodesFrom(std::size_t count);
  [[nodiscard]] const Vec3& node(NodeId id) const { return nodes_[id.index()]; }
  [[nodiscard]] std::span<const Vec3> nodes() const { return nodes_; }
  /// No two nodes there ever were are further apart along any axis.
  [[nodiscard]] double extent() const { return 2.0 * maxOffset_; }
  [[nodiscard]] std::uint16_t layer(NodeId id) const { return layers_[id.index()]; }
  [[nodiscard]] FieldHint hint(NodeId id) const { return hints_[id.index()]; }

  // Faces.
  /// Adds an active face; `queued` puts it into the heap too.
  FaceId addFace(const NodeTriple& nodes, std::uint32_t region, FieldHint hint, bool queued);
  void removeFace(FaceId face);
  [[nodiscard]] const FrontFace& face(FaceId id) const { return faces_[id.index()]; }
  void setHint(FaceId face, FieldHint hint) { faces_[face.index()].hint = hint; }
  /// Active faces in the order of their ids. O(all faces there ever were at once).
  [[nodiscard]] std::vector<FaceId> activeFaces() const;
  /// Active faces and free positions for faces.
  [[nodiscard]] std::size_t slotCount() const { return faces_.size(); }
  [[nodiscard]] std::uint32_t activeCount() const { return activeCount_; }
  [[nodiscard]] Box boxOf(FaceId face) const;

  // The order in which faces leave (step F4).
  [[nodiscard]] bool isQueueEmpty() const { return heap_.empty(); }
  /// Takes the next base face out of the heap; it stays active.
  FaceId popBase() { return FaceId(heap_.pop()); }
  /// Puts a face back, under the rules of class `ruleClass`.
  void requeue(FaceId face, std::uint8_t ruleClass);
  /// Marks a face as one that no rule could complete; it stays active, but out of the heap.
  void setAside(FaceId face, std::uint8_t ruleClass) { faces_[face.index()].ruleClass = ruleClass; }
  void clearQueue() { heap_.clear(); }
  void setOrder(FrontOrder order) { order_ = order; }

  /// Writes the numbers of the faces whose boxes meet `box`; see FaceGrid::query.
  std::size_t facesNear(const Box& box, std::vector<std::uint32_t>& faces) const {
    return grid_.query(box, faces);
  }

 private:
  [[nodiscard]] std::uint64_t keyOf(const FrontFace& face);
  /// Which part of space the face is in, for faces of one bucket and layer.
  [[nodiscard]] std::uint64_t tileOf(const FrontFace& face, int bucket) const;

  FrontOrder order_;
  double typicalSize_;
  Vec3 origin_;
  double maxOffset_ = 0.0;  ///< of any node from the origin, along an axis
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
