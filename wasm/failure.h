#pragma once

/// @file Reason for which a call of the engine failed. Storing it allocates nothing, because the reason may be that no
/// memory is left.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <new>
#include <string>
#include <string_view>

namespace tetrafront::border {

enum class Failure : std::uint8_t { kNone = 0, kOutOfMemory = 1, kEngineFailed = 2 };

/// Calls work, and keeps the reason if it throws.
class FailureGuard {
 public:
  template <class Work>
  void run(const Work& work) noexcept {
    try {
      work();
    } catch (const std::bad_alloc&) {
      failure_ = Failure::kOutOfMemory;
    } catch (const std::exception& error) {
      fail(error.what());
    } catch (...) {
      fail("unknown exception");
    }
  }

  [[nodiscard]] Failure failure() const { return failure_; }
  [[nodiscard]] bool hasFailed() const { return failure_ != Failure::kNone; }
  /// Returns the text of the exception if the failure is kEngineFailed; empty otherwise.
  [[nodiscard]] std::string message() const { return {message_.data(), length_}; }

 private:
  /// Keeps the beginning of a long message.
  void fail(std::string_view message) noexcept {
    failure_ = Failure::kEngineFailed;
    length_ = std::min(message.size(), message_.size());
    std::copy_n(message.begin(), length_, message_.begin());
  }

  Failure failure_ = Failure::kNone;
  std::array<char, 200> message_{};
  std::size_t length_ = 0;
};

}  // namespace tetrafront::border
