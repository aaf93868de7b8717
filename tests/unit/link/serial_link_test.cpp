#include "link/serial_link.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <termios.h>

#include <array>

namespace drover::link {
namespace {

struct Pty {
  Pty() : master(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)) {
    ::grantpt(master.get());
    ::unlockpt(master.get());
    std::array<char, 64> name{};
    ::ptsname_r(master.get(), name.data(), name.size());
    path = name.data();
  }
  UniqueFd master;
  std::string path;
};

TEST(OpenSerial, RefusesABaudRateNobodyKnows) {
  const auto opened = open_serial({"/dev/null", 12345});
  EXPECT_EQ(opened.link, nullptr);
  EXPECT_EQ(opened.problem, "/dev/null: baud rate 12345 is not supported");
}

TEST(OpenSerial, RefusesWhatIsNoSerialLine) {
  const auto opened = open_serial({"/dev/null", 115200});
  EXPECT_EQ(opened.link, nullptr);
  EXPECT_NE(opened.problem.find("is no serial line"), std::string::npos) << opened.problem;
}

TEST(OpenSerial, RefusesALineThatAnotherProgramUses) {
  Pty pty;
  const auto first = open_serial({pty.path, 115200});
  ASSERT_NE(first.link, nullptr) << first.problem;
  EXPECT_EQ(open_serial({pty.path, 115200}).link, nullptr);
}

TEST(AdoptSerial, TakesTheOpenFileThatASecondOpeningCannotHave) {
  Pty pty;
  auto first = open_serial({pty.path, 115200});
  ASSERT_NE(first.link, nullptr) << first.problem;
  auto kept = first.link->duplicate();
  ASSERT_EQ(::write(kept.get(), "stop", 4), 4);
  ASSERT_EQ(::write(pty.master.get(), "old", 3), 3);
  first.link.reset();
  ASSERT_EQ(open_serial({pty.path, 115200}).link, nullptr) << "somebody has it";
  const auto adopted = adopt_serial({pty.path, 115200}, std::move(kept));
  ASSERT_NE(adopted.link, nullptr);
  std::array<char, 16> heard{};
  EXPECT_EQ(::read(pty.master.get(), heard.data(), heard.size()), 4) << "what was written stays";
  std::array<std::uint8_t, 16> buffer{};
  std::size_t size = 0;
  ASSERT_TRUE(adopted.link->read(buffer, size));
  EXPECT_EQ(size, 0U) << "what was said before is old";
}

TEST(AdoptSerial, LeavesWhatIsDeadOrAnotherLine) {
  Pty pty;
  Pty other;
  const auto keep = [](const Pty& of) { return open_serial({of.path, 115200}).link->duplicate(); };
  EXPECT_EQ(adopt_serial({other.path, 115200}, keep(pty)).link, nullptr) << "another line";
  EXPECT_EQ(adopt_serial({"/no/such/line", 115200}, keep(pty)).link, nullptr);
  EXPECT_EQ(adopt_serial({pty.path, 115200}, UniqueFd()).link, nullptr);
  auto dead = keep(pty);
  const auto path = pty.path;
  pty.master.reset();
  EXPECT_EQ(adopt_serial({path, 115200}, std::move(dead)).link, nullptr) << "hung up";
}

TEST(SerialLink, IsRawAndDoesNotEcho) {
  Pty pty;
  const auto opened = open_serial({pty.path, 115200});
  ASSERT_NE(opened.link, nullptr) << opened.problem;
  const std::string bytes(
      "\r\n\x11\x13\x00\xff"
      "A",
      7);
  ASSERT_EQ(::write(pty.master.get(), bytes.data(), bytes.size()), 7);
  std::array<std::uint8_t, 64> buffer{};
  std::size_t size = 0;
  ASSERT_TRUE(opened.link->read(buffer, size));
  EXPECT_EQ(std::string(buffer.begin(), buffer.begin() + size), bytes);
  EXPECT_LT(::read(pty.master.get(), buffer.data(), buffer.size()), 0) << "an echo came back";
}

TEST(SerialLink, TellsAnIdleLineFromOneThatHungUp) {
  Pty pty;
  const auto opened = open_serial({pty.path, 115200});
  ASSERT_NE(opened.link, nullptr) << opened.problem;
  std::array<std::uint8_t, 64> buffer{};
  std::size_t size = 0;
  EXPECT_TRUE(opened.link->read(buffer, size));
  EXPECT_EQ(size, 0U);
  pty.master.reset();
  EXPECT_FALSE(opened.link->read(buffer, size));
}

}  // namespace
}  // namespace drover::link
