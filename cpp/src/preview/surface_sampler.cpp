#include "preview/surface_sampler.h"

#include <algorithm>
#include <utility>

#include "base/ids.h"
#include "base/sort.h"
#include "base/tolerance.h"
#include "model/patch_projection.h"
#include "surface/patch_boundary.h"
#include "surface/planar_front.h"
#include "surface/tube_boundary.h"

namespace tetrafront {

namespace {

/// Segments of a curved line's polyline.
constexpr std::uint32_t kLineSegments = 48;
/// Sides of a curved line that only planar patches use.
constexpr std::uint32_t kBoundarySides = 24;
/// Rows and columns of a curved patch's lattice, and sides of its lines: patches that share a line have the same nodes
/// there.
constexpr std::uint32_t kLatticeCells = 16;
/// Largest distance of a lattice's border from its line / length of the line. The border points are moved onto the line.
constexpr double kMaxBorderDistance = 1e-6;
/// Edges taken from a patch's front before it is abandoned. Typical models need some hundreds.
constexpr std::uint32_t kFrontBudget = 200'000;

void append(std::vector<double>& points, const Vec3& position) {
  points.insert(points.end(), {position.x, position.y, position.z});
}

/// Divides a curve into sides of equal parameter length.
LineDivision divideEvenly(const Curve& curve, std::uint32_t sides) {
  LineDivision division;
  for (std::uint32_t i = 0; i <= sides; ++i) {
    division.parameters.push_back(static_cast<double>(i) / sides);
    division.nodes.push_back(curve.position(division.parameters.back()));
  }
  return division;
}

/// Samples one patch after the other.
class SurfaceSampler {
 public:
  SurfaceSampler(const Model& model, const CheckedModel& found, std::uint32_t refinement)
      : model_(&model),
        found_(&found),
        cells_(kLatticeCells * refinement),
        boundarySides_(kBoundarySides * refinement),
        resolved_(model, found.usableLines) {
    findLinesOfLattices();
    addLines();
    sampled_.preview.patchOffsets.push_back(0);
    sampled_.isConforming.assign(model.patches.size(), 0);
  }

  /// Adds the samples of the next patch; none if it is not selected or cannot be drawn.
  void addPatch(std::uint32_t patch, bool isSelected) {
    ModelPreview& preview = sampled_.preview;
    if (isSelected && found_->usablePatches[patch] != 0) samplePatch(patch);
    preview.patchOffsets.push_back(static_cast<std::uint32_t>(preview.patchTriangles.size() / 3));
  }

  [[nodiscard]] SampledModel take() { return std::move(sampled_); }

 private:
  void findLinesOfLattices() {
    isOnLattice_.assign(model_->lines.size(), 0);
    for (std::size_t patch = 0; patch < model_->patches.size(); ++patch) {
      if (found_->usablePatches[patch] == 0) continue;
      const PatchType type = model_->patches[patch].type;
      if (type == PatchType::kPlanar || type == PatchType::kTube) continue;
      for (const Loop& loop : model_->patches[patch].loops)
        for (const OrientedLine& walked : loop)
          isOnLattice_[found_->duplicates.lines[walked.line].index()] = 1;
    }
  }

  void addLines() {
    ModelPreview& preview = sampled_.preview;
    preview.lineOffsets.push_back(0);
    lines_.divisions.resize(model_->lines.size());
    lines_.nodes.resize(model_->lines.size());
    nextNode_ = static_cast<std::uint32_t>(model_->points.size());
    for (const LineId line : IdRange<LineId>(model_->lines.size())) {
      if (found_->usableLines[line.index()] != 0) addLine(line);
      preview.lineOffsets.push_back(static_cast<std::uint32_t>(preview.linePoints.size() / 3));
    }
  }

  void addLine(LineId line) {
    const Curve& curve = resolved_.curve(line);
    const std::uint32_t shown = curve.isStraight() ? 1 : kLineSegments;
    for (const Vec3& position : divideEvenly(curve, shown).nodes)
      append(sampled_.preview.linePoints, position);
    const LineId first = found_->duplicates.lines[line.index()];
    const std::uint32_t alone = curve.isStraight() ? 1 : boundarySides_;
    lines_.divisions[line.index()] =
        divideEvenly(curve, isOnLattice_[first.index()] != 0 ? cells_ : alone);
    numberNodes(line, first);
  }

  /// Points at the same position are one node, and so are the points of lines that were drawn twice.
  void numberNodes(LineId line, LineId first) {
    const std::vector<std::uint32_t>& points = model_->lines[line.index()].points;
    std::vector<NodeId>& nodes = lines_.nodes[line.index()];
    nodes.resize(lines_.divisions[line.index()].nodes.size());
    const auto [from, to] = std::minmax(points.front(), points.back());
    nodes.front() = NodeId(found_->duplicates.points[from].value);
    nodes.back() = NodeId(found_->duplicates.points[to].value);
    const std::size_t inner = nodes.size() - 2;
    const int direction = first == line ? 0 : directionAlong(line, first);
    for (std::size_t i = 1; i <= inner; ++i) {
      if (direction == 0) nodes[i] = NodeId(nextNode_++);
      if (direction > 0) nodes[i] = lines_.nodes[first.index()][i];
      if (direction < 0) nodes[i] = lines_.nodes[first.index()][inner + 1 - i];
    }
  }

  /// Returns 1 if the nodes of `line` coincide with those of `other`, -1 if they do so in the opposite order, else 0.
  [[nodiscard]] int directionAlong(LineId line, LineId other) const {
    const std::vector<Vec3>& a = lines_.divisions[line.index()].nodes;
    const std::vector<Vec3>& b = lines_.divisions[other.index()].nodes;
    if (a.size() != b.size() || a.size() < 3) return 0;
    const double tolerance = kMaxBorderDistance * resolved_.curve(line).length();
    bool isAlong = true;
    bool isAgainst = true;
    for (std::size_t i = 0; i < a.size(); ++i) {
      isAlong = isAlong && glm::length(a[i] - b[i]) <= tolerance;
      isAgainst = isAgainst && glm::length(a[i] - b[b.size() - 1 - i]) <= tolerance;
    }
    return isAlong ? 1 : (isAgainst ? -1 : 0);
  }

  void samplePatch(std::uint32_t patch) {
    const Patch& drawn = model_->patches[patch];
    const PatchSurface surface(resolved_, drawn);
    if (hasCurvedHoles(drawn)) {
      // Triangles of about the size of a lattice cell.
      addTriangulation(patch, surface, extentOf(drawn) / cells_);
    } else if (drawn.type == PatchType::kTube) {
      addTube(patch, surface);
    } else if (const MappedSurface* curved = surface.mapped()) {
      const std::uint32_t first = nextPoint();
      addLattice(curved->unitSurface());
      const bool isConforming = conformBorder(drawn, curved->unitSurface().shape(), first);
      sampled_.isConforming[patch] = isConforming ? 1 : 0;
    } else {
      // A size larger than all sides: away from short sides, triangles grow as fast as the front permits.
      addTriangulation(patch, surface, extentOf(drawn));
    }
  }

  /// Adds the rows of the unit square, or those of the unit triangle, each of which is one point shorter than the last.
  void addLattice(const UnitSurface& surface) {
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

  /// A node in a row around a tube.
  struct RowNode {
    double xi;
    std::uint32_t point;  ///< of the samples
  };

  /// Adds rows around a tube: the nodes of its rims, and between them one node per ruling from any node of a rim.
  void addTube(std::uint32_t patch, const PatchSurface& surface) {
    const Patch& drawn = model_->patches[patch];
    const TubeSurface& tube = *surface.mapped()->unitSurface().tube();
    const std::vector<RowNode> first =
        addRim(nodesOfRim(resolved_, drawn.loops[0], tube.first(), lines_),
               [](double part) { return part; });
    const std::vector<RowNode> second =
        addRim(nodesOfRim(resolved_, drawn.loops[1], tube.second(), lines_),
               [&](double part) { return tube.xiOfSecond(part); });
    std::vector<double> rulings;
    for (const RowNode& node : first) rulings.push_back(node.xi);
    for (const RowNode& node : second) rulings.push_back(node.xi);
    stableSort(rulings);
    const auto same = std::ranges::unique(
        rulings, [](double a, double b) { return b - a <= Tolerance::kCoincidence; });
    rulings.erase(same.begin(), same.end());
    std::vector<RowNode> row = first;
    for (std::uint32_t j = 1; j < cells_; ++j) {
      std::vector<RowNode> next;
      for (const double xi : rulings) {
        next.push_back({xi, nextPoint()});
        addPoint(tube.evaluate({xi, static_cast<double>(j) / cells_}).position, nextNode_++);
      }
      joinRows(row, next);
      row = std::move(next);
    }
    joinRows(row, second);
    sampled_.isConforming[patch] = 1;
  }

  template <class XiOf>
  std::vector<RowNode> addRim(const std::vector<RimNode>& nodes, XiOf&& xiOf) {
    std::vector<RowNode> row;
    for (const RimNode& node : nodes) {
      row.push_back({xiOf(node.part), nextPoint()});
      addPoint(node.position, node.node.value);
    }
    stableSort(row, [](const RowNode& a, const RowNode& b) { return a.xi < b.xi; });
    return row;
  }

  /// Adds the triangles between two rows, both in ascending order.
  void joinRows(const std::vector<RowNode>& row, const std::vector<RowNode>& next) {
    const auto at = [](const std::vector<RowNode>& nodes, std::size_t i) {
      const RowNode& node = nodes[i % nodes.size()];
      return RowNode{node.xi + (i < nodes.size() ? 0.0 : 1.0), node.point};
    };
    std::vector<std::uint32_t>& triangles = sampled_.preview.patchTriangles;
    for (std::size_t i = 0, j = 0; i < row.size() || j < next.size();) {
      const RowNode after = at(row, i + 1);
      const RowNode afterNext = at(next, j + 1);
      const bool isOnRow = j == next.size() || (i < row.size() && after.xi <= afterNext.xi);
      triangles.insert(triangles.end(),
                       {at(row, i).point, (isOnRow ? after : afterNext).point, at(next, j).point});
      ++(isOnRow ? i : j);
    }
  }

  /// Moves the border points of a lattice onto the nodes of its lines, from which they differ by rounding. Returns false
  /// if they differ by more.
  bool conformBorder(const Patch& patch, UnitShape shape, std::uint32_t first) {
    bool isConforming = true;
    for (std::size_t side = 0; side < patch.loops.front().size(); ++side) {
      const OrientedLine& walked = patch.loops.front()[side];
      const bool isBackward = walked.reversed != resolved_.isFlipped(LineId(walked.line));
      const LineDivision& division = lines_.divisions[walked.line];
      const double tolerance = kMaxBorderDistance * resolved_.curve(LineId(walked.line)).length();
      for (std::uint32_t i = 0; i <= cells_; ++i) {
        const Vec2 unit = unitBorder(shape, side, static_cast<double>(i) / cells_);
        const auto column = static_cast<std::uint32_t>(unit.x * cells_ + 0.5);
        const auto row = static_cast<std::uint32_t>(unit.y * cells_ + 0.5);
        // Rows of a triangle are cells_ + 1, cells_, cells_ - 1, ... points long.
        const std::uint32_t missing =
            shape == UnitShape::kTriangle && row > 0 ? row * (row - 1) / 2 : 0;
        const std::uint32_t point = first + row * (cells_ + 1) - missing + column;
        const std::uint32_t node = isBackward ? cells_ - i : i;
        const Vec3& position = division.nodes[node];
        isConforming = isConforming && glm::length(sampleAt(sampled_.preview.patchPoints, point) -
                                                   position) <= tolerance;
        for (int axis = 0; axis < 3; ++axis)
          sampled_.preview.patchPoints[3 * std::size_t{point} + axis] = position[axis];
        sampled_.nodes[point] = lines_.nodes[walked.line][node].value;
      }
    }
    return isConforming;
  }

  /// Adds the cells between two rows of a lattice; the last cell of a triangle's row is one triangle.
  void addCells(std::uint32_t row, std::uint32_t next, std::uint32_t cells, bool isTriangle) {
    std::vector<std::uint32_t>& triangles = sampled_.preview.patchTriangles;
    for (std::uint32_t i = 0; i < cells; ++i) {
      triangles.insert(triangles.end(), {row + i, row + i + 1, next + i});
      if (!isTriangle || i + 1 < cells)
        triangles.insert(triangles.end(), {row + i + 1, next + i + 1, next + i});
    }
  }

  void addTriangulation(std::uint32_t number, const PatchSurface& surface, double size) {
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
    sampled_.isConforming[number] = 1;
  }

  void addPoint(const Vec3& position, std::uint32_t node) {
    append(sampled_.preview.patchPoints, position);
    sampled_.nodes.push_back(node);
  }

  [[nodiscard]] double extentOf(const Patch& patch) const {
    return loopExtent(resolved_, spanningLoops(patch), kBoundarySides);
  }

  [[nodiscard]] std::uint32_t nextPoint() const {
    return static_cast<std::uint32_t>(sampled_.nodes.size());
  }

  const Model* model_;
  const CheckedModel* found_;
  std::uint32_t cells_;
  std::uint32_t boundarySides_;
  ResolvedModel resolved_;
  /// Per line that is the first of its course: 1 if it is the border of a lattice.
  std::vector<std::uint8_t> isOnLattice_;
  DividedLines lines_;
  std::uint32_t nextNode_ = 0;
  SampledModel sampled_;
};

}  // namespace

Task<SampledModel> sampleSurface(Work& work, const Model& model, const CheckedModel& found) {
  SurfaceSampler sampler(model, found, 1);
  const std::size_t count = model.patches.size();
  for (std::uint32_t patch = 0; patch < count; ++patch) {
    sampler.addPatch(patch, true);
    work.setFraction(static_cast<double>(patch + 1) / static_cast<double>(count));
    co_await work.spend(kUnitsPerPatch);
  }
  co_return sampler.take();
}

SampledModel sampleFinely(const Model& model, const CheckedModel& found, std::uint32_t refinement,
                          std::span<const std::uint32_t> patches) {
  SurfaceSampler sampler(model, found, refinement);
  for (std::uint32_t patch = 0; patch < model.patches.size(); ++patch)
    sampler.addPatch(patch, std::ranges::find(patches, patch) != patches.end());
  return sampler.take();
}

}  // namespace tetrafront
