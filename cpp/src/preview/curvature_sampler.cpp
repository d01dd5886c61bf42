// Curvatures follow from differences of the tangents, which are exact. Near the border and at corners they are those slightly
// inside, where all differences can be taken.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>

#include "base/task.h"
#include "base/tool_job.h"
#include "model/check_model.h"
#include "model/patch_projection.h"
#include "model/patch_surface.h"
#include "preview/surface_sampler.h"
#include "tetrafront/curvature_samples.h"

namespace tetrafront {

namespace {

/// Step of the differences of tangents, in the unit domain: their error is about its square, 1e-6, far below what a colour shows, and
/// rounding divided by the step is far smaller still.
constexpr double kDifference = 1e-3;
/// Distance from a crease / width of the strip: on one side of it in floating point, and nowhere visible.
constexpr double kBesideCrease = 1e-7;
/// A normal shorter than this part of the product of the tangents has no direction: it would be wrong by more than 1e-7 by rounding.
constexpr double kMinNormalSine = 1e-9;
/// Patches per slice.
constexpr std::uint32_t kUnitsPerShadedPatch = 200;

using Evaluate = std::function<SurfacePoint(const Vec2&)>;

struct Shape {
  Vec3 normal{0.0};
  double gaussian = 0.0;
  double largest = 0.0;
};

Vec3 unitNormalOf(const SurfacePoint& point) {
  const Vec3 normal = glm::cross(point.alongXi, point.alongEta);
  const double length = glm::length(normal);
  if (length <= kMinNormalSine * glm::length(point.alongXi) * glm::length(point.alongEta) ||
      !(length > 0.0))
    return Vec3(0.0);
  return normal / length;
}

/// `at`: where the normal is taken; `inside`: where differences can be taken by `step` in all directions.
Shape shapeAt(const Evaluate& evaluate, const Vec2& at, const Vec2& inside, double step) {
  const SurfacePoint point = evaluate(inside);
  const SurfacePoint east = evaluate(inside + Vec2(step, 0.0));
  const SurfacePoint west = evaluate(inside - Vec2(step, 0.0));
  const SurfacePoint north = evaluate(inside + Vec2(0.0, step));
  const SurfacePoint south = evaluate(inside - Vec2(0.0, step));
  Shape shape;
  const Vec3 normal = unitNormalOf(point);
  shape.normal = unitNormalOf(evaluate(at));
  if (shape.normal == Vec3(0.0)) shape.normal = normal;
  // First and second fundamental form.
  const double e = glm::dot(point.alongXi, point.alongXi);
  const double f = glm::dot(point.alongXi, point.alongEta);
  const double g = glm::dot(point.alongEta, point.alongEta);
  const double l = glm::dot(normal, east.alongXi - west.alongXi) / (2.0 * step);
  const double m = glm::dot(normal, north.alongXi - south.alongXi) / (2.0 * step);
  const double n = glm::dot(normal, north.alongEta - south.alongEta) / (2.0 * step);
  const double area = e * g - f * f;
  if (!(area > 0.0)) return shape;
  shape.gaussian = (l * n - m * m) / area;
  const double mean = (e * n - 2.0 * f * m + g * l) / (2.0 * area);
  shape.largest = std::fabs(mean) + std::sqrt(std::max(0.0, mean * mean - shape.gaussian));
  return shape;
}

Vec2 centreOf(UnitShape shape) {
  return shape == UnitShape::kTriangle ? Vec2(1.0 / 3.0) : Vec2(0.5);
}

/// Moves a position of a domain inside, by some steps of a difference at its border.
Vec2 insideOf(const Vec2& centre, const Vec2& unit) {
  return centre + (1.0 - 4.0 * kDifference) * (unit - centre);
}

class ShapeCollector {
 public:
  /// `cells`: rows and columns of a lattice.
  explicit ShapeCollector(int cells) : cells_(cells) { samples_.patchOffsets.push_back(0); }

  std::uint32_t addVertex(const Vec3& position, const Shape& shape) {
    const auto vertex = static_cast<std::uint32_t>(samples_.gaussian.size());
    for (int k = 0; k < 3; ++k) {
      samples_.points.push_back(position[k]);
      samples_.normals.push_back(shape.normal[k]);
    }
    samples_.gaussian.push_back(shape.gaussian);
    samples_.largest.push_back(shape.largest);
    return vertex;
  }

  void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    samples_.triangles.insert(samples_.triangles.end(), {a, b, c});
  }

  void endPatch() {
    samples_.patchOffsets.push_back(static_cast<std::uint32_t>(samples_.triangles.size() / 3));
  }

  /// Adds a lattice over a part of the unit square, `from` to `to` in xi, or over the unit triangle.
  void addLattice(const UnitSurface& surface, double from = 0.0, double to = 1.0) {
    const bool isTriangle = surface.shape() == UnitShape::kTriangle;
    const Vec2 centre = isTriangle ? centreOf(surface.shape()) : Vec2(0.5 * (from + to), 0.5);
    const auto evaluate = [&surface](const Vec2& unit) { return surface.evaluate(unit); };
    const auto first = static_cast<std::uint32_t>(samples_.gaussian.size());
    std::vector<std::uint32_t> rows;
    for (int j = 0; j <= cells_; ++j) {
      rows.push_back(static_cast<std::uint32_t>(samples_.gaussian.size()));
      const int columns = isTriangle ? cells_ - j : cells_;
      for (int i = 0; i <= columns; ++i) {
        const double share = static_cast<double>(i) / cells_;
        const Vec2 unit(from + (to - from) * share, static_cast<double>(j) / cells_);
        const Vec2 inside = insideOf(centre, unit);
        // The normals of a strip at a crease are those of its own side.
        const double margin = surface.tube() == nullptr ? 0.0 : kBesideCrease * (to - from);
        const Vec2 at(std::clamp(unit.x, from + margin, to - margin), unit.y);
        addVertex(surface.evaluate(unit).position,
                  shapeAt(evaluate, at, inside, (to - from) * kDifference));
      }
    }
    for (int j = 0; j < cells_; ++j) {
      const int columns = isTriangle ? cells_ - j : cells_;
      const std::uint32_t low = rows[static_cast<std::size_t>(j)];
      const std::uint32_t high = rows[static_cast<std::size_t>(j) + 1];
      for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(columns); ++i) {
        addTriangle(low + i, low + i + 1, high + i);
        if (!isTriangle || i + 1 < static_cast<std::uint32_t>(columns))
          addTriangle(low + i + 1, high + i + 1, high + i);
      }
    }
    alignNormals(first);
  }

  [[nodiscard]] CurvatureSamples take() { return std::move(samples_); }

 private:
  /// Where a corner has no normal, that of the vertex before it.
  void alignNormals(std::uint32_t first) {
    for (std::size_t v = first + 1; v < samples_.gaussian.size(); ++v) {
      double* normal = &samples_.normals[3 * v];
      if (normal[0] != 0.0 || normal[1] != 0.0 || normal[2] != 0.0) continue;
      std::copy_n(normal - 3, 3, normal);
    }
  }

  int cells_;
  CurvatureSamples samples_;
};

/// The triangles of planar patches and patches with holes.
class Triangulated {
 public:
  Triangulated(const Model& model, const CheckedModel& found)
      : sampled_(sampleFinely(model, found, 2, selectedOf(model, found))) {}

  [[nodiscard]] static bool needs(const Patch& patch) {
    return patch.type == PatchType::kPlanar || hasCurvedHoles(patch);
  }

  void add(std::uint32_t patch, const PatchSurface& surface, ShapeCollector& collector) {
    const std::vector<std::uint32_t>& offsets = sampled_.preview.patchOffsets;
    vertices_.resize(sampled_.preview.patchPoints.size() / 3, kNoIndex);
    std::optional<PatchProjection> projection;
    if (surface.planar() == nullptr) projection.emplace(surface);
    const auto vertexOf = [&](std::uint32_t node) {
      if (vertices_[node] != kNoIndex) return vertices_[node];
      const Vec3 position = sampleAt(sampled_.preview.patchPoints, node);
      return vertices_[node] = collector.addVertex(
                 position, projection ? shapeOn(*surface.mapped(), projection->project(position))
                                      : Shape{unitNormalOf(surface.evaluate({0.0, 0.0}))});
    };
    // Patches share the nodes on lines, but not their normals.
    const std::size_t first = 3 * std::size_t{offsets[patch]};
    const std::size_t end = 3 * std::size_t{offsets[patch + 1]};
    const std::vector<std::uint32_t>& triangles = sampled_.preview.patchTriangles;
    for (std::size_t corner = first; corner < end; ++corner)
      vertices_[triangles[corner]] = kNoIndex;
    for (std::size_t t = first; t < end; t += 3) {
      const std::uint32_t a = vertexOf(triangles[t]);
      const std::uint32_t b = vertexOf(triangles[t + 1]);
      collector.addTriangle(a, b, vertexOf(triangles[t + 2]));
    }
  }

 private:
  static std::vector<std::uint32_t> selectedOf(const Model& model, const CheckedModel& found) {
    std::vector<std::uint32_t> selected;
    for (std::uint32_t patch = 0; patch < model.patches.size(); ++patch)
      if (found.usablePatches[patch] != 0 && needs(model.patches[patch])) selected.push_back(patch);
    return selected;
  }

  static Shape shapeOn(const MappedSurface& mapped, const PatchProjection::Foot& foot) {
    const UnitSurface& surface = mapped.unitSurface();
    const auto evaluate = [&surface](const Vec2& unit) { return surface.evaluate(unit); };
    const Vec2 unit = mapped.stretchedPlane().toUnit(foot.plane);
    return shapeAt(evaluate, unit, insideOf(centreOf(surface.shape()), unit), kDifference);
  }

  SampledModel sampled_;
  std::vector<std::uint32_t> vertices_;
};

void addTube(const UnitSurface& surface, ShapeCollector& collector) {
  const std::span<const double> creases = surface.tube()->creases();
  if (creases.empty()) {
    // A third each, so that a circle looks round.
    for (int part = 0; part < 3; ++part)
      collector.addLattice(surface, part / 3.0, (part + 1) / 3.0);
    return;
  }
  for (std::size_t i = 0; i < creases.size(); ++i)
    collector.addLattice(surface, creases[i],
                         i + 1 < creases.size() ? creases[i + 1] : creases.front() + 1.0);
}

struct CurvatureInput {
  Model model;
  int cells;
};

Task<CurvatureSamples> sampleCurvature(Work& work, const CurvatureInput& input) {
  const Model& model = input.model;
  work.beginPart(0.3);
  const CheckedModel found = co_await checkModel(work, model);
  work.beginPart(1.0);
  const ResolvedModel resolved(model, found.usableLines);
  Triangulated triangulated(model, found);
  ShapeCollector collector(input.cells);
  for (std::uint32_t patch = 0; patch < model.patches.size(); ++patch) {
    if (found.usablePatches[patch] != 0) {
      const Patch& drawn = model.patches[patch];
      const PatchSurface surface(resolved, drawn);
      const MappedSurface* mapped = surface.mapped();
      if (Triangulated::needs(drawn))
        triangulated.add(patch, surface, collector);
      else if (drawn.type == PatchType::kTube)
        addTube(mapped->unitSurface(), collector);
      else
        collector.addLattice(mapped->unitSurface());
    }
    collector.endPatch();
    co_await work.spend(kUnitsPerShadedPatch);
  }
  co_return collector.take();
}

}  // namespace

CurvatureSampler::CurvatureSampler(Model model, double cells)
    : SlicedTool(makeToolJob<CurvatureSamples>(
          CurvatureInput{std::move(model),
                         static_cast<int>(std::clamp<double>(cells, 1.0, kMaxShadedCells))},
          sampleCurvature)) {}

}  // namespace tetrafront
