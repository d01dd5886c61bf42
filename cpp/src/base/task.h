#pragma once

/// @file Long work in slices, written as ordinary functions. A Task is a coroutine. It yields when
/// the budget of the slice is used up, and the next slice resumes it after the same `co_await`. A
/// Job owns the outermost task and does one slice per call. A task runs other work with
///
///     co_await work.finish(builder);                     // a class with advance(budget), see base/resumable.h
///     co_await work.forEachBlock(count, visit);          // a plain function, called for blocks of items
///     const CheckedInput input = co_await check(work);   // another task
///
/// Hot loops stay outside coroutines, in the first two forms. What must hold:
/// - Everything that a task refers to outlives it: parameters, `this` and what they point to. A lambda that is a
///   coroutine must not capture. A Job that uses other members of its class is the last member.
/// - `co_await` is a statement, a whole initializer or a condition: GCC 12 miscompiles some other forms, and
///   `npm run lint` rejects them.
/// - To cancel, destroy the Job. The locals of all suspended tasks are then destroyed, innermost first.
/// - An exception ends all tasks of the job; Job::advance() throws it, now and in every later call.

#include <algorithm>
#include <coroutine>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include "base/resumable.h"

namespace tetrafront {

/// The remaining budget of a slice, the task that runs in it, and the progress of the job.
class Work {
 public:
  class Yield;
  class Finish;
  template <class Visit>
  class ForEachBlock;

  Work() = default;
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;

  /// Units left in the budget of this slice.
  [[nodiscard]] std::uint32_t remaining() const { return remaining_; }

  /// `co_await work.spend(units)` subtracts units from the budget, and yields if none remain. The last work of a
  /// slice may exceed the budget.
  [[nodiscard]] Yield spend(std::size_t units);
  /// `co_await work.yield()` ends the slice.
  [[nodiscard]] Yield yield();

  /// `co_await work.finish(machine)` calls machine.advance(budget) once per slice until it returns true, and then
  /// ends the slice: the machine does not say how much of its last budget it used. One unit of the budget is
  /// worth `stepsPerUnit` steps of the machine. Follows machine.fraction() if there is one.
  template <class Machine>
  [[nodiscard]] Finish finish(Machine& machine, std::size_t stepsPerUnit = 1);

  /// `co_await work.forEachBlock(count, visit)` calls visit(first, last) for consecutive blocks of the items
  /// [0, count), each as large as the budget allows; `itemsPerUnit` items cost one unit.
  template <class Visit>
  [[nodiscard]] ForEachBlock<Visit> forEachBlock(std::size_t count, Visit visit,
                                                 std::size_t itemsPerUnit = 1);

  /// `co_await work.forEachId<NodeId>(count, visit)` does the same with visit(id) for each of the ids [0, count).
  template <class AnyId, class Visit>
  [[nodiscard]] auto forEachId(std::size_t count, Visit visit, std::size_t itemsPerUnit = 1) {
    const auto visitBlock = [visit](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) visit(AnyId(i));
    };
    return ForEachBlock<decltype(visitBlock)>(*this, count, visitBlock, itemsPerUnit);
  }

  /// The work up to the next part takes the progress of the running task from where it is to `end`, 0 to 1. A task
  /// that is awaited there divides this part further. A task that declares no parts is one part. The last part is
  /// complete when the task ends; parts that were not begun are left out.
  void beginPart(double end);
  /// The same, for a part whose work is `work` of the `remaining` work of the task, itself included: parts that end early
  /// leave their progress to those after them.
  void beginShare(double work, double remaining);
  /// Leaves the rest of the running part to the parts after it, because its work has ended early.
  void leaveRest();
  /// Sets the progress of the running part, 0 to 1. The progress of the job never decreases.
  void setFraction(double ofPart);
  /// Estimated progress of the job, 0 to 1.
  [[nodiscard]] double fraction() const { return fraction_; }

 private:
  friend class TaskPromise;
  template <class T>
  friend class Job;

  /// Work that a task awaits and that is not a coroutine. Not virtual: each awaited type would add a table and its
  /// name to the download.
  class Step {
   public:
    Step(const Step&) = delete;
    Step& operator=(const Step&) = delete;
    /// Does the work of one slice; true when finished.
    bool advance() { return run_(*this); }

    void await_suspend(std::coroutine_handle<> /*task*/) { work_.step_ = this; }
    void await_resume() const noexcept {}

   protected:
    using Run = bool (*)(Step& self);
    Step(Work& work, Run run) : work_(work), run_(run) {}
    ~Step() = default;
    [[nodiscard]] Work& work() const { return work_; }

   private:
    Work& work_;
    Run run_;
  };

  class Blocks;

  /// Part of the progress of the job.
  struct Section {
    double begin = 0.0;
    double end = 1.0;
  };

  /// Does one slice; true when all tasks are finished.
  bool advance(std::uint32_t budget);
  void advanceStep();
  void fail() noexcept;
  void subtract(std::size_t units);

  std::uint32_t remaining_ = 0;
  std::coroutine_handle<> running_;  ///< the innermost task, null when all are finished
  Step* step_ = nullptr;             ///< awaited by the running task, or null
  std::exception_ptr failure_;
  Section task_;
  Section part_;
  double fraction_ = 0.0;
};

class [[nodiscard]] Work::Yield {
 public:
  explicit Yield(const Work& work) : work_(work) {}
  [[nodiscard]] bool await_ready() const noexcept { return work_.remaining_ > 0; }
  void await_suspend(std::coroutine_handle<> /*task*/) const noexcept {}
  void await_resume() const noexcept {}

 private:
  const Work& work_;
};

inline Work::Yield Work::spend(std::size_t units) {
  subtract(units);
  return Yield(*this);
}

inline Work::Yield Work::yield() { return spend(remaining_); }

class [[nodiscard]] Work::Finish : public Step {
 public:
  /// Calls advance(steps) of a machine, and follows its fraction.
  using AdvanceMachine = bool (*)(Work& work, void* machine, std::uint32_t steps);

  Finish(Work& work, void* machine, std::size_t stepsPerUnit, AdvanceMachine advanceMachine);
  [[nodiscard]] bool await_ready() const noexcept { return false; }

 private:
  static bool run(Step& self);

  void* machine_;
  std::size_t stepsPerUnit_;
  AdvanceMachine advanceMachine_;
};

template <class Machine>
Work::Finish Work::finish(Machine& machine, std::size_t stepsPerUnit) {
  return Finish(*this, &machine, stepsPerUnit, [](Work& work, void* any, std::uint32_t steps) {
    Machine& typed = *static_cast<Machine*>(any);
    const bool isFinished = typed.advance(steps);
    if constexpr (requires { typed.fraction(); }) {
      if (!isFinished) work.setFraction(typed.fraction());
    }
    return isFinished;
  });
}

/// The part of ForEachBlock that all visitors share.
class Work::Blocks : public Step, private Resumable {
 public:
  [[nodiscard]] bool await_ready() const noexcept { return isPassDone(); }

 protected:
  using VisitBlock = void (*)(Blocks& self, std::size_t first, std::size_t last);
  Blocks(Work& work, std::size_t count, std::size_t itemsPerUnit, VisitBlock visitBlock);
  ~Blocks() = default;

 private:
  static bool run(Step& self);

  std::size_t itemsPerUnit_;
  VisitBlock visitBlock_;
};

template <class Visit>
class [[nodiscard]] Work::ForEachBlock : public Blocks {
 public:
  ForEachBlock(Work& work, std::size_t count, Visit visit, std::size_t itemsPerUnit)
      : Blocks(work, count, itemsPerUnit,
               [](Blocks& self, std::size_t first, std::size_t last) {
                 static_cast<ForEachBlock&>(self).visit_(first, last);
               }),
        visit_(std::move(visit)) {}

 private:
  Visit visit_;
};

template <class Visit>
Work::ForEachBlock<Visit> Work::forEachBlock(std::size_t count, Visit visit,
                                             std::size_t itemsPerUnit) {
  return ForEachBlock<Visit>(*this, count, std::move(visit), itemsPerUnit);
}

/// What all tasks have in common. A task that awaits another returns to Work::advance(), which resumes the other:
/// symmetric transfer would use up the stack in WebAssembly and in builds that are not optimized.
class TaskPromise {
 public:
  std::suspend_always initial_suspend() noexcept { return {}; }
  std::suspend_always final_suspend() noexcept {
    end();
    return {};
  }
  /// Keeps the exception for Work::advance(): clang 19 destroys locals twice if a coroutine is left by one.
  void unhandled_exception() noexcept { work_->fail(); }

  [[nodiscard]] Work& work() const { return *work_; }
  /// `parent` awaits `self`, or is null.
  void begin(Work& work, std::coroutine_handle<> self, std::coroutine_handle<> parent);

 private:
  void end() noexcept;

  Work* work_ = nullptr;
  std::coroutine_handle<> parent_;
  Work::Section outerTask_;
  Work::Section outerPart_;
};

template <class T>
class TaskResult : public TaskPromise {
 public:
  void return_value(T value) { result_.emplace(std::move(value)); }
  [[nodiscard]] T take() { return std::move(*result_); }

 private:
  std::optional<T> result_;
};

template <>
class TaskResult<void> : public TaskPromise {
 public:
  void return_void() noexcept {}
  void take() noexcept {}
};

/// What a coroutine that works in slices returns. It starts when it is awaited, which happens once.
template <class T = void>
class [[nodiscard]] Task {
 public:
  using Result = T;
  struct promise_type : TaskResult<T> {
    Task get_return_object() {
      return Task(std::coroutine_handle<promise_type>::from_promise(*this));
    }
  };

  Task(const Task&) = delete;
  Task& operator=(const Task&) = delete;
  ~Task() { handle_.destroy(); }

  [[nodiscard]] bool await_ready() const noexcept { return false; }
  template <class Parent>
  void await_suspend(std::coroutine_handle<Parent> parent) {
    handle_.promise().begin(parent.promise().work(), handle_, parent);
  }
  T await_resume() { return handle_.promise().take(); }

 private:
  template <class U>
  friend class Job;
  explicit Task(std::coroutine_handle<promise_type> handle) : handle_(handle) {}

  std::coroutine_handle<promise_type> handle_;
};

/// A task and everything it awaits, done in slices.
template <class T = void>
class Job {
 public:
  /// `start(work)` returns the task. Nothing runs before advance().
  template <class Start>
  explicit Job(Start start) : task_(start(work_)) {
    task_.handle_.promise().begin(work_, task_.handle_, nullptr);
  }
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  /// Does about `budget` units of work, at least one; true when finished.
  bool advance(std::uint32_t budget) { return work_.advance(budget); }
  /// Returns what the task returned; once, when finished.
  [[nodiscard]] T take() { return task_.handle_.promise().take(); }
  /// Does all remaining work in one call, and returns what the task returned.
  T finish() {
    while (!advance(std::numeric_limits<std::uint32_t>::max())) {
    }
    return take();
  }
  /// Estimated progress, 0 to 1; it never decreases.
  [[nodiscard]] double fraction() const { return work_.fraction(); }

 private:
  Work work_;
  Task<T> task_;
};

template <class Start>
explicit Job(Start) -> Job<typename std::invoke_result_t<Start, Work&>::Result>;

/// Does a job in the slices of another one; returns false if it was stopped.
template <class T>
Task<bool> finishUnlessStopped(Work& work, Job<T>& job, const bool& isStopped) {
  while (!isStopped) {
    const bool isFinished = job.advance(work.remaining());
    work.setFraction(job.fraction());
    co_await work.yield();
    if (isFinished) co_return true;
  }
  co_return false;
}

}  // namespace tetrafront
