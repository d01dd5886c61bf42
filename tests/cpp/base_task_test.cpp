#include "base/task.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/resumable.h"

namespace tetrafront {
namespace {

constexpr std::uint32_t kUnlimited = std::numeric_limits<std::uint32_t>::max();

/// Writes its name when it is destroyed.
class Witness {
 public:
  Witness(std::vector<std::string>& log, std::string name) : log_(log), name_(std::move(name)) {}
  Witness(const Witness&) = delete;
  Witness& operator=(const Witness&) = delete;
  ~Witness() { log_.push_back(name_); }

 private:
  std::vector<std::string>& log_;
  std::string name_;
};

/// Counts the steps it is given, in one pass.
class Counter : public Resumable {
 public:
  explicit Counter(std::size_t count) : Resumable(count) {}
  bool advance(std::size_t budget) {
    const auto [first, last] = take(budget);
    steps += last - first;
    ++slices;
    return isPassDone();
  }

  std::size_t steps = 0;
  std::size_t slices = 0;
};

template <class SomeJob>
std::size_t countSlices(SomeJob& job, std::uint32_t budget) {
  std::size_t slices = 1;
  while (!job.advance(budget)) ++slices;
  return slices;
}

Task<int> addUp(Work& work, int last) {
  int sum = 0;
  for (int i = 1; i <= last; ++i) {
    sum += i;
    co_await work.spend(1);
  }
  co_return sum;
}

TEST(Task, StartsWhenTheJobIsAdvanced) {
  bool hasStarted = false;
  struct Start {
    static Task<> run(Work& /*work*/, bool& flag) {
      flag = true;
      co_return;
    }
  };
  Job job([&](Work& work) { return Start::run(work, hasStarted); });
  EXPECT_FALSE(hasStarted);
  EXPECT_TRUE(job.advance(1));
  EXPECT_TRUE(hasStarted);
}

TEST(Task, YieldsWhenTheBudgetIsUsedUp) {
  Job job([](Work& work) { return addUp(work, 10); });
  EXPECT_EQ(countSlices(job, 4), 3U);
  EXPECT_EQ(job.take(), 55);
}

TEST(Task, DoesAtLeastOneUnitPerSlice) {
  Job job([](Work& work) { return addUp(work, 3); });
  EXPECT_EQ(countSlices(job, 0), 4U);
}

TEST(Task, StaysFinished) {
  Job job([](Work& work) { return addUp(work, 3); });
  EXPECT_TRUE(job.advance(kUnlimited));
  EXPECT_TRUE(job.advance(kUnlimited));
  EXPECT_EQ(job.take(), 6);
}

TEST(Task, EndsTheSliceInYield) {
  struct Twice {
    static Task<> run(Work& work) {
      co_await work.yield();
      co_await work.yield();
    }
  };
  Job job([](Work& work) { return Twice::run(work); });
  EXPECT_EQ(countSlices(job, 1000), 3U);
}

TEST(Task, ReturnsValuesThatCannotBeCopied) {
  struct Make {
    static Task<std::unique_ptr<int>> inner(Work& work) {
      co_await work.yield();
      co_return std::make_unique<int>(7);
    }
    static Task<std::unique_ptr<int>> outer(Work& work) {
      std::unique_ptr<int> made = co_await inner(work);
      ++*made;
      co_return made;
    }
  };
  Job job([](Work& work) { return Make::outer(work); });
  EXPECT_EQ(*job.finish(), 8);
}

TEST(Task, SharesTheBudgetWithTheTasksItAwaits) {
  struct Both {
    static Task<int> run(Work& work) {
      const int first = co_await addUp(work, 3);
      const int second = co_await addUp(work, 4);
      co_return first + second;
    }
  };
  Job job([](Work& work) { return Both::run(work); });
  EXPECT_FALSE(job.advance(5));
  EXPECT_TRUE(job.advance(3));
  EXPECT_EQ(job.take(), 16);
}

TEST(Task, AwaitsAHundredThousandTasksInOneSlice) {
  struct Many {
    static Task<int> one(Work& /*work*/) { co_return 1; }
    static Task<int> all(Work& work) {
      int sum = 0;
      for (int i = 0; i < 100000; ++i) sum += co_await one(work);
      co_return sum;
    }
  };
  Job job([](Work& work) { return Many::all(work); });
  EXPECT_TRUE(job.advance(1));
  EXPECT_EQ(job.take(), 100000);
}

TEST(Task, AwaitsTasksTenThousandDeep) {
  struct Deep {
    static Task<int> run(Work& work, int depth) {
      if (depth == 0) co_return 0;
      const int below = co_await run(work, depth - 1);
      co_return below + 1;
    }
  };
  Job job([](Work& work) { return Deep::run(work, 10000); });
  EXPECT_TRUE(job.advance(1));
  EXPECT_EQ(job.take(), 10000);
}

/// The first task awaits the second; each has a local to destroy.
struct Nested {
  static Task<> inner(Work& work, std::vector<std::string>& log) {
    const Witness witness(log, "inner");
    co_await work.yield();
    Counter counter(2);
    co_await work.finish(counter);
    co_await work.forEachBlock(2, [](std::size_t, std::size_t) {});
  }
  static Task<> outer(Work& work, std::vector<std::string>& log) {
    const Witness witness(log, "outer");
    co_await work.yield();
    co_await inner(work, log);
    co_await work.yield();
  }
};

TEST(Task, CanBeCancelledAtEverySuspension) {
  const std::size_t slices = [] {
    std::vector<std::string> log;
    Job job([&](Work& work) { return Nested::outer(work, log); });
    return countSlices(job, 1);
  }();
  EXPECT_EQ(slices, 8U);
  for (std::size_t stop = 0; stop < slices; ++stop) {
    std::vector<std::string> log;
    {
      Job job([&](Work& work) { return Nested::outer(work, log); });
      for (std::size_t i = 0; i < stop; ++i) EXPECT_FALSE(job.advance(1));
    }
    const std::vector<std::string> expected = stop == 0 ? std::vector<std::string>{}
                                              : stop == 1
                                                  ? std::vector<std::string>{"outer"}
                                                  : std::vector<std::string>{"inner", "outer"};
    EXPECT_EQ(log, expected) << "cancelled after slice " << stop;
  }
}

struct Throwing {
  enum class Where { kAtOnce, kAfterYield, kInMachine, kInBlock };

  struct Machine {
    bool advance(std::uint32_t /*budget*/) { throw std::runtime_error("machine"); }
  };
  static Task<int> inner(Work& work, std::vector<std::string>& log, Where where) {
    const Witness witness(log, "inner");
    if (where == Where::kAtOnce) throw std::runtime_error("task");
    co_await work.yield();
    if (where == Where::kAfterYield) throw std::runtime_error("task");
    if (where == Where::kInBlock)
      co_await work.forEachBlock(
          3, [](std::size_t, std::size_t) { throw std::runtime_error("block"); });
    Machine machine;
    co_await work.finish(machine);
    co_return 1;
  }
  static Task<int> outer(Work& work, std::vector<std::string>& log, Where where) {
    const Witness witness(log, "outer");
    const int result = co_await inner(work, log, where);
    log.emplace_back("resumed");
    co_return result;
  }
};

TEST(Task, EndsTheJobWhenItThrows) {
  using Where = Throwing::Where;
  for (const Where where :
       {Where::kAtOnce, Where::kAfterYield, Where::kInMachine, Where::kInBlock}) {
    std::vector<std::string> log;
    {
      Job job([&](Work& work) { return Throwing::outer(work, log, where); });
      if (where != Where::kAtOnce) {
        EXPECT_FALSE(job.advance(100));
      }
      EXPECT_THROW(job.advance(100), std::runtime_error);
      EXPECT_THROW(job.advance(100), std::runtime_error) << "a job that failed stays so";
      EXPECT_LT(job.fraction(), 1.0);
    }
    EXPECT_EQ(log, (std::vector<std::string>{"inner", "outer"}));
  }
}

TEST(Work, FinishesAMachineOneSliceAtATime) {
  struct Run {
    static Task<> run(Work& work, Counter& counter) { co_await work.finish(counter, 16); }
  };
  Counter counter(100);
  Job job([&](Work& work) { return Run::run(work, counter); });
  EXPECT_FALSE(job.advance(2));
  EXPECT_EQ(counter.steps, 32U);
  EXPECT_DOUBLE_EQ(job.fraction(), 0.32);
  // The machine is finished in the fourth slice, the task in the next.
  EXPECT_EQ(countSlices(job, 2), 4U);
  EXPECT_EQ(counter.steps, 100U);
  EXPECT_EQ(counter.slices, 4U);
  EXPECT_EQ(job.fraction(), 1.0);
}

TEST(Work, LimitsTheBudgetOfAMachineToWhatItsTypeHolds) {
  struct Narrow {
    bool advance(std::uint32_t budget) {
      given = budget;
      return true;
    }
    std::uint32_t given = 0;
  };
  struct Run {
    static Task<> run(Work& work, Narrow& machine) { co_await work.finish(machine, 16); }
  };
  Narrow machine;
  Job job([&](Work& work) { return Run::run(work, machine); });
  job.finish();
  EXPECT_EQ(machine.given, kUnlimited);
}

TEST(Work, VisitsEachItemOnceInOrder) {
  struct Run {
    static Task<> run(Work& work, std::size_t count, std::vector<std::size_t>& visited,
                      std::vector<std::size_t>& blocks) {
      co_await work.forEachBlock(
          count,
          [&](std::size_t first, std::size_t last) {
            blocks.push_back(last - first);
            for (std::size_t i = first; i < last; ++i) visited.push_back(i);
          },
          4);
    }
  };
  std::vector<std::size_t> visited;
  std::vector<std::size_t> blocks;
  Job job([&](Work& work) { return Run::run(work, 19, visited, blocks); });
  EXPECT_EQ(countSlices(job, 2), 3U);
  ASSERT_EQ(visited.size(), 19U);
  for (std::size_t i = 0; i < visited.size(); ++i) EXPECT_EQ(visited[i], i);
  EXPECT_EQ(blocks, (std::vector<std::size_t>{8, 8, 3}));
}

TEST(Work, VisitsNothingOfNoItems) {
  struct Run {
    static Task<> run(Work& work, bool& wasCalled) {
      co_await work.forEachBlock(0, [&](std::size_t, std::size_t) { wasCalled = true; });
    }
  };
  bool wasCalled = false;
  Job job([&](Work& work) { return Run::run(work, wasCalled); });
  EXPECT_TRUE(job.advance(1));
  EXPECT_FALSE(wasCalled);
}

struct Parts {
  static Task<> leaf(Work& work, std::size_t items) {
    co_await work.forEachBlock(items, [](std::size_t, std::size_t) {});
  }
  static Task<> branch(Work& work) {
    work.beginPart(0.5);
    co_await leaf(work, 5);
    work.beginPart(1.0);
    co_await leaf(work, 5);
    // A second loop in the same part starts at 0 again; the progress must not.
    co_await leaf(work, 5);
  }
  static Task<> root(Work& work) {
    work.beginPart(0.2);
    co_await leaf(work, 4);
    // The part is left before its end, so the next part begins at the current progress.
    work.beginPart(0.4);
    work.setFraction(0.5);
    co_await work.yield();
    work.beginPart(1.0);
    co_await branch(work);
  }
};

struct Shares {
  static Task<> root(Work& work) {
    work.beginShare(1.0, 4.0);
    co_await Parts::leaf(work, 4);
    // It ends early: what it leaves is for those after it.
    work.beginShare(2.0, 3.0);
    work.setFraction(0.1);
    co_await work.yield();
    work.beginShare(0.5, 1.0);
    co_await Parts::leaf(work, 4);
  }
};

TEST(Work, LeavesTheProgressOfPartsThatEndEarlyToTheOthers) {
  Job job([](Work& work) { return Shares::root(work); });
  EXPECT_FALSE(job.advance(2));
  EXPECT_DOUBLE_EQ(job.fraction(), 0.125);
  EXPECT_FALSE(job.advance(3));
  EXPECT_DOUBLE_EQ(job.fraction(), 0.3);
  EXPECT_FALSE(job.advance(2));
  EXPECT_DOUBLE_EQ(job.fraction(), 0.3 + 0.5 * 0.35);
  job.finish();
  EXPECT_EQ(job.fraction(), 1.0);
}

struct Attempts {
  static Task<> failing(Work& work) {
    work.beginPart(0.2);
    co_await Parts::leaf(work, 4);
    work.leaveRest();
  }
  static Task<> root(Work& work) {
    work.beginShare(1.0, 2.0);
    co_await failing(work);
    work.beginShare(1.0, 1.0);
    co_await Parts::leaf(work, 4);
  }
};

TEST(Work, LeavesTheRestOfATaskThatEndsEarlyToTheTasksAfterIt) {
  Job job([](Work& work) { return Attempts::root(work); });
  EXPECT_FALSE(job.advance(4));
  // Not at 0.5, as if all its work had been done.
  EXPECT_DOUBLE_EQ(job.fraction(), 0.1);
  EXPECT_FALSE(job.advance(2));
  EXPECT_DOUBLE_EQ(job.fraction(), 0.1 + 0.5 * 0.9);
  job.finish();
  EXPECT_EQ(job.fraction(), 1.0);
}

TEST(Work, DividesItsProgressIntoNestedParts) {
  Job job([](Work& work) { return Parts::root(work); });
  EXPECT_EQ(job.fraction(), 0.0);
  EXPECT_FALSE(job.advance(2));
  EXPECT_DOUBLE_EQ(job.fraction(), 0.1);
  EXPECT_FALSE(job.advance(3));
  EXPECT_DOUBLE_EQ(job.fraction(), 0.3);
  EXPECT_FALSE(job.advance(5));
  EXPECT_DOUBLE_EQ(job.fraction(), 0.65);
  EXPECT_FALSE(job.advance(2));
  EXPECT_DOUBLE_EQ(job.fraction(), 0.65 + 0.4 * 0.35);
  job.finish();
  EXPECT_EQ(job.fraction(), 1.0);
}

TEST(Work, CompletesOnlyThePartInWhichATaskEnds) {
  struct Early {
    static Task<> inner(Work& work) {
      work.beginPart(0.5);
      co_await work.yield();
      co_return;
    }
    static Task<> outer(Work& work) {
      co_await inner(work);
      co_await work.yield();
    }
  };
  Job job([](Work& work) { return Early::outer(work); });
  EXPECT_FALSE(job.advance(1));
  EXPECT_EQ(job.fraction(), 0.0);
  EXPECT_FALSE(job.advance(1));
  EXPECT_EQ(job.fraction(), 0.5);
  EXPECT_TRUE(job.advance(1));
  EXPECT_EQ(job.fraction(), 1.0);
}

TEST(Work, ProgressNeverDecreases) {
  Job job([](Work& work) { return Parts::root(work); });
  double before = 0.0;
  for (bool isFinished = false; !isFinished; before = job.fraction()) {
    isFinished = job.advance(1);
    EXPECT_GE(job.fraction(), before);
  }
  EXPECT_EQ(before, 1.0);
}

/// Two passes, the second over twice as many items.
class TwoPasses : public Resumable {
 public:
  TwoPasses() { beginPass(10, 0.25); }
  bool advance(std::size_t budget) {
    const auto [first, last] = take(budget);
    visited += last - first;
    if (!isPassDone()) return false;
    if (isSecond_) return true;
    isSecond_ = true;
    beginPass(20, 1.0);
    return false;
  }
  std::size_t visited = 0;

 private:
  bool isSecond_ = false;
};

TEST(Resumable, OwnsPositionAndProgressOfItsPasses) {
  TwoPasses passes;
  EXPECT_EQ(passes.fraction(), 0.0);
  EXPECT_FALSE(passes.advance(4));
  EXPECT_DOUBLE_EQ(passes.fraction(), 0.1);
  EXPECT_FALSE(passes.advance(100));
  EXPECT_DOUBLE_EQ(passes.fraction(), 0.25);
  EXPECT_FALSE(passes.advance(4));
  EXPECT_DOUBLE_EQ(passes.fraction(), 0.4);
  finish(passes);
  EXPECT_EQ(passes.visited, 30U);
  EXPECT_EQ(passes.fraction(), 1.0);
}

TEST(Resumable, IsFinishedWithoutItems) {
  Counter none(0);
  EXPECT_EQ(none.fraction(), 1.0);
  EXPECT_TRUE(none.advance(1));
}

}  // namespace
}  // namespace tetrafront
