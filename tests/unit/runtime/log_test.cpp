#include "runtime/log.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <array>
#include <string>

#include "runtime/clock.h"

namespace drover::runtime {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

/// Standard error is a pipe that nobody reads until told.
class LogTest : public testing::Test {
 protected:
  LogTest() : own_(::dup(STDERR_FILENO)) {
    std::array<int, 2> ends{};
    (void)!::pipe2(ends.data(), O_CLOEXEC);
    read_ = ends[0];
    ::dup2(ends[1], STDERR_FILENO);
    ::close(ends[1]);
  }
  ~LogTest() override {
    restore();
    ::close(read_);
  }
  void restore() {
    if (own_ < 0) return;
    ::dup2(own_, STDERR_FILENO);
    ::close(own_);
    own_ = -1;
  }
  void fill_pipe() {
    const int flags = ::fcntl(STDERR_FILENO, F_GETFL);
    ::fcntl(STDERR_FILENO, F_SETFL, flags | O_NONBLOCK);
    const std::string full(4096, 'x');
    while (::write(STDERR_FILENO, full.data(), full.size()) > 0) {
    }
    ::fcntl(STDERR_FILENO, F_SETFL, flags);
  }
  /// What comes until nothing came for 0.2 s.
  std::string drain() const {
    ::fcntl(read_, F_SETFL, O_NONBLOCK);
    std::string text;
    std::array<char, 4096> chunk{};
    for (int quiet = 0; quiet < 20;) {
      const auto n = ::read(read_, chunk.data(), chunk.size());
      if (n > 0) {
        text.append(chunk.data(), static_cast<std::size_t>(n));
        quiet = 0;
      } else {
        ++quiet;
        ::usleep(10'000);
      }
    }
    return text;
  }

  int read_ = -1;
  int own_;
};

TEST_F(LogTest, WritesEachLineWithItsLevel) {
  {
    const LogWriter writer;
    log(LogLevel::info, "one");
    log(LogLevel::error, "two");
  }
  EXPECT_EQ(drain(), "one\nerror: two\n");
}

TEST_F(LogTest, WritesNothingOfAnothersTextThatForgesALineOrTurnsIt) {
  log(LogLevel::info, "refused 'a\nerror: b\u202Ec\x1B[2J'");
  EXPECT_EQ(drain(), "refused 'a?error: b?c?[2J'\n");
}

TEST_F(LogTest, NobodyWaitsForAReaderWhoStoppedReadingAndTheLostLinesAreTold) {
  fill_pipe();
  const LogWriter writer;
  const auto before = LogWriter::dropped();
  const Time begin = monotonic_now();
  const std::string line(200, 'y');
  for (int i = 0; i < 2000; ++i) log(LogLevel::info, line);
  EXPECT_LT(monotonic_now() - begin, 2s);
  const auto lost = LogWriter::dropped() - before;
  EXPECT_GT(lost, 1000U);
  EXPECT_THAT(drain(), HasSubstr(std::to_string(lost) + " lines were dropped"));
}

TEST_F(LogTest, EndsSoonThoughNobodyReads) {
  fill_pipe();
  const Time begin = monotonic_now();
  {
    const LogWriter writer;
    log(LogLevel::info, "never read");
  }
  EXPECT_LT(monotonic_now() - begin, 2s);
  EXPECT_THAT(drain(), HasSubstr("never read")) << "the thread lets go, so that the next test can";
}

}  // namespace
}  // namespace drover::runtime
