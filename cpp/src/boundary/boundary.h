#pragma once

/// @file One closed, oriented boundary (between steps F2 and F3 of Löhner & Parikh 1988): finds
/// what would keep a surface from enclosing a volume and names it, turns triangles outward
/// whatever way they were drawn, and tells which region lies inside each. Topology is decided by
/// exact signs; the one tolerance is the rounding of a shell's volume against zero.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "boundary/boundary_report.h"
#include "tetrafront/mesh.h"
#include "tetrafront/options.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// What bounds a region from outside, or a cavity in it.
struct BoundaryShell {
  std::uint32_t firstTriangle = 0;
  std::uint32_t triangles = 0;
  std::uint32_t region = 0;
  double volume = 0.0;  ///< enclosed; negative for a cavity
  double area = 0.0;
};

struct BoundaryResult {
  bool valid = false;
  /// By their lowest triangles; a wall belongs to two. Empty unless valid.
  std::vector<BoundaryShell> shells;
  std::uint32_t regionCount = 0;
};

/// What becomes of a part of a given surface, connected over edges, some of whose triangles face
/// inward and others outward. Parts that are inside out as a whole are always set right.
enum class MixedOrientation : std::uint8_t {
  kFlip,    ///< and named as information
  kRefuse,  ///< each triangle that faces inward is an error: repair is for those who ask for it
};

/// The check in slices. Surfaces that pass are left
///   - with every triangle counter-clockwise seen from outside its region, whatever way it was drawn;
///     a wall, which has a region on either side, as it was drawn;
///   - with triangleRegions set, by the rule of region_map.h: a shell within a shell bounds a
///     cavity, one more an island, unless such parts are to be regions of their own; bodies with a
///     common wall are a region each;
///   - in their order of nodes and triangles, which only ever have two nodes exchanged;
///   - for a given surface with trianglePatch set to the shell, numbered by its lowest triangle.
/// Any number of triangles above one may meet at an edge: bodies touch along it, or walls end there.
class BoundaryCheck {
 public:
  /// `mesh` must outlive this, and not change meanwhile. `maxDiagnostics`: findings of each code.
  BoundaryCheck(SurfaceMesh& mesh, BoundarySource source,
                EnclosedBodies enclosed = EnclosedBodies::kCavities,
                MixedOrientation mixed = MixedOrientation::kFlip,
                std::size_t maxDiagnostics = kListedFindings);
  BoundaryCheck(BoundaryCheck&&) noexcept;
  BoundaryCheck& operator=(BoundaryCheck&&) noexcept;
  ~BoundaryCheck();

  /// Works on for about `budget` triangles; true when finished. O(n log n) in all for surfaces
  /// that do not meet themselves everywhere.
  bool advance(std::uint32_t budget);

  /// Of its own work, 0 to 1.
  [[nodiscard]] double fraction() const;

  /// Both complete once advance() has returned true. Not valid iff there is an error among the
  /// diagnostics; the last of an error's values counts the findings of its kind.
  [[nodiscard]] const BoundaryResult& result() const;
  [[nodiscard]] const std::vector<Diagnostic>& diagnostics() const;
  /// The same, and none are left here: there may be a million.
  [[nodiscard]] std::vector<Diagnostic> takeDiagnostics();

  /// One flag per triangle: those that make no edges, having a node twice or the nodes of an earlier
  /// triangle. Empty where numbers are broken.
  [[nodiscard]] const std::vector<std::uint8_t>& withoutEdges() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// The whole check at once; findings are appended to `out`.
BoundaryResult closeBoundary(SurfaceMesh& mesh, BoundarySource source, std::vector<Diagnostic>& out,
                             EnclosedBodies enclosed = EnclosedBodies::kCavities);

}  // namespace tetrafront
