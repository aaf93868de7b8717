// Every kind of input, and every kind of command, at least once.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "gateway/input.h"
#include "support/describe.h"

namespace drover::gateway {

struct OneOfEachInput {
  OneOfEachInput() {
    path.number = 3;
    path.name = "row";
    path.points = {{0, 0}, {5, 0}};
    add(LinkUp{0});
    add(LinkUp{1});
    add(LinkUp{2});
    add(LinkUp{3});
    add(FrameHeard{0, test::parse_frame("021#0000000008000000")});
    add(FrameHeard{0, test::parse_frame("049#0000004000000000")});
    CanFrame error;
    error.error = true;
    error.id = 0x40;
    error.len = 8;
    add(FrameHeard{0, error});
    CanFrame odd = make_frame(0x18FF1234, {1, 2, 3});
    odd.extended = odd.fd = true;
    add(FrameHeard{0, odd});
    add(BytesHeard{1, view(sentence)});
    add(BytesHeard{2, view(sensor)});
    LevelsRead levels;
    levels.link = 4;
    (void)levels.levels.push_back(true);
    (void)levels.levels.push_back(false);
    add(levels);
    add(LinkLost{4, {}});
    RegistersRead read;
    read.slot = 4;
    read.words.resize(62);
    for (std::size_t i = 0; i < read.words.size(); ++i)
      read.words[i] = static_cast<std::uint16_t>(700 * i);
    add(read);
    add(RegistersFailed{4, 1, RegisterFailure::refused, 2});
    add(FramesSent{0, 40, 3});
    JointTargets joints;
    (void)joints.joints.push_back({0, 0.0});
    (void)joints.joints.push_back({1, -2.5});
    command(std::monostate{});
    command(SetOrigin{{52.1, 10.2, 80.0}});
    command(joints);
    command(JointTargetsRefused{"an unknown joint"});
    command(JointTargetsRefused{"droverd has only just come", true});
    command(StartTask{&path, 1, 0.5});
    command(FindHeading{});
    command(ProposeOrigin{});
    command(CancelTask{});
    command(EngageStop{});
    command(ResetStop{});
    command(ReleaseHold{true});
    command(ArmHold{});
    command(AcceptPosition{});
    command(ForgetLearned{});
    command(DriveByHand{7, {0.3, -0.1}});
    command(FollowTwist{{0.3, -0.1, 0.2}});
    command(FollowTwist{{}, true});
    command(TwistRefused{"linear.y is 0.3"});
    command(TwistRefused{"two programs write it", true});
    add(Tick{true, false});
    add(ProgramTrouble{"droverd ends"});
    add(Suspended{2.5});
    Remembered left{"emergency stop", true, false, true, false, true, true, "bumper touched", true};
    left.place.doubt_cm = 65;
    add(Recalled{left});
    LearnedValues learned;
    learned.receiver = 1;
    learned.mounting_rad = {0.03, 0.002};
    learned.late_s = {0.08, 0.01};
    add(LearnedRecalled{learned});
    add(OutputsUp{true});
    add(ClearanceFound{{Time{std::chrono::milliseconds(40)},
                        7,
                        3,
                        {0.5, -0.1, 0.2},
                        INFINITY,
                        3,
                        1.5,
                        0.25,
                        2,
                        1.25,
                        0.75,
                        {INFINITY, 3.5, 1.75, 0.5, 2.5, 1.375, 0.875},
                        "box1",
                        "box2 is in the way of the turn to the left, after 14 deg",
                        "blind",
                        "the fence of field_north"}});
    add(ClearanceFound{});
    add(HeldUp{0.31});
    add(LinkLost{0, "can0: lost (No such device)"});
    add(Tick{false, true, true});
    add(Tick{false, true, true, false, true});
  }
  OneOfEachInput(const OneOfEachInput&) = delete;
  OneOfEachInput& operator=(const OneOfEachInput&) = delete;

  void add(const InputBody& body) {
    now += std::chrono::milliseconds(1);
    inputs.push_back({now, body});
  }
  void command(decltype(Command::body) body) {
    add(CommandGiven{{{RequestId::Source::cli, inputs.size()}, now, std::move(body)}});
  }
  static std::span<const std::uint8_t> view(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
  }

  Path path;
  std::string sentence =
      "$GNGGA,103607.00,5327.03942,N,00214.42462,W,4,06,5.88,56.0,M,48.5,M,,*69\r\n";
  std::string sensor = std::string("\x55\x51\x00\x00\x00\x00\x00\x08\x00\x00\xAE", 11);
  Time now{std::chrono::seconds(100)};
  std::vector<Input> inputs;
};

}  // namespace drover::gateway
