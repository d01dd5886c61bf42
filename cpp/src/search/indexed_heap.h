#pragma once

/// @file A heap that stores the slot of each id, so that a face that leaves the front early is
/// removed at once (Löhner & Parikh 1988, second section 6, structure (1)). Four children per node
/// halve the levels of a binary heap for the same number of comparisons. About half of the faces
/// are removed before their turn; lazy deletion would triple the heap.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/ids.h"

namespace tetrafront {

/// Smallest key first. The order of equal keys depends on the sequence of calls, never on
/// addresses. Callers that need more put a sequence number into the low bits of the key.
class IndexedHeap {
 public:
  /// Permits the ids 0 .. count-1.
  void reserveIds(std::size_t count) {
    if (count > slotOf_.size()) slotOf_.resize(std::max(count, slotOf_.size() * 3 / 2), kNoIndex);
  }
  [[nodiscard]] bool empty() const { return entries_.empty(); }
  [[nodiscard]] std::size_t size() const { return entries_.size(); }
  [[nodiscard]] bool contains(std::uint32_t id) const { return slotOf_[id] != kNoIndex; }

  /// `id` must not be in the heap. O(log n).
  void push(std::uint32_t id, std::uint64_t key) {
    entries_.push_back({key, id});
    siftUp(entries_.size() - 1);
  }

  /// Removes and returns the id of the smallest key. O(log n).
  std::uint32_t pop() {
    const std::uint32_t id = entries_.front().id;
    remove(id);
    return id;
  }

  /// Removes `id` if it is in the heap. O(log n).
  void remove(std::uint32_t id) {
    const std::uint32_t at = slotOf_[id];
    if (at == kNoIndex) return;
    slotOf_[id] = kNoIndex;
    const Entry last = entries_.back();
    entries_.pop_back();
    if (last.id == id) return;
    const bool rises = last.key < entries_[at].key;
    put(at, last);
    if (rises) {
      siftUp(at);
    } else {
      siftDown(at);
    }
  }

  void clear() {
    for (const Entry& entry : entries_) slotOf_[entry.id] = kNoIndex;
    entries_.clear();
  }

 private:
  struct Entry {
    std::uint64_t key;
    std::uint32_t id;
  };
  static constexpr std::size_t kChildren = 4;

  void put(std::size_t at, Entry entry) {
    entries_[at] = entry;
    slotOf_[entry.id] = static_cast<std::uint32_t>(at);
  }

  void siftUp(std::size_t at) {
    const Entry entry = entries_[at];
    while (at > 0) {
      const std::size_t parent = (at - 1) / kChildren;
      if (entries_[parent].key <= entry.key) break;
      put(at, entries_[parent]);
      at = parent;
    }
    put(at, entry);
  }

  void siftDown(std::size_t at) {
    const Entry entry = entries_[at];
    for (;;) {
      const std::size_t first = kChildren * at + 1;
      if (first >= entries_.size()) break;
      const std::size_t end = std::min(first + kChildren, entries_.size());
      std::size_t least = first;
      for (std::size_t child = first + 1; child < end; ++child) {
        if (entries_[child].key < entries_[least].key) least = child;
      }
      if (entries_[least].key >= entry.key) break;
      put(at, entries_[least]);
      at = least;
    }
    put(at, entry);
  }

  std::vector<Entry> entries_;
  std::vector<std::uint32_t> slotOf_;
};

}  // namespace tetrafront
