// What one message may weigh: the broker's file, the units and the daemon must agree.
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "publish/command_service.h"
#include "runtime/parser_loop.h"
#include "store/track.h"

namespace drover::runtime {
namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20;
/// A broker and a libmosquitto client hold a message three times while they pass it on.
constexpr std::size_t kCopies = 3;
constexpr std::size_t kPacketRoom = 4096;  // topic and headers

/// The number behind a word at the beginning of a line.
std::size_t number(const std::string& file, const std::string& word) {
  std::ifstream in(std::string(DROVER_SOURCE_DIR "/config/") + file);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(word)) return std::stoul(line.substr(word.size()));
  ADD_FAILURE() << file << ": no " << word;
  return 0;
}

std::size_t broker(const std::string& word) {
  return number("mosquitto/drover.conf", word + " ");
}

TEST(BrokerLimits, TheBrokerTakesTheLongestListAndTheLargestCommand) {
  EXPECT_GE(broker("max_packet_size"), store::kMaxListBytes + kPacketRoom);
  // One byte too many is to be refused with a reason, which only we give.
  EXPECT_GE(broker("max_packet_size"), publish::ControlLimits{}.max_bytes + kMiB);
  EXPECT_EQ(publish::CommandServiceConfig{}.max_message_bytes, store::kMaxListBytes);
}

TEST(BrokerLimits, TheBrokersMemoryHoldsAListTwoSlowReadersAndASave) {
  const auto list = broker("max_packet_size");
  // One begins below the limit, one more ends above it.
  const auto slow_reader = broker("max_inflight_bytes") + list;
  EXPECT_GE(broker("memory_limit"),
            kCopies * list + 2 * slow_reader + kCopies * publish::ControlLimits{}.max_bytes);
  EXPECT_GT(number("systemd/mosquitto.service.d/drover.conf", "MemoryMax=") * kMiB,
            broker("memory_limit") + 8 * kMiB);
}

TEST(BrokerLimits, TheDaemonsMemoryHoldsTheWorstOfEverythingAtOnce) {
  constexpr std::size_t kAtRest = 24 * kMiB;
  constexpr std::size_t kTree = 16;  // of a parsed message, times its size: short numbers
  const publish::CommandServiceConfig service;
  const std::size_t tracks = 2 * store::kMaxListBytes;  // spelled, and as numbers
  const std::size_t worst = kAtRest + tracks + kCopies * store::kMaxListBytes +
                            2 * kCopies * broker("max_packet_size") +  // on each connection
                            ParserLoop::kMostWaitingBytes + kTree * service.limits.max_bytes +
                            service.max_pending_bytes;
  EXPECT_GE(number("systemd/droverd.service.in", "MemoryMax=") * kMiB, worst) << worst / kMiB;
}

}  // namespace
}  // namespace drover::runtime
