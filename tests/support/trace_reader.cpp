#include "support/trace_reader.h"

#include <stdexcept>

namespace tetrafront::testing {
namespace {

class TraceCursor {
 public:
  explicit TraceCursor(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  [[nodiscard]] bool isAtEnd() const { return at_ == bytes_.size(); }
  std::uint32_t byte() {
    if (isAtEnd()) throw std::out_of_range("the trace ends within an event");
    return bytes_[at_++];
  }
  void skip(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) byte();
  }
  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (int shift = 0;; shift += 7) {
      const std::uint32_t next = byte();
      value |= std::uint64_t{next & 0x7fU} << shift;
      if (next < 0x80U) return value;
    }
  }
  std::int64_t zigzag() {
    const std::uint64_t value = varint();
    const auto half = static_cast<std::int64_t>(value >> 1U);
    return (value & 1U) == 0 ? half : -half - 1;
  }
  std::uint32_t near(std::uint32_t from) {
    return static_cast<std::uint32_t>(std::int64_t{from} + zigzag());
  }
  void skipIndices() {
    for (std::uint64_t left = varint(); left > 0; --left) varint();
  }
  void skipZigzags(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) zigzag();
  }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

/// A score, and its terms.
constexpr std::size_t kScore = 4;
constexpr std::size_t kFloat = 4;
constexpr std::size_t kDouble = 8;

void readPass(TraceCursor& in) {
  in.skip(kDouble);
  for (std::uint64_t left = in.varint(); left > 0; --left) {
    in.skipZigzags(3);
    in.varint();
  }
}

void readBase(TraceCursor& in, TraceStep& step, std::uint32_t& base) {
  base = in.near(base);
  in.byte();
  in.varint();
  in.skip((step.detail & 8U) != 0 ? 6 * kFloat : kFloat);
  in.skip(3 * kFloat);
  in.varint();
  in.varint();
}

void readRefused(TraceCursor& in, TraceStep& step, std::uint32_t base) {
  in.skip(kScore);
  if ((step.detail & 4U) != 0) {
    in.skip(3 * kFloat);
  } else {
    in.zigzag();
  }
  if ((step.detail & 3U) != 0) step.culprit = in.near(base);
}

void readAccepted(TraceCursor& in, const TraceStep& step) {
  in.skip(kScore);
  if ((step.detail & 8U) != 0) {
    in.skip(3 * kDouble);
  } else {
    in.zigzag();
  }
  in.skipZigzags(3);
}

void readChange(TraceCursor& in) {
  in.varint();
  for (std::uint64_t left = in.varint(); left > 0; --left) in.skip(3 * kDouble);
  in.skipIndices();
  in.varint();
  in.skipIndices();
  in.skipIndices();
  for (std::uint64_t left = in.varint(); left > 0; --left) {
    in.skipZigzags(4);
    in.varint();
  }
  for (std::uint64_t left = in.varint(); left > 0; --left) {
    in.skipZigzags(4);
    in.varint();
  }
}

}  // namespace

std::vector<TraceStep> readTrace(std::span<const std::uint8_t> bytes) {
  std::vector<TraceStep> steps;
  TraceCursor in(bytes);
  std::uint32_t base = 0;
  while (!in.isAtEnd()) {
    const std::uint32_t head = in.byte();
    TraceStep step;
    step.kind = static_cast<TraceStep::Kind>(head & 7U);
    step.detail = head >> 3U;
    switch (step.kind) {
      case TraceStep::kPass:
        base = 0;
        readPass(in);
        break;
      case TraceStep::kBase:
        readBase(in, step, base);
        break;
      case TraceStep::kRefused:
        readRefused(in, step, base);
        break;
      case TraceStep::kAccepted:
        readAccepted(in, step);
        break;
      case TraceStep::kChange:
        readChange(in);
        break;
      case TraceStep::kPostponed:
      case TraceStep::kEnd:
        break;
      default:
        throw std::out_of_range("an unknown event");
    }
    step.face = base;
    steps.push_back(step);
  }
  return steps;
}

}  // namespace tetrafront::testing
