#include "volume/front_watch.h"

#include <algorithm>
#include <utility>

#include "base/diagnostics.h"
#include "volume/rules.h"

namespace tetrafront {
namespace {

double sixVolumes(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return glm::dot(glm::cross(b - a, c - a), d - a);
}

}  // namespace

void FrontWatch::begin(const Front& front, double enclosedVolume) {
  enclosedVolume_ = enclosedVolume;
  checkedNodes_ = front.nodes().size();
}

bool FrontWatch::allowsRelaxation(const Elements& elements, std::uint64_t relaxedCost) const {
  return relaxedCost <= kRelaxedCost.of(elements.size(), triangles_);
}

void FrontWatch::look(Front& front, const Elements& elements, std::uint32_t cost) {
  cost_ += cost;
  if (cost_ > kFrontCost.of(elements.size(), triangles_)) front.clearQueue();
  stepsWithoutElement_ = elements.size() > measuredElements_ ? 0 : stepsWithoutElement_ + 1;
  measureNew(front, elements);
  lookAtNodes(front);
  if (!isRunning()) return;
  if (elements.size() > maxTetrahedra_) {
    end_ = End::kTooManyElements;
  } else if (isStuck(front)) {
    end_ = End::kStuck;
  }
}

void FrontWatch::measureNew(const Front& front, const Elements& elements) {
  for (; measuredElements_ < elements.size(); ++measuredElements_) {
    const NodeQuad& n = elements.nodes[measuredElements_];
    filledVolume_ +=
        sixVolumes(front.node(n[0]), front.node(n[1]), front.node(n[2]), front.node(n[3]));
  }
}

/// Checks that the background grid covers each new node (step F1).
void FrontWatch::lookAtNodes(const Front& front) {
  for (; checkedNodes_ < front.nodes().size(); ++checkedNodes_) {
    FieldHint hint = front.hint(NodeId(checkedNodes_));
    if (field_->covers(front.node(NodeId(checkedNodes_)), hint)) continue;
    end_ = End::kOutsideGrid;
    return;
  }
}

/// A valid front never reaches these limits: until it changes, each face can fail only once under each rule class, and its
/// elements fill no more than the boundary encloses.
bool FrontWatch::isStuck(const Front& front) const {
  // Far above the rounding errors of the sums, even if the elements are needles.
  constexpr double kExcess = 0.5;
  constexpr double kExcessPerBox = 1e-9;
  const double extent = front.extent();
  return stepsWithoutElement_ > kRuleClasses.size() * front.activeCount() ||
         filledVolume_ >
             (1.0 + kExcess) * enclosedVolume_ + kExcessPerBox * extent * extent * extent;
}

double FrontWatch::filledFraction() const {
  if (!(enclosedVolume_ > 0.0)) return 0.0;
  return std::clamp(filledVolume_ / enclosedVolume_, 0.0, 1.0);
}

double FrontWatch::fraction(const Elements& elements) const {
  const double spent =
      static_cast<double>(cost_) / static_cast<double>(kFrontCost.of(elements.size(), triangles_));
  return std::max(filledFraction(), std::min(spent, 1.0));
}

std::vector<Diagnostic> FrontWatch::diagnostics(const Front& front,
                                                const Elements& elements) const {
  if (end_ == End::kTooManyElements) {
    // Share of the volume: at the limit the elements may fill almost nothing, and the estimate divides by the share.
    constexpr double kMinFraction = 1e-9;
    const double expected =
        static_cast<double>(elements.size()) / std::max(filledFraction(), kMinFraction);
    Vec3 centroid(0.0);
    for (const NodeId node : elements.nodes.back()) centroid += front.node(node) * 0.25;
    return {tooManyElements(expected, maxTetrahedra_).at(centroid)};
  }
  if (end_ == End::kOutsideGrid) {
    return {
        diagnose<DiagnosticCode::kOutsideBackgroundGrid>().at(front.node(NodeId(checkedNodes_)))};
  }
  return {};
}

}  // namespace tetrafront
