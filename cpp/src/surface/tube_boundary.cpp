#include "surface/tube_boundary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "base/sort.h"
#include "base/tolerance.h"
#include "surface/carrier_table.h"
#include "surface/line_mesher.h"
#include "surface/rules.h"

namespace tetrafront {

namespace {

/// A seam from the first rim to the second; it is inclined if `first` and `second` differ.
struct Seam {
  double first = 0.0;         ///< xi on the first rim
  double second = 0.0;        ///< xi on the second rim
  std::vector<Vec2> units;    ///< of its nodes between the rims
  std::size_t firstNode = 0;  ///< in PatchBoundary::seam
};

class TubeBoundaryBuilder {
 public:
  TubeBoundaryBuilder(const ResolvedModel& model, const Patch& patch, const PatchSurface& surface,
                      const SizeField& field, const DividedLines& lines)
      : surface_(surface.mapped()),
        tube_(surface_->unitSurface().tube()),
        patchSurface_(&surface),
        field_(&field),
        firstSeamNode_(lines.nodeCount),
        first_(nodesOfRim(model, patch.loops[0], tube_->first(), lines)),
        second_(nodesOfRim(model, patch.loops[1], tube_->second(), lines)) {}

  PatchBoundary run() {
    for (RimNode& node : second_) node.part = tube_->xiOfSecond(node.part);
    stableSort(second_, [](const RimNode& a, const RimNode& b) { return a.part < b.part; });
    placeSeams();
    boundary_.loops = {0};
    for (std::size_t strip = 0; strip < seams_.size(); ++strip) addStrip(strip);
    addCarriers();
    boundary_.mesh.boundaryCount = static_cast<std::uint32_t>(nodeCount());
    return std::move(boundary_);
  }

 private:
  [[nodiscard]] std::size_t nodeCount() const { return boundary_.mesh.plane.size(); }

  /// Places a seam at each crease; without creases, one from the start of the first rim to the opposite node.
  void placeSeams() {
    const std::span<const double> creases = tube_->creases();
    if (creases.empty()) {
      addSeam(0.0);
    } else {
      for (const double crease : creases) addSeam(crease);
    }
  }

  void addSeam(double xi) {
    Seam seam;
    seam.first = xi;
    const RimNode& from = nodeNear(first_, xi);
    const RimNode& to = nodeNear(second_, xi);
    // The difference of their xi, from -1/2 to 1/2.
    seam.second = xi + (wrapped(to.part - xi + 0.5) - 0.5);
    seam.firstNode = boundary_.seam.size();
    const Curve ruling(LineType::kStraight, {from.position, to.position});
    const StretchedPlane& plane = surface_->stretchedPlane();
    const Vec2 start = plane.toPlane({seam.first, 0.0});
    const Vec2 end = plane.toPlane({seam.second, 1.0});
    const LineDivision division = divideLine(ruling, *field_, 1);
    for (std::size_t i = 1; i < division.sideCount(); ++i) {
      const Vec2 unit = plane.toUnit(start + division.parameters[i] * (end - start));
      seam.units.push_back(unit);
      boundary_.seam.push_back(patchSurface_->evaluate(planeOf(unit, seams_.size())).position);
    }
    seams_.push_back(std::move(seam));
  }

  /// Returns the node nearest to xi, all around.
  static const RimNode& nodeNear(const std::vector<RimNode>& nodes, double xi) {
    const auto distance = [&](const RimNode& node) {
      return std::fabs(wrapped(node.part - xi + 0.5) - 0.5);
    };
    return *std::ranges::min_element(nodes, {}, distance);
  }

  /// Adds the loop around the strip that follows seam `strip`.
  void addStrip(std::size_t strip) {
    const bool isLast = strip + 1 == seams_.size();
    const Seam& left = seams_[strip];
    Seam right = seams_[isLast ? 0 : strip + 1];
    const double turn = isLast ? 1.0 : 0.0;
    right.first += turn;
    right.second += turn;
    strip_ = strip;
    const std::size_t firstNode = nodeCount();
    std::array<std::size_t, 4> corners{};
    corners[0] = nodeCount();
    addRim(first_, left.first, right.first, 0.0, false);
    corners[1] = nodeCount() - 1;
    boundary_.origins.back().line = {};
    for (std::size_t i = 0; i < right.units.size(); ++i) addSeamNode(right, i, turn);
    corners[2] = nodeCount();
    addRim(second_, left.second, right.second, 1.0, true);
    corners[3] = nodeCount() - 1;
    boundary_.origins.back().line = {};
    for (std::size_t i = left.units.size(); i-- > 0;) addSeamNode(left, i, 0.0);
    const std::size_t end = nodeCount();
    for (std::size_t node = firstNode; node < end; ++node)
      boundary_.mesh.sides.push_back(
          {PlanarNodeId(node), PlanarNodeId(node + 1 == end ? firstNode : node + 1)});
    corners_.push_back(corners);
  }

  /// Adds the nodes of a rim from one xi to another, which are nodes themselves.
  void addRim(const std::vector<RimNode>& nodes, double from, double to, double eta,
              bool isBackward) {
    const std::size_t first =
        static_cast<std::size_t>(&nodeNear(nodes, wrapped(from)) - nodes.data());
    const double width = to - from;
    std::vector<RimNode> run;
    for (std::size_t i = 0; i <= nodes.size(); ++i) {
      RimNode node = nodes[(first + i) % nodes.size()];
      const double along = i == 0 ? 0.0 : i == nodes.size() ? 1.0 : wrapped(node.part - from);
      const bool isEnd = std::fabs(along - width) <= Tolerance::kCoincidence;
      node.part = isEnd ? to : from + along;
      run.push_back(node);
      if (isEnd) break;
    }
    const std::size_t count = run.size();
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t at = isBackward ? count - 1 - i : i;
      addNode(run[at], {run[at].part, eta}, lineAt(run, at, isBackward));
    }
  }

  /// Returns the line of the side that begins at node `at` of a rim in the direction of the strip's loop.
  [[nodiscard]] LineId lineAt(const std::vector<RimNode>& run, std::size_t at,
                              bool isBackward) const {
    if (!isBackward) return run[at].line;
    if (at == 0) return {};
    return run[tube_->isReversed() ? at : at - 1].line;
  }

  [[nodiscard]] Vec2 planeOf(const Vec2& unit, std::size_t strip) const {
    return surface_->stripToPlane(unit, strip);
  }

  void addNode(const RimNode& node, const Vec2& unit, LineId lineOfSide) {
    add(node.position, unit, node.node, lineOfSide);
  }

  void addSeamNode(const Seam& seam, std::size_t i, double shift) {
    const std::size_t node = seam.firstNode + i;
    add(boundary_.seam[node], {seam.units[i].x + shift, seam.units[i].y},
        NodeId(firstSeamNode_ + node), {});
  }

  void add(const Vec3& position, const Vec2& unit, NodeId node, LineId lineOfSide) {
    boundary_.mesh.addNode(planeOf(unit, strip_), position, field_->sizeAt(position, hint_));
    boundary_.mesh.surfaceNodes.back() = node;
    boundary_.origins.push_back({lineOfSide, 0});
  }

  void addCarriers() {
    PlanarMesh& mesh = boundary_.mesh;
    PlaneBox region = PlaneBox::of(mesh.plane.front(), mesh.plane.front());
    for (const Vec2& node : mesh.plane) region.include(node);
    CarrierTable table(region);
    for (std::size_t strip = 0; strip < corners_.size(); ++strip) {
      const std::array<std::size_t, 4>& corners = corners_[strip];
      const std::size_t end = strip + 1 < corners_.size() ? corners_[strip + 1][0] : nodeCount();
      for (std::size_t k = 0; k < corners.size(); ++k) {
        const std::size_t to = corners[(k + 1) % corners.size()];
        const CarrierId carrier = table.findOrAdd(mesh.plane[corners[k]], mesh.plane[to]);
        const std::size_t last = k + 1 < corners.size() ? to : end;
        for (std::size_t node = corners[k]; node < last; ++node) mesh.addCarrier(node, carrier);
        mesh.addCarrier(to, carrier);
      }
    }
  }

  const MappedSurface* surface_;
  const TubeSurface* tube_;
  const PatchSurface* patchSurface_;
  const SizeField* field_;
  std::size_t firstSeamNode_;
  std::vector<RimNode> first_;
  std::vector<RimNode> second_;  ///< in run(), `part` becomes the xi
  std::vector<Seam> seams_;
  std::vector<std::array<std::size_t, 4>> corners_;  ///< per strip: nodes of the mesh
  std::size_t strip_ = 0;                            ///< to which nodes are added
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
