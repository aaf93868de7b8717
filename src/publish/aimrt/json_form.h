// AimRT's messages as JSON, in the form in which AimRT itself writes them.
//
// Protobuf's JSON mapping with original field names (time_stamp): every scalar is written, also 0;
// 64-bit integers are texts, NaN and infinity too; no white space.
#pragma once

#include <string>

namespace aimrt::protocols::sensor {
class ImuState;
class JointState;
class TouchState;
}  // namespace aimrt::protocols::sensor

namespace drover::publish::aimrt {

std::string json_form(const ::aimrt::protocols::sensor::JointState& message);
std::string json_form(const ::aimrt::protocols::sensor::ImuState& message);
std::string json_form(const ::aimrt::protocols::sensor::TouchState& message);

}  // namespace drover::publish::aimrt
