#pragma once

/// @file What the boundary check has to say: names lines and patches for a drawn model, triangles
/// for a given surface, and keeps a million findings of one kind from becoming a million messages
/// unless they are asked for.

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "tetrafront/mesh.h"
#include "tetrafront/status.h"
#include "tetrafront/surface_tools.h"

namespace tetrafront {

/// Where a boundary comes from, which decides how findings are named.
enum class BoundarySource : std::uint8_t {
  kDrawnPatches,  ///< SurfaceMesh::trianglePatch, sides and sideLine are filled
  kGivenSurface,  ///< points and triangles only
};

/// Collects findings. Of each code the first `maxDiagnostics` are kept; the last of their `values` is the
/// number of findings of that code in all (for a drawn model: with the same entities), and after it
/// comes a 1 where the search was ended early, so that it is at least so many. A entry in a drawn
/// model names lines and patches first, then its triangles, up to kMaxTriangles of all findings with
/// the same lines and patches.
class BoundaryReport {
 public:
  BoundaryReport(const SurfaceMesh& mesh, BoundarySource source,
                 std::size_t maxDiagnostics = kListedFindings)
      : mesh_(mesh), source_(source), maxDiagnostics_(maxDiagnostics) {}

  void addNode(DiagnosticCode code, std::uint32_t node, std::vector<double> values);
  void addNodePair(DiagnosticCode code, std::uint32_t a, std::uint32_t b);
  void addTriangle(DiagnosticCode code, std::uint32_t triangle, std::vector<double> values = {});
  void addTrianglePair(DiagnosticCode code, std::uint32_t a, std::uint32_t b, const Vec3& place);
  /// `triangles`: those that meet at the edge.
  void addEdge(DiagnosticCode code, std::uint32_t from, std::uint32_t to,
               std::span<const std::uint32_t> triangles);
  /// Not counted with others of its kind.
  void addInformation(DiagnosticCode code, std::vector<Entity> entities, const Vec3& place,
                      std::vector<double> values);
  /// Information: so many regions and cavities; `triangle` is one of the second of these.
  void addNesting(std::uint32_t triangle, std::uint32_t regions, std::uint32_t cavities);
  void addEmpty();
  /// The last node or triangle is incomplete; `index` is its place.
  void addIncomplete(EntityKind kind, std::size_t index);

  [[nodiscard]] bool hasErrors() const { return errors_ > 0; }
  /// Of each code.
  [[nodiscard]] std::size_t maxDiagnostics() const { return maxDiagnostics_; }
  /// There may be more findings of that code than were looked for.
  void setIncomplete(DiagnosticCode code) { kindOf(code).setIncomplete = true; }
  /// False if no further entry of that code will be kept: its place need not be found.
  [[nodiscard]] bool keepsNext(DiagnosticCode code) { return kindOf(code).kept < maxDiagnostics_; }

  /// Everything, with the counts filled in.
  [[nodiscard]] std::vector<Diagnostic> take();

  [[nodiscard]] Vec3 centroidOf(std::uint32_t triangle) const;

 private:
  static constexpr std::size_t kMaxTriangles = 200;
  static constexpr std::size_t kCodes = 64;  ///< all are below this
  static constexpr std::size_t kNotKept = static_cast<std::size_t>(-1);

  struct Kind {
    std::uint64_t total = 0;
    std::size_t kept = 0;
    bool setIncomplete = false;
  };
  struct Entry {
    Diagnostic diagnostic;
    std::uint64_t count = 0;               ///< with the same entities; drawn models only
    std::vector<std::uint32_t> triangles;  ///< of a drawn model, each once
    bool isCounted = true;
  };

  /// `triangles`: those concerned, where the entities are lines and patches.
  void add(DiagnosticCode code, std::vector<Entity> entities, const Vec3& place,
           std::vector<double> values, std::span<const std::uint32_t> triangles = {});
  static void addTriangles(Entry& entry, std::span<const std::uint32_t> triangles);
  [[nodiscard]] Kind& kindOf(DiagnosticCode code) { return kinds_[static_cast<std::size_t>(code)]; }
  [[nodiscard]] bool isDrawn() const { return source_ == BoundarySource::kDrawnPatches; }
  [[nodiscard]] Entity patchOf(std::uint32_t triangle) const;
  [[nodiscard]] bool lineOf(std::uint32_t a, std::uint32_t b, std::uint32_t& line);

  const SurfaceMesh& mesh_;
  BoundarySource source_;
  std::size_t maxDiagnostics_;
  std::size_t errors_ = 0;
  std::vector<Entry> entries_;
  std::array<Kind, kCodes> kinds_;  ///< by code
  /// Findings of a drawn model by code and entities.
  std::map<std::pair<DiagnosticCode, std::vector<std::uint64_t>>, std::size_t> known_;
  /// Sides as {lower node, higher node, line}, sorted when first asked for.
  std::vector<std::array<std::uint32_t, 3>> sides_;
};

}  // namespace tetrafront
