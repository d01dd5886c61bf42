#pragma once

/// @file Computes all statistics of a finished mesh (quality_statistics.h), in slices.

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "field/size_field.h"
#include "geom/tetrahedron.h"
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
  [[nodiscard]] MetricShapes takeMetricShapes() { return std::move(metricShapes_); }

 private:
  enum class Stage : std::uint8_t {
    kSizes,
    kElements,
    kInsertEdges,
    kEdges,
    kBoundary,
    kLimits,
    kDone
  };

  void querySizes(std::size_t first, std::size_t last);
  void measureElements(std::size_t first, std::size_t last);
  void insertEdges(std::size_t first, std::size_t last);
  void measureEdges(std::size_t firstNode, std::size_t lastNode);
  void findBoundaryFaces(std::size_t first, std::size_t last);
  void startEdges();
  void startBoundary();
  void findLimits(std::size_t first, std::size_t last);
  void finish();

  /// Returns the corners in the element's metric space, the first in the origin; without stretching,
  /// the corners in space.
  [[nodiscard]] std::array<Vec3, 4> metricCorners(TetId element) const;
  /// Returns the mean of raised size / target size over the nodes.
  [[nodiscard]] double meanRaiseFactor(std::span<const NodeId> nodes) const;
  [[nodiscard]] double relativeLength(NodeId a, NodeId b) const;
  [[nodiscard]] ElementQuality qualityOf(TetId element) const;
  [[nodiscard]] ElementView viewOf(const NodeQuad& nodes) const;
  void count(BoundaryLimit limit);
  RegionStatistics& statisticsOf(std::uint32_t region);
  void measureShape(std::uint32_t region, const TetrahedronMeasures& measures);

  struct Ranked {
    double cost;  ///< dihedralCostOf()
    TetId element;
  };
  static void keepWorst(std::vector<Ranked>& worst, const Ranked& candidate);
  [[nodiscard]] std::vector<ElementQuality> qualityOf(const std::vector<Ranked>& worst) const;

  const VolumeMesh& mesh_;
  const SurfaceMesh& surface_;
  const SizeField& field_;
  bool isStretched_;
  FieldHint hint_;
  Stage stage_ = Stage::kSizes;
  std::size_t next_ = 0;
  QualityMeter meter_;
  QualityStatistics statistics_;
  std::vector<QualityMeter> regionMeters_;  ///< in the metric
  MetricShapes metricShapes_;
  std::vector<double> sizes_;             ///< target lengths at nodes, without stretching
  std::vector<SymmetricTensor> tensors_;  ///< T of nodes, with stretching
  std::vector<double>
      raiseFactors_;  ///< raised size / target size at nodes, if the field is raised
  /// An edge of an element, as an index into kTetEdges.
  class ElementEdge {
   public:
    ElementEdge() = default;
    ElementEdge(TetId element, std::size_t edge)
        : packed_(static_cast<std::uint32_t>(kTetEdges.size() * element.index() + edge)) {}
    [[nodiscard]] TetId element() const { return TetId(packed_ / kTetEdges.size()); }
    [[nodiscard]] const TetEdge& corners() const { return kTetEdges[packed_ % kTetEdges.size()]; }

   private:
    std::uint32_t packed_ = 0;
  };

  /// Edges of elements by their lower node. Those of node i begin at starts_[i].
  std::vector<std::uint32_t> starts_;
  std::vector<std::uint32_t> filled_;
  std::vector<ElementEdge> edges_;
  /// Per node: the last lower node with which it shared an edge, or none.
  std::vector<NodeId> lastLowerNode_;
  double sumOfEdges_ = 0.0;
  double sumOfAchievable_ = 0.0;
  std::uint64_t edgeCount_ = 0;
  std::uint64_t nearTargetCount_ = 0;
  double largestVolume_ = 0.0;
  double smallestVolume_ = 0.0;
  TetId smallest_{0U};
  std::vector<Ranked> worst_;
  std::vector<Ranked> outOfRange_;
  std::vector<Ranked> worstLimited_;
  std::vector<std::uint8_t> isTested_;  ///< nodes of the elements to test
  BoundaryLimits limits_;               ///< limits of those elements
};

}  // namespace tetrafront
