#include "arrangement/cut_graph.h"

#include <algorithm>
#include <cstddef>

#include "base/sort.h"

namespace tetrafront {

void CutGraph::add(const CutSegment& segment) {
  const Vec3 a = points_.rounded(segment.from);
  const Vec3 b = points_.rounded(segment.to);
  const auto u = static_cast<int>(view_.u);
  const auto v = static_cast<int>(view_.v);
  entries_.push_back({segment,
                      {std::min(a[u], b[u]), std::min(a[v], b[v])},
                      {std::max(a[u], b[u]), std::max(a[v], b[v])},
                      {}});
}

void CutGraph::divide() {
  const auto endsOf = [](const Entry& entry) {
    return std::minmax(entry.segment.from, entry.segment.to);
  };
  std::ranges::stable_sort(entries_, [&](const Entry& a, const Entry& b) {
    return a.low.x != b.low.x ? a.low.x < b.low.x : Edge(endsOf(a)) < Edge(endsOf(b));
  });
  const auto last = std::ranges::unique(
      entries_, [&](const Entry& a, const Entry& b) { return Edge(endsOf(a)) == Edge(endsOf(b)); });
  entries_.erase(last.begin(), last.end());
  for (std::size_t i = 0; i < entries_.size() && !points_.isFull(); ++i) {
    for (std::size_t j = i + 1; j < entries_.size(); ++j) {
      // Rounding is monotonic: boxes of rounded ends overlap if the segments do.
      if (entries_[j].low.x > entries_[i].high.x) break;
      if (entries_[j].low.y > entries_[i].high.y || entries_[i].low.y > entries_[j].high.y)
        continue;
      intersect(entries_[i], entries_[j]);
    }
  }
  for (Entry& entry : entries_) emit(entry);
  sortUnique(vertices_);
  stableSort(edges_);
  edges_.erase(std::ranges::unique(edges_).begin(), edges_.end());
}

bool CutGraph::isOnSegment(const CutSegment& segment, CutPointId point) const {
  for (const std::uint32_t axis : {view_.u, view_.v}) {
    const int order = points_.compare(axis, segment.from, segment.to);
    if (order == 0) continue;
    return points_.compare(axis, segment.from, point) == order &&
           points_.compare(axis, point, segment.to) == order;
  }
  return false;
}

int CutGraph::touch(Entry& s, CutPointId end) {
  const int side = points_.orient(view_, s.segment.from, s.segment.to, end);
  if (side == 0 && isOnSegment(s.segment, end)) s.inside.push_back(end);
  return side;
}

void CutGraph::intersect(Entry& s, Entry& t) {
  const auto isPoint = [](const Entry& e) { return e.segment.from == e.segment.to; };
  const auto isEndOf = [](const Entry& e, CutPointId p) {
    return e.segment.from == p || e.segment.to == p;
  };
  if (isPoint(s) && isPoint(t)) return;
  if (isPoint(s)) {
    if (!isEndOf(t, s.segment.from)) touch(t, s.segment.from);
    return;
  }
  if (isPoint(t)) {
    if (!isEndOf(s, t.segment.from)) touch(s, t.segment.from);
    return;
  }
  bool haveCommonEnd = false;
  int product = -1;
  const auto test = [&](Entry& e, const Entry& other) {
    int sides = 1;
    for (const CutPointId end : {other.segment.from, other.segment.to}) {
      if (isEndOf(e, end)) {
        haveCommonEnd = true;
      } else {
        sides *= touch(e, end);
      }
    }
    if (sides >= 0) product = 0;
  };
  test(s, t);
  // If both ends of `t` are on one side of `s`, the ends of `s` can still be on `t` only if an end of `t` is on the line of
  // `s`; the second test decides this too.
  test(t, s);
  if (haveCommonEnd || product == 0) return;
  const CutPointId crossing = points_.addOnPlanes(plane_, s.segment.plane, t.segment.plane);
  if (!isEndOf(s, crossing)) s.inside.push_back(crossing);
  if (!isEndOf(t, crossing)) t.inside.push_back(crossing);
}

void CutGraph::emit(Entry& entry) {
  const auto& [from, to, plane] = entry.segment;
  vertices_.push_back(from);
  if (from == to) return;
  vertices_.push_back(to);
  std::uint32_t axis = view_.u;
  int order = points_.compare(axis, from, to);
  if (order == 0) {
    axis = view_.v;
    order = points_.compare(axis, from, to);
  }
  sortUnique(entry.inside);
  sortFew(entry.inside,
          [&](CutPointId a, CutPointId b) { return points_.compare(axis, a, b) == order; });
  CutPointId before = from;
  const auto join = [&](CutPointId next) {
    edges_.push_back(std::minmax(before, next));
    before = next;
  };
  for (const CutPointId point : entry.inside) {
    vertices_.push_back(point);
    join(point);
  }
  join(to);
}

}  // namespace tetrafront
