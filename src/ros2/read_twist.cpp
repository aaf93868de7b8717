#include "ros2/read_twist.h"

#include <array>
#include <cmath>

#include "drover/fixed_text.h"

namespace drover::ros2 {

Result<Twist, std::string> read_twist(const geometry_msgs_msg_dds__Twist_& message) {
  struct Part {
    const char* name;
    double value;
    const char* why_not;  ///< nullptr: a base has it, or refuses it itself
  };
  constexpr const char* kTilts = "this base only turns about z";
  const std::array<Part, 6> parts{{{"linear.x", message.linear_.x_, nullptr},
                                   {"linear.y", message.linear_.y_, nullptr},
                                   {"linear.z", message.linear_.z_, "this base cannot rise"},
                                   {"angular.x", message.angular_.x_, kTilts},
                                   {"angular.y", message.angular_.y_, kTilts},
                                   {"angular.z", message.angular_.z_, nullptr}}};
  for (const Part& part : parts)
    if (!std::isfinite(part.value))
      return std::string(part.name) + (std::isnan(part.value) ? " is NaN" : " is infinite");
  for (const Part& part : parts)
    if (part.why_not != nullptr && part.value != 0) {
      Reason why;
      why.format("%s is %g: %s", part.name, part.value, part.why_not);
      return std::string(why.view());
    }
  return Twist{message.linear_.x_, message.angular_.z_, message.linear_.y_};
}

}  // namespace drover::ros2
