#include "base/sort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <utility>
#include <vector>

namespace tetrafront {
namespace {

template <std::size_t Words>
struct Record {
  std::array<std::uint32_t, Words> words;
};

/// Returns records with few different keys in the first word, and the index before sorting in the
/// last, which shows whether equal records keep their order.
template <std::size_t Words>
std::vector<Record<Words>> records(std::size_t count, std::uint32_t keys, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Record<Words>> result(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    for (std::uint32_t& word : result[i].words) word = random() % keys;
    result[i].words.back() = i;
  }
  return result;
}

template <std::size_t Words, class Sort>
void expectAsTheLibrarySorts(const Sort& sort) {
  const auto byKey = [](const Record<Words>& a, const Record<Words>& b) {
    return a.words[0] < b.words[0];
  };
  for (std::size_t count = 0; count < 300; count += count < 70 ? 1 : 23) {
    for (const std::uint32_t keys : {1U, 5U, 1U << 30U}) {
      auto sorted = records<Words>(count, keys, static_cast<unsigned>(count));
      auto expected = sorted;
      sort(sorted, byKey);
      std::stable_sort(expected.begin(), expected.end(), byKey);
      for (std::size_t i = 0; i < count; ++i)
        ASSERT_EQ(sorted[i].words, expected[i].words) << i << " of " << count << ", keys " << keys;
    }
  }
}

TEST(Sort, IsStableForRecordsOfAllSizes) {
  const auto sort = [](auto& range, const auto& less) { stableSort(range, less); };
  expectAsTheLibrarySorts<2>(sort);
  expectAsTheLibrarySorts<3>(sort);
  expectAsTheLibrarySorts<7>(sort);
  expectAsTheLibrarySorts<sorting::kLargestRecord / 4>(sort);
}

TEST(Sort, EachSliceUsesItsBudgetAndNoMore) {
  for (const std::uint32_t keys : {1U, 5U, 1U << 30U}) {
    for (const std::size_t budget : {1U, 50U, 100'000U}) {
      auto sorted = records<3>(5000, keys, 3);
      auto expected = sorted;
      std::size_t comparisons = 0;
      const auto byKey = [&comparisons](const Record<3>& a, const Record<3>& b) {
        ++comparisons;
        return a.words[0] < b.words[0];
      };
      SlicedSort sort(std::span<Record<3>>{sorted}, byKey);
      std::size_t slices = 1;
      for (bool isDone = false; !isDone; ++slices) {
        comparisons = 0;
        isDone = sort.advance(budget);
        ASSERT_LE(comparisons, 8 * budget + 64);
      }
      std::stable_sort(expected.begin(), expected.end(), byKey);
      for (std::size_t i = 0; i < sorted.size(); ++i)
        ASSERT_EQ(sorted[i].words, expected[i].words) << "slices of " << budget;
      if (keys > 5) {
        EXPECT_GT(slices * budget, 5 * sorted.size());
      }
    }
  }
}

TEST(Sort, SortsFewElementsAsTheLibraryDoes) {
  const auto sort = [](auto& range, const auto& less) { sortFew(range, less); };
  expectAsTheLibrarySorts<2>(sort);
  expectAsTheLibrarySorts<5>(sort);
}

TEST(Sort, SortedAndReversedInputNeedsFewComparisons) {
  constexpr std::size_t kCount = 4096;
  for (const bool isTurned : {false, true}) {
    std::vector<std::uint32_t> numbers(kCount);
    for (std::uint32_t i = 0; i < kCount; ++i) numbers[i] = isTurned ? kCount - i : i;
    std::size_t comparisons = 0;
    stableSort(numbers, [&](std::uint32_t a, std::uint32_t b) {
      ++comparisons;
      return a < b;
    });
    EXPECT_TRUE(std::is_sorted(numbers.begin(), numbers.end()));
    // Sorted input needs one comparison per pair of neighbours; reversed input, half of each of the
    // nine merges, and the short runs.
    EXPECT_LT(comparisons, kCount * (isTurned ? 10 : 2));
  }
}

TEST(Sort, ChangesOnlyTheGivenSpan) {
  std::vector<std::uint32_t> numbers{9, 8, 7, 6, 5, 4, 3};
  stableSort(std::span(numbers).subspan(2, 3));
  EXPECT_EQ(numbers, (std::vector<std::uint32_t>{9, 8, 5, 6, 7, 4, 3}));
}

TEST(Sort, SortsPairsByBothMembersAndRemovesDuplicates) {
  std::vector<std::pair<double, std::uint32_t>> pairs{{2.0, 1}, {1.0, 7}, {2.0, 0}, {1.0, 7}};
  sortUnique(pairs);
  EXPECT_EQ(pairs, (std::vector<std::pair<double, std::uint32_t>>{{1.0, 7}, {2.0, 0}, {2.0, 1}}));
}

TEST(Sort, SortsArraysInAnyOrder) {
  std::array<int, 4> turned{0, 1, 2, 3};
  do {
    EXPECT_EQ(sorted(turned), (std::array{0, 1, 2, 3}));
  } while (std::next_permutation(turned.begin(), turned.end()));
}

}  // namespace
}  // namespace tetrafront
