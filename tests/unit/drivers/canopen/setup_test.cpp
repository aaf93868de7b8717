#include "drivers/canopen/setup.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "drover/bytes.h"
#include "support/describe.h"

namespace drover::canopen {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;

constexpr std::uint8_t kNode = 5;
constexpr SdoStep kSteps[] = {
    {.object = {0x1017, 0}, .value = u16(100)},
    {.object = {0x6060, 0}, .value = u8(3)},
};

/// A node that keeps what is written, unless told otherwise.
struct Node {
  std::map<std::uint16_t, std::uint32_t> objects;
  std::uint16_t refuses = 0;
  std::uint16_t keeps_zero = 0;
  bool silent = false;
  int asked = 0;

  std::optional<CanFrame> answer(const CanFrame& request) {
    if (request.data[0] == 0x80) return {};
    ++asked;
    if (silent) return {};
    const auto index = load_le<std::uint16_t>(request.data, 1);
    CanFrame reply = request;
    reply.id = 0x580U + kNode;
    if (index == refuses) {
      reply.data[0] = 0x80;
      store_le(reply.data, 4, std::uint32_t{0x06010002});
    } else if (request.data[0] == 0x40) {
      reply.data[0] = 0x43;
      store_le(reply.data, 4, objects[index]);
    } else {
      objects[index] = index == keeps_zero ? 0U : load_le<std::uint32_t>(request.data, 4);
      reply.data[0] = 0x60;
    }
    return reply;
  }
};

class CanopenSetup : public testing::Test {
 protected:
  Node node;
  SdoSetup setup{kNode, kSteps};
  Time now{};

  void run(int ticks) {
    for (int i = 0; i < ticks; ++i, now += milliseconds(5)) {
      auto frame = setup.on_tick(now);
      while (frame) {
        const auto reply = node.answer(*frame);
        frame.reset();
        if (reply) frame = setup.on_frame(*reply, now);
      }
    }
  }
};

TEST_F(CanopenSetup, WritesAndReadsBackEachObject) {
  run(10);
  EXPECT_TRUE(setup.done());
  EXPECT_FALSE(setup.failed());
  EXPECT_EQ(node.objects[0x1017], 100U);
  EXPECT_EQ(node.objects[0x6060], 3U);
  EXPECT_EQ(node.asked, 4);
}

TEST_F(CanopenSetup, BelievesOnlyWhatItReadsBack) {
  node.keeps_zero = 0x6060;
  run(20);
  EXPECT_FALSE(setup.done());
  EXPECT_EQ(setup.reason(), "object 6060:00 holds 0 after 3 was written");
}

TEST_F(CanopenSetup, SaysWhichObjectWasRefusedAndWhy) {
  node.refuses = 0x1017;
  run(20);
  EXPECT_TRUE(setup.failed());
  EXPECT_EQ(setup.reason(), "object 1017:00 cannot be written: can only be read (06010002)");
}

TEST_F(CanopenSetup, GoesOnWithoutWhatMayBeRefused) {
  constexpr SdoStep kLenient[] = {
      {.object = {0x2000, 0}, .value = u16(1), .may_be_refused = true},
      {.object = {0x6060, 0}, .value = u8(3), .read_back = false},
  };
  SdoSetup lenient(kNode, kLenient);
  std::swap(setup, lenient);
  node.refuses = 0x2000;
  run(20);
  EXPECT_TRUE(setup.done());
  EXPECT_EQ(node.asked, 2);
}

TEST_F(CanopenSetup, AsksASilentNodeThreeTimes) {
  node.silent = true;
  run(400);
  EXPECT_EQ(node.asked, 3);
  EXPECT_THAT(std::string(setup.reason().view()), HasSubstr("1017:00: the node does not answer"));
}

TEST_F(CanopenSetup, OutlivesOneLostAnswer) {
  node.silent = true;
  run(10);
  node.silent = false;
  run(100);
  EXPECT_TRUE(setup.done());
}

TEST_F(CanopenSetup, BeginsAnewAfterABootUp) {
  node.keeps_zero = 0x6060;
  run(20);
  ASSERT_TRUE(setup.failed());
  node = {};
  setup.begin();
  run(20);
  EXPECT_TRUE(setup.done());
}

}  // namespace
}  // namespace drover::canopen
