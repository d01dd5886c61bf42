#pragma once

/// @file Checks that a surface is one closed boundary, orients its triangles outward, and finds the region on either
/// side of each (between steps F2 and F3 of Löhner & Parikh 1988). Reports everything that keeps the surface from
/// enclosing a volume. Exact signs decide the topology; the only tolerance decides whether the volume of a shell
/// is zero.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "base/task.h"
#include "boundary/boundary_report.h"
#include "boundary/region_map.h"
#include "tetrafront/mesh.h"
#include "tetrafront/options.h"
#include "tetrafront/status.h"
#include "topology/edge_table.h"

namespace tetrafront {

/// The closed boundary of a region or of a cavity inside a region.
struct BoundaryShell {
  TriangleId firstTriangle{};
  std::uint32_t triangleCount = 0;
  RegionId region{};
  double volume = 0.0;  ///< enclosed volume; negative for a cavity
  double area = 0.0;
};

/// What the check has found out about a surface, for all who work on it.
struct Boundary {
  bool isValid = false;
  /// The edges of the triangles as the check leaves them; none if a number is invalid.
  std::optional<EdgeTable> edges;
  /// One flag per triangle: whether it is left out of the edges, because it has a repeated node or duplicates an
  /// earlier triangle.
  std::vector<std::uint8_t> withoutEdges;
  /// In the order of their first triangles; an interface belongs to two. Empty unless valid.
  std::vector<BoundaryShell> shells;
  std::uint32_t regionCount = 0;
  /// Per region: its index in the given triangleRegions; empty if none were given.
  std::vector<std::uint32_t> givenRegionOf;
};

/// What the check does with a component of a given surface in which some triangles face inward and others outward.
/// A component that is flipped as a whole is oriented outward in either case.
enum class MixedOrientation : std::uint8_t {
  kFlip,  ///< flip the triangles that face inward, and report this as information
  kRefuse,  ///< report each triangle that faces inward as an error: only an explicit repair changes it
};

/// The boundary check in slices. A valid surface is left
///   - with every triangle counter-clockwise as seen from outside its region; an interface, which has a region on
///     either side, keeps its orientation;
///   - with triangleRegions set, by the rule of region_map.h, or by the triangleRegions that were given;
///   - with its nodes and triangles in their order: the check only swaps two nodes of a triangle;
///   - for a given surface, with trianglePatch set to the index of the shell in Boundary::shells.
/// Two or more triangles may meet at an edge: regions touch there, or interfaces end.
class BoundaryCheck {
 public:
  /// `mesh` must outlive this object and not change meanwhile. If its triangleRegions are not empty, they state what
  /// is meshed, and `innerShells` has no effect. `maxDiagnostics`: limit per code.
  BoundaryCheck(SurfaceMesh& mesh, BoundarySource source,
                InnerShells innerShells = InnerShells::kByOrientation,
                MixedOrientation mixed = MixedOrientation::kFlip,
                std::size_t maxDiagnostics = kDefaultMaxDiagnostics);

  /// Declares that the triangles of drawn patches end at `triangle`, where those of bodies begin: their orientation means
  /// something. Must be called before the first advance().
  void setFirstOfBodies(std::uint32_t triangle) { firstOfBodies_ = triangle; }

  /// Declares that no two triangles intersect, as a search or the changes that made them have shown: the check then does not
  /// search again. Must be called before the first advance().
  void setEmbedded() { isEmbedded_ = true; }

  /// Does work for about `budget` triangles; returns true when finished. O(n log n) in total for surfaces with few
  /// self-intersections.
  bool advance(std::uint32_t budget) { return job_.advance(budget); }

  /// Estimated progress, 0 to 1.
  [[nodiscard]] double fraction() const { return job_.fraction(); }

  /// The result and the diagnostics are complete once advance() has returned true. The result is valid unless one
  /// of the diagnostics is an error.
  [[nodiscard]] const Boundary& result() const { return result_; }
  [[nodiscard]] Boundary takeResult() { return std::move(result_); }
  [[nodiscard]] const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }
  /// Moves the diagnostics out: there may be a million.
  [[nodiscard]] std::vector<Diagnostic> takeDiagnostics() { return std::move(diagnostics_); }

 private:
  Task<> run(Work& work);
  Task<> closeBoundary(Work& work);

  [[nodiscard]] MeshedRule meshedRule() const;
  /// Makes the meshed side the back of every triangle. Flips interfaces only with a body inside a body, if both face inward.
  void orientOutward(RegionMap& regions);
  void reportFlippedPatches(const std::vector<std::uint8_t>& isFlipped);
  void reportFlippedComponents(const RegionMap& regions,
                               const std::vector<std::uint8_t>& isFlipped);
  /// Reports the edges and nodes at which the surface touches itself, except those of interfaces.
  void reportContacts(const RegionMap& regions);
  /// Numbers the regions in the order of the first triangles of their outer shells.
  void numberRegions(const RegionMap& regions);

  SurfaceMesh& mesh_;
  BoundarySource source_;
  InnerShells innerShells_;
  MixedOrientation mixed_;
  BoundaryReport report_;
  std::uint32_t firstOfBodies_ = 0xffffffffU;
  bool isEmbedded_ = false;
  std::vector<std::uint32_t> givenRegions_;  ///< two per triangle, or empty
  Boundary result_;
  std::vector<Diagnostic> diagnostics_;
  Job<> job_;  ///< last, because it uses the other members
};

/// Does the whole check in one call. Appends the diagnostics to `diagnostics`.
Boundary closeBoundary(SurfaceMesh& mesh, BoundarySource source,
                       std::vector<Diagnostic>& diagnostics,
                       InnerShells innerShells = InnerShells::kByOrientation);

}  // namespace tetrafront
