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
};

/// A metric at the nodes of a mesh.
struct SolutionMetric {
  std::vector<double> metrics;  ///< six numbers per node: xx xy xz yy yz zz
  /// The same as a background grid with one stretching: the shorter two sizes of each node are replaced by their
  /// geometric mean, so the number of elements per volume is kept.
  std::vector<double> sizes;
  std::vector<double> stretchings;
  std::vector<double> directions;  ///< x y z per node, of length 1
  double elements = 0.0;           ///< number of elements that the metric asks for
  std::vector<double>
      errors;  ///< per field: interpolation error of a mesh of regular unit elements
  /// Per field: 1 if it varies by more than rounding. Others have no influence.
  std::vector<std::uint8_t> hasVariation;
};

/// Makes a metric for the interpolation error of fields by elements with linear functions: of each field, the Hessian is
/// recovered (solution/recovered_hessian.h) and scaled for the norm (Loseille & Alauzet 2011, Continuous mesh framework);
/// the metrics of several fields are intersected; sizes, aspect and growth are limited. If a number of elements is asked
/// for, the metric is scaled until the limited metric asks for it. If no field varies, the metric is the same everywhere.
/// `mesh` needs positive volumes; values are finite. A unit of work is about a step of the front.
class SolutionSizer : public SlicedTool<SolutionMetric> {
 public:
  SolutionSizer(VolumeMesh mesh, SolutionFields fields, SolutionMetricOptions options);
};

}  // namespace tetrafront
