#pragma once

/// @file Sizes from a solution, and solutions from one mesh to another: what a loop of meshing and solving needs. The
/// engine itself solves nothing.

#include <cstdint>
#include <vector>

#include "tetrafront/mesh.h"
#include "tetrafront/sliced_tool.h"

namespace tetrafront {

/// Fields on a mesh, one after the other.
struct SolutionFields {
  /// Per field: all components of the first node or element, then those of the next.
  std::vector<double> values;
  std::vector<std::uint32_t> components;   ///< per field: numbers per node or element, >= 1
  std::vector<std::uint8_t> isPerElement;  ///< per field: 1 for values at the centroids of elements
};

/// Norm of the interpolation error over the mesh.
enum class ErrorNorm : std::uint8_t { kL1 = 0, kL2 = 1, kL4 = 2, kMax = 3 };

/// What the metric of a solution is made for. Either `elements` or `error` is > 0.
struct SolutionMetricOptions {
  ErrorNorm norm = ErrorNorm::kL2;
  double elements = 0.0;     ///< target number of elements
  double error = 0.0;        ///< target error of each field, in the unit of the field and the norm
  bool isIsotropic = false;  ///< one size at each node
  double minSize = 0.0;      ///< smallest edge length, >= 0
  double maxSize = 0.0;      ///< largest edge length; 0 for the diagonal of the mesh's bounding box
  double maxAspect = 1e4;    ///< largest ratio of two sizes at a node, 1 to 1e6
  double growth = 0.5;  ///< limit of the growth of the metric (metric/mesh_metric.h); 0 for none
  /// Index of the field that is an indicator of the error: its values are >= 0, one per node or element. It decides how
  /// large elements are, and the other fields only their shape; `error` is its target.
  std::uint32_t indicator = kNoIndicator;
  double indicatorOrder = 2.0;  ///< the indicator falls with this power of the size, 0.1 to 20

  static constexpr std::uint32_t kNoIndicator = 0xffffffffU;
};

/// Metrics as the sizes of a background grid. The front's sizes are shorter than the lengths of the edges that it makes, so
/// they are 0.947 of the lengths in the metric, with which it makes as many elements. If the two shorter sizes are the
/// same at all nodes, up to rounding, there is no second stretching.
struct FrontSizes {
  std::vector<double> sizes;              ///< per node: the smallest size
  std::vector<double> stretchings;        ///< per node: largest size / smallest size
  std::vector<double> directions;         ///< x y z of the largest size per node, of length 1
  std::vector<double> secondStretchings;  ///< per node: middle size / smallest size; or empty
  std::vector<double> secondDirections;   ///< x y z per node, of length 1; or empty
  std::uint32_t invalidNode = kNoNode;    ///< the first node whose metric is not positive definite

  static constexpr std::uint32_t kNoNode = 0xffffffffU;
};

/// Converts metrics, six numbers per node: xx xy xz yy yz zz. If one is not positive definite, or has an aspect above
/// 1e6, the result has no sizes. A unit of work is eight nodes.
class FrontSizer : public SlicedTool<FrontSizes> {
 public:
  explicit FrontSizer(std::vector<double> metrics);
};

/// A metric at the nodes of a mesh.
struct SolutionMetric {
  std::vector<double> metrics;  ///< six numbers per node: xx xy xz yy yz zz
  FrontSizes frontSizes;
  double elements = 0.0;  ///< number of elements that the metric asks for
  /// Per field: interpolation error of a mesh of regular unit elements; for the indicator, its largest value there.
  std::vector<double> errors;
  /// Per field: 1 if it varies by more than rounding, for the indicator if it is not 0 everywhere. Others have no
  /// influence.
  std::vector<std::uint8_t> hasVariation;
};

/// Makes a metric for the interpolation error of fields by elements with linear functions: of each field, the Hessian is
/// recovered (solution/recovered_hessian.h) and scaled for the norm (Loseille & Alauzet 2011, Continuous mesh framework);
/// the metrics of several fields are intersected; sizes, aspect and growth are limited. If a number of elements is asked
/// for, the metric is scaled until the limited metric asks for it. If no field varies, the metric is the same everywhere.
/// With an indicator, sizes follow from it and from those of the mesh (solution/indicator_density.h).
/// `mesh` needs positive volumes; values are finite. A unit of work is about a step of the front.
class SolutionSizer : public SlicedTool<SolutionMetric> {
 public:
  SolutionSizer(VolumeMesh mesh, SolutionFields fields, SolutionMetricOptions options);
};

/// Fields on another mesh.
struct TransferredSolution {
  std::vector<double>
      values;  ///< as SolutionFields::values, for the nodes and elements of the other mesh
  /// Integrals over the meshes, per component of each field: of linear functions between nodes, or of the values of
  /// elements.
  std::vector<double> integralsBefore;
  std::vector<double> integralsAfter;
  std::uint32_t outside =
      0;                  ///< nodes or elements of the other mesh that the given one does not reach
  double farthest = 0.0;  ///< largest distance of these nodes or centroids from the given mesh
};

/// Transfers fields from one mesh to another. Both need positive volumes; values are finite. A unit of work is about a
/// step of the front.
///
/// By interpolation, a node gets the value of the linear function of the element around it, an element the value of the
/// element around its centroid; outside the given mesh, the value of the nearest point counts, so a curved boundary may
/// move by less than a chord.
///
/// Conservative transfer intersects the elements of both meshes. An element gets the mean of the values over it. Nodes
/// get the linear functions nearest to the given ones in the sense of least squares (Farrell et al. 2009, Conservative
/// interpolation between unstructured meshes via supermesh construction): linear fields are reproduced, and beside jumps
/// values may leave the range of the given ones. Where both meshes fill the same domain, integrals are kept up to
/// rounding. Elements that the given mesh covers in part get the mean of the covered part; for nodes,
/// interpolated values count in the rest.
class SolutionTransferrer : public SlicedTool<TransferredSolution> {
 public:
  SolutionTransferrer(VolumeMesh from, VolumeMesh to, SolutionFields fields, bool isConservative);
};

}  // namespace tetrafront
