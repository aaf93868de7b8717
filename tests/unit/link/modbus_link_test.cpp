// The Modbus link against raw bytes on a pseudo-terminal and against libmodbus' own server.
#include "link/modbus_link.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <modbus.h>
#include <netinet/in.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <functional>
#include <thread>
#include <vector>

#include "drover/checksum.h"
#include "link/unique_fd.h"

namespace drover::link {
namespace {

using namespace std::chrono_literals;
using Bytes = std::vector<std::uint8_t>;

Time now() {
  timespec t{};
  ::clock_gettime(CLOCK_MONOTONIC, &t);
  return Time{std::chrono::seconds(t.tv_sec) + std::chrono::nanoseconds(t.tv_nsec)};
}

void wait_until(Time when) {
  while (now() < when) std::this_thread::sleep_for(2ms);
}

Bytes sealed(Bytes frame) {
  const auto crc = modbus_crc(frame);
  frame.push_back(static_cast<std::uint8_t>(crc));
  frame.push_back(static_cast<std::uint8_t>(crc >> 8U));
  return frame;
}

Bytes answer_to(std::uint8_t unit, const RegisterBlock& block, std::uint16_t first) {
  Bytes frame{unit, block.function, static_cast<std::uint8_t>(2 * block.count)};
  for (std::uint16_t i = 0; i < block.count; ++i) {
    frame.push_back(static_cast<std::uint8_t>((first + i) >> 8));
    frame.push_back(static_cast<std::uint8_t>(first + i));
  }
  return sealed(frame);
}

/// The device's end of a pseudo-terminal: calls back with each request of eight bytes.
class Device {
 public:
  using OnRequest = std::function<void(Device&, const Bytes&)>;
  Device() : master_(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)) {
    ::grantpt(master_.get());
    ::unlockpt(master_.get());
    std::array<char, 64> name{};
    ::ptsname_r(master_.get(), name.data(), name.size());
    path = name.data();
    termios raw{};
    ::tcgetattr(master_.get(), &raw);
    ::cfmakeraw(&raw);
    ::tcsetattr(master_.get(), TCSANOW, &raw);
  }
  ~Device() { stop(); }
  void start(OnRequest on_request) {
    thread_ = std::thread([this, on_request] {
      Bytes heard;
      while (!stop_) {
        pollfd line{master_.get(), POLLIN, 0};
        if (::poll(&line, 1, 10) <= 0 || (line.revents & POLLIN) == 0) continue;
        std::array<std::uint8_t, 64> chunk{};
        const auto n = ::read(master_.get(), chunk.data(), chunk.size());
        if (n > 0) heard.insert(heard.end(), chunk.begin(), chunk.begin() + n);
        if (heard.size() < 8) continue;
        ++requests;
        on_request(*this, heard);
        heard.clear();
      }
    });
  }
  void stop() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
  }
  void send(const Bytes& bytes) { (void)!::write(master_.get(), bytes.data(), bytes.size()); }
  void unplug() {
    stop();
    master_.reset();
  }
  bool stopping() const { return stop_; }

  std::string path;
  std::atomic<int> requests{0};
  std::atomic<int> dripped{0};

 private:
  UniqueFd master_;
  std::thread thread_;
  std::atomic<bool> stop_{false};
};

class AModbusLine : public ::testing::Test {
 protected:
  static constexpr RegisterBlock kBlock{3, 0x28, 10};
  static constexpr ModbusUnit kUnit{0xD2, 0.01, 0.3};
  static constexpr ModbusUnit kOther{0xD3, 0.01, 0.3};
  ModbusSettings settings() const {
    ModbusSettings s;
    s.port = device.path;
    return s;
  }
  void open() {
    link.reset();
    auto opened = open_modbus(settings(), &now);
    ASSERT_NE(opened.link, nullptr) << opened.problem;
    link = std::move(opened.link);
  }
  ModbusResult ask(const ModbusUnit& unit = kUnit) {
    constexpr RegisterBlock block = kBlock;
    // As the loop does: what comes when nothing is asked is thrown away.
    while (now() < link->ready_at(unit)) {
      pollfd line{link->fd(), POLLIN, 0};
      if (::poll(&line, 1, 2) > 0) {
        EXPECT_TRUE(link->drain());
      }
    }
    words.assign(block.count, 0xAAAA);
    return link->read(unit, block, words);
  }

  // What the device's thread looks at outlives it.
  std::vector<Bytes> prepared;  ///< not changed while the device runs
  std::atomic<std::size_t> turn{0};
  std::atomic<bool> answers{false};
  std::atomic<std::uint16_t> next{100};
  Device device;
  std::unique_ptr<ModbusLink> link;
  std::vector<std::uint16_t> words;
};

TEST(OpenModbus, RefusesWhatCannotBe) {
  ModbusSettings settings;
  settings.port = "/dev/null";
  settings.baud = 250000;
  EXPECT_EQ(open_modbus(settings, &now).problem, "/dev/null: baud rate 250000 is not supported");
  settings.baud = 9600;
  EXPECT_EQ(open_modbus(settings, &now).link, nullptr);
  settings.port = "/dev/no_such_line";
  EXPECT_EQ(open_modbus(settings, &now).link, nullptr);
  settings.port = "tcp:127.0.0.1:1";
  EXPECT_EQ(open_modbus(settings, &now).link, nullptr);
}

TEST_F(AModbusLine, IsRefusedToASecondProgram) {
  open();
  EXPECT_EQ(open_modbus(settings(), &now).link, nullptr);
}

TEST_F(AModbusLine, BringsTheRegisters) {
  device.start([](Device& d, const Bytes&) { d.send(answer_to(0xD2, kBlock, 0x1234)); });
  open();
  ASSERT_TRUE(ask().good);
  EXPECT_EQ(words.front(), 0x1234);
  EXPECT_EQ(words.back(), 0x123D);
}

TEST_F(AModbusLine, TellsWhatWentWrong) {
  prepared = {
      {}, answer_to(0xD3, kBlock, 1), answer_to(0xD2, kBlock, 1), answer_to(0xD2, kBlock, 77)};
  prepared[2].back() ^= 1;
  device.start([&](Device& d, const Bytes&) { d.send(prepared[turn]); });
  open();
  EXPECT_EQ(ask().failure, RegisterFailure::silent);
  open();
  turn = 1;
  EXPECT_EQ(ask().failure, RegisterFailure::wrong_unit);
  open();
  turn = 2;
  EXPECT_EQ(ask().failure, RegisterFailure::damaged);
  turn = 3;
  ASSERT_TRUE(ask().good) << "the next one is good";
  EXPECT_EQ(words.front(), 77);
}

TEST_F(AModbusLine, ReadsTheException) {
  device.start([](Device& d, const Bytes&) { d.send(sealed({0xD2, 0x83, 0x02})); });
  open();
  const auto result = ask();
  EXPECT_EQ(result.failure, RegisterFailure::refused);
  EXPECT_EQ(result.exception, 2);
}

TEST_F(AModbusLine, IsNotHeldUpByADeviceThatDripsItsAnswer) {
  // A byte each 100 ms keeps any time-out that begins anew with each byte from ending.
  device.start([](Device& d, const Bytes&) {
    for (const std::uint8_t byte : answer_to(0xD2, kBlock, 1)) {
      if (d.stopping()) return;
      d.send({byte});
      ++d.dripped;
      std::this_thread::sleep_for(100ms);
    }
  });
  open();
  EXPECT_FALSE(ask().good);
  EXPECT_LT(device.dripped, 25) << "it waited for the last of 25 bytes";
}

TEST_F(AModbusLine, BelievesNoLateAnswer) {
  // Each answer comes 0.5 s after its request, 0.2 s after the wait for it.
  device.start([&](Device& d, const Bytes&) {
    std::this_thread::sleep_for(500ms);
    d.send(answer_to(0xD2, kBlock, next++));
  });
  open();
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(ask().good) << words.front();
  EXPECT_GT(link->counters().late_bytes, 0U);
}

TEST_F(AModbusLine, LetsASilentUnitCostTheOtherNoMoreThanItsWait) {
  device.start([](Device& d, const Bytes& request) {
    if (request[0] == 0xD2) d.send(answer_to(0xD2, kBlock, 5));
  });
  open();
  for (int i = 0; i < 3; ++i) {
    const Time before = now();
    EXPECT_EQ(ask(kOther).failure, RegisterFailure::silent);
    EXPECT_LT(to_s(link->ready_at(kUnit) - now()), 0.02) << "nobody waits for the silent one";
    ASSERT_TRUE(ask().good);
    EXPECT_EQ(words.front(), 5);
    if (i == 0) {
      EXPECT_LT(to_s(now() - before), 0.45);
    }
    EXPECT_GT(to_s(link->ready_at(kOther) - now()), 0.5) << "a late answer may still come";
    EXPECT_LT(to_s(link->ready_at(kUnit) - now()), 0.02);
  }
}

TEST_F(AModbusLine, TakesNoUnitsLateAnswerForTheOthers) {
  // The second unit answers 0.4 s after it was asked: when the first is being waited for.
  device.start([](Device& d, const Bytes& request) {
    if (request[0] == 0xD2) {
      d.send(answer_to(0xD3, kBlock, 9));
      d.send(answer_to(0xD2, kBlock, 5));
    }
  });
  open();
  EXPECT_EQ(ask(kOther).failure, RegisterFailure::silent);
  ASSERT_TRUE(ask().good);
  EXPECT_EQ(words.front(), 5);
}

TEST_F(AModbusLine, DropsItsOwnEcho) {
  device.start([&](Device& d, const Bytes& request) {
    d.send(request);
    if (answers) d.send(answer_to(0xD2, kBlock, 55));
  });
  open();
  EXPECT_EQ(ask().failure, RegisterFailure::silent);
  answers = true;
  ASSERT_TRUE(ask().good);
  EXPECT_EQ(words.front(), 55);
  EXPECT_EQ(link->counters().echoes, 2U);
}

TEST_F(AModbusLine, NoticesThatItIsGone) {
  open();
  device.unplug();
  EXPECT_FALSE(link->drain());
  EXPECT_NE(link->error(), 0);
  words.assign(kBlock.count, 0);
  EXPECT_EQ(link->read(kUnit, kBlock, words).failure, RegisterFailure::link);
}

/// libmodbus' own server on the loopback.
class Server {
 public:
  explicit Server(int answers) : context_(modbus_new_tcp("127.0.0.1", 0)) {
    listen_ = modbus_tcp_listen(context_, 1);
    sockaddr_in address{};
    socklen_t size = sizeof address;
    ::getsockname(listen_, reinterpret_cast<sockaddr*>(&address), &size);
    port = "tcp:127.0.0.1:" + std::to_string(ntohs(address.sin_port));
    mapping_ = modbus_mapping_new(0, 0, 100, 0);
    for (std::uint16_t i = 0; i < 100; ++i) mapping_->tab_registers[i] = 1000 + i;
    thread_ = std::thread([this, answers] {
      if (modbus_tcp_accept(context_, &listen_) < 0) return;
      std::array<std::uint8_t, MODBUS_TCP_MAX_ADU_LENGTH> query{};
      for (int i = 0; i < answers; ++i) {
        const int length = modbus_receive(context_, query.data());
        if (length < 0) return;
        modbus_reply(context_, query.data(), length, mapping_);
      }
      modbus_close(context_);
    });
  }
  ~Server() {
    ::shutdown(listen_, SHUT_RDWR);
    thread_.join();
    modbus_mapping_free(mapping_);
    modbus_free(context_);
    ::close(listen_);
  }
  std::string port;

 private:
  modbus_t* context_;
  int listen_ = -1;
  modbus_mapping_t* mapping_ = nullptr;
  std::thread thread_;
};

TEST(ModbusOverTcp, BringsRegistersAndExceptionsAndNoticesTheEnd) {
  Server server(2);
  ModbusSettings settings;
  settings.port = server.port;
  const ModbusUnit unit{255, 0.1, 1};
  auto opened = open_modbus(settings, &now);
  ASSERT_NE(opened.link, nullptr) << opened.problem;
  std::array<std::uint16_t, 4> words{};
  wait_until(opened.link->ready_at(unit));
  ASSERT_TRUE(opened.link->read(unit, {3, 20, 4}, words).good);
  EXPECT_EQ(words[3], 1023);
  const auto refused = opened.link->read(unit, {3, 98, 4}, words);
  EXPECT_EQ(refused.failure, RegisterFailure::refused);
  EXPECT_EQ(refused.exception, 2);
  EXPECT_EQ(opened.link->read(unit, {3, 20, 4}, words).failure, RegisterFailure::link);
}

}  // namespace
}  // namespace drover::link
