// What the viewer shows before anything is meshed: the lines as polylines, curved patches as a
// grid, planar patches by the same front that meshes them, with the coarsest sides that show
// their lines' bends.

#include <array>
#include <limits>
#include <utility>

#include "model/check_model.h"
#include "model/patch_projection.h"
#include "preview/model_sampling.h"
#include "surface/patch_boundary.h"
#include "surface/planar_front.h"

namespace tetrafront {

namespace {

/// Pieces of a curved line in its polyline.
constexpr std::uint32_t kLinePieces = 48;
/// Sides of a curved line that only planar patches use.
constexpr std::uint32_t kBoundaryPieces = 24;
/// Cells per direction of a curved patch, and sides of its lines: patches that share a line have
/// the same nodes there.
constexpr std::uint32_t kGridCells = 16;
/// A border of a grid that is not on its line, as a share of the line's length, is none.
constexpr double kOnLine = 1e-6;
/// Sides taken from a patch's front before it is given up; models people draw need some hundreds.
constexpr std::uint32_t kFrontBudget = 200'000;
constexpr std::uint32_t kAllPatches = std::numeric_limits<std::uint32_t>::max();

void append(std::vector<double>& points, const Vec3& place) {
  points.insert(points.end(), {place.x, place.y, place.z});
}

/// A curve cut into pieces of equal parameter.
LineDivision cut(const Curve& curve, std::uint32_t pieces) {
  LineDivision division;
  for (std::uint32_t i = 0; i <= pieces; ++i) {
    division.parameters.push_back(static_cast<double>(i) / pieces);
    division.nodes.push_back(curve.position(division.parameters.back()));
  }
  return division;
}

}  // namespace

class SurfaceSampler::Impl {
 public:
  Impl(const Model& model, const CheckedModel& found, std::uint32_t refinement)
      : model_(&model),
        found_(&found),
        cells_(kGridCells * refinement),
        boundaryPieces_(kBoundaryPieces * refinement),
        resolved_(model, found.usableLines) {}

  /// `isWanted`: per patch; empty for all.
  bool advance(std::uint32_t budget, std::span<const std::uint8_t> isWanted) {
    ModelPreview& preview = sampled_.preview;
    if (preview.patchOffsets.empty()) {
      findLinesOfGrids();
      addLines();
      preview.patchOffsets.push_back(0);
      sampled_.isJoined.assign(model_->patches.size(), 0);
    }
    for (; budget > 0 && preview.patchOffsets.size() <= model_->patches.size(); --budget) {
      const auto patch = static_cast<std::uint32_t>(preview.patchOffsets.size() - 1);
      const bool wanted = isWanted.empty() || isWanted[patch] != 0;
      if (wanted && found_->usablePatches[patch] != 0) addPatch(patch);
      preview.patchOffsets.push_back(static_cast<std::uint32_t>(preview.patchTriangles.size() / 3));
    }
    return preview.patchOffsets.size() > model_->patches.size();
  }

  [[nodiscard]] SampledModel take() { return std::move(sampled_); }

 private:
  void findLinesOfGrids() {
    isOnGrid_.assign(model_->lines.size(), 0);
    for (std::size_t patch = 0; patch < model_->patches.size(); ++patch) {
      if (found_->usablePatches[patch] == 0) continue;
      if (model_->patches[patch].type == PatchType::kPlanar) continue;
      for (const Loop& loop : model_->patches[patch].loops)
        for (const OrientedLine& walked : loop)
          isOnGrid_[found_->duplicates.lines[walked.line]] = 1;
    }
  }

  void addLines() {
    ModelPreview& preview = sampled_.preview;
    preview.lineOffsets.push_back(0);
    lines_.divisions.resize(model_->lines.size());
    lines_.nodes.resize(model_->lines.size());
    nextNode_ = static_cast<std::uint32_t>(model_->points.size());
    for (std::uint32_t line = 0; line < model_->lines.size(); ++line) {
      if (found_->usableLines[line] != 0) addLine(line);
      preview.lineOffsets.push_back(static_cast<std::uint32_t>(preview.linePoints.size() / 3));
    }
  }

  void addLine(std::uint32_t line) {
    const Curve& curve = resolved_.curve(line);
    const std::uint32_t shown = curve.isStraight() ? 1 : kLinePieces;
    for (const Vec3& place : cut(curve, shown).nodes) append(sampled_.preview.linePoints, place);
    const std::uint32_t first = found_->duplicates.lines[line];
    const std::uint32_t alone = curve.isStraight() ? 1 : boundaryPieces_;
    lines_.divisions[line] = cut(curve, isOnGrid_[first] != 0 ? cells_ : alone);
    numberNodes(line, first);
  }

  /// Points at one place are one node, and so are those of lines drawn twice.
  void numberNodes(std::uint32_t line, std::uint32_t first) {
    const std::vector<std::uint32_t>& points = model_->lines[line].points;
    std::vector<NodeId>& nodes = lines_.nodes[line];
    nodes.resize(lines_.divisions[line].nodes.size());
    const auto [from, to] = std::minmax(points.front(), points.back());
    nodes.front() = NodeId(found_->duplicates.points[from]);
    nodes.back() = NodeId(found_->duplicates.points[to]);
    const std::size_t inner = nodes.size() - 2;
    const int way = first == line ? 0 : directionAlong(line, first);
    for (std::size_t i = 1; i <= inner; ++i) {
      if (way == 0) nodes[i] = NodeId(nextNode_++);
      if (way > 0) nodes[i] = lines_.nodes[first][i];
      if (way < 0) nodes[i] = lines_.nodes[first][inner + 1 - i];
    }
  }

  /// 1 if the nodes of `line` are where those of `other` are, -1 if in the opposite order, else 0.
  [[nodiscard]] int directionAlong(std::uint32_t line, std::uint32_t other) const {
    const std::vector<Vec3>& a = lines_.divisions[line].nodes;
    const std::vector<Vec3>& b = lines_.divisions[other].nodes;
    if (a.size() != b.size() || a.size() < 3) return 0;
    const double tolerance = kOnLine * resolved_.curve(line).length();
    bool along = true;
    bool against = true;
    for (std::size_t i = 0; i < a.size(); ++i) {
      along = along && glm::length(a[i] - b[i]) <= tolerance;
      against = against && glm::length(a[i] - b[b.size() - 1 - i]) <= tolerance;
    }
    return along ? 1 : (against ? -1 : 0);
  }

  void addPatch(std::uint32_t patch) {
    const Patch& drawn = model_->patches[patch];
    const PatchSurface surface(resolved_, drawn);
    if (hasCurvedHoles(drawn)) {
      // Triangles of about the cells' size.
      addMeshed(patch, surface, extentOf(drawn) / cells_);
    } else if (const MappedSurface* curved = surface.mapped()) {
      const std::uint32_t first = nextPoint();
      addGrid(curved->unitSurface());
      const bool joined = joinBorder(drawn, curved->unitSurface().shape(), first);
      sampled_.isJoined[patch] = joined ? 1 : 0;
    } else {
      // A size beyond all sides: triangles grow as fast away from short ones as the front lets
      // them.
      addMeshed(patch, surface, extentOf(drawn));
    }
  }

  /// Row by row of the unit square; of the unit triangle, each row one point shorter.
  void addGrid(const UnitSurface& surface) {
    const bool isTriangle = surface.shape() == UnitShape::kTriangle;
    std::uint32_t row = nextPoint();
    for (std::uint32_t j = 0; j <= cells_; ++j) {
      const std::uint32_t cells = isTriangle ? cells_ - j : cells_;
      for (std::uint32_t i = 0; i <= cells; ++i) {
        const Vec2 unit(static_cast<double>(i) / cells_, static_cast<double>(j) / cells_);
        addPoint(surface.evaluate(unit).position, nextNode_++);
      }
      if (j < cells_) addCells(row, row + cells + 1, cells, isTriangle);
      row += cells + 1;
    }
  }

  /// Puts the points on a grid's border onto the nodes of its lines, which they only miss by
  /// rounding; false if they do not.
  bool joinBorder(const Patch& patch, UnitShape shape, std::uint32_t first) {
    bool joined = true;
    for (std::size_t position = 0; position < patch.loops.front().size(); ++position) {
      const OrientedLine& walked = patch.loops.front()[position];
      const bool backward = walked.reversed != resolved_.flipped(walked.line);
      const LineDivision& division = lines_.divisions[walked.line];
      const double tolerance = kOnLine * resolved_.curve(walked.line).length();
      for (std::uint32_t i = 0; i <= cells_; ++i) {
        const Vec2 unit = unitBorder(shape, position, static_cast<double>(i) / cells_);
        const auto column = static_cast<std::uint32_t>(unit.x * cells_ + 0.5);
        const auto row = static_cast<std::uint32_t>(unit.y * cells_ + 0.5);
        // Rows of a triangle are cells_ + 1, cells_, cells_ - 1, ... points long.
        const std::uint32_t missing =
            shape == UnitShape::kTriangle && row > 0 ? row * (row - 1) / 2 : 0;
        const std::uint32_t point = first + row * (cells_ + 1) - missing + column;
        const std::uint32_t node = backward ? cells_ - i : i;
        const Vec3& place = division.nodes[node];
        joined = joined &&
                 glm::length(sampleAt(sampled_.preview.patchPoints, point) - place) <= tolerance;
        for (int axis = 0; axis < 3; ++axis)
          sampled_.preview.patchPoints[3 * std::size_t{point} + axis] = place[axis];
        sampled_.nodes[point] = lines_.nodes[walked.line][node].value;
      }
    }
    return joined;
  }

  /// The cells between two rows of a grid; the last one of a triangle's row is half a cell.
  void addCells(std::uint32_t row, std::uint32_t next, std::uint32_t cells, bool isTriangle) {
    std::vector<std::uint32_t>& triangles = sampled_.preview.patchTriangles;
    for (std::uint32_t i = 0; i < cells; ++i) {
      triangles.insert(triangles.end(), {row + i, row + i + 1, next + i});
      if (!isTriangle || i + 1 < cells)
        triangles.insert(triangles.end(), {row + i + 1, next + i + 1, next + i});
    }
  }

  void addMeshed(std::uint32_t number, const PatchSurface& surface, double size) {
    const SizeField field = SizeField::uniform(size);
    PatchBoundary boundary =
        layOutBoundary(resolved_, model_->patches[number], surface, field, lines_);
    if (!findInvalidSides(boundary).empty()) return;
    PlanarMesh& mesh = boundary.mesh;
    const PatchMetric metric(surface, field);
    PlanarFront front(metric, mesh);
    if (!front.advance(kFrontBudget) || front.hasStalled()) return;
    const std::uint32_t first = nextPoint();
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const NodeId node = mesh.surfaceNodes[i];
      addPoint(mesh.positions[i], node.isNone() ? nextNode_++ : node.value);
    }
    for (const PlanarMesh::Triangle& triangle : mesh.triangles)
      for (const PlanarNodeId node : triangle)
        sampled_.preview.patchTriangles.push_back(first + node.value);
    sampled_.isJoined[number] = 1;
  }

  void addPoint(const Vec3& place, std::uint32_t node) {
    append(sampled_.preview.patchPoints, place);
    sampled_.nodes.push_back(node);
  }

  [[nodiscard]] double extentOf(const Patch& patch) const {
    return loopExtent(resolved_, patch.loops.front(), kBoundaryPieces);
  }

  [[nodiscard]] std::uint32_t nextPoint() const {
    return static_cast<std::uint32_t>(sampled_.nodes.size());
  }

  const Model* model_;
  const CheckedModel* found_;
  std::uint32_t cells_;
  std::uint32_t boundaryPieces_;
  ResolvedModel resolved_;
  std::vector<std::uint8_t> isOnGrid_;  ///< per line, the lowest of its course: a grid's border
  DividedLines lines_;
  std::uint32_t nextNode_ = 0;
  SampledModel sampled_;
};

SurfaceSampler::SurfaceSampler(const Model& model, const CheckedModel& found)
    : impl_(std::make_unique<Impl>(model, found, 1)) {}
SurfaceSampler::SurfaceSampler(SurfaceSampler&&) noexcept = default;
SurfaceSampler& SurfaceSampler::operator=(SurfaceSampler&&) noexcept = default;
SurfaceSampler::~SurfaceSampler() = default;

bool SurfaceSampler::advance(std::uint32_t budget) { return impl_->advance(budget, {}); }
SampledModel SurfaceSampler::take() { return impl_->take(); }

SampledModel sampleSurface(const Model& model, const CheckedModel& found) {
  SurfaceSampler sampler(model, found);
  while (!sampler.advance(kAllPatches)) {
  }
  return sampler.take();
}

SampledModel sampleFinely(const Model& model, const CheckedModel& found, std::uint32_t refinement,
                          std::span<const std::uint32_t> patches) {
  std::vector<std::uint8_t> isWanted(model.patches.size(), 0);
  for (const std::uint32_t patch : patches) isWanted[patch] = 1;
  SurfaceSampler::Impl sampler(model, found, refinement);
  while (!sampler.advance(kAllPatches, isWanted)) {
  }
  return sampler.take();
}

}  // namespace tetrafront
