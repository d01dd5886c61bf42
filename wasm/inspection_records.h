#pragma once

/// @file Results of inspecting, repairing and refining given surfaces and meshes, as JavaScript
/// objects.

#include <cstdint>
#include <vector>

#include "records.h"
#include "statistics_record.h"
#include "tetrafront/mesh_inspection.h"
#include "tetrafront/surface_tools.h"
#include "typed_arrays.h"

namespace tetrafront::border {

struct SurfaceInspectionRecord {
  bool isFillable = false;
  bool isClosed = false;
  bool isManifold = false;
  bool isEmbedded = false;
  std::uint32_t nodes = 0;
  std::uint32_t unusedNodes = 0;
  std::uint32_t triangles = 0;
  std::uint32_t edges = 0;
  std::uint32_t openEdges = 0;
  std::uint32_t nonManifoldEdges = 0;
  std::uint32_t nonManifoldNodes = 0;
  std::uint32_t flippedTriangles = 0;
  std::uint32_t regions = 0;
  /// x y z of the lowest corner, then of the highest.
  Float64Array box = copyOut(std::vector<double>{});
  double area = 0.0;
  double volume = 0.0;
  /// Shortest, mean, longest.
  Float64Array edgeLengths = box;
  /// Per shell: first triangle, number of triangles, region, 1 for a cavity, area, volume.
  Float64Array shells = box;
  /// Per triangle: index, x y z of the centroid, area, smallest angle, radius ratio.
  Float64Array worst = box;
  DiagnosticArrays diagnostics;
};

struct RepairRecord {
  Float64Array points = copyOut(std::vector<double>{});
  Uint32Array triangles = copyOut(std::vector<std::uint32_t>{});
  Uint32Array origin = triangles;
  Uint8Array kinds = copyOut(std::vector<std::uint8_t>{});
  /// Two numbers per change; its x y z are in `positions`.
  Uint32Array subjects = triangles;
  Float64Array positions = points;
  DiagnosticArrays diagnostics;
};

struct RefinementRecord {
  Float64Array points = copyOut(std::vector<double>{});
  Uint32Array triangles = copyOut(std::vector<std::uint32_t>{});
  Uint32Array origin = triangles;
  std::uint32_t splitEdges = 0;
  DiagnosticArrays diagnostics;
};

struct MeshInspectionRecord {
  bool isReadable = false;
  std::uint32_t nodes = 0;
  std::uint32_t unusedNodes = 0;
  std::uint32_t tetrahedra = 0;
  std::uint32_t invertedTetrahedra = 0;
  std::uint32_t degenerateTetrahedra = 0;
  std::uint32_t duplicateTetrahedra = 0;
  std::uint32_t nonManifoldFaces = 0;
  std::uint32_t overlappingFaces = 0;
  std::uint32_t coincidentNodes = 0;
  /// Shortest, mean, longest.
  Float64Array edgeLengths = copyOut(std::vector<double>{});
  QualitySummary quality;
  StatisticsRecord statistics;
  Uint32Array boundary = copyOut(std::vector<std::uint32_t>{});
  Uint32Array boundaryRegion = boundary;
};

[[nodiscard]] inline Float64Array flatShells(const std::vector<ShellInfo>& shells) {
  std::vector<double> flat;
  for (const ShellInfo& s : shells) {
    flat.insert(flat.end(),
                {static_cast<double>(s.firstTriangle), static_cast<double>(s.triangles),
                 static_cast<double>(s.region), s.isCavity ? 1.0 : 0.0, s.area, s.volume});
  }
  return copyOut(flat);
}

[[nodiscard]] inline Float64Array flatTriangles(const std::vector<TriangleQuality>& triangles) {
  std::vector<double> flat;
  for (const TriangleQuality& t : triangles) {
    flat.insert(flat.end(), {static_cast<double>(t.triangle), t.centroid.x, t.centroid.y,
                             t.centroid.z, t.area, t.smallestAngle, t.radiusRatio});
  }
  return copyOut(flat);
}

[[nodiscard]] inline SurfaceInspectionRecord toRecord(const SurfaceInspection& found) {
  const std::vector<double> box{found.low.x,  found.low.y,  found.low.z,
                                found.high.x, found.high.y, found.high.z};
  const std::vector<double> lengths{found.shortestEdge, found.meanEdge, found.longestEdge};
  return {.isFillable = found.isFillable,
          .isClosed = found.isClosed,
          .isManifold = found.isManifold,
          .isEmbedded = found.isEmbedded,
          .nodes = found.nodes,
          .unusedNodes = found.unusedNodes,
          .triangles = found.triangles,
          .edges = found.edges,
          .openEdges = found.openEdges,
          .nonManifoldEdges = found.nonManifoldEdges,
          .nonManifoldNodes = found.nonManifoldNodes,
          .flippedTriangles = found.flippedTriangles,
          .regions = found.regions,
          .box = copyOut(box),
          .area = found.area,
          .volume = found.volume,
          .edgeLengths = copyOut(lengths),
          .shells = flatShells(found.shells),
          .worst = flatTriangles(found.worst),
          .diagnostics = toArrays(found.diagnostics)};
}

[[nodiscard]] inline RepairRecord toRecord(const SurfaceRepair& repair) {
  std::vector<std::uint8_t> kinds;
  std::vector<std::uint32_t> subjects;
  std::vector<double> positions;
  for (const RepairChange& change : repair.changes) {
    kinds.push_back(static_cast<std::uint8_t>(change.kind));
    subjects.insert(subjects.end(), {change.first, change.second});
    positions.insert(positions.end(), {change.position.x, change.position.y, change.position.z});
  }
  return {.points = copyOut(repair.points),
          .triangles = copyOut(repair.triangles),
          .origin = copyOut(repair.origin),
          .kinds = copyOut(kinds),
          .subjects = copyOut(subjects),
          .positions = copyOut(positions),
          .diagnostics = toArrays(repair.diagnostics)};
}

[[nodiscard]] inline RefinementRecord toRecord(const SurfaceRefinement& refinement) {
  return {.points = copyOut(refinement.points),
          .triangles = copyOut(refinement.triangles),
          .origin = copyOut(refinement.origin),
          .splitEdges = refinement.splitEdges,
          .diagnostics = toArrays(refinement.diagnostics)};
}

[[nodiscard]] inline MeshInspectionRecord toRecord(const MeshInspection& found) {
  const std::vector<double> lengths{found.shortestEdge, found.meanEdge, found.longestEdge};
  return {.isReadable = found.isReadable,
          .nodes = found.nodes,
          .unusedNodes = found.unusedNodes,
          .tetrahedra = found.tetrahedra,
          .invertedTetrahedra = found.invertedTetrahedra,
          .degenerateTetrahedra = found.degenerateTetrahedra,
          .duplicateTetrahedra = found.duplicateTetrahedra,
          .nonManifoldFaces = found.nonManifoldFaces,
          .overlappingFaces = found.overlappingFaces,
          .coincidentNodes = found.coincidentNodes,
          .edgeLengths = copyOut(lengths),
          .quality = found.quality,
          .statistics = toRecord(found.statistics),
          .boundary = copyOut(found.boundary.triangles),
          .boundaryRegion = copyOut(found.boundary.trianglePatch)};
}

}  // namespace tetrafront::border
