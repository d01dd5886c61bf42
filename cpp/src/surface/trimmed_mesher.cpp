#include "surface/trimmed_mesher.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "base/diagnostics.h"
#include "base/sort.h"
#include "sizing/expected_count.h"
#include "surface/line_mesher.h"
#include "surface/rules.h"
#include "surface/surface_trace.h"
#include "surface/trimmed_boundary.h"

namespace tetrafront {

namespace {

/// Part of the progress for dividing the edges and checking the loops.
constexpr double kEdgesEnd = 0.1;
/// Sides or triangles per unit of the budget.
constexpr std::size_t kPerUnit = 4;
/// Rounding of the angle by which an edge turns, in sides: a circle of six sides turns by six of them, and not by one more.
constexpr double kTurningMargin = 1e-6;
/// Size at an inner node that is connected to both copies of a node / length of such an edge.
constexpr double kSizeAtDoubleEdge = 0.5;

/// Divides an edge between its stations into equal sides of about the target size.
LineDivision divideBetween(const EdgeCurve& curve, const SizeField& field, std::uint32_t minSides,
                           std::span<const double> stations) {
  LineDivision division;
  FieldHint hint;
  const auto intervals = static_cast<double>(stations.size() - 1);
  const double fewest = std::ceil(minSides / intervals);
  const auto append = [&](double t) {
    division.parameters.push_back(t);
    division.nodes.push_back(curve.position(t));
  };
  append(stations.front());
  for (std::size_t i = 1; i < stations.size(); ++i) {
    const double from = stations[i - 1];
    const double to = stations[i];
    const double length =
        curve.length(from, to) / field.sizeAt(curve.position(0.5 * (from + to)), hint);
    division.length += length;
    const double sides = std::max(fewest, std::floor(length + 0.5));
    if (!(sides <= kMaxSidesPerLine)) {
      division.status = LineDivisionStatus::kTooManySides;
      division.position = curve.position(from);
      division.requiredSides = sides;
      return division;
    }
    for (double k = 1.0; k < sides; k += 1.0) append(from + (to - from) * (k / sides));
    append(to);
  }
  return division;
}

/// An edge between an inner node and one copy of a boundary node.
struct InnerEdge {
  PlanarNodeId inner;
  NodeId surfaceNode;
  PlanarNodeId boundary;

  friend auto operator<=>(const InnerEdge&, const InnerEdge&) = default;
};

/// Returns smaller sizes at the inner nodes that are connected to both copies of a node of a seam: these edges are the
/// same edge of the surface, which would have four triangles.
std::vector<SizeSource> sourcesAtDoubleEdges(const PlanarMesh& mesh) {
  std::vector<InnerEdge> edges;
  for (const PlanarMesh::Triangle& triangle : mesh.triangles) {
    for (const PlanarNodeId inner : triangle) {
      if (mesh.isBoundary(inner)) continue;
      for (const PlanarNodeId other : triangle)
        if (mesh.isBoundary(other))
          edges.push_back({inner, mesh.surfaceNodes[other.index()], other});
    }
  }
  sortUnique(edges);
  std::vector<SizeSource> sources;
  for (std::size_t i = 1; i < edges.size(); ++i) {
    const InnerEdge& edge = edges[i];
    if (edge.inner != edges[i - 1].inner || edge.surfaceNode != edges[i - 1].surfaceNode) continue;
    const Vec3& position = mesh.positionOf(edge.inner);
    const double length = glm::length(mesh.positionOf(edge.boundary) - position);
    SizeSource& source = sources.emplace_back();
    source.type = SourceType::kPoint;
    source.points[0] = position;
    source.size = kSizeAtDoubleEdge * length;
    source.distance = length;
    source.growth = kBentEdgeGrowth;
  }
  return sources;
}

}  // namespace

TrimmedMesher::TrimmedMesher(const TrimmedModel& model, const SizeField& field,
                             std::uint32_t maxTetrahedra, std::vector<std::vector<double>> stations)
    : model_(&model),
      field_(&field),
      maxTetrahedra_(maxTetrahedra),
      stations_(std::move(stations)),
      separated_(model.faces.size()) {}

MeshStatus TrimmedMesher::advance(std::uint32_t budget) {
  if (!job_.advance(budget)) return MeshStatus::kRunning;
  return diagnostics_.empty() ? MeshStatus::kDone : MeshStatus::kInvalidInput;
}

Task<> TrimmedMesher::meshSurface(Work& work) {
  findUsedEdges();
  layOutFaces();
  if (!diagnostics_.empty()) co_return;
  work.beginPart(0.5 * kEdgesEnd);
  co_await divideEdges(work);
  if (!diagnostics_.empty()) co_return;
  work.beginPart(kEdgesEnd);
  co_await makeLoopsSimple(work);
  if (!diagnostics_.empty()) co_return;
  phase_ = Phase::kSurface;
  writeEdges();
  work.beginPart(1.0);
  co_await meshFaces(work);
  if (!diagnostics_.empty()) co_return;
  for (const PatchId face : IdRange<PatchId>(model_->faces.size())) append(face);
}

// ---- edges ---------------------------------------------------------------------------------------

void TrimmedMesher::findUsedEdges() {
  isUsed_.assign(model_->edges.size(), 0);
  for (const TrimmedFace& face : model_->faces) {
    for (const std::vector<Coedge>& loop : face.loops) {
      for (const Coedge& coedge : loop) {
        const TrimmedEdge& edge = model_->edges[coedge.edge];
        if (!edge.curve) continue;
        isUsed_[coedge.edge] = 1;
        vertices_.insert(vertices_.end(), {edge.start, edge.end});
      }
    }
  }
  sortUnique(vertices_);
}

/// An edge has a side for each kMaxTurningPerSide of its tangent. As for drawn lines, a closed edge has at least
/// kMinSidesAtSeam sides, and edges between the same vertices kMinSidesOfParallelLine.
void TrimmedMesher::findMinSides() {
  minSides_.assign(model_->edges.size(), 1);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> edgeBetween;
  for (std::uint32_t e = 0; e < model_->edges.size(); ++e) {
    if (isUsed_[e] == 0) continue;
    const TrimmedEdge& edge = model_->edges[e];
    const double turns = curveOf(LineId(e)).turning() / kMaxTurningPerSide;
    minSides_[e] = std::max(1U, static_cast<std::uint32_t>(std::ceil(turns - kTurningMargin)));
    if (edge.start == edge.end) {
      minSides_[e] = std::max(minSides_[e], kMinSidesAtSeam);
      continue;
    }
    const auto [entry, isFirst] = edgeBetween.try_emplace(std::minmax(edge.start, edge.end), e);
    if (isFirst) continue;
    for (const std::uint32_t parallel : {e, entry->second})
      minSides_[parallel] = std::max(minSides_[parallel], kMinSidesOfParallelLine);
  }
}

Task<> TrimmedMesher::divideEdges(Work& work) {
  findMinSides();
  lines_.divisions.resize(model_->edges.size());
  lines_.nodes.resize(model_->edges.size());
  co_await divideEachEdge(work);
  if (diagnostics_.empty() && addSourcesAtBentEdges()) co_await divideEachEdge(work);
}

/// Caps the sizes near edges that turn too much for the sizes there. Returns true if there are any.
bool TrimmedMesher::addSourcesAtBentEdges() {
  std::vector<SizeSource> sources;
  for (const LineDivision& division : lines_.divisions) {
    const auto sides = static_cast<double>(division.sideCount());
    if (!(sides > division.length + 0.5)) continue;
    for (std::size_t i = 0; i < division.sideCount(); ++i) {
      SizeSource& source = sources.emplace_back();
      source.type = SourceType::kSegment;
      source.points = {division.nodes[i], division.nodes[i + 1], Vec3(0.0)};
      source.size = glm::length(division.nodes[i + 1] - division.nodes[i]);
      source.growth = kBentEdgeGrowth;
    }
  }
  if (sources.empty()) return false;
  gradedField_.emplace(*field_);
  gradedField_->addSources(sources);
  field_ = &*gradedField_;
  return true;
}

LineDivision TrimmedMesher::divisionOf(LineId edge) const {
  const std::uint32_t minSides = minSides_[edge.index()];
  const bool hasStations = !stations_.empty() && !stations_[edge.index()].empty();
  if (hasStations) return divideBetween(curveOf(edge), *field_, minSides, stations_[edge.index()]);
  return divideLine(curveOf(edge), *field_, minSides, NullSurfaceTrace{});
}

/// Divides every edge, also after a failure, so that the user gets all diagnostics at once.
Task<> TrimmedMesher::divideEachEdge(Work& work) {
  for (const LineId edge : IdRange<LineId>(model_->edges.size())) {
    if (isUsed_[edge.index()] == 0) continue;
    LineDivision& division = lines_.divisions[edge.index()];
    division = divisionOf(edge);
    if (division.status == LineDivisionStatus::kOutsideGrid)
      diagnostics_.push_back(diagnose<DiagnosticCode::kOutsideBackgroundGrid>()
                                 .about({entityOf(edge)})
                                 .at(division.position));
    if (division.status == LineDivisionStatus::kTooManySides)
      diagnostics_.push_back(
          tooManySides(division.requiredSides).about({entityOf(edge)}).at(division.position));
    co_await work.spend(division.sideCount() / kPerUnit + 1);
  }
}

void TrimmedMesher::numberNodes() {
  const auto nodeAt = [&](std::uint32_t vertex) {
    const auto entry = std::ranges::lower_bound(vertices_, vertex);
    return NodeId(static_cast<std::size_t>(entry - vertices_.begin()));
  };
  std::size_t next = vertices_.size();
  for (std::size_t e = 0; e < model_->edges.size(); ++e) {
    if (isUsed_[e] == 0) continue;
    std::vector<NodeId>& nodes = lines_.nodes[e];
    nodes.assign(lines_.divisions[e].nodes.size(), {});
    nodes.front() = nodeAt(model_->edges[e].start);
    nodes.back() = nodeAt(model_->edges[e].end);
    for (std::size_t i = 1; i + 1 < nodes.size(); ++i) nodes[i] = NodeId(next++);
  }
  lines_.nodeCount = static_cast<std::uint32_t>(next);
}

void TrimmedMesher::writeEdges() {
  const auto append = [&](const Vec3& position) {
    mesh_.points.insert(mesh_.points.end(), {position.x, position.y, position.z});
  };
  for (const std::uint32_t vertex : vertices_) append(model_->vertices[vertex]);
  for (std::uint32_t e = 0; e < model_->edges.size(); ++e) {
    const std::vector<NodeId>& nodes = lines_.nodes[e];
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      if (i > 0) append(lines_.divisions[e].nodes[i]);
      mesh_.sides.insert(mesh_.sides.end(), {nodes[i].value, nodes[i + 1].value});
      mesh_.sideLine.push_back(e);
    }
  }
}

// ---- loops ---------------------------------------------------------------------------------------

void TrimmedMesher::layOutFaces() {
  loops_.reserve(model_->faces.size());
  planes_.reserve(model_->faces.size());
  for (const PatchId face : IdRange<PatchId>(model_->faces.size())) {
    const TrimmedFace& trimmed = model_->faces[face.index()];
    const FaceLoops& loops = loops_.emplace_back(*model_, trimmed);
    if (loops.isUsable()) {
      planes_.emplace_back(model_->surfaces[trimmed.surface], loops.box(), loops.poles());
    } else if (loops.open()) {
      const Coedge& coedge = *loops.loops()[loops.open()->loop][loops.open()->index];
      const TrimmedEdge& edge = model_->edges[coedge.edge];
      const std::uint32_t vertex = coedge.reversed ? edge.end : edge.start;
      diagnostics_.push_back(
          diagnose<DiagnosticCode::kLoopNotClosed>()
              .about({entityOf(face), entityOf(LineId(coedge.edge)), entityOf(PointId(vertex))})
              .at(model_->vertices[vertex]));
    } else {
      diagnostics_.push_back(diagnose<DiagnosticCode::kDegeneratePatch>().about({entityOf(face)}));
    }
  }
}

/// Halves sides until no loops intersect, as SurfaceMesher does.
Task<> TrimmedMesher::makeLoopsSimple(Work& work) {
  numberNodes();
  for (int round = 0; true; ++round) {
    std::set<LineSide> halvings;
    for (const PatchId face : IdRange<PatchId>(model_->faces.size())) {
      checkLoops(face, round < kMaxHalvingRounds, halvings);
      co_await work.spend(1);
    }
    if (!diagnostics_.empty() || halvings.empty()) co_return;
    // In descending order, so that the indices of the other sides stay valid.
    for (auto entry = halvings.rbegin(); entry != halvings.rend(); ++entry)
      halveSide(curveOf(entry->first), entry->second, lines_.divisions[entry->first.index()]);
    numberNodes();
  }
}

void TrimmedMesher::checkLoops(PatchId face, bool canHalve, std::set<LineSide>& halvings) {
  const PatchBoundary boundary = separatedBoundary(face, *field_);
  const std::vector<std::uint32_t> invalid = findInvalidSides(boundary);
  std::vector<LineId> edges;
  for (const std::uint32_t side : invalid) {
    const auto& [edge, edgeSide] = boundary.origins[side];
    if (canHalve) halvings.emplace(edge, edgeSide);
    edges.push_back(edge);
  }
  if (canHalve || invalid.empty()) return;
  sortUnique(edges);
  diagnostics_.push_back(
      diagnose<DiagnosticCode::kLoopsIntersect>()
          .about(patchAndLines(face, edges))
          .at(boundary.mesh.positionOf(boundary.mesh.sides[invalid.front()].from)));
}

// ---- faces ---------------------------------------------------------------------------------------

/// Triangulates all faces, and then again those that share an edge between the same nodes other than a side.
Task<> TrimmedMesher::meshFaces(Work& work) {
  const std::size_t count = model_->faces.size();
  triangulations_.resize(count);
  std::vector<PatchId> pending;
  for (const PatchId face : IdRange<PatchId>(count)) pending.push_back(face);
  for (int round = 0; !pending.empty(); ++round) {
    for (std::size_t i = 0; i < pending.size(); ++i) {
      work.beginPart(static_cast<double>(i + 1) / static_cast<double>(pending.size()));
      co_await meshFace(work, pending[i]);
    }
    if (!diagnostics_.empty() || round == kMaxSeparationRounds) co_return;
    pending = findFacesToSeparate();
    co_await work.spend(1);
  }
}

/// Triangulates a face; again with smaller sizes where it would meet itself across a seam.
Task<> TrimmedMesher::meshFace(Work& work, PatchId face) {
  const PatchSurface surface(planes_[face.index()]);
  SizeField field = *field_;
  for (int round = 0; round <= kMaxSeparationRounds; ++round) {
    PatchMesher mesher(surface, field, separatedBoundary(face, field));
    while (!mesher.advance(work.remaining())) co_await work.yield();
    co_await work.spend(mesher.mesh().triangles.size() / kPerUnit + 1);
    if (mesher.hasTooManyTriangles()) {
      const auto triangles = static_cast<double>(mesher.mesh().triangles.size());
      diagnostics_.push_back(tooManySides(std::sqrt(0.5 * triangles)).about({entityOf(face)}));
      co_return;
    }
    if (!mesher.isComplete()) break;
    const std::vector<SizeSource> sources = sourcesAtDoubleEdges(mesher.mesh());
    if (sources.empty()) {
      take(face, mesher.mesh());
      co_return;
    }
    field.addSources(sources);
  }
  diagnostics_.push_back(diagnose<DiagnosticCode::kDegeneratePatch>().about({entityOf(face)}));
}

/// Lays out a face and marks its separated nodes.
PatchBoundary TrimmedMesher::separatedBoundary(PatchId face, const SizeField& field) const {
  PatchBoundary boundary = layOutFace(loops_[face.index()], planes_[face.index()], field, lines_);
  const std::vector<NodeId>& separated = separated_[face.index()];
  if (separated.empty()) return boundary;
  for (const NodeId node : boundary.mesh.surfaceNodes)
    boundary.mesh.separated.push_back(std::ranges::binary_search(separated, node) ? 1 : 0);
  return boundary;
}

void TrimmedMesher::take(PatchId face, const PlanarMesh& planar) {
  Triangulation& taken = triangulations_[face.index()];
  taken = {};
  taken.nodes.assign(planar.positions.begin() + planar.boundaryCount, planar.positions.end());
  const auto nodeOf = [&](PlanarNodeId node) {
    return planar.isBoundary(node) ? planar.surfaceNodes[node.index()]
                                   : NodeId(lines_.nodeCount + (node.value - planar.boundaryCount));
  };
  const bool isReversed = model_->faces[face.index()].reversed;
  for (const auto& [a, b, c] : planar.triangles)
    taken.triangles.push_back({nodeOf(a), nodeOf(isReversed ? c : b), nodeOf(isReversed ? b : c)});
  collectChords(face, planar, taken.chords);
}

/// Finds edges between the same two nodes that faces, or two parts of a closed face, have in common without being a side.
/// Their nodes become separated in the faces that are not planes: in a plane, further nodes separate nothing.
std::vector<PatchId> TrimmedMesher::findFacesToSeparate() {
  std::vector<Chord> chords;
  for (const Triangulation& face : triangulations_)
    chords.insert(chords.end(), face.chords.begin(), face.chords.end());
  for (Chord& chord : chords) std::ranges::sort(chord.nodes);
  stableSort(chords, [](const Chord& a, const Chord& b) { return a.nodes < b.nodes; });
  std::vector<PatchId> faces;
  for (std::size_t i = 0; i < chords.size(); ++i) {
    const Chord& chord = chords[i];
    const bool isRepeated = (i > 0 && chords[i - 1].nodes == chord.nodes) ||
                            (i + 1 < chords.size() && chords[i + 1].nodes == chord.nodes);
    const TrimmedFace& face = model_->faces[chord.patch.index()];
    if (!isRepeated || model_->surfaces[face.surface].kind == SurfaceKind::kPlane) continue;
    std::vector<NodeId>& separated = separated_[chord.patch.index()];
    const std::size_t before = separated.size();
    separated.insert(separated.end(), chord.nodes.begin(), chord.nodes.end());
    sortUnique(separated);
    if (separated.size() > before) faces.push_back(chord.patch);
  }
  sortUnique(faces);
  return faces;
}

Diagnostic TrimmedMesher::tooManySides(double sides) const {
  return tooManyElements(kTetrahedraPerUnitVolume * sides * sides * sides, maxTetrahedra_);
}

/// Appends a triangulation to the mesh, and frees its memory.
void TrimmedMesher::append(PatchId face) {
  const Triangulation taken = std::exchange(triangulations_[face.index()], {});
  const auto shift = static_cast<std::uint32_t>(mesh_.points.size() / 3) - lines_.nodeCount;
  for (const Vec3& position : taken.nodes)
    mesh_.points.insert(mesh_.points.end(), {position.x, position.y, position.z});
  for (const NodeTriple& triangle : taken.triangles)
    for (const NodeId node : triangle)
      mesh_.triangles.push_back(node.value < lines_.nodeCount ? node.value : node.value + shift);
  mesh_.trianglePatch.insert(mesh_.trianglePatch.end(), taken.triangles.size(), face.value);
}

}  // namespace tetrafront
