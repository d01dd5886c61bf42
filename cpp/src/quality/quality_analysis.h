#pragma once

/// @file Computes all statistics of a finished mesh (quality_statistics.h), in slices.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "field/size_field.h"
#include "quality/boundary_limits.h"
#include "quality/metrics.h"
#include "tetrafront/mesh.h"
#include "tetrafront/quality_statistics.h"
#include "tetrafront/status.h"

namespace tetrafront {

class QualityAnalysis {
 public:
  /// `surface` has the triangles of the boundary and of interfaces; its nodes are the mesh's. All
  /// must outlive this.
  QualityAnalysis(const VolumeMesh& mesh, const SurfaceMesh& surface, const SizeField& field);

  /// Visits about `budget` elements or nodes; returns true when finished. O(n), about 0.5 µs per
  /// element.
  bool advance(std::uint32_t budget);

  /// Summary in plain space; final when finished.
  [[nodiscard]] QualitySummary summary() const { return meter_.summary(); }
  [[nodiscard]] const QualityStatistics& statistics() const { return statistics_; }

 private:
  enum class Stage : std::uint8_t {
    kSizes,
    kElements,
    kPlaceEdges,
    kEdges,
    kBoundary,
    kLimits,
    kDone
  };

  void askSizes(std::size_t first, std::size_t last);
  void measureElements(std::size_t first, std::size_t last);
  void placeEdges(std::size_t first, std::size_t last);
  void measureEdges(std::size_t firstNode, std::size_t lastNode);
  void findBoundaryFaces(std::size_t first, std::size_t last);
  void startEdges();
  void startBoundary();
  void findLimits(std::size_t first, std::size_t last);
  void finish();

  [[nodiscard]] Vec3 pointOf(std::uint32_t node) const;
  [[nodiscard]] std::span<const std::uint32_t, 4> nodesOf(std::size_t element) const;
  /// The corners in the element's metric space, the first in the origin; without stretching, plain
  /// corners up to a factor.
  [[nodiscard]] std::array<Vec3, 4> seenCorners(std::span<const std::uint32_t, 4> nodes) const;
  /// Statistics over the nodes of actual size / target size.
  [[nodiscard]] double meanLift(std::span<const std::uint32_t> nodes) const;
  [[nodiscard]] double relativeLength(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] ElementQuality figuresOf(std::uint32_t element) const;
  [[nodiscard]] ElementView viewOf(std::span<const std::uint32_t, 4> nodes) const;
  void count(BoundaryLimit limit);
  RegionStatistics& statisticsOf(std::uint32_t region);

  struct Ranked {
    double badness;
    std::uint32_t element;
  };
  static void keepWorst(std::vector<Ranked>& worst, const Ranked& one);
  [[nodiscard]] std::vector<ElementQuality> figuresOf(const std::vector<Ranked>& worst) const;

  const VolumeMesh& mesh_;
  const SurfaceMesh& surface_;
  const SizeField& field_;
  bool isStretched_;
  FieldHint hint_;
  Stage stage_ = Stage::kSizes;
  std::size_t next_ = 0;
  QualityMeter meter_;
  QualityStatistics statistics_;
  std::vector<double> sizes_;             ///< target lengths at nodes, without stretching
  std::vector<SymmetricTensor> tensors_;  ///< T of nodes, with stretching
  std::vector<double> lifts_;  ///< raised size / target size at nodes, if the field is raised
  /// Edges of elements by their lower node, as 6 x element + edge. Those of node i begin at
  /// starts_[i].
  std::vector<std::uint32_t> starts_;
  std::vector<std::uint32_t> filled_;
  std::vector<std::uint32_t> edges_;
  std::vector<std::uint32_t>
      metBy_;  ///< per node: the last lower node that it shared an edge with, plus 1
  double sumOfEdges_ = 0.0;
  double sumOfPossible_ = 0.0;
  std::uint64_t edgeCount_ = 0;
  std::uint64_t nearCount_ = 0;
  double largestVolume_ = 0.0;
  double smallestVolume_ = 0.0;
  std::uint32_t smallest_ = 0;
  std::vector<Ranked> worst_;
  std::vector<Ranked> missed_;
  std::vector<Ranked> worstLimited_;
  std::vector<std::uint8_t> concerned_;  ///< nodes of the elements to test
  BoundaryLimits limits_;                ///< limits of those elements
};

}  // namespace tetrafront
