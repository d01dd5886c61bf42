#include "placement/model_index.h"

#include <algorithm>
#include <cmath>

#include "base/sort.h"
#include "geom/angles.h"
#include "geom/box.h"
#include "geom/measure.h"
#include "geom/sine.h"
#include "model/edge_curve.h"

namespace tetrafront {

namespace {

/// Cosine of the largest angle between similar normals, and between similar directions.
constexpr double kSimilarNormal = 0.5;
constexpr double kSimilarDirection = 0.7;
/// Largest angle by which an edge turns along a segment, and largest number of segments between two knots.
constexpr double kTurningPerSegment = radians(10.0);
constexpr double kMaxSegments = 256.0;
/// Part of the extent of a face's triangles by which the face may extend beyond them: its edges bend outward.
constexpr double kBeyondTriangles = 0.25;

/// Parts of the corners of a triangle that sum up to a position in its plane.
Vec3 barycentric(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = glm::cross(b - a, c - a);
  const double square = glm::dot(normal, normal);
  if (!(square > 0.0)) return {1.0, 0.0, 0.0};
  const double ofB = glm::dot(glm::cross(p - a, c - a), normal) / square;
  const double ofC = glm::dot(glm::cross(b - a, p - a), normal) / square;
  return {1.0 - ofB - ofC, ofB, ofC};
}

/// Returns where a face may be whose triangles have parameters in `box`.
ParameterBox boxAround(const FaceSurface& surface, const ParameterBox& box) {
  const Vec2 beyond = kBeyondTriangles * (box.high - box.low);
  ParameterBox wide{clampedToDomain(surface, box.low - beyond),
                    clampedToDomain(surface, box.high + beyond)};
  if (surface.kind == SurfaceKind::kCone) {
    // The face is on one side of the apex.
    const double apex = -surface.radius / sineCosine(surface.halfAngle).sine;
    if (box.low.y + box.high.y < 2.0 * apex) {
      wide.high.y = std::min(wide.high.y, apex);
    } else {
      wide.low.y = std::max(wide.low.y, apex);
    }
  }
  return wide;
}

}  // namespace

ModelIndex::ModelIndex(const ReadModel& read, const ModelTriangles& triangles, double sag)
    : read_(&read), triangles_(&triangles), sag_(sag) {
  addTriangles();
  addEdges();
}

Vec3 ModelIndex::pointOf(std::uint32_t node) const {
  const double* at = &triangles_->points[std::size_t{3} * node];
  return {at[0], at[1], at[2]};
}

Vec2 ModelIndex::parametersOf(std::uint32_t node) const {
  const double* at = &triangles_->parameters[std::size_t{2} * node];
  return {at[0], at[1]};
}

void ModelIndex::addTriangles() {
  constexpr double kFar = std::numeric_limits<double>::max();
  const TrimmedModel& model = read_->model;
  boxes_.assign(model.faces.size(), {Vec2(kFar), Vec2(-kFar)});
  const std::size_t nodes =
      std::min(triangles_->points.size() / 3, triangles_->parameters.size() / 2);
  std::vector<Box> boxes;
  for (std::uint32_t t = 0; t < triangles_->faces.size(); ++t) {
    const std::uint32_t face = triangles_->faces[t];
    if (std::size_t{3} * t + 3 > triangles_->triangles.size() || face >= model.faces.size())
      continue;
    const auto corners = nodesOf(t);
    const bool areNodes =
        std::ranges::all_of(corners, [&](std::uint32_t node) { return node < nodes; });
    if (!areNodes || read_->isSurfaceValid[model.faces[face].surface] == 0) continue;
    for (const std::uint32_t node : corners) {
      boxes_[face] = {glm::min(boxes_[face].low, parametersOf(node)),
                      glm::max(boxes_[face].high, parametersOf(node))};
    }
    boxes.push_back(Box::of(pointOf(corners[0]), pointOf(corners[1]), pointOf(corners[2])));
    indexed_.push_back(t);
  }
  for (std::size_t face = 0; face < boxes_.size(); ++face) {
    if (!(boxes_[face].low.x <= boxes_[face].high.x)) continue;
    boxes_[face] = boxAround(model.surfaces[model.faces[face].surface], boxes_[face]);
  }
  triangleTree_ = BoxTree(std::span<const Box>(boxes));
}

void ModelIndex::addEdges() {
  const TrimmedModel& model = read_->model;
  // An edge that one face has twice is a seam.
  std::vector<std::uint32_t> lastFace(model.edges.size(), TrimmedFace::kNone);
  std::vector<std::uint8_t> isSeam(model.edges.size(), 0);
  for (std::uint32_t face = 0; face < model.faces.size(); ++face) {
    for (const std::vector<Coedge>& loop : model.faces[face].loops) {
      for (const Coedge& coedge : loop) {
        if (lastFace[coedge.edge] == face) isSeam[coedge.edge] = 1;
        lastFace[coedge.edge] = face;
      }
    }
  }
  std::vector<std::uint32_t> ends;
  for (std::uint32_t edge = 0; edge < model.edges.size(); ++edge) {
    const TrimmedEdge& trimmed = model.edges[edge];
    const bool isUsed = lastFace[edge] != TrimmedFace::kNone && trimmed.curve.has_value();
    if (!isUsed || isSeam[edge] != 0 || read_->isEdgeValid[edge] == 0) continue;
    addSegments(edge);
    if (trimmed.start != trimmed.end) ends.insert(ends.end(), {trimmed.start, trimmed.end});
  }
  std::vector<Box> boxes;
  for (const Segment& segment : segments_) {
    boxes.push_back(Box::of(segment.start, segment.end, segment.end));
  }
  segmentTree_ = BoxTree(std::span<const Box>(boxes));
  sortUnique(ends);
  boxes.clear();
  for (const std::uint32_t end : ends) {
    vertices_.push_back(model.vertices[end]);
    boxes.push_back(Box::of(vertices_.back(), vertices_.back(), vertices_.back()));
  }
  vertexTree_ = BoxTree(std::span<const Box>(boxes));
}

void ModelIndex::addSegments(std::uint32_t edge) {
  const EdgeCurve curve(read_->model, read_->model.edges[edge]);
  const double turns = std::ceil(curve.turning() / kTurningPerSegment);
  const auto perPiece = static_cast<int>(std::clamp(turns, 1.0, kMaxSegments));
  const std::span<const double> knots = curve.knots();
  double before = 0.0;
  for (std::size_t piece = 0; piece + 1 < knots.size(); ++piece) {
    for (int i = 1; i <= perPiece; ++i) {
      const double t = i == perPiece
                           ? knots[piece + 1]
                           : knots[piece] + (knots[piece + 1] - knots[piece]) * i / perPiece;
      segments_.push_back({edge, curve.parameterAt(before), curve.parameterAt(t),
                           curve.position(before), curve.position(t)});
      before = t;
    }
  }
}

std::optional<FacePlace> ModelIndex::nearestOnFace(const Vec3& position, const Vec3& normal,
                                                   double reach,
                                                   std::span<const std::uint32_t> only) const {
  const bool isAny = normal == Vec3(0.0);
  double least = (reach + sag_) * (reach + sag_);
  std::uint32_t nearest = TrimmedFace::kNone;
  triangleTree_.visitNear(position, least, [&](std::uint32_t item) {
    if (!only.empty() && !std::ranges::binary_search(only, triangles_->faces[indexed_[item]]))
      return;
    const auto [a, b, c] =
        std::array{pointOf(nodesOf(indexed_[item])[0]), pointOf(nodesOf(indexed_[item])[1]),
                   pointOf(nodesOf(indexed_[item])[2])};
    const double squared = squaredDistanceToTriangle(position, a, b, c);
    if (!(squared < least)) return;
    const Vec3 across = glm::cross(b - a, c - a);
    if (!isAny && !(glm::dot(across, normal) >= kSimilarNormal * glm::length(across))) return;
    least = squared;
    nearest = indexed_[item];
  });
  if (nearest == TrimmedFace::kNone) return std::nullopt;
  const auto nodes = nodesOf(nearest);
  const auto [a, b, c] = std::array{pointOf(nodes[0]), pointOf(nodes[1]), pointOf(nodes[2])};
  const Vec3 parts = barycentric(nearestPointOfTriangle(position, a, b, c), a, b, c);
  const Vec2 start = parts.x * parametersOf(nodes[0]) + parts.y * parametersOf(nodes[1]) +
                     parts.z * parametersOf(nodes[2]);
  const std::uint32_t face = triangles_->faces[nearest];
  const FaceSurface& surface = read_->model.surfaces[read_->model.faces[face].surface];
  const Vec3 place =
      evaluate(surface, closestParametersFrom(surface, boxes_[face], position, start)).position;
  if (!(glm::length(place - position) <= reach)) return std::nullopt;
  return FacePlace{face, place};
}

std::optional<EdgePlace> ModelIndex::nearestOnEdge(const Vec3& position, const Vec3& direction,
                                                   double reach,
                                                   std::optional<std::uint32_t> only) const {
  const bool isAny = direction == Vec3(0.0);
  double least = (reach + sag_) * (reach + sag_);
  const Segment* nearest = nullptr;
  segmentTree_.visitNear(position, least, [&](std::uint32_t item) {
    const Segment& segment = segments_[item];
    if (only && segment.edge != *only) return;
    const double squared = squaredDistanceToSegment(position, segment.start, segment.end);
    if (!(squared < least)) return;
    const Vec3 along = segment.end - segment.start;
    const double cosine = std::fabs(glm::dot(along, direction));
    if (!isAny && !(cosine >= kSimilarDirection * glm::length(along))) return;
    least = squared;
    nearest = &segment;
  });
  if (nearest == nullptr) return std::nullopt;
  const Vec3 along = nearest->end - nearest->start;
  const double square = glm::dot(along, along);
  const double part =
      square > 0.0 ? std::clamp(glm::dot(position - nearest->start, along) / square, 0.0, 1.0)
                   : 0.0;
  const TrimmedEdge& edge = read_->model.edges[nearest->edge];
  const double start = nearest->from + part * (nearest->to - nearest->from);
  const double at = closestParameterFrom(read_->model.curves[*edge.curve], edge.first, edge.last,
                                         position, start);
  const EdgeCurve curve(read_->model, edge);
  const Vec3 place = curve.position((at - edge.first) / (edge.last - edge.first));
  if (!(glm::length(place - position) <= reach)) return std::nullopt;
  return EdgePlace{nearest->edge, place};
}

std::optional<Vec3> ModelIndex::nearestVertex(const Vec3& position, double reach) const {
  double least = reach * reach;
  std::optional<Vec3> nearest;
  vertexTree_.visitNear(position, least, [&](std::uint32_t item) {
    const Vec3 offset = vertices_[item] - position;
    const double squared = glm::dot(offset, offset);
    if (!(squared < least)) return;
    least = squared;
    nearest = vertices_[item];
  });
  return nearest;
}

}  // namespace tetrafront
