#include "runtime/recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <thread>

#include "config/load.h"
#include "gateway/recording/replay.h"
#include "support/small_robot.h"
#include "support/temp_folder.h"

namespace drover::runtime {
namespace {

using gateway::Replayed;
using ::testing::HasSubstr;
using namespace std::chrono_literals;

class ARecorder : public ::testing::Test {
 protected:
  std::string file() const { return folder.path() + "/run.rec"; }
  Recorder start(std::size_t ring_bytes = 1 << 16) {
    return Recorder(file(),
                    {"test", loaded.text, loaded.register_map, gateway::mathematics_fingerprint(),
                     gateway::field_names(gateway)},
                    ring_bytes);
  }
  /// As the control thread does it.
  void apply(Recorder& recorder, const gateway::InputBody& body) {
    const gateway::Input input{now, body};
    recorder.input(input);
    gateway.apply(input);
    if (std::holds_alternative<gateway::Tick>(body)) recorder.output(gateway);
  }
  void cycles(Recorder& recorder, int count) {
    for (int i = 0; i < count; ++i) {
      now += 5ms;
      apply(recorder, gateway::FrameHeard{0, make_frame(0x21, {0, 0, 0, 0, 8, 0, 0, 0})});
      apply(recorder, gateway::Tick{true, false});
    }
  }
  static Replayed replayed(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    return gateway::replay({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  }

  test::TempFolder folder;
  config::Loaded loaded =
      config::load_text(test::kSmallRobot, std::string(DROVER_SOURCE_DIR) + "/config/maps");
  gateway::Gateway gateway{loaded.config};
  Time now{100s};
  std::atomic<bool> stop{false};
};

TEST_F(ARecorder, WritesWhatReplaysToTheBit) {
  auto recorder = start();
  std::thread writer([&] { recorder.run(stop); });
  // More than the ring holds at once: it comes round many times.
  for (int i = 0; i < 100; ++i) {
    cycles(recorder, 20);
    std::this_thread::sleep_for(1ms);
    recorder.wake();
  }
  stop = true;
  recorder.wake();
  writer.join();
  const auto it = replayed(file());
  EXPECT_EQ(it.verdict, Replayed::Verdict::equal) << it.note << it.difference.what;
  EXPECT_EQ(it.cycles, 2000U);
  EXPECT_EQ(it.note, "");
}

TEST_F(ARecorder, WritesAPathBeforeTheCommandThatNamesIt) {
  auto recorder = start();
  Path path;
  path.number = 5;
  path.points = {{0, 0}, {1, 0}};
  recorder.path(path);
  apply(recorder, gateway::CommandGiven{{{}, now, StartTask{&path, 1, 0.5}}});
  cycles(recorder, 1);
  stop = true;
  recorder.run(stop);
  const auto it = replayed(file());
  EXPECT_EQ(it.verdict, Replayed::Verdict::equal) << it.note;
}

TEST_F(ARecorder, EndsWithAGapWhenTheDiskIsTooSlow) {
  auto recorder = start(1 << 14);
  cycles(recorder, 2000);  // nobody writes
  stop = true;
  recorder.run(stop);
  const auto it = replayed(file());
  EXPECT_EQ(it.verdict, Replayed::Verdict::unusable);
  EXPECT_THAT(it.note, HasSubstr("gap"));
  EXPECT_GT(it.cycles, 10U) << "it is whole until there";
  EXPECT_LT(it.cycles, 2000U);
}

TEST_F(ARecorder, LeavesAnEarlierRecordingAlone) {
  {
    auto first = start();
    cycles(first, 3);
    stop = true;
    first.run(stop);
  }
  auto second = start();
  EXPECT_EQ(second.file(), file() + ".1");
  auto third = start();
  EXPECT_EQ(third.file(), file() + ".2");
  EXPECT_EQ(replayed(file()).cycles, 3U);
}

TEST_F(ARecorder, SaysWhyItCannotRecord) {
  try {
    Recorder recorder(folder.path() + "/none/run.rec", {});
    FAIL() << "there is no such folder";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("cannot record"));
  }
}

}  // namespace
}  // namespace drover::runtime
