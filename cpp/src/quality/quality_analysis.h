#pragma once

/// @file Computes all statistics of a finished mesh (quality_statistics.h), in slices.

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "base/task.h"
#include "field/size_field.h"
#include "quality/boundary_limits.h"
#include "quality/metrics.h"
#include "tetrafront/mesh.h"
#include "tetrafront/quality_statistics.h"
#include "tetrafront/status.h"
#include "topology/mesh_view.h"
#include "topology/node_list_passes.h"

namespace tetrafront {

class QualityAnalysis {
 public:
  /// `surface` has the triangles of the boundary and of interfaces; its nodes are the mesh's. All
  /// must outlive this. At most about `maxEdges` edges of elements are kept at a time.
  QualityAnalysis(const MeshView& mesh, const SurfaceMesh& surface, const SizeField& field,
                  std::size_t maxEdges = kMaxListed);

  /// Visits about `budget` elements or nodes; returns true when finished. O(n), about 0.5 µs per
  /// element.
  bool advance(std::uint32_t budget) { return job_.advance(budget); }

  /// Estimated progress, 0 to 1.
  [[nodiscard]] double fraction() const { return job_.fraction(); }

  /// Summary in plain space; final when finished.
  [[nodiscard]] QualitySummary summary() const { return meter_.summary(); }
  [[nodiscard]] const QualityStatistics& statistics() const { return statistics_; }
  [[nodiscard]] MetricShapes takeMetricShapes() { return std::move(metricShapes_); }

 private:
  /// An edge of an element, listed at its lower node.
  struct EdgeUse {
    NodeId upper;
    TetId element;
  };

  Task<> analyse(Work& work);
  Task<> measureElements(Work& work);
  Task<> findLimits(Work& work);
  Task<> findReasons(Work& work);

  void querySize(NodeId node);
  void measureElement(TetId element, const ElementSource::Element& made);
  Task<> measureEdges(Work& work, NodeListPasses<EdgeUse>& edges);
  void measureEdge(NodeId lower, const EdgeUse& edge);
  void finish();

  /// Returns the corners in the element's metric space, the first in the origin; without stretching,
  /// the corners in space.
  [[nodiscard]] std::array<Vec3, 4> metricCorners(const ElementSource::Element& element) const;
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

  MeshView mesh_;
  const SurfaceMesh& surface_;
  const SizeField& field_;
  std::size_t maxEdges_;
  bool isStretched_;
  FieldHint hint_;
  QualityMeter meter_;
  QualityStatistics statistics_;
  std::vector<QualityMeter> regionMeters_;  ///< in the metric
  MetricShapes metricShapes_;
  std::vector<double> sizes_;             ///< target lengths at nodes, without stretching
  std::vector<SymmetricTensor> tensors_;  ///< T of nodes, with stretching
  std::vector<double>
      raiseFactors_;  ///< raised size / target size at nodes, if the field is raised
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
  std::vector<TetId> poor_;
  double largestCosine_ = -1.0;  ///< of the poor elements; the worst one is the first
  Job<> job_;                    ///< last, because it uses the other members
};

}  // namespace tetrafront
