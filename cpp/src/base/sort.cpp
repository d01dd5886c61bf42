#include "base/sort.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <utility>

namespace tetrafront::sorting {
namespace {

/// Length of the first runs: merging shorter ones does not pay.
constexpr std::size_t kRun = 8;

/// Copies word by word: records are short, and a call of memcpy() would cost more.
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
    std::byte* position = next;
    do {
      copyRecord(position, position - size, size);
      position -= size;
    } while (position != first && before(held.data(), position - size));
    copyRecord(position, held.data(), size);
  }
}

}  // namespace

RecordSort::RecordSort(const Records& records)
    : first_(static_cast<std::byte*>(records.first)),
      size_(records.size),
      bytes_(records.count * records.size) {}

bool RecordSort::advance(std::size_t budget, const Before& before) {
  if (isSorted_) return true;
  const std::size_t run = kRun * size_;
  while (inRuns_ < bytes_) {
    if (budget == 0) return false;
    const std::size_t end = inRuns_ + std::min(run, bytes_ - inRuns_);
    insertEach(first_ + inRuns_, first_ + end, size_, before);
    budget -= std::min(budget, kRun);
    inRuns_ = end;
  }
  if (bytes_ > run && !mergeRuns(budget, before)) return false;
  isSorted_ = true;
  return true;
}

bool RecordSort::mergeRuns(std::size_t budget, const Before& before) {
  if (!buffer_) {
    buffer_ = std::make_unique_for_overwrite<std::byte[]>(bytes_);  // NOLINT(*-avoid-c-arrays)
    from_ = first_;
    to_ = buffer_.get();
    length_ = kRun * size_;
    beginMerge(0);
  }
  while (length_ < bytes_) {
    if (budget == 0) return false;
    merge(budget, before);
  }
  if (from_ != first_) std::copy(from_, from_ + bytes_, first_);
  buffer_.reset();
  return true;
}

/// Begins to merge the two runs at the current position.
void RecordSort::beginMerge(std::size_t at) {
  const std::size_t middle = at + std::min(length_, bytes_ - at);
  a_ = from_ + at;
  middle_ = from_ + middle;
  b_ = middle_;
  last_ = middle_ + std::min(length_, bytes_ - middle);
  out_ = to_ + at;
}

void RecordSort::merge(std::size_t& budget, const Before& before) {
  // The two runs are in order if the records at their seam are.
  if (b_ != last_ && (b_ != middle_ || before(b_, b_ - size_))) {
    // Copy the pointers into locals: a write through `std::byte*` may alias the members.
    const std::byte* a = a_;
    const std::byte* b = b_;
    std::byte* out = out_;
    const std::size_t size = size_;
    std::size_t left = budget;
    for (; left > 0 && a != middle_ && b != last_; --left) {
      const std::byte*& least = before(b, a) ? b : a;
      copyRecord(out, least, size);
      least += size;
      out += size;
    }
    a_ = a;
    b_ = b;
    out_ = out;
    budget = left;
    if (a_ != middle_ && b_ != last_) return;
  }
  // Copying costs little, but it counts.
  constexpr std::size_t kCopiesPerStep = 8;
  const auto copied = static_cast<std::size_t>((middle_ - a_) + (last_ - b_)) / size_;
  budget -= std::min(budget, copied / kCopiesPerStep + 1);
  out_ = std::copy(a_, middle_, out_);
  out_ = std::copy(b_, last_, out_);
  endMerge();
}

/// Continues with the next two runs, or with runs twice as long.
void RecordSort::endMerge() {
  const auto at = static_cast<std::size_t>(out_ - to_);
  if (at < bytes_) return beginMerge(at);
  std::swap(from_, to_);
  length_ *= 2;
  beginMerge(0);
}

void sortRecords(const Records& records, const Before& before) {
  RecordSort sort(records);
  while (!sort.advance(records.count, before)) {
  }
}

}  // namespace tetrafront::sorting
