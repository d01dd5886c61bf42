#include "lattice/lattice_core.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace tetrafront {
namespace {

/// Rows in which the nodes around centres lie: y and z, from one below those of the centres.
constexpr std::array<std::array<std::uint32_t, 2>, 7> kRowsAround{
    {{1, 1}, {3, 1}, {1, 3}, {0, 0}, {0, 2}, {2, 0}, {2, 2}}};

}  // namespace

/// A row of both sets. Queries must ascend.
class CoreNodes::Row {
 public:
  Row(const CoreNodes& nodes, std::uint32_t y, std::uint32_t z, const RowStart& start)
      : shared_(nodes.shared.rowAt(y, z, start.shared)),
        own_(nodes.own.rowAt(y, z, start.own)),
        firstShared_(nodes.firstShared),
        firstOwn_(nodes.firstOwn) {}

  void skipTo(std::uint32_t x) {
    shared_.skipTo(x);
    own_.skipTo(x);
  }
  [[nodiscard]] NodeId at(std::uint32_t x) {
    const NodeId inOwn = own_.at(x);
    if (!inOwn.isNone()) return NodeId(firstOwn_ + inOwn.value);
    const NodeId inShared = shared_.at(x);
    return inShared.isNone() ? inShared : NodeId(firstShared_ + inShared.value);
  }

 private:
  LatticeNodes::Row shared_;
  LatticeNodes::Row own_;
  std::uint32_t firstShared_;
  std::uint32_t firstOwn_;
};

CoreNodes::RowStart CoreNodes::startOf(std::uint32_t y, std::uint32_t z) const {
  return {static_cast<std::uint32_t>(shared.firstFrom({0, y, z})),
          static_cast<std::uint32_t>(own.firstFrom({0, y, z}))};
}

/// The rows around one of centres, as CentreRow asks for them.
class LatticeCore::RowsAround {
 public:
  RowsAround(const CoreNodes& nodes, const Row& row) : nodes_(nodes), row_(row) {}

  [[nodiscard]] CoreNodes::Row rowAt(std::uint32_t y, std::uint32_t z) const {
    return {nodes_, y, z, row_.starts[indexOf(y, z, row_)]};
  }
  /// Own row, next ones along y and z, and the four of corners.
  static std::size_t indexOf(std::uint32_t y, std::uint32_t z, const Row& row) {
    const bool isAbove = y > row.y;
    if (y % 2 == row.y % 2) return isAbove ? 1 : z > row.z ? 2 : 0;
    return 3 + (isAbove ? 2U : 0U) + (z > row.z ? 1U : 0U);
  }

 private:
  const CoreNodes& nodes_;
  const Row& row_;
};

LatticeCore::LatticeCore(const Lattice& lattice, CoreNodes nodes, std::vector<ElementBits> ofShared,
                         std::vector<ElementBits> ofOwn)
    : lattice_(lattice),
      nodes_(std::move(nodes)),
      ofShared_(std::move(ofShared)),
      ofOwn_(std::move(ofOwn)) {
  listRows();
}

void LatticeCore::listRows() {
  const LatticeNodes& shared = nodes_.shared;
  const LatticeNodes& own = nodes_.own;
  std::uint32_t s = 0;
  std::uint32_t o = 0;
  const auto isBefore = [](const LatticePlace& a, const LatticePlace& b) {
    return a.z != b.z ? a.z < b.z : a.y < b.y;
  };
  while (s < shared.count() || o < own.count()) {
    LatticePlace place;
    if (s < shared.count()) place = shared.placeOf(NodeId(s));
    if (o < own.count()) {
      const LatticePlace other = own.placeOf(NodeId(o));
      if (s == shared.count() || isBefore(other, place)) place = other;
    }
    const auto [y, z] = std::pair(place.y, place.z);
    Row row{.y = y,
            .z = z,
            .firstElement = elementCount_,
            .shared = s,
            .own = o,
            .sharedEnd = static_cast<std::uint32_t>(shared.firstFrom({0, place.y + 1, place.z})),
            .ownEnd = static_cast<std::uint32_t>(own.firstFrom({0, place.y + 1, place.z})),
            .starts = {}};
    for (; s < row.sharedEnd; ++s) elementCount_ += std::popcount(ofShared_[s]);
    for (; o < row.ownEnd; ++o) elementCount_ += std::popcount(ofOwn_[o]);
    if (elementCount_ == row.firstElement) continue;
    for (const auto& [dy, dz] : kRowsAround) {
      const std::uint32_t atY = y + dy - 1;
      const std::uint32_t atZ = z + dz - 1;
      row.starts[RowsAround::indexOf(atY, atZ, row)] = nodes_.startOf(atY, atZ);
    }
    rows_.push_back(row);
  }
}

/// Calls visit(Centre) for the centres of a row with elements, in the order of space, until it returns false.
template <class Visit>
void LatticeCore::forEachCentre(const Row& row, Visit visit) const {
  std::uint32_t s = row.shared;
  std::uint32_t o = row.own;
  while (s < row.sharedEnd || o < row.ownEnd) {
    Centre centre{};
    const bool hasShared = s < row.sharedEnd;
    if (hasShared) {
      centre = {NodeId(nodes_.firstShared + s), nodes_.shared.placeOf(NodeId(s)), ofShared_[s]};
    }
    bool isOwn = !hasShared;
    if (o < row.ownEnd) {
      const LatticePlace place = nodes_.own.placeOf(NodeId(o));
      isOwn = isOwn || place.x < centre.place.x;
      if (isOwn) centre = {NodeId(nodes_.firstOwn + o), place, ofOwn_[o]};
    }
    ++(isOwn ? o : s);
    if (centre.bits != 0 && !visit(centre)) return;
  }
}

ElementSource::Element LatticeCore::elementOf(const CentreNodes& around, const LatticePlace& place,
                                              std::size_t number) const {
  ElementSource::Element element{around.nodesOf(number), {}};
  for (std::size_t k = 0; k < 4; ++k) {
    element.corners[k] = lattice_.positionOf(placeAt(place, kElementNodes[number][k]));
  }
  return element;
}

void LatticeCore::copyElements(std::uint32_t first, std::span<ElementSource::Element> to) const {
  auto row = std::ranges::upper_bound(rows_, first, {}, &Row::firstElement) - 1;
  std::size_t skipped = first - row->firstElement;
  std::size_t copied = 0;
  for (; copied < to.size(); ++row) {
    CentreRow<CoreNodes::Row> nodes(RowsAround(nodes_, *row), row->y, row->z);
    bool isFirst = true;
    forEachCentre(*row, [&](const Centre& centre) {
      const auto count = static_cast<std::size_t>(std::popcount(centre.bits));
      if (skipped >= count) {
        skipped -= count;
        return true;
      }
      if (std::exchange(isFirst, false)) nodes.skipTo(centre.place.x);
      const CentreNodes around = nodes.at(centre.node, centre.place.x);
      for (std::size_t number = 0; number < kElementsPerCentre && copied < to.size(); ++number) {
        if ((centre.bits >> number & 1U) == 0) continue;
        if (skipped > 0) {
          --skipped;
        } else {
          to[copied++] = elementOf(around, centre.place, number);
        }
      }
      return copied < to.size();
    });
  }
}

LatticeCores::LatticeCores(std::vector<LatticeCore> cores, std::uint32_t shared)
    : cores_(std::move(cores)), shared_(shared) {
  for (const LatticeCore& core : cores_) {
    nodeCount_ += static_cast<std::uint32_t>(core.nodes().own.count());
    elementCount_ += core.elementCount();
  }
}

Vec3 LatticeCores::positionOf(std::uint32_t node) const {
  for (const LatticeCore& core : cores_) {
    const std::size_t own = core.nodes().own.count();
    if (node < own) return core.positionOf(node);
    node -= static_cast<std::uint32_t>(own);
  }
  return Vec3(0.0);
}

void LatticeCores::copyElements(std::uint32_t first, std::span<Element> to) const {
  for (const LatticeCore& core : cores_) {
    if (to.empty()) return;
    if (first < core.elementCount()) {
      const std::size_t count = std::min<std::size_t>(to.size(), core.elementCount() - first);
      core.copyElements(first, to.first(count));
      to = to.subspan(count);
      first = 0;
    } else {
      first -= core.elementCount();
    }
  }
}

}  // namespace tetrafront
