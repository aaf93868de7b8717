// The judge of what an arm's motors are told, on small records made by hand.
#include "mission/arm_wire.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace drover::mission {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr AllArmBounds kBounds{{{1, 80, 0.5}, {1, 150, 0.5}, {1, 60, 0.5}}};

/// A DM4310 and what it is told, number 3 on the bus: each 5 ms one frame, as its maker packs it.
class ArmWire : public testing::Test {
 protected:
  void tells(double position_rad, double velocity_radps = 0) {
    const unsigned p = raw(position_rad, 12.5, 16);
    const unsigned v = raw(velocity_radps, 30, 12);
    add(0x13, {0x13, p >> 8U, p, v >> 4U, (v & 15U) << 4U | 7U, 0xFF, 30, 30});
  }
  void told(double position_rad, double stiffness, double torque_Nm = 0) {
    time_ += 5ms;
    const unsigned p = raw(position_rad, 12.5, 16);
    const auto k = static_cast<unsigned>(stiffness / 500 * 4095);
    const unsigned t = raw(torque_Nm, 10, 12);
    add(3, {p >> 8U, p, 0x7F, 0xF0U | k >> 8U, k, 0x66, 0x60U | t >> 8U, t});
  }
  /// Comes up to 60 Nm/rad in half a second, and stays there.
  void engage(double position_rad) {
    told(position_rad, 0);
    for (int i = 1; i <= 400; ++i) told(position_rad, std::min(0.6 * i, 60.0));
  }
  Problems steps() const { return check_arm_steps(record_, kBounds); }

  static unsigned raw(double value, double end, unsigned bits) {
    return static_cast<unsigned>((value + end) / (2 * end) * ((1U << bits) - 1));
  }
  void add(std::uint32_t id, std::initializer_list<unsigned> bytes) {
    CanLine line;
    line.time = time_;
    line.bus = "can1";
    line.frame.id = id;
    line.frame.len = 8;
    std::size_t at = 0;
    for (const unsigned byte : bytes) line.frame.data[at++] = static_cast<std::uint8_t>(byte);
    record_.can.push_back(line);
  }

  Record record_;
  Time time_{1s};
};

TEST_F(ArmWire, WhatRisesAndMovesWithinItsLimitsIsWell) {
  tells(0.4);
  engage(0.4);
  for (int i = 0; i < 100; ++i) told(0.4 + 0.005 * i, 60);
  EXPECT_THAT(steps(), IsEmpty());
}

TEST_F(ArmWire, APositionThatStepsIsFound) {
  tells(0.4);
  engage(0.4);
  told(0.41, 60);
  EXPECT_THAT(steps(), ElementsAre(HasSubstr("joint 2 steps by 0.0099")));
}

TEST_F(ArmWire, AHoldMayBeginWhereTheJointIsIfItsTorqueStays) {
  tells(0.4);
  engage(0.4);
  tells(0.39);
  told(0.39, 60, 0.6);
  EXPECT_THAT(steps(), IsEmpty());
  told(0.41, 60, 0.6);
  EXPECT_THAT(steps(), ElementsAre(HasSubstr("1.2")));
}

TEST_F(ArmWire, WhoBeginsElsewhereThanWhereItIsIsFound) {
  tells(0.4);
  engage(0.43);
  EXPECT_THAT(steps(), ElementsAre(HasSubstr("begins 0.0297")));
}

TEST_F(ArmWire, StiffnessThatComesAtOnceOrTooLateIsFound) {
  tells(0.4);
  told(0.4, 0);
  for (int i = 1; i <= 400; ++i) told(0.4, 60);
  EXPECT_THAT(steps(), ElementsAre(HasSubstr("stiffer by 59.9")));
  record_ = {};
  tells(0.4);
  told(0.4, 0);
  for (int i = 1; i <= 400; ++i) told(0.4, std::min(0.2 * i, 60.0));
  EXPECT_THAT(steps(), ElementsAre(HasSubstr("has not come up yet")));
}

TEST_F(ArmWire, NothingStiffIsNothingJudged) {
  EXPECT_THAT(steps(), ElementsAre("no motor was ever told to hold"));
}

TEST_F(ArmWire, OnlyDampingIsDampingAndIsThereAllTheTime) {
  const auto of_elbow = [this](Time begin) {
    auto problems = check_arm_only_damped(record_, begin, time_);
    std::erase_if(problems, [](const auto& text) { return text.find("joint 2") == text.npos; });
    return problems;
  };
  for (int i = 0; i < 20; ++i) told(0, 0);
  EXPECT_THAT(of_elbow(Time{1s}), IsEmpty());
  told(0, 0, 0.1);
  told(0.4, 1);
  EXPECT_THAT(of_elbow(Time{1s}),
              ElementsAre(HasSubstr("told to move"), HasSubstr("told to move")));
  const Time silent = time_;
  time_ += 200ms;
  EXPECT_THAT(of_elbow(silent + 1ms), ElementsAre(HasSubstr("told nothing")));
}

}  // namespace
}  // namespace drover::mission
