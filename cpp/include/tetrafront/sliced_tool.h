#pragma once

/// @file The common form of the tools: objects that work in slices, so that the caller can show the progress, stop, and
/// do other work in between.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>

namespace tetrafront {

/// The work behind a tool.
template <class Result>
class ToolWork {
 public:
  ToolWork() = default;
  ToolWork(const ToolWork&) = delete;
  ToolWork& operator=(const ToolWork&) = delete;
  virtual ~ToolWork() = default;

  /// `budget` is at least 1.
  virtual bool advance(std::uint32_t budget) = 0;
  [[nodiscard]] virtual double fraction() const = 0;
  [[nodiscard]] virtual const Result& result() const = 0;
  virtual void stop() {}
};

/// A tool. Movable, not copyable; after it was moved from, it can only be assigned to or destroyed.
template <class Result>
class SlicedTool {
 public:
  /// Does about `budget` units of work, at least one; true when finished. Each tool defines its
  /// unit.
  bool advance(std::uint32_t budget) { return work_->advance(std::max(budget, 1U)); }

  /// Estimated progress, 0 to 1.
  [[nodiscard]] double fraction() const { return work_->fraction(); }

  /// Asks a tool that can end early for what it has made so far: advance() returns true soon after. Other tools go on.
  void stop() { work_->stop(); }

  /// Complete once advance() has returned true.
  [[nodiscard]] const Result& result() const { return work_->result(); }

 protected:
  explicit SlicedTool(std::unique_ptr<ToolWork<Result>> work) : work_(std::move(work)) {}

 private:
  std::unique_ptr<ToolWork<Result>> work_;
};

}  // namespace tetrafront
