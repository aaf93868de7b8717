// Where something is: headers and poses.
#include <cmath>
#include <utility>

#include "scene/message/check.h"
#include "scene/message/frames.h"
#include "scene/message/validate.h"
#include "text/number.h"

namespace drover::scene::check {
namespace {

bool is_zero(const Quaternion& q) {
  return q.w == 0 && q.x == 0 && q.y == 0 && q.z == 0;
}

/// Below this a length differs by rounding only, and the numbers stay as they came.
constexpr double kRounding = 1e-12;
/// Below this single precision explains it, and nothing is said.
constexpr double kSinglePrecision = 1e-6;

}  // namespace

Problem header(const std::string& path, const Header& header) {
  const std::string frame = member(path, "frame_id");
  if (auto problem = text(frame, header.frame_id)) return problem;
  if (is_no_frame(header.frame_id)) {
    return Refusal{frame, (header.frame_id.empty() ? "is empty" : "is 0, no frame") +
                              std::string(": a place needs one, as map or base_link")};
  }
  constexpr std::uint32_t kSecond_ns = 1'000'000'000;
  if (header.stamp.nsec < kSecond_ns) return std::nullopt;
  return Refusal{member(path, "stamp.nsec"),
                 "is " + std::to_string(header.stamp.nsec) + ": it must be below 1000000000"};
}

Problem position(const std::string& path, const Vector3& position_m) {
  for (const auto& [axis, value_m] :
       {std::pair{"x", position_m.x}, {"y", position_m.y}, {"z", position_m.z}}) {
    if (std::abs(value_m) <= kMaxCoordinate_m) continue;
    return number(member(path, axis), value_m, -kMaxCoordinate_m, kMaxCoordinate_m);
  }
  return std::nullopt;
}

Problem orientation(const std::string& path, Quaternion& orientation, Notes& notes) {
  Quaternion& q = orientation;
  for (const auto& [axis, value] : {std::pair{"x", q.x}, {"y", q.y}, {"z", q.z}, {"w", q.w}})
    if (!std::isfinite(value)) return Refusal{member(path, axis), "is no finite number"};
  if (is_zero(q)) {
    q = Quaternion{};
    note(notes, path, "all zero, taken as no turn");
    return std::nullopt;
  }
  // No square of a number that is told can be too large.
  const double length = std::hypot(std::hypot(q.w, q.x), std::hypot(q.y, q.z));
  const double error = std::abs(length - 1);
  if (!(error <= kMaxQuaternionError)) {
    return Refusal{path, "has the length " + text::number_text(length) +
                             ": a quaternion's must be 1, within 0.001"};
  }
  if (error <= kRounding) return std::nullopt;
  if (error > kSinglePrecision) {
    note(notes, path, "of the length " + text::number_text(length) + ", made 1");
  }
  q = {q.w / length, q.x / length, q.y / length, q.z / length};
  return std::nullopt;
}

Problem pose(const std::string& path, Pose& pose, Notes& notes) {
  if (auto problem = position(member(path, "position"), pose.position_m)) return problem;
  return orientation(member(path, "orientation"), pose.orientation, notes);
}

Problem poses(const std::string& path, std::vector<Pose>& poses, std::size_t shapes, Notes& notes) {
  if (poses.size() > shapes) {
    return Refusal{path, "has " + text::counted(poses.size(), "pose", "poses") + " for " +
                             text::counted(shapes, "shape", "shapes")};
  }
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (auto problem = pose(element(path, i), poses[i], notes)) return problem;
  if (poses.size() < shapes) {
    note(notes, path,
         std::to_string(shapes - poses.size()) + " of " + std::to_string(shapes) +
             " are missing, taken as the origin of the frame");
    poses.resize(shapes);
  }
  return std::nullopt;
}

}  // namespace drover::scene::check
