#include "surface/tube_boundary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/sort.h"
#include "surface/carrier_table.h"
#include "surface/line_mesher.h"

namespace tetrafront {

namespace {

/// Sections of a tube, and positions around each, at which the size is compared with the circumference.
constexpr int kTubeSections = 9;
constexpr int kAroundSection = 24;
/// Fewest elements around a tube.
constexpr double kFewestAround = 6.0;
/// Growth of the size per unit of distance from a tube.
constexpr double kTubeGrowth = 0.5;

class TubeBoundaryBuilder {
 public:
  TubeBoundaryBuilder(const ResolvedModel& model, const Patch& patch, const PatchSurface& surface,
                      const SizeField& field, const DividedLines& lines)
      : surface_(&surface),
        plane_(&surface.mapped()->stretchedPlane()),
        tube_(surface.mapped()->unitSurface().tube()),
        field_(&field),
        firstSeamNode_(lines.nodeCount),
        first_(nodesOfRim(model, patch.loops[0], tube_->first(), lines)),
        second_(nodesOfRim(model, patch.loops[1], tube_->second(), lines)) {}

  PatchBoundary run() {
    orderSecond();
    divideSeam();
    boundary_.loops = {0};
    std::array<std::size_t, 4> corners{};
    corners[0] = nodeCount();
    for (const RimNode& node : first_) addNode(node, {node.part, 0.0}, node.line);
    corners[1] = nodeCount();
    addNode(first_.front(), {1.0, 0.0}, {});
    for (std::size_t i = 0; i < seam_.size(); ++i) addSeamNode(i, 1.0);
    corners[2] = nodeCount();
    const std::size_t count = second_.size();
    addNode(second_.front(), {second_.front().part + 1.0, 1.0}, lineAfter(count - 1));
    for (std::size_t i = count; i-- > 1;)
      addNode(second_[i], {second_[i].part, 1.0}, lineAfter(i - 1));
    corners[3] = nodeCount();
    addNode(second_.front(), {second_.front().part, 1.0}, {});
    for (std::size_t i = seam_.size(); i-- > 0;) addSeamNode(i, 0.0);
    addSides();
    addCarriers(corners);
    boundary_.mesh.boundaryCount = static_cast<std::uint32_t>(nodeCount());
    return std::move(boundary_);
  }

 private:
  [[nodiscard]] std::size_t nodeCount() const { return boundary_.mesh.plane.size(); }

  /// Sorts the nodes of the second rim by their xi, from the node nearest to xi = 0, which may be negative.
  void orderSecond() {
    for (RimNode& node : second_) node.part = tube_->xiOfSecond(node.part);
    stableSort(second_, [](const RimNode& a, const RimNode& b) { return a.part < b.part; });
    if (1.0 - second_.back().part >= second_.front().part) return;
    std::ranges::rotate(second_, second_.end() - 1);
    second_.front().part -= 1.0;
  }

  /// Returns the line of the side from node i of the second rim to the next one.
  [[nodiscard]] LineId lineAfter(std::size_t i) const {
    return second_[tube_->isReversed() ? (i + 1) % second_.size() : i].line;
  }

  void divideSeam() {
    const Curve ruling(LineType::kStraight, {first_.front().position, second_.front().position});
    const Vec2 from = plane_->toPlane({0.0, 0.0});
    const Vec2 to = plane_->toPlane({second_.front().part, 1.0});
    const LineDivision division = divideLine(ruling, *field_, 1);
    for (std::size_t i = 1; i < division.sideCount(); ++i) {
      const Vec2 plane = from + division.parameters[i] * (to - from);
      seam_.push_back(plane_->toUnit(plane));
      boundary_.seam.push_back(surface_->evaluate(plane).position);
    }
  }

  void addNode(const RimNode& node, const Vec2& unit, LineId lineOfSide) {
    add(node.position, unit, node.node, lineOfSide);
  }

  void addSeamNode(std::size_t i, double shift) {
    add(boundary_.seam[i], {seam_[i].x + shift, seam_[i].y}, NodeId(firstSeamNode_ + i), {});
  }

  void add(const Vec3& position, const Vec2& unit, NodeId node, LineId lineOfSide) {
    boundary_.mesh.addNode(plane_->toPlane(unit), position, field_->sizeAt(position, hint_));
    boundary_.mesh.surfaceNodes.back() = node;
    boundary_.origins.push_back({lineOfSide, 0});
  }

  void addSides() {
    const std::size_t count = nodeCount();
    for (std::size_t node = 0; node < count; ++node)
      boundary_.mesh.sides.push_back({PlanarNodeId(node), PlanarNodeId((node + 1) % count)});
  }

  void addCarriers(const std::array<std::size_t, 4>& corners) {
    PlanarMesh& mesh = boundary_.mesh;
    PlaneBox region = PlaneBox::of(mesh.plane.front(), mesh.plane.front());
    for (const Vec2& node : mesh.plane) region.include(node);
    CarrierTable table(region);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const bool isLast = k + 1 == corners.size();
      const std::size_t end = isLast ? nodeCount() : corners[k + 1];
      const std::size_t to = isLast ? corners.front() : end;
      const CarrierId carrier = table.findOrAdd(mesh.plane[corners[k]], mesh.plane[to]);
      for (std::size_t node = corners[k]; node < end; ++node) mesh.addCarrier(node, carrier);
      mesh.addCarrier(to, carrier);
    }
  }

  const PatchSurface* surface_;
  const StretchedPlane* plane_;
  const TubeSurface* tube_;
  const SizeField* field_;
  std::size_t firstSeamNode_;
  std::vector<RimNode> first_;
  std::vector<RimNode> second_;  ///< after orderSecond(), `part` is the xi
  std::vector<Vec2> seam_;       ///< per node of the seam: its unit coordinates on the left
  FieldHint hint_;
  PatchBoundary boundary_;
};

/// A section of a tube at one eta.
struct Section {
  Vec3 centre{0.0};
  double radius = 0.0;  ///< largest distance from the centre
  double circumference = 0.0;
  double largestSize = 0.0;
};

Section sectionAt(const TubeSurface& tube, double eta, const SizeField& field) {
  std::vector<Vec3> positions;
  for (int i = 0; i < kAroundSection; ++i)
    positions.push_back(tube.evaluate({static_cast<double>(i) / kAroundSection, eta}).position);
  Section section;
  for (const Vec3& position : positions)
    section.centre += position / static_cast<double>(kAroundSection);
  FieldHint hint;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vec3& here = positions[i];
    section.radius = std::max(section.radius, glm::length(here - section.centre));
    section.circumference += glm::length(positions[(i + 1) % positions.size()] - here);
    section.largestSize = std::max(section.largestSize, field.sizeAt(here, hint));
  }
  return section;
}

void appendSources(const TubeSurface& tube, const SizeField& field,
                   std::vector<SizeSource>& sources) {
  Section before = sectionAt(tube, 0.0, field);
  for (int i = 1; i < kTubeSections; ++i) {
    const Section section = sectionAt(tube, static_cast<double>(i) / (kTubeSections - 1), field);
    const double size = std::min(before.circumference, section.circumference) / kFewestAround;
    if (std::max(before.largestSize, section.largestSize) > size) {
      SizeSource& source = sources.emplace_back();
      source.type = SourceType::kSegment;
      source.points = {before.centre, section.centre, Vec3(0.0)};
      source.size = size;
      source.distance = std::max(before.radius, section.radius);
      source.growth = kTubeGrowth;
    }
    before = section;
  }
}

}  // namespace

std::vector<RimNode> nodesOfRim(const ResolvedModel& model, const Loop& loop, const Rim& rim,
                                const DividedLines& lines) {
  std::vector<RimNode> nodes;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const LineId line(loop[i].line);
    const LineDivision& division = lines.divisions[line.index()];
    const bool isBackward = loop[i].reversed != model.isFlipped(line);
    const std::size_t count = division.sideCount();
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t at = isBackward ? count - k : k;
      const double t = isBackward ? 1.0 - division.parameters[at] : division.parameters[at];
      nodes.push_back({lines.nodes[line.index()][at], division.nodes[at], line, rim.partAt(i, t)});
    }
  }
  return nodes;
}

PatchBoundary layOutTube(const ResolvedModel& model, const Patch& patch,
                         const PatchSurface& surface, const SizeField& field,
                         const DividedLines& lines) {
  return TubeBoundaryBuilder(model, patch, surface, field, lines).run();
}

std::vector<SizeSource> sourcesInTubes(const std::vector<PatchSurface>& surfaces,
                                       const SizeField& field) {
  std::vector<SizeSource> sources;
  for (const PatchSurface& surface : surfaces) {
    const MappedSurface* mapped = surface.mapped();
    const TubeSurface* tube = mapped != nullptr ? mapped->unitSurface().tube() : nullptr;
    if (tube != nullptr) appendSources(*tube, field, sources);
  }
  return sources;
}

}  // namespace tetrafront
