#include "search/quadtree.h"

#include <algorithm>

namespace tetrafront {

namespace {

/// Maximum number of boxes in a leaf: scanning this many costs about as much as one more level.
constexpr std::uint32_t kLeafCapacity = 12;
/// Maximum depth: boxes with equal centres cannot be separated, and 2^-40 of the region is below
/// any size.
constexpr std::uint32_t kMaxDepth = 40;

}  // namespace

PlaneBox PlaneBox::of(const Vec2& a, const Vec2& b) {
  return {{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}};
}

void PlaneBox::include(const Vec2& position) {
  low = {std::min(low.x, position.x), std::min(low.y, position.y)};
  high = {std::max(high.x, position.x), std::max(high.y, position.y)};
}

Quadtree::Quadtree(const PlaneBox& region) {
  Node root;
  root.centre = 0.5 * (region.low + region.high);
  root.halfWidth = 0.5 * (region.high - region.low);
  nodes_.push_back(root);
}

std::uint32_t Quadtree::childAt(const Node& node, const Vec2& centre) const {
  return node.firstChild + (centre.x > node.centre.x ? 1U : 0U) +
         (centre.y > node.centre.y ? 2U : 0U);
}

void Quadtree::insert(std::uint32_t id, const PlaneBox& box) {
  if (id >= items_.size()) items_.resize(std::max<std::size_t>(id + 1, items_.size() * 3 / 2));
  items_[id].box = box;
  const Vec2 centre = 0.5 * (box.low + box.high);
  // The reach is measured from the node's region, so it also covers centres outside the root.
  std::uint32_t at = 0;
  for (;;) {
    Node& node = nodes_[at];
    node.reach.x = std::max({node.reach.x, box.high.x - (node.centre.x + node.halfWidth.x),
                             (node.centre.x - node.halfWidth.x) - box.low.x});
    node.reach.y = std::max({node.reach.y, box.high.y - (node.centre.y + node.halfWidth.y),
                             (node.centre.y - node.halfWidth.y) - box.low.y});
    if (node.firstChild == kNoIndex) break;
    at = childAt(node, centre);
  }
  link(at, id);
  if (nodes_[at].count > kLeafCapacity && nodes_[at].depth < kMaxDepth) split(at);
}

void Quadtree::link(std::uint32_t node, std::uint32_t id) {
  Item& item = items_[id];
  item.leaf = node;
  item.previous = kNoIndex;
  item.next = nodes_[node].head;
  if (item.next != kNoIndex) items_[item.next].previous = id;
  nodes_[node].head = id;
  ++nodes_[node].count;
}

void Quadtree::split(std::uint32_t node) {
  const auto first = static_cast<std::uint32_t>(nodes_.size());
  const Node parent = nodes_[node];
  const Vec2 quarter = 0.5 * parent.halfWidth;
  for (std::uint32_t child = 0; child < 4; ++child) {
    Node part;
    part.centre = {parent.centre.x + ((child & 1U) != 0 ? quarter.x : -quarter.x),
                   parent.centre.y + ((child & 2U) != 0 ? quarter.y : -quarter.y)};
    part.halfWidth = quarter;
    part.depth = parent.depth + 1;
    nodes_.push_back(part);
  }
  nodes_[node].firstChild = first;
  nodes_[node].head = kNoIndex;
  nodes_[node].count = 0;
  for (std::uint32_t id = parent.head; id != kNoIndex;) {
    const std::uint32_t next = items_[id].next;
    const PlaneBox& box = items_[id].box;
    const std::uint32_t at = childAt(nodes_[node], 0.5 * (box.low + box.high));
    Node& part = nodes_[at];
    part.reach.x = std::max({part.reach.x, box.high.x - (part.centre.x + part.halfWidth.x),
                             (part.centre.x - part.halfWidth.x) - box.low.x});
    part.reach.y = std::max({part.reach.y, box.high.y - (part.centre.y + part.halfWidth.y),
                             (part.centre.y - part.halfWidth.y) - box.low.y});
    link(at, id);
    id = next;
  }
}

void Quadtree::remove(std::uint32_t id) {
  Item& item = items_[id];
  Node& leaf = nodes_[item.leaf];
  if (item.previous == kNoIndex)
    leaf.head = item.next;
  else
    items_[item.previous].next = item.next;
  if (item.next != kNoIndex) items_[item.next].previous = item.previous;
  --leaf.count;
  item.leaf = kNoIndex;
}

void Quadtree::query(const PlaneBox& box, std::vector<std::uint32_t>& found) const {
  stack_.assign(1, 0);
  while (!stack_.empty()) {
    const Node& node = nodes_[stack_.back()];
    stack_.pop_back();
    const Vec2 half = node.halfWidth + node.reach;
    if (node.centre.x - half.x > box.high.x || node.centre.x + half.x < box.low.x ||
        node.centre.y - half.y > box.high.y || node.centre.y + half.y < box.low.y)
      continue;
    if (node.firstChild != kNoIndex) {
      for (std::uint32_t child = 0; child < 4; ++child) stack_.push_back(node.firstChild + child);
      continue;
    }
    for (std::uint32_t id = node.head; id != kNoIndex; id = items_[id].next)
      if (items_[id].box.overlaps(box)) found.push_back(id);
  }
}

}  // namespace tetrafront
