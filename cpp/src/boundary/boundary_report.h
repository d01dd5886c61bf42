#pragma once

/// @file The diagnostics of the boundary check. Names lines and patches for a drawn model, triangles for a given
/// surface. Limits the number of diagnostics per code, because a badly damaged surface can have millions.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "tetrafront/mesh.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// Origin of a boundary, which decides what diagnostics name.
enum class BoundarySource : std::uint8_t {
  kDrawnPatches,  ///< SurfaceMesh::trianglePatch, sides and sideLine are filled
  kGivenSurface,  ///< points and triangles only
};

/// Collects diagnostics and keeps the first `maxDiagnostics` of each code. The last of their `values` is the total
/// of that code; for a drawn model, the total with the same entities. If the search ended early, a 1 follows: the
/// total is then a lower bound. A diagnostic of a drawn model names lines and patches first, then up to
/// kMaxTriangles of the triangles concerned.
class BoundaryReport {
 public:
  BoundaryReport(const SurfaceMesh& mesh, BoundarySource source,
                 std::size_t maxDiagnostics = kDefaultMaxDiagnostics)
      : mesh_(mesh), source_(source), maxDiagnostics_(maxDiagnostics) {}

  /// Positions of the mesh are relative to `origin` from now on; those that are reported are not.
  void setOrigin(const Vec3& origin) { origin_ = origin; }

  /// Adds an error about a node. It is made by diagnoseCounted(), as those of the four functions below.
  void addNode(Diagnostic found, NodeId node);
  void addNodePair(Diagnostic found, NodeId a, NodeId b);
  void addTriangle(Diagnostic found, TriangleId triangle);
  void addTrianglePair(Diagnostic found, TriangleId a, TriangleId b, const Vec3& position);
  /// `triangles`: the triangles at the edge.
  void addEdge(Diagnostic found, NodeId from, NodeId to, std::span<const TriangleId> triangles);
  /// Adds a diagnostic with all its values as one of severity kInformation; its position is relative to the origin.
  void addInformation(Diagnostic found);
  /// Reports the numbers of regions and cavities; `triangle` belongs to the second shell.
  void addNesting(TriangleId triangle, std::uint32_t regions, std::uint32_t cavities);
  /// Reports the numbers of edges and nodes at which the surface touches itself; `triangle` is at the first one.
  void addContact(TriangleId triangle, const Vec3& position, std::size_t edges, std::size_t nodes);
  void addEmpty();
  /// Reports that the last node or triangle has fewer than three numbers; `index` is its index.
  void addIncomplete(EntityKind kind, std::size_t index);

  [[nodiscard]] bool hasErrors() const { return errors_ > 0; }
  /// Maximum number of diagnostics kept of each code.
  [[nodiscard]] std::size_t maxDiagnostics() const { return maxDiagnostics_; }
  /// Declares the total of a code a lower bound, because the search ended early.
  void setLowerBound(DiagnosticCode code) { totalOf(code).isLowerBound = true; }
  /// Returns false if no further diagnostic of this code is kept: its position need not be computed.
  [[nodiscard]] bool canKeep(DiagnosticCode code) { return totalOf(code).kept < maxDiagnostics_; }

  /// Returns all diagnostics, complete with totals, and forgets them.
  [[nodiscard]] std::vector<Diagnostic> take();

 private:
  static constexpr std::size_t kMaxTriangles = 200;
  static constexpr std::size_t kCodes = 64;  ///< above all codes
  static constexpr std::size_t kNotKept = static_cast<std::size_t>(-1);

  struct Total {
    std::uint64_t reported = 0;
    std::size_t kept = 0;
    bool isLowerBound = false;
  };
  struct Entry {
    Diagnostic diagnostic;
    std::uint64_t count = 0;              ///< reports with the same entities; drawn models only
    std::vector<TriangleId> triangles{};  ///< of a drawn model, without duplicates
    bool hasTotal = true;
  };
  /// A side of a divided line.
  struct Side {
    NodeId low;
    NodeId high;
    LineId line;
    friend auto operator<=>(const Side&, const Side&) = default;
  };

  /// `triangles`: the triangles concerned, if the entities are lines and patches.
  void add(Diagnostic found, const Vec3& position, std::span<const TriangleId> triangles = {});
  static void addTriangles(Entry& entry, std::span<const TriangleId> triangles);
  [[nodiscard]] Total& totalOf(DiagnosticCode code) {
    return totals_[static_cast<std::size_t>(code)];
  }
  [[nodiscard]] bool isDrawn() const { return source_ == BoundarySource::kDrawnPatches; }
  [[nodiscard]] Entity patchOf(TriangleId triangle) const;
  /// Returns the line that has a side between the nodes, if there is one.
  [[nodiscard]] std::optional<LineId> lineOf(NodeId a, NodeId b);

  const SurfaceMesh& mesh_;
  BoundarySource source_;
  Vec3 origin_{0.0};
  std::size_t maxDiagnostics_;
  std::size_t errors_ = 0;
  std::vector<Entry> entries_;
  std::array<Total, kCodes> totals_;  ///< by code
  /// Indices in entries_, or kNotKept, by code and entities; drawn models only.
  std::map<std::pair<DiagnosticCode, std::vector<std::uint64_t>>, std::size_t> known_;
  std::vector<Side> sides_;  ///< sorted; filled at the first query
};

}  // namespace tetrafront
