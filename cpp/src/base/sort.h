#pragma once

/// @file Sorting with code that all element types share. libc++ compiles std::sort again for each
/// type and order, which adds 2 to 5 kB to the download each time. Here, only the comparison is
/// compiled again.

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <iterator>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace tetrafront {

namespace sorting {

/// Contiguous records of `size` bytes, a multiple of 4 and at most kLargestRecord.
struct Records {
  void* first;
  std::size_t count;
  std::size_t size;
};

constexpr std::size_t kLargestRecord = 128;

/// Order of two records: call(less, a, b) is true if the record at `a` comes before the one at
/// `b`.
struct Before {
  bool (*call)(const void* less, const void* a, const void* b);
  const void* less;

  bool operator()(const void* a, const void* b) const { return call(less, a, b); }
};

/// Merge sort that starts with runs of a few records. O(n log n), and O(n) if the records are
/// already in order.
class RecordSort {
 public:
  /// The records must not move or change until they are sorted.
  explicit RecordSort(const Records& records);

  /// Visits about `budget` records; returns true when the sort is finished. Each record is visited
  /// about log n times. Runs that are already in order are only copied.
  bool advance(std::size_t budget, const Before& before);

 private:
  bool mergeRuns(std::size_t budget, const Before& before);
  void beginMerge(std::size_t at);
  void merge(std::size_t& budget, const Before& before);
  void endMerge();

  std::byte* first_;
  std::size_t size_;
  std::size_t bytes_;
  bool isSorted_ = false;
  std::size_t inRuns_ = 0;               ///< bytes in sorted runs of a few records
  std::unique_ptr<std::byte[]> buffer_;  // NOLINT(*-avoid-c-arrays)
  std::byte* from_ = nullptr;
  std::byte* to_ = nullptr;
  std::size_t length_ = 0;        ///< length of the runs that are merged
  const std::byte* a_ = nullptr;  ///< rest of one run, up to middle_
  const std::byte* b_ = nullptr;  ///< rest of the next run, up to last_
  const std::byte* middle_ = nullptr;
  const std::byte* last_ = nullptr;
  std::byte* out_ = nullptr;
};

/// Sorts in one call.
void sortRecords(const Records& records, const Before& before);

/// True if elements may be moved as bytes. Pairs may be, although their assignment is not trivial.
template <class T>
constexpr bool kIsPlain =
    std::is_trivially_copy_constructible_v<T> && std::is_trivially_destructible_v<T> &&
    sizeof(T) % 4 == 0 && sizeof(T) <= kLargestRecord;

}  // namespace sorting

/// Sorts contiguous plain elements; equal elements keep their order. A comparison costs a call
/// through a pointer. Throws bad_alloc if there is no memory for a second copy; a few elements
/// need none.
template <class Range, class Less = std::less<>>
void stableSort(Range&& range, const Less& less = {}) {
  using T = std::remove_reference_t<decltype(*std::data(range))>;
  static_assert(sorting::kIsPlain<T>);
  const auto call = [](const void* order, const void* a, const void* b) -> bool {
    return (*static_cast<const Less*>(order))(*static_cast<const T*>(a), *static_cast<const T*>(b));
  };
  sorting::sortRecords({std::data(range), std::size(range), sizeof(T)}, {call, &less});
}

/// Does the work of stableSort() in slices.
template <class T, class Less = std::less<>>
class SlicedSort {
 public:
  /// The elements must not move or change until they are sorted.
  explicit SlicedSort(std::span<T> elements, Less less = {})
      : less_(std::move(less)), sort_({elements.data(), elements.size(), sizeof(T)}) {
    static_assert(sorting::kIsPlain<T>);
  }

  /// Visits about `budget` elements, each about log n times; true when finished.
  bool advance(std::size_t budget) {
    const auto call = [](const void* order, const void* a, const void* b) -> bool {
      return (*static_cast<const Less*>(order))(*static_cast<const T*>(a),
                                                *static_cast<const T*>(b));
    };
    return sort_.advance(budget, {call, &less_});
  }

 private:
  Less less_;
  sorting::RecordSort sort_;
};

/// Does the same as stableSort(), for ranges in hot loops that nearly always have few elements.
template <class Range, class Less = std::less<>>
void sortFew(Range&& range, const Less& less = {}) {
  constexpr std::size_t kFew = 32;
  auto* const first = std::data(range);
  const std::size_t count = std::size(range);
  if (count > kFew) {
    stableSort(range, less);
    return;
  }
  for (std::size_t i = 1; i < count; ++i) {
    auto element = std::move(first[i]);
    std::size_t position = i;
    for (; position > 0 && less(element, first[position - 1]); --position)
      first[position] = std::move(first[position - 1]);
    first[position] = std::move(element);
  }
}

/// Sorts the elements in ascending order and removes duplicates.
template <class T>
void sortUnique(std::vector<T>& values) {
  stableSort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// Returns the elements in ascending order, for example the nodes of a face.
template <class T, std::size_t N>
[[nodiscard]] constexpr std::array<T, N> sorted(std::array<T, N> elements) {
  for (std::size_t i = 1; i < N; ++i) {
    for (std::size_t k = i; k > 0 && elements[k] < elements[k - 1]; --k)
      std::swap(elements[k], elements[k - 1]);
  }
  return elements;
}

}  // namespace tetrafront
