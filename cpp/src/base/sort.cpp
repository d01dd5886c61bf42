#include "base/sort.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>

namespace tetrafront::sorting {
namespace {

/// Shorter runs are not worth merging.
constexpr std::size_t kRun = 8;

/// Word by word: records are short, and a call of memcpy would cost more than the words.
void copyRecord(std::byte* to, const std::byte* from, std::size_t size) {
  for (std::size_t at = 0; at < size; at += sizeof(std::uint32_t)) {
    std::memcpy(to + at, from + at, sizeof(std::uint32_t));
  }
}

void insertEach(std::byte* first, std::byte* last, std::size_t size, const Before& before) {
  alignas(std::max_align_t) std::array<std::byte, kLargestRecord> held;
  for (std::byte* next = first + size; next < last; next += size) {
    if (!before(next, next - size)) continue;
    copyRecord(held.data(), next, size);
    std::byte* place = next;
    do {
      copyRecord(place, place - size, size);
      place -= size;
    } while (place != first && before(held.data(), place - size));
    copyRecord(place, held.data(), size);
  }
}

/// Two runs, [first, middle) and [middle, last), into one at `to`.
void mergeRuns(const std::byte* first, const std::byte* middle, const std::byte* last,
               std::byte* to, std::size_t size, const Before& before) {
  const std::byte* a = first;
  const std::byte* b = middle;
  if (b != last && before(b, b - size)) {
    while (a != middle && b != last) {
      const std::byte*& least = before(b, a) ? b : a;
      copyRecord(to, least, size);
      least += size;
      to += size;
    }
  }
  to = std::copy(a, middle, to);
  std::copy(b, last, to);
}

}  // namespace

void sortRecords(const Records& records, const Before& before) {
  const std::size_t size = records.size;
  const std::size_t bytes = records.count * size;
  auto* const first = static_cast<std::byte*>(records.first);
  for (std::size_t run = 0; run < bytes; run += kRun * size) {
    insertEach(first + run, first + run + std::min(kRun * size, bytes - run), size, before);
  }
  if (records.count <= kRun) return;
  const auto room = std::make_unique_for_overwrite<std::byte[]>(bytes);  // NOLINT(*-avoid-c-arrays)
  std::byte* from = first;
  std::byte* to = room.get();
  for (std::size_t length = kRun * size; length < bytes; length *= 2) {
    for (std::size_t at = 0; at < bytes;) {
      const std::size_t middle = at + std::min(length, bytes - at);
      const std::size_t last = middle + std::min(length, bytes - middle);
      mergeRuns(from + at, from + middle, from + last, to + at, size, before);
      at = last;
    }
    std::swap(from, to);
  }
  if (from != first) std::copy(from, from + bytes, first);
}

}  // namespace tetrafront::sorting
