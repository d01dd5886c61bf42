#include "volume/element_index.h"

#include <algorithm>

#include "base/sort.h"

namespace tetrafront {
namespace {

constexpr std::size_t kElementsPerStep = 100;

}  // namespace

void ElementIndex::begin(std::size_t nodeCount) {
  listed_ = elements_.size();
  lists_ = NodeLists<TetId>(nodeCount);
  firstLink_.clear();
  links_.clear();
  next_ = 0;
  if (listed_ == 0) lists_.endCounting();
}

std::size_t ElementIndex::build(std::size_t budget) {
  const std::size_t left = 2 * listed_ - next_;
  // Compare before multiplying: the product can exceed 32 bits.
  const std::size_t done = left / kElementsPerStep < budget ? left : kElementsPerStep * budget;
  for (const std::size_t last = next_ + done; next_ < last; ++next_) {
    const bool isCounting = next_ < listed_;
    if (next_ == listed_) lists_.endCounting();
    const TetId element(isCounting ? next_ : next_ - listed_);
    for (const NodeId node : elements_.nodes[element.index()]) {
      if (isCounting) {
        lists_.count(node);
      } else {
        lists_.add(node, element);
      }
    }
  }
  return 1 + done / kElementsPerStep;
}

void ElementIndex::chainNew() {
  for (std::size_t e = listed_ + links_.size() / 4; e < elements_.size(); ++e) {
    for (const NodeId node : elements_.nodes[e]) {
      if (node.index() >= firstLink_.size()) firstLink_.resize(node.index() + 1);
      links_.push_back(firstLink_[node.index()]);
      firstLink_[node.index()] = LinkId(links_.size() - 1);
    }
  }
}

template <class Take>
void ElementIndex::forEachAt(NodeId node, const Take& take) const {
  for (const TetId element : lists_.at(node)) take(element);
  if (node.index() >= firstLink_.size()) return;
  for (LinkId link = firstLink_[node.index()]; !link.isNone(); link = links_[link.index()]) {
    take(TetId(listed_ + link.index() / 4));
  }
}

std::vector<TetId> ElementIndex::around(std::vector<NodeId> nodes, std::uint32_t rings,
                                        std::size_t enough) {
  chainNew();
  std::vector<NodeId> rim = nodes;
  std::vector<TetId> elements;
  std::vector<TetId> found;
  for (std::uint32_t ring = 0; ring < rings && !rim.empty() && elements.size() < enough; ++ring) {
    found.clear();
    for (const NodeId node : rim) {
      forEachAt(node, [&](TetId element) {
        if (elements_.removed[element.index()] == 0) found.push_back(element);
      });
    }
    elements.insert(elements.end(), found.begin(), found.end());
    sortUnique(elements);
    rim.clear();
    for (const TetId element : found) {
      const NodeQuad& quad = elements_.nodes[element.index()];
      rim.insert(rim.end(), quad.begin(), quad.end());
    }
    sortUnique(rim);
    std::erase_if(
        rim, [&](NodeId node) { return std::binary_search(nodes.begin(), nodes.end(), node); });
    nodes.insert(nodes.end(), rim.begin(), rim.end());
    stableSort(nodes);
  }
  return elements;
}

}  // namespace tetrafront
