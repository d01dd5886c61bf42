#pragma once

/// @file The common base of inner loops that are interrupted and resumed. Such a class has an advance(budget)
/// that does part of the work and returns true when all of it is done. Work that runs other work in sequence
/// is a coroutine instead (base/task.h).

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace tetrafront {

/// Position and progress of work that consists of passes over numbered items. In advance(), a derived class
/// takes the next items, visits them and begins the next pass when isPassDone():
///
///     const auto [first, last] = take(budget);
///     for (std::size_t i = first; i < last; ++i) visit(i);
class Resumable {
 public:
  /// Estimated progress, 0 to 1; it never decreases.
  [[nodiscard]] double fraction() const {
    if (next_ == count_) return passEnd_;
    const double done = static_cast<double>(next_) / static_cast<double>(count_);
    return passBegin_ + done * (passEnd_ - passBegin_);
  }

 protected:
  /// Items [first, last).
  struct Range {
    std::size_t first;
    std::size_t last;
  };

  Resumable() = default;
  /// Work in a single pass.
  explicit Resumable(std::size_t count) : count_(count), passEnd_(1.0) {}
  ~Resumable() = default;
  Resumable(const Resumable&) = default;
  Resumable(Resumable&&) = default;
  Resumable& operator=(const Resumable&) = default;
  Resumable& operator=(Resumable&&) = default;

  /// Starts a pass over the items [0, count). At its end, fraction() is `end`, no less than where it is now.
  void beginPass(std::size_t count, double end) {
    passBegin_ = fraction();
    passEnd_ = std::max(end, passBegin_);
    next_ = 0;
    count_ = count;
  }

  /// Returns the next items of the pass, at most `budget`, and counts them as visited.
  Range take(std::size_t budget) {
    const std::size_t first = next_;
    next_ += std::min(budget, count_ - next_);
    return {first, next_};
  }

  /// True if take() has returned all items of the pass.
  [[nodiscard]] bool isPassDone() const { return next_ == count_; }

 private:
  std::size_t next_ = 0;
  std::size_t count_ = 0;
  double passBegin_ = 0.0;
  double passEnd_ = 0.0;
};

/// Does all remaining work of a resumable class in one call.
template <class Machine>
void finish(Machine& machine) {
  while (!machine.advance(std::numeric_limits<std::uint32_t>::max())) {
  }
}

}  // namespace tetrafront
