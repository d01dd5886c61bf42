#pragma once

/// @file The work of a tool (tetrafront/sliced_tool.h) that is a task.

#include <cstdint>
#include <memory>
#include <utility>

#include "base/task.h"
#include "tetrafront/sliced_tool.h"

namespace tetrafront {

/// One task on a copy of the arguments of a tool. Keeps the result. If the input has a flag `isStopped`, stop() sets it.
template <class Result, class Input>
class ToolJob final : public ToolWork<Result> {
 public:
  /// `start(work, input)` returns the task.
  template <class Start>
  ToolJob(Input input, const Start& start)
      : input_(std::move(input)),
        job_([this, &start](Work& work) { return start(work, input_); }) {}

  bool advance(std::uint32_t budget) override {
    if (!isFinished_ && job_.advance(budget)) {
      result_ = job_.take();
      isFinished_ = true;
    }
    return isFinished_;
  }
  [[nodiscard]] double fraction() const override { return job_.fraction(); }
  [[nodiscard]] const Result& result() const override { return result_; }
  void stop() override {
    if constexpr (requires { input_.isStopped; }) input_.isStopped = true;
  }

 private:
  Input input_;
  Result result_;
  bool isFinished_ = false;
  Job<Result> job_;  ///< last, because it uses the input
};

template <class Result, class Input, class Start>
std::unique_ptr<ToolWork<Result>> makeToolJob(Input input, const Start& start) {
  return std::make_unique<ToolJob<Result, Input>>(std::move(input), start);
}

}  // namespace tetrafront
