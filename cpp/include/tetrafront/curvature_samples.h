#pragma once

/// @file Normals and curvatures of drawn patches, for display: how smooth a surface is and where it bends.

#include <cstdint>
#include <vector>

#include "tetrafront/model.h"
#include "tetrafront/sliced_tool.h"

namespace tetrafront {

/// Rows and columns of a curved patch, by default and at most.
inline constexpr std::uint32_t kShadedCells = 24;
inline constexpr std::uint32_t kMaxShadedCells = 384;

/// Triangles of all patches, with the normals and curvatures of the patches themselves. Patches share no vertices.
struct CurvatureSamples {
  std::vector<double> points;    ///< x y z per vertex
  std::vector<double> normals;   ///< x y z per vertex, of length 1; on the same side within a patch
  std::vector<double> gaussian;  ///< per vertex: product of the principal curvatures, 1 / length^2
  std::vector<double>
      largest;  ///< per vertex: the larger magnitude of the principal curvatures, 1 / length
  /// Triangles of patch p: triangles[3t..3t+2] for t in patchOffsets[p] .. patchOffsets[p+1]-1, vertices. A patch that
  /// cannot be evaluated has none.
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint32_t> patchOffsets;
};

/// Samples the normals and curvatures of a drawn model, which may have problems, in slices. About 4000 evaluations per curved
/// patch by default; in patches with holes, of each vertex of their triangles too.
class CurvatureSampler : public SlicedTool<CurvatureSamples> {
 public:
  /// `cells`: number of rows and columns of a curved patch without holes, a whole number from 1 to kMaxShadedCells. A tube has
  /// several such lattices.
  explicit CurvatureSampler(Model model, double cells = kShadedCells);
};

}  // namespace tetrafront
