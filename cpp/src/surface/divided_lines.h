#pragma once

/// @file The lines of a model, divided into sides once for all patches. Patches are watertight because they use the
/// same nodes along the lines that they share.

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "field/size_field.h"
#include "model/resolved_model.h"
#include "surface/line_mesher.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

/// Per line its division, and the surface nodes of the division, both in the curve's canonical direction. Lines that
/// no patch uses have neither.
struct DividedLines {
  std::vector<LineDivision> divisions;
  std::vector<std::vector<NodeId>> nodes;
  /// Number of all nodes; patches number their own nodes from there on.
  std::uint32_t nodeCount = 0;
};

/// A line, and one of its sides in the curve's canonical direction.
using LineSide = std::pair<LineId, std::uint32_t>;

/// Divides the lines that patches use, and numbers their nodes: first the end points of lines in the order of the
/// model, then the inner nodes line by line.
class LineDivider {
 public:
  /// `model` must outlive this.
  explicit LineDivider(const ResolvedModel& model);

  [[nodiscard]] const DividedLines& lines() const { return lines_; }
  [[nodiscard]] std::size_t lineCount() const { return isUsed_.size(); }
  [[nodiscard]] bool isUsed(LineId line) const { return isUsed_[line.index()] != 0; }

  /// Divides a used line, or divides it again. `trace`: see surface_trace.h.
  template <class Trace>
  const LineDivision& divide(LineId line, const SizeField& field, Trace trace);

  /// Makes a used line one side. `trace` as above.
  template <class Trace>
  const LineDivision& keepWhole(LineId line, const SizeField& field, Trace trace);

  /// Adds a node in the middle of each side, and numbers all nodes again.
  template <class Trace>
  void halveSides(const std::set<LineSide>& sides, Trace trace);

  /// Sets lines().nodes.
  void numberNodes();

  /// Writes the nodes, in their order, and the sides of all lines to an empty surface.
  void writeTo(SurfaceMesh& mesh) const;

 private:
  void findUsedLines();
  void findMinSides();

  const ResolvedModel* model_;
  std::vector<std::uint8_t> isUsed_;     ///< per line
  std::vector<std::uint32_t> minSides_;  ///< per line
  std::vector<PointId> endPoints_;       ///< points of the model that are nodes, ascending
  DividedLines lines_;
};

}  // namespace tetrafront
