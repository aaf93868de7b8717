// What is wrong with a chassis, in words that are the same on both wires.
#pragma once

#include <string_view>

namespace drover::gt01::words {

inline constexpr std::string_view kHardEstop = "the chassis' emergency stop button is pressed";
inline constexpr std::string_view kRemoteEstop = "the remote control's emergency stop is on";
inline constexpr std::string_view kSoftEstop =
    "the chassis' emergency stop by software is on: end it with its own tool";
inline constexpr std::string_view kFrontBumper =
    "the front bumper was touched: press and release the chassis' emergency stop button";
inline constexpr std::string_view kRearBumper =
    "the rear bumper was touched: press and release the chassis' emergency stop button";
inline constexpr std::string_view kRemote = "the remote control has the chassis";
inline constexpr std::string_view kDocking =
    "the chassis docks by itself: end it with its own tool";

}  // namespace drover::gt01::words
