// A key that drives, on its way from the socket to the engine and back, and what is measured.
#include "publish/hand_outlet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace drover::publish {
namespace {

using testing::HasSubstr;

class HandOutletTest : public ::testing::Test {
 protected:
  std::string reply_to(const std::string& line, ClientId client = 7) {
    actions_.clear();
    EXPECT_TRUE(outlet_.on_line(client, line, now_, actions_));
    const auto* reply = actions_.empty() ? nullptr : std::get_if<Reply>(&actions_.back());
    return reply == nullptr ? "" : reply->line;
  }
  std::optional<Command> command() const {
    const auto* command = actions_.empty() ? nullptr : std::get_if<Command>(&actions_.back());
    return command == nullptr ? std::nullopt : std::optional(*command);
  }
  std::vector<Reply> replies_to(const Event& event) {
    actions_.clear();
    outlet_.on_event(event, actions_);
    std::vector<Reply> all;
    for (const Action& action : actions_) all.push_back(std::get<Reply>(action));
    return all;
  }
  static constexpr const char* kKey = R"({"cmd":"drive_by_hand","vx_mps":0.3,"wz_radps":-0.1})";

  Time now_{std::chrono::seconds(100)};
  Snapshot seen_;
  Actions actions_;
  HandOutlet outlet_{{R"({"robot": "a"})", "map"}, [this](Time) { return seen_; }};
};

TEST_F(HandOutletTest, AKeyIsACommandOfHimWhoIsConnectedAndTheEngineAnswers) {
  EXPECT_EQ(reply_to(kKey), "");
  const auto given = command();
  ASSERT_TRUE(given);
  EXPECT_EQ(given->received, now_);
  const auto& key = std::get<DriveByHand>(given->body);
  EXPECT_EQ(key.hand, 7);
  EXPECT_EQ(key.twist.vx_mps, 0.3);
  EXPECT_EQ(key.twist.wz_radps, -0.1);
  const auto said = replies_to({now_, CommandRefused{given->id, "e-stop pressed"}});
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].client, 7U);
  EXPECT_EQ(said[0].line, R"({"ok":false,"reason":"e-stop pressed"})");
  EXPECT_TRUE(replies_to({now_, CommandRefused{given->id, "again"}}).empty());
  EXPECT_TRUE(replies_to({now_, CommandAccepted{{RequestId::Source::cli, 1}, {}}}).empty());
}
TEST_F(HandOutletTest, AKeyCountsFromWhenItCameToItsTerminal) {
  const auto at = [&](const char* ns) {
    return reply_to(R"({"cmd":"drive_by_hand","vx_mps":0.3,"wz_radps":0,"at_ns":)" +
                    std::string(ns) + "}");
  };
  EXPECT_EQ(at("99900000000"), "");
  EXPECT_EQ(command()->received, Time{std::chrono::milliseconds(99900)});
  EXPECT_EQ(at("200000000000"), "");
  EXPECT_EQ(command()->received, now_) << "that is not yet";
  for (const char* ns : {"-1", "1e300", "null", "\"now\""})
    EXPECT_THAT(at(ns), HasSubstr("at_ns")) << ns;
}
TEST_F(HandOutletTest, AKeyThatTheEngineDoesNotTakeIsAnswered) {
  EXPECT_EQ(reply_to(kKey), "");
  const auto given = command();
  ASSERT_TRUE(given);
  actions_.clear();
  outlet_.on_undelivered({{RequestId::Source::mqtt, given->id.number}, now_, {}}, actions_);
  EXPECT_TRUE(actions_.empty()) << "another one's";
  outlet_.on_undelivered(*given, actions_);
  ASSERT_EQ(actions_.size(), 1U);
  const auto& reply = std::get<Reply>(actions_[0]);
  EXPECT_EQ(reply.client, 7U);
  EXPECT_THAT(reply.line, HasSubstr("takes no command now"));
}
TEST_F(HandOutletTest, EachOneIsAnsweredInWhateverOrderTheAnswersCome) {
  EXPECT_EQ(reply_to(kKey, 7), "");
  const auto first = command();
  EXPECT_EQ(reply_to(kKey, 8), "");
  const auto second = command();
  ASSERT_TRUE(first && second);
  // The ring was full for the newer one, which is known before the engine answers the older one.
  actions_.clear();
  outlet_.on_undelivered(*second, actions_);
  ASSERT_EQ(actions_.size(), 1U);
  EXPECT_EQ(std::get<Reply>(actions_[0]).client, 8U);
  const auto said = replies_to({now_, CommandAccepted{first->id, {}}});
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].client, 7U);
}
TEST_F(HandOutletTest, WhatIsWaitedForNoLongerIsAnsweredToo) {
  std::vector<ClientId> told;
  for (ClientId client = 1; client <= 300; ++client) {
    actions_.clear();
    EXPECT_TRUE(outlet_.on_line(client, kKey, now_, actions_));
    for (const Action& action : actions_)
      if (const auto* reply = std::get_if<Reply>(&action)) told.push_back(reply->client);
  }
  ASSERT_EQ(told.size(), 300U - 256U);
  EXPECT_EQ(told.front(), 1U);
  EXPECT_EQ(told.back(), 44U);
}
TEST_F(HandOutletTest, AFloodIsToldToSlowDownAndHeldBack) {
  int given = 0;
  for (int i = 0; i < 100; ++i) {
    if (reply_to(kKey).empty()) ++given;
  }
  EXPECT_LE(given, 21);
  EXPECT_THAT(reply_to(kKey), HasSubstr("slow down"));
  EXPECT_EQ(reply_to(kKey, 8), "") << "somebody else's key";
}
TEST_F(HandOutletTest, ThatTheKeyIsUpPassesHoweverManyKeysCameBefore) {
  constexpr const char* kUp = R"({"cmd":"drive_by_hand","vx_mps":0,"wz_radps":0})";
  for (int i = 0; i < 100; ++i) (void)reply_to(kKey);
  EXPECT_EQ(reply_to(kUp), "");
  const auto up = command();
  ASSERT_TRUE(up);
  EXPECT_TRUE(is_zero(std::get<DriveByHand>(up->body).twist));
  EXPECT_THAT(reply_to(kUp), HasSubstr("slow down")) << "it is known";
  outlet_.on_undelivered(*up, actions_);
  EXPECT_EQ(reply_to(kUp), "") << "it was not";
}
TEST_F(HandOutletTest, WhoLooksTooOftenIsToldToSlowDown) {
  int told = 0;
  for (int i = 0; i < 400; ++i, now_ += std::chrono::milliseconds(1))
    if (reply_to(R"({"cmd":"drive_values"})").find("slow down") == std::string::npos) ++told;
  EXPECT_GE(told, 190);
  EXPECT_LE(told, 210);
  // As often as a drive looks.
  now_ += std::chrono::seconds(1);
  for (int i = 0; i < 400; ++i, now_ += std::chrono::milliseconds(5))
    ASSERT_THAT(reply_to(R"({"cmd":"drive_values"})"), HasSubstr("values"));
}
TEST_F(HandOutletTest, ForgetsWhoWasNotHeardForLong) {
  for (int i = 0; i < 100; ++i) (void)reply_to(kKey, 1);
  for (ClientId client = 2; client < 1000; ++client) {
    now_ += std::chrono::milliseconds(1);
    (void)reply_to(R"({"cmd":"drive_values"})", client);
  }
  EXPECT_EQ(reply_to(kKey, 1), "");
}
TEST_F(HandOutletTest, AKeyWithoutASpeedIsRefused) {
  EXPECT_THAT(reply_to(R"({"cmd":"drive_by_hand","vx_mps":0.3})"), HasSubstr("wz_radps"));
  EXPECT_THAT(reply_to(R"({"cmd":"drive_by_hand","vx_mps":"0.3","wz_radps":0})"),
              HasSubstr("missing"));
}
TEST_F(HandOutletTest, TellsWhatIsMeasuredAndWhenItWasTrue) {
  seen_.time = now_;
  AxisSnapshot axis;
  axis.motion.velocity_radps = 1.5;
  axis.last_motion = now_ - std::chrono::milliseconds(3);
  (void)seen_.axes.push_back(axis);
  EXPECT_THAT(reply_to(R"({"cmd":"drive_values"})"),
              testing::AllOf(HasSubstr(R"("at_ns":99997000000,"radps":1.5)"),
                             HasSubstr(R"("heading":{"at_ns":null,"deg":null})")));
}
TEST_F(HandOutletTest, TellsTheConfigurationThatIsInUseAndLeavesOthersLines) {
  EXPECT_EQ(reply_to(R"({"cmd":"configuration"})"),
            R"({"ok":true,"configuration":"{\"robot\": \"a\"}","register_map":"map"})");
  EXPECT_FALSE(outlet_.on_line(7, R"({"cmd":"status"})", now_, actions_));
  EXPECT_FALSE(outlet_.on_line(7, "nonsense", now_, actions_));
}

}  // namespace
}  // namespace drover::publish
