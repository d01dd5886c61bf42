#include "base/task.h"

#include <algorithm>

#include "base/budget.h"

namespace tetrafront {

void Work::beginPart(double end) {
  part_ = {fraction_, std::max(fraction_, task_.begin + end * (task_.end - task_.begin))};
}

void Work::beginShare(double work, double remaining) {
  part_ = {fraction_, fraction_ + std::max(0.0, task_.end - fraction_) * work / remaining};
}

void Work::leaveRest() { part_.end = fraction_; }

void Work::setFraction(double ofPart) {
  // Without rounding at the end, so that a finished job is at exactly 1.
  const double now = ofPart < 1.0 ? part_.begin + ofPart * (part_.end - part_.begin) : part_.end;
  fraction_ = std::max(fraction_, now);
}

bool Work::advance(std::uint32_t budget) {
  remaining_ = std::max(budget, 1U);
  while (running_ && remaining_ > 0) {
    if (step_ == nullptr) {
      running_.resume();
    } else {
      advanceStep();
    }
  }
  if (failure_) std::rethrow_exception(failure_);
  if (!running_) fraction_ = 1.0;
  return !running_;
}

void Work::advanceStep() {
  try {
    if (step_->advance()) step_ = nullptr;
  } catch (...) {
    fail();
    running_ = nullptr;
  }
}

void Work::fail() noexcept { failure_ = std::current_exception(); }

Work::Finish::Finish(Work& work, void* machine, std::size_t stepsPerUnit,
                     AdvanceMachine advanceMachine)
    : Step(work, run),
      machine_(machine),
      stepsPerUnit_(stepsPerUnit),
      advanceMachine_(advanceMachine) {}

bool Work::Finish::run(Step& self) {
  auto& finish = static_cast<Finish&>(self);
  Work& work = finish.work();
  constexpr std::size_t kLargest = std::numeric_limits<std::uint32_t>::max();
  const std::size_t steps =
      std::min(scaledBudget(work.remaining(), finish.stepsPerUnit_), kLargest);
  const bool isFinished =
      finish.advanceMachine_(work, finish.machine_, static_cast<std::uint32_t>(steps));
  work.subtract(work.remaining());
  if (isFinished) work.setFraction(1.0);
  return isFinished;
}

Work::Blocks::Blocks(Work& work, std::size_t count, std::size_t itemsPerUnit, VisitBlock visitBlock)
    : Step(work, run), Resumable(count), itemsPerUnit_(itemsPerUnit), visitBlock_(visitBlock) {}

bool Work::Blocks::run(Step& self) {
  auto& blocks = static_cast<Blocks&>(self);
  Work& work = blocks.work();
  const auto [first, last] = blocks.take(scaledBudget(work.remaining(), blocks.itemsPerUnit_));
  blocks.visitBlock_(blocks, first, last);
  work.subtract((last - first + blocks.itemsPerUnit_ - 1) / blocks.itemsPerUnit_);
  work.setFraction(blocks.fraction());
  return blocks.isPassDone();
}

void Work::subtract(std::size_t units) {
  remaining_ -= static_cast<std::uint32_t>(std::min<std::size_t>(units, remaining_));
}

void TaskPromise::begin(Work& work, std::coroutine_handle<> self, std::coroutine_handle<> parent) {
  work_ = &work;
  parent_ = parent;
  outerTask_ = work.task_;
  outerPart_ = work.part_;
  work.task_ = work.part_;
  work.running_ = self;
}

void TaskPromise::end() noexcept {
  if (work_->failure_) {
    work_->running_ = nullptr;
    return;
  }
  work_->setFraction(1.0);
  work_->task_ = outerTask_;
  work_->part_ = outerPart_;
  work_->running_ = parent_;
}

}  // namespace tetrafront
