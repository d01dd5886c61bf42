/// @file Ends the test program if a test runs far longer than any test needs. A front that advances
/// for ever then fails the test that it belongs to, by name, instead of blocking the whole run.

#include <gtest/gtest.h>

#if defined(__unix__) || defined(__APPLE__)

#include <unistd.h>

#include <csignal>
#include <cstring>

namespace tetrafront::testing {
namespace {

/// The slowest test takes a few seconds; sanitizers and a busy machine multiply that.
constexpr unsigned kLimitSeconds = 300;

/// Contains only data that a signal handler may read.
char runningTest[256] = "";

extern "C" void endAtTimeLimit(int /*signal*/) {
  constexpr char kMessage[] = "\nTIME LIMIT exceeded by ";
  (void)!write(STDERR_FILENO, kMessage, sizeof(kMessage) - 1);
  (void)!write(STDERR_FILENO, runningTest, std::strlen(runningTest));
  (void)!write(STDERR_FILENO, "\n", 1);
  _exit(1);
}

class TimeLimit : public ::testing::EmptyTestEventListener {
  void OnTestStart(const ::testing::TestInfo& test) override {
    const std::string name = std::string(test.test_suite_name()) + "." + test.name();
    std::strncpy(runningTest, name.c_str(), sizeof(runningTest) - 1);
    std::signal(SIGALRM, endAtTimeLimit);
    alarm(kLimitSeconds);
  }
  void OnTestEnd(const ::testing::TestInfo& /*test*/) override { alarm(0); }
};

[[maybe_unused]] const bool kIsListening = [] {
  ::testing::UnitTest::GetInstance()->listeners().Append(new TimeLimit);
  return true;
}();

}  // namespace
}  // namespace tetrafront::testing

#endif
