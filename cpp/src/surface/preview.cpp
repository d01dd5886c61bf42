// What the viewer shows before anything is meshed: the lines as polylines, curved patches as a
// grid, planar patches by the same front that meshes them, with the coarsest sides that show
// their lines' bends.

#include <array>
#include <utility>

#include "field/grid_locator.h"
#include "field/size_sources.h"
#include "model/check_model.h"
#include "model/patch_projection.h"
#include "surface/check_coverage.h"
#include "surface/model_sampling.h"
#include "surface/patch_boundary.h"
#include "surface/planar_front.h"
#include "tetrafront/mesher.h"

namespace tetrafront {

namespace {

/// Pieces of a curved line in its polyline.
constexpr std::uint32_t kLinePieces = 48;
/// Sides of a curved line around a planar patch.
constexpr std::uint32_t kBoundaryPieces = 24;
/// Cells per direction of a curved patch.
constexpr std::uint32_t kGridCells = 16;
/// Sides taken from a patch's front before it is given up; models people draw need some hundreds.
constexpr std::uint32_t kFrontBudget = 200'000;

void append(std::vector<double>& points, const Vec3& place) {
  points.insert(points.end(), {place.x, place.y, place.z});
}

/// A curve cut into pieces of equal parameter.
LineDivision cutEvenly(const Curve& curve, std::uint32_t pieces) {
  LineDivision division;
  for (std::uint32_t i = 0; i <= pieces; ++i) {
    division.parameters.push_back(static_cast<double>(i) / pieces);
    division.nodes.push_back(curve.position(division.parameters.back()));
  }
  return division;
}

/// The same, a straight line in one piece.
LineDivision cut(const Curve& curve, std::uint32_t pieces) {
  return cutEvenly(curve, curve.isStraight() ? 1 : pieces);
}

class PreviewBuilder {
 public:
  PreviewBuilder(const Model& model, const ModelExamination& found)
      : model_(&model), found_(&found), resolved_(model, found.soundLines) {}

  ModelPreview build() {
    addLines();
    preview_.patchOffsets.push_back(0);
    for (std::size_t patch = 0; patch < model_->patches.size(); ++patch) {
      if (found_->soundPatches[patch] != 0) addPatch(model_->patches[patch]);
      preview_.patchOffsets.push_back(
          static_cast<std::uint32_t>(preview_.patchTriangles.size() / 3));
    }
    return std::move(preview_);
  }

 private:
  void addLines() {
    preview_.lineOffsets.push_back(0);
    lines_.divisions.resize(model_->lines.size());
    lines_.nodes.resize(model_->lines.size());
    for (std::uint32_t line = 0; line < model_->lines.size(); ++line) {
      if (found_->soundLines[line] != 0) addLine(line);
      preview_.lineOffsets.push_back(static_cast<std::uint32_t>(preview_.linePoints.size() / 3));
    }
  }

  void addLine(std::uint32_t line) {
    const Curve& curve = resolved_.curve(line);
    for (const Vec3& place : cut(curve, kLinePieces).nodes) append(preview_.linePoints, place);
    lines_.divisions[line] = cut(curve, kBoundaryPieces);
    lines_.nodes[line].assign(lines_.divisions[line].nodes.size(), PlanarMesh::kNone);
  }

  void addPatch(const Patch& patch) {
    const PatchSurface surface(resolved_, patch);
    if (hasCurvedHoles(patch)) {
      addWithHoles(patch, surface);
    } else if (const MappedSurface* curved = surface.mapped()) {
      addGrid(curved->unitSurface());
    } else {
      // A size beyond all sides: triangles grow as fast away from short ones as the front lets
      // them.
      addMeshed(patch, surface, lines_, extentOf(patch));
    }
  }

  /// Row by row of the unit square; of the unit triangle, each row one point shorter.
  void addGrid(const UnitSurface& surface) {
    const bool isTriangle = surface.shape() == UnitShape::kTriangle;
    std::uint32_t row = nextPoint();
    for (std::uint32_t j = 0; j <= kGridCells; ++j) {
      const std::uint32_t cells = isTriangle ? kGridCells - j : kGridCells;
      for (std::uint32_t i = 0; i <= cells; ++i) {
        const Vec2 unit(static_cast<double>(i) / kGridCells, static_cast<double>(j) / kGridCells);
        append(preview_.patchPoints, surface.evaluate(unit).position);
      }
      if (j < kGridCells) addCells(row, row + cells + 1, cells, isTriangle);
      row += cells + 1;
    }
  }

  /// The cells between two rows of a grid; the last one of a triangle's row is half a cell.
  void addCells(std::uint32_t row, std::uint32_t next, std::uint32_t cells, bool isTriangle) {
    std::vector<std::uint32_t>& triangles = preview_.patchTriangles;
    for (std::uint32_t i = 0; i < cells; ++i) {
      triangles.insert(triangles.end(), {row + i, row + i + 1, next + i});
      if (!isTriangle || i + 1 < cells)
        triangles.insert(triangles.end(), {row + i + 1, next + i + 1, next + i});
    }
  }

  /// A curved patch with holes: triangles of about the cells' size, straight lines cut too, as the
  /// surface beside them need not be flat.
  void addWithHoles(const Patch& patch, const PatchSurface& surface) {
    DividedLines lines = lines_;
    for (const Loop& loop : patch.loops) {
      for (const OrientedLine& line : loop) {
        const Curve& curve = resolved_.curve(line.line);
        if (!curve.isStraight()) continue;
        lines.divisions[line.line] = cutEvenly(curve, kGridCells);
        lines.nodes[line.line].assign(kGridCells + 1, PlanarMesh::kNone);
      }
    }
    addMeshed(patch, surface, lines, extentOf(patch) / kGridCells);
  }

  void addMeshed(const Patch& patch, const PatchSurface& surface, const DividedLines& lines,
                 double size) {
    const SizeField field = SizeField::uniform(size);
    PatchBoundary boundary = layOutBoundary(resolved_, patch, surface, field, lines);
    if (!findFaultySides(boundary).empty()) return;
    PlanarMesh& mesh = boundary.mesh;
    const PatchMetric metric(surface, field);
    PlanarFront front(metric, mesh);
    if (front.advance(kFrontBudget) != MeshStatus::kDone) return;
    const std::uint32_t first = nextPoint();
    for (const Vec3& place : mesh.places) append(preview_.patchPoints, place);
    for (const std::uint32_t node : mesh.triangles) preview_.patchTriangles.push_back(first + node);
  }

  [[nodiscard]] double extentOf(const Patch& patch) const {
    Vec3 low = resolved_.curve(patch.loops.front().front()).start();
    Vec3 high = low;
    for (const Vec3& sample : sampleLoop(resolved_, patch.loops.front(), kBoundaryPieces)) {
      low = glm::min(low, sample);
      high = glm::max(high, sample);
    }
    return glm::length(high - low);
  }

  [[nodiscard]] std::uint32_t nextPoint() const {
    return static_cast<std::uint32_t>(preview_.patchPoints.size() / 3);
  }

  const Model* model_;
  const ModelExamination* found_;
  ResolvedModel resolved_;
  DividedLines lines_;
  ModelPreview preview_;
};

}  // namespace

ModelPreview sampleModel(const Model& model) {
  ModelExamination found = examineModel(model);
  ModelPreview preview = PreviewBuilder(model, found).build();
  preview.diagnostics = std::move(found.diagnostics);
  return preview;
}

ModelPreview previewModel(const Model& model, const BackgroundGrid& grid, double size) {
  ModelPreview preview = sampleModel(model);
  const bool usesGrid = !(size > 0.0);
  std::vector<Diagnostic> found =
      usesGrid ? checkBackgroundGrid(grid) : checkSizeSources(grid.sources);
  if (usesGrid && found.empty())
    found = checkCoverage(model, preview, SizeField::fromGrid(GridLocator(grid)));
  for (Diagnostic& diagnostic : found) preview.diagnostics.push_back(std::move(diagnostic));
  return preview;
}

}  // namespace tetrafront
