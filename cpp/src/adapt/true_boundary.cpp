#include "adapt/true_boundary.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/sort.h"
#include "topology/mesh_access.h"

namespace tetrafront {
namespace {

/// Largest distance between a triangle or a segment and its face or edge / its longest edge.
constexpr double kReachPerEdge = 0.4;

/// Distance of the middle of a segment from its edge / its length, up to which the segment counts as straight: above the rounding
/// of coordinates, and far below any bend that matters.
constexpr double kStraight = 1e-10;

/// Largest distance of the model's own triangles from its faces / diagonal.
constexpr double kSagPerDiagonal = 0.02;

/// Returns the place nearest to `position`, if it is within reach of its foot, and otherwise to the foot; the foot if there is none.
/// `find(from, reach)`: returns the nearest place, if any.
template <class Find>
Vec3 nearestOr(const Vec3& foot, const Vec3& position, double reach, Find find) {
  const Vec3 off = position - foot;
  if (glm::dot(off, off) <= reach * reach) {
    if (const auto place = find(position, reach)) return place->position;
  }
  const auto place = find(foot, reach);
  return place ? place->position : foot;
}

}  // namespace

TrueBoundary::TrueBoundary(const ReferenceSurface& reference, const ReadModel& model,
                           const ModelTriangles& triangles)
    : reference_(reference), index_(model, triangles, kSagPerDiagonal * reference.diagonal()) {}

double TrueBoundary::reachOf(TriangleId triangle) const {
  const auto [a, b, c] = cornersOf(reference_.mesh(), triangle);
  const double squared =
      std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)});
  return kReachPerEdge * std::sqrt(squared);
}

Task<> TrueBoundary::prepare(Work& work) {
  constexpr std::size_t kTrianglesPerUnit = 1;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  work.beginPart(0.8);
  co_await work.forEachId<TriangleId>(
      countTriangles(reference_.mesh()), [&](TriangleId t) { addFacesOf(t, pairs); },
      kTrianglesPerUnit);
  sortUnique(pairs);
  faceBegins_.assign(reference_.patchCount() + 1, 0);
  for (const auto& [patch, face] : pairs) {
    ++faceBegins_[patch + 1];
    faces_.push_back(face);
  }
  for (std::size_t i = 1; i < faceBegins_.size(); ++i) faceBegins_[i] += faceBegins_[i - 1];
  work.beginPart(1.0);
  segmentBegins_.assign(1, 0);
  for (const FeatureLine& line : reference_.lines()) {
    const std::vector<Vec3>& points = line.points();
    for (std::size_t i = 0; i + 1 < points.size(); ++i) addSegment(points[i], points[i + 1]);
    segmentBegins_.push_back(static_cast<std::uint32_t>(edges_.size()));
    co_await work.spend(points.size());
  }
}

void TrueBoundary::addFacesOf(TriangleId triangle,
                              std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
  const SmoothPatchId patch = reference_.patchOf(triangle);
  if (reference_.patch(patch).isPlanar) return;
  const auto [a, b, c] = cornersOf(reference_.mesh(), triangle);
  const Vec3 middle = (a + b + c) / 3.0;
  for (const Vec3& at : {middle, 0.5 * (a + middle), 0.5 * (b + middle), 0.5 * (c + middle)}) {
    const std::optional<FacePlace> place =
        index_.nearestOnFace(at, reference_.normalOf(triangle), reachOf(triangle));
    if (!place) continue;
    sag_ = std::max(sag_, glm::length(place->position - at));
    pairs.emplace_back(patch.value, place->face);
  }
}

void TrueBoundary::addSegment(const Vec3& from, const Vec3& to) {
  const Vec3 chord = to - from;
  const double length = glm::length(chord);
  std::uint32_t edge = kNoIndex;
  double farthest = kStraight * length;
  // The middle of an S is on its chord.
  for (const double part : {0.5, 0.25, 0.75}) {
    const Vec3 at = from + part * chord;
    const std::optional<EdgePlace> place =
        index_.nearestOnEdge(at, chord / length, kReachPerEdge * length);
    const double off = place ? glm::length(place->position - at) : 0.0;
    if (off <= farthest) continue;
    farthest = off;
    edge = place->edge;
    sag_ = std::max(sag_, off);
  }
  edges_.push_back(edge);
}

Vec3 TrueBoundary::onPatch(SmoothPatchId patch, TriangleId triangle, const Vec3& foot,
                           const Vec3& position) const {
  const std::uint32_t begin = faceBegins_[patch.index()];
  const std::span<const std::uint32_t> faces(faces_.data() + begin,
                                             faceBegins_[patch.index() + 1] - begin);
  if (faces.empty()) return foot;
  const Vec3& normal = reference_.normalOf(triangle);
  return nearestOr(foot, position, reachOf(triangle), [&](const Vec3& from, double reach) {
    // Near an apex the normals of a face and of a triangle differ.
    const std::optional<FacePlace> place = index_.nearestOnFace(from, normal, reach, faces);
    return place ? place : index_.nearestOnFace(from, Vec3(0.0), reach, faces);
  });
}

Vec3 TrueBoundary::onLine(FeatureLineId id, std::size_t segment, const Vec3& foot,
                          const Vec3& position) const {
  const std::uint32_t edge = edges_[segmentBegins_[id.index()] + segment];
  if (edge == kNoIndex) return foot;
  const std::vector<Vec3>& points = reference_.line(id).points();
  const double length = glm::length(points[segment + 1] - points[segment]);
  return nearestOr(foot, position, kReachPerEdge * length, [&](const Vec3& from, double reach) {
    return index_.nearestOnEdge(from, Vec3(0.0), reach, edge);
  });
}

}  // namespace tetrafront
