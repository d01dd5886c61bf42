#pragma once

/// @file The engine's results and options as JavaScript objects.

#include <emscripten/val.h>

#include <cstdint>
#include <string>
#include <vector>

#include "model_arrays.h"
#include "tetrafront/background_grid.h"
#include "tetrafront/preview.h"
#include "tetrafront/size_proposals.h"
#include "tetrafront/status.h"
#include "typed_arrays.h"

namespace tetrafront::border {

struct Options {
  double size = 0.0;
  double growth = 0.0;
  double gradation = 0.0;
  std::uint32_t innerShells = 0;
  std::uint32_t order = 0;
  bool filters = true;
  std::uint32_t optimization = 0;
  bool exactFillOnly = false;
};

/// All diagnostics in a few arrays, because there may be a million.
struct DiagnosticArrays {
  /// Per diagnostic: code, severity, number of entities, 1 with a position, number of values.
  Uint32Array heads = copyOut(std::vector<std::uint32_t>{});
  /// Kind and index per entity, one diagnostic after the other.
  Uint32Array entities = heads;
  /// x y z of the diagnostics that have a position.
  Float64Array positions = copyOut(std::vector<double>{});
  Float64Array values = positions;
};

/// JavaScript array of PatchSummary.
EMSCRIPTEN_DECLARE_VAL_TYPE(PatchSummaries)

struct SurfaceArrays {
  Float64Array points = copyOut(std::vector<double>{});
  Uint32Array triangles = copyOut(std::vector<std::uint32_t>{});
  Uint32Array trianglePatch = triangles;
  Uint32Array triangleRegions = triangles;
  Uint32Array sides = triangles;
  Uint32Array sideLine = triangles;
};

struct VolumeArrays {
  Float64Array points = copyOut(std::vector<double>{});
  Uint32Array tetrahedra = copyOut(std::vector<std::uint32_t>{});
  Uint32Array regions = tetrahedra;
  Uint32Array front = tetrahedra;
};

struct ProgressRecord {
  std::uint32_t phase = 0;
  double fraction = 0.0;
  std::uint32_t nodes = 0;
  std::uint32_t triangles = 0;
  std::uint32_t tetrahedra = 0;
  std::uint32_t frontFaces = 0;
  std::uint32_t expectedTetrahedra = 0;
  double exactFillFraction = 0.0;
};

struct PreviewRecord {
  Float64Array linePoints = copyOut(std::vector<double>{});
  Uint32Array lineOffsets = copyOut(std::vector<std::uint32_t>{});
  Float64Array patchPoints = linePoints;
  Uint32Array patchTriangles = lineOffsets;
  Uint32Array patchOffsets = lineOffsets;
  DiagnosticArrays diagnostics;
};

/// FrontCounters as JavaScript numbers, exact up to 2^53.
struct CounterRecord {
  double pops = 0.0;
  double gatheredFaces = 0.0;
  double candidatesTried = 0.0;
  double facesTested = 0.0;
  double facesAnalysed = 0.0;
  double exactPredicates = 0.0;
};

/// Background grid returned to JavaScript. It has no stretching: none of the tools that make grids
/// adds any.
struct GridRecord {
  Float64Array points = copyOut(std::vector<double>{});
  Float64Array sizes = points;
  Uint32Array tetrahedra = copyOut(std::vector<std::uint32_t>{});
  double coverageMargin = 0.0;
};

struct ProposalRecord {
  double size = 0.0;
  Uint8Array sourceTypes = copyOut(std::vector<std::uint8_t>{});
  Float64Array sourceValues = copyOut(std::vector<double>{});
};

inline DiagnosticArrays toArrays(const std::vector<Diagnostic>& diagnostics) {
  std::vector<std::uint32_t> heads;
  std::vector<std::uint32_t> entities;
  std::vector<double> positions;
  std::vector<double> values;
  for (const Diagnostic& d : diagnostics) {
    heads.insert(heads.end(),
                 {static_cast<std::uint32_t>(d.code), static_cast<std::uint32_t>(d.severity),
                  static_cast<std::uint32_t>(d.entities.size()), d.hasPosition ? 1U : 0U,
                  static_cast<std::uint32_t>(d.values.size())});
    for (const Entity& entity : d.entities) {
      entities.insert(entities.end(), {static_cast<std::uint32_t>(entity.kind), entity.index});
    }
    if (d.hasPosition)
      positions.insert(positions.end(), {d.position.x, d.position.y, d.position.z});
    values.insert(values.end(), d.values.begin(), d.values.end());
  }
  return {.heads = copyOut(heads),
          .entities = copyOut(entities),
          .positions = copyOut(positions),
          .values = copyOut(values)};
}

inline PreviewRecord toRecord(const ModelPreview& drawn) {
  return {.linePoints = copyOut(drawn.linePoints),
          .lineOffsets = copyOut(drawn.lineOffsets),
          .patchPoints = copyOut(drawn.patchPoints),
          .patchTriangles = copyOut(drawn.patchTriangles),
          .patchOffsets = copyOut(drawn.patchOffsets),
          .diagnostics = toArrays(drawn.diagnostics)};
}

/// Returns sixteen hexadecimal digits: a JavaScript number cannot hold 64 bits exactly.
inline std::string toHex(std::uint64_t value) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text(16, '0');
  for (auto digit = text.rbegin(); digit != text.rend(); ++digit, value >>= 4) {
    *digit = kDigits[value & 15];
  }
  return text;
}

inline PatchSummaries toSummaries(const std::vector<PatchSummary>& summaries) {
  auto records = emscripten::val::array();
  for (const PatchSummary& summary : summaries) records.call<void>("push", summary);
  return PatchSummaries{records};
}

inline GridRecord toRecord(const BackgroundGrid& grid) {
  std::vector<double> points;
  std::vector<double> sizes;
  std::vector<std::uint32_t> corners;
  points.reserve(3 * grid.nodes.size());
  sizes.reserve(grid.nodes.size());
  corners.reserve(4 * grid.tetrahedra.size());
  for (const BackgroundNode& node : grid.nodes) {
    points.insert(points.end(), {node.position.x, node.position.y, node.position.z});
    sizes.push_back(node.size);
  }
  for (const auto& tetrahedron : grid.tetrahedra) {
    corners.insert(corners.end(), tetrahedron.begin(), tetrahedron.end());
  }
  return {.points = copyOut(points),
          .sizes = copyOut(sizes),
          .tetrahedra = copyOut(corners),
          .coverageMargin = grid.coverageMargin};
}

inline ProposalRecord toRecord(const SizeProposal& proposal) {
  std::vector<std::uint8_t> types;
  std::vector<double> values;
  for (const SizeSource& source : proposal.sources) {
    types.push_back(static_cast<std::uint8_t>(source.type));
    for (const Vec3& point : source.points) {
      values.insert(values.end(), {point.x, point.y, point.z});
    }
    values.insert(values.end(), {source.size, source.distance, source.growth});
  }
  return {.size = proposal.size, .sourceTypes = copyOut(types), .sourceValues = copyOut(values)};
}

}  // namespace tetrafront::border
