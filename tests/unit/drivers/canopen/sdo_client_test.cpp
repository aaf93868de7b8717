// Frames of christiansandberg/canopen, test/test_sdo.py (node 2), where nothing else is said.
#include "drivers/canopen/sdo_client.h"

#include <gtest/gtest.h>

#include <string>

#include "support/describe.h"

namespace drover::canopen {
namespace {

using std::chrono::milliseconds;
using test::describe;
using test::parse_frame;

Time at(int ms) {
  return Time{} + milliseconds(ms);
}

class CanopenSdo : public testing::Test {
 protected:
  SdoClient client{2};

  /// What the client says to this answer; "" when nothing.
  std::string after(const char* answer) {
    const auto frame = client.on_frame(parse_frame(answer), at(0));
    return frame ? describe(*frame) : "";
  }
  std::string text() {
    const auto outcome = client.take_outcome();
    return outcome ? std::string(outcome->data.begin(), outcome->data.end()) : "";
  }
  std::optional<std::uint32_t> number() {
    const auto outcome = client.take_outcome();
    return outcome && outcome->kind == SdoOutcome::Kind::read ? outcome->number() : std::nullopt;
  }
};

TEST_F(CanopenSdo, ReadsANumber) {
  EXPECT_EQ(describe(client.read({0x1018, 1}, at(0))), "602#4018100100000000");
  EXPECT_TRUE(client.busy());
  EXPECT_EQ(after("582#4318100104000000"), "");
  EXPECT_FALSE(client.busy());
  EXPECT_EQ(number(), 4U);
}

TEST_F(CanopenSdo, ReadsAnAnswerThatIsNoLongerThanItsValue) {
  client.read({0x1400, 2}, at(0));
  after("582#4F001402FE");
  EXPECT_EQ(number(), 0xFEU);
}

TEST_F(CanopenSdo, ReadsAnAnswerThatDoesNotTellItsSize) {
  client.read({0x1400, 2}, at(0));
  after("582#42001402FE000000");
  EXPECT_EQ(number(), 0xFEU);
}

TEST_F(CanopenSdo, LeavesOutWhatStandsBehindTheValue) {
  client.read({0x2005, 0}, at(0));
  after("582#4F052000FEFDFCFB");
  EXPECT_EQ(number(), 0xFEU);
}

TEST_F(CanopenSdo, ReadsATextInSegments) {
  client.read({0x1008, 0}, at(0));
  EXPECT_EQ(after("582#410810001A000000"), "602#6000000000000000");
  EXPECT_EQ(after("582#0054696E79204E6F"), "602#7000000000000000");
  EXPECT_EQ(after("582#106465202D204D65"), "602#6000000000000000");
  EXPECT_EQ(after("582#00676120446F6D61"), "602#7000000000000000");
  EXPECT_EQ(after("582#15696E7320210000"), "");
  EXPECT_EQ(text(), "Tiny Node - Mega Domains !");
}

TEST_F(CanopenSdo, GivesUpASegmentThatDoesNotAlternate) {
  client.read({0x1008, 0}, at(0));
  after("582#410810001A000000");
  EXPECT_EQ(after("582#1054696E79204E6F"), "602#8008100000000305");
  EXPECT_EQ(client.take_outcome()->kind, SdoOutcome::Kind::refused);
}

TEST_F(CanopenSdo, GivesUpAValueThatIsTooLongForIt) {
  client.read({0x1008, 0}, at(0));
  EXPECT_EQ(after("582#4108100041000000"), "602#8008100005000405");
  client.read({0x1008, 0}, at(0));
  // One that never tells its end.
  EXPECT_EQ(after("582#4008100000000000"), "602#6000000000000000");
  bool toggle = false;
  for (int i = 0; i < 9; ++i, toggle = !toggle)
    EXPECT_NE(after(toggle ? "582#1041414141414141" : "582#0041414141414141"), "");
  EXPECT_EQ(after("582#1041414141414141"), "602#8008100005000405");
  EXPECT_FALSE(client.busy());
}

TEST_F(CanopenSdo, GivesUpANodeThatSendsSegmentsOfNothing) {
  client.read({0x1008, 0}, at(0));
  after("582#410810001A000000");
  EXPECT_EQ(after("582#0E00000000000000"), "602#8008100001000405");
}

TEST_F(CanopenSdo, GivesUpATextOfAnotherLengthThanAnnounced) {
  client.read({0x1008, 0}, at(0));
  after("582#4108100005000000");
  EXPECT_EQ(after("582#0141424344454647"), "602#8008100010000706");
}

TEST_F(CanopenSdo, Writes) {
  EXPECT_EQ(describe(client.write({0x1017, 0}, u16(4000), at(0))), "602#2B171000A00F0000");
  EXPECT_EQ(after("582#6017100000000000"), "");
  EXPECT_EQ(client.take_outcome()->kind, SdoOutcome::Kind::written);
  EXPECT_EQ(describe(client.write({0x6060, 0}, u8(3), at(0))), "602#2F60600003000000");
  client.forget();
  EXPECT_EQ(describe(client.write({0x60FF, 0}, i32(-1000), at(0))), "602#23FF600018FCFFFF");
}

TEST_F(CanopenSdo, TellsWhyTheNodeRefuses) {
  client.read({0x1018, 1}, at(0));
  after("582#8018100111000906");
  const auto outcome = client.take_outcome();
  EXPECT_EQ(outcome->kind, SdoOutcome::Kind::refused);
  EXPECT_EQ(outcome->code, 0x06090011U);
  EXPECT_EQ(abort_text(outcome->code), "no such subindex");
  EXPECT_EQ(abort_text(0x12345678), "refused with a code of the maker's own");
}

TEST_F(CanopenSdo, LeavesAloneWhatIsNoAnswerToItsQuestion) {
  after("582#4318100104000000");
  EXPECT_FALSE(client.take_outcome()) << "nothing was asked";
  client.read({0x1018, 1}, at(0));
  for (const char* frame : {"582#4318100204000000", "583#4318100104000000", "602#4318100104000000",
                            "582#6018100100000000", "582#0054696E79204E6F", "582#43181001", "582#",
                            "582#R", "582#80181001110009", "582#A018100100000000"}) {
    EXPECT_EQ(after(frame), "") << frame;
    EXPECT_TRUE(client.busy()) << frame;
  }
  after("582#4318100104000000");
  EXPECT_EQ(number(), 4U);
}

TEST_F(CanopenSdo, DoesNotWaitForEver) {
  client.read({0x1018, 1}, at(0));
  EXPECT_FALSE(client.on_tick(at(199)));
  EXPECT_EQ(describe(client.on_tick(at(200)).value()), "602#8018100100000405");
  EXPECT_EQ(client.take_outcome()->kind, SdoOutcome::Kind::silent);
  EXPECT_FALSE(client.on_tick(at(500)));
  after("582#4318100104000000");
  EXPECT_FALSE(client.take_outcome()) << "an answer that comes too late";
}

TEST_F(CanopenSdo, ForgetsWhatItAskedWhenTheNodeWasRestarted) {
  client.read({0x1018, 1}, at(0));
  client.forget();
  EXPECT_FALSE(client.busy());
  EXPECT_FALSE(client.on_tick(at(500)));
}

}  // namespace
}  // namespace drover::canopen
