#include "runtime/parser_loop.h"

#include <gmock/gmock.h>
#include <poll.h>

#include <thread>

namespace drover::runtime {
namespace {

class ParserLoopTest : public testing::Test {
 protected:
  ParserLoopTest() : thread_([this] { parser_->run(stop_); }) {}
  ~ParserLoopTest() override {
    stop_ = true;
    parser_->wake();
    thread_.join();
  }
  std::optional<ParseReply> reply() {
    ParseReply taken;
    for (int i = 0; i < 1000; ++i) {
      if (parser_->take(taken)) return taken;
      pollfd wait{parser_->replies_ready().fd(), POLLIN, 0};
      (void)::poll(&wait, 1, 10);
      parser_->replies_ready().clear();
    }
    return std::nullopt;
  }

  std::unique_ptr<ParserLoop> parser_ = std::make_unique<ParserLoop>(publish::ControlLimits{});
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

TEST_F(ParserLoopTest, GivesBackWhatItReadInTheOrderInWhichItCame) {
  ASSERT_TRUE(parser_->give({R"({"cmd_type":"task_control","cmd":"cancel_task"})", {}}));
  ASSERT_TRUE(parser_->give({"{", {}}));
  EXPECT_TRUE(parser_->busy());
  const auto first = reply();
  ASSERT_TRUE(first && first->request);
  EXPECT_TRUE(publish::is_stop(*first->request));
  const auto second = reply();
  ASSERT_TRUE(second && second->request);
  EXPECT_FALSE(second->request->ok());
  EXPECT_EQ(second->job.payload, "{");
  EXPECT_FALSE(parser_->busy());
}

TEST_F(ParserLoopTest, TakesOnlySoMuchAtOnce) {
  const std::string large(std::size_t{2} << 20, ' ');
  int taken = 0;
  while (parser_->give({large, {}})) ++taken;
  EXPECT_EQ(taken, 4);
  for (int i = 0; i < taken; ++i) EXPECT_TRUE(reply());
  EXPECT_TRUE(parser_->give({large, {}}));
}

}  // namespace
}  // namespace drover::runtime
